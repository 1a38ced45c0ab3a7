//! `signorini sweep`: rows that equal runs, failures as rows, folders that are continued, shards
//! that are merged.
use crate::command::{command, said};
use signorini::case::{Case, CaseFile};
use signorini::sweep::{Axis, Follow, Kernel, Measure, Plan, Sample, Samples, Scope, Shard, Status, Sweep, Window};
use signorini::{Load, Options, Scheme, Stepper, run};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Child, Command};
use std::time::{Duration, Instant};

fn source() -> Sweep {
    Sweep::new(CaseFile::embedded("rigid-walls-sine").unwrap())
}

fn frequency(from: f64, to: f64, points: u64) -> Axis {
    Axis::linear("load.1.harmonic.frequency", from, to, points).unwrap().named("frequency")
}

fn every_wall_measure() -> Vec<Measure> {
    Measure::all().filter(|measure| matches!(measure.scope(), Scope::Wall | Scope::Place | Scope::Probe)).collect()
}

/// The value of a column of a row.
fn cell(plan: &Plan, row: &signorini::sweep::Row, column: &str) -> Option<f64> {
    let first = plan.header().len() - row.measures.len();
    let index = plan.header().iter().position(|name| name == column).unwrap_or_else(|| panic!("no column {column}"));
    row.measures[index - first]
}

/// Supports of flats with random forces, and round ones with friction: work rates, forces of all
/// flats together and worn volumes over the gap are those of the runs with that gap.
#[test]
fn the_measures_of_supports_are_those_of_the_runs() {
    for name in ["tube-lattice-bars", "tube-round-supports"] {
        let ends = [("time.end", 0.4), ("time.statistics_from", 0.1)];
        let file = CaseFile::embedded(name).unwrap();
        let of_supports = Measure::all().filter(|measure| matches!(measure.scope(), Scope::Support | Scope::Place));
        // The lattice bars have no coefficient of wear.
        let has_law = file.case().unwrap().archard(0).is_some();
        let asked: Vec<Measure> = of_supports
            .filter(|measure| has_law || !measure.name().contains("worn") && !measure.name().starts_with("depth"))
            .collect();
        assert_eq!(asked.len(), if has_law { 12 } else { 7 }, "{name}");
        let gaps = [1.5e-4, 3e-4];
        let mut sweep = Sweep::new(file.clone());
        for (key, value) in ends {
            sweep = sweep.set(key, value).unwrap();
        }
        let axis = Axis::list("support.*.gap", &gaps.map(Into::into)).unwrap();
        let plan = sweep.vary(axis).by("moreau-jean").measure(asked).plan().unwrap();
        for (row, gap) in plan.rows(1).unwrap().iter().zip(gaps) {
            assert_eq!((row.status, row.error.as_str()), (Status::Ok, ""), "{name}");
            let mut file = file.clone();
            for (key, value) in ends.into_iter().chain([("support.*.gap", gap)]) {
                file.set(&key.parse().unwrap(), &value.into()).unwrap();
            }
            let case = file.case().unwrap();
            let run = run(&case.scene, &case.method("moreau-jean").unwrap(), &Options::new(case.time)).unwrap();
            assert_eq!(run.statistics.wear.len(), 2);
            let names: Vec<String> = case.scene.supports.iter().map(|support| support.name.clone()).collect();
            let words = signorini::output::csv::words(&names);
            for (index, word) in words.iter().enumerate() {
                let (wear, support) = (&run.statistics.wear[index], &run.statistics.supports[index]);
                let force = support.force.as_ref().unwrap();
                assert!(wear.work_rate_w > 0.0 && force.mean_n > 0.0, "{name}");
                let mut expected = vec![
                    (format!("work_rate_{word}_W"), Some(wear.work_rate_w)),
                    (format!("impact_share_{word}"), wear.impact_share),
                    (format!("sliding_rate_{word}_m_per_s"), Some(wear.sliding_m / (0.4 - 0.1))),
                    (format!("friction_power_{word}_W"), Some(wear.friction_power_w)),
                    (format!("force_mean_{word}_N"), Some(force.mean_n)),
                    (format!("force_rms_{word}_N"), Some(force.rms_n)),
                    (format!("force_largest_{word}_N"), support.force_largest.map(|largest| largest.mean_n)),
                ];
                assert!(force.largest.is_some(), "{name}: rigid supports have one as well");
                if let Some(law) = case.archard(index) {
                    let worn = law.worn(wear.work_rate_w);
                    assert!(worn.volume_m3.unwrap() > 0.0);
                    expected.push((format!("worn_volume_{word}_m3"), worn.volume_m3));
                    expected.push((format!("support_worn_volume_{word}_m3"), worn.support_volume_m3));
                    let deepest = case.depth_deepest(index, wear);
                    // The work of the most loaded sector, on its part of the circle.
                    let sectors = wear.sectors.iter().map(|sector| sector.work_rate_w).fold(0.0, f64::max);
                    let most = worn.depth_all_round_m.unwrap() * sectors / wear.work_rate_w * wear.sectors.len() as f64;
                    let wanted = most.min(worn.depth_one_scar_m.unwrap());
                    assert!((deepest.unwrap() / wanted - 1.0).abs() < 1e-12 && deepest > worn.depth_all_round_m);
                    expected.push((format!("depth_deepest_{word}_m"), deepest));
                    expected.push((format!("depth_one_scar_{word}_m"), worn.depth_one_scar_m));
                    expected.push((format!("depth_all_round_{word}_m"), worn.depth_all_round_m));
                }
                for (column, value) in expected {
                    assert_eq!(cell(&plan, row, &column), value, "{name}, {column}");
                }
            }
        }
    }
}

/// A measure of supports is refused by name where there are none, and one of wear without a law.
#[test]
fn measures_of_supports_are_refused_by_name_where_they_have_no_value() {
    let refused = |case: &str, key: &str, measure: Measure| {
        let axis = Axis::linear(key, 0.1, 0.2, 2).unwrap();
        let sweep = Sweep::new(CaseFile::embedded(case).unwrap()).vary(axis).by("moreau-jean");
        sweep.measure([measure]).plan().unwrap_err().to_string()
    };
    // A slider has a worn volume, and no scar with a depth.
    let mut damper = CaseFile::embedded("dry-friction-damper").unwrap();
    for (key, value) in [("wear.coefficient", 1e-14), ("wear.service", 3e8)] {
        damper.set(&key.parse().unwrap(), &value.into()).unwrap();
    }
    let of_damper = |measure: Measure| {
        let axis = Axis::linear("slider.pad.friction", 0.1, 0.2, 2).unwrap();
        Sweep::new(damper.clone()).vary(axis).by("moreau-jean").measure([measure]).plan()
    };
    assert!(of_damper(Measure::WornVolume).is_ok());
    for measure in [Measure::DepthDeepest, Measure::DepthOneScar, Measure::DepthAllRound] {
        let said = of_damper(measure).unwrap_err().to_string();
        assert!(said.contains(measure.name()) && said.contains("worn_volume, or a support with width"), "{said}");
    }
    let said = refused("rigid-walls-sine", "wall.*.restitution", Measure::WorkRate);
    assert!(said.contains("work_rate") && said.contains("the case has no support in two planes"), "{said}");
    let said = refused("tube-lattice-bars", "support.*.restitution", Measure::WornVolume);
    assert!(said.contains("worn_volume") && said.contains("coefficient and service in [wear]"), "{said}");
}

#[test]
fn the_measures_of_a_row_are_those_of_the_run_with_its_values() {
    for scheme in ["event", "moreau-jean", "penalty:stiffness=1e6", "paoli-schatzman"] {
        for (name, key) in [
            ("rigid-walls-sine", "load.1.harmonic.amplitude"),
            ("elastic-wall", "load.1.harmonic.amplitude"),
            ("two-masses", "load.1.harmonic.amplitude"),
        ] {
            let set = |sweep: Sweep| sweep.set("time.end", 2.0).unwrap().set("time.statistics_from", 0.37).unwrap();
            let file = CaseFile::embedded(name).unwrap();
            let sweep = set(Sweep::new(file.clone())).vary(Axis::list(key, &[2.5.into(), 3.0.into()]).unwrap());
            let plan = sweep.by(scheme).measure(every_wall_measure()).plan().unwrap();
            let rows = plan.rows(1).unwrap();
            for (row, amplitude) in rows.iter().zip([2.5, 3.0]) {
                assert_eq!((row.status, row.error.as_str()), (Status::Ok, ""), "{name} by {scheme}");
                let mut file = file.clone();
                for (key, value) in [("time.end", 2.0), ("time.statistics_from", 0.37), (key, amplitude)] {
                    file.set(&key.parse().unwrap(), &value.into()).unwrap();
                }
                let case = file.case().unwrap();
                let method = case.method(scheme).unwrap();
                let run = run(&case.scene, &method, &Options::new(case.time)).unwrap();
                let words = signorini::output::csv::words(
                    &case.scene.walls.iter().map(|wall| wall.name.clone()).collect::<Vec<_>>(),
                );
                for (wall, word) in run.statistics.walls.iter().zip(words) {
                    let force = wall.force.unwrap();
                    for (column, expected) in [
                        (format!("contacts_{word}"), Some(wall.contacts as f64)),
                        (format!("contact_rate_{word}_per_s"), Some(wall.contact_rate_per_s)),
                        (format!("contact_time_ratio_{word}"), Some(wall.contact_time_ratio)),
                        (format!("impulse_{word}_N_s"), Some(force.impulse_n_s)),
                        (format!("force_mean_{word}_N"), Some(force.mean_n)),
                        (format!("force_rms_{word}_N"), Some(force.rms_n)),
                        (format!("force_largest_{word}_N"), wall.force_largest.map(|largest| largest.mean_n)),
                        (format!("impulse_mean_{word}_N_s"), wall.episode_impulse_n_s.mean),
                        (format!("impulse_max_{word}_N_s"), wall.episode_impulse_n_s.max),
                        (format!("peak_force_max_{word}_N"), wall.episode_peak_force_n.max),
                        (format!("peak_force_mean_{word}_N"), wall.episode_peak_force_n.mean),
                        (format!("impact_power_{word}_W"), Some(wall.impact_power_w)),
                        (format!("arrived_less_departed_power_{word}_W"), Some(wall.arrived_less_departed_power_w)),
                    ] {
                        // Sums over the same contacts in the same order: the same bits.
                        assert_eq!(cell(&plan, row, &column), expected, "{name} by {scheme}: {column}");
                    }
                }
            }
        }
    }
}

#[test]
fn displacements_between_the_rows_of_a_run_are_exact_extremes() {
    // Against a run recorded so finely that its largest row is within ½ a h² of the extreme: h =
    // 1e-5 s, a < 1e2 m/s².
    for (name, end) in [("linear-sine", 3.0), ("elastic-wall", 3.0), ("two-masses", 3.0), ("rigid-walls-sine", 3.0)] {
        let case = Case::embedded(name).unwrap();
        let sweep = Sweep::new(CaseFile::embedded(name).unwrap());
        let key = "load.1.harmonic.phase";
        let measures = [
            Measure::DisplacementMax,
            Measure::DisplacementHighest,
            Measure::DisplacementLowest,
            Measure::DisplacementRms,
            Measure::VelocityMax,
        ];
        let sweep = sweep.set("time.end", end).unwrap().set("time.statistics_from", 1.0).unwrap();
        let plan = sweep.vary(Axis::list(key, &[0.0.into()]).unwrap()).by("event").measure(measures).plan().unwrap();
        let row = plan.rows(1).unwrap().remove(0);
        let scene = signorini::Scene { duration: end, ..case.scene.clone() };
        let fine = run(&scene, &Scheme::Event, &Options::with_step(1e-3).with_sample(1e-5)).unwrap().trajectory;
        for (probe, name) in scene.probes.iter().zip(fine.probes()) {
            let word = if probe.name.is_empty() { String::new() } else { format!("_{}", name.replace('-', "_")) };
            let from = fine.time().partition_point(|&t| t < 1.0 - 1e-9);
            let (u, v) = fine.probe(name).unwrap();
            let (u, v) = (&u[from..], &v[from..]);
            let top = u.iter().copied().fold(f64::NEG_INFINITY, f64::max);
            let bottom = u.iter().copied().fold(f64::INFINITY, f64::min);
            let square =
                u.windows(2).map(|pair| 0.5 * (pair[0].powi(2) + pair[1].powi(2))).sum::<f64>() / (u.len() - 1) as f64;
            let speed = v.iter().copied().fold(0.0, |most: f64, v| most.max(v.abs()));
            let found = |measure: &str, unit: &str| cell(&plan, &row, &format!("{measure}{word}_{unit}")).unwrap();
            let (highest, lowest) = (found("displacement_highest", "m"), found("displacement_lowest", "m"));
            // A body that strikes a rigid wall between two rows was there, and up to v h from it at
            // both.
            let strikes = scene.walls.iter().any(|wall| wall.law.is_rigid());
            let slack = 5e-9 + if strikes { 1e-5 * speed } else { 0.0 };
            assert!(highest >= top - 1e-15 && highest - top < slack, "{name}: {highest:e} against {top:e}");
            assert!(lowest <= bottom + 1e-15 && bottom - lowest < slack, "{name}: {lowest:e} against {bottom:e}");
            assert_eq!(found("displacement_max", "m"), highest.abs().max(lowest.abs()));
            let rms = found("displacement_rms", "m");
            assert!((rms / square.sqrt() - 1.0).abs() < 1e-5, "{name}: {rms:e} against {:e}", square.sqrt());
            // An impact between two rows may reach further than both, by a h.
            let most = found("velocity_max", "m_per_s");
            assert!(most >= speed - 1e-12 && most - speed < 2e-3 * speed.max(0.1), "{name}: {most} against {speed}");
        }
    }
}

/// A window so short that its first or last state is an extreme: both belong to it.
#[test]
fn extremes_of_stepped_motion_are_those_of_the_states_from_the_begin_of_the_window_on() {
    let mut first_is_extreme = 0;
    for scheme in ["moreau-jean", "located", "newmark"] {
        for (from, end) in [(0.0, 0.02), (1.0, 1.02), (1.05, 1.07), (1.1, 1.12), (1.15, 1.17)] {
            let sweep = Sweep::new(CaseFile::embedded("linear-sine").unwrap());
            let sweep = sweep.set("time.end", end).unwrap().set("time.statistics_from", from).unwrap();
            let sweep = sweep.set("time.step", 1e-3).unwrap();
            let sweep = sweep.vary(Axis::list("load.1.harmonic.phase", &[0.3.into()]).unwrap()).by(scheme);
            let plan = sweep.measure([Measure::DisplacementHighest, Measure::DisplacementLowest]).plan().unwrap();
            let measures = plan.rows(1).unwrap().remove(0).measures;
            let mut file = CaseFile::embedded("linear-sine").unwrap();
            file.set(&"load.1.harmonic.phase".parse().unwrap(), &0.3.into()).unwrap();
            let scene = signorini::Scene { duration: end, ..file.case().unwrap().scene };
            let options = Options::with_step(1e-3).with_sample(1e-3);
            let motion = run(&scene, &scheme.parse::<Scheme>().unwrap(), &options).unwrap().trajectory;
            let first = motion.time().partition_point(|&t| t < from - 1e-9);
            let u = &motion.probe("").unwrap().0[first..];
            assert_eq!(u.len(), 21);
            let [top, bottom] = [f64::max as fn(f64, f64) -> f64, f64::min].map(|more| u.iter().copied().reduce(more));
            first_is_extreme += usize::from([top, bottom].contains(&u.first().copied()));
            // Multiples of a decimal step are those of its instants up to rounding.
            for (found, wanted) in measures.iter().zip([top, bottom]) {
                let (found, wanted) = (found.unwrap(), wanted.unwrap());
                assert!((found - wanted).abs() <= 1e-12 * wanted.abs().max(1e-6), "{scheme}: {found:e}, {wanted:e}");
            }
        }
    }
    assert!(first_is_extreme >= 3, "{first_is_extreme} of 15 windows begin with an extreme");
}

/// A random force lasts as long as the row, whose end is not that of the case: it is the force of
/// the case with that end.
#[test]
fn a_row_of_another_duration_has_its_own_random_force() {
    let tube = |end: f64, from: f64| {
        let sweep = Sweep::new(CaseFile::embedded("tube-lattice-bars").unwrap()).set("system.modes", 4.0).unwrap();
        let sweep = sweep.set("time.end", end).unwrap().set("time.statistics_from", from).unwrap();
        sweep.vary(Axis::list("system.damping.ratio", &[0.01.into(), 0.03.into()]).unwrap())
    };
    let rows = |sweep: Sweep| {
        let plan = sweep.measure(every_wall_measure()).plan().unwrap();
        plan.rows(1).unwrap().into_iter().map(|row| (row.status, row.measures)).collect::<Vec<_>>()
    };
    let longer = rows(tube(0.2, 0.0).over(Window::Seconds { settle: 0.1, keep: 0.4 }));
    assert!(longer.iter().all(|(status, _)| *status == Status::Ok));
    assert_eq!(longer, rows(tube(0.5, 0.1)));
}

#[test]
fn a_quiet_motion_has_the_amplitude_of_its_closed_form() {
    // Below the graze at 4.2107738… Hz the steady motion is F/√((k − mω²)² + (cω)²); 300 periods of
    // 0.3 s and c/2m = 0.1/s leave e⁻⁹ of the start.
    let plan = source()
        .vary(frequency(3.0, 4.0, 3))
        .by("event")
        .set("system.oscillator.damping", 0.4)
        .unwrap()
        .set("load.1.harmonic.amplitude", 0.5)
        .unwrap()
        .over(Window::Periods { settle: 600, keep: 20 })
        .measure([Measure::DisplacementMax, Measure::DisplacementRms, Measure::Period, Measure::Contacts])
        .plan()
        .unwrap();
    for row in plan.rows(2).unwrap() {
        let f = row.values[0].number().unwrap();
        let omega = std::f64::consts::TAU * f;
        let amplitude = 0.5 / ((100.0 - omega * omega).powi(2) + (0.4 * omega).powi(2)).sqrt();
        let found = [0, 1].map(|i| row.measures[i].unwrap());
        assert!((found[0] / amplitude - 1.0).abs() < 1e-9, "{f} Hz: {} against {amplitude}", found[0]);
        assert!((found[1] * 2.0_f64.sqrt() / amplitude - 1.0).abs() < 1e-9, "{f} Hz: {}", found[1]);
        assert_eq!(row.measures[2], Some(1.0));
        assert_eq!(row.measures[3..], [Some(0.0), Some(0.0)]);
    }
}

#[test]
fn the_symmetric_orbit_and_where_its_symmetry_breaks_are_found_by_sweeping() {
    // e = 0.8, one impact a wall and period: at 5 Hz the speed of impact in closed form is
    // 0.1694105913583735 m/s; by falling frequency the orbit loses its symmetry at 4.57083913378074
    // Hz, where the speeds at the two walls part.
    let sweep = |axis: Axis, settle| {
        let sweep = source().set("wall.*.restitution", 0.8).unwrap().vary(axis).by("event");
        let sweep = sweep.over(Window::Periods { settle, keep: 8 });
        sweep.measure([Measure::ApproachSpeedMax, Measure::Period]).plan().unwrap().rows(2).unwrap()
    };
    // A multiplier of 0.79² a period leaves 1e-16 of the start after 100 of them.
    let row = sweep(Axis::list("load.1.harmonic.frequency", &[5.0.into()]).unwrap(), 400).remove(0);
    for speed in [row.measures[0].unwrap(), row.measures[1].unwrap()] {
        assert!((speed / 0.169_410_591_358_373_5 - 1.0).abs() < 1e-12, "{speed:e}");
    }
    assert_eq!(row.measures[2], Some(1.0));
    // Near the point the orbit attracts weakly: 0.01 Hz from it on either side 600 periods settle
    // what is left to 1e-5 of the speeds.
    let rows = sweep(frequency(4.56, 4.58, 2).followed(Follow::Down), 600);
    let part = |row: &signorini::sweep::Row| (row.measures[0].unwrap() / row.measures[1].unwrap() - 1.0).abs();
    assert!(part(&rows[0]) < 1e-5, "{} Hz: {:e}", rows[0].values[0], part(&rows[0]));
    assert!(part(&rows[1]) > 1e-3, "{} Hz: {:e}", rows[1].values[0], part(&rows[1]));
}

#[test]
fn instants_are_those_of_the_run() {
    let sweep = source().vary(frequency(5.0, 5.5, 2)).by("event").over(Window::Periods { settle: 5, keep: 10 });
    let plan = sweep.clone().measure([Measure::Contacts]).sample(Samples::Impacts, 1000).plan().unwrap();
    let strobed = sweep.sample(Samples::Periods, 4).plan().unwrap();
    for (row, strobes) in plan.rows(2).unwrap().iter().zip(strobed.rows(1).unwrap()) {
        let f = row.values[0].number().unwrap();
        let mut file = CaseFile::embedded("rigid-walls-sine").unwrap();
        file.set(&"load.1.harmonic.frequency".parse().unwrap(), &f.into()).unwrap();
        let mut case = file.case().unwrap();
        case.scene.duration = 15.0 * (1.0 / f);
        let run = run(&case.scene, &Scheme::Event, &Options::new(case.time)).unwrap();
        let contacts: Vec<_> = run.trajectory.contacts().iter().filter(|c| c.start >= 5.0 / f).collect();
        assert_eq!(row.samples.len(), contacts.len());
        assert_eq!(row.measures.iter().flatten().sum::<f64>(), contacts.len() as f64);
        for (sample, contact) in row.samples.iter().zip(contacts) {
            let Sample::Impact { start, phase, approach, impulse, .. } = sample else { panic!("{sample:?}") };
            assert_eq!((*start, *approach, *impulse), (contact.start, contact.approach_speed, contact.impulse));
            let cycles = contact.start * f;
            assert!((phase.unwrap() - cycles.fract()).abs() < 1e-9);
        }
        // The last four of ten instants, the end of the run among them.
        assert_eq!(strobes.samples.len(), 4);
        let mut stepper = Stepper::new(&case.scene, &Scheme::Event, case.scene.duration).unwrap();
        let mut ends = Vec::new();
        for k in 12..=15 {
            let until = f64::from(k) * (1.0 / f);
            while stepper.time() < until {
                let step = stepper.step().unwrap();
                if let (signorini::Path::Exact(arc), true) = (step.path, step.end > until) {
                    ends.push([arc.state(until).0, arc.state(until).1]);
                } else if step.end == until {
                    ends.push([step.q[0], step.v[0]]);
                }
            }
        }
        let found: Vec<_> = strobes
            .samples
            .iter()
            .map(|s| if let Sample::Strobe { seen, .. } = s { seen[0] } else { panic!() })
            .collect();
        assert_eq!(found, ends);
    }
}

#[test]
fn followed_rows_start_where_the_last_one_ended() {
    let window = Window::Periods { settle: 6, keep: 4 };
    let plan = source()
        .set("wall.*.restitution", 0.6)
        .unwrap()
        .vary(Axis::list("wall.*.restitution", &[0.6.into()]).unwrap())
        .vary(frequency(4.4, 4.8, 3).followed(Follow::Both))
        .by("event")
        .over(window)
        .measure([Measure::Contacts, Measure::DisplacementMax]);
    let plan = plan.plan().unwrap();
    assert_eq!((plan.count(), plan.chain_rows()), (6, 6));
    let rows = plan.rows(3).unwrap();
    let directions: Vec<_> = rows.iter().map(|row| row.direction.unwrap()).collect();
    assert_eq!(directions, ["up", "up", "up", "down", "down", "down"]);
    // The same by hand: ten periods at each frequency from the state of the last.
    let mut state = Case::embedded("rigid-walls-sine").unwrap().scene.initial;
    for row in &rows {
        let f = row.values[1].number().unwrap();
        let mut file = CaseFile::embedded("rigid-walls-sine").unwrap();
        for (key, value) in [("load.1.harmonic.frequency", f), ("wall.*.restitution", 0.6)] {
            file.set(&key.parse().unwrap(), &value.into()).unwrap();
        }
        let mut scene = file.case().unwrap().scene;
        (scene.initial, scene.duration) = (state, 10.0 * (1.0 / f));
        state = run(&scene, &Scheme::Event, &Options::with_step(1e-4).with_sample(scene.duration)).unwrap().state;
        assert_eq!(row.end.as_ref(), Some(&state), "{f} Hz");
    }
}

#[test]
fn a_wall_that_moves_past_the_body_takes_it_along() {
    // At rest near one end of its way, the gap closing: every row must start, none may fail.
    let gap = Axis::list("wall.upper.position", &[1e-3.into(), 2e-3.into(), 5e-3.into()]).unwrap();
    let gap = gap.tied("wall.lower.position", -1.0).unwrap().followed(Follow::Down);
    let plan = source().vary(gap).by("event").over(Window::Periods { settle: 0, keep: 3 });
    let rows = plan.measure([Measure::DisplacementMax]).plan().unwrap().rows(1).unwrap();
    for row in rows {
        assert_eq!(row.error, "");
        assert!(row.measures[0].unwrap() <= row.values[0].number().unwrap() * (1.0 + 1e-12));
    }
    // Of several degrees of freedom by the least move.
    let mut masses = Sweep::new(CaseFile::embedded("two-masses").unwrap()).by("event");
    masses = masses.over(Window::Periods { settle: 0, keep: 3 }).measure([Measure::Contacts]);
    let gap = Axis::linear("wall.stop.position", 5e-3, -1e-2, 6).unwrap().followed(Follow::Down);
    let rows = masses.vary(gap).plan().unwrap().rows(1).unwrap();
    assert!(rows[1..].iter().all(|row| row.status == Status::Ok), "{rows:?}");
}

#[test]
fn rows_that_fail_are_rows_with_their_reason() {
    let positions = [5e-3.into(), (-6e-3).into(), 4e-3.into()];
    let sweep = source().vary(Axis::list("wall.upper.position", &positions).unwrap()).set("time.end", 0.5).unwrap();
    let plan = sweep.measure([Measure::Contacts]).plan().unwrap();
    let rows = plan.rows(2).unwrap();
    assert_eq!(rows.iter().map(|row| row.status).collect::<Vec<_>>(), [Status::Ok, Status::Invalid, Status::Ok]);
    assert!(rows[1].error.contains("wall") && !rows[1].error.contains('\n'), "{}", rows[1].error);
    assert_eq!(rows[1].measures, [None, None]);
    // A scheme that diverges: not newmark with unresolved walls, but an explicit rule beyond its
    // stability limit.
    let penalty = "penalty:stiffness=1e12,integrator=central-difference";
    let sweep = source().vary(Axis::list("run.scheme", &[penalty.into(), "event".into()]).unwrap());
    let rows = sweep.set("time.end", 2.0).unwrap().measure([Measure::Contacts]).plan().unwrap().rows(2).unwrap();
    assert_eq!((rows[0].status, rows[1].status), (Status::Diverged, Status::Ok));
    assert!(rows[0].error.contains("stable below a step"), "{}", rows[0].error);
}

#[test]
fn all_rows_are_judged_unless_fewer_are_asked_for_and_judging_changes_no_number() {
    let sweep = || source().vary(frequency(4.0, 5.0, 40)).by("moreau-jean").set("time.end", 0.5).unwrap();
    let rows = |sweep: Sweep| sweep.measure([Measure::Impulse]).plan().unwrap().rows(2).unwrap();
    let all = rows(sweep());
    assert!(all.iter().all(|row| row.status == Status::Ok));
    for judged in [0, 10, 16, 1000] {
        let some = rows(sweep().judged(judged));
        let ok: Vec<u64> = some.iter().filter(|row| row.status == Status::Ok).map(|row| row.number).collect();
        // ⌈40 k/j⌉, the first row among them.
        let j = judged.min(40);
        assert_eq!(ok, (0..j).map(|k| (40 * k).div_ceil(j)).collect::<Vec<_>>(), "{judged}");
        for (row, same) in some.iter().zip(&all) {
            let expected = if ok.contains(&row.number) { Status::Ok } else { Status::Unjudged };
            assert_eq!((row.status, row.error.as_str(), &row.measures), (expected, "", &same.measures));
        }
    }
}

/// Starts of a basin, and oscillators side by side: each is judged or marked.
#[test]
fn basins_are_judged_whole_and_of_the_batch_engine_sixteen_rows() {
    let starts = |sweep: Sweep| {
        let axis = Axis::linear("initial.displacement", -4e-3, 4e-3, 20).unwrap();
        let sweep = sweep.vary(axis).by("event").over(Window::Periods { settle: 20, keep: 20 });
        let rows = sweep.plan().unwrap().rows(2).unwrap();
        [Status::Ok, Status::Unjudged].map(|status| rows.iter().filter(|row| row.status == status).count())
    };
    let damped = || source().set("wall.*.restitution", 0.8).unwrap();
    assert_eq!(starts(damped().measure([Measure::Attractor])), [20, 0]);
    assert_eq!(starts(damped().measure([Measure::Attractor]).judged(5)), [5, 15]);
    let batch = || damped().measure([Measure::Impacts]).kernel(Kernel::Batch);
    assert_eq!(starts(batch()), [16, 4]);
    assert_eq!(starts(batch().judged(20)), [20, 0]);
}

#[test]
fn unjudged_rows_are_named_in_the_table_the_terminal_and_the_page_also_when_merged() {
    let dir = tempfile::tempdir().unwrap();
    let request = |out: &str, more: &[&str]| {
        let own = ["sweep", "rigid-walls-sine", "--set", "time.end=0.5", "--judged", "10", "--measure", "impulse"];
        let vary = ["--vary", "load.1.harmonic.frequency=4:5:40", "--out", out];
        said(dir.path(), &[&own[..], &vary, more].concat(), 0).1
    };
    let told = "unjudged: 30 of 40 rows: nothing checked their steps; see --judged";
    assert!(request("whole", &[]).contains(told));
    let table = fs::read_to_string(dir.path().join("whole/sweep.csv")).unwrap();
    assert_eq!((table.matches(",ok,,").count(), table.matches(",unjudged,,").count()), (10, 30));
    assert!(fs::read_to_string(dir.path().join("whole/report.html")).unwrap().contains("\"unjudged\":30"));
    for shard in ["1/2", "2/2"] {
        request("parts", &["--shard", shard]);
    }
    let (_, merged) = said(dir.path(), &["merge", "parts", "--out", "merged"], 0);
    assert!(merged.contains(told), "{merged}");
    assert_eq!(fs::read_to_string(dir.path().join("merged/sweep.csv")).unwrap(), table);
}

#[test]
fn a_measure_without_a_place_is_refused_by_name() {
    let dir = tempfile::tempdir().unwrap();
    let ask = |case: &str, what: &[&str]| {
        let own = ["sweep", case, "--vary", "time.end=0.3,0.4"];
        said(dir.path(), &[&own[..], what].concat(), 2).1
    };
    let instants = ask("linear-sine", &["--samples", "impacts"]);
    assert!(instants.contains("[measure] samples is \"impacts\"; expected \"periods\""), "{instants}");
    let bare = ask("linear-sine", &["--measure", "contacts"]);
    assert!(bare.contains("columns is contacts") && bare.contains("the case has no wall"), "{bare}");
}

#[test]
fn steps_are_varied_only_of_schemes_that_have_one() {
    let dir = tempfile::tempdir().unwrap();
    let own = ["sweep", "rigid-walls-sine", "--set", "time.end=0.3", "--vary", "time.step=1e-3,2e-3"];
    let own = [&own[..], &["--measure", "contacts"]].concat();
    let (_, err) = said(dir.path(), &[&own[..], &["--scheme", "event"]].concat(), 2);
    assert!(err.contains("time.step") && err.contains("of which event has none"), "{err}");
    // Beside event another scheme may have one.
    let both = ["--vary", "run.scheme=event,moreau-jean"];
    said(dir.path(), &[&own[..], &both].concat(), 0);
}

const FILE: &str = r#"
case = "rigid-walls-sine"
[set]
"wall.*.restitution" = 0.8
[[vary]]
key = "wall.*.restitution"
values = [0.5, 0.6, 0.7, 0.8, 0.9]
[[vary]]
key = "load.1.harmonic.frequency"
name = "frequency"
from = 4.0
to = 5.5
points = 20
follow = "both"
[run]
scheme = "event"
settle = { periods = 20 }
keep = { periods = 12 }
[measure]
columns = ["contacts", "impulse", "displacement_max", "period"]
samples = "impacts"
"#;

/// A folder with the sweep file.
fn place() -> (tempfile::TempDir, PathBuf) {
    let dir = tempfile::tempdir().unwrap();
    fs::write(dir.path().join("study.toml"), FILE).unwrap();
    let path = dir.path().to_owned();
    (dir, path)
}

/// The bytes of the tables and the picture.
fn bytes(folder: &Path) -> Vec<Vec<u8>> {
    ["sweep.csv", "samples.csv", "sweep.svg"]
        .map(|name| fs::read(folder.join(name)).unwrap_or_else(|e| panic!("{name}: {e}")))
        .to_vec()
}

#[test]
fn threads_shards_and_kills_change_no_byte() {
    let (_dir, path) = place();
    said(&path, &["sweep", "study.toml", "--out", "one", "--threads", "1"], 0);
    let whole = bytes(&path.join("one"));
    for threads in ["2", "8"] {
        let out = format!("threads-{threads}");
        said(&path, &["sweep", "study.toml", "--out", &out, "--threads", threads], 0);
        assert!(bytes(&path.join(&out)) == whole, "{threads} threads");
    }
    for of in 1..=5 {
        for index in (1..=of).rev() {
            let shard = format!("{index}/{of}");
            said(
                &path,
                &["sweep", "study.toml", "--out", &format!("parts-{of}"), "--shard", &shard, "--threads", "2"],
                0,
            );
        }
        let (parts, out) = (format!("parts-{of}"), format!("merged-{of}"));
        said(&path, &["merge", &parts, "--out", &out], 0);
        assert!(bytes(&path.join(&out)) == whole, "{of} shards");
    }
    let kills = std::env::var("SIGNORINI_KILLS").ok().and_then(|text| text.parse().ok()).unwrap_or(6);
    let mut killed = 0;
    let mut round = 0;
    while killed < kills {
        let out = format!("killed-{round}");
        round += 1;
        let threads = ["1", "2", "8"][round % 3];
        let args = ["sweep", "study.toml", "--out", &out, "--threads", threads];
        // Longer and longer until it is done before it is killed.
        let mut patience = 2 + (round as u64 * 7919) % 23;
        loop {
            let mut child = command(&path, &args).spawn().unwrap();
            if waited(&mut child, Duration::from_millis(patience)) {
                break;
            }
            child.kill().unwrap();
            child.wait().unwrap();
            killed += 1;
            patience += 1 + (patience * 31 + round as u64 * 17) % 29;
        }
        assert!(bytes(&path.join(&out)) == whole, "round {round}, after {killed} kills");
        assert!(!path.join(&out).join("rows.journal").exists());
    }
}

/// True if the process ended by itself within `patience`.
fn waited(child: &mut Child, patience: Duration) -> bool {
    let started = Instant::now();
    loop {
        if let Some(status) = child.try_wait().unwrap() {
            assert!(status.success(), "{status}");
            return true;
        }
        if started.elapsed() > patience {
            return false;
        }
        std::thread::sleep(Duration::from_millis(1));
    }
}

#[cfg(unix)]
#[test]
fn a_full_disk_is_said_and_nothing_is_lost() {
    let (_dir, path) = place();
    said(&path, &["sweep", "study.toml", "--out", "whole"], 0);
    // Files of at most 24 blocks of 1024 bytes: writing beyond fails, as on a full disk.
    let tool = env!("CARGO_BIN_EXE_signorini");
    let script = format!("trap '' XFSZ; ulimit -f 24; exec {tool} sweep study.toml --out full --threads 2");
    let output = Command::new("bash").args(["-c", &script]).current_dir(&path).output().unwrap();
    let err = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(1), "{err}");
    assert!(err.contains("give the same command again") && !err.contains("panicked"), "{err}");
    let kept = fs::metadata(path.join("full/rows.journal")).unwrap().len();
    assert!(kept > 20_000, "{kept} bytes kept");
    let (_, err) = said(&path, &["sweep", "study.toml", "--out", "full"], 0);
    assert!(err.contains("of them there already"), "{err}");
    assert!(bytes(&path.join("full")) == bytes(&path.join("whole")));
}

#[test]
fn a_folder_is_gone_on_with_by_its_own_request_alone() {
    let (_dir, path) = place();
    said(&path, &["sweep", "study.toml", "--out", "out"], 0);
    let before = bytes(&path.join("out"));
    let (_, err) = said(&path, &["sweep", "study.toml", "--out", "out"], 0);
    assert!(err.contains("all of them there already"), "{err}");
    for (args, words) in [
        (&["--set", "wall.upper.position=6e-3"][..], "wall.upper.position: 0.005 there, 0.006 asked"),
        (&["--scheme", "moreau-jean"], "scheme"),
        (&["--keep", "10"], "run"),
        (&["--measure", "contact_rate"], "columns"),
    ] {
        let (_, err) = said(&path, &[&["sweep", "study.toml", "--out", "out"], args].concat(), 2);
        assert!(err.contains("another request") && err.contains(words) && err.contains("--force"), "{args:?}: {err}");
        assert!(bytes(&path.join("out")) == before);
    }
    said(&path, &["sweep", "study.toml", "--out", "out", "--keep", "10", "--force"], 0);
    assert!(bytes(&path.join("out")) != before);
    // Results of another command are as safe from a sweep as they are from any other.
    said(&path, &["run", "rigid-walls-sine", "--end", "0.1", "--no-verdict", "--out", "run"], 0);
    let (_, err) = said(&path, &["sweep", "study.toml", "--out", "run"], 2);
    assert!(err.contains("another request"), "{err}");
    said(&path, &["run", "rigid-walls-sine", "--end", "0.1", "--no-verdict", "--out", "out"], 2);
}

#[test]
fn shards_that_do_not_belong_together_are_not_merged() {
    let (_dir, path) = place();
    let shard = |out: &str, shard: &str, more: &[&str]| {
        said(&path, &[&["sweep", "study.toml", "--out", out, "--shard", shard], more].concat(), 0);
    };
    shard("a", "1/3", &[]);
    shard("a", "3/3", &[]);
    let refused = |folders: &[&str], words: &str| {
        let (_, err) = said(&path, &[&["merge"], folders, &["--out", "merged"]].concat(), 2);
        assert!(err.contains(words), "{folders:?}: {err}");
    };
    refused(&["a"], "error: a: 1 of 3 shards are missing: 2/3");
    refused(&["a/shard-3-of-3"], "error: a/shard-3-of-3: 2 of 3 shards are missing: 1/3, 2/3");
    shard("b", "2/3", &["--set", "wall.upper.position=6e-3"]);
    refused(&["a", "b"], "a shard of another request");
    shard("c", "2/2", &[]);
    refused(&["a", "c"], "a shard of 2");
    refused(&["a", "a/shard-1-of-3"], "is given twice");
    refused(&["nowhere"], "nowhere");
    fs::create_dir(path.join("empty")).unwrap();
    refused(&["empty"], "not a shard of a sweep, and contains none");
    // One that was begun and not finished.
    let mut child =
        command(&path, &["sweep", "study.toml", "--out", "a", "--shard", "2/3", "--threads", "1"]).spawn().unwrap();
    while !path.join("a/shard-2-of-3/request.json").exists() {
        std::thread::sleep(Duration::from_millis(1));
    }
    child.kill().unwrap();
    child.wait().unwrap();
    if !path.join("a/shard-2-of-3/sweep.csv").exists() {
        refused(&["a"], "is not finished");
    }
    shard("a", "2/3", &[]);
    said(&path, &["merge", "a", "--out", "merged"], 0);
}

#[test]
fn two_processes_do_not_work_in_one_folder() {
    let (_dir, path) = place();
    let long = FILE.replace("periods = 20 }", "periods = 20000 }");
    fs::write(path.join("long.toml"), long).unwrap();
    let mut first = command(&path, &["sweep", "long.toml", "--out", "out", "--threads", "1"]).spawn().unwrap();
    while !path.join("out/request.json").exists() {
        std::thread::sleep(Duration::from_millis(1));
    }
    let (_, err) = said(&path, &["sweep", "long.toml", "--out", "out"], 2);
    first.kill().unwrap();
    first.wait().unwrap();
    assert!(err.contains("another process is at work"), "{err}");
}

#[test]
fn bad_requests_are_named_before_anything_runs() {
    let (_dir, path) = place();
    let vary = "load.1.harmonic.frequency=4:5:3";
    for (args, words) in [
        (&["--vary", vary][..], "one measure or more"),
        (&["--measure", "contacts"], "--vary KEY=FROM:TO:POINTS"),
        (&["--measure", "contacts", "--vary", vary, "--samples", "no"], "named \"no\"; there is periods, impacts"),
        (&["--measure", "contact", "--vary", vary], "did you mean contacts?"),
        (&["--measure", "contacts", "--vary", "load.1.harmonic.frequency=4:4:3"], "the range is empty"),
        (&["--measure", "contacts", "--vary", "load.1.harmonic.frequency=4:x:3"], "KEY=FROM:TO:POINTS"),
        (&["--measure", "contacts", "--vary", "load.1.harmonic.frequency=0:5:3:log"], "above 0 on a logarithmic scale"),
        (&["--measure", "contacts", "--vary", "load.1.harmonic.frequency=4:5"], "a table [random] that draws them"),
        (&["--measure", "contacts", "--vary", "wall.upper.side=1:2:3"], "side"),
        (&["--measure", "contacts", "--vary", "nowhere=1:2:3"], "no value of a case file is named"),
        (&["--measure", "contacts", "--vary", vary, "--follow", "both"], "settle and keep in forcing periods"),
        (&["--measure", "period", "--vary", vary], "settle and keep in forcing periods"),
        (&["--measure", "contacts", "--vary", vary, "--random", "sobol", "--points", "8"], "without points"),
        (
            &["--measure", "contacts", "--vary", "time.end=1:2", "--random", "sobol", "--points", "8", "--keep", "3"],
            "they set the same",
        ),
        (&["--measure", "contacts", "--vary", vary, "--vary", vary], "each key once"),
        (&["--measure", "contacts", "--vary", vary, "--shard", "4/3"], "I/N with I from 1 to N"),
        (&["--measure", "contacts", "--vary", vary, "--scheme", "evnt"], "did you mean event?"),
    ] {
        let (_, err) = said(&path, &[&["sweep", "rigid-walls-sine", "--out", "bad"], args].concat(), 2);
        assert!(err.contains(words), "{args:?}: {err}");
        assert!(!path.join("bad").exists(), "{args:?}");
    }
}

#[test]
fn all_rows_failed_or_one_under_strict_is_exit_code_1() {
    let (_dir, path) = place();
    let args = [
        "sweep",
        "rigid-walls-sine",
        "--vary",
        "wall.upper.position=-6e-3,5e-3",
        "--measure",
        "contacts",
        "--set",
        "time.end=0.2",
    ];
    let (_, err) = said(&path, &[&args[..], &["--out", "some"]].concat(), 0);
    assert!(err.contains("invalid: 1 of 2 rows"), "{err}");
    said(&path, &[&args[..], &["--out", "some", "--strict"]].concat(), 1);
    let (out, _) = said(&path, &[&args[..], &["--plan"]].concat(), 0);
    assert!(out.contains("2 rows by located") && out.contains("1 of which failed"), "{out}");
    let text = fs::read_to_string(path.join("some/sweep.csv")).unwrap();
    assert_eq!(text.lines().count(), 3);
    assert!(text.starts_with("row,position_m,status,error,contacts_upper,contacts_lower\n"), "{text}");
    let cells: Vec<&str> = text.lines().nth(1).unwrap().split(',').collect();
    assert_eq!((cells[0], cells[1].parse::<f64>().unwrap(), cells[2]), ("0", -6e-3, "invalid"));
}

#[test]
fn a_shard_is_a_part_of_the_whole_by_number() {
    for (text, good) in [("1/1", true), ("3/128", true), ("0/3", false), ("4/3", false), ("1", false), ("a/b", false)] {
        assert_eq!(text.parse::<Shard>().is_ok(), good, "{text}");
    }
}

#[test]
fn the_batch_engine_gives_the_rows_of_the_scheme_event() {
    let sweep = |kernel| {
        let gap = Axis::list("wall.*.restitution", &[0.8.into(), 0.7.into()]).unwrap();
        let measures = [
            Measure::Impacts,
            Measure::Impulse,
            Measure::DisplacementHighest,
            Measure::DisplacementLowest,
            Measure::Period,
        ];
        let sweep = source().vary(gap).vary(frequency(4.0, 5.5, 31)).by("event").kernel(kernel).judged(62);
        let sweep = sweep
            .over(Window::Periods { settle: 150, keep: 40 })
            .measure(measures)
            .measure([Measure::ImpactsPerPeriod]);
        sweep.sample(Samples::Periods, 5).plan().unwrap().rows(2).unwrap()
    };
    let (scalar, batch) = (sweep(Kernel::Scalar), sweep(Kernel::Batch));
    assert_eq!((scalar.len(), batch.len()), (62, 62));
    let mut compared = 0;
    for (a, b) in scalar.iter().zip(&batch) {
        assert_eq!((a.number, &a.values, a.status), (b.number, &b.values, b.status));
        // Periodic motions attract: both come to the same one, to what 150 periods leave. Others
        // part.
        if a.measures[6].is_none() {
            continue;
        }
        compared += 1;
        for (index, (x, y)) in a.measures.iter().zip(&b.measures).enumerate() {
            let (x, y) = (x.unwrap(), y.unwrap());
            assert!((x - y).abs() <= 1e-6 * x.abs().max(1e-3), "row {}, measure {index}: {x:e} and {y:e}", a.number);
        }
        for (s, t) in a.samples.iter().zip(&b.samples) {
            let (Sample::Strobe { time, seen }, Sample::Strobe { time: other, seen: also }) = (s, t) else { panic!() };
            assert!((time - other).abs() < 1e-12 * time);
            assert!(
                (seen[0][0] - also[0][0]).abs() < 1e-8 && (seen[0][1] - also[0][1]).abs() < 1e-6,
                "row {}",
                a.number
            );
        }
        assert_eq!((a.samples.len(), b.samples.len()), (5, 5));
    }
    assert!(compared > 40, "{compared}");
}

#[test]
fn exponents_of_rows_are_those_of_their_runs_and_of_the_lanes() {
    use signorini::variation::Exponents;
    let sweep = |kernel, measures: &[Measure]| {
        let over = Window::Periods { settle: 100, keep: 400 };
        let sweep = source().set("wall.*.restitution", 0.8).unwrap();
        let sweep = sweep.vary(frequency(2.0, 5.0, 13)).by("event").kernel(kernel).over(over);
        sweep.measure(measures.iter().copied()).plan().unwrap()
    };
    let plan = sweep(Kernel::Scalar, &[Measure::Lyapunov, Measure::LyapunovError, Measure::Period]);
    assert_eq!(plan.header()[4..], ["lyapunov_per_s", "lyapunov_error_per_s", "period"]);
    let (scalar, batch) = (plan.rows(2).unwrap(), sweep(Kernel::Batch, &[Measure::Lyapunov]).rows(2).unwrap());
    let mut chaotic = 0;
    for (row, lanes) in scalar.iter().zip(&batch) {
        let (exponent, error) = (row.measures[0].unwrap(), row.measures[1]);
        // Of the run itself, to the bit, but for a periodic motion, which has ln|μ| over its time.
        let mut scene = plan.case().scene.clone();
        let frequency = row.values[0].number().unwrap();
        scene.loads[0] = Load::harmonic(3.0, frequency, 0.0);
        let period = 1.0 / frequency;
        let window = [100.0 * period, 500.0 * period];
        scene.duration = window[1];
        let mut own = Exponents::new(&scene, 1, window).unwrap();
        let mut stepper = Stepper::new(&scene, &Scheme::Event, window[1]).unwrap();
        while stepper.time() < window[1] {
            own.observe(&stepper.step().unwrap()).unwrap();
        }
        let own = own.largest();
        if row.measures[2].is_some() {
            assert_eq!(error, Some(0.0));
            assert!((exponent - own.per_s).abs() < 3.0 / (window[1] - window[0]), "{exponent} and {own:?}");
        } else {
            assert_eq!((exponent.to_bits(), error), (own.per_s.to_bits(), own.error_per_s));
        }
        if frequency == 5.0 {
            // Both exponents of the symmetric orbit, (ln det)/2T, in 30 digits.
            assert!((exponent + 2.331_435_513_142_098).abs() < 1e-9, "{exponent}");
        }
        // The lanes' has other digits and another measure of size: of a chaotic motion it is the
        // same to a few standard errors, of a periodic one to a factor of order e³ over the window.
        let other = lanes.measures[0].unwrap();
        if exponent == f64::NEG_INFINITY {
            assert_eq!(other, exponent);
            continue;
        }
        let allowed = 8.0 * error.unwrap() + 3.0 / (window[1] - window[0]);
        assert!((exponent - other).abs() < allowed, "{frequency}: {exponent} and {other}, {allowed}");
        let is_chaotic = exponent > 3.0 * error.unwrap();
        chaotic += usize::from(is_chaotic);
        assert!(!(is_chaotic && row.measures[2].is_some()), "{frequency}");
    }
    assert!(chaotic >= 3, "{chaotic}");
}

#[test]
fn what_the_lanes_do_not_hold_is_refused_by_name() {
    let (_dir, path) = place();
    let vary = ["--kernel", "batch", "--vary", "load.1.harmonic.frequency=4:5:3"];
    for (case, args, words) in [
        ("rigid-walls-sine", &["--measure", "impacts"][..], "settle and keep in forcing periods"),
        ("rigid-walls-sine", &["--measure", "contacts", "--keep", "5"], "one of impacts"),
        ("rigid-walls-sine", &["--measure", "impacts", "--keep", "5", "--scheme", "moreau-jean"], "event"),
        ("rigid-walls-sine", &["--measure", "impacts", "--keep", "5", "--follow", "up"], "no followed value"),
        ("rigid-walls-sine", &["--measure", "impacts", "--keep", "5", "--samples", "impacts"], "\"periods\""),
        ("two-masses", &["--measure", "impacts", "--keep", "5"], "degree"),
    ] {
        let (_, err) = said(&path, &[&["sweep", case, "--out", "bad"], &vary[..], args].concat(), 2);
        assert!(err.contains(words), "{args:?}: {err}");
    }
    for measure in ["lyapunov", "lyapunov_error"] {
        let asked = ["--vary", "load.1.harmonic.frequency=4:5:3", "--measure", measure, "--scheme", "moreau-jean"];
        let (_, err) = said(&path, &[&["sweep", "rigid-walls-sine", "--out", "bad"][..], &asked].concat(), 2);
        assert!(err.contains("--scheme event"), "{err}");
    }
}
