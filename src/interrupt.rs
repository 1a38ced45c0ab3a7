//! Stopping a computation that is under way.

use crate::error::{Error, Result};
use std::cell::{Cell, RefCell};
use std::fmt;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

/// Time between two calls of the caller's function.
const INTERVAL: Duration = Duration::from_millis(50);

/// Approximate time between two readings of the clock: short compared with the interval, since
/// steps may suddenly cost a hundred times more, and long compared with a reading, which costs some
/// 30 ns.
const LOOK: Duration = Duration::from_millis(1);

thread_local! {
    static CURRENT: RefCell<Option<Interrupt>> = const { RefCell::new(None) };
    /// Time of the last call on this thread, or of the first possibility of one. It outlasts a
    /// computation, so that many short ones in turn, such as the rows of a sweep, call as often as
    /// a long one.
    static ASKED: Cell<Option<Instant>> = const { Cell::new(None) };
}

/// A function of the caller that computations call about every 50 ms, to know whether to stop.
///
/// [`Interrupt::over`] applies it to any computation of the crate: runs, studies, sweeps, and
/// steppers made within it. All of them end with [`Error::Stopped`] soon after the function has
/// returned true, on every thread that takes part. An interrupt that has stopped something stays
/// stopped.
///
/// ```
/// use signorini::{Error, Interrupt, Options, Scene, Scheme, run};
/// use std::time::{Duration, Instant};
///
/// // Ten thousand million steps, some minutes of computing; given up after a tenth of a second.
/// let scene = Scene::oscillator(1.0, 0.0, 100.0).with_duration(1e6);
/// let options = Options::with_step(1e-4).with_sample(1e3);
/// let started = Instant::now();
/// let interrupt = Interrupt::new(move || started.elapsed() > Duration::from_millis(100));
/// let outcome = interrupt.over(|| run(&scene, &Scheme::MoreauJean { theta: 0.5 }, &options));
/// assert_eq!(outcome.unwrap_err(), Error::Stopped);
/// ```
#[derive(Clone)]
pub struct Interrupt(Arc<Inner>);

struct Inner {
    ask: Box<dyn Fn() -> bool + Send + Sync>,
    stopped: AtomicBool,
    depth: usize,
}

impl Interrupt {
    /// An interrupt by `ask`, which returns true if the computation is to stop. It is called on the
    /// threads of the computation.
    #[must_use]
    pub fn new(ask: impl Fn() -> bool + Send + Sync + 'static) -> Self {
        let depth = Self::current().map_or(0, |around| around.depth() + 1);
        Self(Arc::new(Inner { ask: Box::new(ask), stopped: AtomicBool::new(false), depth }))
    }

    /// Does `work` under this interrupt. Of nested interrupts, only the innermost is called.
    ///
    /// # Errors
    /// [`Error::Stopped`] if the work was stopped, whatever the work itself returned; otherwise its
    /// own errors.
    pub fn over<T>(&self, work: impl FnOnce() -> Result<T>) -> Result<T> {
        let outcome = Carried(Some(self.clone())).over(work);
        if self.is_stopped() { Err(Error::Stopped) } else { outcome }
    }

    /// The interrupt that applies to the caller, to be applied to its work on other threads too.
    #[must_use]
    pub fn current() -> Option<Self> {
        CURRENT.with_borrow(Option::clone)
    }

    /// The number of interrupts around the one that was made, on whatever thread: 0 for one made
    /// outside of all others. A program whose loads call back into it, and so run scenes within
    /// runs of scenes, knows by it how deep it is.
    #[must_use]
    pub fn depth(&self) -> usize {
        self.0.depth
    }

    /// True once the function has returned true.
    fn is_stopped(&self) -> bool {
        self.0.stopped.load(Ordering::Relaxed)
    }

    fn ask(&self) -> bool {
        if !self.is_stopped() && (self.0.ask)() {
            self.0.stopped.store(true, Ordering::Relaxed);
        }
        self.is_stopped()
    }
}

impl fmt::Debug for Interrupt {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Interrupt").field("stopped", &self.is_stopped()).finish_non_exhaustive()
    }
}

/// The interrupt that applies to a computation, if there is one, to be applied to its parts on
/// other threads too.
#[derive(Debug, Clone)]
pub(crate) struct Carried(Option<Interrupt>);

impl Carried {
    /// The interrupt that applies to the caller.
    pub fn here() -> Self {
        Self(Interrupt::current())
    }

    /// Does `work` under this interrupt.
    pub fn over<T>(&self, work: impl FnOnce() -> T) -> T {
        let _before = Restored(CURRENT.replace(self.0.clone()));
        work()
    }

    /// Refuses incomplete results: to be called where stopped work would otherwise count as done.
    ///
    /// # Errors
    /// [`Error::Stopped`] once the interrupt has stopped.
    #[cfg(feature = "cli")]
    pub fn check(&self) -> Result<()> {
        if self.0.as_ref().is_some_and(Interrupt::is_stopped) { Err(Error::Stopped) } else { Ok(()) }
    }
}

/// Restores the former interrupt when dropped, also after a panic.
struct Restored(Option<Interrupt>);

impl Drop for Restored {
    fn drop(&mut self) {
        CURRENT.set(self.0.take());
    }
}

/// Calls the interrupt of a loop about every 50 ms, at the cost of one comparison per pass.
#[derive(Debug, Clone)]
pub(crate) struct Asking {
    /// The number of passes at which the clock is read next.
    due: u64,
    pace: Option<Box<Pace>>,
}

#[derive(Debug, Clone)]
struct Pace {
    interrupt: Interrupt,
    /// Passes between two readings of the clock; adapted to the cost of a pass.
    stride: u64,
    looked: Instant,
}

impl Asking {
    /// For a loop of the caller's computation.
    pub fn here() -> Self {
        let pace = |interrupt| {
            let now = Instant::now();
            Box::new(Pace { interrupt, stride: 1, looked: now })
        };
        let pace = Carried::here().0.map(pace);
        Self { due: if pace.is_some() { 0 } else { u64::MAX }, pace }
    }

    /// Called in every pass with the number of passes so far.
    ///
    /// # Errors
    /// [`Error::Stopped`].
    #[inline]
    pub fn pass(&mut self, count: u64) -> Result<()> {
        if count < self.due { Ok(()) } else { self.ask_now(count) }
    }

    /// The count goes on from elsewhere.
    pub fn restart(&mut self) {
        if self.pace.is_some() {
            self.due = 0;
        }
    }

    #[cold]
    #[inline(never)]
    fn ask_now(&mut self, count: u64) -> Result<()> {
        let Some(pace) = &mut self.pace else { return Ok(()) };
        let now = Instant::now();
        let since = now - pace.looked;
        if since < LOOK {
            pace.stride *= 2;
        } else if since > 4 * LOOK {
            pace.stride = (pace.stride / 2).max(1);
        }
        pace.looked = now;
        self.due = count.saturating_add(pace.stride);
        let asked = ASKED.get().unwrap_or(now);
        let due = now - asked >= INTERVAL;
        ASKED.set(Some(if due { now } else { asked }));
        if pace.interrupt.is_stopped() || (due && pace.interrupt.ask()) { Err(Error::Stopped) } else { Ok(()) }
    }
}
