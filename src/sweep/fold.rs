//! The row of `sweep.csv` from the lines of its realisations: means, the half widths of their 95 %
//! intervals, and what the reader must know of realisations that failed. The deepest depth is that
//! of the means of all parts of a support, whose depths stand in a column of their own.

use super::measure::depths_column;
use super::status::Status;
use super::table::{REALISATION, numbers_of};
use super::until_interval::UntilInterval;
use crate::output::csv::digits;
use crate::study::realisations::{Deepest, mean_of};
use csv::StringRecord;

/// Most numbers of realisations that a reason lists.
const MOST_LISTED: usize = 12;

/// The columns of `realisations.csv`, as a fold needs them.
pub(super) struct Fold {
    header: Vec<String>,
    realisation: usize,
    status: usize,
    error: usize,
    /// The end of the columns of measures.
    end: usize,
    until: Option<UntilInterval>,
}

impl Fold {
    /// The fold of lines under `header`; `until` where the intervals of rows decide how many there
    /// are.
    pub fn of(header: &[String], until: Option<UntilInterval>) -> Self {
        let find = |name: &str| header.iter().position(|column| column == name).unwrap_or(usize::MAX);
        let (realisation, status, error) = (find(REALISATION), find("status"), find("error"));
        let depths = header.iter().filter(|name| depths_column(name).is_some_and(|list| header.contains(&list)));
        let end = header.len().saturating_sub(depths.count());
        Self { header: header.to_vec(), realisation, status, error, end, until }
    }

    /// The cells of the row with these `runs`, one or more: what tells the row apart, the number of
    /// realisations in the means, status, reason, then each mean x̄ and the half width t s/√N of
    /// its interval, by [`mean_of`], of the deepest depth by [`Deepest`]. The means are over the
    /// runs that have valid measures; where one of these lacks a measure, its cells are empty.
    pub fn row(&self, runs: &[StringRecord]) -> Vec<String> {
        let good: Vec<&StringRecord> = runs.iter().filter(|run| Status::is_good_word(self.word(run))).collect();
        let lead = runs.first().into_iter().flat_map(|run| run.iter().take(self.status).enumerate());
        let mut cells: Vec<String> =
            lead.filter(|(at, _)| *at != self.realisation).map(|(_, cell)| cell.to_owned()).collect();
        let shortfall = self.until.as_ref().and_then(|until| until.shortfall(runs)).map(|error| error.to_string());
        let status = self.status_of(runs, good.len(), shortfall.is_some());
        let reasons: Vec<String> = self.reasons(runs, &good).into_iter().chain(shortfall).collect();
        cells.extend([good.len().to_string(), status, reasons.join("; ")]);
        for column in self.measures() {
            let mean = self.mean(column, &good);
            cells.push(digits(mean.map(|(mean, _)| mean)));
            cells.push(digits(mean.and_then(|(_, half_width)| half_width).filter(|half| half.is_finite())));
        }
        cells
    }

    /// The mean of a column over the runs that are `good`, and the half width of its interval.
    fn mean(&self, column: usize, good: &[&StringRecord]) -> Option<(f64, Option<f64>)> {
        let values: Vec<f64> = good.iter().map(|run| number(run, column)).collect::<Option<_>>()?;
        if values.is_empty() {
            return None;
        }
        let list = self.header.get(column).and_then(|name| depths_column(name));
        if let Some(list) = list.and_then(|name| self.header.iter().position(|column| *column == name)) {
            let depths: Option<Vec<Vec<f64>>> = good.iter().map(|run| numbers_of(run.get(list)?)).collect();
            return depths.map(|depths| Deepest::of(&depths)).map(|found| (found.value, found.half_width_95));
        }
        let (mean, _, half_width) = mean_of(&values);
        Some((mean, half_width))
    }

    fn measures(&self) -> std::ops::Range<usize> {
        self.error.saturating_add(1).min(self.end)..self.end
    }

    fn word<'a>(&self, run: &'a StringRecord) -> &'a str {
        run.get(self.status).unwrap_or_default()
    }

    /// The status of a row of which `good` runs have valid measures: `partial` where some have and
    /// some have not, and where these are `too_few`, else that of the first which is not `ok`.
    fn status_of(&self, runs: &[StringRecord], good: usize, too_few: bool) -> String {
        if good > 0 && (good < runs.len() || too_few) {
            return Status::Partial.name().to_owned();
        }
        let told = runs.iter().map(|run| self.word(run)).find(|word| *word != Status::Ok.name());
        told.unwrap_or(Status::Ok.name()).to_owned()
    }

    /// What the runs say of themselves, by status: how many, which, and what the first of them
    /// says; then the measures that only some of them have, or none.
    fn reasons(&self, runs: &[StringRecord], good: &[&StringRecord]) -> Vec<String> {
        let reason = |run: &&StringRecord| run.get(self.error).unwrap_or_default().to_owned();
        let tells = |run: &&StringRecord| !Status::is_good_word(self.word(run)) || !reason(run).is_empty();
        let mut groups: Vec<Vec<&StringRecord>> = Vec::new();
        for run in runs.iter().filter(tells) {
            match groups.iter_mut().find(|group| group.first().is_some_and(|one| self.word(one) == self.word(run))) {
                Some(group) => group.push(run),
                None => groups.push(vec![run]),
            }
        }
        let told = |group: &Vec<&StringRecord>| {
            let first = group.first()?;
            let word = Some(self.word(first)).filter(|word| *word != Status::Ok.name());
            let status = word.map_or_else(String::new, |word| format!("{word} "));
            let reason = reason(first);
            let reason = if reason.is_empty() { reason } else { format!(": {reason}") };
            Some(format!("{status}in {} of {} realisations ({}){reason}", group.len(), runs.len(), self.listed(group)))
        };
        let mut told: Vec<String> = groups.iter().filter_map(told).collect();
        let [mut some, mut all] = [Vec::new(), Vec::new()];
        for (column, name) in self.header.iter().enumerate().take(self.end).skip(self.measures().start) {
            let with = good.iter().filter(|run| number(run, column).is_some()).count();
            if with > 0 && with < good.len() {
                some.push(name.as_str());
            // What all lack, each run may have said already.
            } else if with == 0 && !good.is_empty() && !told.iter().any(|words| words.contains(name.as_str())) {
                all.push(name.as_str());
            }
        }
        for (which, columns) in [("some realisations have no value", some), ("no realisation has a value", all)] {
            if !columns.is_empty() {
                told.push(format!("{which}, so there is no mean, of {}", columns.join(", ")));
            }
        }
        told
    }

    /// The numbers of realisations.
    fn listed(&self, runs: &[&StringRecord]) -> String {
        let numbers = runs.iter().take(MOST_LISTED).map(|run| run.get(self.realisation).unwrap_or_default());
        let more = if runs.len() > MOST_LISTED { ", …" } else { "" };
        numbers.collect::<Vec<_>>().join(", ") + more
    }
}

fn number(run: &StringRecord, column: usize) -> Option<f64> {
    run.get(column)?.parse().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn folded(runs: &[[&str; 7]]) -> Vec<String> {
        let header = ["row", "realisation", "gap_m", "status", "error", "work_rate_a_W", "impact_share_a"];
        let runs: Vec<StringRecord> = runs.iter().map(|run| StringRecord::from(run.to_vec())).collect();
        Fold::of(&header.map(str::to_owned), None).row(&runs)
    }

    #[test]
    fn a_row_has_the_means_and_the_intervals_of_student() {
        // 1, 2, 3, 6: mean 3, deviation √(14/3), t₃ = 3.182446305284 (a table); four equal values
        // have the half width 0.
        let runs = ["1", "2", "3", "6"].map(|x| ["4", x, "1e-3", "ok", "", x, "0.5"]);
        let row = folded(&runs);
        assert_eq!(row[..6], ["4", "1e-3", "4", "ok", "", "3.0"].map(str::to_owned));
        let half = 3.182_446_305_284 * (14.0_f64 / 3.0).sqrt() / 2.0;
        // The table of t has 13 digits.
        assert!((row[6].parse::<f64>().unwrap() / half - 1.0).abs() < 1e-12, "{row:?}");
        assert_eq!(row[7..], ["0.5", "0.0"].map(str::to_owned));
    }

    #[test]
    fn the_deepest_depth_is_that_of_the_means_of_all_parts() {
        let header = ["row", "realisation", "status", "error", "depth_deepest_a_m", "work_rate_a_W", "depths_a_m"];
        let fold = Fold::of(&header.map(str::to_owned), None);
        let row =
            |runs: &[[&str; 7]]| fold.row(&runs.iter().map(|run| StringRecord::from(run.to_vec())).collect::<Vec<_>>());
        // The mean of 4 and 2 is 3; those of the parts are 2 and 1, and the jackknife's
        // pseudo-values 4 − 2 and 4 − 4: the bias is 1, beside t₁ times the mean's deviation 2.
        let [first, second] = [["0", "1", "ok", "", "4", "1", "4.0 0.0"], ["0", "2", "ok", "", "2", "1", "0.0 2.0"]];
        let found = row(&[first, second]);
        assert_eq!((found[4].as_str(), found.len()), ("2.0", 8));
        assert!((found[5].parse::<f64>().unwrap() - (2.0 * 12.706_204_736_2 + 1.0)).abs() < 1e-9, "{found:?}");
        assert_eq!(found[6..], ["1.0", "0.0"].map(str::to_owned));
        // A run without the depth leaves no mean, and names its measure alone.
        let lacking = row(&[first, ["0", "2", "ok", "", "", "1", ""]]);
        assert_eq!(lacking[4..6], ["", ""].map(str::to_owned));
        assert!(lacking[3].contains("of depth_deepest_a_m") && !lacking[3].contains("depths_a"), "{lacking:?}");
    }

    #[test]
    fn realisations_that_failed_are_named_and_counted_and_are_not_in_the_means() {
        let row = folded(&[
            ["4", "1", "1e-3", "ok", "", "1", "0.5"],
            ["4", "2", "1e-3", "refuted", "momentum, gained", "9", "0.5"],
            ["4", "3", "1e-3", "ok", "", "3", ""],
            ["4", "4", "1e-3", "diverged", "at 1 s", "", ""],
            ["4", "5", "1e-3", "refuted", "momentum, lost", "9", "0.5"],
        ]);
        assert_eq!(row[2..4], ["2", "partial"].map(str::to_owned));
        let reason = "refuted in 2 of 5 realisations (2, 5): momentum, gained; diverged in 1 of 5 realisations (4): at \
                      1 s; some realisations have no value, so there is no mean, of impact_share_a";
        assert_eq!(row[4], reason);
        // 1 and 3: mean 2, deviation √2, t₁ = 12.7062047362.
        assert_eq!(row[5], "2.0");
        assert!((row[6].parse::<f64>().unwrap() / 12.706_204_736_2 - 1.0).abs() < 1e-11, "{row:?}");
        assert_eq!(row[7..], ["", ""].map(str::to_owned));
    }

    #[test]
    fn a_row_whose_realisations_all_failed_has_no_mean_and_their_status() {
        let row =
            folded(&[["4", "1", "1e-3", "not-finite", "a", "", ""], ["4", "2", "1e-3", "refuted", "b", "1", "1"]]);
        assert_eq!(row[2..4], ["0", "not-finite"].map(str::to_owned));
        assert_eq!(row[4], "not-finite in 1 of 2 realisations (1): a; refuted in 1 of 2 realisations (2): b");
        assert!(row[5..].iter().all(String::is_empty), "{row:?}");
    }

    #[test]
    fn a_row_with_one_mean_has_no_interval_and_notes_of_good_runs_stay() {
        let row = folded(&[
            ["4", "1", "1e-3", "handed", "2 stretches", "1", "1"],
            ["4", "2", "1e-3", "ok", "no derivative", "3", "1"],
        ]);
        assert_eq!((row[3].as_str(), row[5].as_str()), ("handed", "2.0"));
        assert_eq!(row[4], "handed in 1 of 2 realisations (1): 2 stretches; in 1 of 2 realisations (2): no derivative");
        // What no run has is named once, by the runs or here.
        for (said, told) in [
            ("", "no realisation has a value, so there is no mean, of impact_share_a"),
            ("no impact_share_a: elastic", "in 2 of 2 realisations (1, 2): no impact_share_a: elastic"),
        ] {
            let row = folded(&[["4", "1", "1e-3", "ok", said, "1", ""], ["4", "2", "1e-3", "ok", said, "3", ""]]);
            assert_eq!((row[3].as_str(), row[4].as_str(), row[7].as_str()), ("ok", told, ""));
        }
        let row = folded(&[["4", "1", "1e-3", "failed", "x", "", ""], ["4", "2", "1e-3", "ok", "", "3", "1"]]);
        assert_eq!(row[2..4], ["1", "partial"].map(str::to_owned));
        assert_eq!(row[5..7], ["3.0", ""].map(str::to_owned));
    }
}
