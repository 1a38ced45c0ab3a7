//! Tells how long work takes, while it lasts.

use super::pace::Pace;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::mpsc::{RecvTimeoutError, Sender, TryRecvError, channel};
use std::time::{Duration, Instant};

/// Reports how long work takes, from a separate thread, since a single step may take longer than
/// all the rest. It ends with the work.
#[derive(Debug)]
pub struct Watch {
    done: Arc<AtomicU64>,
    /// Dropped when the work is over, which closes the channel.
    _over: Sender<()>,
}

impl Watch {
    /// Watches work that begins now; `say` is called once, after `patience` or as soon afterwards
    /// as an estimate exists.
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
                // The work may have ended while the message was computed.
                let over = ended.try_recv() == Err(TryRecvError::Disconnected);
                if let (Some(line), false) = (line, over) {
                    return say(&line);
                }
                pause = started.elapsed();
            }
        };
        // If no thread can be started, there is no message, and the work continues.
        let _ = std::thread::Builder::new().name("pace".to_owned()).spawn(watch);
        Self { done, _over: over }
    }

    /// Sets the share of the work that is done.
    pub fn share(&self, share: f64) {
        self.done.store(share.to_bits(), Ordering::Relaxed);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Scene;

    #[test]
    fn what_is_watched_is_spoken_of_once_and_only_while_it_lasts() {
        let pace = Pace::of_maps(&Scene::oscillator(1.0, 0.0, 100.0), 1_000_000, 7);
        let whole = pace.line(Duration::from_secs(3600), 0.5).unwrap();
        let (_, cause) = whole.split_once(": ").unwrap();
        let ending = format!(": {cause}");
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
        assert!(line.ends_with(&ending), "{line}");
        // The thread has ended, and with it the channel.
        assert!(lines.recv().is_err());
    }
}
