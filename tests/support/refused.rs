//! Case files that must be refused, each at its place.

use signorini::case::Case;

/// What is wrong; the text of the right case that is replaced, and its replacement; line:column of
/// the error; what the message must contain.
pub type Wrong = (&'static str, &'static str, &'static str, &'static str, &'static [&'static str]);

/// The wrong texts that are not rejected at the expected place and with the expected words.
pub fn not_refused(right: &str, all: &[Wrong]) -> String {
    let mut failures = String::new();
    for (what, old, new, place, words) in all {
        assert!(right.contains(old), "{what}: nothing to replace");
        let text = right.replacen(old, new, 1);
        let said = match Case::parse(&text, "wrong.toml", "") {
            Ok(_) => "ACCEPTED".to_owned(),
            Err(error) => error.to_string(),
        };
        let at = format!("--> wrong.toml:{place}\n");
        let fits = said.starts_with("error: ")
            && said.contains(&at)
            && said.contains("expected")
            && words.iter().all(|w| said.contains(w))
            && said.is_ascii();
        if !fits {
            failures += &format!("{what}: wanted {place} and {words:?}\n{said}\n\n");
        }
    }
    failures
}
