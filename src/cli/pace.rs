//! Estimates how long a run will take, and what determines this.

use crate::scene::{LoadKind, Scene, System};
use crate::scheme::{Method, Scheme, Stepper};
use crate::study::choice::choose;
use std::f64::consts::TAU;
use std::time::{Duration, Instant};

/// Seconds: a shorter remainder is not reported.
const WORTH_SAYING: f64 = 2.0;

/// A finished share below this is too small to extrapolate from.
const SEEN: f64 = 1e-12;

/// Most periods of the fastest motion that an estimate of one degree of freedom steps before it
/// looks at the clock again: the exact scheme searches each of them for a contact.
const PERIODS_A_LOOK: f64 = 1e3;

/// How long a run is tried where no part of the work has finished yet.
const TRIAL: Duration = Duration::from_millis(300);

/// Structures with more degrees of freedom take too long to set up and are not tried beside the run
/// itself; after [`UNKNOWN`] seconds the tool says that the duration is not known.
const FEW: usize = 2000;
const UNKNOWN: f64 = 10.0;

/// What the duration of the work depends on.
#[derive(Debug, Clone)]
pub struct Pace {
    /// Description of all steps, such as `200000 steps of 5e-5 s`.
    cause: String,
    /// Runs from whose cost the duration is estimated while no share of the work is done.
    parts: Vec<Part>,
}

/// A run of the work, or one of several kinds of runs in it.
#[derive(Debug, Clone)]
struct Part {
    scene: Scene,
    method: Method,
    step: f64,
    /// Number of such runs, or of runs that cost the same in all.
    runs: f64,
    /// Words before and after the time that these runs take together.
    words: [&'static str; 2],
}

/// Estimate from a short piece of a run.
#[derive(Debug, Clone)]
pub struct Estimate {
    /// Wall-clock time of the whole run, s.
    pub seconds: f64,
    /// What decides that time.
    pub cause: String,
}

impl Pace {
    /// The pace of `method` on `scene` with steps of `step` seconds.
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
        let part = Part { scene: scene.clone(), method: *method, step, runs: 1.0, words: ["about", "more"] };
        Self { cause, parts: vec![part] }
    }

    /// The same for work that consists of `runs` such runs.
    #[must_use]
    pub fn times(mut self, runs: f64) -> Self {
        self.parts.iter_mut().for_each(|part| part.runs *= runs);
        self
    }

    /// The pace of a comparison of `methods` with each other and with the exact scheme.
    #[must_use]
    pub fn of_all(scene: &Scene, methods: &[Method], step: f64) -> Self {
        let exact = Self::of(scene, &Method::new(Scheme::Event), step);
        let stepping = methods.iter().find(|method| method.scheme != Scheme::Event);
        let others = stepping.map(|method| Self::of(scene, method, step).cause);
        let cause = match others {
            Some(others) => format!("{}; the others take {others}", exact.cause),
            None => exact.cause.clone(),
        };
        Self { cause, ..exact.each() }
    }

    /// The pace of a search for an error, by `method` if one is asked for, with at most
    /// `most_steps` steps: the exact motion several times, and steps halved until the error is
    /// kept.
    #[must_use]
    pub fn of_search(scene: &Scene, method: Option<Method>, step: f64, most_steps: u64) -> Self {
        let exact = Self::of(scene, &Method::new(Scheme::Event), step).each();
        let method = method.filter(|m| m.scheme != Scheme::Event).unwrap_or_else(|| choose(scene).method);
        let finest = Self::of(scene, &method, scene.duration / most_steps as f64);
        let cause =
            format!("{}; steps are halved until there are {:.1e} of them at most", exact.cause, most_steps as f64);
        let mut parts = exact.parts;
        // Recording and judging cost about as much as stepping; all coarser runs together cost as
        // much as the finest.
        parts.extend(finest.parts.into_iter().map(|part| Part { runs: 4.0, words: ["at most about", "more"], ..part }));
        // The exact motion of a structure is given up after about a second if it has too many
        // events.
        parts.retain(|part| part.method.scheme != Scheme::Event || matches!(scene.system, System::Oscillator(_)));
        Self { cause, parts }
    }

    /// The pace of a chart of `methods`, each at several steps, where no run may take longer than
    /// `longest` (s).
    #[must_use]
    pub fn of_chart(scene: &Scene, methods: &[Method], levels: u32, longest: f64) -> Self {
        let exact = Self::of(scene, &Method::new(Scheme::Event), scene.duration).each();
        let cause = format!(
            "{} at up to {levels} steps each, --longest {longest} s a run; {}",
            counted(methods.len(), "method"),
            exact.cause
        );
        Self { cause, parts: exact.parts }
    }

    /// The pace of the study of energy and lasting contacts: `runs` runs of about equal cost, and
    /// the exact motion.
    #[must_use]
    pub fn of_contacts(scene: &Scene, step: f64, runs: f64) -> Self {
        let moreau = Method::new(Scheme::MoreauJean { theta: 0.5 });
        let Self { cause, mut parts } = Self::of_all(scene, &[moreau], step);
        parts.extend(Self::of(scene, &moreau, step).times(runs).parts);
        Self { cause, parts }
    }

    /// The pace of maps with `rows` rows and `work` steps in all.
    #[must_use]
    pub fn of_maps(scene: &Scene, work: u64, rows: usize) -> Self {
        let n = scene.system.degrees_of_freedom();
        let unknowns = if n > 1 { format!(" with {n} unknowns") } else { String::new() };
        let cause = format!(
            "{:.1e} steps{unknowns} in {}, set by the slowest frequency and time.end",
            work as f64,
            counted(rows, "row")
        );
        Self { cause, parts: Vec::new() }
    }

    /// For work whose number of runs is not known, each of which may take long.
    fn each(mut self) -> Self {
        self.parts.iter_mut().for_each(|part| part.words = ["about", "for each run of the exact motion"]);
        self
    }

    /// The message after `elapsed`, with `share` of the work done; `None` if the work ends soon.
    #[must_use]
    pub(super) fn line(&self, elapsed: Duration, share: f64) -> Option<String> {
        let elapsed = elapsed.as_secs_f64();
        if share >= 1.0 {
            return None;
        }
        if share > SEEN {
            let left = elapsed * (1.0 - share) / share;
            return (left >= WORTH_SAYING).then(|| format!("about {} more: {}", words(left), self.cause));
        }
        // No part of the work has finished: either a single step takes this long, or the work
        // before the first step does.
        let (tried, untried): (Vec<&Part>, Vec<&Part>) =
            self.parts.iter().partition(|part| part.scene.system.degrees_of_freedom() <= FEW);
        let line = |part: &Part| {
            let seconds = part.runs * estimate(&part.scene, &part.method, part.step, TRIAL)?.seconds;
            let [before, after] = part.words;
            let said = || format!("{before} {} {after}: {}", words(seconds), self.cause);
            (seconds.is_finite() && seconds >= WORTH_SAYING).then(said)
        };
        let unknown = || format!("how long it takes is not known after {elapsed:.0} s: {}", self.cause);
        tried.into_iter().find_map(line).or_else(|| (!untried.is_empty() && elapsed >= UNKNOWN).then(unknown))
    }
}

/// `1 row`, `12 rows`.
fn counted(count: usize, what: &str) -> String {
    format!("{count} {what}{}", if count == 1 { "" } else { "s" })
}

/// Steps `scene` by `method` for at most `patience`, and estimates from that how long the whole run
/// takes; `None` if it cannot start. Recording and judging are not included: they cost about as
/// much again. The exact scheme of one degree of freedom is stopped every thousand periods,
/// whatever `step` is, since between two contacts it may have to search any number of periods.
#[must_use]
pub fn estimate(scene: &Scene, method: &Method, step: f64, patience: Duration) -> Option<Estimate> {
    let started = Instant::now();
    let exact = method.scheme == Scheme::Event;
    let stride = match scene.system {
        System::Oscillator(_) if exact => step.min(PERIODS_A_LOOK * TAU / fastest(scene).0),
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
    Some(Estimate { seconds, cause: Pace::of(scene, method, step).cause })
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
            (TAU * frequency, format!("load {} of {frequency:.3e} Hz", index + 1))
        }
        _ => (mode, format!("the fastest mode, {:.3e} Hz,", mode / TAU)),
    }
}

/// A time in words: `3.2 s`, `4 min`, `7.5 h`, `12 days`, `3e4 years`.
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
    use crate::scene::{Load, Wall};

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
        let pace = Pace { cause: "reasons".to_owned(), parts: Vec::new() };
        let second = Duration::from_secs(1);
        assert_eq!(pace.line(second, 0.01).as_deref(), Some("about 99 s more: reasons"));
        assert!(pace.line(second, 0.9).is_none() && pace.line(second, 1.0).is_none());
    }

    /// One degree of freedom at 100 THz, with a wall that it does not reach: the whole run is a
    /// single step of the exact scheme, which takes hours.
    fn stiff() -> Scene {
        let scene = Scene::oscillator(1.0, 0.0, 4e29).with_wall(Wall::upper("stop", 1.0)).with_duration(10.0);
        scene.with_load(Load::harmonic(1.0, 25.0, 0.0))
    }

    #[test]
    fn work_of_which_nothing_is_done_is_told_from_a_trial() {
        let second = Duration::from_secs(1);
        let event = Method::new(Scheme::Event);
        let moreau = Method::new(Scheme::MoreauJean { theta: 0.5 });
        let of = |pace: Pace| pace.line(second, 0.0).unwrap_or_default();
        let run = of(Pace::of(&stiff(), &event, 1e-4));
        assert!(run.starts_with("about ") && run.contains(" more: ") && run.contains("the fastest mode, 1.0"), "{run}");
        for each in [
            Pace::of_all(&stiff(), &[moreau], 1e-4),
            Pace::of_search(&stiff(), None, 1e-4, 1 << 24),
            Pace::of_chart(&stiff(), &[moreau, event], 8, 1.0),
        ] {
            let line = of(each);
            assert!(line.contains("for each run of the exact motion: ") && line.contains("the fastest mode"), "{line}");
            assert!(["h for", "days", "years"].iter().any(|unit| line.contains(unit)), "{line}");
        }
        // A run of a moment gets no message.
        let soon = Scene::oscillator(1.0, 0.0, 100.0).with_wall(Wall::upper("stop", 1.0));
        assert_eq!(Pace::of(&soon, &event, 1e-4).line(second, 0.0), None);
        // Where the steps of the finest run decide.
        let many = of(Pace::of_search(&soon, Some(moreau), 1e-4, 10_000_000_000));
        assert!(many.starts_with("at most about ") && many.contains("1.0e10 of them at most"), "{many}");
        // Twice as many runs take about twice as long: both are measured, so only within a small
        // factor.
        let seconds = |runs: f64| {
            let pace = Pace::of(&stiff(), &moreau, 1e-9).times(runs);
            let part = &pace.parts[0];
            part.runs * estimate(&part.scene, &part.method, part.step, TRIAL).map_or(0.0, |e| e.seconds)
        };
        assert!(seconds(100.0) > 5.0 * seconds(1.0));
    }
}
