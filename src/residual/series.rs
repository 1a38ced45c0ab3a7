//! Checks of a structure's exact motion.
//!
//! A stretch lasts at most two radians of its fastest motion, so that Gauss's rule of ten points
//! integrates powers, which have twice that rate, to 1e-20 of their size. If the fastest rate were
//! underestimated, the energy ledger would not close.

use super::deepest::{behind, deepest};
use super::energy::{Ledger, Moved};
use super::quadrature::{Panel, nodes};
use super::{Judge, PLACE_UNITS};
use crate::flow::Series;
use crate::step::Step;

/// Rounding error of the momenta at the ends of a stretch, in units in the last place of the run's
/// largest momentum.
const MOMENTUM_UNITS: f64 = 4.0;

impl Judge {
    pub(super) fn observe_series(&mut self, step: &Step<'_>, series: &Series) {
        for (index, wall) in self.scene.walls.iter().enumerate() {
            self.walls.tension = self.walls.tension.max(-wall.sign() * step.jump[index]);
        }
        let mut moved = Moved::default();
        self.series.left.copy_from_slice(step.velocity_before);
        if step.end > step.start {
            self.follow(step, series, &mut moved);
            // The velocity at the end, from the left.
            let s = &mut self.series;
            series.state(step.end, &mut s.q, &mut s.left);
            self.weigh(step, series);
        }
        let s = &mut self.series;
        for (i, mid) in s.mid.iter_mut().enumerate() {
            *mid = s.left[i] + self.blows.struck[i];
            self.normal_speed = self.normal_speed.max(mid.abs() * self.weights.root_mass[i]);
        }
        if self.supports.is_some() {
            self.strike_holes(step);
        }
        let s = &self.series;
        self.energy.observe_series(step, moved, &self.blows.impulse, &s.left, &s.mid);
    }

    /// Integrates over the stretch, and checks the walls' laws at the nodes. Leaves ∫ of the net
    /// force in `net`, N s.
    fn follow(&mut self, step: &Step<'_>, series: &Series, moved: &mut Moved) {
        let s = &mut self.series;
        for sum in [&mut s.net, &mut s.place, &mut s.way] {
            sum.fill(0.0);
        }
        let system = &self.scene.system;
        for (t, weight) in nodes(Panel::new(step.start, step.end, series.rate())) {
            series.state(t, &mut s.q, &mut s.v);
            s.load.copy_from_slice(step.extra);
            self.loads.add_force(t, 1.0, &mut s.load);
            let power: f64 = s.load.iter().zip(&s.v).map(|(f, v)| f * v).sum();
            moved.work += weight * power;
            moved.passed += weight * power.abs();
            moved.damping += weight * system.damping_form(&s.v, &s.v);
            for i in 0..s.net.len() {
                s.net[i] += weight * s.load[i];
                s.place[i] += weight * s.q[i];
                s.way[i] += weight * s.v[i];
                let weight = self.weights.root_mass[i];
                self.balance.raise_scale(s.load[i].abs() / weight);
                self.normal_speed = self.normal_speed.max(s.v[i].abs() * weight);
            }
            self.noise.state(&s.q, &s.v, 0.0, &self.weights);
            let force = |wall: usize| series.contact_force(wall, t);
            moved.largest = moved.largest.max(Ledger::energy_at(&self.scene, &s.q, &s.v, force));
            for (index, wall) in self.scene.walls.iter().enumerate().filter(|(_, wall)| !wall.is_round()) {
                let (sign, r) = (wall.side().sign(), force(index));
                let (w, rate) = (wall.row().dot(&s.q), wall.row().dot(&s.v));
                let pressure = sign * r;
                let (gap, rigid) = (wall.gap(w), wall.law.is_rigid());
                self.walls.observe_force(&mut self.noise, index, (pressure, pressure.abs()), rigid);
                self.walls.observe_depth(index, -gap);
                for &(i, g) in wall.row().entries() {
                    s.net[i] += weight * g * r;
                }
                let size = wall.row().size(&s.q) + wall.position().abs() + rate.abs() * t;
                if rigid {
                    self.walls.observe_gap(&self.noise, index, (gap, size), pressure);
                    continue;
                }
                if wall.law.is_damped() {
                    moved.push -= weight * r * rate;
                }
                let rounding = PLACE_UNITS * f64::EPSILON * size;
                let law = |depth: f64| wall.law.pressure(depth, -sign * rate);
                let (low, high) = (law(-gap - rounding), law(-gap + rounding));
                self.walls.observe_law(&self.noise, index, (low - pressure).max(pressure - high), 0.0);
            }
        }
        if self.supports.is_some() {
            self.follow_holes(step, series);
        }
        self.follow_depths(step, series);
        self.scale_by_dashpots(step.end - step.start);
        let (s, system) = (&mut self.series, &self.scene.system);
        system.add_damping(-1.0, &s.way, &mut s.net);
        system.add_stiffness(-1.0, &s.place, &mut s.net);
    }

    /// Notes the largest depth behind each elastic wall that pushes.
    fn follow_depths(&mut self, step: &Step<'_>, series: &Series) {
        let (span, middle) = ([step.start, step.end], 0.5 * (step.start + step.end));
        let (q, v) = (&mut self.series.q, &mut self.series.v);
        for (index, wall) in self.scene.walls.iter().enumerate() {
            if wall.is_round() || wall.law.is_rigid() || series.contact_force(index, middle) == 0.0 {
                continue;
            }
            let motion = |t: f64| {
                series.state(t, q, v);
                behind(wall, q, v)
            };
            self.walls.observe_depth(index, deepest(span, series.rate(), motion));
        }
    }

    /// Notes the mean force of the dashpots over `span` seconds: without loads and springs it is
    /// the only force.
    fn scale_by_dashpots(&mut self, span: f64) {
        let s = &mut self.series;
        s.rub.fill(0.0);
        self.scene.system.add_damping(1.0 / span, &s.way, &mut s.rub);
        for (force, weight) in s.rub.iter().zip(&self.weights.root_mass) {
            self.balance.raise_scale(force.abs() / weight);
        }
    }

    /// Checks the momentum balance: M(v₁ − v₀) minus the impulse of the net force over the stretch,
    /// and the change of momentum between the end of the last step and the start of the stretch.
    ///
    /// A structure that comes to rest on a wall is stopped exactly, which removes a small momentum
    /// in no time: up to some thousand units in the last place of the largest momentum were seen.
    /// Divided by the length of a stretch of some ulps of the time, it would give a force of any
    /// size. So it is measured as an impulse: by the force that would give it within one radian of
    /// the fastest motion.
    fn weigh(&mut self, step: &Step<'_>, series: &Series) {
        let s = &mut self.series;
        let span = step.end - step.start;
        let radian = (1.0 / series.rate()).min(self.scene.duration).max(span);
        series.state(step.start, &mut s.q, &mut s.v);
        for (from, to, momentum) in
            [(&s.v[..], &s.left[..], &mut s.gained), (step.velocity_before, &s.v, &mut s.stopped)]
        {
            s.change.iter_mut().zip(to.iter().zip(from)).for_each(|(change, (to, from))| *change = to - from);
            momentum.fill(0.0);
            self.scene.system.add_mass(1.0, &s.change, momentum);
        }
        // Over so short a stretch the rounding error of the momentum would count as a force, too.
        let rounding = MOMENTUM_UNITS * f64::EPSILON * self.normal_speed;
        let (mut worst, mut doubtful) = (0.0_f64, 0.0_f64);
        for (i, weight) in self.weights.root_mass.iter().enumerate() {
            let (open, stopped) = (s.gained[i] - s.net[i], s.stopped[i]);
            let beyond = |open: f64| (open.abs() - rounding * weight).max(0.0);
            let force = (beyond(open) / span).max(beyond(stopped) / radian);
            self.balance.raise_largest(force);
            worst = worst.max(force / weight);
            doubtful = doubtful.max(beyond(open + stopped) / (span * weight));
        }
        let balance = &mut self.balance.force;
        balance.value = balance.value.max(worst);
        balance.excess.observe(doubtful - self.noise.force(), self.noise.end, None);
    }
}
