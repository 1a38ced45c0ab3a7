//! A recorded motion prepared for drawing: it includes the contact instants, and is curved between
//! the rows.
//!
//! Rows are evenly spaced and skip the instants of impacts: a curve through the rows alone stops
//! short of the wall. The contact episodes hold when, and how fast, a body arrived at a wall and
//! left it. Each piece between two neighbouring points, rows or contact instants, is the cubic
//! (Hermite) through both displacements with both velocities.

use super::window::Span;
use crate::order::sort_by_number;
use crate::run::Run;
use crate::scene::Scene;
use crate::scheme::Scheme;
use crate::step::Contact;

/// Points wanted in a stretch: where there are fewer, its pieces are divided, each into at most
/// [`MOST_PARTS`].
const ENOUGH: usize = 4000;
const MOST_PARTS: usize = 16;
/// Relative tolerance for dividing a piece: the mean of the velocities at its ends must agree with
/// the slope of its chord. Where it does not, the rows do not resolve the motion, and a cubic would
/// invent one.
const RESOLVED: f64 = 0.15;

/// An instant of a motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Instant {
    /// Time, s.
    pub t: f64,
    /// Displacement, m.
    pub q: f64,
    /// Velocity, m/s.
    pub v: f64,
    /// False for a contact instant, which a scheme on a grid knows only to within its step.
    row: bool,
}

/// The motion of probe number `probe` within `whole`, with its pieces divided within `fine`. With
/// `corners`, impacts on rigid walls are inserted even where every step is a row.
pub(super) fn motion(scene: &Scene, run: &Run, probe: usize, whole: Span, fine: Span, corners: bool) -> Vec<Instant> {
    let knots = knots(scene, run, probe, whole, corners);
    let count = knots.iter().filter(|k| fine.holds(k.t)).count().max(1);
    let parts = ENOUGH.div_ceil(count).min(MOST_PARTS);
    let mut out = Vec::with_capacity(knots.len() + parts * count);
    for (i, knot) in knots.iter().enumerate() {
        if let Some(before) = i.checked_sub(1).and_then(|i| knots.get(i)) {
            let sure = run.scheme.is_exact() || (knot.row && before.row);
            if parts > 1 && sure && fine.holds(knot.t) && fine.holds(before.t) {
                divide(before, knot, parts, &mut out);
            }
        }
        out.push(*knot);
    }
    out
}

/// Rows and contact instants, in order of time.
fn knots(scene: &Scene, run: &Run, probe: usize, span: Span, corners: bool) -> Vec<Instant> {
    let t = &run.trajectory;
    let displacement = t.displacements().get(probe).into_iter().flatten();
    let velocity = t.velocities().get(probe).into_iter().flatten();
    let rows = t.time().iter().zip(displacement).zip(velocity).map(|((&t, &q), &v)| Instant { t, q, v, row: true });
    let spacing = t.time().get(1).copied().unwrap_or(0.0);
    let sparse = run.scheme.is_exact() || spacing > 1.5 * run.grid.step;
    // The rows show contacts that last. On a grid only the contacts that fit between rows are
    // inserted.
    let short = |c: &Contact| c.end.is_some_and(|end| end - c.start < 3.0 * spacing);
    let wanted = |c: &Contact| run.scheme.is_exact() || (corners && c.peak_force.is_none()) || (sparse && short(c));
    let mut instants = contact_instants(scene, run, probe, wanted);
    sort_by_number(&mut instants, |a| a.t);
    let mut instants = instants.into_iter().peekable();
    let mut out = Vec::new();
    // The row at the time of an impact holds the state after it, so the corners of the impact are
    // inserted before the row.
    for row in rows {
        while let Some(instant) = instants.next_if(|c| c.t <= row.t) {
            out.push(instant);
        }
        out.push(row);
    }
    out.retain(|k| span.holds(k.t));
    out
}

/// Arrival and departure instants of the wanted contacts, at the walls on the probe's row.
fn contact_instants(scene: &Scene, run: &Run, probe: usize, wanted: impl Fn(&Contact) -> bool) -> Vec<Instant> {
    let place = scene.probes.get(probe).map(|p| &p.at);
    let springs = matches!(run.scheme, Scheme::Penalty { .. });
    let mut out = Vec::new();
    for c in run.trajectory.contacts().iter().filter(|c| wanted(c)) {
        let Some(wall) = scene.walls.get(c.wall).filter(|w| Some(w.row()) == place) else { continue };
        let (sign, rigid) = (wall.side().sign(), wall.law.is_rigid() && !springs);
        let at = |t: f64, v: f64| Instant { t, q: wall.position(), v, row: false };
        // A contact that exists at the start of the run has no arrival.
        if c.start > 0.0 || c.approach_speed > 0.0 {
            out.push(at(c.start, -sign * c.approach_speed));
        }
        match (c.end, c.departure_speed) {
            (Some(end), Some(departure)) if rigid && end <= c.start => out.push(at(end, sign * departure)),
            // The body stays at the wall. For a scheme that lets it rest behind the wall, the rows
            // show where.
            (end, departure) if rigid => {
                out.push(at(c.start, 0.0));
                let end = end.filter(|_| run.scheme.is_exact());
                out.extend(end.map(|end| at(end, sign * departure.unwrap_or(0.0))));
            }
            // A spring without damping releases the body where it met it; with a damper it does so
            // earlier, at a position that is not recorded.
            (Some(end), Some(departure)) if springs => out.push(at(end, sign * departure)),
            _ => {}
        }
    }
    out
}

/// Inserts `parts − 1` instants between two, on the cubic through both.
fn divide(a: &Instant, b: &Instant, parts: usize, out: &mut Vec<Instant>) {
    let h = b.t - a.t;
    let chord = (b.q - a.q) / h;
    let resolved = (chord - 0.5 * (a.v + b.v)).abs() <= RESOLVED * (a.v.abs() + b.v.abs());
    if h <= 0.0 || !resolved {
        return;
    }
    for k in 1..parts {
        let s = k as f64 / parts as f64;
        let (r, d) = (1.0 - s, b.q - a.q);
        // Hermite's cubic, and its derivative.
        let q = a.q + s * s * (3.0 - 2.0 * s) * d + h * s * r * (r * a.v - s * b.v);
        let v = 6.0 * s * r * chord + r * (1.0 - 3.0 * s) * a.v + s * (3.0 * s - 2.0) * b.v;
        out.push(Instant { t: a.t + s * h, q, v, row: true });
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::run::{Options, run};
    use crate::scene::{Load, Wall};
    use crate::time::TimeOptions;

    /// A ball of 1 kg falls from 1 m onto a floor at 0, e = 0.5, recorded in rows of 0.1 s: its
    /// path is known in closed form.
    #[test]
    fn the_drawn_path_of_a_ball_is_its_parabolas_and_meets_the_floor() {
        let scene = Scene::oscillator(1.0, 0.0, 0.0)
            .with_wall(Wall::lower("floor", 0.0).with_restitution(0.5))
            .with_load(Load::constant(-9.81))
            .with_initial(&[1.0], &[0.0])
            .with_duration(0.8);
        let mut options = Options::with_step(1e-3);
        options.time = TimeOptions { sample: Some(0.1), ..options.time };
        let run = run(&scene, &Scheme::Event, &options).unwrap();
        let whole = Span { from: 0.0, to: 0.8 };
        let drawn = motion(&scene, &run, 0, whole, whole, false);
        let lowest = run.trajectory.displacement().iter().fold(f64::INFINITY, |a, q| a.min(*q));
        assert!(lowest > 0.05, "the rows alone stop {lowest} m above the floor");
        let (g, fall) = (9.81, (2.0_f64 / 9.81).sqrt());
        assert!(drawn.iter().any(|k| k.q == 0.0 && (k.t - fall).abs() < 1e-12));
        for k in &drawn {
            let (t, bounced) = (k.t, k.t - fall);
            let before = 1.0 - 0.5 * g * t * t;
            let after = 0.5 * g * fall * bounced - 0.5 * g * bounced * bounced;
            let expected = if bounced <= 0.0 { before } else { after };
            // A cubic fitted to a parabola is that parabola: only rounding remains.
            assert!((k.q - expected).abs() < 1e-12, "{k:?} is not {expected}");
        }
        assert!(drawn.len() > 100);
    }

    /// On a grid a soft spring is met somewhere within a step: the orbit drawn must show no
    /// spurious corner there.
    #[test]
    fn a_soft_wall_leaves_the_velocity_of_a_stepping_scheme_smooth() {
        let scene = Scene::oscillator(1.0, 0.0, 100.0)
            .with_wall(Wall::upper("soft", 5e-3).with_elasticity(100.0, 0.0))
            .with_initial(&[0.0], &[0.3])
            .with_duration(2.0);
        let mut options = Options::with_step(1e-3);
        options.time = TimeOptions { sample: Some(1e-2), ..options.time };
        let run = run(&scene, &Scheme::MoreauJean { theta: 0.5 }, &options).unwrap();
        let whole = Span { from: 0.0, to: 2.0 };
        let drawn = motion(&scene, &run, 0, whole, whole, true);
        // Between two points the speed changes by at most the acceleration times the time between
        // them: the acceleration is at most ω² u = 100 · 0.03 m/s² outside and, with the spring,
        // twice as much inside; the points are 0.6 ms apart.
        for pair in drawn.windows(2) {
            let [a, b] = pair else { continue };
            assert!((b.v - a.v).abs() < 6.0 * (b.t - a.t) + 1e-3, "{a:?} to {b:?}");
        }
    }

    #[test]
    fn where_rows_do_not_resolve_the_motion_no_curve_is_invented() {
        let mut out = Vec::new();
        let at = |t: f64, q: f64| Instant { t, q, v: 10.0, row: true };
        let a = at(0.0, 0.0);
        divide(&a, &at(1.0, 0.1), 8, &mut out);
        assert!(out.is_empty());
        divide(&a, &at(1.0, 10.0), 8, &mut out);
        assert_eq!(out.len(), 7);
    }
}
