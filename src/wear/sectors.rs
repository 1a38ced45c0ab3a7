//! Sectors: equal parts of the circle around a support.

/// The sector of a contact at `angle`, degrees from +y towards +z, among `count` equal ones. Sector
/// number k holds the angles from 360k/count to below 360(k + 1)/count. An angle that is not finite
/// is in the first; so is every angle where `count` is 0.
///
/// ```
/// use signorini::wear::sector_of;
///
/// assert_eq!([0.0, 29.9, 30.0, 359.9, 360.0, -30.0].map(|angle| sector_of(angle, 12)), [0, 0, 1, 11, 0, 11]);
/// ```
#[must_use]
pub fn sector_of(angle: f64, count: usize) -> usize {
    let share = angle.rem_euclid(360.0) / 360.0;
    // By rounding, a small negative angle may give a share of 1, and an edge may come out a little
    // below its number.
    let at = (share * count as f64 * (1.0 + 2.0 * f64::EPSILON)) as usize;
    if at < count { at } else { 0 }
}

#[cfg(test)]
mod tests {
    use super::sector_of;

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
