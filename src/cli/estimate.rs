//! How long work will take, and what determines this: estimated from the share that is done or from
//! a short trial, and said once while the work lasts.

#[cfg(test)]
mod tests;

use super::run_time::{run_time, steps_in_words, time_in_words, unknowns_in_words};
use crate::error::counted;
use crate::parallel::cores;
use crate::scene::{Scene, System};
use crate::scheme::{Method, Scheme, check_exact};
use crate::study::choice::choose;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::mpsc::{RecvTimeoutError, Sender, TryRecvError, channel};
use std::time::{Duration, Instant};

/// Seconds: a shorter remainder is not reported.
const WORTH_SAYING: f64 = 2.0;

/// A finished share below this is too small to extrapolate from.
const LEAST_SHARE: f64 = 1e-12;

/// How long a run is tried where no part of the work has finished yet.
const TRIAL: Duration = Duration::from_millis(300);

/// Structures with more degrees of freedom take too long to set up and are not tried beside the run
/// itself; after [`UNKNOWN`] seconds the tool says that the duration is not known.
const MOST_TRIED: usize = 2000;
const UNKNOWN: f64 = 10.0;

/// What the same command does after an interruption, where parts of the work are kept.
pub(super) const GOES_ON: &str = "the same command goes on from what is done";

/// What the duration of the work depends on.
#[derive(Debug, Clone)]
pub struct DurationEstimate {
    /// Description of all steps, such as `200000 steps of 5e-5 s`.
    cause: String,
    /// Runs from whose cost the duration is estimated while no share of the work is done.
    runs: Vec<CountedRun>,
    /// Work that follows, in units of this one: what is left of both is told.
    following: f64,
    /// The word before the time that the share done gives.
    about: &'static str,
}

/// A run of the work, or one of several kinds of runs in it.
#[derive(Debug, Clone)]
struct CountedRun {
    scene: Scene,
    method: Method,
    step: f64,
    /// Number of such runs, or of runs that cost the same in all.
    count: f64,
    /// Words before and after the time that these runs take together.
    words: [&'static str; 2],
}

impl DurationEstimate {
    fn new(cause: String, runs: Vec<CountedRun>) -> Self {
        Self { cause, runs, following: 0.0, about: "about" }
    }

    /// That of `method` on `scene` with steps of `step` seconds.
    #[must_use]
    pub fn of_run(scene: &Scene, method: &Method, step: f64) -> Self {
        let run = CountedRun { scene: scene.clone(), method: *method, step, count: 1.0, words: ["about", "more"] };
        Self::new(steps_in_words(scene, method, step), vec![run])
    }

    /// The same for work that consists of `count` such runs.
    #[must_use]
    pub fn times(mut self, count: f64) -> Self {
        self.runs.iter_mut().for_each(|run| run.count *= count);
        self
    }

    /// The same for work after which other work follows, `following` times as long: it is counted
    /// once a share of this one is done.
    #[must_use]
    pub fn followed_by(self, following: f64) -> Self {
        Self { following, ..self }
    }

    /// The same for work that goes on faster than it begins: what its first share gives is a bound.
    #[must_use]
    pub fn at_most(self) -> Self {
        Self { about: "at most about", ..self }
    }

    /// The same for work whose parts are kept as they end.
    #[must_use]
    pub fn resumable(self) -> Self {
        Self { cause: format!("{}; after an interruption {GOES_ON}", self.cause), ..self }
    }

    /// The same for `count` such runs that share all cores.
    #[must_use]
    pub fn on_all_cores(self, count: f64) -> Self {
        self.times(count / (cores() as f64).min(count.max(1.0)))
    }

    /// That of a comparison of `methods` with each other and, where it takes the scene, with the
    /// exact scheme.
    #[must_use]
    pub fn of_comparison(scene: &Scene, methods: &[Method], step: f64) -> Self {
        let mut exact = Self::of_each_exact_run(scene, step);
        if let Some(method) = methods.iter().find(|method| method.scheme != Scheme::Event) {
            if exact.runs.is_empty() {
                return Self::of_run(scene, method, step).times(methods.len() as f64);
            }
            exact.cause = format!("{}; the others take {}", exact.cause, steps_in_words(scene, method, step));
        }
        exact
    }

    /// That of a search for an error, by `method` if one is asked for, with at most `most_steps`
    /// steps: the exact motion several times, and steps halved until the error is kept.
    #[must_use]
    pub fn of_search(scene: &Scene, method: Option<Method>, step: f64, most_steps: u64) -> Self {
        let exact = Self::of_each_exact_run(scene, step);
        let method = method.filter(|m| m.scheme != Scheme::Event).unwrap_or_else(|| choose(scene).method);
        let finest = Self::of_run(scene, &method, scene.duration / most_steps as f64);
        let halved = format!("steps are halved until there are {:.1e} of them at most", most_steps as f64);
        let cause = if exact.runs.is_empty() { halved } else { format!("{}; {halved}", exact.cause) };
        let mut runs = exact.runs;
        // Recording and judging cost about as much as stepping; all coarser runs together cost as
        // much as the finest.
        runs.extend(finest.runs.into_iter().map(|run| CountedRun {
            count: 4.0,
            words: ["at most about", "more"],
            ..run
        }));
        // The exact motion of a structure is given up after about a second if it has too many
        // events.
        runs.retain(|run| run.method.scheme != Scheme::Event || matches!(scene.system, System::Oscillator(_)));
        Self::new(cause, runs)
    }

    /// That of a chart of `methods`, each at several steps, where no run may take longer than
    /// `longest` (s).
    #[must_use]
    pub fn of_chart(scene: &Scene, methods: &[Method], levels: u32, longest: f64) -> Self {
        let exact = Self::of_each_exact_run(scene, scene.duration);
        let count = counted(methods.len(), "method");
        let mut cause = format!("{count} at up to {levels} steps each, --longest {longest} s a run");
        if !exact.runs.is_empty() {
            cause = format!("{cause}; {}", exact.cause);
        }
        Self { cause, ..exact }
    }

    /// That of the study of energy and lasting contacts: `count` runs of about equal cost, and the
    /// exact motion.
    #[must_use]
    pub fn of_contacts(scene: &Scene, step: f64, count: f64) -> Self {
        let moreau = Method::new(Scheme::MoreauJean { theta: 0.5 });
        let Self { cause, mut runs, .. } = Self::of_comparison(scene, &[moreau], step);
        runs.extend(Self::of_run(scene, &moreau, step).times(count).runs);
        Self::new(cause, runs)
    }

    /// That of maps with `rows` rows and `work` steps in all.
    #[must_use]
    pub fn of_maps(scene: &Scene, work: u64, rows: usize) -> Self {
        let (unknowns, rows) = (unknowns_in_words(scene), counted(rows, "row"));
        let cause = format!("{:.1e} steps{unknowns} in {rows}, set by the slowest frequency and time.end", work as f64);
        Self::new(cause, Vec::new())
    }

    /// For work with runs of the exact motion whose number is not known, each of which may take
    /// long; without a run where the exact scheme refuses the scene.
    fn of_each_exact_run(scene: &Scene, step: f64) -> Self {
        if check_exact(scene, "an estimate").is_err() {
            return Self::new(String::new(), Vec::new());
        }
        let mut exact = Self::of_run(scene, &Method::new(Scheme::Event), step);
        exact.runs.iter_mut().for_each(|run| run.words = ["about", "for each run of the exact motion"]);
        exact
    }

    /// The message after `elapsed`, with `share` of the work done; `None` if the work ends soon.
    fn message(&self, elapsed: Duration, share: f64) -> Option<String> {
        let elapsed = elapsed.as_secs_f64();
        if share >= 1.0 {
            return None;
        }
        if share > LEAST_SHARE {
            let left = elapsed * (1.0 + self.following - share) / share;
            return (left >= WORTH_SAYING)
                .then(|| format!("{} {} more: {}", self.about, time_in_words(left), self.cause));
        }
        // No part of the work has finished: either a single step takes this long, or the work
        // before the first step does.
        let (tried, untried): (Vec<&CountedRun>, Vec<&CountedRun>) =
            self.runs.iter().partition(|run| run.scene.system.degrees_of_freedom() <= MOST_TRIED);
        let unknown = || format!("how long it takes is not known after {elapsed:.0} s: {}", self.cause);
        let message = |run: &CountedRun| {
            let seconds = run.seconds().filter(|seconds| seconds.is_finite() && *seconds >= WORTH_SAYING)?;
            let [before, after] = run.words;
            Some(format!("{before} {} {after}: {}", time_in_words(seconds), self.cause))
        };
        tried.into_iter().find_map(message).or_else(|| (!untried.is_empty() && elapsed >= UNKNOWN).then(unknown))
    }

    /// Calls `say` once with the message on work that begins now: after `patience`, or as soon
    /// afterwards as an estimate exists, unless the returned value is dropped before, which ends
    /// the work. A thread of its own does this, since a single step may take longer than all the
    /// rest.
    pub fn announce(self, patience: Duration, say: impl Fn(&str) + Send + 'static) -> WorkUnderWay {
        let (over, ended) = channel::<()>();
        let done = Arc::new(AtomicU64::new(0));
        let share = Arc::clone(&done);
        let wait = move || {
            let started = Instant::now();
            let mut pause = patience;
            while ended.recv_timeout(pause) == Err(RecvTimeoutError::Timeout) {
                let message = self.message(started.elapsed(), f64::from_bits(share.load(Ordering::Relaxed)));
                // The work may have ended while the message was computed.
                let over = ended.try_recv() == Err(TryRecvError::Disconnected);
                if let (Some(message), false) = (message, over) {
                    return say(&message);
                }
                pause = started.elapsed();
            }
        };
        // If no thread can be started, there is no message, and the work continues.
        let _ = std::thread::Builder::new().name("estimate".to_owned()).spawn(wait);
        WorkUnderWay { done, _over: over }
    }
}

/// Work whose duration is announced while it lasts.
#[derive(Debug)]
pub struct WorkUnderWay {
    done: Arc<AtomicU64>,
    /// Dropped when the work is over, which closes the channel.
    _over: Sender<()>,
}

impl WorkUnderWay {
    /// Sets the share of the work that is done.
    pub fn set_share(&self, share: f64) {
        self.done.store(share.to_bits(), Ordering::Relaxed);
    }
}

impl CountedRun {
    /// Time of all these runs, from a trial of one.
    fn seconds(&self) -> Option<f64> {
        run_time(&self.scene, &self.method, self.step, TRIAL).map(|time| self.count * time.seconds)
    }
}
