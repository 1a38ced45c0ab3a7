//! The rule written out for one degree of freedom, beside the steps that are made.

use super::super::line::Line;
use super::super::matrices::Matrices;
use super::*;
use crate::hash::{mix, unit};
use crate::scene::{Load, Row, Side, Wall};

/// From −1 to 1, the same in every run.
fn draw(stream: u64, index: u64) -> f64 {
    2.0 * unit(mix(13, stream, index)) - 1.0
}

/// α_m, α_f, β, γ of Chung & Hulbert for a spectral radius.
fn weights(rho: f64) -> [f64; 4] {
    let (alpha_m, alpha_f) = ((2.0 * rho - 1.0) / (rho + 1.0), rho / (rho + 1.0));
    let gamma = 0.5 + alpha_f - alpha_m;
    [alpha_m, alpha_f, 0.25 * (gamma + 0.5) * (gamma + 0.5), gamma]
}

/// m, c, k and the constant load of a body, its walls, a blow (its impulse and its instant), and
/// the extra force of every step.
#[derive(Debug, Clone)]
struct Plan {
    body: [f64; 4],
    walls: Vec<Wall>,
    blow: Option<[f64; 2]>,
    extra: f64,
    state: [f64; 2],
    rho: f64,
    h: f64,
}

/// What a step leaves: q, v, and the impulse and the force of each wall.
#[derive(Debug)]
struct End {
    state: [f64; 2],
    impulse: Vec<f64>,
    force: Vec<f64>,
}

/// The rule by the formulas of the head of the file.
struct Written {
    plan: Plan,
    a: f64,
    /// F, and the forces of the elastic walls.
    force: f64,
    elastic: Vec<f64>,
    closed: bool,
}

/// Distance at which a rigid wall counts as touched, m: in these scenes more than rounding, and
/// less than any other distance.
const TOUCH: f64 = 1e-12;

fn sign(wall: &Wall) -> f64 {
    wall.side().sign()
}

fn depth(wall: &Wall, q: f64) -> f64 {
    sign(wall) * (wall.position() - q)
}

/// Stiffness and damping of an elastic wall.
fn spring(wall: &Wall) -> Option<[f64; 2]> {
    if let WallLaw::Elastic { stiffness, damping } = wall.law { Some([stiffness, damping]) } else { None }
}

impl Written {
    fn new(plan: &Plan) -> Self {
        let ([m, c, k, f], [q, v]) = (plan.body, plan.state);
        let push = |wall: &Wall| match spring(wall) {
            Some([ka, ca]) if depth(wall, q) > 0.0 => sign(wall) * (ka * depth(wall, q) - ca * sign(wall) * v).max(0.0),
            _ => 0.0,
        };
        let elastic: Vec<f64> = plan.walls.iter().map(push).collect();
        let force = f - c * v - k * q + elastic.iter().sum::<f64>();
        let closed = plan.walls.iter().any(|wall| wall.law.is_rigid() && depth(wall, q) >= -TOUCH);
        Self { plan: plan.clone(), a: force / m, force, elastic, closed }
    }

    /// Δ and r of each wall: the equilibrium of a spring S under b with the springs of the elastic
    /// walls, which only push, stopped at the rigid ones, which then push with the rest.
    fn place(&self, s: f64, b: f64, ahead: f64) -> (f64, Vec<f64>, bool) {
        let Plan { walls, state: [q, _], h, .. } = &self.plan;
        let yields = |wall: &Wall, [ka, ca]: [f64; 2], delta: f64| {
            ka * depth(wall, ahead + delta) + ca / h * (depth(wall, ahead + delta) - depth(wall, *q).max(0.0))
        };
        let elastic: Vec<usize> = (0..walls.len()).filter(|&w| spring(&walls[w]).is_some()).collect();
        let found = (0..1_u32 << elastic.len()).find_map(|pushing| {
            let (mut stiff, mut load) = (s, b);
            for (_, &w) in elastic.iter().enumerate().filter(|(bit, _)| (pushing >> bit) & 1 == 1) {
                let law = spring(&walls[w]).unwrap();
                stiff += law[0] + law[1] / h;
                load += sign(&walls[w]) * yields(&walls[w], law, 0.0);
            }
            let delta = load / stiff;
            let fits = |(bit, &w): (usize, &usize)| {
                (yields(&walls[w], spring(&walls[w]).unwrap(), delta) > 0.0) == ((pushing >> bit) & 1 == 1)
            };
            elastic.iter().enumerate().all(fits).then_some(delta)
        });
        let free = found.expect("a monotone problem");
        let (mut delta, mut stop) = (free, None);
        for (w, wall) in walls.iter().enumerate().filter(|(_, wall)| wall.law.is_rigid()) {
            if depth(wall, ahead + delta) > 0.0 {
                (delta, stop) = (wall.position() - ahead, Some(w));
            }
        }
        let push = |wall: &Wall| spring(wall).map_or(0.0, |law| sign(wall) * yields(wall, law, delta).max(0.0));
        let mut force: Vec<f64> = walls.iter().map(push).collect();
        if let Some(w) = stop {
            force[w] = s * delta - b - force.iter().sum::<f64>();
        }
        (delta, force, stop.is_some())
    }

    fn step(&mut self, number: u64) -> End {
        let Plan { body: [m, c, k, f], walls, blow, extra, state: [q, v], rho, h } = self.plan.clone();
        let [alpha_m, alpha_f, beta, gamma] = weights(rho);
        let (start, end, mu) = (number as f64 * h, (number + 1) as f64 * h, (1.0 - alpha_m) / (1.0 - alpha_f));
        let [given, at] = blow.filter(|[_, at]| *at > start && *at <= end).unwrap_or([0.0, end]);
        // The damper acts on a blow as if it came in the middle of the step.
        let lost = c * (end - 0.5 * h - at) * given / m;
        let ahead = q + h * v + h * h * (0.5 - beta) * self.a + (end - at) * given / m + 0.5 * h * h * extra / m;
        let mut free = v + h * (1.0 - gamma) * self.a + (given - lost + h * extra) / m;
        let past = (alpha_f * self.force - alpha_m * m * self.a) / (1.0 - alpha_f);
        let s = (mu * m + h * gamma * c + h * h * beta * k) / (h * h * beta);
        let unfelt = h * (1.0 - gamma / (2.0 * beta));
        let place =
            |unfelt: f64| self.place(s, past + f - c * (free - unfelt * (self.a + extra / m)) - k * ahead, ahead);
        let (felt, not_felt) = (place(0.0), place(unfelt));
        // A wall that holds the body is met if it is met either way; another if it is met both
        // ways, or by the damper that feels the acceleration alone.
        let (delta, push, met) =
            if c == 0.0 || rho == 1.0 || !(self.closed || felt.2) || !not_felt.2 { felt } else { not_felt };
        let q1 = ahead + delta;
        let mut a1 = delta / (h * h * beta);
        let elastic: Vec<f64> = walls.iter().zip(&push).map(|(w, r)| if w.law.is_rigid() { 0.0 } else { *r }).collect();
        let closed: Vec<usize> = (0..walls.len())
            .filter(|&w| walls[w].law.is_rigid() && (push[w] != 0.0 || depth(&walls[w], q1) >= -TOUCH))
            .collect();
        let answered = c != 0.0 && closed.iter().any(|&w| sign(&walls[w]) * given < 0.0);
        if answered {
            free += lost / m;
        }
        let pushed_by: f64 = elastic.iter().sum();
        if met || answered {
            a1 = (past + f - k * q1 + pushed_by - c * free) / (mu * m + h * gamma * c);
        }
        let rule = free + h * gamma * a1;
        let mut impulse: Vec<f64> = self.elastic.iter().zip(&elastic).map(|(r, r1)| 0.5 * h * (r + r1)).collect();
        let (mut v1, mut force) = (rule, elastic.clone());
        for &w in &closed {
            let struck = v + given / m;
            let Some(e) = walls[w].law.restitution() else { continue };
            let least = -struck * if sign(&walls[w]) * struck <= 0.0 { e } else { 1.0 };
            if sign(&walls[w]) * (v1 - least) < 0.0 {
                v1 = least;
                impulse[w] = (mu * m + h * gamma * c) * (v1 - rule) / mu;
                force[w] = impulse[w] / h;
            }
        }
        self.force = f - c * v1 - k * q1 + pushed_by;
        if v1 != rule || met || answered {
            a1 = (past + self.force) / (mu * m);
        }
        (self.a, self.elastic, self.closed, self.plan.state) = (a1, elastic, !closed.is_empty(), [q1, v1]);
        End { state: [q1, v1], impulse, force }
    }
}

fn scene(plan: &Plan) -> Scene {
    let [m, c, k, f] = plan.body;
    let mut scene = Scene::oscillator(m, c, k).with_load(Load::constant(f));
    for wall in &plan.walls {
        scene = scene.with_wall(wall.clone());
    }
    if let Some([given, at]) = plan.blow {
        scene = scene.with_load(Load::impulse(given, at));
    }
    scene.with_initial(&plan.state[..1], &plan.state[1..])
}

/// Fails unless `steps` steps of the rule are those that are written out.
fn compare<S: Space>(plan: &Plan, steps: u64) {
    let scene = scene(plan);
    let [alpha_m, alpha_f, beta, gamma] = weights(plan.rho);
    let balance = Balance::GeneralizedAlpha { alpha_m, alpha_f, beta, gamma };
    let mut rule = GeneralizedAlpha::<S>::new(&scene, balance, plan.h, Backend::Auto).unwrap();
    let mut frame = Frame::<S>::new(&scene).unwrap();
    rule.restart(&scene, 0.0, &frame).unwrap();
    let mut written = Written::new(plan);
    for step in 0..steps {
        frame.force(Some(&[plan.extra]));
        rule.advance(step, &mut frame).unwrap();
        let end = written.step(step);
        let found = [frame.q[0], frame.v[0]].into_iter().chain(frame.impulse.iter().chain(&frame.force).copied());
        let expected = end.state.into_iter().chain(end.impulse.iter().chain(&end.force).copied());
        for (found, expected) in found.zip(expected) {
            // Rounding of accelerations that are differences of displacements over h², 1e-6 s²;
            // impacts double it some times.
            assert!(
                (found - expected).abs() < 1e-7 * (1.0 + expected.abs()),
                "{plan:?}, step {step}: {end:?} {frame:?}"
            );
        }
    }
}

/// Walls of every kind about a place at which a body stands: on one, before it, or beside all.
fn drawn(index: u64) -> Plan {
    let number = |stream: u64, octaves: f64| (octaves * draw(stream, index)).exp2();
    let or_none = |stream: u64, x: f64| if draw(stream, index) < -0.3 { 0.0 } else { x };
    let h = 0.02 * number(1, 2.0);
    let e = [0.0, 0.5, 0.8, 1.0][(2.0 * draw(2, index) + 2.0) as usize];
    let mut walls =
        vec![Wall::upper("stop", 0.25).with_restitution(e), Wall::lower("floor", -0.5).with_restitution(0.5)];
    if draw(3, index) > 0.0 {
        // A pad before the stop, so that both push at once.
        walls.push(Wall::upper("pad", 0.125).with_elasticity(50.0 * number(4, 3.0), or_none(5, number(6, 2.0))));
        walls.push(Wall::lower("soft", -0.375).with_elasticity(50.0 * number(7, 3.0), or_none(8, number(9, 2.0))));
    }
    // Also at the very end of a step, where it moves nothing in it.
    let at = h * if draw(13, index) > 0.0 { 3.0 } else { 2.5 + 0.5 * draw(14, index) };
    let blow = (draw(15, index) > -0.3).then_some([4.0 * draw(16, index), at]);
    let body = [
        number(17, 1.0),
        or_none(18, 5.0 * number(19, 5.0)),
        or_none(20, 20.0 * number(21, 3.0)),
        or_none(22, 20.0 * draw(23, index)),
    ];
    let state = match draw(10, index) {
        moving if moving < -0.2 => [0.25 * draw(11, index), 4.0 * draw(12, index)],
        // At rest before the stop, by about the way of the first step.
        near if near < 0.2 => [0.25 - 0.5 * h * h * body[3].abs() / body[0] * number(27, 4.0), 0.0],
        _ => [0.25, 0.0],
    };
    let rho = [0.0, 0.3, 0.8, 1.0][(2.0 * draw(24, index) + 2.0) as usize];
    let extra = or_none(25, 10.0 * draw(26, index));
    Plan { body, walls, blow, extra, state, rho, h }
}

#[test]
fn every_step_is_that_of_the_formulas() {
    for index in 0..3000 {
        let plan = drawn(index);
        compare::<Line>(&plan, 12);
        let mut mirrored = plan.clone();
        for wall in &mut mirrored.walls {
            let side = if wall.side() == Side::Upper { Wall::lower } else { Wall::upper };
            *wall = Wall { law: wall.law, ..side(&wall.name, -wall.position()) };
        }
        mirrored.body[3] *= -1.0;
        mirrored.extra *= -1.0;
        mirrored.state = mirrored.state.map(|x| -x);
        mirrored.blow = mirrored.blow.map(|[given, at]| [-given, at]);
        compare::<Matrices>(&mirrored, 12);
    }
}

#[test]
fn a_body_that_stands_at_its_wall_unpressed_and_is_struck_at_the_end_of_a_step_rebounds() {
    // The blow moves nothing in its step: the wall is touched, and nothing presses onto it.
    for rho in [0.0, 0.5, 0.8, 1.0] {
        for wall in [Wall::upper("stop", 0.25), Wall::lower("stop", 0.25)] {
            let given = -sign(&wall) * 2.0;
            let scene = Scene::oscillator(1.0, 0.0, 0.0)
                .with_load(Load::impulse(given, 0.03))
                .with_initial(&[0.25], &[0.0])
                .with_wall(wall.with_restitution(0.5));
            let [alpha_m, alpha_f, beta, gamma] = weights(rho);
            let balance = Balance::GeneralizedAlpha { alpha_m, alpha_f, beta, gamma };
            let mut rule = GeneralizedAlpha::<Line>::new(&scene, balance, 0.01, Backend::Auto).unwrap();
            let mut frame = Frame::<Line>::new(&scene).unwrap();
            rule.restart(&scene, 0.0, &frame).unwrap();
            for step in 0..3 {
                assert_eq!((frame.q[0], frame.v[0]), (0.25, 0.0));
                rule.advance(step, &mut frame).unwrap();
            }
            // e times the speed of the blow, without rounding in these numbers.
            assert_eq!((frame.q[0], frame.v[0]), (0.25, -0.5 * given), "{rho}");
        }
    }
}

#[test]
fn a_body_before_a_wall_is_not_held_by_it_though_a_damper_that_feels_less_would_take_it_there() {
    // m/c of a few steps, and distances about the way of the first step under 6 N, in h² times the
    // acceleration.
    let (m, h, f) = (2.0, 0.01, 6.0);
    for (rho, steps) in [0.0, 0.3, 0.5].into_iter().flat_map(|rho| [1.0, 2.0, 4.0, 8.0].map(|x| (rho, x))) {
        for distance in (1..20).map(|k| 0.025 * f64::from(k) * h * h * f / m) {
            let walls = vec![Wall::upper("stop", 0.25).with_restitution(0.5)];
            let (body, state) = ([m, steps * m / h, 0.0, f], [0.25 - distance, 0.0]);
            compare::<Line>(&Plan { body, walls, blow: None, extra: 0.0, state, rho, h }, 3);
        }
    }
}

#[test]
fn a_wall_far_from_the_origin_gives_back_the_blow_that_drives_a_damped_body_into_it() {
    // There the place of a body on its floor, behind a lever, is known to some 1e-10 m, far less
    // well than a touching distance. It rests under 5 N, with a blow of 1 N s within the second
    // step.
    let [alpha_m, alpha_f, beta, gamma] = weights(0.8);
    let balance = Balance::GeneralizedAlpha { alpha_m, alpha_f, beta, gamma };
    for place in (0..50).map(|i| 1e6 + 0.1 * f64::from(i)) {
        let lever = |wall: Wall| wall.at(Row::new(vec![(0, 0.3)]));
        let scene = Scene::oscillator(2.0, 3.0, 0.0)
            .with_wall(lever(Wall::lower("floor", place).with_restitution(0.0)))
            .with_wall(lever(Wall::upper("ceiling", place + 0.5)))
            .with_load(Load::constant(-5.0))
            .with_load(Load::impulse(-1.0, 0.013))
            .with_initial(&[place / 0.3], &[0.0]);
        let mut rule = GeneralizedAlpha::<Matrices>::new(&scene, balance, 0.01, Backend::Auto).unwrap();
        let mut frame = Frame::<Matrices>::new(&scene).unwrap();
        rule.restart(&scene, 0.0, &frame).unwrap();
        let mut total = 0.0;
        for step in 0..10 {
            rule.advance(step, &mut frame).unwrap();
            total += 0.3 * frame.impulse[0];
        }
        // The weight of 0.1 s and the blow, of which the damper would take 3 mN s; 2 kg times the
        // rounding of the place over the step.
        assert!((total - 1.5).abs() < 1e-5 && frame.v[0].abs() < 1e-6, "{place}: {total}, {frame:?}");
    }
}
