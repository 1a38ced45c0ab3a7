//! How long a run will take, and what sets it.

use crate::scene::{LoadKind, Scene, System};
use crate::scheme::{Method, Scheme, Stepper};
use std::f64::consts::TAU;
use std::time::{Duration, Instant};

/// Shorter remainders are not worth a line.
const WORTH_SAYING: f64 = 2.0;

/// What the pace of a run follows from, in words.
#[derive(Debug, Clone)]
pub struct Pace {
    /// Of all of the run: `200000 steps of 5e-5 s`.
    cause: String,
}

/// What a moment of a run told about all of it.
#[derive(Debug, Clone)]
pub struct Estimate {
    /// Of the whole run, s of wall-clock time.
    pub seconds: f64,
    /// What sets that.
    pub cause: String,
}

impl Pace {
    /// What sets the pace of `method` on `scene` with steps of `step` seconds.
    #[must_use]
    pub fn of(scene: &Scene, method: &Method, step: f64) -> Self {
        let cause = if method.scheme == Scheme::Event {
            let (rate, what) = fastest(scene);
            match scene.system {
                System::Structure(_) => {
                    let count = (0.5 * rate * scene.duration).ceil();
                    format!(
                        "the exact scheme follows {what} in at least {count:.1e} stretches, and stops at every contact"
                    )
                }
                System::Oscillator(_) => {
                    let count = rate * scene.duration / TAU;
                    format!("the exact scheme goes from contact to contact; {what} has {count:.1e} periods in the run")
                }
            }
        } else {
            let n = scene.system.degrees_of_freedom();
            let unknowns = if n > 1 { format!(" with {n} unknowns") } else { String::new() };
            format!(
                "{:.1e} steps of {step:e} s{unknowns}, set by time.end and time.step",
                (scene.duration / step).ceil()
            )
        };
        Self { cause }
    }

    /// The same of a comparison of `methods` with each other and with the exact scheme.
    #[must_use]
    pub fn of_all(scene: &Scene, methods: &[Method], step: f64) -> Self {
        let exact = Self::of(scene, &Method::new(Scheme::Event), step).cause;
        let stepping = methods.iter().find(|method| method.scheme != Scheme::Event);
        let others = stepping.map(|method| Self::of(scene, method, step).cause);
        Self { cause: others.map_or_else(|| exact.clone(), |others| format!("{exact}; the others take {others}")) }
    }

    /// The line that is said once `elapsed` has gone by and `share` of the work is done; none where it is over soon.
    #[must_use]
    pub(super) fn line(&self, elapsed: Duration, share: f64) -> Option<String> {
        if share >= 1.0 {
            return None;
        }
        let elapsed = elapsed.as_secs_f64();
        if share <= 0.0 {
            return Some(format!("no end in sight after {elapsed:.0} s: {}", self.cause));
        }
        let left = elapsed * (1.0 - share) / share;
        let shown = || format!("about {} more: {}", words(left), self.cause);
        (left >= WORTH_SAYING).then(shown)
    }
}

/// Steps `scene` by `method` for at most `patience` and tells from that how long all of it takes; none where it cannot
/// even start. Recording and judging are not in it: they cost about as much again.
#[must_use]
pub fn estimate(scene: &Scene, method: &Method, step: f64, patience: Duration) -> Option<Estimate> {
    let started = Instant::now();
    let exact = method.scheme == Scheme::Event;
    let mut stepper = Stepper::with_backend(scene, &method.scheme, step, method.backend).ok()?;
    let setup = started.elapsed().as_secs_f64();
    let stepping = Instant::now();
    let mut time = 0.0;
    while time < scene.duration && stepping.elapsed() < patience {
        // Few looks at the clock where steps take nanoseconds.
        for _ in 0..if exact { 1 } else { 64 } {
            time = stepper.step().ok()?.end;
        }
    }
    let share = (time / scene.duration).min(1.0);
    let seconds = if share > 0.0 { setup + stepping.elapsed().as_secs_f64() / share } else { f64::INFINITY };
    Some(Estimate { seconds, cause: Pace::of(scene, method, step).cause })
}

/// The fastest angular frequency that the exact scheme follows, rad/s, and what it belongs to.
fn fastest(scene: &Scene) -> (f64, String) {
    let [_, mode] = scene.system.frequencies();
    let harmonic = |kind: &LoadKind| match kind {
        LoadKind::Harmonic { frequency, .. } => Some(*frequency),
        _ => None,
    };
    let loads = scene.loads.iter().enumerate().filter_map(|(i, load)| Some((i, harmonic(&load.kind)?)));
    match loads.max_by(|a, b| a.1.total_cmp(&b.1)) {
        Some((index, frequency)) if TAU * frequency > mode => {
            (TAU * frequency, format!("load {} of {frequency:.3e} Hz", index + 1))
        }
        _ => (mode, format!("the fastest mode, {:.3e} Hz,", mode / TAU)),
    }
}

/// A time in the words of people: `3.2 s`, `4 min`, `7.5 h`, `12 days`, `3e4 years`.
#[must_use]
pub fn words(seconds: f64) -> String {
    const MINUTE: f64 = 60.0;
    const HOUR: f64 = 60.0 * MINUTE;
    const DAY: f64 = 24.0 * HOUR;
    const YEAR: f64 = 365.25 * DAY;
    match seconds {
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
    use super::*;

    #[test]
    fn times_are_told_in_words() {
        for (seconds, text) in
            [(0.25, "250 ms"), (3.21, "3.2 s"), (300.0, "5 min"), (36_000.0, "10.0 h"), (1e15, "3e7 years")]
        {
            assert_eq!(words(seconds), text);
        }
    }

    #[test]
    fn the_pace_is_extrapolated_from_what_is_done() {
        let pace = Pace { cause: "reasons".to_owned() };
        let second = Duration::from_secs(1);
        assert_eq!(pace.line(second, 0.01).as_deref(), Some("about 99 s more: reasons"));
        assert!(pace.line(second, 0.9).is_none());
        assert!(pace.line(second, 0.0).is_some_and(|line| line.contains("no end in sight")));
    }
}
