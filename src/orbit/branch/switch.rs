//! From a special point to the branch that begins there.

use super::super::boundary::BoundaryLaw;
use super::super::periodic::Orbit;
use super::super::problem::Problem;
use super::super::signature::{Event, Kind, Signature};
use super::arclength::{beside, null, tangent, unit};
use super::curve::{Curve, Vector};
use super::events::point;
use super::follow::follow;
use super::label::Label;
use super::line::{Begin, Followed, Line, Metric, NODE, Passed};
use super::point::Point;
use crate::error::{Error, Result};
use nalgebra::DVector;

/// Step to either side of a new branch's start that shows on which side a body can follow its
/// orbits.
const PROBE: f64 = 1e-4;

/// Where orbits over several periods meet that of one, they are located to such a difference: it is
/// the root of the distance to that point.
const MET: f64 = 1e-4;

impl Problem {
    /// The shorter orbit that `orbit` repeats, or whose mirror image is its second half, and the
    /// label of the point where a branch of such orbits begins.
    pub(super) fn halves(&self, orbit: &Orbit) -> Option<(Orbit, Label)> {
        let (part, mirrored) = orbit.part_within(self.mirror(), MET)?;
        Some((part, if mirrored { Label::SymmetryBreaking } else { Label::PeriodDoubling }))
    }
}

impl<'a> Followed for Curve<'a> {
    fn tangent_at(&self, y: &Vector, along: &Vector) -> Result<Vector> {
        tangent(&self.linear(y)?.matrix, along)
    }

    fn follow(
        &self,
        y: Vector,
        along: &Vector,
        range: [f64; 2],
        most: usize,
        seen: &mut dyn FnMut(&Point),
    ) -> Result<Line<Self>> {
        follow(self, y, along, range, most, seen)
    }

    fn switch(&self, at: &Passed<Self>) -> Result<Begin<Self>> {
        let problem = self.problem(&at.y)?;
        let orbit = &at.point.orbit;
        // A branch of orbits over several periods has met the orbit of one of them: the branch of
        // the latter goes on to both sides.
        if let Some((half, _)) = problem.halves(orbit) {
            return self.begin(&problem, &half, at.point.value, None, true);
        }
        match at.label {
            Label::PeriodDoubling => self.branch_off(&problem, at, &orbit.doubled()),
            Label::SymmetryBreaking => self.branch_off(&problem, at, &orbit.unfolded(problem.mirror())),
            Label::GrazingIn => self.touch(&problem, at),
            Label::GrazingOut => self.lift(&problem, at),
            Label::RestEnds | Label::RestBegins => self.rest(&problem, at),
            Label::Fold | Label::BranchPoint | Label::NeimarkSacker => {
                Err(Error::no_orbit("the branch itself goes on beyond"))
            }
            Label::ContactEnds | Label::Corner => {
                let begun = self.divide(&problem, at).or_else(|| self.join(&problem, at));
                let begun = begun.or_else(|| self.exchange(&problem, at));
                begun.or_else(|| self.come_out(&problem, at)).unwrap_or_else(|| {
                    let what = at.label;
                    Err(Error::no_orbit(format!("what follows a {what} is not known: start from a run beyond it")))
                })
            }
        }
    }

    fn orbit_at(&self, y: &Vector) -> Result<(Orbit, Metric)> {
        let problem = self.problem(y)?;
        let metric =
            Metric { mirror: problem.mirror().map(<[usize]>::to_vec), speed: problem.scales().speed, near: NODE };
        Ok((self.orbit(&problem, y), metric))
    }
}

impl<'a> Curve<'a> {
    /// The curve of another signature of the same family.
    pub(super) fn of(&self, signature: &Signature) -> Curve<'a> {
        Curve { family: self.family, signature: signature.clone(), scales: self.scales, width: self.width }
    }

    /// The orbit near `orbit` at the key's value `value`.
    pub(super) fn corrected(&self, problem: &Problem, orbit: &Orbit, value: f64) -> Result<Orbit> {
        let curve = self.of(&orbit.signature);
        let guess = curve.gather(problem, orbit, value);
        let (y, linear, _) = curve.correct(&guess, &unit(guess.len(), guess.len() - 1))?;
        Ok(curve.orbit(&linear.problem, &y))
    }

    /// The branch that leaves along the eigenvector of a multiplier −1, at a small amplitude.
    fn branch_off(&self, problem: &Problem, at: &Passed<Self>, whole: &Orbit) -> Result<Begin<Self>> {
        let curve = self.of(&whole.signature);
        curve.signature.check(problem.scene())?;
        let origin = curve.gather(problem, whole, at.point.value);
        let null = null(self.twisted(problem, &at.y))?;
        let n = null.len();
        let share = std::f64::consts::FRAC_1_SQRT_2;
        let aside = DVector::from_fn(2 * n + 1, |i, _| match i {
            i if i < n => share * null[i],
            i if i < 2 * n => -share * null[i - n],
            _ => 0.0,
        });
        let (y, along) = beside(&origin, &aside, |guess| Ok(curve.correct(guess, &aside)?.0))?;
        Ok(Begin { curve, y, along, both: false })
    }

    /// Adds an impact of speed 0 where the orbit touches a wall.
    fn touch(&self, problem: &Problem, at: &Passed<Self>) -> Result<Begin<Self>> {
        let mut orbit = at.point.orbit.clone();
        let nearest = at.point.admissible.nearest.ok_or_else(|| Error::no_orbit("no wall is touched"))?;
        let index = if orbit.phases.is_empty() { 0 } else { nearest.flight + 1 };
        let boundary = problem.boundary(nearest.wall).ok_or_else(|| Error::no_orbit("no wall is touched"))?;
        if let BoundaryLaw::Rigid(_) = boundary.law {
            orbit.insert(index, Event { kind: Kind::Impact, wall: nearest.wall }, nearest.phase, 0.0);
            let curve = self.of(&orbit.signature);
            let y = curve.gather(problem, &orbit, at.point.value);
            let along = unit(y.len(), 2 * index + 1);
            return Ok(Begin { curve, y, along, both: false });
        }
        self.insert_short(problem, at, nearest, [Kind::Enter, Kind::Leave])
    }

    /// Leaves out the impact whose speed has become 0; of an elastic wall the contact, or the
    /// flight between two, that has become so short.
    fn lift(&self, problem: &Problem, at: &Passed<Self>) -> Result<Begin<Self>> {
        let mut orbit = at.point.orbit.clone();
        let kind = orbit.signature.events.get(at.event).map(|event| event.kind);
        let merged = orbit.merged(at.event).filter(|_| kind == Some(Kind::Enter));
        let merged = merged.map(|merged| self.begin(problem, &merged, at.point.value, Some(at), false));
        if let Some(Ok(begin)) = merged {
            return Ok(begin);
        }
        let gone = if kind == Some(Kind::Enter) { 2 } else { 1 };
        if kind == Some(Kind::Rest) {
            return Err(Error::no_orbit(
                "what follows an arrival without speed at a rest is not known: start from a run beyond it",
            ));
        }
        for _ in 0..gone {
            orbit.remove(if at.event < orbit.phases.len() { at.event } else { 0 });
        }
        if orbit.phases.is_empty() {
            orbit.signature = Signature { events: Vec::new(), periods: 1, symmetric: problem.is_symmetric() };
        }
        let orbit = problem.halves(&orbit).map_or(orbit, |(once, _)| once);
        let lifted = self.begin(problem, &orbit, at.point.value, Some(at), false);
        if kind == Some(Kind::Enter) && lifted.is_err() {
            return self.stay_behind(problem, at).or(lifted);
        }
        lifted
    }

    /// An impact with e = 0 gets a rest of duration 0, or a rest of duration 0 becomes such an
    /// impact.
    fn rest(&self, problem: &Problem, at: &Passed<Self>) -> Result<Begin<Self>> {
        let mut orbit = at.point.orbit.clone();
        let Some(event) = orbit.signature.events.get_mut(at.event) else {
            return Err(Error::no_orbit("no such event"));
        };
        let wall = event.wall;
        if !matches!(problem.boundary(wall).map(|boundary| boundary.law), Some(BoundaryLaw::Rigid(0.0))) {
            return Err(Error::no_orbit("impacts accumulate there: start from a run beyond it"));
        }
        if at.label == Label::RestBegins {
            event.kind = Kind::Rest;
            let phase = orbit.phases[at.event];
            orbit.insert(at.event + 1, Event { kind: Kind::Release, wall }, phase, 0.0);
        } else {
            event.kind = Kind::Impact;
            // Its release is the next event; that of the last one comes first.
            orbit.remove(if at.event + 1 < orbit.phases.len() { at.event + 1 } else { 0 });
        }
        self.begin(problem, &orbit, at.point.value, Some(at), false)
    }

    /// The branch through `orbit`, to the side on which a body can follow its orbits; an error
    /// where there is no such side.
    pub(super) fn begin(
        &self,
        problem: &Problem,
        orbit: &Orbit,
        value: f64,
        sided: Option<&Passed<Self>>,
        both: bool,
    ) -> Result<Begin<Self>> {
        let curve = self.of(&orbit.signature);
        let guess = curve.gather(problem, orbit, value);
        let last = unit(guess.len(), guess.len() - 1);
        let (y, linear, _) = curve.correct(&guess, &last)?;
        let tangent = tangent(&linear.matrix, &last)?;
        if sided.is_none() {
            return Ok(Begin { curve, y, along: tangent, both });
        }
        for sign in [1.0, -1.0] {
            let along = &tangent * sign;
            let beside = curve.correct(&(&y + &along * PROBE), &along);
            let fits = beside.and_then(|(y, linear, _)| point(&curve, &linear.problem, &y)).is_ok_and(|point| {
                let phases = &point.orbit.phases;
                point.admissible.holds() && phases.windows(2).all(|pair| pair[0] < pair[1])
            });
            if fits {
                return Ok(Begin { curve, y, along, both });
            }
        }
        Err(Error::no_orbit("no body can follow the orbits beyond on either side"))
    }
}
