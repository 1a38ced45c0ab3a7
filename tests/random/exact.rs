//! `located` approaches the exact motion of random scenes: what a scheme and its judge both have
//! wrong, such as a load that acts too long, no residual shows.
//!
//! `SIGNORINI_CASES` and `SIGNORINI_SEED` as for the other test.

use crate::draws;
use crate::random_scenes::{Units, random_scene};
use signorini::{Options, Run, Scene, Scheme, run};

/// Steps of the scene's own length that are compared: errors have little time to grow.
const STEPS: f64 = 15.0;

fn made(scene: &Scene, scheme: Scheme, step: f64) -> Option<Run> {
    run(scene, &scheme, &Options::with_step(step)).ok().filter(|run| run.findings.is_empty())
}

/// How far `located` is from the exact motion of `scene` at its end in steps of `step` over these
/// numbers, as shares of the largest displacement or gap; `None` where one of them has no motion.
fn errors<const N: usize>(scene: &Scene, step: f64, parts: [f64; N]) -> Option<[f64; N]> {
    let exact = made(scene, Scheme::Event, step)?.state.q;
    let size = exact.iter().chain(&scene.initial.q).fold(scene.gap_scale(), |size, x| size.max(x.abs()));
    let mut errors = [0.0; N];
    for (error, parts) in errors.iter_mut().zip(parts) {
        let found = made(scene, Scheme::Located, step / parts)?.state.q;
        *error = found.iter().zip(&exact).map(|(a, b)| (a - b).abs() / size).fold(0.0, f64::max);
    }
    Some(errors)
}

#[test]
fn located_approaches_the_exact_motion() {
    let (first, cases) = (draws::seed(31_000_000), draws::cases(100_u64));
    let (mut compared, mut apart) = (0_u64, 0_u64);
    for seed in first..first + cases {
        let mut drawn = random_scene(seed, Units::Ordinary);
        drawn.scene.duration = drawn.step * (drawn.scene.duration / drawn.step).round().min(STEPS);
        let Some([coarse, fine]) = errors(&drawn.scene, drawn.step, [8.0, 64.0]) else { continue };
        compared += 1;
        // Steps of an eighth leave a 64th of the error of order 2; a fourth is far from that.
        if fine < 1e-5 || fine < coarse / 4.0 {
            continue;
        }
        let finest = errors(&drawn.scene, drawn.step, [512.0]).map_or(f64::INFINITY, |[finest]| finest);
        if finest > 1e-4 && finest > fine / 8.0 {
            apart += 1;
            println!("seed {seed}, step {:e}: {coarse:.1e}, {fine:.1e}, {finest:.1e}", drawn.step);
        }
    }
    println!("{compared} of {cases} scenes compared, {apart} apart");
    // Where impacts accumulate between several walls, where a spring or dashpot of a wall is not
    // resolved by any of these steps and where an error grows a thousandfold in these few steps,
    // the motions part: 67 of 2062 were found.
    assert!(compared * 3 > cases && 20 * apart < compared, "{apart} of {compared} apart");
}
