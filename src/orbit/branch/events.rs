//! Test functions, which change sign at the special points of a branch.

use super::super::boundary::BoundaryLaw;
use super::super::problem::Problem;
use super::super::signature::Kind;
use super::super::strobe::Scales;
use super::curve::{Curve, Vector};
use super::label::Label;
use super::point::Point;
use crate::error::Result;
use crate::flow::Support;
use crate::scene::Side;

/// The value of a test function that the law of a wall does not have, such as the beginning of a
/// rest after impacts with restitution. It has no sign, which therefore does not change where a
/// branch in restitution or damping comes to 0.
const NONE: f64 = f64::NAN;

/// A test function: its label, the event that it belongs to, and its value.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Test {
    pub label: Label,
    pub event: usize,
    pub value: f64,
}

/// All test functions at `y`, in an order that depends on the signature only.
pub(super) fn tests(curve: &Curve<'_>, problem: &Problem, point: &Point, y: &Vector, tangent: &Vector) -> Vec<Test> {
    let orbit = &point.orbit;
    let signature = &orbit.signature;
    let count = signature.events.len();
    let mut found = vec![Test { label: Label::Fold, event: 0, value: tangent[tangent.len() - 1] }];
    if count > 0 && !signature.rests() {
        let label = if signature.symmetric { Label::SymmetryBreaking } else { Label::PeriodDoubling };
        found.push(Test { label, event: 0, value: curve.twisted(problem, y).determinant() });
    }
    let Scales { length, speed } = problem.scales();
    let force = problem.body().mass * speed * speed / length;
    let gap = point.admissible.nearest.map_or(1.0, |nearest| nearest.gap / length);
    found.push(Test { label: Label::GrazingIn, event: 0, value: gap });
    let touching = problem.touching(signature);
    for (index, event) in signature.events.iter().enumerate() {
        let Some(boundary) = problem.boundary(event.wall) else { continue };
        let speed = orbit.speeds[index] / curve.scales.speed;
        let start = orbit.phases[index] * problem.forcing_period();
        let lasts = orbit.next_phase(index) - orbit.phases[index];
        let mut add = |label, value| found.push(Test { label, event: index, value });
        match (event.kind, boundary.law) {
            (Kind::Impact | Kind::Rest | Kind::Enter, _) => add(Label::GrazingOut, speed),
            (Kind::Leave | Kind::Again, _) => add(Label::ContactEnds, speed),
            _ => {}
        }
        let state = boundary.after(event.kind, orbit.speeds[index]).state;
        let mut arc = problem.arc();
        if matches!(event.kind, Kind::Enter | Kind::Leave | Kind::Again) {
            problem.fly(&mut arc, state, [start, lasts * problem.forcing_period()], &touching[index], None);
            let nearest = problem.nearest_change(&arc, index, orbit.phases[index]);
            add(Label::ContactEnds, nearest.map_or(1.0, |nearest| nearest.gap / length));
        }
        match (event.kind, boundary.law) {
            (Kind::Rest, _) => {
                problem.fly(&mut arc, state, [start, 0.0], &[], Some(event.wall));
                let side = if boundary.toward > 0.0 { Side::Upper } else { Side::Lower };
                let [reaction, ..] = arc.pressing(Support { wall: event.wall, side }, 0.0);
                add(Label::RestEnds, reaction / force);
            }
            (Kind::Impact, BoundaryLaw::Rigid(0.0)) => {
                problem.fly(&mut arc, state, [start, 0.0], &[], None);
                add(Label::RestBegins, -boundary.toward * arc.start_jet()[2]);
            }
            (Kind::Impact, BoundaryLaw::Rigid(_)) => add(Label::RestBegins, NONE),
            _ => {}
        }
        if !matches!(event.kind, Kind::Rest) {
            add(Label::Corner, lasts);
        }
    }
    found
}

/// The orbit at `y` with its multipliers and its admissibility.
///
/// # Errors
/// Errors of [`Problem::floquet`] and [`Problem::admissible`].
pub(super) fn point(curve: &Curve<'_>, problem: &Problem, y: &Vector) -> Result<Point> {
    let orbit = curve.orbit(problem, y);
    let (floquet, admissible) = (problem.floquet(&orbit)?, problem.admissible(&orbit)?);
    Ok(Point { value: curve.value(y), orbit, floquet, admissible, strobe: None })
}
