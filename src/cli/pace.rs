//! How long a run will take, and what sets it.

use crate::scene::{LoadKind, Scene, System};
use crate::scheme::{Method, Scheme, Stepper};
use crate::study::choice::choose;
use std::f64::consts::TAU;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::mpsc::{RecvTimeoutError, Sender, TryRecvError, channel};
use std::time::{Duration, Instant};

/// Shorter remainders are not worth a line.
const WORTH_SAYING: f64 = 2.0;

/// A share below this says nothing of the rest.
const SEEN: f64 = 1e-12;

/// Steps or stretches that a moment's estimate makes at most between two looks at the clock, in periods of the fastest
/// motion of one degree of freedom: the exact scheme looks through every one of them for a contact.
const PERIODS_A_LOOK: f64 = 1e3;

/// How long a run is tried where nothing of the work has come back yet.
const TRIAL: Duration = Duration::from_millis(300);

/// More degrees of freedom take more than a moment to set up: they are not tried beside the run itself, and what is not
/// known after this long is said not to be.
const FEW: usize = 2000;
const UNKNOWN: f64 = 10.0;

/// What the pace of a run follows from, in words.
#[derive(Debug, Clone)]
pub struct Pace {
    /// Of all of the run: `200000 steps of 5e-5 s`.
    cause: String,
    /// Runs whose cost tells that of the whole as long as nothing of it is done.
    parts: Vec<Part>,
}

/// A run that the work consists of, or has among others.
#[derive(Debug, Clone)]
struct Part {
    scene: Scene,
    method: Method,
    step: f64,
    /// How many such runs there are, or as many as those that cost the same.
    runs: f64,
    /// What stands before the time that all of them take, and after it.
    words: [&'static str; 2],
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
        let part = Part { scene: scene.clone(), method: *method, step, runs: 1.0, words: ["about", "more"] };
        Self { cause, parts: vec![part] }
    }

    /// The same of work that takes `runs` such runs.
    #[must_use]
    pub fn times(mut self, runs: f64) -> Self {
        self.parts.iter_mut().for_each(|part| part.runs *= runs);
        self
    }

    /// The same of a comparison of `methods` with each other and with the exact scheme.
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

    /// The same of a search for the error that `method`, if one is asked for, makes in `most_steps` at most: the exact
    /// motion some times, and steps halved until they are enough.
    #[must_use]
    pub fn of_search(scene: &Scene, method: Option<Method>, step: f64, most_steps: u64) -> Self {
        let exact = Self::of(scene, &Method::new(Scheme::Event), step).each();
        let method = method.filter(|m| m.scheme != Scheme::Event).unwrap_or_else(|| choose(scene).method);
        let finest = Self::of(scene, &method, scene.duration / most_steps as f64);
        let cause =
            format!("{}; steps are halved until there are {:.1e} of them at most", exact.cause, most_steps as f64);
        let mut parts = exact.parts;
        // A run costs about as much again to record and judge; those before the finest are as much as it.
        parts.extend(finest.parts.into_iter().map(|part| Part { runs: 4.0, words: ["at most about", "more"], ..part }));
        // The exact motion of many is given up after a second or so, where it has too many events.
        parts.retain(|part| part.method.scheme != Scheme::Event || matches!(scene.system, System::Oscillator(_)));
        Self { cause, parts }
    }

    /// The same of a chart of `methods`, each at some steps, none of which may take longer than `longest` (s).
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

    /// The same of the energy and the lasting contacts of `runs` runs of about one cost, beside the exact motion.
    #[must_use]
    pub fn of_contacts(scene: &Scene, step: f64, runs: f64) -> Self {
        let moreau = Method::new(Scheme::MoreauJean { theta: 0.5 });
        let Self { cause, mut parts } = Self::of_all(scene, &[moreau], step);
        parts.extend(Self::of(scene, &moreau, step).times(runs).parts);
        Self { cause, parts }
    }

    /// The same of maps of `rows` rows and `work` steps in all.
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

    /// Where each of the runs costs so much by itself, and their number is not known.
    fn each(mut self) -> Self {
        self.parts.iter_mut().for_each(|part| part.words = ["about", "for each run of the exact motion"]);
        self
    }

    /// The line that is said once `elapsed` has gone by and `share` of the work is done; none where it is over soon.
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
        // Nothing has come back: a step that takes longer than this, or the work before the first.
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

/// Says how long work takes, from a thread beside it: a single step may take longer than all else. It ends with the work.
#[derive(Debug)]
pub struct Watch {
    done: Arc<AtomicU64>,
    /// Closed when the work is over.
    _over: Sender<()>,
}

impl Watch {
    /// Watches work that begins now; `say` is called once, after `patience` or as much later as there is something to say.
    #[must_use]
    pub fn new(pace: Pace, patience: Duration, say: impl Fn(&str) + Send + 'static) -> Self {
        let (over, ended) = channel::<()>();
        let done = Arc::new(AtomicU64::new(0));
        let share = Arc::clone(&done);
        let watch = move || {
            let started = Instant::now();
            let mut pause = patience;
            while ended.recv_timeout(pause) == Err(RecvTimeoutError::Timeout) {
                let share = || f64::from_bits(share.load(Ordering::Relaxed));
                let line = pace.line(started.elapsed(), share());
                // It may have ended while the line was worked out.
                let over = ended.try_recv() == Err(TryRecvError::Disconnected);
                if let (Some(line), false) = (line, over) {
                    return say(&line);
                }
                pause = started.elapsed();
            }
        };
        // Without a thread there is no line, and the work goes on.
        let _ = std::thread::Builder::new().name("pace".to_owned()).spawn(watch);
        Self { done, _over: over }
    }

    /// Tells which share of the work is done.
    pub fn share(&self, share: f64) {
        self.done.store(share.to_bits(), Ordering::Relaxed);
    }
}

/// Steps `scene` by `method` for at most `patience` and tells from that how long all of it takes; none where it cannot
/// even start. Recording and judging are not in it: they cost about as much again. The exact scheme of one degree of freedom is
/// stopped every thousand periods, whatever `step`: between contacts it may have to look through any number of them.
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

    /// One degree of freedom at 100 THz before a wall that it does not reach: a single step of the exact scheme is the
    /// whole run, and takes hours.
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
        // A scene that is over in a moment is worth no line.
        let soon = Scene::oscillator(1.0, 0.0, 100.0).with_wall(Wall::upper("stop", 1.0));
        assert_eq!(Pace::of(&soon, &event, 1e-4).line(second, 0.0), None);
        // Where the steps of the finest run are what costs.
        let many = of(Pace::of_search(&soon, Some(moreau), 1e-4, 10_000_000_000));
        assert!(many.starts_with("at most about ") && many.contains("1.0e10 of them at most"), "{many}");
        // Twice as many runs take about twice as long: both are trials, so within a factor of some.
        let seconds = |runs: f64| {
            let pace = Pace::of(&stiff(), &moreau, 1e-9).times(runs);
            let part = &pace.parts[0];
            part.runs * estimate(&part.scene, &part.method, part.step, TRIAL).map_or(0.0, |e| e.seconds)
        };
        assert!(seconds(100.0) > 5.0 * seconds(1.0));
    }

    #[test]
    fn what_is_watched_is_spoken_of_once_and_only_while_it_lasts() {
        let pace = Pace { cause: "reasons".to_owned(), parts: Vec::new() };
        let (said, lines) = channel();
        let short = Watch::new(pace.clone(), Duration::from_secs(3600), {
            let said = said.clone();
            move |line: &str| drop(said.send(line.to_owned()))
        });
        short.share(0.01);
        drop(short);
        let long = Watch::new(pace, Duration::from_millis(50), move |line: &str| drop(said.send(line.to_owned())));
        long.share(1e-6);
        let line = lines.recv_timeout(Duration::from_secs(60)).unwrap();
        assert!(line.ends_with(": reasons"), "{line}");
        // The thread has gone, and with it the other end.
        assert!(lines.recv().is_err());
    }
}
