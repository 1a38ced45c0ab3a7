//! The HTML file: a frame with style, data and script, none of which loads anything.
//!
//! Text of a case never becomes markup: the data stand in a script element of a type that browsers
//! do not run, with `<`, `>` and `&` escaped, and the page writes text with `textContent` only. A
//! Content-Security-Policy allows the one style and the one script whose SHA-256 it names, and no
//! connection: a script put into the file by others is not run.

use super::column::base64;
use crate::error::{Error, Result, escaped};
use crate::output::request::program;
use serde_json::Value;
use sha2::{Digest, Sha256};

/// The name of the report within a folder of results.
pub const FILE: &str = "report.html";

const FRAME: &str = include_str!("page/page.html");
const STYLE: &str = include_str!("page/page.css");

/// The script in the order in which it runs; one strict scope, so the parts share their names.
const SCRIPT: [&str; 50] = [
    include_str!("page/js/base.js"),
    include_str!("page/js/look.js"),
    include_str!("page/js/axes.js"),
    include_str!("page/js/plot.js"),
    include_str!("page/js/curves.js"),
    include_str!("page/js/marks.js"),
    include_str!("page/js/pointer.js"),
    include_str!("page/js/motion.js"),
    include_str!("page/js/controls.js"),
    include_str!("page/js/table.js"),
    include_str!("page/js/stage.js"),
    include_str!("page/js/body.js"),
    include_str!("page/js/stations.js"),
    include_str!("page/js/structure.js"),
    include_str!("page/js/outlines.js"),
    include_str!("page/js/planes.js"),
    include_str!("page/js/bodies.js"),
    include_str!("page/js/panels.js"),
    include_str!("page/js/phase.js"),
    include_str!("page/js/sectors.js"),
    include_str!("page/js/supports.js"),
    include_str!("page/js/where.js"),
    include_str!("page/js/contacts.js"),
    include_str!("page/js/derivatives.js"),
    include_str!("page/js/compare.js"),
    include_str!("page/js/endnames.js"),
    include_str!("page/js/cheapest.js"),
    include_str!("page/js/chart.js"),
    include_str!("page/js/map.js"),
    include_str!("page/js/stability.js"),
    include_str!("page/js/basin.js"),
    include_str!("page/js/intervals.js"),
    include_str!("page/js/effects.js"),
    include_str!("page/js/shares.js"),
    include_str!("page/js/measures.js"),
    include_str!("page/js/swept.js"),
    include_str!("page/js/sweep.js"),
    include_str!("page/js/wear.js"),
    include_str!("page/js/margins.js"),
    include_str!("page/js/flow.js"),
    include_str!("page/js/means.js"),
    include_str!("page/js/realisations.js"),
    include_str!("page/js/orbit.js"),
    include_str!("page/js/periodic.js"),
    include_str!("page/js/chosen.js"),
    include_str!("page/js/branches.js"),
    include_str!("page/js/diagram.js"),
    include_str!("page/js/continuation.js"),
    include_str!("page/js/definitions.js"),
    include_str!("page/js/page.js"),
];

/// The page of that title with these data.
pub(super) fn file(title: &str, data: &Value) -> Result<String> {
    let failed = |error: serde_json::Error| Error::io("the report", error.to_string(), false).caused_by(error);
    let data = in_script(&serde_json::to_string(data).map_err(failed)?);
    let script = format!("\"use strict\";\n(() => {{\n{}}})();\n", SCRIPT.concat());
    let marks = [
        ("%STYLE_HASH%", hash(STYLE)),
        ("%SCRIPT_HASH%", hash(&script)),
        ("%PROGRAM%", program()),
        ("%TITLE%", in_text(&escaped(title))),
        ("%STYLE%", STYLE.to_owned()),
        ("%DATA%", data),
        ("%SCRIPT%", script),
    ];
    // From mark to mark through the frame: what is put in is not searched again.
    let mut out = String::with_capacity(FRAME.len() + marks.iter().map(|mark| mark.1.len()).sum::<usize>());
    let mut rest = FRAME;
    for (mark, text) in &marks {
        let (before, after) = rest.split_once(mark).unwrap_or((rest, ""));
        out.push_str(before);
        out.push_str(text);
        rest = after;
    }
    out.push_str(rest);
    Ok(out)
}

/// The name of a text in a Content-Security-Policy: its hash.
pub(super) fn hash(text: &str) -> String {
    format!("sha256-{}", base64(&Sha256::digest(text.as_bytes())))
}

/// JSON that can stand in a script element: nothing in it ends the element or begins a comment.
fn in_script(json: &str) -> String {
    let mut out = String::with_capacity(json.len() + json.len() / 64);
    for c in json.chars() {
        match c {
            '<' | '>' | '&' | '\u{2028}' | '\u{2029}' => out.push_str(&format!("\\u{:04x}", u32::from(c))),
            c => out.push(c),
        }
    }
    out
}

/// Text between tags.
pub(super) fn in_text(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}

#[cfg(test)]
mod tests {
    use super::{FRAME, file, in_script};
    use serde_json::{Value, json};

    #[test]
    fn every_mark_of_the_frame_is_filled_in_its_order() {
        let page = file("a %STYLE% title", &json!({ "x": "%SCRIPT%" })).unwrap();
        assert!(page.contains("<title>a %STYLE% title</title>") && page.contains(r#"{"x":"%SCRIPT%"}"#));
        assert!(FRAME.matches('%').count().is_multiple_of(2));
        assert!(page.ends_with("</html>\n") && !page.contains("%DATA%"), "a mark out of order");
    }

    #[test]
    fn escaped_json_is_the_same_json() {
        let value = json!({ "a": "</script><!-- & \u{2028} \u{2029} \\ \" <" });
        let text = in_script(&value.to_string());
        assert!(!text.contains(['<', '>', '&', '\u{2028}']));
        assert_eq!(serde_json::from_str::<Value>(&text).unwrap(), value);
    }
}
