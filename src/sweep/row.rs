//! One row: builds its case, runs it and computes the measures.

use super::instability;
use super::lacking;
use super::measure::Measure;
use super::plan::{Plan, Point};
use super::row_observer::RowObserver;
use super::sample::Sample;
use super::status::Status;
use crate::case::{Case, KeyValue};
use crate::error::{Error, Result};
use crate::residual::{Finding, Judge};
use crate::run::{Caution, Divergence, notes};
use crate::scene::{Checked, State};
use crate::scheme::{Method, Scheme, Stepper};
use crate::study::attractor::Attractor;
use crate::time::TimeGrid;
use crate::wear::WearWork;

/// A row of a sweep.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Row {
    /// Its number, from 0.
    pub number: u64,
    /// The realisation of its random loads, from 1; `None` unless rows have several.
    pub realisation: Option<u64>,
    /// `up` or `down` along a followed axis; `None` if no axis is followed.
    pub direction: Option<&'static str>,
    /// The values set, as in the columns of the axes.
    pub values: Vec<KeyValue>,
    /// Its status.
    pub status: Status,
    /// The reason for the status, in a sentence; of a row with results also that its motion is
    /// unstable, and why measures have no value; else empty for `ok`. Of an `unjudged` row, what
    /// another status would say if it had been judged: that stretches were handed to moreau-jean.
    pub error: String,
    /// What limits the use of its run; nothing for a row of the batch kernel, which makes no steps.
    pub caution: Caution,
    /// The measures, as in their columns; `None` for a measure without a value, and in a row that
    /// failed.
    pub measures: Vec<Option<f64>>,
    /// Its work rates at each support, W, of a realisation whose depths follow from their mean over
    /// all of the row; `None` where the support has no law of wear.
    pub rates: Vec<Option<WearWork>>,
    /// Its instants.
    pub samples: Vec<Sample>,
    /// The attractor to which its start leads; `None` if the measure is not asked for, or it was
    /// not decided.
    pub attractor: Option<Attractor>,
    /// The state at its end, from which the next row of a followed axis starts; `None` if it
    /// failed.
    pub end: Option<State>,
}

impl Row {
    /// Records the error as the reason why the row has no results.
    pub(super) fn fail(&mut self, error: &Error) {
        self.status = Status::of(error);
        self.error = sentence(error);
    }

    /// Marks a row that has results, but was not judged.
    pub(super) fn mark_unjudged(&mut self) {
        if self.status.is_good() {
            self.status = Status::Unjudged;
        }
    }
}

/// The results of the run of one row.
struct Done {
    measures: Vec<Option<f64>>,
    rates: Vec<Option<WearWork>>,
    samples: Vec<Sample>,
    end: State,
    handed: usize,
    findings: Vec<Finding>,
    caution: Caution,
    /// That its motion is unstable, and why measures have no value.
    notes: Vec<String>,
}

impl Plan {
    /// Computes the row of `point`, from the state `start` if it follows another row. The row's
    /// numbers depend on nothing else.
    pub(super) fn row(&self, point: &Point, start: Option<&State>) -> Row {
        let mut row = self.blank(point);
        let judged = self.is_judged(point.row);
        if self.asks_attractor() {
            self.lead(point, judged, &mut row);
        } else {
            self.measure(point, start, judged, &mut row);
        }
        if !judged {
            row.mark_unjudged();
        }
        row
    }

    /// Runs the row of `point`, and records its measures and instants.
    fn measure(&self, point: &Point, start: Option<&State>, judged: bool, row: &mut Row) {
        match self.build(point, start).and_then(|(case, method)| self.perform(case, method, judged)) {
            Ok(done) => {
                (row.measures, row.samples, row.end) = (done.measures, done.samples, Some(done.end));
                row.rates = done.rates;
                row.caution = done.caution;
                let mut notes = done.notes;
                if done.handed > 0 {
                    row.status = Status::Handed;
                    notes.insert(0, format!("{} stretches of impacts by moreau-jean", done.handed));
                }
                row.error = notes.join("; ");
                self.check_finite(row);
                if !done.findings.is_empty() {
                    row.status = Status::Refuted;
                    row.error = done.findings.iter().map(ToString::to_string).collect::<Vec<_>>().join("; ");
                }
            }
            Err(error) => row.fail(&error),
        }
    }

    /// The row of `point` without results.
    pub(super) fn blank(&self, point: &Point) -> Row {
        let axes = self.sweep.axes.iter().zip(&point.values);
        Row {
            number: point.row,
            realisation: point.realisation,
            direction: point.direction,
            values: axes.flat_map(|(axis, value)| axis.cells(value)).collect(),
            status: Status::Ok,
            error: String::new(),
            caution: Caution::default(),
            measures: vec![None; self.measured()],
            rates: if self.sweep.keeps_work_rates() { vec![None; self.base.scene.supports.len()] } else { Vec::new() },
            samples: Vec::new(),
            attractor: None,
            end: None,
        }
    }

    /// Number of columns of measures.
    pub(super) fn measured(&self) -> usize {
        self.sweep.measures.iter().map(|measure| measure.columns(&self.base.scene).len()).sum()
    }

    /// Gives a row with a measure that is infinite or not a number the status for that. The
    /// exponent of a change that an impact without rebound ends is −∞ by definition.
    pub(super) fn check_finite(&self, row: &mut Row) {
        let mut values = row.measures.iter();
        for measure in &self.sweep.measures {
            let columns = measure.columns(&self.base.scene);
            let strange =
                columns.into_iter().zip(values.by_ref()).find(|(_, value)| value.is_some_and(|x| !x.is_finite()));
            if let (Some((column, _)), false) = (strange, matches!(measure, Measure::Lyapunov | Measure::LyapunovError))
            {
                row.status = Status::NotFinite;
                row.error = format!("the measure {column} is infinite or not a number");
                return;
            }
        }
    }

    fn perform(&self, case: Case, method: Method, judged: bool) -> Result<Done> {
        let scene = &Checked::new(&case.scene)?;
        let mut time = case.time;
        let exact = method.scheme == Scheme::Event;
        // Nothing is recorded, so the limit on recorded rows does not apply. A spacing in the case
        // is kept, since steps end on its rows, as in `run`.
        time.sample = time.sample.or(Some(scene.duration));
        let grid =
            if exact { TimeGrid::exact(scene.duration, &time) } else { TimeGrid::stepping(scene.duration, &time) }?;
        let mut stepper = Stepper::by(scene, method, grid.step)?;
        let start = stepper.state();
        let mut observer = RowObserver::new(&self.sweep, &stepper, &time, &start)?;
        let mut judge = judged.then(|| {
            let seen = stepper.checked();
            Judge::over(seen.shared(), seen.wall_masses(), stepper.contract(), grid.step, (&start.q, &start.v))
        });
        let mut divergence = Divergence::new(&stepper, grid.step, &start);
        let mut count = 0;
        loop {
            let step = stepper.step()?;
            observer.observe(&step);
            if let Some(judge) = &mut judge {
                judge.observe(&step);
            }
            count += 1;
            if let Some(diverged) = divergence.at(step.end, step.v) {
                return Err(diverged.error(count));
            }
            let end = step.end;
            let ended = if exact { end >= scene.duration } else { stepper.index() == grid.steps };
            if ended {
                break;
            }
        }
        let energy = judge.as_ref().map(|judge| judge.residuals().energy);
        let cautions = notes::unrecorded(scene, &method.scheme, grid.step, energy.as_ref(), &stepper.counters());
        let unstable = instability::of_row(&case, scene);
        let (open, note) = (stepper.open_contacts(), observer.note());
        let observed = observer.finish(&self.sweep, &case, stepper.checked(), &open);
        let lacking = lacking::reasons(&self.sweep.measures, &observed.measures, &case);
        Ok(Done {
            measures: observed.measures,
            rates: observed.rates,
            samples: observed.samples,
            end: stepper.state(),
            handed: stepper.handed().len(),
            findings: judge.map_or_else(Vec::new, |judge| judge.findings()),
            caution: Caution {
                note: cautions.into_iter().find(|caution| !unstable.contains(caution)).or(observed.through),
                unsettled: observed.unsettled,
            },
            notes: unstable.into_iter().chain(note).chain(lacking).collect(),
        })
    }
}

/// An error in one line; if it points at a place of the case file, only what is wrong and what is
/// accepted.
fn sentence(error: &Error) -> String {
    let text = error.to_string();
    let told: Vec<&str> = match error {
        Error::Case { .. } => {
            let help = |line: &str| line.split_once("= help: ").map_or("", |(_, help)| help).to_owned();
            let first = text.lines().next().unwrap_or_default().trim_start_matches("error: ");
            let help = text.lines().map(help).find(|help| !help.is_empty());
            return help.map_or_else(|| first.to_owned(), |help| format!("{first}; {help}"));
        }
        _ => text.lines().map(str::trim).collect(),
    };
    told.join("; ")
}

#[cfg(test)]
mod tests {
    use super::Status;
    use crate::case::CaseFile;
    use crate::sweep::{Axis, Measure, Sweep};

    /// What rows say of measures of supports without a value.
    #[test]
    fn a_cell_without_a_value_has_its_reason_in_the_row() {
        let case = "[system]\nplanes = 2\n[system.oscillator]\nmass = 1.0\ndamping = 2.0\nstiffness = 1000.0\n\
                    [[support]]\nname = \"b\"\nshape = \"flats\"\nsides = 4\ngap = 1e-3\nstiffness = 1e6\n\
                    width = 0.02\nradius = 0.01\n[wear]\ncoefficient = 1e-14\nservice = 3e8\n\
                    [[load]]\ndirection = 10.0\nharmonic = { amplitude = 12.0, frequency = 5.0 }\n\
                    [time]\nend = 0.3\nstep = 1e-3\n";
        let elastic = "no impact_share_b: an elastic support has no impacts, only forces";
        let through = "; no depth_one_scar_b_m: one scar of that volume would cut the tube in two";
        for (key, values, told) in [
            ("wear.service", [3e8, 1e14], [elastic.to_owned(), format!("{elastic}{through}")]),
            ("load.1.harmonic.amplitude", [12.0, 0.1], [elastic.to_owned(), elastic.to_owned()]),
        ] {
            let axis = Axis::linear(key, values[0], values[1], 2).expect("an axis");
            let sweep = Sweep::new(CaseFile::from_text(case, "b", ".")).vary(axis);
            let plan = sweep.measure([Measure::ImpactShare, Measure::DepthOneScar]).plan().expect("a plan");
            let errors: Vec<_> = plan.rows(2).expect("rows").into_iter().map(|row| row.error).collect();
            assert_eq!(errors, told);
        }
    }

    #[test]
    fn a_row_with_a_measure_that_is_not_finite_is_not_ok() {
        let sweep = Sweep::new(CaseFile::embedded("rigid-walls-sine").expect("a case")).by("event");
        let axis = Axis::linear("load.1.harmonic.frequency", 4.0, 5.0, 2).expect("an axis");
        let sweep = sweep.vary(axis).set("time.end", 0.2).expect("an end");
        let plan = sweep.measure([Measure::Lyapunov, Measure::ForceRms, Measure::Contacts]).plan().expect("a plan");
        let sound = plan.rows(1).expect("rows").remove(0);
        // One exponent, and two walls.
        assert_eq!((sound.status, sound.measures.len()), (Status::Ok, 5));
        let with = |index: usize, value: f64| {
            let mut row = sound.clone();
            row.measures[index] = Some(value);
            plan.check_finite(&mut row);
            row
        };
        assert_eq!(with(0, f64::NEG_INFINITY).status, Status::Ok);
        for (index, column) in [(1, "force_rms_upper_N"), (2, "force_rms_lower_N"), (4, "contacts_lower")] {
            for value in [f64::NAN, f64::INFINITY] {
                let row = with(index, value);
                assert_eq!(row.status, Status::NotFinite);
                assert!(row.error.contains(column), "{}", row.error);
            }
        }
    }
}
