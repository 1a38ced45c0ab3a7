//! Checks of a sweep before its rows run.

use super::axis::Axis;
use super::follow::Follow;
use super::forcing;
use super::layout::Layout;
use super::measure::{Measure, Scope};
use super::plan::Plan;
use super::request::{Kernel, Sweep, Window};
use super::sample::Samples;
use super::strobe;
use super::target::Target;
use crate::case::{Case, KeyValue};
use crate::error::{Error, Result};
use crate::scene::Scene;
use crate::scheme::{Scheme, check_exact};
use crate::wear::{Archard, SCAR};

/// What measures over forcing periods need.
const PERIODS: &str =
    "settle and keep in forcing periods ([run] keep = { periods = N }, --keep N, keep=N in Python) beside it";

impl Sweep {
    /// Checks what varies, each axis by itself and all together, and that anything is measured.
    pub(super) fn check_axes(&self) -> Result<()> {
        if self.axes.is_empty() {
            let expected = "a key and its values, or more of them (an axis, [[vary]], --vary KEY=FROM:TO:POINTS)";
            return Err(Error::invalid("what is varied", "nothing", expected));
        }
        if self.measures.is_empty() && self.samples.is_none() {
            let known = Measure::all().map(Measure::name).collect::<Vec<_>>().join(", ");
            return Err(Error::invalid("what is measured", "nothing", format!("one measure or more of {known}")));
        }
        for axis in &self.axes {
            axis.validate(self.layout)?;
        }
        if let Some(random) = self.layout.random() {
            random.validate(self.axes.len())?;
        }
        let followed: Vec<String> =
            self.axes.iter().filter(|axis| axis.follow != Follow::No).map(Axis::label).collect();
        if followed.len() > 1 {
            return Err(Error::invalid("follow", followed.join(" and "), "one followed [[vary]] at most"));
        }
        self.unique()
    }

    /// The values of the axes in the case itself, where they are varied one at a time; an error for
    /// an axis without one.
    pub(super) fn centre(&self) -> Result<Vec<KeyValue>> {
        if self.layout != Layout::OneAtATime {
            return Ok(Vec::new());
        }
        let of = |axis: &Axis| {
            let in_case = |target: &Target| match target {
                Target::Case(key) => self.case.get(key),
                Target::Scheme => Ok(None),
            };
            let first = axis.targets.first().map(|(target, _)| in_case(target)).transpose()?.flatten();
            let value = first.filter(|value| value.number().is_some());
            let factor = axis.targets.first().map_or(1.0, |(_, factor)| *factor);
            let value = match value.as_ref().and_then(KeyValue::number) {
                Some(x) if factor != 1.0 => Some((x / factor).into()),
                _ => value,
            };
            let Some(value) = value else { return Err(no_centre(axis)) };
            for (target, expected) in axis.settings(&value) {
                if in_case(target)?.and_then(|found| found.number()) != expected.number() {
                    return Err(no_centre(axis));
                }
            }
            Ok(value)
        };
        self.axes.iter().map(of).collect()
    }

    /// An error for a key that is varied twice, or set by two axes under different names.
    pub(super) fn unique(&self) -> Result<()> {
        let all: Vec<String> =
            self.axes.iter().flat_map(|axis| &axis.targets).map(|(target, _)| target.to_string()).collect();
        let twice =
            all.iter().enumerate().find(|(index, target)| all.iter().take(*index).any(|other| other == *target));
        twice.map_or(Ok(()), |(_, target)| {
            Err(Error::invalid("[[vary]] key", format!("{target}, twice"), "each key once"))
        })
    }

    /// Refuses fewer forcing periods than the measures need.
    fn check_kept(&self, keep: u32) -> Result<()> {
        let refuse = |expected: String| Err(Error::invalid("[run] keep", keep, expected));
        let repeats = self.measures.contains(&Measure::Period);
        match keep {
            0 => refuse("one forcing period or more".to_owned()),
            _ if repeats && (keep as usize) < strobe::LEAST_KEPT => {
                refuse(format!("{} forcing periods or more for the measure period", strobe::LEAST_KEPT))
            }
            _ => Ok(()),
        }
    }

    /// An error for settings of time that contradict one another.
    pub(super) fn times(&self, base: &Case) -> Result<()> {
        let axes = || self.axes.iter().flat_map(|axis| &axis.targets);
        let varies = |key: &str| axes().any(|(target, _)| target.to_string() == key);
        if self.window != Window::Case
            && let Some(key) = ["time.end", "time.statistics_from"].into_iter().find(|key| varies(key))
        {
            return Err(Error::invalid("[[vary]] key", key, "no settle and keep beside it: they set the same"));
        }
        match self.window {
            Window::Case => {}
            Window::Periods { settle, keep } if settle.checked_add(keep).is_none_or(|all| all == u32::MAX) => {
                let found = format_args!("{settle} + {keep} periods");
                return Err(Error::invalid("[run] settle and keep", found, "less than 2^32 - 1 periods in all"));
            }
            Window::Periods { keep, .. } => {
                self.check_kept(keep)?;
                base.check_repeats()?;
                forcing::period(&base.scene)?;
            }
            Window::Seconds { settle, keep } => {
                if !(settle.is_finite() && settle >= 0.0) {
                    return Err(Error::invalid(
                        "[run] settle",
                        format_args!("{settle:?} s"),
                        "a finite time, 0 or more",
                    ));
                }
                if !(keep.is_finite() && keep > 0.0) {
                    return Err(Error::invalid("[run] keep", format_args!("{keep:?} s"), "a finite time above 0"));
                }
            }
        }
        let periods = matches!(self.window, Window::Periods { .. });
        if let Some(measure) = self.measures.iter().find(|measure| measure.needs_period()).filter(|_| !periods) {
            return Err(Error::invalid("[measure] columns", measure, PERIODS));
        }
        if self.samples == Some(Samples::Periods) && !periods {
            return Err(Error::invalid("[measure] samples", "\"periods\"", PERIODS));
        }
        let Some(followed) = self.followed().and_then(|index| self.axes.get(index)) else { return Ok(()) };
        if !periods && forcing::has_sine(&base.scene) {
            let expected = "settle and keep in forcing periods beside it, so that the load goes on \
                at the phase at which the last row ended";
            return Err(Error::invalid("follow", followed.label(), expected));
        }
        let shapes = |(target, _): &(Target, f64)| matches!(target, Target::Case(key) if key.shapes_system());
        if base.truncated.is_some() && followed.targets.iter().any(shapes) {
            let expected = "a key outside [system]: the state of a case cut to modes is that of \
                its modes, which change with the system";
            return Err(Error::invalid("follow", followed.label(), expected));
        }
        Ok(())
    }
}

impl Sweep {
    /// An error where the exact motion is needed and `scene` has none: before the settings that
    /// belong to it are looked at, of which none is at fault.
    pub(super) fn check_exact(&self, scene: &Scene) -> Result<()> {
        if let Some(measure) = self.measures.iter().find(|measure| measure.needs_event()) {
            check_exact(scene, format!("the measure {measure}"))?;
        }
        if self.kernel == Kernel::Batch { check_exact(scene, "kernel = \"batch\"") } else { Ok(()) }
    }
}

/// The error of an axis that is varied from the case, which gives it no value.
fn no_centre(axis: &Axis) -> Error {
    let key = axis.targets.first().map_or_else(String::new, |(target, _)| target.to_string());
    let expected = format!(
        "a key to which the case gives one number, from which it is varied: set it (--set '{key}=VALUE'), or vary \
         each value that * stands for by its own key"
    );
    Error::invalid(format!("[[vary]] {}", axis.label()), "varied one at a time", expected)
}

impl Plan {
    /// An error for steps that the exact scheme does not take, and for a measure that takes the
    /// derivative with respect to the start if the scheme has none.
    pub(super) fn check_event(&self) -> Result<()> {
        let mut targets = self.sweep.axes.iter().flat_map(|axis| &axis.targets).map(|(target, _)| target);
        if self.method.scheme == Scheme::Event
            && !self.sweep.varies_scheme()
            && let Some(key) = targets.find(|target| target.is_step())
        {
            let expected = "a scheme that has a step, of which event has none: all rows would be the same";
            return Err(Error::invalid("[[vary]] key", key, expected));
        }
        let asked = self.sweep.measures.iter().find(|measure| measure.needs_event());
        match asked.filter(|_| self.method.scheme != Scheme::Event || self.sweep.varies_scheme()) {
            Some(measure) => Err(Error::invalid(
                "[measure] columns",
                measure,
                format!("scheme = \"event\" in [run] (--scheme event) beside it, not {}", self.method),
            )),
            None => Ok(()),
        }
    }

    /// An error for a measure, or for instants, of places that the case does not have.
    pub(super) fn check_places(&self) -> Result<()> {
        let scene = &self.base.scene;
        let has = |measure: &Measure| !measure.columns(scene).is_empty();
        let lacks = |scope: Scope| match scope {
            Scope::Probe => "no probe",
            Scope::Support => "no support in two planes",
            Scope::Wall | Scope::Place | Scope::Row => "no wall",
        };
        if let Some(measure) = self.sweep.measures.iter().find(|measure| !has(measure)) {
            let known = Measure::all().filter(has).map(Measure::name).collect::<Vec<_>>().join(", ");
            let expected = format!("one of {known}: the case has {}", lacks(measure.scope()));
            return Err(Error::invalid("[measure] columns", measure, expected));
        }
        let laws: Vec<Archard> = (0..scene.supports.len()).filter_map(|index| self.base.archard(index)).collect();
        if let Some(measure) = self.sweep.measures.iter().find(|measure| measure.needs_law() && laws.is_empty()) {
            let expected = "work_rate, or coefficient and service in [wear] beside it";
            return Err(Error::invalid("[measure] columns", measure, expected));
        }
        let has_scar = || laws.iter().any(|law| law.scar.is_some());
        if let Some(measure) = self.sweep.measures.iter().find(|measure| measure.needs_scar() && !has_scar()) {
            let expected = format!("worn_volume, or {SCAR}");
            return Err(Error::invalid("[measure] columns", measure, expected));
        }
        if self.sweep.samples == Some(Samples::Impacts) && scene.walls.is_empty() {
            let expected = "\"periods\": the case has no wall";
            return Err(Error::invalid("[measure] samples", "\"impacts\"", expected));
        }
        Ok(())
    }

    /// An error for an axis none of whose values gives a valid case: it is better reported now than
    /// as a table of failed rows.
    pub(super) fn try_values(&self) -> Result<()> {
        let middle = |count: u64| count / 2;
        for axis in &self.sweep.axes {
            let tries = [(0, 0.001), (middle(axis.values.count()), 0.5), (axis.values.count() - 1, 0.999)];
            let mut failure = None;
            for (number, share) in tries {
                let mut file = self.sweep.case.clone();
                let value = axis.values.at(number, share);
                let set = axis.settings(&value).try_for_each(|(target, value)| match target {
                    Target::Case(key) => file.set(key, &value),
                    Target::Scheme => self.base.method(&value.to_string()).map(drop),
                });
                match set.and_then(|()| file.case()) {
                    Ok(_) => {
                        failure = None;
                        break;
                    }
                    Err(error) => failure = failure.or(Some(error)),
                }
            }
            // Values that are valid only together with those of another axis, such as both walls
            // moved past the body, are checked row by row.
            if let Some(error) = failure.filter(|_| self.sweep.axes.len() == 1 || !self.any_works()) {
                return Err(error);
            }
        }
        Ok(())
    }

    /// True if one of a few rows gives a valid case.
    fn any_works(&self) -> bool {
        let last = self.chains - 1;
        let places = [0, self.chain_rows() / 2];
        [0, last / 3, last / 2, last]
            .iter()
            .any(|&chain| places.iter().any(|&place| self.build(&self.point(chain, place), None).is_ok()))
    }
}
