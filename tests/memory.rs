//! The memory of the exact scheme for a large structure grows with the rows in contact, not with
//! all pairs of walls.
#![allow(unsafe_code, reason = "an allocator that counts")]

use signorini::linear::Symmetric;
use signorini::{Load, Row, Scene, Scheme, Stepper, Structure, Wall};
use std::alloc::{GlobalAlloc, Layout, System as Heap};
use std::sync::atomic::{AtomicUsize, Ordering};

struct Counting;

static HELD: AtomicUsize = AtomicUsize::new(0);
static MOST: AtomicUsize = AtomicUsize::new(0);

// SAFETY: every call goes to the system's allocator unchanged.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        let held = HELD.fetch_add(layout.size(), Ordering::Relaxed) + layout.size();
        MOST.fetch_max(held, Ordering::Relaxed);
        // SAFETY: the caller's promises hold for the system's allocator too.
        unsafe { Heap.alloc(layout) }
    }

    unsafe fn dealloc(&self, at: *mut u8, layout: Layout) {
        HELD.fetch_sub(layout.size(), Ordering::Relaxed);
        // SAFETY: as above.
        unsafe { Heap.dealloc(at, layout) }
    }
}

#[global_allocator]
static HEAP: Counting = Counting;

#[test]
fn memory_follows_the_rows_in_play() {
    // A chain of 20 000 masses with stops at 2000 of them, pushed at one end: the first stops are
    // met, the others stand far off.
    let (n, walls) = (20_000, 2000);
    let entries = (0..n).flat_map(|i| [(i, i, 2e4), (i + 1, i, -1e4)]).filter(|entry| entry.0 < n);
    let structure = Structure {
        mass: Symmetric::diagonal(&vec![1.0; n]),
        damping: Symmetric::zeros(n),
        stiffness: Symmetric::from_entries(n, entries),
    };
    let mut scene = Scene::oscillator(1.0, 0.0, 0.0).with_initial(&vec![0.0; n], &vec![0.0; n]).with_duration(0.1);
    scene.system = structure.into();
    scene = scene.with_load(Load::constant(50.0));
    for i in 0..walls {
        let wall = Wall::upper(&format!("w{i}"), 1e-3).with_restitution(if i % 2 == 0 { 0.0 } else { 0.5 });
        scene = scene.with_wall(wall.at(Row::dof(i * (n / walls))));
    }
    let before = HELD.load(Ordering::Relaxed);
    MOST.store(before, Ordering::Relaxed);
    let mut stepper = Stepper::new(&scene, &Scheme::Event, 0.1).unwrap();
    for _ in 0..20 {
        stepper.step().unwrap();
    }
    let most = (MOST.load(Ordering::Relaxed) - before) as f64 / 1e6;
    println!("{most} MB, {:?}", stepper.counters());
    assert!(stepper.counters().events > 0);
    // The scene, its matrices and two series of 32 terms come to some 20 MB; all pairs of masses
    // and walls would be 320 MB.
    assert!(most < 60.0, "{most} MB");
}
