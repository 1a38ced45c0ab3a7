//! The requested error is met, and the step found for it is close to the best one.
use signorini::study::accuracy::{Against, JudgedBy, Target, foresee, reach};
use signorini::study::change::Change;
use signorini::study::choice::choose;
use signorini::study::verdict::Verdict;
use signorini::{
    Error, Integrator, Load, Method, Options, PenaltyLaw, Run, Scene, Scheme, Table, TimeOptions, Wall, run,
};

const MOREAU: Scheme = Scheme::MoreauJean { theta: 0.5 };

/// The main scene: an oscillator of 1.6 Hz under a sine.
fn driven(amplitude: f64, frequency: f64, duration: f64) -> Scene {
    Scene::oscillator(1.0, 0.2, 100.0).with_load(Load::harmonic(amplitude, frequency, 0.0)).with_duration(duration)
}

fn upper(position: f64, e: f64) -> Wall {
    Wall::upper("upper", position).with_restitution(e)
}

fn lower(position: f64, e: f64) -> Wall {
    Wall::lower("lower", position).with_restitution(e)
}

fn spring(wall: Wall, stiffness: f64, damping: f64) -> Wall {
    wall.with_elasticity(stiffness, damping)
}

fn ball(e: f64, duration: f64) -> Scene {
    Scene::oscillator(1.0, 0.0, 0.0)
        .with_wall(lower(0.0, e))
        .with_load(Load::constant(-9.81))
        .with_initial(&[1.0], &[0.0])
        .with_duration(duration)
}

fn pulse() -> Load {
    Load::table(Table::new(vec![0.05, 0.15, 0.35, 0.4], vec![0.0, 4.0, -3.0, 0.0]).unwrap())
}

/// Scenes with walls, each with a name.
fn scenes() -> Vec<(String, Scene)> {
    let mut scenes = Vec::new();
    let mut add = |name: &str, scene: Scene| scenes.push((name.to_owned(), scene));
    for e in [0.0, 0.3, 0.5, 0.8, 0.9, 1.0] {
        let duration = if e == 1.0 { 1.0 } else { 1.5 };
        add(
            &format!("two walls, e = {e}"),
            driven(3.0, 5.0, duration).with_wall(upper(5e-3, e)).with_wall(lower(-5e-3, e)),
        );
    }
    for e in [0.0, 0.5, 0.8, 1.0] {
        add(&format!("one wall, e = {e}"), driven(3.0, 5.0, 1.0).with_wall(upper(3e-3, e)));
    }
    add("unequal gaps", driven(3.0, 5.0, 1.0).with_wall(upper(4e-3, 0.8)).with_wall(lower(-8e-3, 0.8)));
    add("unequal restitution", driven(3.0, 5.0, 1.0).with_wall(upper(4e-3, 0.9)).with_wall(lower(-8e-3, 0.4)));
    add("wall at the rest position", driven(3.0, 5.0, 1.0).with_wall(upper(0.0, 0.5)));
    add("slow load", driven(3.0, 2.0, 1.5).with_wall(upper(5e-3, 0.8)).with_wall(lower(-5e-3, 0.8)));
    add("fast load", driven(6.0, 8.0, 1.0).with_wall(upper(5e-3, 0.8)).with_wall(lower(-5e-3, 0.8)));
    add("strong load", driven(10.0, 5.0, 1.0).with_wall(upper(5e-3, 0.8)).with_wall(lower(-5e-3, 0.8)));
    for e in [0.8, 1.0] {
        let blown = Scene::oscillator(1.0, 0.2, 100.0).with_load(Load::impulse(0.1, 0.0)).with_duration(1.5);
        add(&format!("a blow, e = {e}"), blown.with_wall(upper(5e-3, e)).with_wall(lower(-5e-3, e)));
    }
    let late = Scene::oscillator(1.0, 0.2, 100.0).with_load(Load::impulse(0.1, 0.2371)).with_duration(1.5);
    add("a late blow", late.with_wall(upper(5e-3, 0.7)));
    let tabulated = Scene::oscillator(1.0, 0.2, 100.0).with_load(pulse()).with_duration(1.5);
    add("a tabulated pulse", tabulated.clone().with_wall(upper(5e-3, 0.6)).with_wall(lower(-5e-3, 0.6)));
    add("a tabulated pulse on a spring", tabulated.with_wall(spring(Wall::upper("upper", 5e-3), 1e3, 0.0)));
    for (stiffness, damping) in [(100.0, 0.0), (1e3, 0.0), (1e4, 0.0), (1e4, 1.0), (1e4, 10.0), (1e3, 100.0)] {
        let name = format!("a spring, {stiffness} N/m, {damping} N s/m");
        add(&name, driven(3.0, 5.0, 1.0).with_wall(spring(Wall::upper("upper", 3e-3), stiffness, damping)));
    }
    let between = driven(3.0, 5.0, 1.0).with_wall(spring(Wall::upper("upper", 3e-3), 1e4, 2.0));
    add("two springs", between.clone().with_wall(spring(Wall::lower("lower", -3e-3), 1e3, 0.0)));
    add("a spring and a wall, e = 1", between.clone().with_wall(lower(-5e-3, 1.0)));
    add("a spring and a wall, e = 0.5", between.with_wall(lower(-5e-3, 0.5)));
    for (e, duration) in [(0.0, 1.0), (0.5, 2.0), (0.8, 2.5), (1.0, 3.0)] {
        add(&format!("a ball, e = {e}"), ball(e, duration));
    }
    for e in [0.0, 0.3, 0.7] {
        let pressed = driven(8.0, 3.0, 1.5).with_load(Load::constant(4.0));
        add(&format!("pressed and released, e = {e}"), pressed.with_wall(upper(5e-3, e)));
    }
    let swinging = Scene::oscillator(2.0, 0.5, 300.0).with_initial(&[8e-3], &[-0.05]).with_duration(1.5);
    add("free vibration against a wall", swinging.with_wall(lower(-4e-3, 0.7)));
    scenes
}

/// Rows are chosen by the refinement; the step is not used.
fn time() -> TimeOptions {
    TimeOptions::with_step(1e-3)
}

/// Largest error of a run against the exact motion at its own rows, in the sense of a target.
fn true_error(scene: &Scene, found: &Run) -> (f64, String) {
    let sample = found.grid.end / found.grid.rows as f64;
    let time = TimeOptions { sample: Some(sample), ..TimeOptions::with_step(sample) };
    let exact = run(scene, &Scheme::Event, &Options::new(time)).unwrap();
    let change = Change::of_runs(scene, found, &exact, scene.duration);
    change.worst()
}

/// As [`true_error`], for the displacement and the impulses alone, computed here from the
/// definition.
fn displacement_and_impulse(scene: &Scene, found: &Run) -> f64 {
    let sample = found.grid.end / found.grid.rows as f64;
    let time = TimeOptions { sample: Some(sample), ..TimeOptions::with_step(sample) };
    let exact = run(scene, &Scheme::Event, &Options::new(time)).unwrap();
    // Shares of the gap; where the only wall leaves none, of the largest displacement.
    let snug = scene.walls.iter().all(|wall| wall.position() == scene.initial.q[0]);
    let largest = exact.trajectory.displacement().iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    let length = if snug { largest } else { scene.gap_scale() };
    let pairs = found.trajectory.displacement().iter().zip(exact.trajectory.displacement());
    let mut error = pairs.map(|(x, y)| (x - y).abs() / length).fold(0.0, f64::max);
    let speed = exact.trajectory.velocity().iter().fold(0.0_f64, |a, v| a.max(v.abs()));
    for wall in &scene.walls {
        let [p, q] = [found, &exact].map(|r| r.trajectory.impulse(&wall.name).unwrap());
        // Every scene here has a mass of 1 or 2 kg.
        error = error.max((p - q).abs() / q.abs().max(2.0 * speed));
    }
    error
}

fn at_step(scene: &Scene, scheme: &Scheme, step: f64, sample: f64) -> Run {
    let time = TimeOptions { sample: Some(sample), ..TimeOptions::with_step(step) };
    run(scene, scheme, &Options::new(time)).unwrap()
}

fn target(scheme: Scheme, against: Against, tolerance: f64) -> Target {
    Target { method: Some(Method::new(scheme)), against, most_steps: 1 << 20, ..Target::new(tolerance, time()) }
}

/// The fewest steps that meet the tolerance in hindsight, by half-octaves from the first step tried
/// to the one found: the one from which on every finer one meets it, and the coarsest that meets it
/// at all, perhaps by luck.
fn best_steps(scene: &Scene, scheme: &Scheme, tolerance: f64, found: &Run, levels: usize) -> (u64, u64) {
    let rows = found.grid.rows;
    let sample = found.grid.end / rows as f64;
    let first = (found.grid.steps / rows) >> (levels - 1);
    let (mut best, mut lucky, mut keeps) = (found.grid.steps, found.grid.steps, true);
    for half in (0..2 * (levels - 1)).rev() {
        let per_row = (first as f64 * 2f64.powf(half as f64 / 2.0)).round() as u64;
        let kept = true_error(scene, &at_step(scene, scheme, sample / per_row as f64, sample)).0 <= tolerance;
        keeps &= kept;
        if kept {
            lucky = per_row * rows;
            best = if keeps { lucky } else { best };
        }
    }
    (best, lucky)
}

fn quantiles(values: &mut [f64]) -> String {
    values.sort_by(f64::total_cmp);
    let at = |share: f64| values[((values.len() - 1) as f64 * share) as usize];
    format!("median {:.1}, 9 of 10 up to {:.1}, largest {:.1}", at(0.5), at(0.9), at(1.0))
}

#[test]
fn what_a_scene_needs_is_the_exact_motion_and_it_keeps_any_tolerance() {
    let linear = [driven(3.0, 5.0, 2.0), Scene::oscillator(1.0, 0.0, 0.0).with_load(pulse())];
    let all = scenes().into_iter().map(|(_, scene)| scene).chain(linear);
    for scene in all {
        for tolerance in [1e-2, 1e-6, 1e-8] {
            let outcome = reach(&scene, &Target::new(tolerance, time()), &mut |_| {}).unwrap();
            assert_eq!(outcome.method.scheme, Scheme::Event, "{}", outcome.reason);
            assert_eq!(outcome.shortfall, None, "{}", outcome.reason);
            assert!(outcome.accuracy.reached <= tolerance);
            assert_eq!(outcome.run.trajectory.time().last(), Some(&scene.duration));
        }
    }
}

/// Against the exact motion the error is the true one: it is met wherever the result does not
/// report that it fell short. The work of all runs together is at most 4 times that of the best
/// step: the levels before the last sum up to less than the last, and the last is less than twice
/// as fine as needed.
#[test]
fn a_step_found_against_the_exact_motion_keeps_the_error_for_at_most_four_times_the_work() {
    let mut kept = 0;
    let (mut work, mut with_luck) = (Vec::new(), Vec::new());
    for (scheme, tolerance) in [(MOREAU, 3e-2), (MOREAU, 5e-3), (Scheme::PaoliSchatzman, 3e-2)] {
        for (name, scene) in scenes() {
            let outcome = reach(&scene, &target(scheme, Against::Exact, tolerance), &mut |_| {}).unwrap();
            let accuracy = &outcome.accuracy;
            if let Some(error) = &outcome.shortfall {
                assert!(matches!(error, Error::Inaccurate { .. }), "{name}: {error}");
                continue;
            }
            kept += 1;
            assert_eq!(accuracy.judged_by, JudgedBy::ExactMotion);
            let (error, quantity) = true_error(&scene, &outcome.run);
            assert!(error <= tolerance, "{scheme}, {name}: {error:e} of the {quantity}");
            assert!(displacement_and_impulse(&scene, &outcome.run) <= tolerance, "{scheme}, {name}");
            let (best, lucky) = best_steps(&scene, &scheme, tolerance, &outcome.run, accuracy.levels.len());
            assert!(accuracy.total_steps <= 4 * best, "{scheme}, {name}: {} against {best}", accuracy.total_steps);
            work.push(accuracy.total_steps as f64 / best as f64);
            with_luck.push(accuracy.total_steps as f64 / lucky as f64);
        }
    }
    println!("{kept} kept; work over the best step's: {}", quantiles(&mut work));
    println!("over that of a step that keeps it by luck: {}", quantiles(&mut with_luck));
    assert!(kept >= 90, "{kept} of {}", 3 * scenes().len());
}

/// With halving alone the result is on the safe side: in these scenes it never missed the error.
/// That has its price: the rule demands two halvings in a row whose change is below a quarter,
/// which a scheme of order 1 reaches at an eighth of the step needed, and the slowest of all
/// quantities decides.
#[test]
fn a_step_found_by_halving_alone_keeps_the_error_too() {
    let mut kept = 0;
    let (mut finest, mut sufficient) = (Vec::new(), Vec::new());
    for tolerance in [3e-2, 5e-3] {
        for (name, scene) in scenes() {
            // Halving does not show moreau-jean's error at a dashpot.
            let dashpot = scene.walls.iter().any(|wall| wall.law.spring().is_some_and(|spring| spring.damping > 0.0));
            let scheme = if dashpot { Scheme::Located } else { MOREAU };
            let first = reach(&scene, &target(MOREAU, Against::Refinements, tolerance), &mut |_| {});
            assert_eq!(first.is_err(), dashpot, "{name}");
            let located = || reach(&scene, &target(scheme, Against::Refinements, tolerance), &mut |_| {});
            let outcome = first.or_else(|_| located()).unwrap();
            let accuracy = &outcome.accuracy;
            if outcome.shortfall.is_some() {
                continue;
            }
            kept += 1;
            assert_eq!(accuracy.judged_by, JudgedBy::Halving);
            let (error, quantity) = true_error(&scene, &outcome.run);
            assert!(error <= tolerance, "{name}: {error:e} of the {quantity}");
            let sample = outcome.run.grid.end / outcome.run.grid.rows as f64;
            let found = at_step(&scene, &scheme, accuracy.sufficient_step_s.unwrap(), sample);
            let (error, quantity) = true_error(&scene, &found);
            assert!(error <= tolerance, "{name}: {error:e} of the {quantity} at the sufficient step");
            let best = best_steps(&scene, &scheme, tolerance, &outcome.run, accuracy.levels.len()).0 as f64;
            finest.push(outcome.run.grid.steps as f64 / best);
            sufficient.push(found.grid.steps as f64 / best);
        }
    }
    println!("{kept} kept; steps over the best: the result's {}", quantiles(&mut finest));
    println!("of the sufficient step: {}", quantiles(&mut sufficient));
    assert!(kept >= 60, "{kept} of {}", 2 * scenes().len());
    sufficient.sort_by(f64::total_cmp);
    assert!(sufficient[sufficient.len() / 2] <= 4.0, "the sufficient step is typically within 4 of the best");
}

/// A dashpot pushes from the step on in which a contact begins, so that the error of moreau-jean is
/// of order 1, more or less by where its steps meet the wall: halving the step changes nothing
/// where it leaves the first instant within the wall. By such changes 3 of 40 of these starts
/// passed with errors of up to 1.6 times the tolerance. located is the default there, and keeps it.
#[test]
fn halving_is_refused_at_walls_with_a_dashpot_where_it_does_not_show_the_error() {
    for start in [0, 1, 15, 27] {
        let scene = Scene::oscillator(1.0, 0.0, 1000.0)
            .with_wall(spring(upper(1e-3, 0.0), 2e5, 50.0))
            .with_initial(&[0.0], &[0.31 + 0.0213 * f64::from(start)])
            .with_duration(0.2);
        let error = reach(&scene, &target(MOREAU, Against::Refinements, 6e-3), &mut |_| {}).unwrap_err();
        assert!(error.is_request() && error.to_string().contains("expected located or no dashpot"), "{error}");
        let chosen = choose(&scene).method.scheme;
        assert_eq!(chosen, Scheme::Located);
        let tries = [target(chosen, Against::Refinements, 6e-3), target(MOREAU, Against::Exact, 6e-3)];
        for outcome in tries.map(|target| reach(&scene, &target, &mut |_| {}).unwrap()) {
            assert!(outcome.shortfall.is_none(), "{start}");
            let error = true_error(&scene, &outcome.run).0;
            assert!(error <= 6e-3, "start {start}: {error:e}");
        }
    }
}

#[test]
fn a_tolerance_out_of_reach_is_named_with_what_was_reached_and_until_when() {
    let scene = driven(3.0, 5.0, 1.0).with_wall(upper(5e-3, 0.8)).with_wall(lower(-5e-3, 0.8));
    let few = Target { most_steps: 2000, ..target(MOREAU, Against::Exact, 1e-4) };
    let outcome = reach(&scene, &few, &mut |_| {}).unwrap();
    let Some(Error::Inaccurate { tolerance, reached, until, steps, .. }) = outcome.shortfall else { panic!("kept") };
    assert!(tolerance == 1e-4 && reached > 1e-4 && reached < 1.0 && steps <= 2000);
    assert!(until > 0.0 && until < 1.0, "{until}");
    assert_eq!(outcome.run.trajectory.time().last(), Some(&1.0));
    // This scheme's limit is another restitution: no step helps, and refinement must not hide it.
    let other = target(Scheme::ImplicitEuler, Against::Exact, 1e-2);
    let outcome = reach(&scene, &other, &mut |_| {}).unwrap();
    assert!(matches!(outcome.shortfall, Some(Error::Inaccurate { .. })));
    let none = Target { most_steps: 1, ..few };
    assert!(matches!(reach(&scene, &none, &mut |_| {}), Err(Error::Inaccurate { .. })));
    for tolerance in [0.0, -1.0, 1.0, f64::NAN, f64::INFINITY] {
        let error = reach(&scene, &Target { tolerance, ..few }, &mut |_| {}).unwrap_err();
        assert!(error.is_request(), "{tolerance}");
    }
}

#[test]
fn a_body_that_crosses_its_gap_millions_of_times_is_refused_in_seconds() {
    let tight = |half: f64| {
        let body = Scene::oscillator(1.0, 0.0, 0.0).with_initial(&[0.0], &[100.0]);
        body.with_wall(upper(half, 1.0)).with_wall(lower(-half, 1.0))
    };
    for method in [None, Some(Method::new(Scheme::Event)), Some(Method::new(MOREAU))] {
        let asked = Target { method, ..Target::new(1e-2, time()) };
        let error = reach(&tight(1e-7), &asked, &mut |_| {}).unwrap_err();
        assert!(matches!(error, Error::Inaccurate { .. } | Error::TooManyEvents { .. }), "{error}");
    }
    // Steps in which the body crosses the whole gap must not pass for convergence.
    let few = Target { most_steps: 1 << 14, ..target(MOREAU, Against::Refinements, 1e-2) };
    let slow = tight(1e-3).with_initial(&[0.0], &[0.0]).with_load(Load::impulse(100.0, 1e-4));
    let outcome = reach(&slow, &few, &mut |_| {}).unwrap();
    assert!(matches!(outcome.shortfall, Some(Error::Inaccurate { .. })));
}

#[test]
fn a_horizon_shorter_than_the_run_is_named_and_the_run_is_kept() {
    let scene = driven(3.0, 5.0, 10.0).with_wall(upper(5e-3, 1.0)).with_wall(lower(-5e-3, 1.0));
    let mut before = 10.0;
    // The growth is 4e11 in 10 s: the smaller the error, the sooner rounding has grown to it.
    for tolerance in [1e-3, 1e-6, 1e-9] {
        let outcome = reach(&scene, &Target::new(tolerance, time()), &mut |_| {}).unwrap();
        let Some(Error::Unpredictable { horizon, end, reached, .. }) = outcome.shortfall else { panic!("predicted") };
        assert!(horizon < before && horizon > 1.0 && end == 10.0 && reached <= tolerance, "{tolerance}: {horizon}");
        assert_eq!(outcome.run.trajectory.time().last(), Some(&10.0));
        before = horizon;
        // Within the horizon the error is kept.
        let within = scene.clone().with_duration(0.99 * horizon);
        assert_eq!(reach(&within, &Target::new(tolerance, time()), &mut |_| {}).unwrap().shortfall, None);
    }
}

#[test]
fn a_penalty_is_held_against_its_own_springs() {
    let scene = driven(3.0, 5.0, 1.0).with_wall(upper(5e-3, 1.0)).with_wall(lower(-5e-3, 1.0));
    for (law, judged_by) in [
        (PenaltyLaw::Linear { stiffness: 1e5, damping: 0.0 }, JudgedBy::ExactMotion),
        (PenaltyLaw::Quartic { epsilon: 1e-9 }, JudgedBy::Halving),
    ] {
        let scheme = Scheme::Penalty { law, integrator: Integrator::default() };
        let outcome = reach(&scene, &target(scheme, Against::Exact, 1e-2), &mut |_| {}).unwrap();
        assert_eq!(outcome.shortfall, None, "{scheme}");
        assert_eq!(outcome.accuracy.judged_by, judged_by);
        assert!(outcome.run.notes.iter().any(|n| n.contains("which no step changes")), "{:?}", outcome.run.notes);
    }
}

/// Runs the tool; gives exit code, stderr and the summary.
fn tool(args: &[&str]) -> (Option<i32>, String, serde_json::Value) {
    let dir = tempfile::tempdir().unwrap();
    let output = std::process::Command::new(env!("CARGO_BIN_EXE_signorini"))
        .args(args)
        .args(["--out", "here"])
        .current_dir(dir.path())
        .output()
        .unwrap();
    let summary = std::fs::read_to_string(dir.path().join("here/summary.json")).unwrap_or("null".into());
    (output.status.code(), String::from_utf8(output.stderr).unwrap(), serde_json::from_str(&summary).unwrap())
}

#[test]
fn the_tool_ends_with_1_where_an_error_is_not_kept_and_its_results_stay() {
    let (code, said, summary) = tool(&["run", "elastic-wall", "--end", "1", "--accuracy", "1e-6"]);
    assert_eq!(code, Some(0), "{said}");
    assert!(said.contains("accuracy: asked for 1e-6"), "{said}");
    assert!(summary["accuracy"]["reached"].as_f64().unwrap() <= 1e-6);
    assert!(summary["refinement"].is_null());
    let (code, said, summary) = tool(&["run", "rigid-walls-sine", "--accuracy", "1e-3", "--of", "motion"]);
    assert_eq!(code, Some(1), "{said}");
    assert!(said.contains("error: an error of 1e-3 is kept until t = ") && said.contains("kept in spite"), "{said}");
    assert!(summary["accuracy"]["until_s"].as_f64().unwrap() < 10.0);
    // The exact motion along a hole without friction differs from itself by roundings only: its
    // contact time too, and the speed of rounding at which it begins on the hole.
    let whirl = ["run", "whirl-in-a-hole", "--set", "support.hole.friction=0", "--accuracy", "1e-4"];
    let (code, said, summary) = tool(&whirl);
    assert_eq!(code, Some(0), "{said}");
    assert!(summary["accuracy"]["reached"].as_f64().unwrap() < 1e-9, "{said}");
    let steps = ["run", "rigid-walls-sine", "--end", "0.5", "--accuracy", "1e-7", "--scheme", "implicit-euler"];
    let (code, said, summary) = tool(&steps);
    assert_eq!(code, Some(1), "{said}");
    assert!(said.contains("was not reached") && said.contains("until t = "), "{said}");
    assert!(summary["accuracy"]["levels"].as_array().unwrap().len() > 5);
    let (code, said, _) = tool(&["run", "rigid-walls-sine", "--accuracy", "1e-3", "--step", "1e-4"]);
    assert_eq!(code, Some(2), "{said}");
    let (code, said, _) = tool(&["run", "rigid-walls-sine", "--accuracy", "-1"]);
    assert_eq!(code, Some(2), "{said}");
}

#[test]
fn runs_and_comparisons_end_with_a_verdict_unless_told_not_to() {
    for (args, text) in [
        (
            &["run", "rigid-walls-sine", "--end", "1"][..],
            "refinement: with half the step, 5.000e-5 s, the displacement changes by",
        ),
        (&["run", "elastic-wall", "--end", "1", "--scheme", "event"], "refinement: the exact scheme has no step"),
        (&["run", "linear-sine", "--end", "1"], "refinement: with half the step"),
        (
            &["compare", "rigid-walls-sine", "--end", "0.5", "--verbose"],
            "refinement: with half the step: located: the displacement changes by",
        ),
    ] {
        let (code, said, summary) = tool(args);
        assert_eq!(code, Some(0), "{said}");
        let line = said.lines().find(|line| line.starts_with("refinement: ")).unwrap();
        assert!(line.starts_with(text), "{line}");
        let of_run = args[0] == "run";
        assert!(!of_run || summary["refinement"]["displacement"].as_f64().unwrap() < 0.1, "{summary}");
        let silent = [args, &["--no-verdict"]].concat();
        let (code, said, summary) = tool(&silent);
        assert_eq!(code, Some(0), "{said}");
        assert!(!said.contains("refinement:") && summary["refinement"].is_null(), "{said}");
    }
}

#[test]
fn a_verdict_tells_the_change_that_half_the_step_makes() {
    let scene = driven(3.0, 5.0, 1.0).with_wall(upper(5e-3, 0.8)).with_wall(lower(-5e-3, 0.8));
    let method = Method::new(MOREAU);
    let [coarse, fine] = [1e-3, 5e-4].map(|h| at_step(&scene, &MOREAU, h, 1e-3));
    let verdict = Verdict::of(&scene, &method, &coarse, &TimeOptions::with_step(1e-3), &mut |_| {}).unwrap();
    let pairs = coarse.trajectory.displacement().iter().zip(fine.trajectory.displacement());
    let change = pairs.map(|(x, y)| (x - y).abs() / 5e-3).fold(0.0, f64::max);
    assert_eq!(verdict.displacement, Some(change));
    assert_eq!(verdict.walls[0].impulse_n_s[1], fine.trajectory.impulse("upper").unwrap());
    assert_eq!(verdict.walls[0].contacts, [coarse.statistics.walls[0].contacts, fine.statistics.walls[0].contacts]);
    assert_eq!(verdict.horizon_s, 1.0);
}

#[test]
fn a_wall_that_is_hardly_touched_does_not_decide() {
    // Driven against its upper wall all the time, and against the lower one now and then.
    let scene =
        driven(3.0, 5.0, 1.5).with_wall(upper(1e-3, 0.5)).with_wall(lower(-6.5e-3, 0.5)).with_load(Load::constant(2.0));
    let coarse = at_step(&scene, &MOREAU, 1e-3, 1e-3);
    let exact = run(&scene, &Scheme::Event, &Options::new(time())).unwrap();
    let change = Change::of_runs(&scene, &coarse, &exact, 1.5);
    let impulses = |name: &str| [&coarse, &exact].map(|r| r.trajectory.impulse(name).unwrap());
    let largest = impulses("upper")[1].abs();
    assert!(impulses("lower")[1].abs() < 0.8 * largest, "{:?}", impulses("lower"));
    for (wall, name) in change.walls.iter().zip(["upper", "lower"]) {
        let [a, b] = impulses(name);
        // The largest impulse of a wall, which is far above that of one impact.
        assert!((wall.impulse - (a - b).abs() / largest).abs() < 1e-12, "{wall:?}: {a} {b}");
    }
}

#[test]
fn the_number_of_impacts_that_accumulate_is_not_asked_for() {
    for (e, duration) in [(0.5, 2.0), (0.8, 6.0)] {
        // Rests after √(2h/g)(1 + e)/(1 − e): 1.35 and 4.06 s.
        let scene = ball(e, duration);
        let exact = run(&scene, &Scheme::Event, &Options::new(time())).unwrap();
        for h in [1e-2, 1e-3, 1e-4] {
            let found = at_step(&scene, &MOREAU, h, 1e-2);
            let wall = &Change::of_runs(&scene, &found, &exact, duration).walls[0];
            assert_eq!(wall.contacts, None, "e = {e}, h = {h}");
            // The quantities requested here have a limit: the impulse is that of the weight,
            // whatever the impacts.
            assert!(wall.impulse < 20.0 * h && wall.contact_time < 60.0 * h, "e = {e}, h = {h}: {wall:?}");
        }
    }
    let separate = driven(3.0, 5.0, 1.0).with_wall(upper(5e-3, 0.8));
    let exact = run(&separate, &Scheme::Event, &Options::new(time())).unwrap();
    let found = at_step(&separate, &MOREAU, 1e-4, 1e-3);
    assert!(Change::of_runs(&separate, &found, &exact, 1.0).walls[0].contacts.is_some());
}

#[test]
fn a_search_that_leads_nowhere_ends_early_and_the_stretch_is_foreseen() {
    // Chaotic at e = 1: every halving keeps the displacement for a little longer, and 2²⁴ steps do
    // not reach the end.
    let scene = driven(3.0, 5.0, 10.0).with_wall(upper(5e-3, 1.0)).with_wall(lower(-5e-3, 1.0));
    let patient = Target { most_steps: 1 << 24, ..target(MOREAU, Against::Exact, 1e-3) };
    let outcome = reach(&scene, &patient, &mut |_| {}).unwrap();
    let Some(Error::Inaccurate { until, .. }) = outcome.shortfall else { panic!("{:?}", outcome.accuracy) };
    assert!(until > 0.05 && until < 10.0, "{until}");
    // A hundredth of what was allowed.
    assert!(outcome.accuracy.total_steps < 1 << 20, "{}", outcome.accuracy.total_steps);
    // Rounding alone limits how long any step stays accurate; in the settled motion nothing does.
    let until = foresee(&scene, &patient).unwrap().unwrap();
    assert!(until > 1.0 && until < 10.0, "{until}");
    let settled = driven(3.0, 5.0, 10.0).with_wall(upper(5e-3, 0.8)).with_wall(lower(-5e-3, 0.8));
    assert_eq!(foresee(&settled, &patient).unwrap(), None);
}

#[test]
fn statistics_that_scatter_more_than_the_error_asked_for_are_named() {
    // Chaotic motion between its walls: one tenth of the window differs from the next.
    let scene = driven(3.0, 5.0, 4.0).with_wall(upper(5e-3, 0.95)).with_wall(lower(-5e-3, 0.95));
    let outcome = reach(&scene, &Target::new(1e-3, time()), &mut |_| {}).unwrap();
    let of_wall = |wall: &signorini::WallStatistics| wall.force.and_then(|f| Some(f.mean_half_width_95_n? / f.mean_n));
    let widest = outcome.run.statistics.walls.iter().filter_map(of_wall).fold(0.0, f64::max);
    let note = |outcome: &signorini::study::accuracy::Outcome| {
        outcome.run.notes.iter().find(|note| note.contains("95 % interval by batches")).cloned()
    };
    assert!(widest > 1e-3 && widest < 0.9, "{widest}");
    let found = note(&outcome).unwrap_or_else(|| panic!("{:?}", outcome.run.notes));
    assert!(found.contains(&format!("±{:.1} %", 100.0 * widest)), "{found}: {widest}");
    // A confidence interval within the requested error gets no note.
    let coarse = reach(&scene, &Target::new(0.95, time()), &mut |_| {}).unwrap();
    assert_eq!(note(&coarse), None);
}

/// A body of 1 m/s that strikes a spring with 0.0447 m/s: an error of a hundredth is one of the
/// impulse that the wall gets and of its force, and not of what an impact at 1 m/s would give it.
#[test]
fn a_wall_that_is_touched_softly_counts_by_what_it_gets() {
    let scene = Scene::oscillator(1.0, 0.0, 100.0)
        .with_wall(spring(upper(0.0999, 0.0), 1e4, 0.0))
        .with_initial(&[0.0], &[1.0])
        .with_duration(0.3);
    for scheme in [Scheme::Located, MOREAU] {
        let outcome = reach(&scene, &target(scheme, Against::Refinements, 1e-2), &mut |_| {}).unwrap();
        assert!(outcome.shortfall.is_none(), "{scheme}");
        let exact = run(&scene, &Scheme::Event, &Options::new(TimeOptions::with_step(1e-3))).unwrap();
        let [found, wanted] = [&outcome.run, &exact].map(|run| {
            let peak = run
                .trajectory
                .contacts()
                .iter()
                .filter_map(|contact| contact.peak_force)
                .fold(0.0, |most: f64, force| most.max(force.abs()));
            [run.trajectory.impulse("upper").unwrap(), peak]
        });
        for (found, wanted) in found.iter().zip(wanted) {
            assert!((found / wanted - 1.0).abs() < 1e-2, "{scheme}: {found} {wanted}");
        }
    }
}

#[test]
fn a_wall_that_one_of_two_runs_touches_changes_by_a_finite_share() {
    let scene = Scene::oscillator(1.0, 0.0, 100.0).with_wall(upper(5e-3, 0.5)).with_wall(lower(-5e-3, 0.5));
    let scene = scene.with_duration(0.2);
    let one = at_step(&scene.clone().with_initial(&[0.0], &[1.0]), &MOREAU, 1e-3, 1e-3);
    let none = at_step(&scene.clone().with_initial(&[0.0], &[1e-3]), &MOREAU, 1e-3, 1e-3);
    assert!(one.trajectory.impulse("upper").unwrap() < 0.0 && none.trajectory.impulse("upper").unwrap() == 0.0);
    for [run, against] in [[&one, &none], [&none, &one]] {
        let (worst, quantity) = Change::of_runs(&scene, run, against, 0.2).worst();
        assert!(worst.is_finite() && worst > 0.1, "{quantity}: {worst}");
    }
}

#[test]
fn where_the_numbers_of_a_rattling_tube_cannot_be_kept_is_known_from_its_first_stretch() {
    // Exact runs from starts 1e-10 apart part within half a second of ten: a sixteenth of the run
    // tells.
    let case = signorini::case::Case::embedded("tube-loose-supports").unwrap();
    let target = Target::new(1e-2, case.time);
    let until = foresee(&case.scene, &target).unwrap().expect("a horizon");
    assert!((0.2..0.8).contains(&until), "{until}");
    // The same scene over the time for which it can be predicted.
    let whole = Target { time: TimeOptions { statistics_from: 0.0, ..case.time }, ..target };
    assert_eq!(foresee(&case.scene.clone().with_duration(0.1), &whole).unwrap(), None);
}

/// A fast impact before the window of the statistics is no measure of the light touches in it.
#[test]
fn impulses_in_the_window_are_judged_by_impacts_in_the_window() {
    let scene = Scene::oscillator(1.0, 4.0, 400.0)
        .with_wall(Wall::lower("stop", -5e-3).with_elasticity(4e4, 0.0))
        .with_load(Load::harmonic(1.2395, 2.0, 0.0))
        .with_initial(&[0.0], &[-0.6])
        .with_duration(6.0);
    let time = TimeOptions { statistics_from: 3.0, sample: Some(0.01), ..TimeOptions::with_step(1e-3) };
    let [coarse, exact] =
        [Scheme::Located, Scheme::Event].map(|scheme| run(&scene, &scheme, &Options::new(time)).expect("a run"));
    let [a, b] = [&coarse, &exact].map(|run| run.statistics.walls[0].force.expect("a flat wall").impulse_n_s);
    let change = Change::of_runs(&scene, &coarse, &exact, 6.0).walls[0].impulse;
    // In the window the body meets the wall with less than 0.02 m/s, and the impulses sum up to
    // more than that of such an impact of 1 kg.
    assert!(b > 0.1 && (change / ((a - b).abs() / b) - 1.0).abs() < 1e-9, "{change} for {a} and {b}");
}
