//! Whether the window of the statistics begins before the motion has settled.

use crate::error::amount;
use crate::scene::{LoadKind, Scene};
use crate::statistics::{Statistics, Unsettled};

/// The note on means that are others in the beginning of the window than in the rest of it, told of
/// the one that differs most; `None` where there are none, without a load that goes on, since a
/// motion that dies away is no settled one, and where a load acts in a part of the window alone:
/// the motion under a blow or a pulse is what is asked for.
pub(crate) fn unsettled(scene: &Scene, statistics: &Statistics) -> Option<String> {
    let lasts = |kind: &LoadKind| !matches!(kind, LoadKind::Constant { .. } | LoadKind::Impulse { .. });
    let window = statistics.from_s..statistics.to_s;
    let passes = |kind: &LoadKind| match kind {
        LoadKind::Impulse { impulse, time } => *impulse != 0.0 && *time > window.start && window.contains(time),
        LoadKind::Table(table) if table.force().iter().any(|force| *force != 0.0) => {
            let edges = [table.time().first(), table.time().last()].into_iter().flatten();
            edges.into_iter().any(|edge| *edge > window.start && *edge < window.end * (1.0 - 1e-9))
        }
        _ => false,
    };
    let kinds = || scene.loads.iter().map(|load| &load.kind);
    if !kinds().any(lasts) || kinds().any(passes) {
        return None;
    }
    let share = |one: &Unsettled| {
        let (_, _, [first, rest]) = one.means();
        (first / rest - 1.0).abs()
    };
    let worst = statistics.unsettled.iter().max_by(|a, b| share(a).total_cmp(&share(b)))?;
    let begins = |one: &Unsettled| one.settled_from_s;
    // All of them have to have settled.
    let from = statistics.unsettled.iter().map(begins).reduce(|a, b| a.zip(b).map(|(a, b)| a.max(b))).flatten();
    let (what, unit, means) = worst.means();
    let [first, rest] = means.map(|mean| amount(mean, 4));
    let place = format!("the {what} of {} {:?}", worst.place.kind.word(), worst.place.name);
    Some(match from {
        Some(from) => {
            let at = amount(from, 4);
            format!(
                "still settling: {place} is {first} {unit} in the beginning of the window and {rest} {unit} in the \
                 rest, by more than it scatters; begin the statistics at t = {at} s (time.statistics_from={at})"
            )
        }
        None => format!(
            "still settling: {place} is {first} {unit} in the beginning of the window and {rest} {unit} in the rest, \
             and no half of it is alike; a later time.statistics_from and a later time.end tell what it comes to"
        ),
    })
}
