//! What histories of wear come to, a sentence each: when a limit is reached, and what the figures
//! mean.

use super::realisations::{self, with_interval};
use crate::case::Case;
use crate::error::amount;
use crate::order::sort_by_number;
use crate::study::realisations::Groups;
use crate::study::wear_history::{
    LimitReached, TimeOfLimit, WearHistories, WearQuantity, WearState, WornThrough, YEAR, mean,
};
use crate::wear::Growth;

/// When the limit is reached, and what the figures mean, a sentence each.
#[must_use]
pub fn remarks(case: &Case, found: &WearHistories) -> Vec<String> {
    let mut remarks: Vec<String> = case.instability().into_iter().collect();
    remarks.extend(limits(case, found));
    remarks.extend(worn_through(found));
    remarks.extend(found.cautioned.sentences());
    remarks.extend(unworn(found));
    remarks.extend(realisations::without_friction(&case.scene).map(|words| format!("{words}, and depths with them")));
    let histories = found.points.first().map_or(0, |point| point.histories.len());
    if histories > 1 {
        remarks.push(format!(
            "± is the half width of the 95 % interval of the mean over {histories} histories, by Student's t; each \
             window of a history has draws of its own. The deepest depth is the largest of the means of all \
             sectors, or flats, with what taking the largest adds in its half width, by the jackknife; that of \
             one history alone is an upper figure"
        ));
    }
    remarks.extend(groups(found));
    remarks.extend(single(case, found));
    remarks.extend(growths(case, found));
    let widened = found.supports.iter().enumerate().filter(|(support, _)| {
        let gap = |point| mean(point, *support, WearQuantity::Gap).0;
        let ends = found.points.first().zip(found.points.last()).map(|(first, last)| [gap(first), gap(last)]);
        ends.is_some_and(|[first, last]| first > 0.0 && last > MUCH * first)
    });
    remarks.extend(widened.map(|(_, name)| {
        format!(
            "the gap of support {name:?} grows beyond {MUCH} times the first: a tube worn so far is no ring any more"
        )
    }));
    remarks.extend(one_sided(case, found));
    remarks.push("the coefficients of wear are those of the case in every year, whatever has worn before".to_owned());
    remarks
}

/// A time in years, with the half width of its 95 % interval; where that is longer than the time,
/// no wear at all is in the interval.
fn in_years(TimeOfLimit { time_s, half_width_95_s, .. }: TimeOfLimit) -> String {
    let years = time_s / YEAR;
    match half_width_95_s.map(|half| half / YEAR) {
        Some(half) if half >= years => format!("{} (or never)", with_interval(years, Some(half))),
        Some(half) => with_interval(years, Some(half)),
        None => amount(years, 3),
    }
}

/// When the tube reaches its limit at each support, a sentence each: first where it does so first.
fn limits(case: &Case, found: &WearHistories) -> Vec<String> {
    let Some(limit) = case.wear.limit else { return Vec::new() };
    let end = found.points.last().map_or(0.0, |point| point.time_s / YEAR);
    let one = |(support, name): (usize, &String)| {
        let depths = [WearQuantity::DepthDeepest, WearQuantity::DepthOneScar, WearQuantity::DepthAllRound];
        let reached = depths.map(|depth| (depth, found.limit_reached(support, limit, depth)));
        let place = format!("the tube reaches the limit of {} mm at support {name:?}", amount(1e3 * limit, 3));
        let words = match all_later(&reached) {
            Some(later) => format!("not within {} years; {later}", rounded(end)),
            None => {
                let [deepest, one_scar, all_round] = reached.each_ref().map(|(depth, one)| after(one, *depth, end));
                format!(
                    "{deepest} where it is deepest, {one_scar} if all of its wear comes off one scar, {all_round} if \
                     it comes off evenly all round"
                )
            }
        };
        let deepest = &reached[0].1;
        let first = deepest.mean.or(deepest.at_last_rate).map_or(f64::INFINITY, |time| time.time_s);
        (first, format!("{place} {words}"))
    };
    let mut all: Vec<(f64, String)> = found.supports.iter().enumerate().map(one).collect();
    sort_by_number(&mut all, |one| one.0);
    all.into_iter().map(|(_, words)| words).collect()
}

/// When a limit is reached, in words.
fn after(reached: &LimitReached, depth: WearQuantity, end: f64) -> String {
    let among = among(&reached.histories, depth);
    match reached.mean {
        Some(time) => format!("after {} years{among}", in_years(time)),
        None => format!("not within {} years{among}{}", rounded(end), later(reached.at_last_rate)),
    }
}

/// When the limit is reached at the last rates by all depths, in words; `None` where a mean or a
/// history reaches it before.
fn all_later(reached: &[(WearQuantity, LimitReached); 3]) -> Option<String> {
    let years = |(_, one): &(WearQuantity, LimitReached)| {
        one.at_last_rate.filter(|_| one.histories.iter().all(Option::is_none)).map(in_years)
    };
    let [deepest, one_scar, all_round] = reached.each_ref().map(years);
    Some(format!(
        "at the last rates after {} years where it is deepest, after {} if all of its wear comes off one scar, after \
         {} if it comes off evenly all round",
        deepest?, one_scar?, all_round?
    ))
}

/// When a limit is reached after the end, s, in words that follow that it is not before.
fn later(at_last_rate: Option<TimeOfLimit>) -> String {
    at_last_rate.map_or_else(String::new, |time| format!(", after {} at the last rate", in_years(time)))
}

/// When a limit is reached in the single histories, s, in words that follow when their mean does.
fn among(times: &[Option<f64>], quantity: WearQuantity) -> String {
    let years: Vec<f64> = times.iter().flatten().map(|time| time / YEAR).collect();
    let ends = years.iter().copied().reduce(f64::min).zip(years.iter().copied().reduce(f64::max));
    let Some((first, last)) = ends.filter(|_| times.len() > 1) else { return String::new() };
    let [first, last] = [first, last].map(|years| amount(years, 3));
    // Of each alone it is the part that is the deepest there, earlier than by the mean.
    let own = if quantity == WearQuantity::DepthDeepest { ", each by its own deepest part" } else { "" };
    match years.len() == times.len() {
        true => format!(" (its {} histories{own} after {first} to {last})", times.len()),
        false => format!(" ({} of its {} histories{own}, the first after {first})", years.len(), times.len()),
    }
}

/// Supports at which the histories fall into two groups by their deepest wear at the end, a
/// sentence each.
fn groups(found: &WearHistories) -> Vec<String> {
    let one = |(support, name): (usize, &String)| {
        let states = found.points.last()?.histories.iter().filter_map(|states| states.get(support));
        let depths: Vec<f64> = states.map(|state| state.depth_deepest_m).collect();
        let words = Groups::of(&depths)?.words("deepest wear", "mm", 1e3);
        Some(format!("the histories fall into two groups at support {name:?}: {words}"))
    };
    found.supports.iter().enumerate().filter_map(one).collect()
}

/// What the interval of a single history is.
fn single(case: &Case, found: &WearHistories) -> Option<String> {
    let largest = &found.points.last()?.largest;
    let is_known = |state: &WearState| state.work_j.is_finite();
    let [known, lacking] = [true, false].map(|known| largest.iter().any(|state| is_known(state) == known));
    let one = if case.is_random() { "one history" } else { "nothing is random here, so that there is one history" };
    let interval = match (known, lacking) {
        (false, false) => return None,
        (true, _) => {
            "± is what the 95 % intervals of the work rates of its windows make of it, as if these erred all alike, \
             and the estimated errors of its steps over the years"
        }
        (false, true) if found.points.iter().skip(1).any(|point| point.largest.iter().any(is_known)) => {
            "± is what the 95 % intervals of the work rates of its windows make of it, until one is too short for an \
             interval of its work rate: what comes after it has none"
        }
        (false, true) => "it has no interval: its windows are too short for one of their work rates",
    };
    let more = "initial.scatter makes several of a chaotic motion, whose depths have intervals of their own";
    let more = if case.is_random() { "several histories tell how far their depths scatter" } else { more };
    Some(format!("{one}; {interval}; {more}"))
}

/// Supports at which nothing slid in any history, a sentence for all of them.
fn unworn(found: &WearHistories) -> Option<String> {
    let last = found.points.last()?;
    let worked =
        |support: usize| last.histories.iter().any(|states| states.get(support).is_some_and(|s| s.work_j > 0.0));
    let names: Vec<String> = (0..found.supports.len())
        .filter(|support| !worked(*support))
        .filter_map(|support| Some(format!("{:?}", found.supports.get(support)?)))
        .collect();
    (!names.is_empty()).then(|| {
        format!(
            "nothing wears at {} {}: in no window did the tube do any work of wear there; `run` says how near it comes",
            if names.len() == 1 { "support" } else { "supports" },
            names.join(", ")
        )
    })
}

/// That the histories end where the tube is worn through.
fn worn_through(found: &WearHistories) -> Option<String> {
    let WornThrough { support, wall_m, depth_m, time_s } = found.worn_through.as_ref()?;
    let own = found.supports.iter().position(|name| name == support)?;
    let half_width_95_s =
        found.reaches(own, *depth_m, WearQuantity::DepthDeepest).and_then(|time| time.half_width_95_s);
    let (depth, years) = (amount(1e3 * depth_m, 3), in_years(TimeOfLimit { time_s: *time_s, half_width_95_s }));
    let count = found.points.first().map_or(0, |point| point.histories.len());
    let over = if count == 1 { String::new() } else { format!(" over the {count} histories") };
    Some(match wall_m {
        Some(_) => format!(
            "{support} is worn through after {years} years, by {depth} mm where it is deepest{over}: there the study \
             ends"
        ),
        None => format!(
            "{support} is worn to the radius of the tube, {depth} mm, after {years} years where it is \
             deepest{over}: there the study ends, since no tube is left; its wall is not known, and `wall` of the \
             support gives it"
        ),
    })
}

/// What wear does to the gaps, a sentence for each way.
fn growths(case: &Case, found: &WearHistories) -> impl Iterator<Item = String> {
    let ways = [
        (Growth::Even, "the gap grows by the wear of tube and support, evenly all round"),
        (
            Growth::Shifted,
            "the gap grows by the mean wear of tube and support, and its centre moves to the deeper side",
        ),
        (
            Growth::Flats,
            "each flat recedes by its scar, of tube and flat or of both tubes together, and the gap is the least of \
             its flats",
        ),
        (
            Growth::Kept,
            "the gaps, of which the least is told, stay as they are: flats wear, and growth = \"flats\" of the \
             support lets them recede",
        ),
    ];
    ways.into_iter().filter_map(|(way, words)| {
        let own = case.written.supports.iter().filter(|support| support.growth == way);
        let names: Vec<String> = own
            .filter(|support| found.supports.contains(&support.name))
            .map(|support| format!("{:?}", support.name))
            .collect();
        (!names.is_empty()).then(|| format!("at {} {words}; the work rate is that of the gap", names.join(", ")))
    })
}

/// Supports of which the deepest wear is far from that all round, a sentence for each.
fn one_sided(case: &Case, found: &WearHistories) -> Vec<String> {
    let one = |(support, name): (usize, &String)| {
        let own = case.written.supports.iter().find(|own| own.name == *name)?;
        let last = found.points.last()?;
        let what = match own.growth {
            Growth::Even => "by which the gap grows here: growth = \"shifted\" moves the hole to the deeper side",
            Growth::Shifted => "and the hole stays a circle, wider and moved: what is sharper than that is lost",
            _ => return None,
        };
        let [deepest, even] =
            [WearQuantity::DepthDeepest, WearQuantity::DepthAllRound].map(|quantity| mean(last, support, quantity).0);
        let ratio = amount(deepest / even, 2);
        (even > 0.0 && deepest > ONE_SIDED * even)
            .then(|| format!("at support {name:?} the deepest wear is {ratio} times that all round, {what}"))
    };
    found.supports.iter().enumerate().filter_map(one).collect()
}

/// Years to three decimals, without zeros at the end.
fn rounded(years: f64) -> f64 {
    (1e3 * years).round() / 1e3
}

/// A gap that has grown by this factor gets a remark.
const MUCH: f64 = 10.0;

/// A deepest wear of this multiple of that all round gets one.
const ONE_SIDED: f64 = 3.0;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::wear_history::{Accrual, WearPoint, WearingSupport};
    use crate::wear::{Archard, Bearing, Scar, WearWork};
    use std::f64::consts::TAU;

    /// Histories whose depths all round grow by `rates` (m a year), at 0, 10 and 20 years; of one
    /// history the largest rates are 1.1 times as large.
    fn histories(rates: &[f64]) -> WearHistories {
        let scar = Scar { width: 0.025, radius: 0.01, bearing: Bearing::Hole { gap: 1e-3 } };
        let law = Archard { coefficient: Some(1e-14), support_coefficient: None, service: 1.0, scar: Some(scar) };
        let support =
            WearingSupport { name: "plate".to_owned(), gaps: vec![1e-3], growth: Growth::Kept, law, wall: None };
        // The work that takes off 1 m all round.
        let work_of = TAU * scar.radius * scar.width / 1e-14;
        let work = |depth: f64| {
            let work = work_of * depth;
            vec![WearWork { total: work, sectors: vec![work], walls: vec![work] }]
        };
        let accrual = |time: f64| Accrual {
            found: rates.iter().map(|rate| work(rate * time)).collect(),
            largest: rates.iter().take(usize::from(rates.len() == 1)).map(|rate| work(1.1 * rate * time)).collect(),
        };
        let supports = [support];
        let point = |years: f64| WearPoint::new(&supports, years * YEAR, accrual(years), accrual(1.0 / YEAR));
        let points = [0.0, 10.0, 20.0].map(point).to_vec();
        let mut found = WearHistories::none(&supports);
        found.points = points;
        found
    }

    #[test]
    fn the_year_of_a_limit_has_the_interval_of_its_histories_or_follows_from_the_last_rate() {
        let found = histories(&[1e-5, 2e-5]);
        let [depth, deepest] = [WearQuantity::DepthAllRound, WearQuantity::DepthDeepest];
        // The mean reaches 0.12 mm after 8 years, the histories after 12 and 6: 9 ± t·s/√2 of one
        // degree of freedom is 38 years.
        let each = found.reaches_by_history(0, 1.2e-4, depth);
        let mean = |quantity| in_years(found.reaches(0, 1.2e-4, quantity).unwrap());
        assert_eq!((&*mean(depth), &*among(&each, depth)), ("8 ± 38 (or never)", " (its 2 histories after 6 to 12)"));
        // Of the deepest depth, here of one part, its half width then, 12.706 times 0.04 mm, over
        // the mean rate of 0.015 mm a year.
        assert_eq!(mean(deepest), "8 ± 34 (or never)");
        assert!(among(&each, deepest).contains("each by its own deepest part after 6 to 12"));
        // 0.6 mm: after 60 and 30 years at those rates, and after 40 at the mean of them, which
        // years of service have, with 12.706 times 0.2 mm over it. The mean of 60 and 30 is late.
        let half_width = 12.706_204_736 * 0.2 / 0.015;
        for quantity in [depth, deepest] {
            let later = found.reaches_at_last_rate(0, 6e-4, quantity).unwrap();
            assert!((later.time_s / YEAR - 40.0).abs() < 1e-9, "{later:?}");
            // The slope is a difference, with some digits less.
            assert!((later.half_width_95_s.unwrap() / YEAR / half_width - 1.0).abs() < 1e-8, "{later:?}");
        }
        assert_eq!(later(found.reaches_at_last_rate(0, 6e-4, deepest)), ", after 40 ± 169 (or never) at the last rate");
        // At a hundredth of the rates not even one scar has the limit by then.
        let of = |found: &WearHistories, limit: f64| {
            [deepest, WearQuantity::DepthOneScar, depth].map(|depth| (depth, found.limit_reached(0, limit, depth)))
        };
        let all = all_later(&of(&histories(&[1e-7, 2e-7]), 6e-4)).unwrap();
        let never = "after 4000 ± 16942 (or never)";
        assert!(all.starts_with(&format!("at the last rates {never} years where it is deepest, after ")), "{all}");
        assert!(all.ends_with(&format!("{never} if it comes off evenly all round")), "{all}");
        assert_eq!(all_later(&of(&found, 1.2e-4)), None, "histories reach it before");
        // Of one history whose windows leave 10 % open: after 12 years, and at 1.1 times the rate
        // after 12/1.1.
        let one = histories(&[1e-5]);
        for quantity in [depth, deepest] {
            let half_width = one.reaches(0, 1.2e-4, quantity).unwrap().half_width_95_s.unwrap() / YEAR;
            assert!((half_width - (12.0 - 12.0 / 1.1)).abs() < 1e-9, "{half_width}");
            let (depth_then, half_width) = super::mean(&one.points[1], 0, quantity);
            assert!((depth_then - 1e-4).abs() < 1e-15 && (half_width.unwrap() - 1e-5).abs() < 1e-15);
        }
        // A work rate that stays is no number that is not known.
        assert!(one.reaches(0, f64::MAX, WearQuantity::WorkRate).is_none());
        // One that does not grow counts in the mean rate, 0.005 mm a year; where none does, nothing
        // is told.
        assert_eq!(
            later(histories(&[0.0, 1e-5]).reaches_at_last_rate(0, 6e-4, depth)),
            ", after 120 ± 1525 (or never) at the last rate"
        );
        assert_eq!(later(histories(&[0.0, 0.0]).reaches_at_last_rate(0, 6e-4, depth)), "");
    }
}
