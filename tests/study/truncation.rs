//! Modal truncation: its error is measured, and the number of modes for a given error is found.
use signorini::case::{Case, Truncated};
use signorini::study::truncation::{MOST_CHOSEN, Truncation, choose_modes};
use signorini::{Error, Method, Options, Run, Scheme, run};
use std::f64::consts::PI;

/// A tube over two spans, pressed by a spread load against a support in its middle, which it
/// touches at rest.
fn tube(system: &str, wall: &str, end: f64) -> Case {
    let text = format!(
        "{system}[system.beam]\nlength = 2.0\nyoungs_modulus = 2e11\ndensity = 7850.0\n\
         outer_diameter = 0.02\ninner_diameter = 0.016\n\
         elements = 16\nleft = \"pinned\"\nright = \"pinned\"\n[system.damping]\nratio = 0.3\n\
         [[wall]]\nname = \"support\"\nat = {{ position = 1.0 }}\nside = \"upper\"\nposition = 0.0\n{wall}\
         [[load]]\nat = {{ spread = [0.0, 2.0] }}\nconstant = {{ force = 80.0 }}\n\
         [time]\nend = {end}\nstep = 1e-3\nsample = {}\n",
        0.1 * end
    );
    Case::parse(&text, "tube.toml", "").unwrap_or_else(|error| panic!("{error}"))
}

/// A bar thrown against a wall in its middle.
fn bar(system: &str, elements: usize, wall: &str) -> Case {
    let text = format!(
        "{system}[system.bar]\nlength = 1.0\nyoungs_modulus = 1.0\ndensity = 1.0\narea = 1.0\n\
         elements = {elements}\nleft = \"free\"\nright = \"clamped\"\n\
         [[wall]]\nname = \"wall\"\nat = {{ position = 0.0 }}\nside = \"lower\"\nposition = 0.1\n{wall}\
         [initial]\ndisplacement = {{ profile = [[0.0, 0.5], [1.0, 0.0]] }}\n[time]\nend = 1.5\n\
         step = 5e-3\nsample = 1e-2\n"
    );
    Case::parse(&text, "bar.toml", "").unwrap_or_else(|error| panic!("{error}"))
}

fn method() -> Method {
    Method::new(Scheme::MoreauJean { theta: 0.5 })
}

fn made(case: &Case) -> Run {
    run(&case.scene, &method(), &Options::new(case.time)).unwrap()
}

fn cost(case: &Case) -> Option<Truncation> {
    let Truncated { whole, reduction, .. } = case.truncated.as_ref().unwrap();
    Truncation::of(whole, reduction, &made(case), &method(), &case.time, &mut |_| {}).unwrap()
}

#[test]
fn a_truncation_is_held_against_twice_its_modes() {
    let case = tube("[system]\nmodes = 3\n", "restitution = 0.0\n", 0.5).with("time.statistics_from", 0.2).unwrap();
    let truncation = cost(&case).unwrap();
    assert_eq!((truncation.modes, truncation.degrees_of_freedom), ([3, 6], 32));
    let runs = [made(&case), made(&case.with("system.modes", 6).unwrap())];
    let wall = &truncation.walls[0];
    // Of the window, as every table.
    assert_eq!(wall.impulse_n_s, runs.each_ref().map(|run| run.statistics.walls[0].force.unwrap().impulse_n_s));
    let whole = runs[0].trajectory.impulse("support").unwrap();
    assert!((wall.impulse_n_s[0] / whole - 0.6).abs() < 0.1, "{wall:?}, {whole}");
    let change = (wall.impulse_n_s[0] - wall.impulse_n_s[1]).abs() / wall.impulse_n_s[1].abs();
    // The impulse is far above that of one impact, so the change is relative to it alone.
    assert!((wall.impulse_change - change).abs() < 1e-15 && change > 1e-4, "{wall:?}");
    let whole = tube("[system]\nmodes = 32\n", "restitution = 0.0\n", 0.5);
    assert_eq!(cost(&whole), None);
}

#[test]
fn the_mass_at_a_wall_falls_as_modes_are_added() {
    // Pinned-pinned, seen in the middle: 1/m = Σ (2/m′L) sin²(iπ/2), half of the modes have a node
    // there.
    let case = tube("[system]\nmodes = 3\n", "", 0.5);
    let wall = cost(&case).unwrap().walls.remove(0);
    let area = PI / 4.0 * (0.02_f64.powi(2) - 0.016_f64.powi(2));
    let total = 7850.0 * area * 2.0;
    for (mass, seen) in wall.effective_mass_kg.into_iter().zip([2.0, 3.0]) {
        // Shapes of 16 Hermite elements: (kh)⁴ of the fifth mode is 1, and its error some
        // thousandth of that.
        assert!((mass / (0.5 * total / seen) - 1.0).abs() < 2e-3, "{mass} {seen}");
    }
    // Static compliance L³/48EI, by modes (2L³/π⁴EI) Σ 1/i⁴ over odd i.
    let share = |odd: &[f64]| odd.iter().map(|i: &f64| i.powi(-4)).sum::<f64>() * 96.0 / PI.powi(4);
    for (found, odd) in wall.compliance_share.into_iter().zip([&[1.0, 3.0][..], &[1.0, 3.0, 5.0]]) {
        assert!((found - share(odd)).abs() < 1e-5, "{found}");
    }
}

/// Numbers stand under the names of their walls, also where a round support comes before flats.
/// In the middle of a pinned tube every second mode has a node: what the second one changes there,
/// nothing, says nothing of those left out.
#[test]
fn modes_that_do_not_move_a_wall_show_no_error_of_those_left_out() {
    let case = tube("[system]\nmodes = 1\n", "stiffness = 1e6\n", 0.2).with("time.step", 1e-4).unwrap();
    let truncation = cost(&case).unwrap();
    assert_eq!(truncation.modes, [1, 4]);
    let [one, more] = truncation.walls[0].effective_mass_kg;
    // 1/m = Σ (2/m′L) sin²(iπ/2) over the first and the third mode.
    assert!((one / more - 2.0).abs() < 1e-3, "{one} {more}");
    assert!(truncation.worst().0 > 1e-3, "{truncation}");
    let whole = &case.truncated.as_ref().unwrap().whole;
    let chosen = choose_modes(whole, 1, &method(), &case.time, 0.9, &mut |_| {}).unwrap();
    // 0.9 allows any change: by two increases that count, to 3 and to 5.
    assert_eq!(chosen.levels.iter().map(|level| level.modes).collect::<Vec<_>>(), [1, 2, 3, 5]);
    assert!(chosen.kept && chosen.levels[1].change.unwrap() < 1e-9, "{chosen}");
}

#[test]
fn each_wall_has_its_own_numbers_in_any_order_of_supports() {
    let text = "[system]\nplanes = 2\nmodes = 3\n[system.beam]\nlength = 2.0\nyoungs_modulus = 2e11\n\
        density = 7850.0\nouter_diameter = 0.02\ninner_diameter = 0.016\nelements = 16\nleft = \"pinned\"\n\
        right = \"pinned\"\n[system.damping]\nratio = 0.01\n\
        [[support]]\nname = \"plate\"\nat = { position = 0.7 }\nshape = \"round\"\ngap = 2e-4\n\
        restitution = 0.5\nwidth = 0.02\n\
        [[support]]\nname = \"bars\"\nat = { position = 1.0 }\nshape = \"flats\"\ndirections = [0, 90, 180, 270]\n\
        gap = 1.5e-4\nrestitution = 0.5\nwidth = 0.02\n\
        [[load]]\nat = { position = 0.9 }\ndirection = 0\nharmonic = { amplitude = 30.0, frequency = 11.0 }\n\
        [[load]]\nat = { position = 0.9 }\ndirection = 90\nharmonic = { amplitude = 20.0, frequency = 17.0 }\n\
        [time]\nend = 1.0\nstep = 2e-4\nsample = 1e-2\n";
    let case = Case::parse(text, "supports.toml", "").unwrap_or_else(|error| panic!("{error}"));
    let (found, run) = (cost(&case).unwrap(), made(&case));
    let masses = case.scene.wall_masses();
    assert_eq!((found.walls.len(), case.scene.walls.len()), (5, 5));
    for wall in &found.walls {
        let index = case.scene.walls.iter().position(|own| own.name == wall.wall).unwrap();
        assert_eq!(wall.effective_mass_kg[0], masses[index], "{}", wall.wall);
        let own = &run.statistics.walls[index];
        assert_eq!(own.wall, wall.wall);
        assert_eq!(wall.impulse_n_s[0], own.force.unwrap().impulse_n_s, "{}", wall.wall);
        assert!(wall.impulse_n_s[0] != 0.0, "{}", wall.wall);
    }
}

#[test]
fn a_static_correction_gives_the_textbooks_reaction_with_one_mode() {
    // Two spans under an even load: 5/8 of it rests on the middle. One mode alone misses the
    // compliance of the others.
    let reaction = |system: &str| {
        let case = tube(system, "", 4.0);
        // The motion has died: the slowest mode at 12 Hz keeps exp(−0.3 · 2π · 12 · 4) of its
        // start.
        let force = made(&case).trajectory.contact_force("support").unwrap().last().copied().unwrap();
        -force / 80.0
    };
    let plain = reaction("[system]\nmodes = 1\n");
    let corrected = reaction("[system]\nmodes = 1\nstatic_correction = true\n");
    let whole = reaction("[system]\nmodes = 32\n");
    // By series: the load moves the middle by 4/π⁵ of qL⁴/EI in the first mode, 5/384 in all; a
    // unit force by 2/π⁴ and 1/48 of L³/EI.
    let (free, unit) = (4.0 / PI.powi(5), [2.0 / PI.powi(4), 1.0 / 48.0]);
    assert!((whole - 0.625).abs() < 1e-6, "{whole}");
    assert!((plain - free / unit[0]).abs() < 1e-5, "{plain}");
    assert!((corrected - free / unit[1]).abs() < 1e-5, "{corrected}");
    assert!((corrected - 0.625).abs() < 0.25 * (plain - 0.625).abs());
}

#[test]
fn as_many_modes_are_found_as_the_error_takes() {
    let case = bar("[system]\nmodes = 4\n", 60, "stiffness = 5.0\n");
    let Truncated { whole, .. } = case.truncated.as_ref().unwrap();
    let chosen = choose_modes(whole, 4, &method(), &case.time, 0.05, &mut |_| {}).unwrap();
    assert!(chosen.kept && chosen.shortfall().is_none() && chosen.modes < 60, "{chosen:?}");
    assert!(chosen.levels.windows(2).all(|pair| pair[1].modes > pair[0].modes));
    let quiet = chosen.levels.iter().rev().take(2).all(|level| level.change.is_some_and(|x| x <= 0.25 * 0.05));
    assert!(quiet, "{chosen:?}");
    // The reference is the result with all modes.
    let cut = made(&case.with("system.modes", chosen.modes as i64).unwrap()).trajectory.impulse("wall").unwrap();
    let all = made(&case.with("system.modes", 60).unwrap()).trajectory.impulse("wall").unwrap();
    assert!((cut / all - 1.0).abs() < 0.05, "{cut} {all}");
    // With all of them nothing is left out, however small the error.
    let all = choose_modes(whole, 4, &method(), &case.time, 1e-14, &mut |_| {}).unwrap();
    assert!(all.kept && all.modes == 60 && all.to_string().contains("all there are"), "{all}");
}

#[test]
fn a_truncation_that_falls_short_says_so() {
    let case = bar("[system]\nmodes = 150\n", MOST_CHOSEN + 20, "restitution = 0.5\n");
    let Truncated { whole, .. } = case.truncated.as_ref().unwrap();
    let chosen = choose_modes(whole, 150, &method(), &case.time, 1e-12, &mut |_| {}).unwrap();
    assert!(!chosen.kept && chosen.modes == MOST_CHOSEN, "{chosen:?}");
    let Some(Error::Truncated { tolerance, reached, modes, .. }) = chosen.shortfall() else { panic!("{chosen:?}") };
    assert!(tolerance == 1e-12 && reached > tolerance && modes == MOST_CHOSEN);
    assert!(chosen.shortfall().is_some_and(|error| !error.is_request()));
}
