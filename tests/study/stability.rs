//! Where schemes fail: known limits, in closed form or by an independent recursion, and what the
//! maps must show.
use signorini::case::Case;
use signorini::study::stability::class::Class;
use signorini::study::stability::family::{MapRequest, SchemeFamily};
use signorini::study::stability::impact::{ImpactMap, alike, impact, maps};
use signorini::study::stability::plan::{Grid, Maps, Plan};
use signorini::{Integrator, PenaltyLaw, Scheme};

const E: f64 = 0.7;

fn impacts() -> Vec<ImpactMap> {
    maps(3.0, 1e-4, E)
}

fn find(maps: &[ImpactMap], label: &str) -> ImpactMap {
    maps.iter().find(|m| m.label == label).unwrap_or_else(|| panic!("no map {label}")).clone()
}

/// Depth and speed of a free particle one step later, behind a linear spring at depth 0: h = m = 1,
/// stiffness κ. Written from the rules themselves, each case of its quadratic solved in closed
/// form.
fn step(integrator: Integrator, k: f64, (s, v): (f64, f64)) -> (f64, f64) {
    let free = s + v;
    match integrator {
        Integrator::ImplicitEuler => {
            let end = if free > 0.0 { free / (1.0 + k) } else { free };
            (end, end - s)
        }
        Integrator::CentralDifference => {
            let v = v - k * s.max(0.0);
            (s + v, v)
        }
        Integrator::Trapezoidal => {
            let pushed = free - 0.25 * k * s.max(0.0);
            let end = if pushed > 0.0 { pushed / (1.0 + 0.25 * k) } else { pushed };
            (end, 2.0 * (end - s) - v)
        }
        Integrator::DiscreteGradient => {
            // P = ½k(s₊² − s⁺₊²)/(s − s⁺) in s⁺ = s + v − ½P.
            let end = if s <= 0.0 && free <= 0.0 {
                free
            } else if s <= 0.0 {
                let (a, b, c) = (1.0 + 0.25 * k, -(2.0 * s + v), s * free);
                (-b + (b * b - 4.0 * a * c).sqrt()) / (2.0 * a)
            } else {
                let both = (free - 0.25 * k * s) / (1.0 + 0.25 * k);
                if both > 0.0 { both } else { s + 0.5 * (v - (v * v + k * s * s).sqrt()) }
            };
            (end, 2.0 * (end - s) - v)
        }
        other => panic!("{other:?} has no rule here"),
    }
}

fn recursion(integrator: Integrator, kappa: f64, phase: f64) -> f64 {
    let mut state = (-phase, 1.0);
    let mut touched = false;
    for _ in 0..1000 {
        state = step(integrator, kappa, state);
        touched |= state.0 > 0.0;
        if touched && state.0 <= 0.0 && state.1 < 0.0 {
            // The trapezoid's speed is that at the end of the step, one free step later nothing has
            // changed.
            return -step(integrator, kappa, state).1;
        }
    }
    f64::NAN
}

#[test]
fn schemes_that_carry_the_law_return_it_at_every_phase() {
    let all = impacts();
    for label in [
        "event",
        "paoli-schatzman",
        "generalized-alpha",
        "moreau-jean",
        "moreau-jean:theta=0.75",
        "moreau-jean:theta=1",
    ] {
        let (low, high) = find(&all, label).range().unwrap();
        // Rounding of positions of a few steps; the margin is a thousandfold.
        assert!((low - E).abs() < 1e-9 && (high - E).abs() < 1e-9, "{label}: {low} to {high}");
    }
    assert_eq!(find(&all, "implicit-euler").range(), Some((0.0, 0.0)));
}

#[test]
fn schemes_that_agree_at_every_phase_stand_together() {
    let maps = impacts();
    let groups = alike(&maps);
    assert_eq!(groups.iter().map(Vec::len).sum::<usize>(), maps.len());
    let names: Vec<Vec<&str>> =
        groups.iter().map(|group| group.iter().map(|map| map.label.as_str()).collect()).collect();
    let of = |label: &str| names.iter().find(|group| group.contains(&label)).unwrap();
    assert!(of("event").contains(&"located") && of("event").contains(&"moreau-jean"), "{names:?}");
    assert_eq!((of("newmark").len(), of("implicit-euler").len()), (1, 1));
    // The members of a group have its restitutions, those of the next have others.
    for (i, group) in groups.iter().enumerate() {
        let apart = |a: &ImpactMap, b: &ImpactMap| {
            let pairs = a.measured().zip(b.measured());
            pairs.map(|(a, b)| (a.restitution - b.restitution).abs()).fold(0.0, f64::max)
        };
        assert!(group.iter().all(|map| apart(map, group[0]) < 1e-9 && map.kappa == group[0].kappa));
        let others = groups.iter().skip(i + 1).filter(|other| other[0].kappa == group[0].kappa);
        assert!(others.into_iter().all(|other| apart(other[0], group[0]) >= 1e-9), "{names:?}");
    }
}

#[test]
fn newmark_returns_one_third_to_three_by_chance_of_the_phase() {
    let newmark = find(&impacts(), "newmark");
    for i in newmark.measured() {
        let expected = if i.phase < 2.0 / 3.0 { 3.0 - 4.0 * i.phase } else { 8.0 * i.phase - 5.0 };
        assert!((i.restitution - expected).abs() < 1e-9, "{i:?}");
    }
    let squares: f64 = newmark.measured().map(|i| i.restitution.powi(2)).sum();
    assert!((squares / newmark.measured().count() as f64 - 3.37).abs() < 0.005);
}

#[test]
fn every_penalty_integrator_follows_an_independent_recursion() {
    for map in impacts().iter().filter(|m| m.kappa.is_some()) {
        let Scheme::Penalty { integrator, .. } = map.scheme else { panic!("{map:?}") };
        let kappa = map.kappa.unwrap();
        for i in map.measured() {
            let expected = recursion(integrator, kappa, i.phase);
            // Relative, since κ = 1e4 throws the body back at up to 1e4 times its speed.
            let error = (i.restitution - expected).abs() / expected.max(1.0);
            assert!(error < 1e-9, "{}: {i:?}, expected {expected}", map.label);
        }
        assert_eq!(map.measured().count(), map.impacts.len());
    }
}

#[test]
fn restitutions_of_the_penalty_lie_in_the_known_ranges() {
    let all = impacts();
    let known = [
        ("penalty, implicit-euler, κ = 1", 0.25, 0.25),
        ("penalty, implicit-euler, κ = 0.01", 0.8538, 0.8559),
        ("penalty, implicit-euler, κ = 10000", 3.3e-5, 1.0e-4),
        ("penalty, central-difference, κ = 1", 1.0, 1.0),
        ("penalty, central-difference, κ = 0.01", 0.9988, 1.0012),
        ("penalty, trapezoidal, κ = 10000", 0.3336, 2.9984),
        ("penalty, trapezoidal, κ = 1", 0.8993, 1.1120),
        ("penalty, trapezoidal, κ = 0.01", 0.9988, 1.0012),
        ("penalty, discrete-gradient, κ = 0.01", 1.0, 1.0),
        ("penalty, discrete-gradient, κ = 3", 1.0, 1.0),
        ("penalty, discrete-gradient, κ = 10000", 1.0, 1.0),
    ];
    for (label, least, most) in known {
        let (low, high) = find(&all, label).range().unwrap();
        // The ranges are rounded to the last digit given; midpoints of 200 phases come that near to
        // their ends.
        let digit = if least == most { 1e-9 } else { 1e-4 * most };
        assert!(low >= least - digit && high <= most + digit, "{label}: {low} to {high}");
        assert!(high - low >= 0.97 * (most - least) - digit, "{label}: {low} to {high} is narrower");
    }
    // Beyond one radian a step it gains although the linear limit is κ = 4; beyond that its only
    // bound is κ − 1.
    let (_, high) = find(&all, "penalty, central-difference, κ = 3").range().unwrap();
    assert!((high - 2.0).abs() < 0.02, "{high}");
    let (_, high) = find(&all, "penalty, central-difference, κ = 10000").range().unwrap();
    assert!(high > 9000.0 && high < 9999.0, "{high}");
}

#[test]
fn an_impact_depends_on_nothing_but_phase_law_and_kappa() {
    let newmark = |mass, h| impact(&Scheme::Newmark, None, mass, h, 1.0, 0.3).unwrap().restitution;
    assert!((newmark(1e-6, 1e-7) - newmark(1e6, 10.0)).abs() < 1e-9);
    let spring = |mass: f64, h: f64| {
        let law = PenaltyLaw::Linear { stiffness: 0.5 * mass / (h * h), damping: 0.0 };
        let scheme = Scheme::Penalty { law, integrator: Integrator::Trapezoidal };
        impact(&scheme, Some(0.5), mass, h, 1.0, 0.3).unwrap().restitution
    };
    assert!((spring(1e-6, 1e-7) - spring(1e6, 10.0)).abs() < 1e-9);
}

/// Few and coarse steps, so that a map is fast.
fn grid(families: &[SchemeFamily]) -> Grid {
    Grid { finest: 1e-2, coarsest: 0.9, per_decade: 4.0, families: families.to_vec(), ..Grid::default() }
}

fn source() -> Case {
    Case::embedded("rigid-walls-sine").unwrap()
}

fn question(case: &Case) -> MapRequest<'_> {
    MapRequest { scene: &case.scene, laws: &case.penalty.laws }
}

fn run(case: &Case, grid: &Grid) -> Maps {
    Plan::new(question(case), grid).unwrap().run(&|_| {}).unwrap()
}

#[test]
fn newmark_gains_energy_on_the_source_scene_at_every_step() {
    let family = SchemeFamily::Constrained(Scheme::Newmark);
    let maps = run(&source(), &grid(&[family]));
    let mut cells = maps.map(family).flat_map(|row| &row.cells);
    assert!(cells.all(|c| matches!(c.class, Class::Gaining | Class::Diverged) && c.measured.is_some()));
    assert!(maps.own().all(|row| row.stable.as_ref().is_some_and(|stable| stable.step.is_none())));
}

#[test]
fn moreau_jean_is_stable_at_small_steps_and_neither_gains_energy_nor_passes_a_wall() {
    let family = SchemeFamily::Constrained(Scheme::MoreauJean { theta: 0.5 });
    let maps = run(&source(), &grid(&[family]));
    for cell in maps.map(family).flat_map(|row| &row.cells) {
        let measured = cell.measured.unwrap();
        assert!(cell.step > 1e-2 || cell.class == Class::Stable, "{cell:?}");
        assert!(measured.growth.is_none_or(|growth| growth < 1e-9), "{cell:?}");
        assert!(measured.passed <= 1.05, "{cell:?}");
    }
    let own = maps.own().next().unwrap();
    assert_eq!(own.subject.value, 1.0);
    // The body crosses the gap of 10 mm in some 50 ms.
    let step = own.stable.clone().unwrap().step.unwrap();
    assert!(step > 1e-2 && step < 1e-1, "{step}");
}

#[test]
fn moreau_jean_freezes_where_a_step_crosses_the_gap() {
    let text = "
        [system.oscillator]\nmass = 1.0\ndamping = 0.0\nstiffness = 0.0
        [[wall]]\nname = \"upper\"\nside = \"upper\"\nposition = 5e-3\nrestitution = 1.0
        [[wall]]\nname = \"lower\"\nside = \"lower\"\nposition = -5e-3\nrestitution = 1.0
        [initial]\nvelocity = 1.0
        [time]\nend = 2.0\nstep = 1e-3";
    let case = Case::parse(text, "free.toml", "").unwrap();
    let family = SchemeFamily::Constrained(Scheme::MoreauJean { theta: 0.5 });
    let wide = Grid { finest: 1e-1, coarsest: 50.0, per_decade: 5.0, ..grid(&[family]) };
    let maps = run(&case, &wide);
    let own = maps.own().next().unwrap();
    // Speed 1 m/s, gap 10 mm: 10 ms. Between half of that and that the body is caught every other
    // step or not, by chance.
    for cell in own.cells.iter().filter(|c| c.step < 4e-3) {
        assert_eq!(cell.class, Class::Stable, "{cell:?}");
    }
    let beyond: Vec<_> = own.cells.iter().filter(|c| c.step > 1.05e-2).collect();
    assert!(!beyond.is_empty() && beyond.iter().all(|c| c.class == Class::Frozen), "{beyond:?}");
}

#[test]
fn the_discrete_gradient_never_gains_and_the_trapezoid_does() {
    let [conserving, trapezoid] = [Integrator::DiscreteGradient, Integrator::Trapezoidal].map(SchemeFamily::Penalty);
    let maps = run(&source(), &grid(&[conserving, trapezoid]));
    for cell in maps.map(conserving).flat_map(|row| &row.cells) {
        assert!(!matches!(cell.class, Class::Gaining | Class::Diverged), "{cell:?}");
        // Newton stops at rounding of the force; a stiff wall multiplies that.
        assert!(cell.measured.unwrap().growth.is_none_or(|growth| growth.abs() < 1e-6), "{cell:?}");
    }
    let stiffest = maps.map(trapezoid).next().unwrap();
    assert_eq!(stiffest.subject.value, 1e-12);
    assert!(stiffest.cells.iter().all(|c| matches!(c.class, Class::Gaining | Class::Diverged)));
}

#[test]
fn a_ball_that_should_rest_rests() {
    let family = SchemeFamily::Constrained(Scheme::MoreauJean { theta: 0.5 });
    let maps = run(&Case::embedded("bouncing-ball").unwrap(), &grid(&[family]));
    let own = maps.own().next().unwrap();
    assert!(own.cells.iter().take(4).all(|c| c.class == Class::Stable), "{:?}", own.cells);
}

#[test]
fn a_case_without_walls_is_refused() {
    let error = Plan::new(question(&Case::embedded("linear-sine").unwrap()), &Grid::default()).unwrap_err();
    assert!(error.is_request() && error.to_string().contains("wall"), "{error}");
}

#[test]
fn a_case_with_a_round_support_is_refused() {
    let error = Plan::new(question(&Case::embedded("whirl-in-a-hole").unwrap()), &Grid::default()).unwrap_err();
    assert!(error.is_request() && error.to_string().contains("round or with friction"), "{error}");
}

#[test]
fn a_case_with_a_slider_is_refused_by_its_name() {
    let error = Plan::new(question(&Case::embedded("dry-friction-damper").unwrap()), &Grid::default()).unwrap_err();
    assert!(error.is_request() && error.to_string().contains("slider \"pad\" is a contact with friction"), "{error}");
}

#[test]
fn one_thread_and_two_give_the_same_maps() {
    let families =
        [SchemeFamily::Constrained(Scheme::PaoliSchatzman), SchemeFamily::Penalty(Integrator::CentralDifference)];
    let with = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| format!("{:?}", run(&source(), &grid(&families))))
    };
    assert_eq!(with(1), with(2));
}

#[test]
fn progress_ends_at_the_work_announced() {
    let plan = Plan::new(question(&source()), &grid(&[SchemeFamily::Constrained(Scheme::ImplicitEuler)])).unwrap();
    let most = std::sync::atomic::AtomicU64::new(0);
    let work = plan.work();
    plan.run(&|done| {
        most.fetch_max(done, std::sync::atomic::Ordering::Relaxed);
    })
    .unwrap();
    assert_eq!(most.into_inner(), work);
}
