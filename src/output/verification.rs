//! The verification manual as a table for the terminal, as `verification.csv` and as Markdown.

use super::csv::{self, digits};
use super::table::Table;
use crate::error::{Error, Result};
use crate::verification::Verified;
use std::path::Path;

/// The table of all lines.
pub(crate) const TABLE: &str = "verification.csv";

/// The lines for the terminal.
#[must_use]
pub(crate) fn table(lines: &[Verified]) -> Table {
    let row = |line: &Verified| {
        let deviation = line.deviation().map_or_else(|| "none found".to_owned(), |x| format!("{x:.0e}"));
        let holds = if line.holds() { "holds" } else { "FAILS" };
        let expected = format!("{} {}", line.expected, line.unit);
        vec![named(line), line.quantity.clone(), expected, deviation, format!("{:.0e}", line.tolerance), holds.into()]
    };
    let header = ["case", "quantity", "expected", "deviation", "tolerance", ""];
    Table::new(&header, lines.iter().map(row).collect())
}

/// The name of a case with what was changed in it, and the scheme.
fn named(line: &Verified) -> String {
    let changes = if line.changes.is_empty() { String::new() } else { format!(", {}", line.changes) };
    format!("{}{changes}, {}", line.case, line.method)
}

/// What the manual shows, in one sentence.
#[must_use]
pub(crate) fn conclusion(lines: &[Verified]) -> String {
    let held = lines.iter().filter(|line| line.holds()).count();
    if held == lines.len() {
        format!("all {held} values are within their tolerances")
    } else {
        format!("{} of {} values are not within their tolerances", lines.len() - held, lines.len())
    }
}

/// The error of a manual that does not hold.
#[must_use]
pub(crate) fn shortfall(lines: &[Verified]) -> Option<Error> {
    let failing = |line: &&Verified| !line.holds();
    let values: Vec<String> =
        lines.iter().filter(failing).map(|line| format!("{}: {}", named(line), line.quantity)).collect();
    (!values.is_empty()).then_some(Error::Unverified { values })
}

/// Writes `verification.csv`.
pub(crate) fn write(path: &Path, lines: &[Verified]) -> Result<()> {
    let columns: [csv::Column<'_, &Verified>; 11] = [
        ("case", &|line| line.case.clone()),
        ("changes", &|line| line.changes.clone()),
        ("method", &|line| line.method.clone()),
        ("source", &|line| line.source.clone()),
        ("quantity", &|line| line.quantity.clone()),
        ("unit", &|line| line.unit.clone()),
        ("expected", &|line| digits(Some(line.expected))),
        ("found", &|line| digits(line.found)),
        ("tolerance", &|line| digits(Some(line.tolerance))),
        ("holds", &|line| line.holds().to_string()),
        ("reason", &|line| line.reason.clone()),
    ];
    csv::records(path, &columns, lines)
}

/// The manual without what was found, which is the same for every machine: `docs/verification.md`.
#[cfg(test)]
fn markdown(lines: &[Verified]) -> String {
    use std::fmt::Write;
    let mut out = String::from(
        "# Verification\n\n\
         `signorini verify` computes the values below on your machine and compares them with what others\n\
         published or with a closed form. It prints the deviations, writes `verification.html` and\n\
         `verification.csv`, and ends with exit code 1 if a value is not within its tolerance. None of the\n\
         expected values was computed by this program. The scenes are built-in cases or stand in\n\
         `src/verification/scenes/`.\n\n\
         | case and scheme | quantity | expected | tolerance | why this tolerance | source |\n\
         |---|---|---|---|---|---|\n",
    );
    for line in lines {
        // Writing to a string cannot fail.
        let _ = writeln!(
            out,
            "| {} | {} | {} {} | {:.0e} | {} | {} |",
            named(line),
            line.quantity,
            line.expected,
            line.unit,
            line.tolerance,
            line.reason,
            line.source
        );
    }
    out
}

#[cfg(test)]
mod tests {
    use super::{conclusion, markdown, shortfall};
    use crate::verification::expected;

    /// `SIGNORINI_UPDATE_VERIFICATION=1 cargo test --lib verification` writes the page anew.
    #[test]
    fn the_page_in_the_docs_is_that_of_the_manual() {
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/docs/verification.md");
        let made = markdown(&expected());
        if std::env::var_os("SIGNORINI_UPDATE_VERIFICATION").is_some() {
            std::fs::write(path, &made).expect("written");
        }
        assert_eq!(std::fs::read_to_string(path).expect(path), made);
    }

    #[test]
    fn a_value_that_is_missing_or_off_or_not_a_number_fails() {
        let mut lines = expected();
        lines.truncate(2);
        let exact: Vec<Option<f64>> = lines.iter().map(|line| Some(line.expected)).collect();
        let mut with = |second: Option<f64>| {
            for (line, found) in lines.iter_mut().zip([exact[0], second]) {
                line.found = found;
            }
            (conclusion(&lines), shortfall(&lines))
        };
        assert_eq!(with(exact[1]), ("all 2 values are within their tolerances".to_owned(), None));
        for wrong in [None, Some(f64::NAN), exact[1].map(|x| x + 1.0)] {
            let (said, error) = with(wrong);
            assert_eq!(said, "1 of 2 values are not within their tolerances");
            let error = error.expect("a failure");
            assert!(!error.is_request() && error.to_string().contains("velocity at 1 s"), "{error}");
        }
    }
}
