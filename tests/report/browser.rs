//! The report in a real browser: opens without errors or requests, and does what its controls say.
//!
//! Driven over Chromium's own protocol through two pipes: no driver, no npm, no port. Where no
//! Chromium is installed the test says so and passes; `SIGNORINI_BROWSER` names another one.
use crate::chromium::{Browser, Tab};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// A tube between four bars.
const TWO_PLANES: &str = r#"
[system]
planes = 2
modes = 4
[system.beam]
length = 3.0
youngs_modulus = 200e9
density = 7850.0
outer_diameter = 19e-3
inner_diameter = 15.7e-3
elements = 20
left = "pinned"
right = "pinned"
[system.damping]
ratio = 0.01
[[support]]
name = "bars"
at = { position = 1.0 }
shape = "flats"
sides = 4
gap = 0.2e-3
restitution = 0.5
[[load]]
at = { position = 0.5 }
direction = 30
harmonic = { amplitude = 10.0, frequency = 25.0 }
[[probe]]
name = "across"
at = { position = 1.0 }
direction = 0
[[probe]]
name = "up"
at = { position = 1.0 }
direction = 90
[time]
end = 0.5
step = 5e-5
sample = 1e-3
"#;

pub fn results(folder: &Path, args: &[&str]) -> PathBuf {
    let out = folder.join(args.join("-").replace(['/', ' '], "_"));
    let mut command = Command::new(env!("CARGO_BIN_EXE_signorini"));
    let run = command.args(args).arg("--out").arg(&out).current_dir(folder).output().unwrap();
    assert!(run.status.success(), "{args:?}: {}", String::from_utf8_lossy(&run.stderr));
    out.join("report.html")
}

/// Opens the page and expects that it drew itself without an error or a request to anywhere.
pub fn opened<'a>(browser: &'a mut Browser, page: &Path) -> Tab<'a> {
    let mut tab = browser.open(page);
    tab.until("document.documentElement?.dataset.ready !== undefined");
    assert_eq!(tab.evaluate("document.documentElement.dataset.errors"), "0", "{}", page.display());
    let drawn = tab.evaluate("Number(document.documentElement.dataset.drawings)").as_f64().unwrap();
    assert!(drawn > 0.0);
    assert_eq!(tab.complaints(), Vec::<String>::new(), "{}", page.display());
    tab
}

#[test]
fn pages_open_and_their_controls_work_in_a_browser() {
    let Some(mut browser) = Browser::start() else {
        eprintln!("skipped: no chromium is installed (apt-get install chromium, or SIGNORINI_BROWSER=PATH)");
        return;
    };
    let dir = tempfile::tempdir().unwrap();
    let run = results(dir.path(), &["run", "rigid-walls-sine", "--end", "3", "--no-verdict"]);
    let mut tab = opened(&mut browser, &run);

    // A click in a plot sets the instant, and the clock says it.
    tab.evaluate("document.querySelector('#motion .plot canvas + canvas').scrollIntoView({ block: 'center' })");
    let [x, y, w, h] = tab.place("#motion .plot canvas + canvas");
    tab.click(x + 0.5 * w, y + 0.5 * h);
    let clock = tab.evaluate("document.querySelector('.clock').textContent");
    let middle: f64 = clock.as_str().unwrap()[4..].split(' ').next().unwrap().parse().unwrap();
    // The plot spans 3 s between its margins of 66 and 14 pixels.
    assert!((middle - 3.0 * (0.5 * w - 66.0) / (w - 80.0)).abs() < 0.02, "{middle}");

    // A drag zooms every panel: the picture changes; a double click shows all again.
    let picture = "document.querySelector('#motion .plot canvas').toDataURL()";
    let whole = tab.evaluate(picture);
    tab.drag((x + 0.3 * w, y + 0.5 * h), (x + 0.5 * w, y + 0.5 * h));
    tab.frame();
    let zoomed = tab.evaluate(picture);
    assert_ne!(zoomed, whole);
    tab.press_button("Whole run");
    tab.frame();
    assert_eq!(tab.evaluate(picture), whole);

    // Sorting: the largest impulse first, and its histogram drawn.
    tab.evaluate(
        "[...document.querySelectorAll('#contacts th')].find((th) => th.textContent.startsWith('impulse')).click()",
    );
    let sorted = "[...document.querySelectorAll('#contacts tbody tr:not(.space)')].slice(0, 5).map((tr) => \
        Math.abs(Number(tr.children[2].textContent.replace('−', '-')))).every((x, i, \
        all) => !i || all[i - 1] >= x)";
    assert_eq!(tab.evaluate(sorted), true);
    // A row leads to its contact.
    tab.evaluate("document.querySelector('#contacts tbody tr:not(.space)').click()");
    let shown = "Math.abs(Number(document.querySelector('.clock').textContent.slice(4).split(' ')[0]) - \
        Number(document.querySelector('#contacts tbody tr:not(.space)').children[1].textContent)) < 1e-4";
    tab.until(shown);

    // The keyboard: from contact to contact, and play.
    let before = tab.evaluate("document.querySelector('.clock').textContent");
    tab.key("ArrowRight");
    tab.frame();
    assert_ne!(tab.evaluate("document.querySelector('.clock').textContent"), before);
    tab.key(" ");
    let playing = tab.evaluate("document.querySelector('.clock').textContent");
    tab.until(&format!("document.querySelector('.clock').textContent !== {playing}"));
    tab.key(" ");

    // The Poincaré section, light and dark.
    tab.press_button("Poincaré section");
    let ground = "getComputedStyle(document.documentElement).backgroundColor";
    let light = tab.evaluate(ground);
    tab.press_button("◐");
    assert_ne!(tab.evaluate(ground), light);
    tab.press_button("◐");

    // On paper every drawing is a picture.
    let pdf = tab.pdf();
    assert!(pdf > 30_000, "{pdf} bytes: the drawings are missing");
    assert_eq!(tab.evaluate("document.documentElement.dataset.errors"), "0");
    assert_eq!(tab.complaints(), Vec::<String>::new());
    tab.close();

    // Other kinds of pages, and a phone's width: nothing stands out to the right.
    fs::write(dir.path().join("bars.toml"), TWO_PLANES).unwrap();
    let pages = [
        results(dir.path(), &["run", "tube-loose-supports", "--end", "0.2", "--no-verdict"]),
        results(dir.path(), &["run", "chain-20", "--end", "0.5", "--no-verdict"]),
        results(dir.path(), &["compare", "rigid-walls-sine", "--end", "1", "--no-verdict"]),
        results(
            dir.path(),
            &["sweep", "rigid-walls-sine", "--vary", "load.1.harmonic.frequency=4:5:5", "--measure", "contacts"],
        ),
        results(dir.path(), &["run", "bars.toml", "--no-verdict"]),
        results(dir.path(), &["run", "tube-round-supports", "--end", "0.3", "--no-verdict"]),
        results(
            dir.path(),
            &["wear", "tube-in-cross-flow", "--end", "0.3", "--until-interval", "99%", "--years", "20"],
        ),
    ];
    for page in pages.iter().chain([&run]) {
        let mut tab = opened(&mut browser, page);
        tab.width(390);
        tab.frame();
        let wider = tab.evaluate("document.documentElement.scrollWidth - innerWidth").as_f64().unwrap();
        assert!(wider <= 0.0, "{}: {wider} pixels wider than a phone", page.display());
        tab.close();
    }

    // Round supports: the orbit in each, a table of all, and contacts that name them.
    let mut tab = opened(&mut browser, &pages[5]);
    let shown = "[document.querySelectorAll('#supports .plot').length, \
        document.querySelectorAll('#supports tbody tr:not(.space)').length, \
        document.querySelector('#contacts tbody tr:not(.space) td').textContent].join(' ')";
    let shown = tab.evaluate(shown);
    assert!(shown.as_str().unwrap().starts_with("2 2 plate-"), "{shown}");
    // Where along the tube they wear: a bar at the place of each.
    let bars = tab.evaluate("document.querySelector('#where canvas').getAttribute('aria-label')");
    let bars = bars.as_str().unwrap();
    assert!(bars.starts_with("Work rate (W) at each support: plate-1 at 1 m: "), "{bars}");
    assert!(bars.contains("; plate-2 at 2 m: "), "{bars}");
    // The drawing of both planes moves from contact to contact.
    let drawing = "document.querySelector('.drawing canvas').toDataURL()";
    let still = tab.evaluate(drawing);
    tab.key("ArrowRight");
    tab.frame();
    assert_ne!(tab.evaluate(drawing), still);
    tab.close();

    // Wear over the years: a plot for each unit, and a row for each time; the means of the first
    // runs, seven at each of two supports, and three that need not converge.
    let mut tab = opened(&mut browser, &pages[6]);
    let shown = "[document.querySelectorAll('#wear .plot').length, \
        document.querySelectorAll('#years tbody tr:not(.space)').length > 1, \
        document.querySelectorAll('#means tbody tr:not(.space)').length, \
        document.querySelector('#wear li').textContent].join(' ')";
    let shown = tab.evaluate(shown);
    assert!(
        shown.as_str().unwrap().starts_with("2 true 20 The tube reaches the limit of 0.66 mm at support"),
        "{shown}"
    );
    tab.close();

    // A click on a row of a sweep gives the command that keeps its run where the page looks for it.
    let mut tab = opened(&mut browser, &pages[3]);
    tab.evaluate("document.querySelectorAll('#rows tbody tr:not(.space)')[2].click()");
    let command = tab.evaluate("document.querySelector('#sweep pre.command').textContent");
    assert!(command.as_str().unwrap().contains("--out rows/2\n"), "{command}");
    tab.close();

    // Methods are switched on and off.
    let mut tab = opened(&mut browser, &pages[2]);
    let picture = "document.querySelector('#motion .plot canvas').toDataURL()";
    let all = tab.evaluate(picture);
    tab.evaluate(
        "document.querySelector('#motion .chip[aria-pressed=true]:nth-child(2), #motion \
        .chip[aria-pressed=true]').click()",
    );
    tab.frame();
    assert_ne!(tab.evaluate(picture), all);
    tab.close();

    injected(&mut browser, dir.path(), &run);
}

/// Branches of orbits: hover, zoom, click, and the command of the orbit that was clicked gives it.
#[test]
fn branches_show_the_orbit_that_is_clicked() {
    let Some(mut browser) = Browser::start() else { return };
    let dir = tempfile::tempdir().unwrap();
    let soft = ["rigid-walls-sine", "--set", "wall.*.restitution=0.8"];
    let key = ["--key", "load.1.harmonic.frequency", "--range", "3.6:6"];
    let page = results(dir.path(), &[&["continue"], &soft[..], &key].concat());
    let mut tab = opened(&mut browser, &page);
    let picture = "document.querySelector('#branches .plot canvas').toDataURL()";
    let text = |selector: &str| format!("document.querySelector('{selector}').textContent");

    // The end of a branch: its symmetry breaks at 4.57083913378074 Hz.
    let rows = "[...document.querySelectorAll('#specials tbody tr:not(.space)')]";
    tab.evaluate(&format!("{rows}.find((tr) => tr.textContent.includes('symmetry-breaking')).click()"));
    let facts = tab.evaluate(&text("#orbit .facts"));
    assert!(facts.as_str().unwrap().contains("4.5708391"), "{facts}");
    // An orbit from the table; its motion is drawn, and the plot of the branches marks it.
    tab.evaluate("document.querySelector('#branches .plot canvas + canvas').scrollIntoView({ block: 'center' })");
    tab.frame();
    let over = "document.querySelector('#branches .plot canvas + canvas').toDataURL()";
    let (before, portrait) =
        (tab.evaluate(over), tab.evaluate("document.querySelector('#orbit .plot canvas').toDataURL()"));
    tab.evaluate("document.querySelectorAll('#orbits tbody tr:not(.space)')[7].click()");
    tab.frame();
    assert_ne!(tab.evaluate(over), before);
    assert_ne!(tab.evaluate("document.querySelector('#orbit .plot canvas').toDataURL()"), portrait);

    // The first view is about the special points, which are in a part of the range.
    let first = tab.evaluate(picture);
    tab.press_button("Whole range");
    tab.frame();
    assert_ne!(tab.evaluate(picture), first);

    // Hover tells the nearest orbit, a click chooses it: somewhere along the middle of the picture.
    let [x, y, w, h] = tab.place("#branches .plot canvas + canvas");
    let told =
        "(() => { const tip = document.querySelector('#branches .tip'); return tip.hidden ? '' : tip.textContent; })()";
    let mut found = String::new();
    for step in 0..60 {
        let place = (x + 0.75 * w, y + h * f64::from(step) / 60.0);
        tab.hover(place.0, place.1);
        found = tab.evaluate(told).as_str().unwrap().to_owned();
        if !found.is_empty() {
            tab.click(place.0, place.1);
            break;
        }
    }
    assert!(found.contains("branch ") && found.contains("Frequency (Hz)"), "{found}");
    let chosen = tab.evaluate(&text("#orbit .facts")).as_str().unwrap().to_owned();
    let frequency = found.split("(Hz): ").nth(1).unwrap().lines().next().unwrap().to_owned();
    assert!(chosen.contains(&frequency[..5]), "{found}: {chosen}");

    // The command beside it finds the same orbit.
    let command = tab.evaluate(&text("#orbit pre")).as_str().unwrap().to_owned();
    let tool = command.replacen("signorini", env!("CARGO_BIN_EXE_signorini"), 1);
    let run = Command::new("sh").args(["-c", &tool]).current_dir(dir.path()).output().unwrap();
    assert!(run.status.success(), "{command}: {}", String::from_utf8_lossy(&run.stderr));
    let out = command.split("--out ").nth(1).unwrap();
    let orbit: serde_json::Value =
        serde_json::from_str(&fs::read_to_string(dir.path().join(out).join("orbit.json")).unwrap()).unwrap();
    let modulus =
        orbit["multipliers"][0].as_array().unwrap().iter().map(|x| x.as_f64().unwrap().powi(2)).sum::<f64>().sqrt();
    let shown = chosen.rsplit("largest |multiplier|").next().unwrap().parse::<f64>().unwrap();
    // The page shows six digits.
    assert!((modulus - shown).abs() <= 1e-5 * shown, "{modulus} {shown}");

    // Another measure, a zoom and back, the keyboard, the dark theme, a phone, paper.
    let whole = tab.evaluate(picture);
    tab.evaluate(
        "(() => { const list = document.querySelector('#branches select'); list.value = \
        'multiplier'; list.dispatchEvent(new Event('change')); })()",
    );
    tab.frame();
    assert_ne!(tab.evaluate(picture), whole);
    tab.evaluate(
        "(() => { const list = document.querySelector('#branches select'); list.value = \
        'speed'; list.dispatchEvent(new Event('change')); })()",
    );
    tab.drag((x + 0.3 * w, y + 0.5 * h), (x + 0.5 * w, y + 0.5 * h));
    tab.frame();
    assert_ne!(tab.evaluate(picture), whole);
    tab.press_button("Whole range");
    tab.frame();
    assert_eq!(tab.evaluate(picture), whole);
    let slider = "document.querySelector('#orbit input[type=range]')";
    tab.evaluate(&format!("{slider}.value = 3; {slider}.dispatchEvent(new Event('input'))"));
    assert_ne!(tab.evaluate(&text("#orbit .facts")).as_str().unwrap(), chosen);
    tab.evaluate(
        "[...document.querySelectorAll('#orbits th')].find((th) => th.textContent.startsWith('Displacement')).click()",
    );
    assert_eq!(tab.evaluate("document.querySelectorAll('#orbits th[aria-sort]').length"), 1);
    tab.press_button("◐");
    assert!(tab.pdf() > 30_000);
    tab.width(390);
    tab.frame();
    assert_eq!(tab.evaluate("Math.max(0, document.documentElement.scrollWidth - innerWidth)"), 0);
    assert_eq!(tab.evaluate("document.documentElement.dataset.errors"), "0");
    assert_eq!(tab.complaints(), Vec::<String>::new());
    tab.close();

    // One orbit, with its contacts; and one that no body can follow.
    let page = results(dir.path(), &[&["orbit"], &soft[..]].concat());
    let mut tab = opened(&mut browser, &page);
    assert_eq!(tab.evaluate("document.querySelectorAll('.hero .plot').length"), 1);
    assert_eq!(tab.evaluate("document.querySelectorAll('.cards .card.good').length"), 3);
    tab.evaluate("document.querySelector('#motion .plot canvas + canvas').scrollIntoView({ block: 'center' })");
    let [x, y, w, h] = tab.place("#motion .plot canvas + canvas");
    tab.hover(x + 0.5 * w, y + 0.5 * h);
    assert!(tab.evaluate(&text("#motion .tip")).as_str().unwrap().contains("velocity"));
    tab.evaluate(
        "[...document.querySelectorAll('#contacts th')].find((th) => th.textContent.startsWith('impulse')).click()",
    );
    let impulses =
        "[...document.querySelectorAll('#contacts tbody tr:not(.space)')].map((tr) => tr.children[4].textContent)";
    // ∓ m (1 + e) v.
    assert_eq!(tab.evaluate(impulses), serde_json::json!(["0.304939", "−0.304939"]));
    tab.width(390);
    tab.frame();
    assert_eq!(tab.evaluate("Math.max(0, document.documentElement.scrollWidth - innerWidth)"), 0);
    assert!(tab.pdf() > 20_000);
    assert_eq!(tab.complaints(), Vec::<String>::new());
    tab.close();
}

/// An orbit through a wall is told as such, and has nothing that could be drawn but its
/// multipliers.
#[test]
fn an_orbit_that_no_body_can_follow_has_a_page_that_says_so() {
    let Some(mut browser) = Browser::start() else { return };
    let dir = tempfile::tempdir().unwrap();
    let tool = |args: &[&str]| {
        Command::new(env!("CARGO_BIN_EXE_signorini")).args(args).current_dir(dir.path()).output().unwrap()
    };
    let soft = ["orbit", "rigid-walls-sine", "--set", "wall.*.restitution=0.8"];
    let listed: serde_json::Value =
        serde_json::from_slice(&tool(&[&soft[..], &["--json", "--list"]].concat()).stdout).unwrap();
    let through = listed["orbits"].as_array().unwrap().iter().find(|orbit| orbit["admissible"] == false).unwrap();
    let start = format!("{},{}", through["phase_cycles"], through["speed_m_per_s"]);
    let (wall, periods) = (through["wall"].as_str().unwrap(), through["periods"].to_string());
    let mut args = [&soft[..], &["--signature", wall, "--start", &start, "--periods", &periods, "--out", "o"]].concat();
    if through["symmetric"] == true {
        args.push("--symmetric");
    }
    assert_eq!(tool(&args).status.code(), Some(1));
    let mut tab = opened(&mut browser, &dir.path().join("o/report.html"));
    let bad = tab.evaluate("document.querySelector('.card.bad .verdict').textContent");
    assert_eq!(bad, "✗ No body can follow it");
    assert_eq!(tab.evaluate("document.querySelectorAll('#motion, #contacts, #walls, .card.good').length"), 0);
    assert_eq!(tab.evaluate("document.querySelectorAll('.hero .plot').length"), 1);
    tab.close();
}

/// Basins: the legend has the shares, the pointer tells the attractor, a click the command.
#[test]
fn basins_tell_the_attractor_of_each_start() {
    let Some(mut browser) = Browser::start() else { return };
    let dir = tempfile::tempdir().unwrap();
    let vary = ["--vary", "initial.displacement=-4e-3:4e-3:10", "--vary", "initial.velocity=-0.3:0.3:12"];
    let set = ["--set", "wall.*.restitution=0.8", "--set", "load.1.harmonic.frequency=3.9"];
    let more = ["--measure", "attractor,period", "--settle", "400", "--keep", "60", "--scheme", "event"];
    let page = results(dir.path(), &[&["sweep", "rigid-walls-sine"], &vary[..], &set[..], &more[..]].concat());
    let table = fs::read_to_string(page.with_file_name("attractors.csv")).unwrap();
    let first: Vec<&str> = table.lines().nth(1).unwrap().split(',').collect();
    let share = 100.0 * first[2].parse::<f64>().unwrap();
    assert!(table.lines().count() >= 3 && share > 1.0 && share < 99.0, "{table}");
    let mut tab = opened(&mut browser, &page);
    let legend = tab.evaluate("document.querySelector('#sweep .key').textContent");
    let shown: f64 = legend.as_str().unwrap()[3..].split(' ').next().unwrap().parse().unwrap();
    // The legend has three digits.
    assert!((shown - share).abs() <= 5e-3 * share, "{legend} {share}");
    // The start at the lower left is the first row of the table, and the attractor of the first row
    // is the first.
    let [x, y, _, h] = tab.place("#sweep .plot canvas + canvas");
    tab.hover(x + 76.0, y + h - 50.0);
    let told = tab.evaluate("document.querySelector('#sweep .tip').textContent");
    assert!(told.as_str().unwrap().contains("leads to attractor 1: "), "{told}");
    assert!(told.as_str().unwrap().contains("Displacement (m): −0.004\nVelocity (m/s): −0.3\n"), "{told}");
    tab.click(x + 76.0, y + h - 50.0);
    let command = tab.evaluate("document.querySelector('#sweep pre').textContent").as_str().unwrap().to_owned();
    let words = "signorini run rigid-walls-sine.toml --set initial.displacement=-0.004 --set \
        initial.velocity=-0.3 --scheme event --settle 400 --keep 60";
    assert!(command.lines().any(|line| line == format!("{words} --out rows/0")), "{command}");
    // With the case of the page the command runs.
    let case = tab.evaluate("document.querySelector('#text details pre').textContent").as_str().unwrap().to_owned();
    assert!(case.contains("restitution = 0.8") && case.contains("frequency = 3.9"), "{case}");
    assert_eq!(
        tab.evaluate("document.querySelectorAll('#attractors tbody tr:not(.space)').length"),
        table.lines().count() - 1
    );
    tab.press_button("◐");
    tab.width(390);
    tab.frame();
    assert_eq!(tab.evaluate("Math.max(0, document.documentElement.scrollWidth - innerWidth)"), 0);
    assert!(tab.pdf() > 10_000);
    assert_eq!(tab.evaluate("document.documentElement.dataset.errors"), "0");
    assert_eq!(tab.complaints(), Vec::<String>::new());
    tab.close();
}

/// A title of markup is text, and a script put into the file afterwards is not run.
fn injected(browser: &mut Browser, dir: &Path, page: &Path) {
    let html = fs::read_to_string(page).unwrap();
    let evil = r#""title":"\u003c/script\u003e\u003cimg src=x onerror=document.evil=1\u003e""#;
    let titled = html.replacen(r#""title":"Two rigid walls, 5 Hz sine""#, evil, 1);
    assert_ne!(titled, html);
    let path = dir.join("titled.html");
    fs::write(&path, titled).unwrap();
    let mut tab = opened(browser, &path);
    assert_eq!(tab.evaluate("document.querySelector('h1').textContent.startsWith('</script><img')"), true);
    assert_eq!(tab.evaluate("document.querySelectorAll('h1 *, img:not(.print)').length"), 0);
    assert_eq!(tab.evaluate("document.evil === undefined"), true);
    tab.close();

    let path = dir.join("pasted.html");
    let pasted = "<body><script>document.evil = 1</script><img src=x onerror='document.evil = 2'>";
    fs::write(&path, html.replacen("<body>", pasted, 1)).unwrap();
    let mut tab = browser.open(&path);
    tab.until("document.documentElement?.dataset.ready !== undefined");
    assert_eq!(tab.evaluate("document.evil === undefined"), true);
    tab.close();
}
