//! Changes of the motion of one degree of freedom by keys, flight by flight.
//!
//! A key changes m, c, k, the loads, and what the elastic walls that touch add to them
//! (`touch_change.rs`). So the change at the end of a flight is a combination of the [`Responses`]
//! of the flight.

use super::key_terms::KeyTerms;
use super::keys::Keys;
use super::stretch::ArcEnd;
use super::tangent::{SceneTangent, WallTangent};
use super::touch_change::TouchChange;
use crate::flow::{Arc, INVERSE, Response, Responses, TERMS, add_sine};
use crate::scene::{Forcing, Scene, System};

/// The changes of a motion by keys over an arc.
#[derive(Debug)]
pub(super) struct ArcChanges {
    /// m, c and k of the body.
    body: [f64; 3],
    forcing: Forcing,
    /// The fastest load, rad/s.
    fastest: f64,
    responses: Responses,
    /// Polynomials of the load, and of its changes by the keys that change it, N.
    load: [f64; TERMS],
    forces: Vec<[f64; TERMS]>,
    keys: Vec<LineTerms>,
    /// The responses at the end of an arc.
    ends: Vec<Response>,
}

/// The terms of a key on an arc.
#[derive(Debug, Clone, Default)]
struct LineTerms {
    /// δm, δc and δk of the body.
    body: [f64; 3],
    /// δk, δc and δm, with what the walls that touch add.
    inner: [f64; 3],
    /// What they add to the force, N.
    constant: f64,
    /// The number of its force among those of all keys, if it changes the force.
    force: Option<usize>,
}

impl ArcChanges {
    /// The changes of motions of `scene` by the keys of `tangents`; `None` for a structure.
    pub fn new(scene: &Scene, tangents: &[SceneTangent]) -> Option<Self> {
        let System::Oscillator(body) = scene.system else { return None };
        let elastic = |tangent: &SceneTangent, changes: fn(&WallTangent) -> bool| {
            let mut springs = scene.walls.iter().zip(&tangent.walls).filter(|(wall, _)| wall.law.spring().is_some());
            springs.any(|(_, wall)| changes(wall) || !wall.row.entries().is_empty())
        };
        let (mut forces, mut inner) = (0, false);
        let mut keys = Vec::with_capacity(tangents.len());
        for tangent in tangents {
            let own = tangent.body();
            inner |= own != [0.0; 3] || elastic(tangent, |wall| wall.stiffness != 0.0 || wall.damping != 0.0);
            let pushes =
                !tangent.loads.is_empty() || elastic(tangent, |wall| wall.stiffness != 0.0 || wall.position != 0.0);
            let force = pushes.then_some(forces);
            forces += usize::from(pushes);
            keys.push(LineTerms { body: own, force, ..LineTerms::default() });
        }
        let forcing = Forcing::on(0, &scene.loads);
        Some(Self {
            body: [body.mass, body.damping, body.stiffness],
            fastest: forcing.harmonics.iter().fold(0.0, |most, wave| wave.omega.abs().max(most)),
            forcing,
            responses: Responses::new(forces, inner),
            load: [0.0; TERMS],
            forces: vec![[0.0; TERMS]; forces],
            keys,
            ends: Vec::with_capacity(2 + forces + 3),
        })
    }

    /// m (kg), c (N s/m) and k (N/m) of the body.
    pub fn body(&self) -> [f64; 3] {
        self.body
    }

    /// Propagates `columns`, the changes by `keys` and further ones of the start alone, over `arc`,
    /// without what happens at its ends; notes what the keys change meanwhile. Returns the motion
    /// at the end.
    pub fn pass(&mut self, arc: &Arc, keys: &mut Keys, columns: &mut [f64]) -> ArcEnd {
        for (sizes, change) in keys.sizes.iter_mut().zip(columns.chunks_exact(2)) {
            sizes.iter_mut().zip(change).for_each(|(size, x)| *size = x.abs().max(*size));
        }
        if let Some(wall) = arc.rests_on() {
            return self.rest(arc, wall, keys, columns);
        }
        let [mass, mut damping, mut stiffness] = self.body;
        let mut constant = 0.0;
        for touch in arc.touching_walls() {
            damping += touch.damping;
            stiffness += touch.stiffness;
            constant += touch.stiffness * touch.position;
        }
        self.touch(arc, keys);
        self.responses.begin([mass, damping, stiffness]);
        let stretches = self.responses.divide(arc.span(), self.fastest);
        let mut end = ArcEnd { state: arc.start_state(), acceleration: 0.0 };
        if arc.span() > 0.0 {
            end.state = self.fly((arc, stretches), constant, keys, columns);
            self.change(arc, keys, columns);
        } else {
            self.fill_load(arc.start(), constant, 1);
        }
        let force: f64 = self.load.iter().rev().sum();
        let [q, v] = end.state;
        end.acceleration = (force - damping * v - stiffness * q) / mass;
        end
    }

    /// Sets the terms of the keys, with those of the walls that touch.
    fn touch(&mut self, arc: &Arc, keys: &Keys) {
        for (line, terms) in self.keys.iter_mut().zip(&keys.terms) {
            let [mass, damping, stiffness] = line.body;
            (line.inner, line.constant) = ([stiffness, damping, mass], 0.0);
            for TouchChange { touch, row, own: [a, b, e] } in TouchChange::all(arc, &terms.tangent) {
                line.inner[0] += a + row * touch.stiffness;
                line.inner[1] += b + row * touch.damping;
                line.constant += e + row * touch.stiffness * touch.position;
            }
        }
    }

    /// Computes the responses over `arc`, stretch by stretch, and reads what lies within. Returns
    /// the state at its end.
    fn fly(&mut self, (arc, stretches): (&Arc, usize), constant: f64, keys: &mut Keys, columns: &[f64]) -> [f64; 2] {
        let (unit, terms) = (self.responses.unit(), self.responses.terms());
        for number in 0..stretches {
            let from = arc.start() + number as f64 * unit;
            let state = if number == 0 { arc.start_state() } else { arc.state(from).into() };
            self.fill_load(from, constant, terms);
            self.fill_forces(from, &mut keys.terms);
            for line in &self.keys {
                line.force.and_then(|at| self.forces.get_mut(at)).into_iter().for_each(|f| f[0] += line.constant);
            }
            self.responses.fill(state, &self.load, &self.forces, !keys.means.is_empty());
            let end = if number + 1 == stretches { arc.end() } else { from + unit };
            let change = |key: usize, time: f64| {
                let x = (time - from) / unit;
                self.combined(key, columns, |number| self.responses.state_at(number, x))
            };
            keys.read(end, |time| arc.state(time).into(), change);
        }
        self.responses.own().state
    }

    /// Sets the polynomial of the load, with a `constant` (N), from `from` (s) on.
    fn fill_load(&mut self, from: f64, constant: f64, terms: usize) {
        let unit = self.responses.unit();
        self.load.fill(0.0);
        self.load[0] = self.forcing.constant + constant;
        for table in &self.forcing.tables {
            let (value, slope) = table.piece(from);
            self.load[0] += value;
            self.load[1] += slope * unit;
        }
        for wave in &self.forcing.harmonics {
            add_sine(wave, (from, unit), &mut self.load[..terms]);
        }
    }

    /// Sets the polynomials of its changes by the keys.
    fn fill_forces(&mut self, from: f64, keys: &mut [KeyTerms]) {
        let (unit, terms) = (self.responses.unit(), self.responses.terms());
        for (line, key) in self.keys.iter().zip(keys) {
            let Some(force) = line.force.and_then(|at| self.forces.get_mut(at)) else { continue };
            force.fill(0.0);
            key.add_loads((from, unit), &mut force[..terms]);
        }
    }

    /// The change by a key, with its rate, of which `of` gives the responses.
    fn combined(&self, key: usize, columns: &[f64], of: impl Fn(usize) -> [f64; 2]) -> [f64; 2] {
        let Some((line, start)) = self.keys.get(key).zip(columns.get(2 * key..2 * key + 2)) else { return [0.0; 2] };
        let mut sum = [0.0; 2];
        let mut add = |share: f64, number: usize| {
            if share != 0.0 {
                sum.iter_mut().zip(of(number)).for_each(|(sum, x)| *sum += share * x);
            }
        };
        add(start[0], 0);
        add(start[1], 1);
        line.force.into_iter().for_each(|force| add(1.0, 2 + force));
        if let Some(first) = self.responses.inner() {
            line.inner.iter().enumerate().for_each(|(order, share)| add(-share, first + order));
        }
        sum
    }

    /// Gives the columns their values at the end of `arc`, and adds what the keys change over it to
    /// means and impulses.
    fn change(&mut self, arc: &Arc, keys: &mut Keys, columns: &mut [f64]) {
        let own = self.responses.own();
        self.ends.clear();
        self.ends.extend((0..self.responses.count()).map(|number| self.responses.response(number)));
        let ends = &self.ends;
        let [q0, _] = arc.start_state();
        for key in 0..self.keys.len() {
            let state = self.combined(key, columns, |number| ends[number].state);
            let Some(terms) = keys.terms.get(key) else { continue };
            if !keys.means.is_empty() || arc.touches() {
                let sums = self.combined(key, columns, |number| ends[number].integrals);
                keys.means.add_flight(key, own.integrals, sums, terms);
                for TouchChange { touch, own: [a, b, e], .. } in TouchChange::all(arc, &terms.tangent) {
                    let (stiffness, damping) = (touch.stiffness, touch.damping);
                    let [q, v] = own.state;
                    let force = e - stiffness * state[0] - damping * state[1] - a * q - b * v;
                    let began = columns.get(2 * key).copied().unwrap_or(0.0);
                    let rubbed = damping * (state[0] - began) + b * (q - q0);
                    let impulse = e * arc.span() - stiffness * sums[0] - a * own.integrals[0] - rubbed;
                    keys.contacts.add_impulse(touch.wall, key, impulse);
                    keys.contacts.set_force(touch.wall, key, force);
                }
            }
            columns.iter_mut().skip(2 * key).zip(state).for_each(|(x, new)| *x = new);
        }
        let [from_q, from_v] = [0, 1].map(|number| ends[number].state);
        for change in columns.chunks_exact_mut(2).skip(self.keys.len()) {
            if let &mut [q, v] = change {
                change.copy_from_slice(&[0, 1].map(|i: usize| from_q[i] * q + from_v[i] * v));
            }
        }
    }

    /// The same for a body at rest on wall `wall`: it stays there, where the key moves it, and the
    /// change of the reaction balances those of all other forces.
    fn rest(&mut self, arc: &Arc, wall: usize, keys: &mut Keys, columns: &mut [f64]) -> ArcEnd {
        let ([q, _], span, stiffness) = (arc.start_state(), arc.span(), self.body[2]);
        let others: f64 = arc.touching_walls().map(|touch| -touch.stiffness * (q - touch.position)).sum();
        let loads = self.loads_at_rest(arc, &mut keys.terms);
        columns.iter_mut().skip(2 * self.keys.len()).for_each(|x| *x = 0.0);
        // The reaction at the end, N, and its integral, N s.
        let steady = stiffness * q - others;
        let reaction = [steady - loads.0[0], steady * span - loads.0[1]];
        for (key, terms) in keys.terms.iter().enumerate() {
            let moved = -terms.offset(wall, &[q]);
            columns.iter_mut().skip(2 * key).zip([moved, 0.0]).for_each(|(x, new)| *x = new);
            let line = self.keys.get(key);
            let mut steady = stiffness * moved + line.map_or(0.0, |line| line.body[2] * q);
            for TouchChange { touch, row, own: [a, _, e] } in TouchChange::all(arc, &terms.tangent) {
                let push = e - touch.stiffness * moved - a * q;
                steady -= push - row * touch.stiffness * (q - touch.position);
                keys.contacts.add_impulse(touch.wall, key, push * span);
                keys.contacts.set_force(touch.wall, key, push);
            }
            let force = line.and_then(|line| loads.1.get(line.force?)).copied().unwrap_or_default();
            let row = terms.along(wall, &[1.0]);
            keys.contacts.set_force(wall, key, steady - force[0] - row * reaction[0]);
            keys.contacts.add_impulse(wall, key, steady * span - force[1] - row * reaction[1]);
            keys.means.add_flight(key, [q * span, q * q * span], [moved * span, q * moved * span], terms);
        }
        let change = |key: usize, _: f64| [columns.get(2 * key).copied().unwrap_or(0.0), 0.0];
        keys.read(arc.end(), |_| [q, 0.0], change);
        ArcEnd { state: [q, 0.0], acceleration: 0.0 }
    }

    /// The load at the end of an arc at rest (N) and its integral (N s), and the same of its change
    /// by each key that changes it.
    fn loads_at_rest(&mut self, arc: &Arc, keys: &mut [KeyTerms]) -> ([f64; 2], Vec<[f64; 2]>) {
        let (mut own, mut changes) = ([0.0; 2], vec![[0.0; 2]; self.forces.len()]);
        self.responses.begin([1.0, 0.0, 0.0]);
        let stretches = self.responses.divide(arc.span(), self.fastest);
        let (unit, terms) = (self.responses.unit(), self.responses.terms());
        let add = |sums: &mut [f64; 2], force: &[f64; TERMS]| {
            sums[0] = force.iter().rev().sum();
            sums[1] += unit * force.iter().zip(&INVERSE).rev().map(|(f, inverse)| f * inverse).sum::<f64>();
        };
        for number in 0..stretches {
            let from = arc.start() + number as f64 * unit;
            self.fill_load(from, 0.0, terms);
            self.fill_forces(from, keys);
            add(&mut own, &self.load);
            changes.iter_mut().zip(&self.forces).for_each(|(sums, force)| add(sums, force));
        }
        (own, changes)
    }
}
