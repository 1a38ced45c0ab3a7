//! Several degrees of freedom: changes of the state propagated over each step.

use super::arc_changes::ArcChanges;
use super::contact_changes::is_late;
use super::jump::Jump;
use super::keys::Keys;
use super::no_derivative::NoDerivative;
use super::stretch::{ArcEnd, Release, Stretch};
use super::tangent::SceneTangent;
use crate::error::{Error, Result};
use crate::flow::{Arc, HeldRows, Propagator, Series};
use crate::scene::Scene;
use crate::step::{Contact, Path, Step};

/// The data of a wall for the propagation of changes.
#[derive(Debug, Clone, Copy)]
pub(super) struct At {
    pub row: usize,
    pub sign: f64,
    pub position: f64,
    /// e of a rigid wall; `None` for an elastic one.
    pub restitution: Option<f64>,
    pub stiffness: f64,
    pub damping: f64,
    /// For an elastic wall: true if it pushes during the present stretch, and after the last event.
    pub during: bool,
    pub after: bool,
    /// For a rigid one: true from a contact on until the body has been away from it.
    pub stands: bool,
}

/// The name of number `wall` among the `names` of all walls.
pub(super) fn name_of(names: &[String], wall: usize) -> String {
    names.get(wall).cloned().unwrap_or_default()
}

/// Propagates changes of the start over the steps of a structure.
#[derive(Debug)]
pub(crate) struct StructureVariation {
    pub(super) flow: Propagator,
    pub(super) walls: Vec<At>,
    /// The names of the walls.
    pub(super) names: Vec<String>,
    pub(super) jump: Jump,
    /// Rows held during the present stretch, and after the last event.
    pub(super) during: Vec<bool>,
    pub(super) after: Vec<bool>,
    /// The latter as constraints.
    pub(super) hold: HeldRows,
    /// For each row the wall that acts there, if one does.
    pub(super) wall_of: Vec<usize>,
    /// For each wall what its force does at the end of the last stretch in which it acts, if that
    /// was the last one of any length.
    pub(super) releases: Vec<Option<Release>>,
    /// A typical displacement, m.
    pub(super) length: f64,
    /// True where the steps come from the start of a run, which no key moves.
    pub(super) from_start: bool,
    /// True once a step has been seen.
    pub(super) began: bool,
    /// The state and the acceleration just before an event, and work space.
    pub(super) q: Vec<f64>,
    pub(super) v: Vec<f64>,
    pub(super) a: Vec<f64>,
    pub(super) work: Vec<f64>,
    /// The keys by which the first columns are derivatives.
    pub(super) keys: Keys,
    /// The changes over closed-form motion; only beside keys.
    pub(super) arcs: Option<Box<ArcChanges>>,
}

impl StructureVariation {
    pub fn new(scene: &Scene) -> Result<Self> {
        if let Some(hole) = scene.holes().next() {
            let found = format!("round, at the support {:?}", hole.name);
            let expected = "walls and flats: the derivative of a motion round a hole is not known";
            return Err(Error::invalid("support", found, expected));
        }
        let singular = || Error::invalid(("system", "mass matrix"), "singular", "a positive definite matrix");
        let flow = Propagator::new(scene).ok_or_else(singular)?;
        let (n, rows) = (flow.body.n, flow.body.rows.count());
        let walls = scene.walls.iter().zip(&flow.body.row_of).map(|(wall, &row)| {
            let (stiffness, damping) = wall.law.spring().map_or((0.0, 0.0), |s| (s.stiffness, s.damping));
            let (sign, position, restitution) = (wall.side().sign(), wall.position(), wall.law.restitution());
            At { row, sign, position, restitution, stiffness, damping, during: false, after: false, stands: false }
        });
        Ok(Self {
            walls: walls.collect(),
            names: (0..scene.walls.len()).map(|wall| scene.wall_name(wall).unwrap_or_default().to_owned()).collect(),
            jump: Jump::with_room(n, rows),
            during: vec![false; rows],
            after: vec![false; rows],
            hold: HeldRows::with_room(rows),
            wall_of: vec![0; rows],
            releases: vec![None; scene.walls.len()],
            length: scene.gap_scale(),
            from_start: false,
            began: false,
            q: vec![0.0; n],
            v: vec![0.0; n],
            a: vec![0.0; n],
            work: vec![0.0; n],
            keys: Keys::none(&flow.body),
            arcs: None,
            flow,
        })
    }

    /// The same, where the first columns are the derivatives with respect to the keys of
    /// `tangents`.
    pub fn with_keys(scene: &Scene, tangents: &[SceneTangent], times: &[f64]) -> Result<Self> {
        let mut variation = Self::new(scene)?;
        variation.keys = Keys::new(scene, &variation.flow.body, tangents, times);
        variation.arcs = if scene.is_line() { ArcChanges::new(scene, tangents).map(Box::new) } else { None };
        Ok(variation)
    }

    /// n.
    pub fn degrees_of_freedom(&self) -> usize {
        self.flow.body.n
    }

    /// Propagates `columns`, changes of 2n entries (δq, δq̇) one after the other, over `step`. They
    /// must not be used after an error.
    pub fn propagate(&mut self, step: &Step<'_>, columns: &mut [f64]) -> std::result::Result<(), NoDerivative> {
        let n = self.degrees_of_freedom();
        let fits = step.q.len() == n && step.force.len() == self.walls.len();
        self.note_late_ends(step, columns);
        match step.path {
            Path::Series(series) if fits => {
                let stretch = Stretch::Series(series);
                self.begin(&stretch, columns);
                self.pass(series, columns);
                self.end(step, &stretch, columns)
            }
            Path::Exact(arc) if fits && self.arcs.is_some() => {
                self.begin(&Stretch::Arc(arc, ArcEnd::default()), columns);
                let end = self.pass_arc(arc, columns);
                self.end(step, &Stretch::Arc(arc, end), columns)
            }
            _ => Err(NoDerivative::Unresolved { time: step.end }),
        }
    }

    /// Propagates `columns`, (δq, δq̇) of each key one after the other, from the start of `arc` to
    /// its end, both at fixed instants, without what happens there. It does nothing to a structure.
    ///
    /// # Errors
    /// [`NoDerivative::Together`] where the body rests on two walls that a key moves apart.
    pub fn fly(&mut self, arc: &Arc, columns: &mut [f64]) -> std::result::Result<(), NoDerivative> {
        self.read(&Stretch::Arc(arc, ArcEnd::default()));
        self.pass_arc(arc, columns);
        // Each flight stands for itself.
        let lost = self.keys.lost.iter_mut().filter_map(Option::take).last();
        lost.map_or(Ok(()), Err)
    }

    /// Propagates the columns over an arc. Returns the motion at its end.
    fn pass_arc(&mut self, arc: &Arc, columns: &mut [f64]) -> ArcEnd {
        let Self { arcs, keys, .. } = self;
        arcs.as_mut().map(|arcs| arcs.pass(arc, keys, columns)).unwrap_or_default()
    }

    /// What happens at the beginning of a stretch, or has happened just before it.
    fn begin(&mut self, stretch: &Stretch<'_>, columns: &mut [f64]) {
        stretch.start_state(&mut self.q, &mut self.v);
        self.read(stretch);
        self.come_to_rest(stretch.start(), columns);
        for w in 0..self.walls.len() {
            if self.walls[w].during && !self.walls[w].after {
                let fixed = (self.from_start && !self.began).then(|| stretch.start());
                self.enter(w, stretch, fixed, columns);
            }
        }
    }

    /// Propagates the columns over a stretch without events.
    fn pass(&mut self, series: &Series, columns: &mut [f64]) {
        let Self { flow, keys, wall_of, .. } = self;
        if !keys.terms.is_empty() {
            return keys.pass((flow, wall_of), series, columns);
        }
        let n = flow.body.n;
        for change in columns.chunks_exact_mut(2 * n) {
            let (q, v) = change.split_at_mut(n);
            flow.flow(series.end() - series.start(), q, v);
        }
    }

    /// What happens at the end of `step`.
    fn end(
        &mut self,
        step: &Step<'_>,
        stretch: &Stretch<'_>,
        columns: &mut [f64],
    ) -> std::result::Result<(), NoDerivative> {
        stretch.end_state(&mut self.q, &mut self.v, &mut self.a);
        self.after.fill(false);
        for (at, &force) in self.walls.iter_mut().zip(step.force) {
            at.after = force != 0.0 && at.restitution.is_none();
            self.after[at.row] |= force != 0.0 && at.restitution.is_some();
        }
        let first = !std::mem::replace(&mut self.began, true) && self.from_start;
        self.note_standing(step);
        if self.bounce(step, columns) {
            return Ok(());
        }
        let blown = self.take_blow(step, columns);
        // A blow ends the contact that it disturbs, and begins another.
        if blown {
            self.end_with_blow(step, columns);
        }
        let struck = self.is_struck(step, blown);
        if blown || struck {
            self.keys.motion.forget(step.end);
        }
        self.note_releases(stretch);
        if struck {
            self.impact(step, stretch, blown, columns)?;
        } else {
            self.check_grazes(step, stretch)?;
            self.rest_after_impacts(step, columns);
            if !blown {
                let ended = step.closed.iter().filter(|contact| !is_late(contact, step));
                ended.for_each(|contact| self.note_end(contact, columns));
            }
            for w in 0..self.walls.len() {
                if self.walls[w].after && !self.walls[w].during {
                    let fixed = blown || (first && step.end <= step.start);
                    self.enter(w, stretch, fixed.then_some(step.end), columns);
                }
            }
        }
        let own = |contact: &&Contact| !is_late(contact, step) && (!blown || contact.start >= step.end);
        let others = step.closed.iter().filter(own);
        others.for_each(|contact| self.keys.contacts.end(contact));
        Ok(())
    }

    /// True if something is struck in flight, or by a blow, at the end of `step`. Where it is not,
    /// impulses at held rows take away what rounding has left of their speeds.
    fn is_struck(&self, step: &Step<'_>, blown: bool) -> bool {
        let mut pushed = self.walls.iter().zip(step.jump).filter(|(_, p)| **p != 0.0);
        pushed.any(|(at, _)| blown || !self.during[at.row])
    }

    /// Records which rows are held and which elastic walls push during `stretch`.
    fn read(&mut self, stretch: &Stretch<'_>) {
        self.during.fill(false);
        self.walls.iter_mut().for_each(|at| at.during = false);
        for (wall, holds) in stretch.acting_walls() {
            let Some(at) = self.walls.get_mut(wall) else { continue };
            at.during = !holds;
            if holds {
                if self.during[at.row] {
                    let both = [self.wall_of[at.row], wall];
                    let walls = both.map(|wall| name_of(&self.names, wall)).to_vec();
                    let reason = NoDerivative::Together { time: stretch.start(), walls };
                    self.keys.lose(self.keys.differing(both[0], both[1]), &reason);
                }
                self.during[at.row] = true;
                self.wall_of[at.row] = wall;
            }
        }
        let pushing = self.walls.iter().enumerate().filter(|(_, at)| at.during);
        let rows = (0..self.during.len()).filter(|&row| self.during[row]);
        self.flow.set(rows, pushing.map(|(wall, at)| (wall, at.stiffness, at.damping)));
    }
}
