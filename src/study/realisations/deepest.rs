//! The largest of several means: how deep a tube wears where it is deepest.
//!
//! Each of n realisations, or histories, has a depth in each sector of a support, or at each of its
//! flats. Wanted is the largest over these parts of the expectation of the depth. The mean of each
//! realisation's largest part is no estimate of it: a part that is the largest by chance counts, so
//! that it exceeds what is wanted by the scatter of one realisation, however many there are. The
//! largest of the means, M/n with M the largest of the sums, exceeds it by their scatter, which
//! falls with √n. It is the estimate: like the depths it never falls with time, and it errs to the
//! safe side. What is left of that excess the jackknife tells (Quenouille 1956,
//! doi:10.1093/biomet/43.3-4.353; Miller 1974, doi:10.1093/biomet/61.1.1): the realisations fall
//! into G groups of m_g, six or as many as there are, with M_g the largest of the sums without
//! group g, and
//!
//! τ_g = (M − M_g)/m_g,   θ = Σ m_g τ_g/n,   b = M/n − θ ≥ 0,
//! s² = Σ (τ_g − θ)²/(n/m_g − 1)/G
//!
//! are the pseudo-values (for groups that differ in size by one as of Busing, Meijer and van der
//! Leeden 1999, doi:10.1023/A:1008800423698), the estimate less its bias, the bias, and the
//! variance of θ. If the same part is the largest without any group, b = 0 and θ is its mean. From
//! few realisations b is too rough to be taken off: of three histories θ was below the depth all
//! round, and fell with time.
//!
//! Where all parts are alike, b is about half of the bias, and s is small, since parts take turns.
//! So the half width is w + b, with w the larger of t s, of G − 1 degrees of freedom, and the half
//! width of the mean of the largest part itself. Groups of several realisations leave out enough
//! for another part to become the largest, which leaving out one of 24 hardly does. Of 12 parts
//! that are all alike, which is the worst case, the intervals of 2 to 60 realisations hold the
//! truth in 94 to 98 % of 2000 studies, those of 200 in 92 %, of 36 such parts in 86 %; of parts
//! that differ in 93 to 99 %.

use super::estimate::mean_of;
use crate::statistics::student_95;

/// Most groups of the jackknife.
const GROUPS: usize = 6;

/// The largest of the expectations of several parts, from realisations that have a value of each.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Deepest {
    /// The estimate; NaN where a value is no number, and 0 without parts.
    pub value: f64,
    /// Standard deviation of one realisation in the part of the largest mean; `None` for one.
    pub deviation: Option<f64>,
    /// Half width of its 95 % interval; `None` for one realisation.
    pub half_width_95: Option<f64>,
    /// The part of the largest mean.
    pub part: usize,
    /// By how much the largest mean exceeds the expectation, as the jackknife has it.
    pub bias: f64,
}

impl Deepest {
    /// That of `members`, which have values of the same parts.
    pub fn of(members: &[Vec<f64>]) -> Self {
        let groups = members.len().min(GROUPS);
        let sums = Sums::of(members, |_| true);
        let Some((part, largest)) = sums.largest() else {
            let nothing = !members.is_empty() && sums.0.is_empty();
            let half_width_95 = (nothing && members.len() > 1).then_some(0.0);
            let value = if nothing { 0.0 } else { f64::NAN };
            return Self { value, deviation: None, half_width_95, part: 0, bias: 0.0 };
        };
        let own: Vec<f64> = members.iter().filter_map(|values| values.get(part).copied()).collect();
        let (mean, deviation, of_part) = mean_of(&own);
        let without: Vec<(usize, f64)> =
            (0..groups).filter_map(|group| Sums::of(members, |k| k % groups != group).largest()).collect();
        let Some(of_part) = of_part else {
            return Self { value: mean, deviation, half_width_95: None, part, bias: 0.0 };
        };
        // Group number g has the members g, g + G, …
        let size = |group: usize| ((members.len() - group).div_ceil(groups)) as f64;
        let pseudo = without.iter().enumerate().map(|(group, (_, sum))| ((largest - sum) / size(group), size(group)));
        let pseudo: Vec<(f64, f64)> = pseudo.collect();
        let n = members.len() as f64;
        let estimate = pseudo.iter().map(|(tau, size)| tau * size).sum::<f64>() / n;
        let square = pseudo.iter().map(|(tau, size)| (tau - estimate).powi(2) / (n / size - 1.0)).sum::<f64>();
        let by_groups = student_95(groups as u64 - 1) * (square / groups as f64).sqrt();
        // Without another part in any group the two differ by their rounding.
        let alone = without.iter().all(|(other, _)| *other == part);
        let bias = if alone { 0.0 } else { (mean - estimate).max(0.0) };
        // Equal realisations scatter by nothing, whatever their sums round to.
        let by_groups = if alone && of_part == 0.0 { 0.0 } else { by_groups };
        let half_width_95 = Some(of_part.max(by_groups) + bias);
        Self { value: mean, deviation, half_width_95, part, bias }
    }
}

/// The sum of each part over some members.
struct Sums(Vec<f64>);

impl Sums {
    fn of(members: &[Vec<f64>], counts: impl Fn(usize) -> bool) -> Self {
        let mut sums = vec![0.0; members.iter().map(Vec::len).min().unwrap_or(0)];
        for (_, values) in members.iter().enumerate().filter(|(k, _)| counts(*k)) {
            sums.iter_mut().zip(values).for_each(|(sum, value)| *sum += value);
        }
        Self(sums)
    }

    /// The first part with the largest sum, and that; `None` where one is no number, and of none.
    fn largest(&self) -> Option<(usize, f64)> {
        let all = self.0.iter().copied().enumerate();
        let larger = |most: (usize, f64), other: (usize, f64)| if other.1 > most.1 { other } else { most };
        all.reduce(larger).filter(|_| self.0.iter().all(|sum| sum.is_finite()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hash::Draws;

    /// Which of `studies` of so many realisations hold the largest of `expectations` by `estimate`,
    /// and the mean of the estimates over it. A depth scatters about its expectation by half of it,
    /// as the mean of four exponential values.
    fn held(
        expectations: &[f64],
        (studies, realisations): (u64, u64),
        estimate: impl Fn(&[Vec<f64>]) -> (f64, f64),
    ) -> (usize, f64) {
        let truth = expectations.iter().copied().fold(0.0, f64::max);
        let (mut held, mut sum) = (0, 0.0);
        for study in 0..studies {
            let mut draws = Draws::new(study, realisations);
            let mut depth = |expected: &f64| -> f64 {
                expected * (0..4).map(|_| -draws.between(1e-12, 1.0).ln()).sum::<f64>() / 4.0
            };
            let members: Vec<Vec<f64>> =
                (0..realisations).map(|_| expectations.iter().map(&mut depth).collect()).collect();
            let (value, half_width) = estimate(&members);
            held += usize::from((value - truth).abs() <= half_width);
            sum += value / truth;
        }
        (held, sum / studies as f64)
    }

    fn by_jackknife(members: &[Vec<f64>]) -> (f64, f64) {
        let deepest = Deepest::of(members);
        (deepest.value, deepest.half_width_95.unwrap())
    }

    /// The mean of the largest of each realisation, as Student has it.
    fn by_largest(members: &[Vec<f64>]) -> (f64, f64) {
        let largest: Vec<f64> = members.iter().map(|values| values.iter().copied().fold(0.0, f64::max)).collect();
        let (mean, _, half_width) = mean_of(&largest);
        (mean, half_width.unwrap())
    }

    /// Twelve parts alike, where which is the largest is chance alone; parts that fall off slowly;
    /// two alike, and one alone far above the others.
    fn cases() -> [Vec<f64>; 4] {
        let slowly = (0..12).map(|k| 1.0 - 0.03 * f64::from(k)).collect();
        let with = |first: &[f64]| [first, &[0.3; 10]].concat();
        [vec![1.0; 12], slowly, with(&[1.0, 1.0]), with(&[1.0])]
    }

    /// Of 200 studies 95 % are 190, with the standard deviation 3.1; 91 % are 182, two and a half
    /// of them below. More than 190 is no fault: a half width has the bias in it.
    #[test]
    fn intervals_of_the_deepest_hold_the_largest_expectation() {
        for realisations in [3, 6, 13, 24] {
            for expectations in cases() {
                let (held, mean) = held(&expectations, (200, realisations), by_jackknife);
                let few = if realisations < 6 { 1.6 } else { 1.4 };
                assert!(held >= 182, "{held} of 200 for {realisations} of {expectations:?}");
                assert!((0.95..few).contains(&mean), "{mean} for {realisations} of {expectations:?}");
            }
        }
    }

    /// What the test above is for: the mean of the largest of each is off by the scatter of one
    /// realisation, however many there are.
    #[test]
    fn the_mean_of_the_largest_of_each_is_no_estimate_of_it() {
        let (held, mean) = held(&[1.0; 12], (200, 24), by_largest);
        assert!(held == 0 && mean > 1.9, "{held}, {mean}");
    }

    #[test]
    fn the_estimate_is_that_of_the_formulas() {
        // M = 2, without the first 1, without the second 2: τ = 1, 0 and θ = 0.5, b = 0.5, s = 0.5;
        // the mean of 2 and 0 has the half width t √2/√2, t₁ = 12.7062047362.
        let found = Deepest::of(&[vec![2.0, 0.0], vec![0.0, 1.0]]);
        assert_eq!((found.value, found.bias, found.part), (1.0, 0.5, 0));
        assert!((found.half_width_95.unwrap() - 12.706_204_736_2 - 0.5).abs() < 1e-9);
        // Seven realisations, the first group of two: M = 10 by 3, 1, 1, 1, 1, 1, 2 and 7 ones
        // beside them, without which the same part is the largest.
        let values = [3.0, 1.0, 1.0, 1.0, 1.0, 1.0, 2.0].map(|x| vec![1.0, x]);
        let found = Deepest::of(&values);
        assert_eq!((found.value, found.bias, found.part), (10.0 / 7.0, 0.0, 1));
    }

    #[test]
    fn one_part_has_students_interval_and_one_realisation_none() {
        let values = [1.0, 2.0, 3.0, 6.0].map(|x| vec![x]);
        let found = Deepest::of(&values);
        // Mean 3, deviation √(14/3), t₃ = 3.182446305284.
        let half = 3.182_446_305_284 * (14.0_f64 / 3.0).sqrt() / 2.0;
        assert!(found.value == 3.0 && (found.half_width_95.unwrap() / half - 1.0).abs() < 1e-12);
        let one = Deepest::of(&[vec![1.0, 4.0, 2.0]]);
        assert_eq!((one.value, one.part, one.half_width_95), (4.0, 1, None));
        // Equal realisations scatter by nothing; a value that is none, and no part at all.
        let same = Deepest::of(&vec![vec![0.1, 0.3]; 7]);
        assert_eq!((same.value, same.half_width_95), (0.3, Some(0.0)));
        assert!(Deepest::of(&[vec![1.0, f64::NAN], vec![1.0, 1.0]]).value.is_nan());
        assert_eq!(Deepest::of(&[vec![], vec![]]).value, 0.0);
        assert!(Deepest::of(&[]).value.is_nan());
    }
}
