//! The table of the shares of keys in the variance of measures.

use crate::cli::pipeline::Answer;
use crate::output::table::Table;
use crate::sweep::{Share, Shares, caution};

/// Most lines of the table.
const MOST_LINES: usize = 40;

/// Shows the shares, a line for each measure and place.
pub(super) fn show_shares(answer: &mut Answer, shares: &[Shares]) {
    let found: Vec<&Shares> = shares.iter().filter(|one| !one.parts.is_empty()).collect();
    if let Some(first) = found.first() {
        let header: Vec<&str> = ["measure"].into_iter().chain(first.parts.iter().map(|one| one.key.as_str())).collect();
        let percent = |one: &Share| match one.half_width_95 {
            Some(half_width) => format!("{:.1} ± {:.1}", 100.0 * one.share, 100.0 * half_width),
            None => format!("{:.1}", 100.0 * one.share),
        };
        let row = |one: &&Shares| [one.column.clone()].into_iter().chain(one.parts.iter().map(percent)).collect();
        answer.table(Table::new(&header, found.iter().take(MOST_LINES).map(row).collect()), "shares.csv");
        let text = "the share of each key in the variance of the measure over the rows, in %, by polynomials of the \
                    third degree; interactions: what no sum of such polynomials gives; ± is the half width of the 95 % \
                    interval, from shares without each thirteenth part of the rows";
        answer.messages([text.to_owned()]);
        answer.messages(fewest(found.into_iter()));
    }
    answer.messages(fewest(shares.iter().filter(|one| one.rows <= one.coefficients)));
}

/// The caution about those with the fewest rows, or with the least share.
fn fewest<'a>(shares: impl Iterator<Item = &'a Shares>) -> Option<String> {
    let shares: Vec<&Shares> = shares.collect();
    let (rows, coefficients) = shares.iter().map(|one| (one.rows, one.coefficients)).min()?;
    let least = shares.iter().flat_map(|one| &one.parts).map(|one| one.share).reduce(f64::min);
    caution(rows, coefficients, least)
}
