#![recursion_limit = "1024"]
// Put into the copy of lib.rs: which mutant is alive, and the forms that the mutants take.
macro_rules! mutant_or { ($id:literal, $op:tt, $other:tt, $l:expr, $r:expr) => {
    (match ($l, $r) { (l, r) => if crate::mutant($id) { l $other r } else { l $op r } })
} }
macro_rules! mutant_compares { ($op:tt $(, $id:literal $other:tt)+; $l:expr, $r:expr) => {
    (match (&$l, &$r) { (l, r) => {
        let own: bool = *l $op *r;
        match crate::mutant_alive() {
            0 => own,
            alive if alive >= crate::TRACING => {
                $( crate::mutant_reached($id, own != (*l $other *r)); )+
                own
            }
            $( $id => *l $other *r, )+
            _ => own,
        }
    } })
} }
macro_rules! mutant_and { ($id:literal, $l:expr, $r:expr) => {
    (match $l { l => if l != crate::mutant($id) { $r } else { l } })
} }
macro_rules! mutant_or_else { ($id:literal, $l:expr, $r:expr) => {
    (match $l { l => if l == crate::mutant($id) { $r } else { l } })
} }
macro_rules! mutant_unary { ($id:literal, $op:tt, $x:expr) => {
    (match $x { x => if crate::mutant($id) { $op ($op x) } else { $op x } })
} }
macro_rules! mutant_assigns { ($id:literal, $op:tt, $other:tt, $l:expr, $r:expr) => {
    (match $r { r => if crate::mutant($id) { $l $other r } else { $l $op r } })
} }

use std::sync::atomic::{AtomicU8, AtomicUsize, Ordering::Relaxed};

pub(crate) const TRACING: usize = usize::MAX - 1;
const UNREAD: usize = usize::MAX;
static ALIVE: AtomicUsize = AtomicUsize::new(UNREAD);
static REACHED: [AtomicU8; COUNT_OF_MUTANTS + 1] =
    [const { AtomicU8::new(0) }; COUNT_OF_MUTANTS + 1];

#[inline(always)]
pub(crate) fn mutant_alive() -> usize {
    ALIVE.load(Relaxed)
}

#[inline(always)]
pub(crate) fn mutant(id: usize) -> bool {
    let alive = mutant_alive();
    alive == id || (alive >= TRACING && mutant_asked(id))
}

#[cold]
#[inline(never)]
fn mutant_asked(id: usize) -> bool {
    mutant_reached(id, true);
    mutant_alive() == id
}

/// Notes that a mutant was reached, and whether its result would have been `another`.
#[cold]
#[inline(never)]
pub(crate) fn mutant_reached(id: usize, another: bool) {
    if mutant_alive() == UNREAD {
        let asked = std::env::var("MUTANT").unwrap_or_default();
        if asked.starts_with("trace:") {
            atexit(mutant_exit);
            ALIVE.store(TRACING, Relaxed);
        } else {
            ALIVE.store(asked.parse().unwrap_or(0), Relaxed);
        }
    }
    if mutant_alive() == TRACING {
        REACHED[id].fetch_or(1 | 2 * u8::from(another), Relaxed);
    }
}

unsafe extern "C" {
    safe fn atexit(f: extern "C" fn()) -> i32;
}

extern "C" fn mutant_exit() {
    let asked = std::env::var("MUTANT").unwrap_or_default();
    if let Some(file) = asked.strip_prefix("trace:") {
        let bytes: Vec<u8> = REACHED.iter().map(|x| x.load(Relaxed)).collect();
        let _ = std::fs::write(file, bytes);
    }
}
