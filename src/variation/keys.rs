//! The keys by which a motion is differentiated, along the run.

use super::contact_changes::ContactChanges;
use super::key_terms::KeyTerms;
use super::means::MeanChanges;
use super::no_derivative::NoDerivative;
use super::tangent::SceneTangent;
use crate::flow::{Changes, Propagator, Series, SeriesBody};
use crate::scene::{Loads, Row, Scene};

/// The terms of the keys, and the derivatives read along the run.
#[derive(Debug)]
pub(super) struct Keys {
    pub terms: Vec<KeyTerms>,
    pub contacts: ContactChanges,
    pub motion: MotionChanges,
    pub means: MeanChanges,
    pub loads: Loads,
    /// The largest |δq| (m) and |δq̇| (m/s) of each key so far.
    pub sizes: Vec<[f64; 2]>,
    /// For each key why there are no derivatives by it any more, while the others go on.
    pub lost: Vec<Option<NoDerivative>>,
    changes: Changes,
    /// Displacement and velocity of the motion, and the columns at a time that is asked for.
    work: [Vec<f64>; 2],
    read: Vec<f64>,
}

/// Displacements and velocities of probes at given times, and their derivatives. NaN where the time
/// has not been reached; derivatives also at an instant at which the velocity jumps.
#[derive(Debug, Clone, Default, PartialEq)]
#[non_exhaustive]
pub struct MotionDerivative {
    /// The times, s.
    pub time: Vec<f64>,
    /// For each time and probe one after the other, m.
    pub displacement: Vec<f64>,
    /// The same, m/s.
    pub velocity: Vec<f64>,
    /// For each time, probe and key one after the other, m per unit of the key.
    pub displacement_by: Vec<f64>,
    /// The same, m/s per unit of the key.
    pub velocity_by: Vec<f64>,
}

/// The motion that is read along a run.
#[derive(Debug)]
pub(super) struct MotionChanges {
    pub found: MotionDerivative,
    /// The number of times passed.
    passed: usize,
    probes: Vec<Row>,
    keys: usize,
    /// For each key whether it has no derivatives any more.
    lost: Vec<bool>,
}

impl Keys {
    /// No keys.
    pub fn none(body: &SeriesBody) -> Self {
        Self {
            terms: Vec::new(),
            contacts: ContactChanges::new(0, 0),
            motion: MotionChanges::new(&[], Vec::new(), 0),
            means: MeanChanges::new(&[], 0),
            loads: Loads::new(&[]),
            sizes: Vec::new(),
            lost: Vec::new(),
            changes: Changes::new(body, 0),
            work: [vec![0.0; body.n], vec![0.0; body.n]],
            read: Vec::new(),
        }
    }

    /// The keys of `tangents`, along a run of `scene`; displacements and velocities at `times` (s,
    /// increasing).
    pub fn new(scene: &Scene, body: &SeriesBody, tangents: &[SceneTangent], times: &[f64]) -> Self {
        let places: Vec<(Row, f64)> = scene.walls.iter().map(|wall| (wall.row().clone(), wall.position())).collect();
        let rows = body.rows.count();
        let probes: Vec<Row> = scene.probes.iter().map(|probe| probe.at.clone()).collect();
        Self {
            terms: tangents.iter().map(|tangent| KeyTerms::new(tangent.clone(), &places, rows)).collect(),
            contacts: ContactChanges::new(tangents.len(), scene.walls.len()),
            means: MeanChanges::new(&probes, tangents.len()),
            motion: MotionChanges::new(times, probes, tangents.len()),
            loads: Loads::new(&scene.loads),
            sizes: vec![[0.0; 2]; tangents.len()],
            lost: vec![None; tangents.len()],
            ..Self::none(body)
        }
    }

    /// The keys for whose terms `which` holds, of those that have derivatives.
    pub fn those(&self, which: impl Fn(&KeyTerms) -> bool) -> Vec<usize> {
        let all = self.terms.iter().zip(&self.lost).enumerate();
        all.filter(|(_, (terms, lost))| lost.is_none() && which(terms)).map(|(key, _)| key).collect()
    }

    /// The keys that change the two walls in different ways.
    pub fn differing(&self, a: usize, b: usize) -> Vec<usize> {
        if a == b { Vec::new() } else { self.those(|terms| terms.differ(a, b)) }
    }

    /// Gives up the derivatives by these keys from here on.
    pub fn lose(&mut self, keys: Vec<usize>, reason: &NoDerivative) {
        for key in keys {
            self.lost.get_mut(key).into_iter().for_each(|lost| *lost = Some(reason.clone()));
            self.contacts.lose(key);
            self.motion.lost.get_mut(key).into_iter().for_each(|lost| *lost = true);
            self.means.lose(key);
        }
    }

    /// Propagates `columns`, those of the keys and then changes of the start alone, over a stretch
    /// without events.
    pub fn pass(&mut self, (flow, wall_of): (&mut Propagator, &[usize]), base: &Series, columns: &mut [f64]) {
        let Self { terms, contacts, motion, means, changes, sizes, work: [q, v], read, .. } = self;
        let Propagator { body, hold, touching, scratch, .. } = flow;
        let n = body.n;
        if changes.count() != columns.len() / (2 * n) {
            *changes = Changes::new(body, columns.len() / (2 * n));
        }
        base.state(base.start(), q, v);
        for (column, change) in columns.chunks_exact_mut(2 * n).enumerate() {
            let (dq, dv) = change.split_at_mut(n);
            for (size, change) in sizes.get_mut(column).into_iter().flatten().zip([&*dq, &*dv]) {
                *size = change.iter().fold(*size, |most, x| most.max(x.abs()));
            }
            if let Some(terms) = terms.get_mut(column) {
                terms.begin(base, wall_of);
            }
            // Rounding errors must not move a row from its wall.
            let (wall, terms) = (|row: usize| wall_of.get(row).copied().unwrap_or(0), terms.get(column));
            hold.change(body, dq, scratch, |held| terms.map_or(0.0, |terms| -terms.offset(wall(held.row), q)));
            hold.change(body, dv, scratch, |held| terms.map_or(0.0, |terms| -terms.along(wall(held.row), v)));
        }
        changes.fill(body, base, (touching, hold), columns, terms, scratch);
        motion.read((base, changes), terms, (q, v), (read, columns.len()));
        let end = base.span();
        for (column, terms) in terms.iter().enumerate() {
            means.add_stretch(column, (base, changes), terms);
            for (wall, share) in base.acting_shares() {
                let [force, impulse] = changes.push(body, (touching, hold), (column, wall), end);
                contacts.add_impulse(wall, column, share * impulse);
                contacts.set_force(wall, column, share * force);
            }
        }
        changes.state_at(end, columns);
    }

    /// Reads the motion of one degree of freedom and its changes by each key at the times up to
    /// `end` (s) that have not been passed; both of displacement and velocity.
    pub fn read(&mut self, end: f64, own: impl Fn(f64) -> [f64; 2], change: impl Fn(usize, f64) -> [f64; 2]) {
        let Self { terms, motion, .. } = self;
        while let Some(&time) = motion.found.time.get(motion.passed).filter(|&&time| time <= end) {
            let [q, v] = own(time);
            for (key, terms) in terms.iter().enumerate() {
                let [dq, dv] = change(key, time);
                motion.note((motion.passed, key), (&[dq], &[dv]), (&[q], &[v]), terms);
            }
            motion.passed += 1;
        }
    }
}

impl MotionChanges {
    fn new(times: &[f64], probes: Vec<Row>, keys: usize) -> Self {
        let values = |each: usize| vec![f64::NAN; times.len() * probes.len() * each];
        let found = MotionDerivative {
            time: times.to_vec(),
            displacement: values(1),
            velocity: values(1),
            displacement_by: values(keys),
            velocity_by: values(keys),
        };
        Self { found, passed: 0, probes, keys, lost: vec![false; keys] }
    }

    /// Reads the changes at the times that lie in the stretch of `base`.
    fn read(
        &mut self,
        (base, changes): (&Series, &mut Changes),
        terms: &[KeyTerms],
        (q, v): (&mut [f64], &mut [f64]),
        (columns, size): (&mut Vec<f64>, usize),
    ) {
        while let Some(&time) = self.found.time.get(self.passed).filter(|&&time| time <= base.end()) {
            columns.resize(size, 0.0);
            changes.state_at((time - base.start()) / base.unit(), columns);
            base.state(time, q, v);
            for (key, (terms, change)) in terms.iter().zip(columns.chunks_exact(2 * q.len())).enumerate() {
                self.note((self.passed, key), change.split_at(q.len()), (q, v), terms);
            }
            self.passed += 1;
        }
    }

    /// Notes the state (`q`, `v`) at time number `number` and its change by key number `column`.
    fn note(
        &mut self,
        (number, column): (usize, usize),
        (dq, dv): (&[f64], &[f64]),
        (q, v): (&[f64], &[f64]),
        terms: &KeyTerms,
    ) {
        let Self { found, probes, keys, lost, .. } = self;
        let known = if lost.get(column).copied().unwrap_or(false) { f64::NAN } else { 0.0 };
        for (probe, row) in probes.iter().enumerate() {
            let own = terms.tangent.probes.get(probe);
            let along = |change: &[f64], x: &[f64]| row.dot(change) + own.map_or(0.0, |own| own.dot(x));
            let index = number * probes.len() + probe;
            let set = |list: &mut Vec<f64>, index: usize, value: f64| {
                list.get_mut(index).into_iter().for_each(|x| *x = value);
            };
            set(&mut found.displacement, index, row.dot(q));
            set(&mut found.velocity, index, row.dot(v));
            set(&mut found.displacement_by, index * *keys + column, known + along(dq, q));
            set(&mut found.velocity_by, index * *keys + column, known + along(dv, v));
        }
    }

    /// Forgets what was read at `time` (s): an instant at which the velocity jumps.
    pub fn forget(&mut self, time: f64) {
        let size = self.probes.len() * self.keys;
        let at = |number: usize| self.found.time.get(number) == Some(&time);
        for number in (0..self.passed).rev().take_while(|&number| at(number)) {
            let values = number * size..(number + 1) * size;
            for list in [&mut self.found.displacement_by, &mut self.found.velocity_by] {
                list.get_mut(values.clone()).into_iter().flatten().for_each(|x| *x = f64::NAN);
            }
        }
    }
}
