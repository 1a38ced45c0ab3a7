//! Sectors: equal parts of the circle around a support.

/// The sector of a contact at `angle`, degrees from +y towards +z, among `count` equal ones. Sector
/// number k holds the angles from 360k/count to below 360(k + 1)/count. An angle that is not finite
/// is in the first; so is every angle where `count` is 0.
fn sector_of(angle: f64, count: usize) -> usize {
    let share = angle.rem_euclid(360.0) / 360.0;
    // By rounding, a small negative angle may give a share of 1, and an edge may come out a little
    // below its number.
    let at = (share * count as f64 * (1.0 + 2.0 * f64::EPSILON)) as usize;
    if at < count { at } else { 0 }
}

/// The sectors among `count` over which a contact turns evenly by `turn` about `angle`, degrees,
/// and the share of its work in each.
pub(crate) fn sectors_over(angle: f64, turn: f64, count: usize) -> impl Iterator<Item = (usize, f64)> {
    let width = 360.0 / count as f64;
    let [from, to] = [-0.5, 0.5].map(|half| (angle + half * turn.abs()) / width);
    let turns = turn != 0.0 && to > from;
    let edges = if turns { from.floor() as i64..to.ceil() as i64 } else { 0..1 };
    edges.map(move |edge| {
        if !turns {
            return (sector_of(angle, count), 1.0);
        }
        let edge = edge as f64;
        let share = (to.min(edge + 1.0) - from.max(edge)) / (to - from);
        (sector_of((edge + 0.5) * width, count), share)
    })
}

#[cfg(test)]
mod tests {
    use super::{sector_of, sectors_over};

    #[test]
    fn a_sector_holds_its_lower_edge() {
        assert_eq!([0.0, 29.9, 30.0, 359.9, 360.0, -30.0].map(|angle| sector_of(angle, 12)), [0, 0, 1, 11, 0, 11]);
    }

    #[test]
    fn what_turns_over_edges_belongs_to_the_sectors_in_proportion() {
        let shares = |angle, turn, count| sectors_over(angle, turn, count).collect::<Vec<_>>();
        assert_eq!(shares(29.0, 0.0, 12), [(0, 1.0)]);
        assert_eq!(shares(15.0, -2.0, 12), [(0, 1.0)]);
        // From 28 to 32 degrees, and from 358 to 6.
        assert_eq!(shares(30.0, 4.0, 12), [(0, 0.5), (1, 0.5)]);
        assert_eq!(shares(2.0, -8.0, 12), [(11, 0.25), (0, 0.75)]);
        // Over three sectors of 2 degrees; and where there are none.
        assert_eq!(shares(5.0, 4.0, 180), [(1, 0.25), (2, 0.5), (3, 0.25)]);
        assert_eq!((shares(5.0, 4.0, 0), shares(f64::NAN, 4.0, 12)), (vec![(0, 1.0)], vec![(0, 1.0)]));
    }

    #[test]
    fn every_edge_begins_its_sector() {
        for count in [1, 2, 3, 7, 12, 360, 3600] {
            for k in 0..count {
                let edge = 360.0 * k as f64 / count as f64;
                assert_eq!(sector_of(edge, count), k, "{edge} of {count}");
                let middle = 360.0 * (k as f64 + 0.5) / count as f64;
                assert_eq!(sector_of(middle, count), k, "{middle} of {count}");
            }
        }
        assert_eq!((sector_of(-1e-20, 12), sector_of(f64::NAN, 12), sector_of(3.0, 0)), (0, 0, 0));
    }
}
