//! The effect of each key on each measure, from a sweep that varies keys one at a time.
//!
//! The effect of a key is the measure at its upper bound less that at its lower bound, the other
//! keys as in the case. Where rows have several realisations of their random loads, it is the mean
//! over the realisations of the differences between two rows with the same seeds; the half width of
//! its 95 % interval follows from their scatter, by Student's t; of the deepest depth, the root of
//! the sum of the squares of that and of the biases of both rows, see
//! [`Deepest`](crate::study::realisations::Deepest). An effect within its half width is not
//! distinguished from none.

use super::columns::Source;
use super::layout::Layout;
use super::measure::Measure;
use super::picture::Picture;
use super::runs::Runs;
use super::table::{SEEDS, TABLE, Table};
use crate::error::Result;
use crate::order::sort_by_number;
use crate::output::csv::digits;
use crate::study::realisations::mean_of;

/// The columns of `effects.csv`.
pub(super) const HEADER: [&str; 12] =
    ["key", "low", "high", "place", "measure", "unit", "base", "at_low", "at_high", "effect", "half_width_95", SEEDS];

/// The effect of one key on one measure at one place.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Effect {
    pub key: String,
    /// The bounds of the key.
    pub bounds: [f64; 2],
    /// The column of the measure, and its parts.
    pub column: String,
    pub place: String,
    pub measure: String,
    /// The measure in the case itself, at the lower and at the upper bound.
    pub base: Option<f64>,
    pub at: [Option<f64>; 2],
    /// The mean difference; `None` where it was found in no realisation.
    pub effect: Option<f64>,
    pub half_width_95: Option<f64>,
    /// Number of differences in the mean.
    pub count: usize,
}

impl Effect {
    /// False for an effect that is not distinguished from none.
    pub fn is_seen(&self) -> bool {
        self.effect.is_some_and(|effect| self.half_width_95.is_none_or(|half| effect.abs() > half))
    }

    /// The length of its bar, from the least to the largest of the measure in the case and at both
    /// bounds; −1 where none is known.
    fn span(&self) -> f64 {
        let known = || self.at.into_iter().chain([self.base]).flatten();
        let ends = known().reduce(f64::min).zip(known().reduce(f64::max));
        ends.map_or(-1.0, |(least, most)| most - least)
    }

    /// True if the measure lies on one side of that of the case at both bounds, where the effect,
    /// its difference between them, says little.
    pub fn turns_between(&self) -> bool {
        let [low, high] = self.at.map(|at| at.zip(self.base).map_or(0.0, |(at, base)| at - base));
        low * high > 0.0
    }

    /// Its line of `effects.csv`.
    pub(super) fn cells(&self) -> Vec<String> {
        let unit = self.measure.parse::<Measure>().ok().and_then(Measure::unit).unwrap_or_default();
        let [low, high] = self.bounds.map(|x| digits(Some(x)));
        let words = [&self.key, &low, &high, &self.place, &self.measure, unit].map(str::to_owned);
        let [at_low, at_high] = self.at;
        let numbers = [self.base, at_low, at_high, self.effect, self.half_width_95].map(digits);
        words.into_iter().chain(numbers).chain([self.count.to_string()]).collect()
    }
}

/// The effects of the keys of `source`, a sweep that varies them one at a time: by measure and
/// place, the widest bar first.
///
/// # Errors
/// [`Error::Io`](crate::Error::Io) for a table that cannot be read.
pub(super) fn effects(source: &Source<'_>) -> Result<Vec<Effect>> {
    let columns = Picture::default().measure_columns(source)?;
    let names: Vec<String> = columns.iter().map(|(_, name)| name.clone()).collect();
    let (runs, bounds) = (Runs::read(source, &names)?, bounds(source)?);
    let mut all = Vec::new();
    for (index, (measure, column)) in columns.iter().enumerate() {
        let of_axis = |(axis, bounds): (usize, &[f64; 2])| {
            let [low, high] = [0, 1].map(|side| Layout::row_of(axis, side));
            let (at_low, at_high) = (runs.of(low, index), runs.of(high, index));
            let pairs: Vec<f64> = at_low.iter().filter_map(|(k, x)| Some(at_high.get(k)? - x)).collect();
            let (effect, _, half_width) = mean_of(&pairs);
            // What taking the largest of several means adds is known to itself.
            let bias = runs.bias(low, index).hypot(runs.bias(high, index));
            let half_width_95 = half_width.map(|half_width| half_width.hypot(bias));
            Effect {
                key: source.axes.get(axis).map_or_else(String::new, |axis| axis.key.clone()),
                bounds: *bounds,
                column: column.clone(),
                place: source.place(column, measure),
                measure: measure.clone(),
                base: runs.mean(0, index),
                at: [low, high].map(|row| runs.mean(row, index)),
                effect: (!pairs.is_empty()).then_some(effect),
                half_width_95,
                count: pairs.len(),
            }
        };
        let mut effects: Vec<Effect> = bounds.iter().enumerate().map(of_axis).collect();
        sort_by_number(&mut effects, |a| -a.span());
        all.extend(effects);
    }
    Ok(all)
}

/// The bounds of each axis, from the rows that are at them.
fn bounds(source: &Source<'_>) -> Result<Vec<[f64; 2]>> {
    let table = Table::open(&source.folder.join(TABLE))?;
    let row = table.column("row")?;
    let columns = source.axes.iter().map(|axis| table.column(&axis.column)).collect::<Result<Vec<_>>>()?;
    let mut bounds = vec![[f64::NAN; 2]; columns.len()];
    table.each(|line| {
        let varied = line.number(row).and_then(|row| Layout::varied(row as u64));
        if let Some((axis, share)) = varied
            && let (Some(bounds), Some(&column)) = (bounds.get_mut(axis), columns.get(axis))
            && let Some(bound) = bounds.get_mut(share as usize)
        {
            *bound = line.number(column).unwrap_or(f64::NAN);
        }
    })?;
    Ok(bounds)
}

#[cfg(test)]
mod tests {
    use super::super::table::REALISATIONS;
    use super::*;
    use crate::hash;
    use serde_json::json;
    use std::fmt::Write;

    /// Places whose measure scatters, by realisation and by row, and whose effect is `effect`.
    fn seen_of_a_thousand(effect: f64) -> usize {
        let (places, seeds) = (1000, 6_u64);
        // Normal numbers, by Box and Muller.
        let normal = |a: u64, b: u64| {
            let [u, v] = [1, 2].map(|seed| hash::unit(hash::mix(seed, a, b)));
            (-2.0 * (1.0 - u).ln()).sqrt() * (std::f64::consts::TAU * v).cos()
        };
        let columns: Vec<String> = (0..places).map(|place| format!("work_rate_p{place}_W")).collect();
        let mut runs = format!("row,realisation,gap_m,status,{}\n", columns.join(","));
        for (row, gap) in [2.0, 1.0, 3.0].into_iter().enumerate() {
            for k in 1..=seeds {
                let _ = write!(runs, "{row},{k},{gap},ok");
                for place in 0..places {
                    // What the realisations of a pair share, and what they do not.
                    let (shared, own) = (normal(place, k), normal(1000 + place, 10 * k + row as u64));
                    let _ = write!(runs, ",{}", 5.0 + shared + own + if row == 2 { effect } else { 0.0 });
                }
                runs.push('\n');
            }
        }
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join(REALISATIONS), runs).unwrap();
        std::fs::write(folder.path().join(TABLE), "row,gap_m\n0,2\n1,1\n2,3\n").unwrap();
        let names: Vec<&str> = ["row", "error"].into_iter().chain(columns.iter().map(String::as_str)).collect();
        let request = json!({
            "vary": [{ "column": "gap_m", "keys": [{ "key": "support.*.gap" }], "count": 1, "follow": "No" }],
            "columns": names,
            "seeds": seeds,
            "one_at_a_time": true,
        });
        let source = Source::new(folder.path(), request.as_object().unwrap(), "");
        let effects = effects(&source).unwrap();
        assert_eq!(effects.len(), places as usize);
        assert!(effects.iter().all(|one| one.bounds == [1.0, 3.0] && one.count == 6));
        effects.iter().filter(|one| one.is_seen()).count()
    }

    /// An interval of 95 % excludes 0 in 5 % of the designs without an effect; of 1000 the number
    /// has the standard deviation 6.9, and three of these are 20.
    #[test]
    fn one_in_twenty_effects_of_none_is_seen_and_a_large_one_always() {
        let seen = seen_of_a_thousand(0.0);
        assert!((30..=70).contains(&seen), "{seen}");
        // Ten deviations of the mean difference, √(2/6), against t₅ = 2.57 of its estimate: an
        // estimate four times too large has the probability of χ²₅ above 75, 1e-14.
        assert_eq!(seen_of_a_thousand(10.0 * (2.0_f64 / 6.0).sqrt()), 1000);
    }
}
