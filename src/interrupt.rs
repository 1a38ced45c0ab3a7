//! Stopping a computation that is under way.

use crate::error::{Error, Result};
use std::cell::{Cell, RefCell};
use std::fmt;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

/// Time between two questions.
const INTERVAL: Duration = Duration::from_millis(50);

/// Time between two looks at the clock, at least and about: short beside the interval, since steps
/// may suddenly cost a hundred times more, and long beside a look, which costs some 30 ns.
const LOOK: Duration = Duration::from_millis(1);

thread_local! {
    static CURRENT: RefCell<Option<Interrupt>> = const { RefCell::new(None) };
    /// When this thread last asked, or first could have: many short computations in turn, such as
    /// the rows of a sweep, ask as often as a long one.
    static ASKED: Cell<Option<Instant>> = const { Cell::new(None) };
}

/// A question that computations ask about every 50 ms: whether to stop.
///
/// [`Interrupt::over`] puts it over any computation of the crate: runs, studies, sweeps, and
/// steppers made within it. All of them end with [`Error::Stopped`] soon after the answer yes, on
/// every thread that takes part. An interrupt that has stopped something stays stopped.
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
}

impl Interrupt {
    /// An interrupt by `ask`, which returns true if the computation shall stop. It is called on the
    /// threads of the computation.
    #[must_use]
    pub fn new(ask: impl Fn() -> bool + Send + Sync + 'static) -> Self {
        Self(Arc::new(Inner { ask: Box::new(ask), stopped: AtomicBool::new(false) }))
    }

    /// Does `work`, and lets it ask. Of interrupts over one another, the innermost is asked.
    ///
    /// # Errors
    /// [`Error::Stopped`] if the work was stopped, whatever it made of that; else its own errors.
    pub fn over<T>(&self, work: impl FnOnce() -> Result<T>) -> Result<T> {
        let outcome = Carried(Some(self.clone())).over(work);
        if self.is_stopped() { Err(Error::Stopped) } else { outcome }
    }

    /// The interrupt over the caller, to be put over what it does on other threads.
    #[must_use]
    pub fn current() -> Option<Self> {
        CURRENT.with_borrow(Option::clone)
    }

    /// True once the answer was yes.
    #[must_use]
    pub fn is_stopped(&self) -> bool {
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

/// The interrupt over a computation, if there is one, to be put over its parts on other threads.
#[derive(Debug, Clone)]
pub(crate) struct Carried(Option<Interrupt>);

impl Carried {
    /// The one over the caller.
    pub fn here() -> Self {
        Self(Interrupt::current())
    }

    /// Does `work` under it.
    pub fn over<T>(&self, work: impl FnOnce() -> T) -> T {
        let _before = Restored(CURRENT.replace(self.0.clone()));
        work()
    }

    /// For what would pass off work that was stopped on its way as done.
    ///
    /// # Errors
    /// [`Error::Stopped`] once it was told to stop.
    #[cfg(feature = "cli")]
    pub fn check(&self) -> Result<()> {
        if self.0.as_ref().is_some_and(Interrupt::is_stopped) { Err(Error::Stopped) } else { Ok(()) }
    }
}

/// Puts back what was there before, also after a panic.
struct Restored(Option<Interrupt>);

impl Drop for Restored {
    fn drop(&mut self) {
        CURRENT.set(self.0.take());
    }
}

/// Asks the interrupt over a loop about every 50 ms, at the cost of one comparison per pass.
#[derive(Debug, Clone)]
pub(crate) struct Asking {
    /// The count of passes at which to look at the clock next.
    due: u64,
    pace: Option<Box<Pace>>,
}

#[derive(Debug, Clone)]
struct Pace {
    interrupt: Interrupt,
    /// Passes between two looks at the clock; it follows their cost.
    stride: u64,
    looked: Instant,
}

impl Asking {
    /// For a loop of the computation that the caller is in.
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
        if count < self.due { Ok(()) } else { self.look(count) }
    }

    /// The count goes on from elsewhere.
    pub fn restart(&mut self) {
        if self.pace.is_some() {
            self.due = 0;
        }
    }

    #[cold]
    #[inline(never)]
    fn look(&mut self, count: u64) -> Result<()> {
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
