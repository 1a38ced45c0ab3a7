//! Random corners: bodies between flats with friction that meet several of them in a step.
//!
//! `SIGNORINI_CASES` and `SIGNORINI_SEED` in the environment draw more and others.

use super::super::super::contact_rows::ContactRows;
use super::super::*;
use super::Draws;
use crate::linear::Factor;
use std::str::FromStr;

/// One to three bodies, which hold together by a random mass matrix in more than half of the
/// corners, each at one to three flats of a regular polygon or of random directions, some of them
/// twice (so that their rows depend on one another; more than two flats of a body always do), some
/// elastic, some without friction.
struct Corner {
    mass: Vec<Vec<f64>>,
    /// Body, normal and compliance of each contact, and its bound on the normal velocity.
    contacts: Vec<(usize, [f64; 2], f64)>,
    bounds: Vec<f64>,
    /// Velocities at the end of the step without contacts.
    free: Vec<f64>,
    places: ContactRows,
    sweeps: FrictionContacts,
}

impl Corner {
    fn random(seed: u64) -> Self {
        let mut draws = Draws::new(17, seed);
        let bodies = 1 + draws.below(3);
        let n = 2 * bodies;
        let half: Vec<Vec<f64>> = (0..n).map(|_| (0..n).map(|_| draws.between(-1.0, 1.0)).collect()).collect();
        let together = draws.chance(0.6);
        let entry = |i: usize, j: usize| {
            let gram: f64 = (0..n).map(|k| half[i][k] * half[j][k]).sum();
            match (together, i == j) {
                (true, same) => gram + if same { 0.3 } else { 0.0 },
                (false, true) => 0.1 + (i / 2) as f64,
                (false, false) => 0.0,
            }
        };
        let mass: Vec<Vec<f64>> = (0..n).map(|i| (0..n).map(|j| entry(i, j)).collect()).collect();
        let entries = (0..n).flat_map(|i| (0..=i).map(move |j| (i, j)));
        let a = Symmetric::from_entries(n, entries.map(|(i, j)| (i, j, mass[i][j])).collect::<Vec<_>>());
        let rows: Vec<Row> = (0..n).map(Row::dof).collect();
        let rows: Vec<&Row> = rows.iter().collect();
        let mut factor = Factor::new(&a).expect("a definite matrix");
        let (places, mut sweeps) =
            (ContactRows::new(n, &rows, &mut factor), FrictionContacts::new(a, &rows, 6 * bodies));
        // Velocities at the start, some of them small, and what loads add to them.
        let size = |draws: &mut Draws, least: f64| 10_f64.powf(draws.between(least, 0.0));
        let speed = |draws: &mut Draws| if draws.chance(0.3) { size(draws, -8.0) } else { 1.0 };
        let start: Vec<f64> = (0..n).map(|_| speed(&mut draws) * draws.between(-1.0, 1.0)).collect();
        let free: Vec<f64> = start.iter().map(|v| v + size(&mut draws, -6.0) * draws.between(-1.0, 1.0)).collect();
        let (shared_e, shared_mu) = ([0.0, 0.5, 1.0][draws.below(3)], [0.1, 0.3, 0.8, 2.0][draws.below(4)]);
        let (unequal_e, unequal_mu, any_angle) = (draws.chance(0.3), draws.chance(0.3), draws.chance(0.25));
        let (mut contacts, mut bounds) = (Vec::new(), Vec::new());
        for body in 0..bodies {
            let (sides, turn) = (3 + draws.below(6), draws.between(0.0, 6.3));
            for flat in 0..1 + draws.below(3) {
                let angle = turn + std::f64::consts::TAU * flat as f64 / sides as f64;
                let angle = if any_angle { draws.between(0.0, 6.3) } else { angle };
                let normal = [angle.cos(), angle.sin()];
                let mu = if unequal_mu { draws.between(0.0, 2.0) } else { shared_mu };
                let mu = if draws.chance(0.2) { 0.0 } else { mu };
                let e = if unequal_e { draws.between(0.0, 1.0) } else { shared_e };
                let compliance = if draws.chance(0.15) { draws.between(0.01, 1.0) } else { 0.0 };
                let approach = dot(normal, [start[2 * body], start[2 * body + 1]]);
                let bound = if approach > 0.0 { -e * approach } else { -approach };
                for _ in 0..if draws.chance(0.1) { 2 } else { 1 } {
                    let (index, at) = (contacts.len(), [2 * body, 2 * body + 1]);
                    let touch = FrictionContact::new(&places, (index, at), (normal, bound), (mu, compliance));
                    sweeps.touches.push(touch);
                    contacts.push((body, normal, compliance));
                    bounds.push(bound);
                }
            }
        }
        sweeps.before.copy_from_slice(&start);
        sweeps.free.copy_from_slice(&free);
        Self { mass, contacts, bounds, free, places, sweeps }
    }

    /// The impulses on the bodies.
    fn impulses(&self) -> Vec<f64> {
        let mut impulses = vec![0.0; self.free.len()];
        for (&(body, [y, z], _), touch) in self.contacts.iter().zip(&self.sweeps.touches) {
            let [p, f] = touch.impulse;
            impulses[2 * body] += -p * y - f * z;
            impulses[2 * body + 1] += -p * z + f * y;
        }
        impulses
    }

    /// The energy that the impulses add to these velocities, over what they would give to a body at
    /// rest.
    fn gain(&self, v: &[f64]) -> f64 {
        let impulses = self.impulses();
        let own = 0.5 * product(&impulses, &solved(&self.mass, impulses.clone()));
        if own == 0.0 { 0.0 } else { product(&impulses, v) / own + 1.0 }
    }

    /// True if friction adds more energy at a body with several pushing contacts than all impulses
    /// take, at the velocities `v` before them.
    fn rubs_faster(&self, v: &[f64]) -> bool {
        let impulses = self.impulses();
        let change = solved(&self.mass, impulses.clone());
        let own = 0.5 * product(&impulses, &change);
        let touches = &self.sweeps.touches;
        let work = |body: usize| {
            let pushing =
                || self.contacts.iter().zip(touches).filter(|(one, touch)| one.0 == body && touch.impulse[0] > 0.0);
            let [y, z] = [2 * body, 2 * body + 1].map(|i| v[i] + 0.5 * change[i]);
            let sum: f64 = pushing().map(|(one, touch)| touch.impulse[1] * (one.1[0] * z - one.1[1] * y)).sum();
            if pushing().count() > 1 { sum } else { 0.0 }
        };
        let most = (1e-9 * own).max(-self.gain(v) * own);
        (0..v.len() / 2).any(|body| work(body) > most)
    }

    /// By how much the impulses miss Coulomb's law, the law of impact and the balance of momentum,
    /// relative to the velocities and the impulses. Knows the masses, and nothing of the solver.
    fn miss(&self) -> f64 {
        let touches = &self.sweeps.touches;
        let momentum = self.mass.iter().zip(self.impulses()).map(|(row, p)| product(row, &self.free) + p);
        let v = solved(&self.mass, momentum.collect());
        let largest = |x: &mut dyn Iterator<Item = f64>| x.fold(0.0_f64, |most, x| most.max(x.abs()));
        let speed = largest(&mut self.free.iter().chain(&self.bounds).chain(&v).copied());
        let push = largest(&mut touches.iter().flat_map(|touch| touch.impulse));
        let over = |x: f64, scale: f64| if x == 0.0 { 0.0 } else { x / scale };
        let mut miss = 0.0_f64;
        for (index, (&(body, [y, z], compliance), touch)) in self.contacts.iter().zip(touches).enumerate() {
            let ([p, f], rate) = (touch.impulse, [v[2 * body], v[2 * body + 1]]);
            let bound = if self.sweeps.wedged.contains(&index) { 0.0 } else { self.bounds[index] };
            let slack = over(bound - (y * rate[0] + z * rate[1]) + compliance * p, speed);
            miss = miss.max(slack.min(over(p, push)).abs()).max(over(f.abs() - touch.friction * p, push));
            let along = y * rate[1] - z * rate[0];
            let slips = over((f + touch.friction * p * along.signum()).abs(), push);
            miss = miss.max(over(along.abs(), speed).min(slips));
        }
        miss
    }
}

fn product(row: &[f64], x: &[f64]) -> f64 {
    row.iter().zip(x).map(|(a, x)| a * x).sum()
}

/// Solves A x = b by elimination with rows exchanged.
fn solved(a: &[Vec<f64>], b: Vec<f64>) -> Vec<f64> {
    let n = b.len();
    let mut rows: Vec<Vec<f64>> = a.iter().zip(b).map(|(row, b)| row.iter().copied().chain([b]).collect()).collect();
    for k in 0..n {
        let pivot = (k..n).max_by(|&i, &j| rows[i][k].abs().total_cmp(&rows[j][k].abs())).expect("a row");
        rows.swap(k, pivot);
        let own = rows[k].clone();
        for row in &mut rows[k + 1..] {
            let factor = row[k] / own[k];
            row.iter_mut().zip(&own).for_each(|(x, own)| *x -= factor * own);
        }
    }
    let mut x = vec![0.0; n];
    for k in (0..n).rev() {
        x[k] = (rows[k][n] - product(&rows[k][k + 1..n], &x[k + 1..])) / rows[k][k];
    }
    x
}

fn from_environment<T: FromStr>(name: &str, usual: T) -> T {
    std::env::var(name).ok().and_then(|text| text.parse().ok()).unwrap_or(usual)
}

#[test]
fn every_random_corner_has_an_answer_that_obeys_coulomb_and_newton() {
    let (count, first) = (from_environment("SIGNORINI_CASES", 3000_u64), from_environment("SIGNORINI_SEED", 0_u64));
    let (mut met, mut wedged, mut worst) = (0, 0, 0.0_f64);
    for seed in first..first + count {
        let mut corner = Corner::random(seed);
        met += u64::from(corner.sweeps.solve(&corner.places));
        assert_eq!(corner.sweeps.unsettled, 0, "seed {seed}");
        wedged += corner.sweeps.gave_up;
        let miss = corner.miss();
        // Masses and pushes of very different sizes lose some digits; the judge allows 1e-6.
        assert!(miss < 1e-9, "seed {seed}: {miss:e}");
        worst = worst.max(miss);
    }
    println!("{met} of {count} corners met something, {wedged} gave up rebounds; largest residual {worst:e}");
    assert!(met * 10 > count * 7 && wedged * 100 > count && wedged * 8 < count, "{met} {wedged}");
}

#[test]
fn no_impact_in_a_random_corner_adds_energy() {
    let (count, first) = (from_environment("SIGNORINI_CASES", 3000_u64), from_environment("SIGNORINI_SEED", 0_u64));
    let (mut rigid, mut stopped, mut rubbed) = (0, 0, 0);
    for seed in first..first + count {
        let mut corner = Corner::random(seed);
        if corner.contacts.iter().any(|contact| contact.2 > 0.0) {
            continue;
        }
        rigid += 1;
        corner.sweeps.strike(&corner.places);
        let gave_up = corner.sweeps.gave_up;
        // Loads add to the velocities: impulses may add energy to those before them or to those
        // after them, of which the other would then be wrong.
        let gain = corner.gain(&corner.sweeps.before).min(corner.gain(&corner.free));
        assert!(gain < 1e-8 && corner.miss() < 1e-9, "seed {seed}: {gain:e}, {:e}", corner.miss());
        let mut newton = Corner::random(seed);
        newton.sweeps.solve(&newton.places);
        let gain = newton.gain(&newton.sweeps.before).min(newton.gain(&newton.free));
        let rubs = newton.rubs_faster(&newton.sweeps.before) && newton.rubs_faster(&newton.free);
        // Nothing else gives up its rebound than by Newton's and Coulomb's law alone.
        let gives_up = (gain > 1e-9 || rubs) && newton.sweeps.gave_up == 0;
        assert_eq!(gave_up > newton.sweeps.gave_up, gives_up, "seed {seed}: {gain:e} {rubs}");
        (stopped, rubbed) = (stopped + u64::from(gain > 1e-9 && gives_up), rubbed + u64::from(rubs && gives_up));
    }
    println!("in {stopped} of {rigid} corners impulses would add energy, in {rubbed} friction more than they take");
    assert!(stopped * 500 > rigid && stopped * 20 < rigid, "{stopped} of {rigid}");
    assert!(rubbed * 1000 > rigid && rubbed * 20 < rigid, "{rubbed} of {rigid}");
}

#[test]
fn an_oblique_impact_that_would_add_energy_ends_in_rest() {
    // Of a body with the momentum (2 ẏ + 0.9 ż, 0.9 ẏ + ż) that sticks to a flat towards y:
    // Newton's law demands (−1, 0) m/s after (1, −0.9) m/s, 1 J after 0.595 J. Without friction it
    // leaves with −1 m/s and the energy that it had.
    let mass = vec![vec![2.0, 0.9], vec![0.9, 1.0]];
    let a = Symmetric::from_entries(2, [(0, 0, 2.0), (0, 1, 0.9), (1, 1, 1.0)]);
    let (rows, free) = ([Row::dof(0), Row::dof(1)], vec![1.0, -0.9]);
    let rows: Vec<&Row> = rows.iter().collect();
    let places = ContactRows::new(2, &rows, &mut Factor::new(&a).expect("a mass"));
    for (friction, after) in [(2.0, Some([0.0, 0.0])), (0.0, None)] {
        let mut sweeps = FrictionContacts::new(a.clone(), &rows, 1);
        sweeps.touches.push(FrictionContact::new(&places, (0, [0, 1]), ([1.0, 0.0], -1.0), (friction, 0.0)));
        sweeps.before.copy_from_slice(&free);
        sweeps.free.copy_from_slice(&free);
        assert!(sweeps.strike(&places));
        assert_eq!((sweeps.gave_up, sweeps.wedged.len()), if after.is_some() { (1, 1) } else { (0, 0) });
        let v: Vec<f64> = solved(&mass, sweeps.impulse.clone()).iter().zip(&free).map(|(d, v)| d + v).collect();
        let [y, z] = after.unwrap_or([-1.0, v[1]]);
        assert!((v[0] - y).abs() < 1e-15 && (v[1] - z).abs() < 1e-15, "{v:?}");
    }
}

#[test]
fn a_corner_whose_balanced_impulses_contradict_the_rebound_gives_it_up() {
    // A body that flies symmetrically into two flats at a right angle, μ = 2: impulses along the
    // edge of the cones of friction balance one another, and both flats stick. Newton's law asks
    // for −e v along both normals, which is a velocity along both tangents.
    for (e, wedged) in [(0.5, vec![0, 1]), (0.0, vec![])] {
        let mut corner = right_angle(e, 2.0);
        assert!(corner.sweeps.solve(&corner.places));
        let mut gave_up = corner.sweeps.wedged.clone();
        gave_up.sort_unstable();
        assert_eq!((gave_up, corner.sweeps.unsettled), (wedged, 0), "e = {e}");
        assert!(corner.miss() < 1e-14, "e = {e}: {:e}", corner.miss());
    }
    // With little friction the body slides back out.
    let mut corner = right_angle(0.5, 0.3);
    assert!(corner.sweeps.solve(&corner.places) && corner.sweeps.wedged.is_empty());
    assert!(corner.miss() < 1e-14, "{:e}", corner.miss());
}

/// A body of 1 kg with (1, 1) m/s at flats towards y and z.
fn right_angle(e: f64, friction: f64) -> Corner {
    let mass = vec![vec![1.0, 0.0], vec![0.0, 1.0]];
    let a = Symmetric::diagonal(&[1.0; 2]);
    let rows = [Row::dof(0), Row::dof(1)];
    let rows: Vec<&Row> = rows.iter().collect();
    let (places, mut sweeps) =
        (ContactRows::new(2, &rows, &mut Factor::new(&a).expect("a mass")), FrictionContacts::new(a, &rows, 2));
    let contacts = vec![(0, [1.0, 0.0], 0.0), (0, [0.0, 1.0], 0.0)];
    for (index, &(_, normal, _)) in contacts.iter().enumerate() {
        sweeps.touches.push(FrictionContact::new(&places, (index, [0, 1]), (normal, -e), (friction, 0.0)));
    }
    sweeps.free.fill(1.0);
    Corner { mass, contacts, bounds: vec![-e; 2], free: vec![1.0; 2], places, sweeps }
}

#[test]
fn the_corner_where_sweeps_pass_an_impulse_to_and_fro_is_answered_by_pivoting() {
    // One flat may be left with 4.9e-6 m/s, the other rebounds and sticks: 3600 sweeps would do.
    let mut corner = right_angle(0.5, 0.3);
    let (bounds, free) = (vec![4.889e-6, -0.027_778_8], vec![0.017_37, 0.061_8]);
    for (touch, &bound) in corner.sweeps.touches.iter_mut().zip(&bounds) {
        touch.bound = bound;
    }
    corner.sweeps.free.copy_from_slice(&free);
    (corner.bounds, corner.free) = (bounds, free);
    assert!(corner.sweeps.solve(&corner.places));
    assert_eq!((corner.sweeps.unsettled, corner.sweeps.gave_up), (0, 0));
    let [first, second] = [0, 1].map(|index: usize| corner.sweeps.touches[index].impulse);
    assert!(first == [0.0; 2] && second[0] > 0.0 && second[1].abs() < 0.3 * second[0], "{first:?} {second:?}");
    assert!(corner.miss() < 1e-14, "{:e}", corner.miss());
}
