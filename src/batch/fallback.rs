//! An oscillator that the lanes do not support, computed by the scheme `event`.

use super::lane::Lane;
use super::outcome::{AtWall, By, Outcome, grown};
use super::series::REACH;
use crate::error::Result;
use crate::flow::Arc;
use crate::scene::Scene;
use crate::scheme::{Scheme, Stepper};
use crate::step::{Path, Step};
use crate::variation::{OscillatorVariation, saltation};

/// Number of places per radian of the fastest motion at which turning points are looked for.
const LOOKS: f64 = 4.0;

/// Number of bisections after which a turning point is known to rounding.
const HALVINGS: usize = 52;

/// The results of one oscillator over its window.
struct Window {
    walls: [AtWall; 2],
    extent: [f64; 2],
    /// A small change of the initial state, propagated along the motion: m and m/s.
    tangent: [f64; 2],
    /// Propagates the change.
    variation: OscillatorVariation,
    /// ln of its size when the window began, minus ln of the factors by which it was scaled down
    /// since.
    began: f64,
    /// Fastest rate, 1/s.
    rate: f64,
}

/// Computes `settle` periods of `lane`, and then one for each of `strobes`.
pub(super) fn follow(lane: &Lane, settle: u32, strobes: &mut [[f64; 2]]) -> Result<Outcome> {
    let periods = u64::from(settle) + strobes.len() as u64;
    let scene = lane.scene(periods as f64 * lane.period);
    let mut stepper = Stepper::new(&scene, &Scheme::Event, lane.period)?;
    let mut window = Window::new(lane, &scene)?;
    let has_lower = usize::from(lane.lower.is_some());
    // The scene has only the walls that exist, the lower one first.
    let slot = |wall: usize| if wall < has_lower { 0 } else { 1 };
    let mut passed = 0;
    if settle == 0 {
        window.begin(lane.displacement);
    }
    while passed < periods {
        let step = stepper.step()?;
        window.observe(&step, &slot);
        let (end, state) = (step.end, [step.q, step.v].map(|x| x.first().copied().unwrap_or(0.0)));
        // A remainder of half a unit of rounding of the time is not a period.
        if end < (passed + 1) as f64 * lane.period * (1.0 - 1e-14) {
            continue;
        }
        passed += 1;
        window.scale();
        if let Some(strobe) = passed.checked_sub(u64::from(settle) + 1).and_then(|row| strobes.get_mut(row as usize)) {
            *strobe = state;
        }
        if passed == u64::from(settle) {
            window.begin(state[0]);
        }
    }
    for contact in stepper.open_contacts() {
        window.note(slot(contact.wall), contact.peak_force);
    }
    let [lower, upper] = window.walls;
    let exponent = grown(window.began, window.size()) / (strobes.len() as f64 * lane.period);
    Ok(Outcome { by: By::Event, lower, upper, extent: window.extent, exponent })
}

impl Window {
    fn new(lane: &Lane, scene: &Scene) -> Result<Self> {
        let rate = lane.fastest().max(REACH / lane.period);
        Ok(Self {
            walls: [AtWall::default(); 2],
            extent: [f64::NEG_INFINITY, f64::INFINITY],
            tangent: [1.0, rate],
            variation: OscillatorVariation::new(scene)?,
            began: 0.0,
            rate,
        })
    }

    fn size(&self) -> f64 {
        self.tangent[0].hypot(self.tangent[1] / self.rate)
    }

    /// Begins the window at the displacement `q` (m), and the change anew if a rest has made it 0.
    fn begin(&mut self, q: f64) {
        if self.size() == 0.0 {
            self.tangent = [1.0, self.rate];
        }
        self.walls = [AtWall::default(); 2];
        self.extent = [q; 2];
        self.began = self.size().ln();
    }

    /// Scales the change of the initial state to size 1, unless it is zero.
    fn scale(&mut self) {
        let size = self.size();
        if size > 0.0 {
            self.tangent = self.tangent.map(|x| x / size);
            self.began -= size.ln();
        }
    }

    fn note(&mut self, slot: usize, peak: Option<f64>) {
        let known = &mut self.walls[slot].peak_force;
        *known = known.iter().copied().chain(peak).reduce(f64::max);
    }

    fn observe(&mut self, step: &Step<'_>, slot: &impl Fn(usize) -> usize) {
        for (wall, (impulse, jump)) in step.impulse.iter().zip(step.jump).enumerate() {
            let at = &mut self.walls[slot(wall)];
            at.impulse += impulse;
            at.impacts += u64::from(*jump != 0.0);
            at.largest_impulse = at.largest_impulse.max(jump.abs());
        }
        for contact in step.closed {
            self.note(slot(contact.wall), contact.peak_force);
        }
        if let Ok(matrix) = self.variation.over(step) {
            self.tangent = saltation::apply(matrix, self.tangent);
        }
        if let Path::Exact(arc) = step.path {
            self.reach(arc);
        }
    }

    /// The extremes of an arc: at its ends, and at the turning points between them.
    fn reach(&mut self, arc: &Arc) {
        let (from, to) = (arc.start(), arc.end());
        let mut observe = |q: f64| self.extent = [self.extent[0].min(q), self.extent[1].max(q)];
        observe(arc.state(from).0);
        observe(arc.state(to).0);
        if arc.is_rest() {
            return;
        }
        let looks = ((to - from) * self.rate * LOOKS).ceil().clamp(1.0, 1e6) as u32;
        let time = |look: u32| if look == looks { to } else { from + (to - from) * f64::from(look) / f64::from(looks) };
        let mut before = (from, arc.state(from).1);
        for look in 1..=looks {
            let now = (time(look), arc.state(time(look)).1);
            if before.1 * now.1 < 0.0 {
                let (mut low, mut high) = (before.0, now.0);
                for _ in 0..HALVINGS {
                    let mid = 0.5 * (low + high);
                    let same = arc.state(mid).1 * before.1 > 0.0;
                    (low, high) = if same { (mid, high) } else { (low, mid) };
                }
                observe(arc.state(low).0);
            }
            before = now;
        }
    }
}
