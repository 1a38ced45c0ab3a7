//! Rows that find the attractor to which their start leads.

use super::attractors::{Attractors, CHAOTIC, QUIET, TOLD};
use super::measure::Measure;
use super::plan::{Plan, Point};
use super::request::Window;
use super::row::Row;
use super::status::Status;
use crate::error::{Error, Result};
use crate::output::csv::digits;
use crate::residual::Judge;
use crate::scene::{Checked, Scene};
use crate::scheme::Scheme;
use crate::study::attractor::{Attractor, Lasts, MOST_FREEDOM, follow};
use nalgebra::Complex;

impl Plan {
    /// True if rows find their attractors.
    pub(super) fn asks_attractor(&self) -> bool {
        self.sweep.measures.contains(&Measure::Attractor)
    }

    /// The column with the numbers of attractors, if the sweep has one.
    pub(super) fn attractor_column(&self) -> Option<usize> {
        let at = || self.header().iter().position(|column| column == Measure::Attractor.name());
        self.asks_attractor().then(at).flatten()
    }

    /// Refuses settings that cannot be combined with attractors.
    pub(super) fn check_attractor(&self) -> Result<()> {
        if !self.asks_attractor() {
            return Ok(());
        }
        let refuse = |key: &'static str, found: String, expected: &str| {
            Err(Error::invalid(key, found, format!("{expected} beside the measure attractor")))
        };
        let other = |measure: &&Measure| !matches!(measure, Measure::Attractor | Measure::Period);
        if let Some(measure) = self.sweep.measures.iter().find(other) {
            let expected = "period at most: rows end as soon as their attractor is certain,";
            return refuse("[measure] columns", measure.to_string(), expected);
        }
        if let Some(samples) = self.sweep.samples {
            return refuse("[measure] samples", format!("{samples:?}").to_lowercase(), "no samples");
        }
        let starts = |key: &str| key.starts_with("initial.");
        let targets = self.sweep.axes.iter().flat_map(|axis| &axis.targets);
        if let Some(key) = targets.map(|(target, _)| target.to_string()).find(|key| !starts(key)) {
            return refuse(
                "[[vary]] key",
                key,
                "initial.displacement and initial.velocity, of one system and its loads,",
            );
        }
        if self.chain_rows() > 1 {
            return refuse("follow", "given".to_owned(), "no followed value: each row has a start of its own");
        }
        let n = self.base.scene.system.degrees_of_freedom();
        if n > MOST_FREEDOM {
            return refuse("system", format!("{n} degrees of freedom"), &format!("at most {MOST_FREEDOM}"));
        }
        Ok(())
    }

    /// Computes the row of `point`: the attractor to which its start leads.
    pub(super) fn lead(&self, point: &Point, judged: bool, row: &mut Row) {
        match self.attractor(point, judged) {
            Ok((attractor, findings)) => {
                let tell = |measure: &Measure| match measure {
                    Measure::Period => attractor.as_ref().and_then(Attractor::period).map(|n| n as f64),
                    _ => None,
                };
                row.measures = self.sweep.measures.iter().map(tell).collect();
                row.attractor = attractor;
                if !findings.is_empty() {
                    (row.status, row.error) = (Status::Refuted, findings);
                }
            }
            Err(error) => row.fail(&error),
        }
    }

    /// The attractor, and the findings of the judge.
    fn attractor(&self, point: &Point, judged: bool) -> Result<(Option<Attractor>, String)> {
        let (case, _) = self.build(point, None)?;
        let Window::Periods { settle, keep } = self.sweep.window else { return Ok((None, String::new())) };
        let period = super::forcing::period(&case.scene)?;
        let scene = &Checked::new(&case.scene)?;
        let initial = crate::scheme::Stepper::by(scene, Scheme::Event.into(), period)?.state();
        let mut judge = judged.then(|| {
            let contract = Scheme::Event.contract();
            Judge::over(scene.shared(), scene.wall_masses(), contract, period, (&initial.q, &initial.v))
        });
        let attractor = follow(scene, period, [settle, keep], |step| {
            if let Some(judge) = &mut judge {
                judge.observe(step);
            }
        })?;
        let findings = judge.map_or_else(Vec::new, |judge| judge.findings());
        Ok((attractor, findings.iter().map(ToString::to_string).collect::<Vec<_>>().join("; ")))
    }

    /// Numbers the attractors of `rows`, which are in order.
    pub(super) fn number(&self, rows: &mut [Row]) {
        let place = self.sweep.measures.iter().position(|measure| *measure == Measure::Attractor);
        let Some(place) = place else { return };
        let mut attractors = Attractors::default();
        for row in rows {
            let Some(attractor) = &row.attractor else { continue };
            let number = attractors.number(&described(attractor, &self.base.scene));
            if let Some(cell) = row.measures.get_mut(place) {
                *cell = Some(number as f64);
            }
        }
    }
}

/// The description of a row's attractor: the cells of [`TOLD`].
pub(super) fn described(attractor: &Attractor, scene: &Scene) -> Vec<String> {
    let Attractor::Periodic { strobes, touches, multipliers } = attractor else {
        let mut cells = vec![String::new(); TOLD.len()];
        CHAOTIC.clone_into(&mut cells[0]);
        return cells;
    };
    let wall = |index: usize| scene.wall_name(index).unwrap_or_default();
    let signature = touches.iter().map(|touch| match touch.lasts {
        Lasts::Rest => format!("{}:rest", wall(touch.wall)),
        Lasts::Chatter => format!("{}:chatter", wall(touch.wall)),
        Lasts::Always => format!("{}:always", wall(touch.wall)),
        _ => wall(touch.wall).to_owned(),
    });
    let signature: Vec<String> = signature.collect();
    let list = |numbers: &mut dyn Iterator<Item = f64>| numbers.map(|x| digits(Some(x))).collect::<Vec<_>>().join(" ");
    let complex = |m: &Complex<f64>| match m.im {
        0.0 => digits(Some(m.re)),
        im => format!("{}{}{}i", digits(Some(m.re)), if im < 0.0 { "" } else { "+" }, digits(Some(im))),
    };
    vec![
        if signature.is_empty() { QUIET.to_owned() } else { signature.join(" ") },
        strobes.len().to_string(),
        list(&mut touches.iter().map(|touch| touch.phase)),
        list(&mut touches.iter().map(|touch| touch.speed)),
        multipliers.iter().map(complex).collect::<Vec<_>>().join(" "),
        list(&mut strobes.iter().flat_map(|state| state.q.iter().copied())),
        list(&mut strobes.iter().flat_map(|state| state.v.iter().copied())),
    ]
}
