//! What the events of a structure make of changes.

use super::jump::{Jump, Struck};
use super::key_terms::Instant;
use super::keys::Keys;
use super::no_derivative::NoDerivative;
use super::stretch::Stretch;
use super::structure::{At, StructureVariation, name_of};
use crate::flow::{Propagator, held};
use crate::step::Step;

/// A row that leaves an impact with less than this share of e times its approach speed has come to
/// rest: the scheme has skipped the remaining impacts of an accumulation.
pub(super) const STUCK: f64 = 0.5;

/// A row whose departure speed differs from e times its approach speed by more than this share was
/// struck more than once.
pub(super) const ONCE: f64 = 1e-6;

/// A change that is this small a share of its terms is rounding: where a body touches, it keeps the
/// body on the wall.
const ROUNDING: f64 = 1e-9;

/// A body grazes a wall where it is this near, as a share of the scene's gap scale, and no faster
/// than a fall from a hundred times that height makes it.
pub(super) const GRAZING: f64 = 1e-10;

type Done = std::result::Result<(), NoDerivative>;

impl At {
    /// True for another wall at the same place, to within `near` (m), that stops a body or pushes
    /// it by a dashpot as soon as it is there.
    pub fn shares_place(&self, other: &At, near: f64) -> bool {
        let sudden = other.restitution.is_some() || other.damping > 0.0;
        let same = other.row == self.row && other.sign == self.sign && (other.position - self.position).abs() <= near;
        sudden && same
    }
}

impl StructureVariation {
    /// Applies the matrix of coming to rest for rows that are held from here on without an impact:
    /// they were at rest already, to rounding.
    pub fn come_to_rest(&mut self, time: f64, columns: &mut [f64]) {
        let Self { flow, walls, names, jump, during, after, hold, q, v, a, wall_of, keys, .. } = self;
        let rows = 0..during.len();
        let fresh: Vec<Struck> = rows.clone().filter(|&row| during[row] && !after[row]).map(Struck::resting).collect();
        if fresh.is_empty() {
            return;
        }
        let at = Instant { time, q, before: v, after: v, acceleration: a, impulse: &[], wall_of };
        for s in &fresh {
            keys.contacts.begin(wall_of[s.row]);
            keys.lose_touched((flow, names), (s.row, wall_of[s.row]), &at, columns, true);
        }
        let held_rows = rows.filter(|&row| during[row]);
        hold.set(&flow.body, held_rows.clone().map(held), std::iter::empty());
        jump.begin(flow, &fresh, held_rows.filter(|&row| after[row]));
        jump.kick(flow, hold, |flow, _, shift, force| {
            for at in walls.iter().filter(|at| at.during) {
                let rate = flow.body.rows.dot(at.row, shift);
                flow.body.rows.add_transposed(at.row, at.damping * rate, force);
            }
        });
        jump.apply_to(flow, columns, &keys.terms, &at);
    }

    /// Rows that `step` leaves at rest on rigid walls without an impact: the last of impacts that
    /// accumulate, too small to be told from rounding. The contacts begin, and the impulses hold
    /// the rows from here on.
    pub(super) fn rest_after_impacts(&mut self, step: &Step<'_>, columns: &[f64]) {
        let Self { flow, walls, jump, during, after, q, v, a, wall_of, keys, .. } = self;
        let begins = |(wall, at): (usize, &At)| {
            let rests = at.restitution.is_some() && step.force[wall] != 0.0 && !during[at.row];
            rests.then_some((wall, at.row))
        };
        let fresh: Vec<(usize, usize)> = walls.iter().enumerate().filter_map(begins).collect();
        if fresh.is_empty() || keys.terms.is_empty() || step.index == 0 {
            return;
        }
        for &(wall, row) in &fresh {
            keys.contacts.begin_again(wall, (1.0 - ROUNDING) * step.end);
            wall_of[row] = wall;
        }
        let struck: Vec<Struck> = fresh.iter().map(|&(_, row)| Struck::resting(row)).collect();
        jump.begin(flow, &struck, (0..during.len()).filter(|&row| during[row] && after[row]));
        let at = Instant { time: step.end, q, before: v, after: v, acceleration: a, impulse: step.jump, wall_of };
        let n = q.len();
        for (number, (terms, change)) in keys.terms.iter().zip(columns.chunks_exact(2 * n)).enumerate() {
            let impulses = jump.impulses(flow, change.split_at(n), terms, &at);
            for (row, impulse) in impulses.into_iter().enumerate().filter(|(row, _)| after[*row]) {
                keys.contacts.add_impulse(at.wall_of[row], number, impulse);
            }
        }
    }

    /// Notes which rigid walls the body stands at after `step`: those that it has touched and not
    /// left since by more than counts as near.
    pub fn note_standing(&mut self, step: &Step<'_>) {
        let Self { flow, walls, during, after, length, keys, .. } = self;
        if keys.terms.is_empty() {
            return;
        }
        for (at, &p) in walls.iter_mut().zip(step.jump).filter(|(at, _)| at.restitution.is_some()) {
            let touched = at.stands || during[at.row] || after[at.row];
            let place = || flow.body.rows.dot(at.row, step.q) - at.position;
            at.stands = p != 0.0 || (touched && place().abs() <= GRAZING * *length);
        }
    }

    /// An error where a rigid wall is touched at the end of `step` without speed, unless the body
    /// is just leaving it: since its contact it has not been away, and it goes ever faster.
    pub(super) fn check_grazes(&mut self, step: &Step<'_>, stretch: &Stretch<'_>) -> Done {
        if self.keys.terms.is_empty() {
            return Ok(());
        }
        let Self { flow, walls, names, during, after, q, v, a, work, length, .. } = self;
        let (near, mut halfway) = (GRAZING * *length, false);
        for (wall, at) in walls.iter().enumerate() {
            if at.restitution.is_none() || during[at.row] || after[at.row] {
                continue;
            }
            let [place, rate, pull] = [step.q, step.v, &a[..]].map(|x| flow.body.rows.dot(at.row, x));
            if (place - at.position).abs() > near || rate * rate > 200.0 * near * pull.abs() {
                continue;
            }
            if !std::mem::replace(&mut halfway, true) {
                stretch.middle_state(q, work);
            }
            let away = (flow.body.rows.dot(at.row, q) - at.position).abs() > near;
            let leaves = at.stands && !away && at.sign * rate > 0.0 && at.sign * pull > 0.0;
            if !leaves {
                return Err(NoDerivative::Graze { time: step.end, wall: name_of(names, wall) });
            }
        }
        if halfway {
            stretch.end_state(q, v, a);
        }
        Ok(())
    }

    /// The impacts at the end of `step`, after its blows if it is `blown`.
    pub(super) fn impact(&mut self, step: &Step<'_>, stretch: &Stretch<'_>, blown: bool, columns: &mut [f64]) -> Done {
        let Self { flow, walls, names, jump, during, after, wall_of, v, a, length, keys, .. } = self;
        let (mut struck, mut passing): (Vec<Struck>, Vec<usize>) = (Vec::new(), Vec::new());
        for row in 0..during.len() {
            let mut here = walls.iter().enumerate().filter(|(_, at)| at.row == row);
            let Some((wall, first)) = here.find(|(wall, _)| step.jump[*wall] != 0.0) else { continue };
            // Walls at the same place, whether they take part of the impulse or not: were one of
            // them nearer, it would be struck.
            let near = GRAZING * *length;
            let others: Vec<(usize, &At)> =
                walls.iter().enumerate().filter(|(other, at)| *other != wall && first.shares_place(at, near)).collect();
            for other in &others {
                let walls = [wall, other.0].map(|wall| name_of(names, wall)).to_vec();
                keys.lose(keys.differing(wall, other.0), &NoDerivative::Together { time: step.end, walls });
            }
            wall_of[row] = wall;
            let e = others.iter().filter_map(|(_, at)| at.restitution).chain(first.restitution).fold(0.0, f64::max);
            let [speed, left, acceleration] = [&v[..], step.v, &a[..]].map(|x| flow.body.rows.dot(row, x));
            if (during[row] && !blown) || speed == 0.0 {
                passing.push(row);
                continue;
            }
            let rests = after[row] || (e > 0.0 && left.abs() < STUCK * e * speed.abs());
            if !rests && (left + e * speed).abs() > ONCE * speed.abs() {
                return Err(together(names, step));
            }
            if rests && e == 0.0 {
                let raised = keys.those(|terms| terms.restitution(wall) != 0.0);
                keys.lose(raised, &NoDerivative::Rebounds { time: step.end, wall: name_of(names, wall) });
            }
            after[row] |= rests;
            let (restitution, pull) = if rests { (0.0, 0.0) } else { (e, acceleration / speed) };
            struck.push(Struck { row, restitution, rests, held: blown, speed, pull });
        }
        jump.begin(flow, &struck, passing.into_iter());
        let turned = walls.iter().any(|at| at.during != at.after && at.damping > 0.0);
        let released = (0..during.len()).any(|row| during[row] && !after[row]);
        if struck.len() > 1 && (turned || released || jump.is_coupled(flow)) {
            return Err(together(names, step));
        }
        self.kick(step, stretch);
        let Self { flow, walls, names, jump, during, q, v, a, wall_of, keys, .. } = self;
        let at = Instant { time: step.end, q, before: v, after: step.v, acceleration: a, impulse: step.jump, wall_of };
        let fixed = blown || (step.index == 0 && step.end <= step.start);
        let free = struck.iter().filter(|s| fixed && !during[s.row]);
        free.for_each(|s| keys.lose_touched((flow, names), (s.row, at.wall_of[s.row]), &at, columns, false));
        if !keys.note_impacts((flow, jump), (walls, &struck), (step, stretch), &at, columns) {
            return Err(together(names, step));
        }
        jump.apply_to(flow, columns, &keys.terms, &at);
        Ok(())
    }

    /// Computes the vectors wᵢ of the impacts that `jump` has begun.
    fn kick(&mut self, step: &Step<'_>, stretch: &Stretch<'_>) {
        let Self { flow, walls, jump, during, after, hold, .. } = self;
        hold.set(&flow.body, (0..after.len()).filter(|&row| after[row]).map(held), std::iter::empty());
        let before = |wall: usize| stretch.force_at_end(wall);
        jump.kick(flow, hold, |flow, s, shift, force| {
            for (wall, at) in walls.iter().enumerate() {
                let push = match (at.restitution, at.during, at.after) {
                    // A reaction that ends with the impact.
                    (Some(_), ..) if during[at.row] && !after[at.row] => -before(wall) / s.speed,
                    (None, true, true) => at.damping * flow.body.rows.dot(at.row, shift),
                    (None, true, false) | (None, false, true) => (step.force[wall] - before(wall)) / s.speed,
                    _ => continue,
                };
                flow.body.rows.add_transposed(at.row, push, force);
            }
        });
    }
}

/// The error of walls struck at the end of `step`.
fn together(names: &[String], step: &Step<'_>) -> NoDerivative {
    let pushed = names.iter().zip(step.jump).filter(|(_, p)| **p != 0.0);
    NoDerivative::Together { time: step.end, walls: pushed.map(|(name, _)| name.clone()).collect() }
}

impl Keys {
    /// Gives up the keys that, or whose changes so far, would move a row from the `wall` that it
    /// touches at an instant that is fixed, or at rest give it a speed.
    pub(super) fn lose_touched(
        &mut self,
        (flow, names): (&Propagator, &[String]),
        (row, wall): (usize, usize),
        at: &Instant<'_>,
        columns: &[f64],
        rests: bool,
    ) {
        let n = at.q.len();
        let large = |own: f64, more: f64, size: f64| (own + more).abs() > ROUNDING * (own.abs() + more.abs()).max(size);
        let mut touched = Vec::new();
        for (key, (terms, change)) in self.terms.iter().zip(columns.chunks_exact(2 * n)).enumerate() {
            let sizes = self.sizes.get(key).copied().unwrap_or_default();
            let (dq, dv) = change.split_at(n);
            let moved = large(flow.body.rows.dot(row, dq), terms.offset(wall, at.q), sizes[0]);
            let sped = rests && large(flow.body.rows.dot(row, dv), terms.along(wall, at.before), sizes[1]);
            if (moved || sped) && self.lost.get(key) == Some(&None) {
                touched.push(key);
            }
        }
        self.lose(touched, &NoDerivative::Touching { time: at.time, wall: name_of(names, wall) });
    }

    /// Notes what the impacts of an instant do to the contacts of each key. False where several
    /// impacts at once change the force of another wall, whose change of impulse is not known.
    fn note_impacts(
        &mut self,
        (flow, jump): (&mut Propagator, &Jump),
        (walls, struck): (&[At], &[Struck]),
        (step, stretch): (&Step<'_>, &Stretch<'_>),
        at: &Instant<'_>,
        columns: &[f64],
    ) -> bool {
        let n = at.q.len();
        let sum =
            |row: usize| walls.iter().zip(step.jump).filter(|(wall, _)| wall.row == row).map(|w| w.1).sum::<f64>();
        let before = |wall: usize| stretch.force_at_end(wall);
        for (number, (terms, change)) in self.terms.iter().zip(columns.chunks_exact(2 * n)).enumerate() {
            let (dq, dv) = change.split_at(n);
            let later = |s: &Struck, wall: usize| s.moves_by(flow.body.rows.dot(s.row, dq) + terms.offset(wall, at.q));
            let moves: Vec<f64> =
                struck.iter().map(|s| later(s, at.wall_of.get(s.row).copied().unwrap_or(0))).collect();
            for (wall, of) in walls.iter().enumerate() {
                let own = struck.iter().position(|s| s.row == of.row).filter(|_| at.impulse[wall] != 0.0);
                if let Some((s, &moved)) = own.and_then(|own| struck.get(own).zip(moves.get(own))) {
                    self.contacts.begin(wall);
                    let pull = flow.body.rows.dot(s.row, at.acceleration);
                    let faster = flow.body.rows.dot(s.row, dv) + terms.along(wall, at.before) + pull * moved;
                    self.contacts.set_start(wall, number, [moved, -of.sign * faster]);
                    if !s.rests {
                        let left = s.restitution * faster + terms.restitution(wall) * s.speed;
                        self.contacts.set_end(wall, number, [moved, -of.sign * left]);
                    }
                }
                let jumped = before(wall) - step.force[wall];
                if jumped == 0.0 {
                    continue;
                }
                let moved = match (own, struck) {
                    (Some(own), _) => moves.get(own).copied().unwrap_or(0.0),
                    (None, [_]) => moves.first().copied().unwrap_or(0.0),
                    _ if moves.iter().all(|&moved| moved == 0.0) => 0.0,
                    _ => return false,
                };
                if of.after && !of.during {
                    self.contacts.begin(wall);
                    self.contacts.set_start(wall, number, [moved, f64::NAN]);
                }
                self.contacts.add_impulse(wall, number, jumped * moved);
            }
            if let ([s], &[later]) = (struck, &moves[..]) {
                self.contacts.note_ends_elsewhere((flow, jump), (walls, s), (step, number), (dv, later), (terms, at));
            }
            let impulses = jump.impulses(flow, (dq, dv), terms, at);
            for (wall, of) in walls.iter().enumerate().filter(|(wall, _)| at.impulse[*wall] != 0.0) {
                let share = at.impulse[wall] / sum(of.row);
                self.contacts.add_impulse(wall, number, share * impulses.get(of.row).copied().unwrap_or(0.0));
            }
        }
        true
    }
}
