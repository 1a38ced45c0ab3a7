//! Depths of wear that the tube does not have: deeper than the limit, its wall or its radius.

use super::supports::figures;
use crate::case::Case;
use crate::wear::Worn;

/// A warning where the scar at support number `index`, or all of its wear evenly all round, goes
/// deeper than the limit, than the wall of the tube, or than its radius where no wall is known.
#[must_use]
pub fn warning(case: &Case, index: usize, worn: &Worn) -> Option<String> {
    let support = case.written.supports.get(index)?;
    let (_, radius) = support.wear.scar?;
    let wall = case.wall_at(index);
    let (volume, round) = (worn.volume_m3?, worn.depth_all_round_m?);
    let end = wall.unwrap_or(radius);
    let beyond = match (worn.depth_one_scar_m, case.wear.limit) {
        (Some(depth), Some(limit)) if depth > limit && depth <= end => {
            format!("is deeper than the limit of {} mm", millimetres(limit))
        }
        (Some(depth), _) if depth <= end => return None,
        _ if wall.is_some() => format!("goes through the tube, whose wall is {} mm", millimetres(end)),
        _ => format!("is deeper than the radius of the tube, {} mm, whose wall is not known", millimetres(end)),
    };
    let scar = match worn.depth_one_scar_m {
        Some(depth) => format!("{} mm deep", millimetres(depth)),
        None => format!("deeper than the whole tube, {} mm", millimetres(2.0 * radius)),
    };
    Some(format!(
        "the scar at support {:?} {beyond}: {} mm³ off one scar is {scar}; off evenly all round it is {} mm deep",
        support.name,
        figures(1e9 * volume),
        millimetres(round)
    ))
}

/// The same of a scar that goes through the tube alone, and not of the limit.
#[must_use]
pub fn beyond(case: &Case, index: usize, worn: &Worn) -> Option<String> {
    let (_, radius) = case.written.supports.get(index)?.wear.scar?;
    let end = case.wall_at(index).unwrap_or(radius);
    worn.depth_one_scar_m.is_none_or(|depth| depth > end).then(|| warning(case, index, worn)).flatten()
}

fn millimetres(metres: f64) -> String {
    figures(1e3 * metres)
}
