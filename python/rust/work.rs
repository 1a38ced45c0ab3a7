//! Computing without the interpreter's lock, and stopping when a signal such as Ctrl-C arrives.

use crate::error::{RunError, raise};
use pyo3::exceptions::PyRecursionError;
use pyo3::prelude::*;
use signorini::{Interrupt, Result};
use std::cell::RefCell;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError, mpsc};
use std::time::Duration;

/// Time between two checks for signals while other threads work.
const INTERVAL: Duration = Duration::from_millis(50);

thread_local! {
    /// The exception raised on this thread by a Python function that is a load.
    static RAISED: RefCell<Option<PyErr>> = const { RefCell::new(None) };
}

/// The most runs within one another, where the load of a scene is a function that runs a scene.
/// Each takes some 60 kB of the stack, of which a thread may have no more than 512 kB.
const MOST_NESTED: usize = 5;

/// Calls a function of Python's that is a load. What it runs itself counts as nested within the
/// computation around it, on whatever thread.
///
/// # Errors
/// `RecursionError` where too many runs are nested; those of the call.
pub fn nested<T>(call: impl FnOnce() -> PyResult<T>) -> PyResult<T> {
    // Of every run within another there are two interrupts: that of the run, and this one, which
    // never stops.
    let inner = Interrupt::new(|| false);
    if inner.depth() > 2 * MOST_NESTED {
        return Err(PyRecursionError::new_err(format!(
            "more than {MOST_NESTED} runs within one another: the function of a Load.function runs a scene, whose \
             load runs another, and so on; expected one that ends, or a force computed before the run, as a Load.table"
        )));
    }
    inner.over(|| Ok(call())).unwrap_or_else(|error| Err(raise(error)))
}

/// The same during a run, which cannot pass an exception on: the first is kept until the run ends,
/// and from then on nothing is called any more.
pub fn called_in_run<T>(call: impl FnOnce() -> PyResult<T>) -> Option<T> {
    if has_raised() {
        return None;
    }
    nested(call).map_err(|error| RAISED.set(Some(error))).ok()
}

/// The exception kept on this thread.
pub fn kept() -> Option<PyErr> {
    RAISED.take()
}

/// True if one is kept.
fn has_raised() -> bool {
    RAISED.with_borrow(Option::is_some)
}

/// Does `work` on this thread without the interpreter's lock. Signals are checked every 50 ms; an
/// exception that a handler raises (Ctrl-C: `KeyboardInterrupt`) ends the work and is passed on.
pub fn compute<T: Send>(py: Python<'_>, work: impl FnOnce() -> Result<T> + Send) -> PyResult<T> {
    let signal = Arc::new(Mutex::new(None));
    let heard = Arc::clone(&signal);
    let interrupt = Interrupt::new(move || {
        let checked = Python::attach(|py| py.check_signals());
        let stop = checked.is_err() || has_raised();
        *heard.lock().unwrap_or_else(PoisonError::into_inner) = checked.err();
        stop
    });
    kept();
    let outcome = py.detach(|| interrupt.over(work));
    let signal = signal.lock().unwrap_or_else(PoisonError::into_inner).take();
    match signal.or_else(kept) {
        Some(error) => Err(error),
        None => outcome.map_err(raise),
    }
}

/// Does `work`, which takes long and may use many threads, on a thread of its own. Meanwhile this
/// thread checks for signals and calls the caller's `watch` from time to time.
pub fn compute_beside<T: Send>(
    py: Python<'_>,
    work: impl FnOnce() -> Result<T> + Send,
    watch: &mut dyn FnMut(Python<'_>) -> PyResult<()>,
) -> PyResult<T> {
    let stop = Arc::new(AtomicBool::new(false));
    let asked = Arc::clone(&stop);
    let interrupt = Interrupt::new(move || asked.load(Ordering::Relaxed));
    let mut signal = None;
    let (send, receive) = mpsc::channel();
    let receive = Mutex::new(receive);
    std::thread::scope(|scope| {
        let worker = scope.spawn(move || {
            let outcome = interrupt.over(work);
            // The receiver waits until it has this.
            let _ = send.send((outcome, kept()));
        });
        let outcome = loop {
            match py.detach(|| receive_within(&receive)) {
                Ok(outcome) => break Some(outcome),
                Err(mpsc::RecvTimeoutError::Disconnected) => break None,
                Err(mpsc::RecvTimeoutError::Timeout) => {
                    if signal.is_none() {
                        signal = py.check_signals().and_then(|()| watch(py)).err();
                        stop.store(signal.is_some(), Ordering::Relaxed);
                    }
                }
            }
        };
        // A panic has printed its message already; it is not passed on.
        let ended = py.detach(|| worker.join());
        match (signal.take(), outcome) {
            (Some(error), _) | (None, Some((_, Some(error)))) => Err(error),
            (None, Some((outcome, None))) => outcome.map_err(raise),
            (None, None) => Err(RunError::new_err(format!("a defect of this program: {ended:?}"))),
        }
    })
}

/// Does `work` on a thread of its own, which is left behind when a signal arrives: work on a large
/// structure has parts that ask no interrupt, such as the factor of a sparse matrix. What is left
/// behind ends at the next part that asks, and its result is dropped.
pub fn compute_apart<T: Send + 'static>(
    py: Python<'_>,
    work: impl FnOnce() -> Result<T> + Send + 'static,
) -> PyResult<T> {
    let stop = Arc::new(AtomicBool::new(false));
    let asked = Arc::clone(&stop);
    let interrupt = Interrupt::new(move || asked.load(Ordering::Relaxed));
    let (send, receive) = mpsc::channel();
    let receive = Mutex::new(receive);
    let worker = std::thread::Builder::new().spawn(move || {
        let outcome = interrupt.over(work);
        // Nobody receives it any more after a signal.
        let _ = send.send((outcome, kept()));
    })?;
    loop {
        match py.detach(|| receive_within(&receive)) {
            Ok((_, Some(error))) => return Err(error),
            Ok((outcome, None)) => return outcome.map_err(raise),
            Err(mpsc::RecvTimeoutError::Timeout) => {
                if let Err(signal) = py.check_signals() {
                    stop.store(true, Ordering::Relaxed);
                    return Err(signal);
                }
            }
            Err(mpsc::RecvTimeoutError::Disconnected) => {
                let ended = py.detach(|| worker.join());
                return Err(RunError::new_err(format!("a defect of this program: {ended:?}")));
            }
        }
    }
}

/// Degrees of freedom from which work on a scene may take a tenth of a second before its first
/// step.
pub const LARGE: usize = 1000;

type Outcome<T> = (Result<T>, Option<PyErr>);

fn receive_within<T>(
    receive: &Mutex<mpsc::Receiver<Outcome<T>>>,
) -> std::result::Result<Outcome<T>, mpsc::RecvTimeoutError> {
    receive.lock().unwrap_or_else(PoisonError::into_inner).recv_timeout(INTERVAL)
}
