//! Work on several threads, whose results arrive on one.

use crate::error::{Error, Result};
use crate::interrupt::Carried;
use std::num::NonZero;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::mpsc::{RecvTimeoutError, sync_channel};
use std::time::Duration;

/// Time after which the receiver is called although no result has arrived.
const TICK: Duration = Duration::from_millis(100);

/// Results per thread that wait for the receiver; a thread that has one more waits, too.
const WAITING: usize = 64;

/// Takes a result of the work; returns false where no more are wanted.
pub type Take<'a, T> = dyn FnMut(T) -> bool + 'a;

/// The number of processor cores, 1 where it is not known.
#[must_use]
pub fn cores() -> usize {
    std::thread::available_parallelism().map_or(1, NonZero::get)
}

/// Does `work` for the numbers from 0 to below `count` on `threads` threads. Each thread takes the
/// next number when it has finished one, so that numbers begin in their order. `work` passes its
/// results, any number of them, to the [`Take`] that it gets. `receive` is called on this thread
/// with every result, and with `None` where none has arrived for 100 ms. An interrupt that applies
/// to this thread applies to the others too.
///
/// # Errors
/// Of `receive`, after which no further number begins; else of `work`; a thread that has panicked.
pub fn on_threads<T: Send>(
    count: u64,
    threads: usize,
    work: &(dyn Fn(u64, &mut Take<'_, T>) -> Result<()> + Sync),
    receive: &mut dyn FnMut(Option<T>) -> Result<()>,
) -> Result<()> {
    let threads = threads.max(1).min(usize::try_from(count).unwrap_or(usize::MAX));
    let next = AtomicU64::new(0);
    let interrupt = Carried::here();
    let (sender, receiver) = sync_channel::<T>(WAITING * threads);
    std::thread::scope(|scope| {
        let (next, interrupt) = (&next, &interrupt);
        let start = |_| {
            let sender = sender.clone();
            let numbers = move || {
                let mut wanted = true;
                while wanted {
                    let number = next.fetch_add(1, Ordering::Relaxed);
                    if number >= count {
                        break;
                    }
                    work(number, &mut |result| {
                        wanted = sender.send(result).is_ok();
                        wanted
                    })?;
                }
                Ok(())
            };
            scope.spawn(move || interrupt.over(numbers))
        };
        let workers: Vec<_> = (0..threads).map(start).collect();
        // The last of the others closes the channel.
        drop(sender);
        let received = loop {
            let result = match receiver.recv_timeout(TICK) {
                Ok(result) => Some(result),
                Err(RecvTimeoutError::Timeout) => None,
                Err(RecvTimeoutError::Disconnected) => break Ok(()),
            };
            if let Err(error) = receive(result) {
                break Err(error);
            }
        };
        // The workers that wait to send end.
        drop(receiver);
        let done = workers.into_iter().map(|worker| worker.join().unwrap_or_else(|_| Err(panicked())));
        received.and(done.collect::<Vec<_>>().into_iter().collect())
    })
}

/// Does `beside` on a thread of its own, and meanwhile `here` on this one; returns both results, in
/// this order. An interrupt that applies to this thread applies to the other too.
pub fn both<A: Send, B>(
    beside: impl FnOnce() -> Result<A> + Send,
    here: impl FnOnce() -> Result<B>,
) -> (Result<A>, Result<B>) {
    let interrupt = Carried::here();
    std::thread::scope(|scope| {
        let beside = scope.spawn(|| interrupt.over(beside));
        let here = here();
        (beside.join().unwrap_or_else(|_| Err(panicked())), here)
    })
}

fn panicked() -> Error {
    Error::io("a thread", "it has panicked, which is a defect of this program".to_owned(), false)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::interrupt::Interrupt;

    #[test]
    fn every_result_arrives_once_whatever_the_number_of_threads() {
        for threads in [1, 2, 7, 100] {
            let mut found = Vec::new();
            let twice = |number: u64, send: &mut Take<'_, u64>| {
                assert!(send(2 * number) && send(2 * number + 1));
                Ok(())
            };
            let mut receive = |result: Option<u64>| {
                found.extend(result);
                Ok(())
            };
            on_threads(50, threads, &twice, &mut receive).unwrap();
            found.sort_unstable();
            assert_eq!(found, (0..100).collect::<Vec<_>>(), "{threads} threads");
        }
        assert!(on_threads(0, 3, &|_, _: &mut Take<'_, ()>| Ok(()), &mut |_| Ok(())).is_ok());
    }

    #[test]
    fn of_two_works_each_has_its_own_result() {
        let fail = || -> Result<()> { Err(Error::invalid("number", 3, "another")) };
        assert_eq!(both(|| Ok(2), || Ok("three")), (Ok(2), Ok("three")));
        assert_eq!(both(fail, || Ok(3)), (fail(), Ok(3)));
        assert_eq!(both(|| Ok(2), fail), (Ok(2), fail()));
        assert!(both(|| -> Result<()> { panic!("as this test wants") }, || Ok(())).0.is_err());
    }

    #[test]
    fn an_error_of_the_receiver_ends_the_work() {
        let begun = AtomicU64::new(0);
        let count = |number, send: &mut Take<'_, u64>| {
            begun.fetch_add(1, Ordering::Relaxed);
            send(number);
            Ok(())
        };
        let full = || Error::io("the disk", "is full".to_owned(), false);
        let error = on_threads(1_000_000, 2, &count, &mut |_| Err(full())).unwrap_err();
        assert!(error.to_string().contains("is full"), "{error}");
        // Two threads fill the channel at most.
        assert!(begun.load(Ordering::Relaxed) < 3 * 2 * WAITING as u64);
    }

    #[test]
    fn errors_panics_and_interrupts_of_the_work_are_passed_on() {
        let fail = |number, _: &mut Take<'_, ()>| {
            if number == 3 { Err(Error::invalid("number", number, "another")) } else { Ok(()) }
        };
        assert!(on_threads(9, 2, &fail, &mut |_| Ok(())).unwrap_err().to_string().contains('3'));
        let panic = |number, _: &mut Take<'_, ()>| {
            assert!(number != 3, "as this test wants");
            Ok(())
        };
        assert!(on_threads(9, 2, &panic, &mut |_| Ok(())).unwrap_err().to_string().contains("panicked"));
        let stop = |_, _: &mut Take<'_, ()>| {
            Interrupt::current().map_or(Ok(()), |interrupt| interrupt.over(|| Err(Error::Stopped)))
        };
        let both_stop = Interrupt::new(|| true).over(|| both(|| stop(0, &mut |()| true), || Ok(())).0);
        assert_eq!(both_stop, Err(Error::Stopped));
        let interrupt = Interrupt::new(|| true);
        let stopped = interrupt.over(|| on_threads(1, 1, &stop, &mut |_| Ok(())));
        assert!(matches!(stopped, Err(Error::Stopped)), "{stopped:?}");
    }
}
