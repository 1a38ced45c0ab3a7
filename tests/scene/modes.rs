//! Modes: against closed forms, at the order of their elements, and what cutting a scene to them
//! keeps.

use crate::structures;
use signorini::State;
use signorini::linear::{Factor, Symmetric};
use signorini::{
    Bar, BarEnd, Beam, BeamEnd, BeamSection, Chain, Damping, Load, LoadKind, MassMatrix, Modes, Probe, Row, Scene,
    Structure, System, Wall, WallLaw,
};
use std::f64::consts::PI;

/// A bar of unit length, area, modulus and density: ω of its modes are multiples of π/2.
fn bar(elements: usize, left: BarEnd, right: BarEnd, mass: MassMatrix) -> Bar {
    Bar { length: 1.0, area: 1.0, youngs_modulus: 1.0, density: 1.0, elements, left, right, mass }
}

/// A steel tube of 1 m.
fn beam(elements: usize, left: BeamEnd, right: BeamEnd) -> Beam {
    Beam { length: 1.0, ..structures::beam(elements, left, right) }
}

fn chain(n: usize, grounds: [f64; 2]) -> Structure {
    Chain { masses: vec![1.0; n], springs: vec![1e4; n - 1], grounds }.structure().unwrap()
}

/// Largest |φᵢᵀMφⱼ − δᵢⱼ| and largest ‖Kφ − ω²Mφ‖ over the norm of what is summed.
fn defects(structure: &Structure, modes: &Modes) -> (f64, f64) {
    let (mut orthonormality, mut residual) = (0.0_f64, 0.0_f64);
    for (i, a) in modes.shapes.iter().enumerate() {
        for (j, b) in modes.shapes.iter().enumerate() {
            let delta = if i == j { 1.0 } else { 0.0 };
            orthonormality = orthonormality.max((structure.mass.form(a, b) - delta).abs());
        }
        let n = a.len();
        let (mut left, mut size) = (vec![0.0; n], vec![0.0; n]);
        structure.stiffness.add_product(1.0, a, &mut left);
        structure.mass.add_product(-modes.omega[i].powi(2), a, &mut left);
        for (r, c, value) in structure.stiffness.entries() {
            size[r] += (value * a[c]).abs();
            if r != c {
                size[c] += (value * a[r]).abs();
            }
        }
        let norm = |x: &[f64]| x.iter().map(|x| x * x).sum::<f64>().sqrt();
        // A mode may have all but rounding on a mass that nothing holds: 1e-14 of the stiffest
        // entry is rounding too, and passes at 1e-9.
        let stiffest = structure.stiffness.diagonal_entries().into_iter().fold(0.0, f64::max);
        residual = residual.max(norm(&left) / (norm(&size) + 1e-5 * stiffest * norm(a)));
    }
    (orthonormality, residual)
}

/// The relative errors of the first frequencies on meshes of `base`, 2 `base` and 4 `base` elements
/// have the order `order`, and the sign `sign`.
fn converges(
    name: &str,
    exact: &[f64],
    rigid: usize,
    base: usize,
    order: f64,
    sign: f64,
    omegas: impl Fn(usize) -> Vec<f64>,
) {
    let meshes: Vec<Vec<f64>> = [base, 2 * base, 4 * base].into_iter().map(omegas).collect();
    for (i, exact) in exact.iter().enumerate() {
        let error = |mesh: &Vec<f64>| mesh[rigid + i] / exact - 1.0;
        let [coarse, middle, fine] = [error(&meshes[0]), error(&meshes[1]), error(&meshes[2])];
        for (a, b) in [(coarse, middle), (middle, fine)] {
            assert!(a * sign > 0.0 && b * sign > 0.0, "{name}, mode {i}: errors {a:e}, {b:e}");
        }
        // The observed order approaches that of the elements from the next term, which at ℎ ω/c < 1
        // is some per cent.
        let observed = (middle / fine).log2();
        assert!(
            (observed - order).abs() < 0.1,
            "{name}, mode {i}: order {observed}, errors {coarse:e} {middle:e} {fine:e}"
        );
    }
}

#[test]
fn bar_frequencies_converge_at_second_order_from_above_and_lumped_from_below() {
    for (mass, sign) in [(MassMatrix::Consistent, 1.0), (MassMatrix::Lumped, -1.0)] {
        let omegas =
            |left, right| move |n| Modes::lowest(&bar(n, left, right, mass).structure().unwrap(), 4).unwrap().omega;
        let fixed_free: Vec<f64> = (0..3).map(|i| (i as f64 + 0.5) * PI).collect();
        converges("fixed–free", &fixed_free, 0, 20, 2.0, sign, omegas(BarEnd::Fixed, BarEnd::Free));
        let free_free: Vec<f64> = (1..4).map(|i| i as f64 * PI).collect();
        converges("free–free", &free_free, 1, 20, 2.0, sign, omegas(BarEnd::Free, BarEnd::Free));
        converges("fixed–fixed", &free_free, 0, 20, 2.0, sign, omegas(BarEnd::Fixed, BarEnd::Fixed));
    }
}

#[test]
fn a_sprung_bar_converges_to_the_root_of_its_frequency_equation() {
    // Fixed at 0, spring k at 1, all units 1: ω cos ω + k sin ω = 0. With k = 3, by bisection.
    let (mut low, mut high) = (PI / 2.0, PI);
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if middle * middle.cos() + 3.0 * middle.sin() > 0.0 { low = middle } else { high = middle }
    }
    let sprung = BarEnd::Sprung { stiffness: 3.0 };
    let omegas = |n| {
        Modes::lowest(&bar(n, BarEnd::Fixed, sprung, MassMatrix::Consistent).structure().unwrap(), 1).unwrap().omega
    };
    converges("fixed–sprung", &[low], 0, 20, 2.0, 1.0, omegas);
}

#[test]
fn a_rectangular_beam_has_the_frequencies_of_its_section() {
    let (width, height, l, elements) = (0.05, 0.02, 1.0, 20);
    let section = BeamSection::Rectangle { width, height };
    let root = f64::sqrt(2.0e11 * height * height / (12.0 * 7850.0));
    for (left, right, bl) in
        [(BeamEnd::Pinned, BeamEnd::Pinned, PI), (BeamEnd::Clamped, BeamEnd::Free, 1.875_104_068_711_961_f64)]
    {
        let plank = Beam { section, added_mass: 0.0, ..beam(elements, left, right) };
        let found = Modes::lowest(&plank.structure().unwrap(), 1).unwrap().omega[0];
        let error = found / ((bl / l).powi(2) * root) - 1.0;
        // From above, by (βℎ)⁴/1440 in the leading order (half of that of ω²); rounding is some
        // 50 elements⁴ units, 2e-9, and the next terms are (βℎ)² of it.
        let leading = (bl / elements as f64).powi(4) / 1440.0;
        assert!(error > 0.0 && error < 1.1 * leading + 2e-9, "{error:e}, of {leading:e}");
    }
}

#[test]
fn beam_frequencies_converge_at_fourth_order_from_above() {
    // βL of the classical ends: roots of cos cosh = ±1, from Blevins' tables to the digits of a
    // double by Newton's method.
    let root = |guess: f64, sign: f64| {
        let mut x = guess;
        for _ in 0..50 {
            // cos x + sign / cosh x = 0.
            x -= (x.cos() + sign / x.cosh()) / (-x.sin() - sign * x.tanh() / x.cosh());
        }
        x
    };
    let cantilever: Vec<f64> = [1.875, 4.694, 7.855].iter().map(|&g| root(g, 1.0)).collect();
    let clamped: Vec<f64> = [4.730, 7.853, 10.996].iter().map(|&g| root(g, -1.0)).collect();
    assert!(
        (cantilever[0] - 1.875_104_068_711_961).abs() < 1e-14 && (clamped[0] - 4.730_040_744_862_704).abs() < 1e-14
    );
    let pinned: Vec<f64> = (1..4).map(|i| f64::from(i) * PI).collect();
    let (free, pin, clamp) = (BeamEnd::Free, BeamEnd::Pinned, BeamEnd::Clamped);
    let cases = [
        ("pinned–pinned", pin, pin, pinned, 0),
        ("clamped–free", clamp, free, cantilever, 0),
        ("clamped–clamped", clamp, clamp, clamped.clone(), 0),
        ("free–free", free, free, clamped, 2),
    ];
    let tube = beam(1, pin, pin);
    let unit = (tube.bending_stiffness() / tube.mass_per_metre()).sqrt();
    for (name, left, right, roots, rigid) in cases {
        let exact: Vec<f64> = roots.iter().map(|x| x * x * unit).collect();
        let omegas = |n| Modes::lowest(&beam(n, left, right).structure().unwrap(), 5).unwrap().omega;
        converges(name, &exact, rigid, 8, 4.0, 1.0, omegas);
    }
}

#[test]
fn rigid_body_motions_are_exact() {
    // A free bar slides, a free beam also turns, a beam on one pin turns; small by full matrices
    // and large by Lanczos.
    for n in [7, 20, 300, 2000] {
        let sliding = bar(n, BarEnd::Free, BarEnd::Free, MassMatrix::Consistent).structure().unwrap();
        let modes = Modes::lowest(&sliding, 3).unwrap();
        assert_eq!(modes.rigid(), 1);
        assert_eq!(modes.omega[0], 0.0);
        // All parts move alike, and the mass is 1: φ = 1, to the rounding of a solve with condition
        // n².
        let worst = modes.shapes[0].iter().map(|x| (x - 1.0).abs()).fold(0.0, f64::max);
        assert!(worst < 1e-15 * (n as f64).powi(2) + 1e-13, "{n}: {worst:e}");
    }
    for n in [3, 12, 150] {
        let free = beam(n, BeamEnd::Free, BeamEnd::Free).structure().unwrap();
        let modes = Modes::lowest(&free, 4).unwrap();
        assert_eq!((modes.rigid(), modes.omega[0], modes.omega[1]), (2, 0.0, 0.0), "{n}: {:?}", modes.omega);
        assert!(modes.omega[2] > 100.0);
        let pivoting = beam(n, BeamEnd::Pinned, BeamEnd::Free).structure().unwrap();
        let modes = Modes::lowest(&pivoting, 4).unwrap();
        assert_eq!((modes.rigid(), modes.omega[0]), (1, 0.0), "{n}: {:?}", modes.omega);
    }
    // Two chains that do not touch: each slides.
    let apart = Chain {
        masses: vec![1.0; 100],
        springs: (0..99).map(|i| if i == 40 { 0.0 } else { 1e4 }).collect(),
        grounds: [0.0; 2],
    };
    assert_eq!(Modes::lowest(&apart.structure().unwrap(), 6).unwrap().rigid(), 2);
}

#[test]
fn chain_frequencies_are_the_closed_form_by_both_methods() {
    // 2 √(k/m) sin(iπ/2(n+1)); by full matrices up to n = 600 where many are requested, else by
    // Lanczos.
    for (n, count) in [(5, 5), (20, 20), (200, 200), (200, 12), (600, 3), (2000, 20), (2000, 100), (50_000, 4)] {
        let structure = chain(n, [1e4, 1e4]);
        let modes = Modes::lowest(&structure, count).unwrap();
        for (i, omega) in modes.omega.iter().enumerate() {
            let exact = 200.0 * ((i + 1) as f64 * PI / (2.0 * (n + 1) as f64)).sin();
            // ω² is known to an ulp or two of the largest ω², 4e4.
            let bound = 1e-15 * 4e4 / exact + 4e-14 * exact;
            assert!((omega - exact).abs() < bound, "n {n}, mode {i}: {omega} {exact} {:e}", omega - exact);
        }
        let (orthonormality, residual) = defects(&structure, &modes);
        assert!(orthonormality < 1e-12 && residual < 1e-9, "n {n}: {orthonormality:e} {residual:e}");
    }
}

#[test]
fn lanczos_finds_the_modes_that_full_matrices_find() {
    // A beam on 150 elements: 300 degrees of freedom, 20 modes by Lanczos, 101 at once.
    for ends in
        [[BeamEnd::Free, BeamEnd::Pinned], [BeamEnd::Clamped, BeamEnd::Sprung { stiffness: 1e4, rotational: 50.0 }]]
    {
        let structure = beam(60, ends[0], ends[1]).structure().unwrap();
        let few = Modes::lowest(&structure, 20).unwrap();
        let all = Modes::lowest(&structure, structure.mass.size()).unwrap();
        for (i, (a, b)) in few.omega.iter().zip(&all.omega).enumerate() {
            // Full matrices know ω² to some ulps of the fastest.
            let fastest = all.omega.last().unwrap();
            let bound = 1e-10 * b + 1e-14 * fastest * fastest / b.max(1.0);
            assert!((a - b).abs() <= bound, "mode {i}: {a} {b}");
        }
        let (orthonormality, residual) = defects(&structure, &few);
        assert!(orthonormality < 1e-12 && residual < 1e-10, "{orthonormality:e} {residual:e}");
    }
}

fn random(seed: &mut u64) -> f64 {
    *seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
    (*seed >> 11) as f64 / (1_u64 << 53) as f64
}

#[test]
fn few_modes_of_random_networks_are_those_of_full_matrices_and_survive_renumbering() {
    // Masses over two decades joined at random by springs over six, held nowhere, once, or often;
    // in pieces where chance leaves them apart.
    let mut seed = 7;
    for draw in 0..60 {
        let n = 45 + (random(&mut seed) * 60.0) as usize;
        let place = |seed: &mut u64| (random(seed) * n as f64) as usize;
        let masses: Vec<f64> = (0..n).map(|_| 10.0_f64.powf(2.0 * random(&mut seed))).collect();
        let mut springs = Vec::new();
        for _ in 0..2 * n {
            let (i, j) = (place(&mut seed), place(&mut seed));
            let k = 10.0_f64.powf(6.0 * random(&mut seed));
            springs.extend(if i == j { vec![] } else { vec![(i, i, k), (j, j, k), (i, j, -k)] });
        }
        for _ in 0..[0, 1, 20][draw % 3] {
            let i = place(&mut seed);
            springs.push((i, i, 1e3));
        }
        let build = |to: &dyn Fn(usize) -> usize| {
            let mut mass = vec![0.0; n];
            (0..n).for_each(|i| mass[to(i)] = masses[i]);
            let stiffness = springs.iter().map(|&(i, j, k)| (to(i), to(j), k));
            Structure {
                mass: Symmetric::diagonal(&mass),
                damping: Symmetric::zeros(n),
                stiffness: Symmetric::from_entries(n, stiffness),
            }
        };
        let structure = build(&|i| i);
        let all = Modes::lowest(&structure, n).unwrap();
        let renumbered = Modes::lowest(&build(&|i| (7 * i + 3) % n), 10);
        let few = Modes::lowest(&structure, 10).unwrap();
        let (orthonormality, residual) = defects(&structure, &few);
        // Shapes are good to 1e-11, which the stiffest spring makes 1e-6 of what the residual is
        // measured by.
        assert!(orthonormality < 1e-12 && residual < 1e-6, "{draw}: {orthonormality:e} {residual:e}");
        assert_eq!(few.rigid(), all.rigid().min(10), "{draw}: {:?}", few.omega);
        let fastest = all.omega[n - 1];
        for i in 0..10 {
            // Full matrices know ω² to some ulps of the fastest.
            let bound = 1e-9 * all.omega[i] + 1e-14 * fastest * fastest / all.omega[i].max(1e-3);
            assert!(
                (few.omega[i] - all.omega[i]).abs() <= bound,
                "{draw}, mode {i}: {} {}",
                few.omega[i],
                all.omega[i]
            );
            // 7 i + 3 is a renumbering where 7 does not divide n.
            if let Some(renumbered) = renumbered.as_ref().ok().filter(|_| !n.is_multiple_of(7)) {
                assert!((few.omega[i] - renumbered.omega[i]).abs() <= bound, "{draw}, mode {i}");
            }
        }
    }
}

#[test]
fn units_play_no_part() {
    // The chain's closed form with k/m from 1e-200 to 1e200, by both methods.
    for exponent in [-100, -60, -9, 0, 9, 60, 100] {
        let (m, k) = (10.0_f64.powi(-exponent), 10.0_f64.powi(exponent));
        let chain = Chain { masses: vec![m; 100], springs: vec![k; 99], grounds: [k, k] }.structure().unwrap();
        for count in [5, 100] {
            let modes = Modes::lowest(&chain, count).unwrap();
            for (i, omega) in modes.omega.iter().enumerate() {
                let exact = 2.0 * k * ((i + 1) as f64 * PI / 202.0).sin();
                assert!((omega - exact).abs() < 1e-11 * exact, "{exponent}, {count}, mode {i}: {omega:e} {exact:e}");
            }
        }
        let damped = chain.with_damping(&Damping::Rayleigh { mass: k, stiffness: 1.0 / k }).unwrap();
        let (alpha, beta) = damped.rayleigh().unwrap();
        assert!((alpha / k - 1.0).abs() < 1e-12 && (beta * k - 1.0).abs() < 1e-12, "{exponent}: {alpha:e} {beta:e}");
    }
}

#[test]
fn rayleigh_damping_is_recognised_on_large_structures() {
    for (n, stiffness) in [(2000, 1e-5), (100_000, 1e-5), (100_000, 0.0)] {
        let tube = beam(n, BeamEnd::Pinned, BeamEnd::Free).structure().unwrap();
        let damped = tube.with_damping(&Damping::Rayleigh { mass: 0.1, stiffness }).unwrap();
        assert!(damped.is_classically_damped(), "{n} {stiffness}");
        let m = damped.mass.size();
        let dashpot = Symmetric::from_entries(m, [(m / 2, m / 2, damped.damping.get(m / 2, m / 2))]);
        let damping = Symmetric::sum(&[(1.0, &damped.damping), (1.0, &dashpot)]);
        assert!(!Structure { damping, ..damped }.is_classically_damped());
    }
}

#[test]
fn equal_frequencies_are_all_found() {
    // Equal chains that do not touch: each frequency as many times, more than Lanczos has start
    // vectors. Fifty short ones exhaust its space at once, where only the count of what is below
    // tells that most are missing.
    for (one, copies, count) in [(120, 6, 18), (4, 50, 20)] {
        let n = one * copies;
        let springs: Vec<f64> = (1..n).map(|i| if i % one == 0 { 0.0 } else { 1e4 }).collect();
        let chain = Chain { masses: vec![1.0; n], springs, grounds: [0.0, 0.0] }.structure().unwrap();
        let held = (0..copies).flat_map(|c| [c * one, c * one + one - 1]).map(|i| (i, i, 1e4));
        let ground = Symmetric::from_entries(n, held);
        let structure = Structure { stiffness: Symmetric::sum(&[(1.0, &chain.stiffness), (1.0, &ground)]), ..chain };
        let modes = Modes::lowest(&structure, count).unwrap();
        for (i, omega) in modes.omega.iter().enumerate() {
            let exact = 200.0 * ((i / copies + 1) as f64 * PI / (2.0 * (one + 1) as f64)).sin();
            // Shapes are good to 1e-11, frequencies to its square and rounding.
            assert!((omega - exact).abs() < 1e-10 * exact, "{copies} copies, mode {i}: {omega} {exact}");
        }
        assert!(defects(&structure, &modes).0 < 1e-12);
    }
}

#[test]
fn shapes_have_a_fixed_sign() {
    let structure = beam(30, BeamEnd::Pinned, BeamEnd::Pinned).structure().unwrap();
    for count in [5, 58] {
        let modes = Modes::lowest(&structure, count).unwrap();
        let weight = structure.mass.diagonal_entries();
        for shape in modes.shapes.iter().take(5) {
            let weighed: Vec<f64> = shape.iter().zip(&weight).map(|(x, w)| x * w.sqrt()).collect();
            let largest = weighed.iter().fold(0.0_f64, |a, x| a.max(x.abs()));
            assert!(*weighed.iter().find(|x| x.abs() >= 0.99999 * largest).unwrap() > 0.0);
        }
    }
}

#[test]
fn counts_and_matrices_that_have_no_modes_are_refused() {
    let structure = chain(5, [0.0, 0.0]);
    for count in [0, 6] {
        assert!(Modes::lowest(&structure, count).unwrap_err().to_string().contains("from 1 to 5"));
    }
    let massless = Structure { mass: Symmetric::diagonal(&[1.0, 0.0, 1.0, 1.0, 1.0]), ..structure.clone() };
    assert!(Modes::lowest(&massless, 2).unwrap_err().to_string().contains("positive definite"));
    let pulled = Structure { stiffness: Symmetric::sum(&[(-1.0, &structure.stiffness)]), ..structure.clone() };
    assert!(Modes::lowest(&pulled, 2).unwrap_err().to_string().contains("stiffness"));
    let holes = Structure { stiffness: Symmetric::diagonal(&[1.0, f64::NAN, 1.0, 1.0, 1.0]), ..structure };
    assert!(Modes::lowest(&holes, 2).unwrap_err().to_string().contains("row 2, column 2"));
    let long = chain(2000, [0.0, 0.0]);
    assert!(Modes::lowest(&long, 501).unwrap_err().to_string().contains("at most 500"));
    let softened = Structure { stiffness: Symmetric::sum(&[(1.0, &long.stiffness), (-1.0, &long.mass)]), ..long };
    assert!(Modes::lowest(&softened, 5).is_err());
}

/// The compliance g K⁻¹ gᵀ.
fn compliance(structure: &Structure, row: &Row) -> f64 {
    let mut x = vec![0.0; structure.mass.size()];
    row.entries().iter().for_each(|&(i, w)| x[i] += w);
    Factor::new(&structure.stiffness).unwrap().solve(&mut x);
    row.dot(&x)
}

/// A pinned tube with a support at 0.37 m, another at the middle, a load and a probe.
fn tube(elements: usize) -> (Beam, Scene) {
    let tube = beam(elements, BeamEnd::Pinned, BeamEnd::Pinned);
    let structure = tube.structure().unwrap().with_damping(&Damping::Rayleigh { mass: 2.0, stiffness: 1e-5 }).unwrap();
    let support = |name, x, position| Wall::upper(name, position).at(tube.at(x).unwrap());
    let under = |name, x, position| Wall::lower(name, position).at(tube.at(x).unwrap());
    let mut scene = Scene::structure(structure)
        .with_wall(support("right", 0.37, 1e-3))
        .with_wall(under("left", 0.37, -1e-3))
        .with_wall(support("middle", 0.5, 2e-3).with_elasticity(1e5, 3.0))
        .with_load(Load { kind: LoadKind::Constant { force: 7.0 }, at: tube.at(0.6).unwrap() });
    scene.probes = vec![Probe { name: "tip".into(), at: tube.at(0.8).unwrap() }];
    (tube, scene)
}

fn structure(scene: &Scene) -> &Structure {
    let System::Structure(structure) = &scene.system else { panic!("not a structure") };
    structure
}

#[test]
fn all_modes_are_the_whole_structure() {
    let (tube, scene) = tube(10);
    let n = scene.system.degrees_of_freedom();
    let q = tube.field("initial", &|x| [1e-3 * (PI * x).sin(), 1e-3 * PI * (PI * x).cos()]).unwrap();
    let v: Vec<f64> = q.iter().enumerate().map(|(i, q)| q * (i as f64).cos()).collect();
    let scene = scene.with_initial(&q, &v);
    for correction in [false, true] {
        let reduction = scene.reduced(n, correction).unwrap();
        let (full, modal) = (structure(&scene), structure(&reduction.scene));
        assert_eq!(
            (modal.mass.half_bandwidth(), modal.damping.half_bandwidth(), modal.stiffness.half_bandwidth()),
            (0, 0, 0)
        );
        assert_eq!(reduction.next_omega, None);
        // Nothing is left out, so nothing is corrected: the rigid wall stays rigid.
        assert!(
            reduction.scene.walls[0].law.is_rigid() && reduction.walls.iter().all(|w| !w.corrected && w.share() == 1.0)
        );
        // Forms of the start are the same: to the rounding of modes on a structure whose ω² span
        // 1e6.
        let (State { q: a, v: b }, start) = (reduction.scene.initial.clone(), &scene.initial);
        for (what, x, y) in [
            ("M", modal.mass.form(&b, &b), full.mass.form(&start.v, &start.v)),
            ("C", modal.damping.form(&b, &a), full.damping.form(&start.v, &start.q)),
            ("K", modal.stiffness.form(&a, &a), full.stiffness.form(&start.q, &start.q)),
        ] {
            assert!((x - y).abs() < 1e-8 * y.abs(), "{what}: {x:e} {y:e}");
        }
        assert!(reduction.start_energy_lost < 1e-8);
        let back = reduction.modes.expand(&a);
        assert!(back.iter().zip(&start.q).all(|(x, y)| (x - y).abs() < 1e-12 * 1e-3 * 1e3));
        for ((wall, modal_wall), truncation) in scene.walls.iter().zip(&reduction.scene.walls).zip(&reduction.walls) {
            let whole = compliance(full, wall.row());
            assert!((compliance(modal, modal_wall.row()) - whole).abs() < 1e-9 * whole);
            assert!((truncation.compliance - whole).abs() < 1e-9 * whole);
            assert!((truncation.mass - truncation.mass_kept).abs() < 1e-10 * truncation.mass);
        }
        // Loads and probes: the static displacement of the probe under the load.
        let through = |scene: &Scene| {
            let mut x = vec![0.0; structure(scene).mass.size()];
            scene.loads[0].at.entries().iter().for_each(|&(i, w)| x[i] += w);
            Factor::new(&structure(scene).stiffness).unwrap().solve(&mut x);
            scene.probes[0].at.dot(&x)
        };
        assert!((through(&scene) - through(&reduction.scene)).abs() < 1e-9 * through(&scene).abs());
        reduction.scene.validate().unwrap();
    }
}

#[test]
fn more_modes_keep_more_compliance_and_less_mass() {
    let (_, scene) = tube(20);
    let whole: Vec<f64> = scene.walls.iter().map(|w| compliance(structure(&scene), w.row())).collect();
    let mut last: Option<signorini::Reduction> = None;
    for k in [1, 2, 3, 5, 8, 13, 21, 40] {
        let reduction = scene.reduced(k, false).unwrap();
        assert!(reduction.scene.walls[0].law.is_rigid());
        for (i, wall) in reduction.walls.iter().enumerate() {
            // K of 20 elements has condition 1e6.
            assert!((wall.compliance - whole[i]).abs() < 1e-9 * whole[i], "{k}: {} {}", wall.compliance, whole[i]);
            assert!(wall.share() <= 1.0 && wall.mass_kept >= wall.mass * (1.0 - 1e-12));
            if let Some(last) = &last {
                assert!(wall.share() >= last.walls[i].share() - 1e-12);
                assert!(wall.mass_kept <= last.walls[i].mass_kept * (1.0 + 1e-12));
            }
        }
        assert_eq!(reduction.modes.count(), k);
        last = Some(reduction);
    }
    // At 0.37 m one mode of a pinned tube carries most of what is soft.
    assert!(scene.reduced(1, false).unwrap().walls[0].share() > 0.9);
}

#[test]
fn the_effective_mass_of_a_string_falls_as_modes_are_added() {
    // A string of mass 1 struck at its middle is the bar's equation: 2 Σ sin²(iπ/2) over its modes,
    // so 1/2 with one mode and 1/20 with nineteen, of which ten move the middle.
    let string = bar(2000, BarEnd::Fixed, BarEnd::Fixed, MassMatrix::Consistent);
    let wall = Wall::upper("stop", 1.0).at(string.at(0.5).unwrap());
    let scene = Scene::structure(string.structure().unwrap()).with_wall(wall);
    for (k, expected) in [(1, 0.5), (19, 0.05)] {
        let kept = scene.reduced(k, false).unwrap().walls[0].mass_kept;
        // Shapes on 2000 elements are those of the string to (kπ/2000)²/24.
        assert!((kept - expected).abs() < 1e-4 * expected, "{k}: {kept}");
    }
}

#[test]
fn static_correction_refuses_a_restitution_that_its_springs_cannot_have() {
    let (_, mut scene) = tube(20);
    let rigid = scene.walls.iter().position(|wall| wall.law.is_rigid()).unwrap();
    scene.walls[rigid].law = WallLaw::Rigid { restitution: 0.5 };
    let said = scene.reduced(4, true).unwrap_err().to_string();
    assert!(said.contains("beside the restitution 0.5 of the wall") && said.contains("cannot rebound"), "{said}");
    assert!(scene.reduced(4, false).is_ok());
}

#[test]
fn static_correction_gives_back_the_whole_compliance() {
    let (_, scene) = tube(20);
    for k in [1, 4, 12] {
        let reduction = scene.reduced(k, true).unwrap();
        for ((before, after), truncation) in scene.walls.iter().zip(&reduction.scene.walls).zip(&reduction.walls) {
            let whole = compliance(structure(&scene), before.row());
            let WallLaw::Elastic { stiffness, damping } = after.law else { panic!("{after:?}") };
            let (own, c) = if let WallLaw::Elastic { stiffness, damping } = before.law {
                (1.0 / stiffness, damping)
            } else {
                (0.0, 0.0)
            };
            let sum = compliance(structure(&reduction.scene), after.row()) + 1.0 / stiffness;
            // What the modes leave out is a difference from the whole: rounding is relative to it,
            // times the condition of K, 1e6.
            assert!((sum - (whole + own)).abs() < 1e-9 * whole, "{k}: {sum:e} {:e}", whole + own);
            assert!((damping - c * (stiffness * own).powi(2)).abs() <= 1e-15 * c);
            assert!(truncation.corrected);
        }
        // Both sides of one place are one place; the middle is another, and is coupled.
        assert!(
            reduction.coupling_neglected > 0.01 && reduction.coupling_neglected < 1.0,
            "{}",
            reduction.coupling_neglected
        );
    }
}

#[test]
fn the_residual_compliance_of_a_free_structure_is_that_of_all_other_modes() {
    // A free bar pushed at its end: Σ 2/(iπ)² over the modes that are left out, i > 3; exact on the
    // elements' own modes.
    let free = bar(40, BarEnd::Free, BarEnd::Free, MassMatrix::Consistent);
    let structure = free.structure().unwrap();
    let wall = Wall::lower("wall", -1.0).at(free.at(0.0).unwrap());
    let scene = Scene::structure(structure.clone()).with_wall(wall);
    let all = Modes::lowest(&structure, 41).unwrap();
    for k in [1, 4, 30] {
        let rest: f64 = (k..41).map(|i| (scene.walls[0].row().dot(&all.shapes[i]) / all.omega[i]).powi(2)).sum();
        let residual = scene.reduced(k, true).unwrap().walls[0].residual();
        assert!((residual - rest).abs() < 1e-11 * rest, "{k}: {residual:e} {rest:e}");
    }
    // Without the rigid-body mode among the modes there is no such compliance.
    let pair = Structure {
        stiffness: Symmetric::zeros(2),
        ..Chain { masses: vec![1.0; 2], springs: vec![1.0], grounds: [0.0; 2] }.structure().unwrap()
    };
    assert!(Scene::structure(pair).reduced(1, false).unwrap_err().to_string().contains("rigid-body"));
}

#[test]
fn a_start_that_truncation_puts_behind_a_wall_is_refused_and_one_on_a_wall_stays_there() {
    let fixed = bar(40, BarEnd::Free, BarEnd::Fixed, MassMatrix::Lumped);
    // u = x(1 − x)/2 … a bar pressed in its middle: its first mode alone moves the free end.
    let q = fixed.field("initial.displacement", &|x| if x < 1.0 { 0.5 * (1.0 - x) } else { 0.0 }).unwrap();
    let touching = |position| {
        let wall = Wall::upper("stop", position).at(fixed.at(0.0).unwrap());
        Scene::structure(fixed.structure().unwrap()).with_wall(wall).with_initial(&q, &vec![0.0; 40])
    };
    // Wavelength by wavelength the end reaches 0.5 from below: the first mode gives 4/π² of it.
    let reduction = touching(0.5).reduced(1, false).unwrap();
    let reached = reduction.scene.walls[0].row().dot(&reduction.scene.initial.q);
    assert!((reached - 4.0 / PI.powi(2)).abs() < 1e-3, "{reached}");
    assert!(reduction.start_energy_lost > 0.1 && reduction.start_energy_lost < 0.3);
    // A lower wall just below the start is then behind.
    let wall = Wall::lower("floor", 0.499).at(fixed.at(0.0).unwrap());
    let error = touching(0.5).with_wall(wall).reduced(1, false).unwrap_err().to_string();
    assert!(error.contains("modes is 1") && error.contains("\"floor\"") && error.contains("more"), "{error}");
    // With all modes the start touches as before, up to rounding, and is taken.
    let all = touching(0.5).reduced(40, false).unwrap();
    all.scene.validate().unwrap();
    assert!(all.scene.walls[0].gap(all.scene.walls[0].row().dot(&all.scene.initial.q)) < 1e-12);
}

#[test]
fn a_dashpot_couples_modes_and_rayleigh_damping_does_not() {
    let plain = beam(8, BeamEnd::Clamped, BeamEnd::Free).structure().unwrap();
    let n = plain.mass.size();
    assert!(plain.is_classically_damped());
    assert_eq!(plain.rayleigh(), Some((0.0, 0.0)));
    let with = |damping: Damping| plain.clone().with_damping(&damping).unwrap();
    let rayleigh = with(Damping::Rayleigh { mass: 3.0, stiffness: 1e-5 });
    let (alpha, beta) = rayleigh.rayleigh().unwrap();
    // ω² span 1e7 here: the larger term hides digits of the smaller.
    assert!((alpha - 3.0).abs() < 1e-6 && (beta - 1e-5).abs() < 1e-16, "{alpha} {beta:e}");
    let ratios = vec![0.01, 0.02, 0.005];
    let modal = with(Damping::Modal(ratios.clone()));
    assert!(modal.is_classically_damped() && modal.rayleigh().is_none());
    let mut modes = Modes::lowest(&modal, n).unwrap();
    let damping = modes.uncouple(&modal.damping).unwrap();
    for i in 0..n {
        let expected = 2.0 * ratios[i.min(2)] * modes.omega[i];
        // The fastest mode's damping is 1e3 of the slowest's and sets the rounding.
        assert!(
            (damping[i] - expected).abs() < 1e-9 * expected + 1e-13 * damping[n - 1],
            "{i}: {} {expected}",
            damping[i]
        );
    }
    let dashpot = with(Damping::Matrix(Symmetric::from_entries(n, [(n - 2, n - 2, 5.0)])));
    assert!(!dashpot.is_classically_damped() && dashpot.rayleigh().is_none());
    assert_eq!(modes.uncouple(&dashpot.damping), None);
    let scene = Scene::structure(dashpot).reduced(4, false).unwrap();
    assert_eq!(structure(&scene.scene).damping.half_bandwidth(), 3);
    // Modal ratios in modal coordinates: diagonal, whatever the size before.
    let modal = Scene::structure(plain).reduced(4, false).unwrap().with_damping(&Damping::Modal(ratios)).unwrap();
    let c = structure(&modal.scene).damping.diagonal_entries();
    let expected = |i: usize| 2.0 * [0.01, 0.02, 0.005, 0.005][i] * modal.modes.omega[i];
    assert!((0..4).all(|i| (c[i] - expected(i)).abs() < 1e-14 * expected(i)));
}

#[test]
fn modes_of_one_frequency_are_turned_until_damping_uncouples_them() {
    // Two equal oscillators, damped along the directions (1, 2) and (2, −1): any basis is one of
    // modes, that one alone uncouples.
    let damping = Symmetric::from_entries(2, [(0, 0, 1.0 + 4.0 * 3.0), (1, 1, 4.0 + 3.0), (1, 0, 2.0 - 2.0 * 3.0)]);
    let structure =
        Structure { mass: Symmetric::diagonal(&[2.0, 2.0]), damping, stiffness: Symmetric::diagonal(&[50.0, 50.0]) };
    assert!(structure.is_classically_damped());
    let mut modes = Modes::lowest(&structure, 2).unwrap();
    let mut c = modes.uncouple(&structure.damping).unwrap();
    c.sort_by(f64::total_cmp);
    // 5/2 and 15/2: the squares of the directions are 5.
    assert!((c[0] - 2.5).abs() < 1e-14 && (c[1] - 7.5).abs() < 1e-14, "{c:?}");
    // Damping that is the same along all of them turns nothing.
    let before = modes.clone();
    assert_eq!(modes.uncouple(&Symmetric::diagonal(&[6.0, 6.0])).map(|c| c.len()), Some(2));
    assert_eq!(modes, before);
    assert!(defects(&structure, &modes).0 < 1e-14);
}

/// One mode, whose coordinate is half the displacement of the point of the wall: without probes of
/// the file the displacement is that of the point, which reaches the walls and no farther.
#[test]
#[cfg(feature = "case")]
fn one_mode_has_the_displacement_of_the_place_of_its_walls() {
    let file = |wall: &str| {
        let text = format!(
            "[system.modal]\nfrequencies = [2.0]\nshapes = {{ p = [2.0] }}\n{wall}\n\
             [[load]]\nat = {{ point = \"p\" }}\nharmonic = {{ amplitude = 3.0, frequency = 5.0 }}\n\
             [time]\nend = 2.0\nstep = 1e-3\n"
        );
        signorini::case::Case::parse(&text, "modes.toml", ".").unwrap().scene
    };
    let scene = file("[[wall]]\nname = \"a\"\nat = { point = \"p\" }\nside = \"both\"\ngap = 4e-3");
    assert_eq!(scene.probes, [Probe { name: "a".into(), at: Row::new(vec![(0, 2.0)]) }]);
    let run = signorini::run(&scene, &signorini::Scheme::Located, &signorini::Options::with_step(1e-3)).unwrap();
    let (displacement, _) = run.trajectory.probe("a").unwrap();
    let farthest = displacement.iter().fold(0.0_f64, |most, w| most.max(w.abs()));
    // It strikes within steps of 1e-3 s, at some 0.1 m/s.
    assert!((3.8e-3..=4e-3 + 1e-12).contains(&farthest), "{farthest}");
    // Without walls: at the first point.
    assert_eq!(file("").probes, [Probe { name: "p".into(), at: Row::new(vec![(0, 2.0)]) }]);
}

/// More modes than are computed of a large structure are refused with the number that was asked
/// for, of each plane.
#[test]
fn too_many_modes_of_a_large_structure_are_told_as_they_were_asked_for() {
    let tube = |planes: usize, modes: usize| {
        let (direction, second) = if planes == 2 { ("direction = 0\n", "planes = 2\n") } else { ("", "") };
        format!(
            "[system]\n{second}modes = {modes}\n[system.beam]\nlength = 3.0\nyoungs_modulus = 2e11\ndensity = 7850.0\n\
             outer_diameter = 0.02\nelements = 310\nleft = \"pinned\"\nright = \"pinned\"\n\
             [[load]]\nat = {{ position = 1.0 }}\n{direction}constant = {{ force = 1.0 }}\n\
             [time]\nend = 0.1\nstep = 1e-3\n"
        )
    };
    for (planes, asked, words) in [(1, 500, "at most 499, of"), (2, 500, "at most 249 in each plane, of")] {
        let said = signorini::case::Case::parse(&tube(planes, asked), "tube.toml", "").unwrap_err().to_string();
        assert!(said.contains(&format!("modes is {asked}")) && said.contains(words), "{said}");
        assert!(said.contains("more than 600 degrees of freedom"), "{said}");
    }
}
