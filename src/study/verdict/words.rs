//! A refinement verdict in words.

use super::{Check, MOST_NAMED, Verdict, WallVerdict, WorkRateVerdict};
use crate::order::sort_by_number;
use crate::study::horizon::LARGEST_GROWTH;
use std::fmt;

/// Largest change that is told as a share.
const MOST_SHARE: f64 = 0.5;

impl Verdict {
    /// The walls named in the text: all where they are few, else those with the largest impulses.
    fn foremost(&self) -> Vec<&WallVerdict> {
        let mut walls: Vec<&WallVerdict> = self.walls.iter().collect();
        if walls.len() > MOST_NAMED {
            sort_by_number(&mut walls, |a| -a.impulse_n_s[0].abs());
            walls.truncate(MOST_NAMED);
        }
        walls
    }

    /// What the check changes in the impulses, as the rest of a sentence.
    pub(crate) fn impulse_words(&self) -> String {
        match self.impulse_change() {
            change if change.is_finite() => format!("by up to {change:.1e} of the largest"),
            _ => "where there were none".to_owned(),
        }
    }

    /// What the check changes in the displacement, as the rest of a sentence.
    pub(crate) fn displacement_words(&self) -> String {
        let horizon = match self.horizon_s {
            t if t < 0.1 => format!("{t:.3e}"),
            t => format!("{t:.4}"),
        };
        match self.displacement {
            None => format!(
                "was not compared: beyond t = {horizon} s, before the first row, a change of the start has grown \
                 {LARGEST_GROWTH:.0e}-fold, or a run has diverged"
            ),
            Some(share) if self.is_gap => format!("changes by {share:.1e} of the gap up to t = {horizon} s"),
            Some(share) => format!("changes by {:.1e} m up to t = {horizon} s", share * self.length_m),
        }
    }
}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.check {
            Check::HalfStep { step_s } => write!(f, "with half the step, {step_s:.3e} s,")?,
            Check::OtherRounding { .. } => f.write_str("the exact scheme has no step; with other roundings")?,
        }
        write!(f, " the displacement {}", self.displacement_words())?;
        if self.parts() && !(self.walls.is_empty() && self.work_rates.is_empty()) {
            f.write_str("; the motions part, so that the rest are differences between two of them, no errors of one")?;
        }
        for wall in self.foremost() {
            write!(f, "; {} {:?}: impulse {}", wall.kind.word(), wall.wall, relative(wall.impulse_n_s, "N s"))?;
            let [before, after] = wall.contacts;
            match before {
                _ if before != after => write!(f, ", contacts {before} → {after}")?,
                // One that began before the window lasts on.
                0 if wall.impulse_n_s[0] != 0.0 => f.write_str(", no contact begins, as before")?,
                0 => f.write_str(", no contact as before")?,
                1 => f.write_str(", 1 contact as before")?,
                _ => write!(f, ", {before} contacts as before")?,
            }
            if let [Some(before), Some(after)] = wall.peak_force_n {
                write!(f, ", peak force {}", relative([before, after], "N"))?;
            }
        }
        if self.walls.len() > MOST_NAMED {
            write!(
                f,
                "; all {} walls: impulses {}, contacts {:+}",
                self.walls.len(),
                self.impulse_words(),
                self.contacts_gained()
            )?;
        }
        WorkRateVerdict::hardest(&self.work_rates).into_iter().try_for_each(|support| write!(f, "; {support}"))
    }
}

impl fmt::Display for WorkRateVerdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "work rate of support {:?} {}", self.support, relative(self.work_rate_w, "W"))?;
        let [before, after] = self.work_rate_w;
        match self.half_width_95_w {
            Some(half) if before != after && (after - before).abs() <= half => {
                write!(f, ", within the run's own interval of ± {:.1e} of it", half / before.abs())
            }
            _ => Ok(()),
        }
    }
}

/// The change of a value in `unit`, as a share of the value before it, which is that of the run;
/// both values where that share says little.
fn relative([before, after]: [f64; 2], unit: &str) -> String {
    let change = (after - before).abs();
    if before == after {
        "unchanged".into()
    } else if after == 0.0 {
        format!("{before:.1e} {unit} → none")
    } else if change > MOST_SHARE * before.abs() {
        format!("{before:.1e} → {after:.1e} {unit}")
    } else {
        format!("{:+.1e} of its value", (after - before) / before.abs())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::statistics::PlaceKind;

    fn verdict(impulses: &[[f64; 2]]) -> Verdict {
        let wall = |(i, &impulse_n_s): (usize, &[f64; 2])| WallVerdict {
            wall: format!("wall-{i}"),
            kind: PlaceKind::Wall,
            impulse_n_s,
            contacts: [1, 1],
            peak_force_n: [None, None],
        };
        let walls = impulses.iter().enumerate().map(wall).collect();
        Verdict {
            check: Check::HalfStep { step_s: 1e-3 },
            displacement: Some(0.0),
            length_m: 1e-3,
            is_gap: true,
            horizon_s: 1.0,
            end_s: 1.0,
            walls,
            work_rates: Vec::new(),
            findings: Vec::new(),
        }
    }

    #[test]
    fn a_wall_that_only_one_run_touches_is_measured_by_the_largest() {
        assert!(verdict(&[[1.0, 1.1]]).to_string().contains(", 1 contact as before"));
        let one_run_only = verdict(&[[-2.0, -2.0], [0.5, 0.0], [0.0, -0.25]]);
        assert!((one_run_only.impulse_change() - 0.25).abs() < 1e-15);
        assert!(one_run_only.to_string().contains("5.0e-1 N s → none"), "{one_run_only}");
        assert!(verdict(&[[1.0, 0.8]]).to_string().contains("impulse -2.0e-1 of its value"));
        assert!(verdict(&[[0.0, 0.0], [0.0, 0.0]]).impulse_change() == 0.0);
        // What grows eleven times is neither a loss nor a change by 91 %.
        let grown = verdict(&[[-0.2595, -2.8587]]);
        assert!(grown.to_string().contains("impulse -2.6e-1 → -2.9e0 N s"), "{grown}");
        assert!((grown.impulse_change() - 10.016).abs() < 1e-3);
        assert_eq!(verdict(&[[0.0, 0.1]]).impulse_words(), "where there were none");
        assert!((verdict(&[[1.0, 0.8]]).impulse_change() - 0.2).abs() < 1e-15);
    }

    #[test]
    fn a_work_rate_that_changes_less_than_it_scatters_says_so() {
        let said = |work_rate_w, half_width_95_w| {
            let support = WorkRateVerdict { support: "plate".to_owned(), work_rate_w, half_width_95_w };
            Verdict { work_rates: vec![support], ..verdict(&[]) }.to_string()
        };
        assert!(said([0.01, 0.015], Some(0.002)).ends_with("; work rate of support \"plate\" +5.0e-1 of its value"));
        let within = said([0.01, 0.0104], Some(0.001));
        assert!(within.ends_with("+4.0e-2 of its value, within the run's own interval of ± 1.0e-1 of it"), "{within}");
        assert!(said([0.01, 0.01], Some(0.001)).ends_with("unchanged"));
        assert!(said([0.01, 0.0], Some(0.1)).contains("1.0e-2 W → none"));
    }

    #[test]
    fn a_displacement_that_was_not_compared_or_has_no_gap_does_not_read_as_a_share_of_it() {
        let mut said = Verdict { displacement: Some(1.3e-8), length_m: 2e-3, ..verdict(&[]) };
        assert_eq!(said.displacement_words(), "changes by 1.3e-8 of the gap up to t = 1.0000 s");
        said.is_gap = false;
        assert_eq!(said.displacement_words(), "changes by 2.6e-11 m up to t = 1.0000 s");
        assert!(!said.to_string().contains("part"));
        let parted = Verdict { displacement: Some(0.5), ..verdict(&[[1.0, 1.0]]) };
        let beyond = Verdict { horizon_s: 0.5, ..verdict(&[[1.0, 1.1]]) };
        // Nothing moves, or alike to the end.
        assert!(!Verdict { horizon_s: 0.5, ..verdict(&[[1.0, 1.0]]) }.to_string().contains("part"));
        assert!([parted, beyond].iter().all(|one| one.to_string().contains("the motions part")));
        assert!(!verdict(&[[1.0, 1.0]]).to_string().contains("part"));
        (said.displacement, said.horizon_s) = (None, 2e-5);
        let words = said.displacement_words();
        assert!(words.starts_with("was not compared: beyond t = 2.000e-5 s"), "{words}");
    }
}
