//! Blows, whose impulses or instants keys change.

use super::key_terms::{Instant, KeyTerms};
use super::keys::Keys;
use super::no_derivative::NoDerivative;
use super::structure::{At, StructureVariation, name_of};
use crate::flow::Propagator;
use crate::step::Step;

impl StructureVariation {
    /// Gives the blows at the end of `step` to the state and to the columns of keys; false if there
    /// are none, or no keys. Keys that move a blow into an impact or a rest, or to where it begins
    /// or ends a push, are given up ([`NoDerivative::Blow`]).
    pub fn take_blow(&mut self, step: &Step<'_>, columns: &mut [f64]) -> bool {
        let Self { flow, walls, names, during, after: held_after, q, v, a, wall_of, keys, .. } = self;
        let n = q.len();
        let mut after = vec![0.0; n];
        let time = step.end;
        if time <= 0.0 || !keys.loads.blow(time.next_down(), time, &mut after) {
            return false;
        }
        let acts = |(wall, at): (usize, &At)| {
            let held = during[at.row] || held_after[at.row];
            step.jump[wall] != 0.0 || at.during != at.after || (at.restitution.is_some() && held)
        };
        let touched = walls.iter().enumerate().position(acts);
        flow.body.solve(&mut after);
        after.iter_mut().zip(&*v).for_each(|(after, v)| *after += v);
        let at = Instant { time, q, before: v, after: &after, acceleration: a, impulse: &[], wall_of };
        let (mut moving, still, mut faster) = (Vec::new(), vec![0.0; n], vec![0.0; n]);
        for (number, (terms, change)) in keys.terms.iter().zip(columns.chunks_exact_mut(2 * n)).enumerate() {
            let (dq, dv) = change.split_at_mut(n);
            terms.add_blow(flow, &at, dv);
            let Some(moved) = terms.moved_blow(flow, time) else { continue };
            moving.push(number);
            // (q̈⁻ − q̈⁺) δt, by the dampers and by the dashpots of walls that push throughout.
            faster.fill(0.0);
            flow.body.add_force(&still, &moved, &mut faster);
            for (wall, at) in walls.iter().enumerate().filter(|(_, at)| at.during && at.after) {
                let eased = -at.damping * flow.body.rows.dot(at.row, &moved);
                flow.body.rows.add_transposed(at.row, eased, &mut faster);
                keys.contacts.add_impulse(wall, number, eased);
            }
            flow.body.solve(&mut faster);
            dq.iter_mut().zip(&moved).for_each(|(q, change)| *q += change);
            dv.iter_mut().zip(&faster).for_each(|(v, faster)| *v += faster);
        }
        if let Some(wall) = touched {
            keys.lose(moving, &NoDerivative::Blow { time, wall: name_of(names, wall) });
        }
        v.copy_from_slice(&after);
        true
    }
}

impl Keys {
    /// The column of each key at the start, 2n entries each: δq, then δq̇ with the blows at t = 0.
    pub fn start(&self, flow: &mut Propagator, v: &[f64]) -> Vec<f64> {
        let n = v.len();
        let mut blown = vec![0.0; n];
        self.loads.initial_blow(&mut blown);
        flow.body.solve(&mut blown);
        let after: Vec<f64> = v.iter().zip(&blown).map(|(v, change)| v + change).collect();
        let of = |terms: &KeyTerms, flow: &mut Propagator| {
            let at = Instant { time: 0.0, q: v, before: v, after: &after, acceleration: v, impulse: &[], wall_of: &[] };
            let mut change = terms.tangent.v.clone();
            terms.add_blow(flow, &at, &mut change);
            [terms.tangent.q.clone(), change].concat()
        };
        self.terms.iter().flat_map(|terms| of(terms, flow)).collect()
    }
}
