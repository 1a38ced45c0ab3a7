//! The notes of a comparison's runs, each listed once.

use crate::study::compare::Comparison;

/// Every note of the rows, with the methods to which it applies.
pub(super) fn run_notes(comparison: &Comparison) -> Vec<String> {
    let runs =
        comparison.rows.iter().filter_map(|row| Some((row.method.to_string(), &row.outcome.as_ref().ok()?.notes)));
    let mut notes: Vec<(&str, Vec<String>)> = Vec::new();
    let mut count = 0;
    for (method, of_run) in runs {
        count += 1;
        for note in of_run {
            match notes.iter_mut().find(|(text, _)| text == note) {
                Some((_, methods)) => methods.push(method.clone()),
                None => notes.push((note, vec![method.clone()])),
            }
        }
    }
    let said = |(note, methods): (&str, Vec<String>)| {
        if methods.len() == count { note.to_owned() } else { format!("{}: {note}", methods.join(", ")) }
    };
    notes.into_iter().map(said).collect()
}
