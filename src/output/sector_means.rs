//! `sector-means.csv`: where around each support a tube wears, in the mean over realisations or
//! histories.

use super::csv::{self, digits};
use crate::case::Case;
use crate::error::Result;
use crate::scene::{Face, Support};
use crate::study::realisations::{Realisations, mean_of};
use crate::study::wear_history::WearHistories;
use std::path::Path;

/// Name of the file.
pub const FILE: &str = "sector-means.csv";

/// A mean and the half width of its 95 % interval; `None` where it is not known.
type Mean = (Option<f64>, Option<f64>);

/// A part of a support around the tube: a sector, or a flat, whose direction is both its ends.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Part {
    kind: &'static str,
    from_deg: f64,
    to_deg: f64,
}

/// So many equal sectors.
fn sectors(count: usize) -> impl Iterator<Item = Part> {
    let edge = move |k: usize| 360.0 * k as f64 / count as f64;
    (0..count).map(move |k| Part { kind: "sector", from_deg: edge(k), to_deg: edge(k + 1) })
}

/// The flats of `support`; none of a round one.
fn flats<'a>(case: &'a Case, support: &'a Support) -> impl Iterator<Item = Part> + 'a {
    support.members(&case.scene.walls).filter_map(|(_, wall)| match wall.face {
        Face::Flat { direction: Some(at), .. } => Some(Part { kind: "flat", from_deg: at, to_deg: at }),
        _ => None,
    })
}

/// The mean of the values, where there are any and all are finite.
fn known(values: &[f64]) -> Mean {
    if values.is_empty() || values.iter().any(|x| !x.is_finite()) {
        return (None, None);
    }
    let (mean, _, half_width) = mean_of(values);
    (Some(mean), half_width)
}

/// The mean of each place of several lists of one length.
fn means(lists: &[Vec<f64>]) -> Vec<Mean> {
    let count = lists.iter().map(Vec::len).min().unwrap_or(0);
    (0..count).map(|at| known(&lists.iter().filter_map(|list| list.get(at).copied()).collect::<Vec<_>>())).collect()
}

/// Writes the means over the realisations of `study`: the work rate of each sector of each support,
/// also of each flat, and the depth worn off the tube there within the service of the case, where
/// it has a law of wear.
pub fn write(path: &Path, case: &Case, study: &Realisations) -> Result<()> {
    let (header, rows) = cells(case, study);
    csv::table(path, &header, rows.into_iter())
}

/// The header and the rows of [`write`].
#[must_use]
pub fn cells(case: &Case, study: &Realisations) -> (Vec<String>, Vec<Vec<String>>) {
    let mut rows = Vec::new();
    for (index, support) in case.scene.supports.iter().enumerate() {
        let wear: Vec<_> = study.members.iter().filter_map(|member| member.wear.get(index)).collect();
        let rates: Vec<_> = wear.iter().map(|wear| wear.rates()).collect();
        let depths = means(&case.depths_about_mean(index, &rates));
        let by_sector = means(&rates.iter().map(|rates| rates.sectors.clone()).collect::<Vec<_>>());
        let by_flat = means(&rates.iter().map(|rates| rates.walls.clone()).collect::<Vec<_>>());
        let of_flats = flats(case, support).count();
        // Depths are those of the sectors of a hole, and of flats.
        let without = if of_flats > 0 { by_sector.len() } else { 0 };
        let parts = sectors(by_sector.len()).zip(by_sector).chain(flats(case, support).zip(by_flat));
        for (at, (part, rate)) in parts.enumerate() {
            let depth = at.checked_sub(without).and_then(|at| depths.get(at)).copied().unwrap_or_default();
            rows.push(row(&support.name, part, &[depth, rate]));
        }
    }
    let rate = ["work_rate_W", "work_rate_half_width_95_W"].map(str::to_owned);
    ([header(), rate.to_vec()].concat(), rows)
}

/// Writes the means over histories of wear at their end: the depth worn off the tube in each sector
/// of a round support, and at each flat.
pub fn write_histories(path: &Path, case: &Case, found: &WearHistories) -> Result<()> {
    let (header, rows) = cells_of_histories(case, found);
    csv::table(path, &header, rows.into_iter())
}

/// The header and the rows of [`write_histories`].
#[must_use]
pub fn cells_of_histories(case: &Case, found: &WearHistories) -> (Vec<String>, Vec<Vec<String>>) {
    let mut rows = Vec::new();
    for (index, name) in found.supports.iter().enumerate() {
        let Some(support) = case.scene.supports.iter().find(|support| support.name == *name) else { continue };
        let means = found.mean_depths_at_end(index);
        let of_flats: Vec<Part> = flats(case, support).collect();
        let parts = if of_flats.is_empty() { sectors(means.len()).collect() } else { of_flats };
        for (part, (mean, half)) in parts.into_iter().zip(means) {
            rows.push(row(name, part, &[(Some(mean).filter(|x| x.is_finite()), half.filter(|x| x.is_finite()))]));
        }
    }
    (header(), rows)
}

fn header() -> Vec<String> {
    ["place", "part", "from_deg", "to_deg", "depth_m", "depth_half_width_95_m"].map(str::to_owned).to_vec()
}

fn row(place: &str, part: Part, means: &[Mean]) -> Vec<String> {
    let mut row = vec![place.to_owned(), part.kind.to_owned()];
    row.extend([part.from_deg, part.to_deg].map(|x| digits(Some(x))));
    row.extend(means.iter().flat_map(|(mean, half)| [digits(*mean), digits(*half)]));
    row
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_go_round_once_and_a_mean_needs_every_value() {
        let parts: Vec<Part> = sectors(12).collect();
        assert_eq!((parts[0].from_deg, parts[11].to_deg), (0.0, 360.0));
        assert!(parts.windows(2).all(|pair| pair[0].to_deg == pair[1].from_deg));
        let case = Case::embedded("tube-lattice-bars").unwrap();
        let bars: Vec<f64> = flats(&case, &case.scene.supports[0]).map(|part| part.from_deg).collect();
        assert_eq!(bars, [0.0, 90.0, 180.0, 270.0]);
        let (mean, half) = means(&[vec![1.0, f64::NAN], vec![3.0, 1.0]])[0];
        // Student's t of one degree of freedom is 12.706.
        assert!(mean == Some(2.0) && (half.unwrap() - 12.706_204_7).abs() < 1e-6);
        assert_eq!(means(&[vec![1.0, f64::NAN], vec![3.0, 1.0]])[1], (None, None));
        assert!(means(&[]).is_empty());
    }
}
