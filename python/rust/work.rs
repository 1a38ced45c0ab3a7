//! Computing without the interpreter's lock, and stopping when a signal such as Ctrl-C arrives.

use crate::error::{RunError, raise};
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

/// Keeps the first exception of a Python function until the computation that called it has ended.
pub fn keep(error: PyErr) {
    RAISED.with_borrow_mut(|raised| {
        raised.get_or_insert(error);
    });
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

type Outcome<T> = (Result<T>, Option<PyErr>);

fn receive_within<T>(
    receive: &Mutex<mpsc::Receiver<Outcome<T>>>,
) -> std::result::Result<Outcome<T>, mpsc::RecvTimeoutError> {
    receive.lock().unwrap_or_else(PoisonError::into_inner).recv_timeout(INTERVAL)
}
