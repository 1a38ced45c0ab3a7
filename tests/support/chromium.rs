//! Chromium over its DevTools protocol: messages of JSON, each ended by a zero byte, through two
//! named pipes that the browser has as descriptors 3 and 4.

use serde_json::{Value, json};
use std::ffi::OsString;
use std::fs::{File, OpenOptions};
use std::io::{BufRead, BufReader, Write};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::sync::mpsc::{Receiver, channel};
use std::time::{Duration, Instant};
use tempfile::TempDir;

/// Longest that the browser may take for anything: a loaded machine starts it in some seconds.
const PATIENCE: Duration = Duration::from_secs(60);

pub struct Browser {
    process: Child,
    commands: File,
    messages: Receiver<Value>,
    /// Messages about tabs that nobody has asked for yet.
    told: Vec<Value>,
    count: u64,
    _folder: TempDir,
}

/// A page that is open.
pub struct Tab<'a> {
    browser: &'a mut Browser,
    session: String,
    target: String,
}

impl Browser {
    /// Starts the browser that `SIGNORINI_BROWSER` names, or `chromium`; `None` where there is
    /// none.
    pub fn start() -> Option<Self> {
        let name = std::env::var_os("SIGNORINI_BROWSER").unwrap_or_else(|| OsString::from("chromium"));
        Command::new(&name).arg("--version").stdout(Stdio::null()).stderr(Stdio::null()).status().ok()?;
        let folder = tempfile::tempdir().unwrap();
        let [to, from] = ["to", "from"].map(|name| folder.path().join(name));
        assert!(Command::new("mkfifo").args([&to, &from]).status().unwrap().success());
        // The shell opens the pipes as the descriptors that the browser expects; both ends are
        // opened for reading and writing, so that neither side waits for the other.
        let script = "to=$1; from=$2; shift 2; exec \"$@\" 3<>\"$to\" 4<>\"$from\"";
        let process = Command::new("sh")
            .args(["-c", script, "sh"])
            .args([&to, &from])
            .arg(&name)
            .args(["--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run"])
            .args(["--disable-background-networking", "--disable-component-update", "--disable-sync"])
            .args(["--remote-debugging-pipe", "--hide-scrollbars", "--window-size=1280,900"])
            .arg(format!("--user-data-dir={}", folder.path().join("profile").display()))
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        let both = |path: &Path| OpenOptions::new().read(true).write(true).open(path).unwrap();
        let commands = both(&to);
        let mut reader = BufReader::new(both(&from));
        let (sender, messages) = channel();
        std::thread::spawn(move || {
            let mut bytes = Vec::new();
            while reader.read_until(0, &mut bytes).is_ok_and(|count| count > 0) {
                bytes.pop();
                if serde_json::from_slice(&bytes).map_or(true, |message| sender.send(message).is_err()) {
                    break;
                }
                bytes.clear();
            }
        });
        Some(Self { process, commands, messages, told: Vec::new(), count: 0, _folder: folder })
    }

    /// The answer to a command.
    fn ask(&mut self, session: Option<&str>, method: &str, params: Value) -> Value {
        self.count += 1;
        let id = self.count;
        let mut message = json!({ "id": id, "method": method, "params": params });
        if let Some(session) = session {
            message["sessionId"] = json!(session);
        }
        self.commands.write_all(format!("{message}\0").as_bytes()).unwrap();
        loop {
            let answer = self.messages.recv_timeout(PATIENCE).unwrap_or_else(|error| panic!("{method}: {error}"));
            if answer["id"] == id {
                assert!(answer.get("error").is_none(), "{method}: {answer}");
                return answer["result"].clone();
            }
            self.told.push(answer);
        }
    }

    /// Opens a file in a new tab and listens to its console and its requests.
    pub fn open(&mut self, page: &Path) -> Tab<'_> {
        let target = self.ask(None, "Target.createTarget", json!({ "url": "about:blank" }));
        let target = target["targetId"].as_str().unwrap().to_owned();
        let session = self.ask(None, "Target.attachToTarget", json!({ "targetId": target, "flatten": true }));
        let session = session["sessionId"].as_str().unwrap().to_owned();
        self.told.clear();
        for domain in ["Page", "Runtime", "Log", "Network"] {
            self.ask(Some(&session), &format!("{domain}.enable"), json!({}));
        }
        let url = format!("file://{}", page.display());
        self.ask(Some(&session), "Page.navigate", json!({ "url": url }));
        Tab { browser: self, session, target }
    }
}

impl Drop for Browser {
    fn drop(&mut self) {
        let _ = self.process.kill();
        let _ = self.process.wait();
    }
}

impl Tab<'_> {
    fn ask(&mut self, method: &str, params: Value) -> Value {
        let session = self.session.clone();
        self.browser.ask(Some(&session), method, params)
    }

    /// The value of an expression in the page.
    pub fn evaluate(&mut self, expression: &str) -> Value {
        let params = json!({ "expression": expression, "returnByValue": true, "awaitPromise": true });
        let answer = self.ask("Runtime.evaluate", params);
        assert!(answer.get("exceptionDetails").is_none(), "{expression}: {answer}");
        answer["result"]["value"].clone()
    }

    /// Waits until an expression is true.
    pub fn until(&mut self, expression: &str) {
        let begun = Instant::now();
        while self.evaluate(expression) != true {
            assert!(begun.elapsed() < PATIENCE, "never true: {expression}");
            std::thread::sleep(Duration::from_millis(50));
        }
    }

    /// Waits until what was asked for is drawn.
    pub fn frame(&mut self) {
        self.evaluate("new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => done(true))))");
    }

    /// Errors and warnings of the console, exceptions, and requests for anything but the file and
    /// pictures that the page makes itself.
    pub fn complaints(&mut self) -> Vec<String> {
        let complaint = |message: &Value| {
            let params = &message["params"];
            match message["method"].as_str()? {
                "Runtime.exceptionThrown" | "Log.entryAdded" => Some(params.to_string()),
                "Runtime.consoleAPICalled" if params["type"] != "log" => Some(params.to_string()),
                "Network.requestWillBeSent" => {
                    let url = params["request"]["url"].as_str()?;
                    (!["file:", "data:", "blob:"].iter().any(|kind| url.starts_with(kind))).then(|| url.to_owned())
                }
                _ => None,
            }
        };
        self.browser.told.iter().filter_map(complaint).collect()
    }

    /// Left, top, width and height of the first element that matches, in the window.
    pub fn place(&mut self, selector: &str) -> [f64; 4] {
        let script = format!(
            "(() => {{ const r = document.querySelector({}).getBoundingClientRect(); return \
             [r.left, r.top, r.width, r.height]; }})()",
            json!(selector)
        );
        let place = self.evaluate(&script);
        [0, 1, 2, 3].map(|i| place[i].as_f64().unwrap())
    }

    fn mouse(&mut self, kind: &str, (x, y): (f64, f64), pressed: bool) {
        let button = if kind == "mouseMoved" && !pressed { "none" } else { "left" };
        let params = json!({
            "type": kind, "x": x, "y": y,
            "button": button, "buttons": u8::from(pressed), "clickCount": u8::from(kind != "mouseMoved"),
        });
        self.ask("Input.dispatchMouseEvent", params);
    }

    /// Moves the pointer there.
    pub fn hover(&mut self, x: f64, y: f64) {
        self.mouse("mouseMoved", (x, y), false);
    }

    pub fn click(&mut self, x: f64, y: f64) {
        self.drag((x, y), (x, y));
    }

    /// Presses at one place and releases at another.
    pub fn drag(&mut self, from: (f64, f64), to: (f64, f64)) {
        self.mouse("mouseMoved", from, false);
        self.mouse("mousePressed", from, true);
        for share in [0.5, 1.0] {
            self.mouse("mouseMoved", (from.0 + share * (to.0 - from.0), from.1 + share * (to.1 - from.1)), true);
        }
        self.mouse("mouseReleased", to, false);
    }

    /// Presses a key while nothing has the focus.
    pub fn key(&mut self, key: &str) {
        self.evaluate("document.activeElement && document.activeElement.blur()");
        for kind in ["keyDown", "keyUp"] {
            self.ask("Input.dispatchKeyEvent", json!({ "type": kind, "key": key }));
        }
    }

    /// Clicks the button with that text.
    pub fn press_button(&mut self, text: &str) {
        let script = format!(
            "[...document.querySelectorAll('button')].find((b) => b.textContent.trim() === {}).click()",
            json!(text)
        );
        self.evaluate(&script);
    }

    /// Makes the window this wide, CSS pixels.
    pub fn width(&mut self, width: u32) {
        let params = json!({ "width": width, "height": 844, "deviceScaleFactor": 2, "mobile": true });
        self.ask("Emulation.setDeviceMetricsOverride", params);
    }

    /// Prints the page and gives the bytes of the PDF.
    pub fn pdf(&mut self) -> usize {
        let printed = self.ask("Page.printToPDF", json!({ "printBackground": true, "preferCSSPageSize": true }));
        // Four digits of base64 are three bytes.
        printed["data"].as_str().unwrap().len() / 4 * 3
    }

    pub fn close(self) {
        let target = self.target.clone();
        self.browser.ask(None, "Target.closeTarget", json!({ "targetId": target }));
    }
}
