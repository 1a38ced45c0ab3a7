//! The beginning of a push of an elastic wall, and what it does to the derivatives.

use super::key_terms::Instant;
use super::oscillator::ON_THE_FACE;
use super::stretch::Stretch;
use super::structure::{At, StructureVariation};

impl StructureVariation {
    /// Elastic wall `w` begins to push in the `stretch` or after it; with the time (s) of a
    /// `fixed` instant, which no key moves. If the state is on its face and moves into it, the
    /// force of its dashpot jumps; a push that begins elsewhere begins with a force of 0.
    pub(super) fn enter(&mut self, w: usize, stretch: &Stretch<'_>, fixed: Option<f64>, columns: &mut [f64]) {
        self.keys.contacts.begin(w);
        if let Some(time) = fixed {
            self.lose_pressed(w, time, columns);
        }
        if !self.began {
            return self.note_pushed_at_start(w, columns);
        }
        let (at, n) = (self.walls[w], self.q.len());
        let [place, rate] = [&self.q, &self.v].map(|x| self.flow.body.rows.dot(at.row, x));
        let on_face = -at.sign * rate > 0.0 && (place - at.position).abs() <= ON_THE_FACE * self.length;
        self.note_push((w, at), [place, rate], on_face, stretch, columns);
        if at.damping == 0.0 || !on_face {
            return;
        }
        let Self { flow, q, work, keys, .. } = self;
        work.fill(0.0);
        flow.body.add_column(at.row, -at.damping, work);
        flow.hold.stop(&flow.body, work, &mut flow.scratch);
        for (number, change) in columns.chunks_exact_mut(2 * n).enumerate() {
            let (dq, dv) = change.split_at_mut(n);
            let own = keys.terms.get(number).map_or(0.0, |terms| terms.offset(w, q));
            let by = flow.body.rows.dot(at.row, dq) + own;
            dv.iter_mut().zip(&*work).for_each(|(v, w)| *v += by * w);
        }
    }

    /// Gives up the keys that would move the body away from the face of elastic wall `w`, whose
    /// push begins at `time` (s) whatever the keys are: while the body is away from it, its dashpot
    /// does not act, and within it does.
    fn lose_pressed(&mut self, w: usize, time: f64, columns: &[f64]) {
        let Self { flow, walls, names, length, q, v, a, wall_of, keys, .. } = self;
        let at = walls[w];
        if at.damping > 0.0 && (flow.body.rows.dot(at.row, q) - at.position).abs() <= ON_THE_FACE * *length {
            let now = Instant { time, q, before: v, after: v, acceleration: a, impulse: &[], wall_of };
            keys.lose_touched((flow, names), (at.row, w), &now, columns, false);
        }
    }

    /// Notes how the approach speed of a contact with wall `w` changes that begins with the motion.
    fn note_pushed_at_start(&mut self, w: usize, columns: &[f64]) {
        let Self { flow, walls, v, keys, .. } = self;
        let (at, n) = (walls[w], v.len());
        let into = at.sign * flow.body.rows.dot(at.row, v) < 0.0;
        for (number, (terms, change)) in keys.terms.iter().zip(columns.chunks_exact(2 * n)).enumerate() {
            let faster = flow.body.rows.dot(at.row, &change[n..]) + terms.along(w, v);
            keys.contacts.set_start(w, number, [0.0, if into { -at.sign * faster } else { 0.0 }]);
        }
    }

    /// Notes what the beginning of a push of wall `w`, at the displacement `place` (m) and speed
    /// `rate` (m/s) of its row, does to the contacts of each key: the contact begins later, and
    /// where the force jumps the reactions of held rows jump too.
    fn note_push(
        &mut self,
        (w, at): (usize, At),
        [place, rate]: [f64; 2],
        on_face: bool,
        stretch: &Stretch<'_>,
        columns: &[f64],
    ) {
        let Self { flow, walls, q, v, a, work, keys, .. } = self;
        let (n, pull) = (q.len(), flow.body.rows.dot(at.row, a));
        let mut reactions = vec![0.0; flow.body.rows.count()];
        if on_face && !keys.terms.is_empty() {
            work.fill(0.0);
            flow.body.rows.add_transposed(at.row, -at.damping * rate, work);
            let held = flow.hold.rows();
            flow.hold.balance(&flow.body, work, &mut flow.scratch, |_| 0.0, |i, p| reactions[held[i].row] += p);
        }
        for (number, (terms, change)) in keys.terms.iter().zip(columns.chunks_exact(2 * n)).enumerate() {
            let (dq, dv) = change.split_at(n);
            let beyond = flow.body.rows.dot(at.row, dq) + terms.offset(w, q);
            let faster = flow.body.rows.dot(at.row, dv) + terms.along(w, v);
            // The instant is where the body reaches the face, or where the force leaves 0.
            let later = if on_face {
                -beyond / rate
            } else {
                let of_wall = terms.tangent.walls.get(w);
                let own = of_wall.map_or(0.0, |wall| wall.stiffness * (place - at.position) + wall.damping * rate);
                -(at.stiffness * beyond + at.damping * faster + own) / (at.stiffness * rate + at.damping * pull)
            };
            // A force that leaves 0 within the wall begins a contact of a body that moves out of
            // it: it approaches with speed 0, by every key.
            let approach = if at.sign * rate < 0.0 { -at.sign * (faster + pull * later) } else { 0.0 };
            keys.contacts.set_start(w, number, [later, approach]);
            if !on_face {
                continue;
            }
            keys.contacts.add_impulse(w, number, at.damping * rate * later);
            for (wall, _) in stretch.acting_walls().filter(|acting| acting.1) {
                let share = stretch.share(wall).unwrap_or(0.0);
                let reaction = walls.get(wall).and_then(|at| reactions.get(at.row)).copied().unwrap_or(0.0);
                keys.contacts.add_impulse(wall, number, -share * reaction * later);
            }
        }
    }
}
