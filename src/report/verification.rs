//! `verification.html`: the verification manual as a page to file with a report. It has no script.

use super::html::{hash, in_text};
use crate::output::request::program;
use crate::output::verification::conclusion;
use crate::verification::Verified;
use std::fmt::Write;

/// The file's name.
pub(crate) const FILE: &str = "verification.html";

const STYLE: &str = "body{font:15px/1.45 system-ui,sans-serif;margin:2em auto;max-width:1240px;padding:0 1em;\
    color:#16181b;background:#fff}h1{font-size:26px;margin:0}p{color:#5c6168;max-width:92ch}\
    p.answer{font-size:17px;font-weight:600;color:#16181b}table{border-collapse:collapse;font-size:13px;width:100%}\
    th,td{border-bottom:1px solid #e2e2de;padding:4px 8px;text-align:left;vertical-align:top}\
    th{border-bottom:2px solid #16181b}td.number{text-align:right;white-space:nowrap}\
    td.holds{color:#00614a;font-weight:600}td.fails{color:#a3123a;font-weight:700}\
    div{overflow-x:auto}\
    @media screen and (max-width:700px){table,tbody{display:block}thead{display:none}\
    tr{display:grid;grid-template-columns:5fr 4fr;gap:0 10px;padding:8px 0;border-bottom:1px solid #e2e2de}\
    td{border:0;padding:0}td.number{text-align:left;white-space:normal}td.all{grid-column:1/-1}\
    td[data-name]::before{content:attr(data-name) \" \";color:#5c6168}td.holds,td.fails{order:-1;text-align:right}\
    td.case{order:-2}}\
    @media screen and (prefers-color-scheme:dark){body{color:#eceef0;background:#15171a}\
    p{color:#a9afb6}p.answer{color:#eceef0}\
    th,td,tr{border-color:#2e3338}td[data-name]::before{color:#a9afb6}td.holds{color:#4cc9a4}td.fails{color:#ff8aa5}}\
    @media print{@page{margin:12mm}body{max-width:none;margin:0;padding:0;color:#000;background:#fff}\
    div{overflow:visible}table{font-size:8px}th,td{padding:2px 4px}td.number{white-space:normal}\
    tr{break-inside:avoid}}";

/// A number with ten digits; `verification.csv` has all of them.
fn number(x: f64) -> String {
    let rounded: f64 = format!("{x:.9e}").parse().unwrap_or(x);
    if rounded == 0.0 || (1e-4..1e6).contains(&rounded.abs()) { rounded.to_string() } else { format!("{rounded:e}") }
}

/// The text with a capital letter at its begin.
fn capital(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}

/// The page of these lines, made at that time (RFC 3339) on this machine.
#[must_use]
pub(crate) fn page(lines: &[Verified], made: &str) -> String {
    let mut rows = String::new();
    for line in lines {
        let (class, verdict) = if line.holds() { ("holds", "holds") } else { ("fails", "FAILS") };
        let scene = if line.changes.is_empty() { String::new() } else { format!(", {}", in_text(&line.changes)) };
        // Writing to a string cannot fail.
        let _ = writeln!(
            rows,
            "<tr><td class=\"case\">{}{scene}<br>{}</td><td class=\"all\">{}</td>\
             <td class=\"number\" data-name=\"expected\">{} {}</td><td class=\"number\" data-name=\"found\">{}</td>\
             <td class=\"number\" data-name=\"deviation\">{}</td>\
             <td class=\"number\" data-name=\"tolerance\">{:.0e}</td><td class=\"{class}\">{verdict}</td>\
             <td class=\"all\" data-name=\"tolerance:\">{}</td><td class=\"all\" data-name=\"source:\">{}</td></tr>",
            in_text(&line.case),
            in_text(&line.method),
            in_text(&line.quantity),
            number(line.expected),
            in_text(&line.unit),
            line.found.map_or_else(|| "none".to_owned(), number),
            line.deviation().map_or_else(|| "–".to_owned(), |deviation| format!("{deviation:.1e}")),
            line.tolerance,
            in_text(&line.reason),
            in_text(&line.source),
        );
    }
    format!(
        "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n\
         <meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src '{}'\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <title>Verification of signorini {version}</title>\n<style>{STYLE}</style></head>\n<body>\n\
         <h1>Verification of signorini {version}</h1>\n<p class=\"answer\">{}.</p>\n\
         <p>Made {} by {} on {}, {}.</p>\n\
         <p>Values that others published or that have a closed form, and what this program found on this machine. \
         None of the expected values was computed by it.</p>\n\
         <div><table><thead><tr><th>case and scheme</th><th>quantity</th><th>expected</th><th>found</th>\
         <th>deviation</th><th>tolerance</th><th></th><th>why this tolerance</th><th>source</th></tr></thead>\
         <tbody>\n{rows}</tbody></table></div>\n</body></html>\n",
        hash(STYLE),
        capital(&conclusion(lines)),
        in_text(&made.replace('T', " ").replace('Z', " UTC")),
        program(),
        std::env::consts::OS,
        std::env::consts::ARCH,
        version = env!("CARGO_PKG_VERSION"),
    )
}
