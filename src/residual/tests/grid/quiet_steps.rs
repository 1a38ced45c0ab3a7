//! Steps without contact, seen together and one by one.

use super::*;
use crate::residual::largest_residual::LargestResidual;
use crate::step::QuietSteps;

/// The end (s), displacement, velocity and velocities in the balance of each step.
type Told = [f64; 5];

/// A body of 4 kg under a load that is straight between 3, −5 and 1 N at 0, 2 and 4 s.
fn scene() -> Scene {
    let load = Table::new(vec![0.0, 2.0, 4.0], vec![3.0, -5.0, 1.0]).expect("a table");
    Scene::oscillator(4.0, 0.0, 0.0).with_wall(Wall::upper("far", 64.0)).with_load(Load::table(load))
}

fn load(k: u64) -> f64 {
    let t = k as f64 * H;
    if t < 2.0 { 3.0 - 4.0 * t } else { 3.0 * t - 11.0 }
}

/// `count` steps of that body from 0 m and 2 m/s by the rule `balance`; `lie` changes the velocity
/// and the displacement at the end of a step, from which the next goes on.
fn free(balance: Balance, count: u64, lie: impl Fn(u64, &mut f64, &mut f64)) -> Vec<Told> {
    let (mut q, mut v) = (0.0, 2.0);
    let step = |k: u64| {
        let before = v;
        let theta = if let Balance::Theta(theta) = balance { theta } else { 0.0 };
        let mean = |a: f64, b: f64| (1.0 - theta) * a + theta * b;
        let mut after = before + H * mean(load(k), load(k + 1)) / 4.0;
        let mut to = 0.0;
        lie(k, &mut after, &mut to);
        to += q + H * if let Balance::Theta(_) = balance { mean(before, after) } else { after };
        (q, v) = (to, after);
        let shown = if let Balance::Theta(_) = balance { after } else { 0.5 * (before + after) };
        [(k + 1) as f64 * H, to, shown, before, after]
    };
    (0..count).map(step).collect()
}

/// Judges that saw the steps `told` from displacement `q` eleven at a time, and one by one.
fn both(scene: &Scene, contract: Contract, q: f64, told: &[Told]) -> [Judge; 2] {
    let mut judges = [(); 2].map(|()| judge(scene, contract, q, told[0][3]));
    assert!(judges[0].batches_quiet_steps());
    let mut quiet = QuietSteps::new(scene.walls.len());
    for (k, &[end, q, v, before, after]) in told.iter().enumerate() {
        quiet.begin(k as u64, k as f64 * H);
        quiet.add(end, (&[q], &[v]), (&[before], &[after]));
        if quiet.len() == 11 || k + 1 == told.len() {
            judges[0].observe_quiet(&quiet);
            (0..quiet.len()).for_each(|k| judges[1].observe(&quiet.step(k)));
            quiet.clear();
        }
    }
    judges
}

/// All that a judge knows of a run, except the residuals less their rounding, of which steps seen
/// together share the largest.
fn state(judge: &Judge) -> String {
    let sizes = [
        judge.balance.largest,
        judge.balance.force.value,
        judge.balance.scale,
        judge.balance.path.value,
        judge.noise.end,
    ];
    let rounding = [judge.noise.path(), judge.noise.force_over(1.0)];
    let (ends, run) =
        ((&judge.q, &judge.load, &judge.walls.depth), (&judge.sums, &judge.extent, judge.energy.report()));
    format!("{ends:?} {run:?} {sizes:?} {rounding:?}")
}

/// The residuals of balance and path less their rounding.
fn excess(judge: Judge) -> (LargestResidual, LargestResidual) {
    (judge.balance.force.excess, judge.balance.path.excess)
}

const RULES: [Balance; 3] = [Balance::Theta(0.5), Balance::Theta(1.0), Balance::Staggered(0.25)];

#[test]
fn steps_in_the_air_are_seen_together_as_one_by_one() {
    for balance in RULES {
        let told = free(balance, 31, |_, _, _| {});
        let [together, alone] = both(&scene(), contract(balance), 0.0, &told);
        assert_eq!(state(&together), state(&alone), "{balance:?}");
        // Sums by the trapezoid rule over the ends of the steps.
        let trapezoid = |x: &dyn Fn(u64) -> f64| (0..31).map(|k| 0.5 * H * (x(k) + x(k + 1))).sum::<f64>();
        let place = |k: u64| if k == 0 { 0.0 } else { told[k as usize - 1][1] };
        let sums = &together.sums;
        assert_eq!((sums.steps, sums.place[0], sums.load[0]), (31, trapezoid(&place), trapezoid(&load)));
        assert_eq!((sums.last[0], together.noise.end, together.q[0]), (told[30][4], 31.0 * H, told[30][1]));
        assert_eq!(together.balance.force.excess.value, 0.0);
        assert_eq!(together.findings(), []);
    }
}

#[test]
fn a_false_step_among_others_is_doubted_by_what_was_added() {
    for balance in RULES {
        for wrong in [1, 11, 17, 30] {
            let time = (wrong + 1) as f64 * H;
            // A quarter of a metre a second without a force: 4 kg · ¼ m/s in a step, over √m.
            let told = free(balance, 31, |k, v, _| *v += if k == wrong { 0.25 } else { 0.0 });
            let [together, alone] = both(&scene(), contract(balance), 0.0, &told);
            assert_eq!(state(&together), state(&alone), "{balance:?}, {wrong}");
            for (force, path) in [together, alone].map(excess) {
                near(force.value, 4.0 * 0.25 / H / 2.0);
                assert_eq!((force.time, path.value), (time, 0.0));
            }
            // A quarter of a metre without a velocity, times √m.
            let told = free(balance, 31, |k, _, q| *q += if k == wrong { 0.25 } else { 0.0 });
            let [together, alone] = both(&scene(), contract(balance), 0.0, &told);
            assert_eq!(state(&together), state(&alone), "{balance:?}, {wrong}");
            for (force, path) in [together, alone].map(excess) {
                near(path.value, 0.25 * 2.0);
                assert_eq!((path.time, force.value), (time, 0.0));
            }
        }
    }
}

#[test]
fn a_wall_that_was_passed_over_is_found_among_steps_in_the_air() {
    // A body of 1 kg, which −48 N turn in the second step: from ¾ m at 4 m/s to ⅞ m at −2 m/s.
    // Half a step ahead it would be at the wall, which must give it −¾ · 4 m/s at least.
    let scene = under(Wall::upper("stop", 1.0).with_restitution(0.75)).with_load(Load::constant(-48.0));
    let contract = rigid(None, Some(Reached::Ahead(0.5)));
    let step = |k: usize| {
        let (before, after) = (10.0 - 6.0 * k as f64, 4.0 - 6.0 * k as f64);
        let t = (k + 1) as f64 * H;
        [t, -0.125 + 10.0 * t - 24.0 * t * t, after, before, after]
    };
    let told: Vec<Told> = (0..30).map(step).collect();
    assert_eq!((told[0][1], told[1][1]), (0.75, 0.875));
    let [together, alone] = both(&scene, contract, -0.125, &told);
    assert_eq!(state(&together), state(&alone));
    for doubt in [together, alone].map(|judge| judge.walls.rebounds.outside.excess) {
        near(doubt.value, 0.75 * 4.0 - 2.0);
        assert_eq!((doubt.time, doubt.wall), (2.0 * H, Some(0)));
    }
}

#[test]
fn steps_are_seen_together_only_where_a_step_is_all_there_is_to_see() {
    let alpha = Balance::GeneralizedAlpha { alpha_m: 0.0, alpha_f: 0.5, beta: 0.25, gamma: 0.5 };
    let gains = |scene: &Scene, balance| judge(scene, contract(balance), 0.0, 2.0).batches_quiet_steps();
    for balance in RULES {
        assert!(gains(&scene(), balance));
        assert!(!gains(&scene().with_load(Load::impulse(1.0, 0.5)), balance));
        assert!(!gains(&two([[1.0; 2]; 3]), balance));
        assert!(!gains(&super::momentum::in_hole(scene()), balance));
    }
    assert!(!gains(&scene(), alpha) && !gains(&scene(), Balance::Exact));
}

#[test]
fn a_step_of_another_scene_is_ignored() {
    let one = free(Balance::Theta(0.5), 1, |_, _, _| {})[0];
    let claim = Claim::of(one[1], one[3], one[4], 1);
    let seen = |step: &Step<'_>| {
        let mut judge = judge(&scene(), contract(Balance::Theta(0.5)), 0.0, 2.0);
        judge.observe(step);
        judge.sums.steps
    };
    assert_eq!(seen(&claim.step()), 1);
    assert_eq!(seen(&Step { friction: &[0.0], ..claim.step() }), 0);
    assert_eq!(seen(&Step { normal: &[[0.0; 2]], ..claim.step() }), 0);
    assert_eq!(seen(&Claim { impulse: vec![0.0; 2], ..claim.clone() }.step()), 0);
    assert_eq!(seen(&Claim { q: vec![0.0; 2], ..claim }.step()), 0);
}
