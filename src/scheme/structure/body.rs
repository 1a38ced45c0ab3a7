//! What every scheme knows of the scene.

use super::frame::Frame;
use crate::linear::{Factor, Operator, Rows, Symmetric};
use crate::scene::{Loads, Scene, SharedStructure};
use crate::scheme::stop::Stop;

/// The structure as a kernel wants it.
#[derive(Debug)]
pub(super) struct Body {
    pub n: usize,
    pub h: f64,
    pub matrices: SharedStructure,
    pub mass: Operator,
    pub damping: Operator,
    pub stiffness: Operator,
    pub loads: Loads,
    /// The walls, and the row of each.
    pub walls: Vec<Stop>,
    pub rows: Rows,
    /// Distance within which a wall counts as touched, m: 1e-12 of the gap scale.
    pub touch: f64,
    /// When the motion began or was taken up anew, s.
    since: f64,
    /// M factored: what a blow changes of the velocity. None without blows.
    inertia: Option<Factor>,
    blow: Vec<f64>,
    /// True if C is not zero.
    pub damped: bool,
    /// Where the blows of the step take the displacement beside its own rule, m, and what they make of the velocity, m/s.
    pub shift: Vec<f64>,
    pub given: Vec<f64>,
    /// Force of each part of the loads at the end of the last step and of the present one, N.
    load: [Vec<f64>; 2],
}

impl Body {
    pub fn new(scene: &Scene, h: f64) -> Self {
        let matrices = scene.system.structure();
        let loads = Loads::new(&scene.loads);
        let n = matrices.mass.size();
        let mut load = [vec![0.0; loads.parts().len()], vec![0.0; loads.parts().len()]];
        loads.forces(0.0, &mut load[0]);
        Self {
            n,
            h,
            mass: Operator::new(&matrices.mass),
            damping: Operator::new(&matrices.damping),
            stiffness: Operator::new(&matrices.stiffness),
            walls: scene.walls.iter().map(Stop::new).collect(),
            rows: Rows::new(n, scene.walls.iter().map(|wall| wall.at.entries())),
            touch: scene.touching_distance(),
            since: 0.0,
            // A mass that cannot be factored is refused by the scene.
            inertia: if loads.has_blows() { matrices.mass_factor().ok() } else { None },
            blow: vec![0.0; n],
            damped: matrices.damping.diagonal_entries().iter().any(|&c| c != 0.0),
            shift: vec![0.0; n],
            given: vec![0.0; n],
            load,
            loads,
            matrices,
        }
    }

    /// Takes the motion up anew at `time` (s).
    pub fn restart(&mut self, time: f64) {
        self.since = time;
        self.loads.forces(time, &mut self.load[0]);
    }

    /// When the motion began or was taken up anew, s.
    pub fn since(&self) -> f64 {
        self.since
    }

    /// The θ-method's A = M + hθC + h²θ²K, and C + hθK.
    pub fn theta_matrices(&self, theta: f64) -> (Symmetric, Operator) {
        let (m, ht) = (&self.matrices, self.h * theta);
        let a = Symmetric::sum(&[(1.0, &m.mass), (ht, &m.damping), (ht * ht, &m.stiffness)]);
        (a, Operator::new(&Symmetric::sum(&[(1.0, &m.damping), (ht, &m.stiffness)])))
    }

    /// Writes h[f_θ + f_x − (C + hθK) v − K q] to `b`, N s, `drag` being C + hθK, and notes the velocity before the step. Once a step.
    #[inline]
    pub fn theta_momentum(&mut self, theta: f64, drag: &Operator, frame: &mut Frame, b: &mut [f64]) {
        let h = self.h;
        b.iter_mut().zip(&frame.extra).for_each(|(b, extra)| *b = h * extra);
        self.add_load(frame.end, h * (1.0 - theta), h * theta, b);
        drag.add_product(-h, &frame.v, b);
        self.stiffness.add_product(-h, &frame.q, b);
        frame.before.copy_from_slice(&frame.v);
    }

    /// Adds `before` times the load at the end of the last step and `after` times that at `end` (s), the end of this one, to `out`. Once a step.
    #[inline]
    pub fn add_load(&mut self, end: f64, before: f64, after: f64, out: &mut [f64]) {
        let [last, next] = &mut self.load;
        self.loads.forces(end, next);
        self.loads.scatter(last.iter().zip(&*next).map(|(a, b)| before * a + after * b), out);
        self.load.swap(0, 1);
    }

    /// The blows in (from, to]: adds `scale` times them to `b` (N s times that) and writes the velocity they leave to `struck`, given `v`. Returns
    /// whether there was one.
    #[inline]
    pub fn strike(&mut self, (from, to): (f64, f64), v: &[f64], scale: f64, b: &mut [f64], struck: &mut [f64]) -> bool {
        if !self.loads.has_blows() || !self.loads.blow(from, to, &mut self.blow) {
            return false;
        }
        self.apply_blow(v, scale, b, struck);
        true
    }

    /// The same for the blows within half a step of the instant step · h.
    pub fn strike_about(&mut self, step: u64, v: &[f64], scale: f64, b: &mut [f64], struck: &mut [f64]) -> bool {
        if !self.loads.has_blows() || !self.loads.blow_about_since(self.since, step, self.h, &mut self.blow) {
            return false;
        }
        self.apply_blow(v, scale, b, struck);
        true
    }

    fn apply_blow(&mut self, v: &[f64], scale: f64, b: &mut [f64], struck: &mut [f64]) {
        b.iter_mut().zip(&self.blow).for_each(|(b, blow)| *b += scale * blow);
        if let Some(inertia) = &mut self.inertia {
            inertia.solve(&mut self.blow);
        }
        for ((struck, v), change) in struck.iter_mut().zip(v).zip(&self.blow) {
            *struck = v + change;
        }
    }

    /// Writes where the blows in each (from, to] take the displacement by `about` (s) beside what a step makes of their sum to
    /// [`Body::shift`], and the velocity that they give to [`Body::given`]. Returns whether there was one.
    #[inline]
    pub fn find_blows(&mut self, spans: &[(f64, f64, f64)]) -> bool {
        self.loads.has_blows() && self.sum_blows(spans)
    }

    fn sum_blows(&mut self, spans: &[(f64, f64, f64)]) -> bool {
        let Self { loads, inertia, blow, shift, given, .. } = self;
        let mut any = false;
        shift.fill(0.0);
        given.fill(0.0);
        for &(from, to, about) in spans {
            any |= loads.blow(from, to, blow);
            given.iter_mut().zip(blow.iter()).for_each(|(sum, blow)| *sum += blow);
            any |= loads.blow_moment(from, to, about, blow);
            shift.iter_mut().zip(blow.iter()).for_each(|(sum, blow)| *sum += blow);
        }
        if let (true, Some(inertia)) = (any, inertia) {
            inertia.solve(shift);
            inertia.solve(given);
        }
        any
    }

    /// Takes the structure to where the blows of the step leave it, unless a rigid wall that pushes was what they drove into.
    #[inline]
    pub fn land(&mut self, spans: &[(f64, f64, f64)], frame: &mut Frame) {
        if self.find_blows(spans) && !self.answers(&frame.pushing) {
            self.shift(&mut frame.q);
        }
    }

    /// Adds what the blows found add to the displacement to `q`.
    #[inline]
    pub fn shift(&self, q: &mut [f64]) {
        q.iter_mut().zip(&self.shift).for_each(|(q, shift)| *q += shift);
    }

    /// True if a rigid one of the walls `pushing` is what the blows found drive into.
    pub fn answers(&self, pushing: &[usize]) -> bool {
        pushing.iter().any(|&wall| self.drives(wall))
    }

    /// True if the blows found drive into a wall, and it is rigid.
    pub fn drives(&self, wall: usize) -> bool {
        let stop = self.walls[wall];
        stop.law.is_rigid() && stop.sign * self.rows.dot(wall, &self.given) < 0.0
    }

    /// Adds −`scale` C d to `b`: what the damper feels of the way on which the blows found take the displacement.
    pub fn damp_shift(&self, scale: f64, b: &mut [f64]) {
        self.damping.add_product(-scale, &self.shift, b);
    }

    /// Adds what the blows in (from, to] make of the velocity to `v`.
    pub fn kick(&mut self, from: f64, to: f64, v: &mut [f64]) {
        if !self.loads.has_blows() || !self.loads.blow(from, to, &mut self.blow) {
            return;
        }
        if let Some(inertia) = &mut self.inertia {
            inertia.solve(&mut self.blow);
        }
        v.iter_mut().zip(&self.blow).for_each(|(v, change)| *v += change);
    }

    /// Adds the signed `forces` of all walls to `out`, each by its row.
    #[inline]
    pub fn push(&self, scale: f64, forces: &[f64], out: &mut [f64]) {
        for (wall, &force) in forces.iter().enumerate() {
            if force != 0.0 {
                self.rows.add_transposed(wall, scale * force, out);
            }
        }
    }
}
