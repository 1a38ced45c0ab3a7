//! Work of wear in round holes and under friction, against closed forms; over the rows of a run and
//! in its contacts.
#![allow(
    clippy::excessive_precision,
    reason = "reference values stand as they were computed, to more digits than a double holds"
)]

use signorini::case::Case;
use signorini::{Options, Run, Scheme, run};

const JEAN: Scheme = Scheme::MoreauJean { theta: 0.5 };

fn case(text: &str) -> Case {
    Case::parse(text, "holes.toml", "").unwrap_or_else(|error| panic!("{error}"))
}

fn made(case: &Case, scheme: Scheme) -> Run {
    let run = run(&case.scene, &scheme, &Options::new(case.time)).unwrap_or_else(|error| panic!("{error}"));
    assert!(run.findings.is_empty(), "{:?}", run.findings);
    run
}

/// The work of each support over the run, J: in the statistics (whose window is the whole run), in
/// the last row and in the contacts.
fn works(case: &Case, run: &Run) -> Vec<[f64; 3]> {
    let trajectory = &run.trajectory;
    let of = |(index, support): (usize, &signorini::Support)| {
        let contacts = trajectory.contacts().iter().zip(trajectory.contact_wear());
        let worn =
            contacts.filter(|(contact, _)| support.walls.contains(&contact.wall)).map(|(_, wear)| wear.unwrap().work);
        let rate = run.statistics.wear[index].work_rate_w;
        [rate * case.scene.duration, *trajectory.wear_work()[index].last().unwrap(), worn.sum()]
    };
    case.scene.supports.iter().enumerate().map(of).collect()
}

#[test]
fn a_whirling_mass_wears_as_the_closed_form_says() {
    let case = Case::embedded("whirl-in-a-hole").unwrap().with("time.end", 1.0).unwrap();
    let run = made(&case, JEAN);
    let [support] = run.statistics.wear.as_slice() else { panic!() };
    // The midpoint rule on the circle: 2e-5 at a step of 1e-3, order 2, so 2e-7 here.
    let force = run.statistics.supports[0].force.unwrap().mean_n;
    assert!((force / 7.064267168051028225190121 - 1.0).abs() < 1e-6, "{force}");
    // The force is steady: the largest is the mean, up to the first step, which begins at the speed
    // of the steady motion and is half a step behind it.
    let peak = run.statistics.supports[0].episode_peak_force_n.max.unwrap();
    assert!((peak / 7.064267168051028225190121 - 1.0).abs() < 1e-6, "{peak}");
    assert!((support.work_rate_w / 1.109652491907234180588153 - 1.0).abs() < 1e-6, "{}", support.work_rate_w);
    assert!((support.friction_power_w / 0.2219304983814468361176306 - 1.0).abs() < 1e-6);
    // The body never stops, so friction takes mu times the work, to the rounding of 1e4 steps.
    assert!((support.friction_power_w / (0.2 * support.work_rate_w) - 1.0).abs() < 1e-12, "{support:?}");
    assert!(!support.upper_figure && (support.contact_time_ratio - 1.0).abs() < 1e-12);
    let distance = std::f64::consts::TAU * 5.0 * 5e-3;
    assert!((support.sliding_m / distance - 1.0).abs() < 1e-6, "{}", support.sliding_m);
    // Five turns: every sector the same, up to a step at its ends, 1/167 of a passage.
    for sector in &support.sectors {
        assert!((12.0 * sector.work_rate_w / support.work_rate_w - 1.0).abs() < 1e-2, "{sector:?}");
        assert!((12.0 * sector.impulse_share - 1.0).abs() < 1e-2, "{sector:?}");
    }
    // One contact, which begins at the lag behind the force.
    let lag = 360.0 - 0.5022776509190162_f64.to_degrees();
    for run in [&run, &made(&case, Scheme::Located)] {
        // Half a step is 0.09 degrees; of order 2 is what the first step leaves.
        let [Some(wear)] = run.trajectory.contact_wear() else { panic!("{:?}", run.trajectory.contact_wear()) };
        assert!((wear.angle - lag).abs() < 1e-5, "{wear:?}");
    }
    let [Some(wear)] = run.trajectory.contact_wear() else { panic!("{:?}", run.trajectory.contact_wear()) };
    assert!((wear.sliding / distance - 1.0).abs() < 1e-6);
    let [[statistics, row, contact]] = works(&case, &run)[..] else { panic!() };
    assert!((row / statistics - 1.0).abs() < 1e-12 && (contact / statistics - 1.0).abs() < 1e-12);
    // The work grows evenly.
    let half = run.trajectory.wear_work()[0][run.trajectory.time().len() / 2];
    assert!((2.0 * half / row - 1.0).abs() < 1e-5, "{half} of {row}");
}

/// A free mass of 1.3 kg in a hole of 2 mm, at e = 1/2, without friction.
fn settling(step: f64) -> Case {
    case(&format!(
        "[system]\nplanes = 2\n[system.oscillator]\nmass = 1.3\ndamping = 0.0\nstiffness = 0.0\n\
         [[support]]\nname = \"hole\"\nshape = \"round\"\ngap = 2e-3\nrestitution = 0.5\n\
         [initial]\ndisplacement = [0.5e-3, -0.3e-3]\nvelocity = [0.11, 0.07]\n[time]\nend = 0.5\nstep = {step:e}\n"
    ))
}

#[test]
fn infinitely_many_impacts_and_then_sliding_for_ever() {
    // With 25 digits; order 1 through the impacts. The slid distance begins where they end: what
    // the grid takes for the last impacts is a share of the step too.
    let [coarse, fine] = [1e-4, 1e-5].map(|step| {
        let case = settling(step);
        let run = made(&case, JEAN);
        let [support] = run.statistics.wear.as_slice() else { panic!() };
        assert!(support.upper_figure && support.friction_power_w == 0.0);
        let [[statistics, row, contact]] = works(&case, &run)[..] else { panic!() };
        assert!((row / statistics - 1.0).abs() < 1e-12 && (contact / statistics - 1.0).abs() < 1e-9);
        let impulse = run.statistics.supports[0].force.unwrap().mean_n * 0.5;
        [
            statistics / 0.0238862564138352009454 - 1.0,
            impulse / 0.7025369533480941454529411 - 1.0,
            support.sliding_m / 0.009576128563268586792642672 - 1.0,
        ]
    });
    for (coarse, fine) in coarse.into_iter().zip(fine) {
        assert!(coarse.abs() < 1e-2 && fine.abs() < 1e-3, "{coarse:e} {fine:e}");
    }
}

/// The built-in case `name` without friction, up to `end` (s).
fn smooth(name: &str, end: f64) -> Case {
    let text = std::fs::read_to_string(format!("{}/cases/{name}.toml", env!("CARGO_MANIFEST_DIR"))).unwrap();
    let kept = |line: &&str| !line.starts_with("friction") && !line.starts_with("statistics_from");
    case(&text.lines().filter(kept).collect::<Vec<_>>().join("\n")).with("time.end", end).unwrap()
}

#[test]
fn a_tube_in_two_holes_has_an_exact_motion_that_moreau_jean_approaches() {
    // 20 modes in each plane under random forces, with impacts and sliding in both holes.
    let case = smooth("tube-round-supports", 0.1);
    let exact = made(&case, Scheme::Event);
    assert!(exact.counters.handed_steps == 0 && exact.counters.events > 50, "{:?}", exact.counters);
    for [statistics, row, contact] in works(&case, &exact) {
        assert!(statistics > 0.0);
        assert!((row / statistics - 1.0).abs() < 1e-12 && (contact / statistics - 1.0).abs() < 1e-12);
    }
    let off = |step: f64| {
        let mut case = smooth("tube-round-supports", 0.1);
        case.time.step = step;
        let run = made(&case, JEAN);
        let pairs = run.statistics.supports.iter().zip(&exact.statistics.supports);
        let forces = pairs.map(|(one, other)| (one.force.unwrap().mean_n, other.force.unwrap().mean_n));
        forces.map(|(one, other)| (one / other - 1.0).abs()).fold(0.0, f64::max)
    };
    // Of order 1 through dozens of impacts, each of which enlarges the errors of those before.
    let [coarse, fine] = [1e-5, 5e-7].map(off);
    assert!(fine < 0.3 * coarse && fine < 2e-2, "{coarse:e} {fine:e}");
}

#[test]
fn comparisons_in_round_holes_have_the_exact_reference() {
    let case = smooth("whirl-in-a-hole", 0.5);
    let methods = [signorini::Method::new(JEAN)];
    let comparison = signorini::study::compare::compare(&case.scene, &methods, &case.time, &|_| ()).unwrap();
    assert!(comparison.reference.is_ok() && comparison.refined.is_none());
    // The start is that of the motion with friction, so the body swings round the hole; order 2.
    let error = comparison.rows[0].error.unwrap();
    assert!(error > 1e-9 && error < 1e-3, "{error:e}");
}

#[test]
fn friction_stops_a_mass_on_a_flat() {
    let case = Case::embedded("code-aster-sdnd100").unwrap();
    let run = made(&case, JEAN);
    let trajectory = &run.trajectory;
    let u = trajectory.probe("flat-y").unwrap().0;
    // It turns at -0.65, 0.45, -0.25 and 0.05 mm, every pi/100 s, and stays there.
    for (k, wanted) in [0.85e-3, -0.65e-3, 0.45e-3, -0.25e-3, 0.05e-3].into_iter().enumerate() {
        let at = (k as f64 * std::f64::consts::PI / 100.0 / 1e-4).round() as usize;
        // A row lies within half a row of the turn: (50e-6 x 100)^2/2 of the amplitude.
        assert!((u[at] - wanted).abs() < 1.5e-5 * 0.75e-3, "{k}: {} {wanted}", u[at]);
    }
    assert!((u.last().unwrap() - 0.05e-3).abs() < 1e-8);
    let [support] = run.statistics.wear.as_slice() else { panic!() };
    // The step in which it stops is part of the last swing: order 2 in the step.
    assert!((support.sliding_m / 0.0036 - 1.0).abs() < 1e-5, "{}", support.sliding_m);
    assert!((support.work_rate_w * 0.15 / 0.036 - 1.0).abs() < 1e-5, "{}", support.work_rate_w);
    assert!((support.friction_power_w * 0.15 / 0.0036 - 1.0).abs() < 1e-5, "{}", support.friction_power_w);
    assert!((support.sectors[3].work_rate_w / support.work_rate_w - 1.0).abs() < 1e-12);
    // The flat pushes along -z with what presses, and friction brakes along y.
    let force = run.statistics.supports[0].force.unwrap().mean_vector_n[1];
    assert!((force + 10.0).abs() < 1e-9, "{force}");
}

#[test]
fn an_oblique_impact_with_friction_slips_as_the_closed_form_says() {
    let text = "[system]\nplanes = 2\n[system.oscillator]\nmass = 1.3\ndamping = 0.0\nstiffness = 0.0\n\
                [[support]]\nname = \"flat\"\nshape = \"flats\"\ndirections = [0]\ngap = 1e-3\nrestitution = 0.5\n\
                friction = 0.2\n[initial]\nvelocity = [0.2, 0.15]\n[time]\nend = 0.01\nstep = 1e-4\n";
    let slips = case(text);
    let run = made(&slips, JEAN);
    let [support] = run.statistics.wear.as_slice() else { panic!() };
    // One impulse, algebra: p_n = 0.39 N s, v_t from 0.15 to 0.09 m/s.
    assert!((run.statistics.supports[0].force.unwrap().mean_n * 0.01 / 0.39 - 1.0).abs() < 1e-12);
    assert!((support.work_rate_w * 0.01 / 0.0468 - 1.0).abs() < 1e-12, "{}", support.work_rate_w);
    assert!((support.friction_power_w / (0.2 * support.work_rate_w) - 1.0).abs() < 1e-12);
    // Slower along the flat it sticks at the end of the impulse: v_t goes to 0 over all of it.
    let sticks = case(&text.replace("0.15]", "0.03]"));
    let run = made(&sticks, JEAN);
    let [support] = run.statistics.wear.as_slice() else { panic!() };
    assert!((support.work_rate_w * 0.01 / (0.39 * 0.015) - 1.0).abs() < 1e-12, "{}", support.work_rate_w);
    assert!((support.friction_power_w * 0.01 / (0.5 * 1.3 * 0.03 * 0.03) - 1.0).abs() < 1e-12);
}

#[test]
fn the_rows_and_contacts_of_exact_motion_carry_the_work() {
    // Pressed on a flat by 10 N, it swings seven times: the work of a swing is twice the amplitude
    // times the force, and at a quarter of a swing from its ends 1 - cos(pi/4) of half of that.
    let pressed = case(
        "[system]\nplanes = 2\n[system.oscillator]\nmass = 1.0\ndamping = 0.0\nstiffness = 1e4\n\
         [[support]]\nname = \"flat\"\nshape = \"flats\"\ndirections = [90]\ngap = 0.0\nrestitution = 0.5\n\
         [[load]]\ndirection = 90\nconstant = { force = 10.0 }\n[initial]\ndisplacement = [0.85e-3, 0.0]\n\
         [time]\nend = 0.2199114857512855\nstep = 1e-4\nsample = 0.00785398163397448\n",
    );
    let run = made(&pressed, Scheme::Event);
    let work = &run.trajectory.wear_work()[0];
    assert_eq!(work.len(), 29);
    for (quarter, &work) in work.iter().enumerate() {
        let (swings, part) = (quarter / 4, quarter % 4);
        let wanted = 10.0 * 0.85e-3 * (2.0 * swings as f64 + 1.0 - (part as f64 * std::f64::consts::FRAC_PI_4).cos());
        // Roundings of a hundred stretches.
        assert!((work - wanted).abs() < 1e-14, "{quarter}: {work} {wanted}");
    }
    // A billiard in a square hole: every impact is a contact of its own, and all of them the work.
    let square = case(
        "[system]\nplanes = 2\n[system.oscillator]\nmass = 1.3\ndamping = 0.0\nstiffness = 0.0\n\
         [[support]]\nname = \"hole\"\nshape = \"flats\"\nsides = 4\nturn = 20\ngap = 1e-3\nrestitution = 1.0\n\
         [initial]\ndisplacement = [2e-4, -6e-4]\nvelocity = [0.05, 0.083]\n[time]\nend = 1.0\nstep = 1e-4\n",
    );
    for scheme in [Scheme::Event, JEAN] {
        let run = made(&square, scheme);
        let [[statistics, row, contacts]] = works(&square, &run)[..] else { panic!() };
        assert!((row / statistics - 1.0).abs() < 1e-12 && (contacts / statistics - 1.0).abs() < 1e-12, "{scheme}");
        assert_eq!(run.trajectory.contact_wear().len(), 68);
        for (contact, wear) in run.trajectory.contacts().iter().zip(run.trajectory.contact_wear()) {
            let wear = wear.unwrap();
            assert_eq!((wear.angle, wear.sliding), (20.0 + 90.0 * contact.wall as f64, 0.0), "{scheme}");
            assert!(wear.work > 0.0);
        }
    }
}

#[test]
fn a_tube_in_two_holes_adds_up() {
    let tube = Case::embedded("tube-round-supports").unwrap().with("time.statistics_from", 0.0).unwrap();
    let tube = tube.with("time.end", 0.3).unwrap();
    let run = made(&tube, JEAN);
    for ([statistics, row, contacts], wear) in works(&tube, &run).into_iter().zip(&run.statistics.wear) {
        assert!(statistics > 0.0 && (row / statistics - 1.0).abs() < 1e-12);
        // Contacts leave out impulses that are rounding.
        assert!((contacts / statistics - 1.0).abs() < 1e-9, "{contacts} {statistics}");
        // Where it slips friction takes mu times the work, and where it sticks less.
        let share = wear.friction_power_w / (0.2 * wear.work_rate_w);
        assert!((0.9..=1.0 + 1e-12).contains(&share), "{share}");
        let sum: f64 = wear.sectors.iter().map(|sector| sector.work_rate_w).sum();
        assert!((sum / wear.work_rate_w - 1.0).abs() < 1e-12);
    }
    // The mean force is that of the columns along y and z.
    for (columns, support) in run.trajectory.hole_impulses().iter().zip(&run.statistics.supports) {
        let force = support.force.unwrap();
        let [y, z] = columns.each_ref().map(|column| column.iter().sum::<f64>() / 0.3);
        assert!((y - force.mean_vector_n[0]).abs() + (z - force.mean_vector_n[1]).abs() < 1e-12 * force.mean_n);
    }
    // Without friction the tube slides more: the reason why such a figure is an upper one.
    let slippery = tube.with("support.*.friction", 0.0).unwrap();
    let free = made(&slippery, JEAN);
    let sum = |run: &Run| run.statistics.wear.iter().map(|wear| wear.work_rate_w).sum::<f64>();
    assert!(free.statistics.wear.iter().all(|wear| wear.upper_figure) && sum(&free) > sum(&run));
}

#[test]
fn the_columns_of_the_files_carry_forces_work_and_angles() {
    let case = Case::embedded("whirl-in-a-hole").unwrap().with("time.end", 0.1).unwrap();
    let run = made(&case, JEAN);
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    signorini::output::csv::trajectory(&path("t.csv"), &run.trajectory).unwrap();
    signorini::output::csv::contacts(&path("c.csv"), &run.trajectory).unwrap();
    let read = |name: &str| -> Vec<Vec<String>> {
        let mut reader = csv::ReaderBuilder::new().has_headers(false).from_path(path(name)).unwrap();
        reader.records().map(|row| row.unwrap().iter().map(str::to_owned).collect()).collect()
    };
    let rows = read("t.csv");
    let tail = &rows[0][rows[0].len() - 5..];
    assert_eq!(
        tail,
        [
            "contact_force_hole_y_N",
            "contact_impulse_hole_y_N_s",
            "contact_force_hole_z_N",
            "contact_impulse_hole_z_N_s",
            "wear_work_hole_J"
        ]
    );
    let last: f64 = rows.last().unwrap().last().unwrap().parse().unwrap();
    assert!((last / 0.1109652491907234 - 1.0).abs() < 1e-4, "{last}");
    let contacts = read("c.csv");
    assert_eq!(contacts[0][7..], ["angle_deg", "work_J", "sliding_m"]);
    assert_eq!((contacts.len(), contacts[1][0].as_str()), (2, "hole"));
    assert!((contacts[1][8].parse::<f64>().unwrap() / last - 1.0).abs() < 1e-12);
}
