//! The impulses of several contacts, judged by the law of each.

mod corners;

use super::*;
use crate::hash::Draws;
use crate::linear::Factor;

/// Contacts of a structure.
struct Scene {
    places: ContactRows,
    sweeps: FrictionContacts,
    factor: Factor,
    rows: Vec<Row>,
    n: usize,
}

impl Scene {
    /// `count` contacts, each at a place of its own, on `n` degrees of freedom whose rows have this
    /// part in common; friction up to `friction`, in half of the contacts 0. Velocities are some
    /// `unit` m/s.
    fn random(draws: &mut Draws, (n, count): (usize, usize), (shared, friction): (f64, f64), unit: f64) -> Self {
        let half: Vec<Vec<f64>> = (0..n).map(|_| (0..n).map(|_| draws.between(-0.3, 0.3)).collect()).collect();
        let mass = |i: usize, j: usize| {
            let gram: f64 = (0..n).map(|k| half[i][k] * half[j][k]).sum();
            if i == j { 1.0 + gram } else { shared * gram }
        };
        let entries = (0..n).flat_map(|i| (0..=i).map(move |j| (i, j)));
        let a = Symmetric::from_entries(n, entries.map(|(i, j)| (i, j, mass(i, j))).collect::<Vec<_>>());
        let mut row = |own: usize| {
            let entry = |j: usize, x: f64| if j == own % n { 1.3 + 0.2 * x } else { shared * x };
            Row::new((0..n).map(|j| (j, entry(j, draws.between(-1.0, 1.0)))).collect())
        };
        let rows: Vec<Row> = (0..2 * count).map(&mut row).collect();
        let mut factor = Factor::new(&a).expect("a definite matrix");
        let all: Vec<&Row> = rows.iter().collect();
        let (places, mut sweeps) = (ContactRows::new(n, &all, &mut factor), FrictionContacts::new(a, &all, count));
        let [inside, off] = [0, 1].map(|_| (0..n).map(|_| draws.between(-1.0, 1.0)).collect::<Vec<f64>>());
        for index in 0..count {
            let (turn, at) = (draws.between(0.0, 6.3), [2 * index, 2 * index + 1]);
            let normal = [turn.cos(), turn.sin()];
            // The velocity `inside` satisfies all bounds.
            let bound = dot(normal, at.map(|row| rows[row].dot(&inside))) + draws.between(0.0, 0.3);
            let mu = if draws.chance(0.5) { draws.between(0.0, friction) } else { 0.0 };
            let compliance = if draws.chance(0.3) { draws.between(0.1, 1.0) } else { 0.0 };
            let laws = (mu, compliance);
            sweeps.touches.push(FrictionContact::new(&places, (index, at), (normal, bound * unit), laws));
        }
        for (free, row) in sweeps.free.iter_mut().zip(&rows) {
            *free = unit * (row.dot(&inside) + 2.0 * row.dot(&off));
        }
        Self { places, sweeps, factor, rows, n }
    }

    fn solve(&mut self) -> bool {
        self.sweeps.solve(&self.places)
    }

    /// The velocities of all rows under the impulses of the contacts, and how far these are from
    /// Coulomb's law and the bounds, in `unit` m/s.
    fn miss(&mut self, unit: f64) -> f64 {
        let mut push = vec![0.0; self.n];
        for touch in &self.sweeps.touches {
            let ([p, f], [y, z]) = (touch.impulse, touch.normal);
            for (row, along) in touch.rows.into_iter().zip([-p * y - f * z, -p * z + f * y]) {
                self.rows[row].entries().iter().for_each(|&(j, g)| push[j] += g * along);
            }
        }
        self.factor.solve(&mut push);
        let mut miss = 0.0_f64;
        for touch in &self.sweeps.touches {
            let ([p, f], [y, z]) = (touch.impulse, touch.normal);
            let rate = touch.rows.map(|row| self.sweeps.free[row] + self.rows[row].dot(&push));
            let (beyond, along) = (dot([y, z], rate) - touch.compliance * p - touch.bound, y * rate[1] - z * rate[0]);
            miss = miss.max(if p > 0.0 { beyond.abs() } else { beyond }).max(-p).max(f.abs() - touch.friction * p);
            // Where it slides, friction is against it, and as large as it may be.
            miss = miss.max((f + touch.friction * p * along.signum()).abs().min(along.abs()));
        }
        miss / unit
    }
}

/// Some roundings of velocities of a few m/s, and of responses of a few 1/kg.
const ROUNDING: f64 = 1e-12;

#[test]
fn impulses_obey_the_law_of_each_contact_in_any_units() {
    let mut rubbing = 0;
    for seed in 0..200 {
        let mut known: Option<Vec<[f64; 2]>> = None;
        for unit in [1.0, 2.0_f64.powi(-40), 2.0_f64.powi(40)] {
            let mut draws = Draws::new(17, seed);
            let count = 2 + seed as usize % 4;
            let mut scene = Scene::random(&mut draws, (2 * count + 1, count), (0.5, 0.3), unit);
            if !scene.solve() {
                continue;
            }
            assert_eq!((scene.sweeps.solves, scene.sweeps.unsettled), (1, 0), "{seed}, {unit:e}");
            let miss = scene.miss(unit);
            assert!(miss < ROUNDING, "{seed}, {unit:e}: {miss:e}");
            let impulses: Vec<[f64; 2]> = scene.sweeps.touches.iter().map(|t| t.impulse.map(|x| x / unit)).collect();
            rubbing += impulses.iter().filter(|p| p[1] != 0.0).count();
            let known = known.get_or_insert_with(|| impulses.clone());
            for (one, other) in known.iter().flatten().zip(impulses.iter().flatten()) {
                assert!((one - other).abs() < ROUNDING, "{seed}, {unit:e}: {known:?} {impulses:?}");
            }
        }
    }
    assert!(rubbing > 100, "{rubbing}");
}

#[test]
fn what_counts_as_settled_obeys_the_law_however_large_the_friction_in_any_units() {
    let mut settled = 0;
    for seed in 0..300 {
        for unit in [1.0, 2.0_f64.powi(-40), 2.0_f64.powi(40)] {
            let count = 3 + seed as usize % 4;
            let mut scene = Scene::random(&mut Draws::new(17, 900 + seed), (count + 2, count), (0.9, 1.5), unit);
            if scene.solve() && scene.sweeps.unsettled == 0 {
                let miss = scene.miss(unit);
                // Impulses that press against each other lose some digits.
                assert!(miss < 1e-9, "{seed}, {unit:e}: {miss:e}");
                settled += 1;
            }
        }
    }
    assert!(settled > 500, "{settled}");
}

#[test]
fn contacts_that_crowd_on_few_degrees_of_freedom_are_answered_by_pivoting_or_without_it() {
    let mut pushing = 0;
    for seed in 0..100 {
        let count = 3 + seed as usize % 4;
        // As many rows as degrees of freedom or more, so that some impulses depend on others.
        let mut scene = Scene::random(&mut Draws::new(17, 500 + seed), (3, count), (0.7, 0.0), 1.0);
        let free =
            scene.sweeps.touches.iter().all(|t| dot(t.normal, t.rows.map(|row| scene.sweeps.free[row])) <= t.bound);
        if free {
            continue;
        }
        assert!(scene.solve(), "{seed}");
        assert_eq!(scene.sweeps.unsettled, 0, "{seed}");
        let miss = scene.miss(1.0);
        // Impulses that press against each other lose some digits.
        assert!(miss < 1e-9, "{seed}: {miss:e}");
        let touches = &mut scene.sweeps.touches;
        touches.iter_mut().for_each(|touch| (touch.state, touch.impulse) = (State::Open, [9.0, 9.0]));
        assert!(scene.sweeps.pivot().is_some(), "{seed}");
        let miss = scene.miss(1.0);
        assert!(miss < 1e-9, "{seed}, by pivoting: {miss:e}");
        for touch in &scene.sweeps.touches {
            let state = if touch.impulse[0] > 0.0 { State::Ahead } else { State::Open };
            assert_eq!((touch.state, touch.impulse[1]), (state, 0.0), "{seed}");
            pushing += u32::from(state == State::Ahead);
        }
        scene.sweeps.touches[0].friction = 0.1;
        assert!(scene.sweeps.pivot().is_none(), "{seed}: there is friction");
    }
    assert!(pushing > 100, "{pushing}");
}

#[test]
fn one_linear_system_gives_the_impulses_of_states_that_are_known() {
    let mut seen = [0; 4];
    for seed in 0..150 {
        let mut draws = Draws::new(17, seed);
        let count = 2 + seed as usize % 4;
        let mut scene = Scene::random(&mut draws, (2 * count + 1, count), (0.5, 0.3), 1.0);
        if !scene.solve() {
            continue;
        }
        let Scene { places, sweeps, .. } = &mut scene;
        let FrictionContacts { touches, free, .. } = sweeps;
        let exact: Vec<[f64; 2]> = touches.iter().map(|touch| touch.impulse).collect();
        for touch in touches.iter_mut() {
            seen[touch.state as usize] += 1;
            touch.impulse = touch.impulse.map(|x| if x == 0.0 { 0.0 } else { x + draws.between(-0.5, 0.5) });
            touch.comply();
        }
        let mut y = vec![f64::NAN; free.len()];
        Linear::default().solve(places, touches, (free, &mut y));
        for (touch, exact) in touches.iter().zip(&exact) {
            let off = [touch.impulse[0] - exact[0], touch.impulse[1] - exact[1]];
            assert!(off.iter().all(|off| off.abs() < 1e-11), "{seed}: {touch:?}, {exact:?}");
            assert!(touch.holds(&y, ROUNDING), "{seed}: {touch:?}");
        }
    }
    assert!(seen.iter().all(|&count| count > 5), "{seen:?}");
}

#[test]
fn states_that_are_wrong_lead_to_those_that_hold() {
    for seed in 0..100 {
        // Contacts that hardly feel each other.
        let count = 2 + seed as usize % 4;
        let mut scene = Scene::random(&mut Draws::new(17, seed), (2 * count, count), (0.02, 0.0), 1.0);
        if !scene.solve() {
            continue;
        }
        let Scene { places, sweeps, .. } = &mut scene;
        let FrictionContacts { touches, free, .. } = sweeps;
        let exact: Vec<f64> = touches.iter().map(|touch| touch.impulse[0]).collect();
        for start in [State::Open, State::Ahead] {
            touches.iter_mut().for_each(|touch| (touch.state, touch.impulse) = (start, [0.0; 2]));
            let mut y = free.clone();
            assert!(Linear::default().settle(places, touches, (free, &mut y), ROUNDING), "{seed}, {start:?}");
            for (touch, exact) in touches.iter().zip(&exact) {
                assert!((touch.impulse[0] - exact).abs() < ROUNDING, "{seed}, {start:?}: {touch:?}, {exact}");
            }
        }
    }
}

#[test]
fn a_contact_that_sticks_within_rounding_has_no_more_friction_than_coulomb_allows() {
    let mut scene = Scene::random(&mut Draws::new(17, 3), (3, 1), (0.5, 0.0), 1.0);
    let Scene { places, sweeps, .. } = &mut scene;
    let FrictionContacts { touches, free, .. } = sweeps;
    // An elastic wall over a part so short that it gives 2e-12 N s.
    let law = (0.5, 1e12);
    let mut touch = FrictionContact::new(places, (0, [0, 1]), ([0.6, 0.8], -2.0), law);
    touch.state = State::Stick;
    // Sticking asks for three times the friction that is allowed, 3e-12 N s, which changes the
    // velocity by less than the rounding of slides of some m/s elsewhere.
    let asked = 3.0 * 0.5 * 2e-12 * touch.own[2];
    free.clear();
    free.extend(touch.tangent.map(|t| -asked * t));
    touches.push(touch);
    let noise = 1e-11;
    assert!(asked < noise);
    let mut y = free.clone();
    touches.remove(0);
    assert!(Linear::default().settle(places, touches, (free, &mut y), noise));
    let [p, f] = touches[0].impulse;
    // The compliance is 1e12 of the response: p is 2e-12 N s to that.
    assert!((p - 2e-12).abs() < 1e-22 && f == 0.5 * p, "{p} {f}");
}

#[test]
fn rounding_is_a_share_of_the_velocities_and_of_what_the_contacts_change() {
    let mut scene = Scene::random(&mut Draws::new(17, 1), (4, 2), (0.5, 0.0), 1.0);
    let touches = &mut scene.sweeps.touches;
    (touches[0].own, touches[1].own) = ([2.0, 0.0, 4.0], [0.5, 0.0, 8.0]);
    for (rate, first, second, largest) in [
        (7.0, [3.0, 0.0], [1.0, 0.0], 7.0),
        (1.0, [3.0, 0.0], [1.0, 0.0], 6.0),
        (1.0, [-3.0, 0.0], [40.0, 0.0], 20.0),
        (1.0, [3.0, 5.0], [1.0, -4.0], 32.0),
        // At most 1e5 times the velocities.
        (4.0, [1e9, 0.0], [0.0, 0.0], 4e5),
    ] {
        (touches[0].impulse, touches[1].impulse) = (first, second);
        assert!((most(rate, touches) - largest).abs() < 1e-9, "{rate} {first:?} {second:?}");
    }
}

#[test]
fn a_step_whose_velocities_are_no_numbers_counts_as_not_settled() {
    let mut scene = Scene::random(&mut Draws::new(17, 1), (3, 1), (0.5, 0.0), 1.0);
    scene.sweeps.touches[0] = scene.sweeps.touches[0].after(0.2.into(), State::Open);
    scene.sweeps.free.fill(f64::NAN);
    assert!(scene.solve());
    assert_eq!((scene.sweeps.solves, scene.sweeps.unsettled), (1, 1));
}
