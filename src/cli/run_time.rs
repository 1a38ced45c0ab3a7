//! The wall-clock time of a run, from a short trial of it, and what decides it; times in words.

use crate::error::amount;
use crate::scene::{LoadKind, Scene, System};
use crate::scheme::{Method, Scheme, Stepper};
use std::f64::consts::TAU;
use std::time::{Duration, Instant};

/// Most periods of the fastest motion that a trial of one degree of freedom steps before it looks
/// at the clock again: the exact scheme searches each of them for a contact.
const PERIODS_PER_LOOK: f64 = 1e3;

/// Wall-clock time of a run, estimated from a short piece of it.
#[derive(Debug, Clone)]
pub struct RunTime {
    /// Of the whole run, s.
    pub seconds: f64,
    /// What decides that time.
    pub cause: String,
}

/// Steps `scene` by `method` for at most `patience`, and estimates from that how long the whole run
/// takes; `None` if it cannot start. Recording and judging are not included: they cost about as
/// much again. The exact scheme of one degree of freedom is stopped every thousand periods,
/// whatever `step` is, since between two contacts it may have to search any number of periods.
#[must_use]
pub fn run_time(scene: &Scene, method: &Method, step: f64, patience: Duration) -> Option<RunTime> {
    let started = Instant::now();
    let exact = method.scheme == Scheme::Event;
    let stride = match scene.system {
        System::Oscillator(_) if exact => step.min(PERIODS_PER_LOOK * TAU / fastest(scene).0),
        _ => step,
    };
    let mut stepper = Stepper::new(scene, method, stride).ok()?;
    let setup = started.elapsed().as_secs_f64();
    let stepping = Instant::now();
    let mut time = 0.0;
    while time < scene.duration && stepping.elapsed() < patience {
        // The clock is read rarely, since a step may take nanoseconds.
        for _ in 0..if exact { 1 } else { 64 } {
            time = stepper.step().ok()?.end;
        }
    }
    let share = (time / scene.duration).min(1.0);
    let seconds = if share > 0.0 { setup + stepping.elapsed().as_secs_f64() / share } else { f64::INFINITY };
    Some(RunTime { seconds, cause: steps_in_words(scene, method, step) })
}

/// How many steps `method` takes on `scene`, and what sets their number.
pub(super) fn steps_in_words(scene: &Scene, method: &Method, step: f64) -> String {
    if method.scheme != Scheme::Event {
        let count = (scene.duration / step).ceil();
        let unknowns = unknowns_in_words(scene);
        let step = amount(step, 4);
        return format!("{count:.1e} steps of {step} s{unknowns}, set by time.end and time.step");
    }
    let (rate, what) = fastest(scene);
    if let System::Structure(_) = scene.system {
        let count = (0.5 * rate * scene.duration).ceil();
        format!("the exact scheme follows {what} in at least {count:.1e} stretches, and stops at every contact")
    } else if rate == 0.0 {
        "the exact scheme goes from contact to contact".to_owned()
    } else {
        let count = amount(rate * scene.duration / TAU, 2);
        format!("the exact scheme goes from contact to contact; {what} has {count} periods in the run")
    }
}

pub(super) fn unknowns_in_words(scene: &Scene) -> String {
    let n = scene.system.degrees_of_freedom();
    if n > 1 { format!(" with {n} unknowns") } else { String::new() }
}

/// The fastest angular frequency that the exact scheme follows, rad/s, and its origin.
fn fastest(scene: &Scene) -> (f64, String) {
    let [_, mode] = scene.system.frequencies();
    let harmonic = |kind: &LoadKind| match kind {
        LoadKind::Harmonic { frequency, .. } => Some(*frequency),
        _ => None,
    };
    let loads = scene.loads.iter().enumerate().filter_map(|(i, load)| Some((i, harmonic(&load.kind)?)));
    match loads.max_by(|a, b| a.1.total_cmp(&b.1)) {
        Some((index, frequency)) if TAU * frequency > mode => {
            (TAU * frequency, format!("load {} of {} Hz", index + 1, amount(frequency, 4)))
        }
        _ => (mode, format!("the fastest mode, {} Hz,", amount(mode / TAU, 4))),
    }
}

/// A time in words: `3.2 s`, `4 min`, `7.5 h`, `12 days`, `3e4 years`.
#[must_use]
pub fn time_in_words(seconds: f64) -> String {
    const MINUTE: f64 = 60.0;
    const HOUR: f64 = 60.0 * MINUTE;
    const DAY: f64 = 24.0 * HOUR;
    const YEAR: f64 = 365.25 * DAY;
    match seconds {
        s if !s.is_finite() => "an unknown time".to_owned(),
        s if s < 1e-3 => "less than a millisecond".to_owned(),
        s if s < 1.0 => format!("{:.0} ms", 1e3 * s),
        s if s < 10.0 => format!("{s:.1} s"),
        s if s < 2.0 * MINUTE => format!("{s:.0} s"),
        s if s < 2.0 * HOUR => format!("{:.0} min", s / MINUTE),
        s if s < 2.0 * DAY => format!("{:.1} h", s / HOUR),
        s if s < 2.0 * YEAR => format!("{:.0} days", s / DAY),
        s if s < 1e4 * YEAR => format!("{:.0} years", s / YEAR),
        s => format!("{:.0e} years", s / YEAR),
    }
}

#[cfg(test)]
mod tests {
    use super::time_in_words;

    #[test]
    fn times_are_told_in_words() {
        for (seconds, text) in [
            (0.25, "250 ms"),
            (3.21, "3.2 s"),
            (300.0, "5 min"),
            (36_000.0, "10.0 h"),
            (1e15, "3e7 years"),
            (f64::INFINITY, "an unknown time"),
        ] {
            assert_eq!(time_in_words(seconds), text);
        }
    }
}
