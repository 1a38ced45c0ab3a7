//! The derivative of a motion with respect to its start: against closed forms, a 60-digit reference
//! and differences of free runs.

use crate::source::source;
use nalgebra::{DMatrix, DVector};
use signorini::linear::Symmetric;
use signorini::variation::{Exponents, NoDerivative, OscillatorVariation, Product, saltation};
use signorini::{Load, Path, Row, Scene, Scheme, State, Stepper, Structure, Table, Wall};

/// Numbers from a fixed sequence, in [0, 1).
struct Draw(u64);

impl Draw {
    fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }
}

/// The two masses of the 60-digit reference: ground – 100 N/m – 1 kg – 50 N/m – 0.5 kg, damping
/// 0.004 K + diag(0.3, 0), an upper wall at 5 mm before the second mass.
fn two_masses(restitution: f64) -> Scene {
    let structure = Structure {
        mass: Symmetric::diagonal(&[1.0, 0.5]),
        damping: Symmetric::from_entries(2, [(0, 0, 0.9), (1, 0, -0.2), (1, 1, 0.2)]),
        stiffness: Symmetric::from_entries(2, [(0, 0, 150.0), (1, 0, -50.0), (1, 1, 50.0)]),
    };
    Scene::structure(structure)
        .with_wall(Wall::upper("upper", 5e-3).with_restitution(restitution).at(Row::dof(1)))
        .with_load(Load { at: Row::dof(1), ..Load::harmonic(3.0, 1.0, 0.0) })
        .with_initial(&[4e-3, 3e-3], &[0.0, 0.1])
}

/// The state at `end` of the free run, and the product of its variation.
fn follow(scene: &Scene, end: f64) -> (State, DMatrix<f64>) {
    let mut product = Product::new(scene).unwrap();
    let mut stepper = Stepper::new(scene, &Scheme::Event, end).unwrap();
    while stepper.time() < end {
        product.observe(&stepper.step().unwrap()).unwrap();
    }
    (stepper.state(), product.matrix().clone())
}

fn end_of(scene: &Scene, end: f64) -> DVector<f64> {
    let mut stepper = Stepper::new(scene, &Scheme::Event, end).unwrap();
    while stepper.time() < end {
        stepper.step().unwrap();
    }
    let State { q, v } = stepper.state();
    DVector::from_iterator(2 * q.len(), q.into_iter().chain(v))
}

/// Units of the entries of a state: displacements of the order of a gap, speeds of a gap times
/// 10 rad/s.
fn unit(row: usize, n: usize) -> f64 {
    if row < n { 5e-3 } else { 5e-2 }
}

/// The derivative by central differences of free runs with steps of `h` units, scaled by units.
fn differences(scene: &Scene, end: f64, h: f64) -> DMatrix<f64> {
    let n = scene.initial.q.len();
    let mut matrix = DMatrix::zeros(2 * n, 2 * n);
    for column in 0..2 * n {
        let beside = |sign: f64| {
            let mut scene = scene.clone();
            let State { q, v } = &mut scene.initial;
            let entry = if column < n { &mut q[column] } else { &mut v[column - n] };
            *entry += sign * h * unit(column, n);
            end_of(&scene, end)
        };
        matrix.set_column(column, &((beside(1.0) - beside(-1.0)) / (2.0 * h)));
    }
    for row in 0..2 * n {
        matrix.row_mut(row).iter_mut().for_each(|x| *x /= unit(row, n));
    }
    matrix
}

/// `matrix` in units of the state.
fn scaled(mut matrix: DMatrix<f64>) -> DMatrix<f64> {
    let n = matrix.nrows() / 2;
    for row in 0..2 * n {
        for column in 0..2 * n {
            matrix[(row, column)] *= unit(column, n) / unit(row, n);
        }
    }
    matrix
}

/// How far the product of `scene` is from differences, and the error of those: from steps of 4h and
/// h, whose errors are as 16 to 1, or something else where an event appears or vanishes.
fn compared(scene: &Scene, end: f64) -> [f64; 2] {
    let exact = scaled(follow(scene, end).1);
    let (coarse, fine) = (differences(scene, end, 4e-6), differences(scene, end, 1e-6));
    let size = 1.0 + exact.amax();
    [(&fine - &exact).amax() / size, (&coarse - &fine).amax() / size]
}

/// Tests `scenes`: where differences with two steps agree to 1e-5, the product agrees with them to
/// 1e-6 and as well as they do. Most scenes must be such.
fn agree(name: &str, scenes: impl Iterator<Item = (Scene, f64)>, fewest: usize) {
    let mut counted = 0;
    for (number, (scene, end)) in scenes.enumerate() {
        let [error, doubt] = compared(&scene, end);
        if doubt < 1e-5 {
            counted += 1;
            // Rounding of differences: 1e-15 of a state over 1e-6, grown as the motion grows.
            assert!(error < doubt + 1e-6, "{name} {number}: {error:e}, differences to {doubt:e}");
        }
    }
    assert!(counted >= fewest, "{name}: {counted} scenes");
}

#[test]
fn derivative_through_impact_rest_and_release_is_that_of_sixty_digits() {
    let scene = two_masses(0.0);
    let (state, product) = follow(&scene, 0.9);
    let known =
        [-0.049_242_802_645_863_81, -0.132_769_310_892_237_4, -0.274_280_623_203_482_85, -0.229_367_714_164_525_92];
    for (x, known) in state.q.iter().chain(&state.v).zip(known) {
        assert!((x - known).abs() < 1e-13, "{x} {known}");
    }
    #[rustfmt::skip]
    let known = DMatrix::from_row_slice(4, 4, &[
        0.106_761_457_976_745_19, -0.006_544_232_166_175_236, -0.007_697_492_075_506_26, -0.000_082_392_578_152_125_65,
        -0.705_216_748_387_455_4, 0.043_343_575_072_211_29, 0.050_995_435_804_160_606, 0.000_545_668_139_261_837,
        2.983_639_728_309_240_5, 0.052_086_479_107_497_583, 0.089_000_561_007_440_79, 0.000_590_467_598_670_397_2,
        -6.622_643_035_756_425, -0.554_399_745_851_444_1, -0.765_452_810_431_979_6, -0.006_713_042_458_844_933,
    ]);
    // Products of 1e3 terms of rounding 1e-16 of an entry of 7.
    assert!((&product - &known).amax() < 1e-12, "{product}");
    // A held row takes 2 off the rank.
    let singular = product.singular_values();
    let mut singular: Vec<f64> = singular.iter().copied().collect();
    singular.sort_by(f64::total_cmp);
    assert!(singular[1] < 1e-14 && singular[2] > 0.3, "{singular:?}");
}

#[test]
fn products_of_an_oscillator_are_differences_of_its_runs() {
    let mut draw = Draw(1);
    agree(
        "rigid",
        (0..40).map(|_| {
            let restitution = draw.between(0.3, 0.95);
            let mut scene = source(draw.between(2.0, 8.0), restitution);
            scene.initial = State { q: vec![draw.between(-4e-3, 4e-3)], v: vec![draw.between(-0.3, 0.3)] };
            (scene, draw.between(0.2, 0.6))
        }),
        30,
    );
    let mut draw = Draw(2);
    agree(
        "elastic with dashpot",
        (0..40).map(|_| {
            let soft = draw.between(1e3, 1e4);
            let mut scene = Scene::oscillator(1.0, 0.2, 100.0)
                .with_wall(Wall { law: elastic(soft, draw.between(0.0, 40.0)), ..Wall::upper("soft", 5e-3) })
                .with_wall(Wall::lower("hard", -6e-3).with_restitution(draw.between(0.2, 0.9)))
                // A stop inside the spring.
                .with_wall(Wall::upper("stop", 8e-3).with_restitution(draw.between(0.2, 0.9)))
                .with_load(Load::harmonic(3.0, draw.between(2.0, 8.0), 0.0));
            scene.initial = State { q: vec![draw.between(-4e-3, 4e-3)], v: vec![draw.between(-0.4, 0.4)] };
            (scene, draw.between(0.2, 0.6))
        }),
        30,
    );
}

fn elastic(stiffness: f64, damping: f64) -> signorini::WallLaw {
    signorini::WallLaw::Elastic { stiffness, damping }
}

#[test]
fn products_of_two_masses_are_differences_of_their_runs() {
    let mut draw = Draw(3);
    let mut start = |scene: &mut Scene| {
        scene.initial.q = vec![draw.between(-3e-3, 4e-3), draw.between(-3e-3, 4e-3)];
        scene.initial.v = vec![draw.between(-0.2, 0.2), draw.between(-0.2, 0.2)];
        draw.between(0.2, 0.8)
    };
    for restitution in [0.0, 0.3, 0.7] {
        agree(
            "two masses",
            (0..16).map(|_| {
                let mut scene = two_masses(restitution);
                let end = start(&mut scene);
                (scene, end)
            }),
            12,
        );
        // Walls at the other mass and between the two masses too, one of them with a dashpot.
        agree(
            "walls between masses",
            (0..16).map(|k| {
                let between = Row::new(vec![(0, 1.0), (1, -1.0)]);
                let spring = Wall { law: elastic(2e3, 4.0 * f64::from(k % 3)), ..Wall::lower("spring", -4e-3) };
                let mut scene = two_masses(restitution)
                    .with_wall(Wall::upper("between", 6e-3).with_restitution(restitution).at(between))
                    .with_wall(spring.at(Row::dof(0)));
                let end = start(&mut scene);
                (scene, end)
            }),
            10,
        );
    }
}

#[test]
fn areas_shrink_by_drag_and_restitution() {
    let mut draw = Draw(4);
    for _ in 0..50 {
        let (upper, lower) = (draw.between(0.2, 1.0), draw.between(0.2, 1.0));
        let (mass, damping) = (draw.between(0.5, 2.0), draw.between(0.0, 0.5));
        let scene = Scene::oscillator(mass, damping, 100.0)
            .with_wall(Wall::upper("upper", 5e-3).with_restitution(upper))
            .with_wall(Wall::lower("lower", -4e-3).with_restitution(lower))
            .with_load(Load::harmonic(3.0, draw.between(2.0, 8.0), 0.0));
        let mut variation = OscillatorVariation::new(&scene).unwrap();
        let mut stepper = Stepper::new(&scene, &Scheme::Event, 0.5).unwrap();
        // Step by step: the determinant of a long product is lost to rounding.
        while stepper.time() < 5.0 {
            let step = stepper.step().unwrap();
            let [[a, b], [c, d]] = variation.over(&step).unwrap();
            let mut expected = (-damping / mass * (step.end - step.start)).exp();
            for (e, _) in [upper, lower].iter().zip(step.jump).filter(|(_, p)| **p != 0.0) {
                expected *= if step.v[0] == 0.0 { 0.0 } else { e * e };
            }
            if matches!(step.path, Path::Exact(arc) if arc.is_rest()) {
                expected = 0.0;
            }
            // Of terms as large as the products a d and b c.
            assert!((a * d - b * c - expected).abs() < 1e-13 * (1.0 + (a * d).abs()), "{a} {b} {c} {d} {expected}");
        }
    }
}

#[test]
fn one_mass_as_a_structure_has_the_product_of_the_oscillator() {
    let mut draw = Draw(5);
    for _ in 0..20 {
        let e = draw.between(0.2, 0.9);
        let walls = |scene: Scene, weight: f64| {
            let at = Row::new(vec![(0, weight)]);
            let law = elastic(3e3 / weight.powi(2), 9.0 / weight.powi(2));
            let soft = Wall { law, ..Wall::lower("soft", -4e-3 * weight) };
            scene
                .with_wall(Wall::upper("hard", 5e-3 * weight).with_restitution(e).at(at.clone()))
                .with_wall(soft.at(at))
        };
        let frequency = draw.between(2.0, 8.0);
        let body = Scene::oscillator(1.0, 0.2, 100.0).with_load(Load::harmonic(3.0, frequency, 0.0));
        // Behind a lever of 2 the same walls make it a structure of one degree of freedom.
        let (state, line) = follow(&walls(body.clone(), 1.0), 0.7);
        let (lever, structure) = follow(&walls(body, 2.0), 0.7);
        assert!((state.q[0] - lever.q[0]).abs() < 1e-12);
        // Both runs have rounding errors of their own, grown as changes of the start grow.
        assert!((&line - &structure).amax() < 1e-9 * (1.0 + line.amax()), "{line} {structure}");
    }
}

#[test]
fn an_accumulation_of_impacts_converges_with_the_square_of_the_speed_at_which_it_is_cut() {
    let scene = two_masses(0.5);
    let (_, whole) = follow(&scene, 0.45);
    let mut errors = Vec::new();
    for least in [1e-3, 1e-4, 1e-5] {
        let mut product = Product::new(&scene).unwrap();
        let mut stepper = Stepper::new(&scene, &Scheme::Event, 0.45).unwrap();
        loop {
            let step = stepper.step().unwrap();
            product.observe(&step).unwrap();
            // The impact after this one brings it to rest.
            if step.jump[0] != 0.0 && step.v[1].abs() < least {
                break;
            }
        }
        let time = stepper.time();
        let mut cut = two_masses(0.0);
        cut.initial = stepper.state();
        cut.loads[0] = Load { at: Row::dof(1), ..Load::harmonic(3.0, 1.0, std::f64::consts::TAU * time) };
        let (_, rest) = follow(&cut, 0.45 - time);
        errors.push((rest * product.matrix() - &whole).amax() / whole.amax());
    }
    // Speeds fall by halves: the speed of the cut lies within a factor of 2 below the given one.
    assert!(errors[0] < 1e-2 && errors[1] < errors[0] / 20.0 && errors[2] < errors[1] / 20.0, "{errors:?}");
    assert!(errors[2] < 1e-6, "{errors:?}");
}

#[test]
fn walls_struck_together_have_no_derivative_unless_they_are_apart() {
    // Two equal oscillators, each with its wall; coupled by a spring they move as one, and strike
    // together.
    let pair = |coupling: f64, drag: f64, mass: f64| {
        let structure = Structure {
            mass: Symmetric::from_entries(2, [(0, 0, 1.0), (1, 0, mass), (1, 1, 1.0)]),
            damping: Symmetric::from_entries(2, [(0, 0, 0.2 + drag), (1, 0, -drag), (1, 1, 0.2 + drag)]),
            stiffness: Symmetric::from_entries(
                2,
                [(0, 0, 100.0 + coupling), (1, 0, -coupling), (1, 1, 100.0 + coupling)],
            ),
        };
        let mut scene = Scene::structure(structure).with_initial(&[0.0; 2], &[0.3; 2]);
        for dof in 0..2 {
            let name = ["first", "second"][dof];
            scene = scene
                .with_wall(Wall::upper(name, 5e-3).with_restitution(0.8).at(Row::dof(dof)))
                .with_load(Load { at: Row::dof(dof), ..Load::harmonic(3.0, 5.0, 0.0) });
        }
        scene
    };
    for (drag, mass) in [(0.1, 0.0), (0.0, 0.3)] {
        let scene = pair(20.0, drag, mass);
        let mut product = Product::new(&scene).unwrap();
        let mut stepper = Stepper::new(&scene, &Scheme::Event, 1.0).unwrap();
        let refused = loop {
            if let Err(refused) = product.observe(&stepper.step().unwrap()) {
                break refused;
            }
        };
        assert!(matches!(&refused, NoDerivative::Together { walls, .. } if walls == &["first", "second"]), "{refused}");
        assert!(refused.to_string().contains("\"first\" and \"second\""), "{refused}");
    }
    // Apart, each has the product of its own.
    let (_, both) = follow(&pair(0.0, 0.0, 0.0), 0.5);
    let mut single = source(5.0, 0.8);
    single.walls.truncate(1);
    single.initial.v = vec![0.3];
    let (_, one) = follow(&single, 0.5);
    for (row, column) in (0..4).flat_map(|row| (0..4).map(move |column| (row, column))) {
        let expected = if row % 2 == column % 2 { one[(row / 2, column / 2)] } else { 0.0 };
        assert!((both[(row, column)] - expected).abs() < 1e-9 * (1.0 + one.amax()), "{both} {one}");
    }
}

#[test]
fn a_scheme_on_a_grid_has_no_derivative() {
    let scene = source(5.0, 0.8);
    let mut stepper = Stepper::new(&scene, &Scheme::MoreauJean { theta: 0.5 }, 1e-3).unwrap();
    let refused = Product::new(&scene).unwrap().observe(&stepper.step().unwrap()).unwrap_err();
    assert!(matches!(refused, NoDerivative::Unresolved { .. }) && refused.to_string().contains("event"));
}

#[test]
fn exponents_of_the_symmetric_orbit_are_half_the_sum_of_drag_and_restitution() {
    // The orbit's multipliers are a complex pair (source oscillator, 5 Hz, e = 0.8), so both
    // exponents are (ln det)/2T; the sum of both is exact in every window of the orbit.
    let scene = source(5.0, 0.8);
    let mut stepper = Stepper::new(&scene, &Scheme::Event, 0.2).unwrap();
    let mut exponents = Exponents::new(&scene, 2, [100.0, 200.0]).unwrap();
    while stepper.time() < 200.0 * (1.0 - 1e-12) {
        exponents.observe(&stepper.step().unwrap()).unwrap();
    }
    let both = exponents.all();
    let known = -2.331_435_513_142_098;
    assert!((both[0].per_s + both[1].per_s - 2.0 * known).abs() < 1e-9 * known.abs(), "{both:?}");
    // The running mean swings like 1/t about the exact value, by the logarithm of a ratio of axes.
    assert!((both[0].per_s - known).abs() < 0.05, "{both:?}");

    // And of the multipliers themselves.
    let mut product = Product::new(&scene).unwrap();
    while stepper.time() < 200.2 * (1.0 - 1e-12) {
        product.observe(&stepper.step().unwrap()).unwrap();
    }
    let matrix = product.matrix();
    let exponent = matrix.determinant().ln() / (2.0 * 0.2);
    assert!((exponent - known).abs() < 1e-9 * known.abs(), "{exponent}");
    // 2 Re μ of the period map, as the closed form of the orbit has it.
    assert!((matrix.trace() - 2.0 * 0.241_955_282_238_606_5).abs() < 1e-8, "{}", matrix.trace());
}

#[test]
fn exponents_add_up_to_drag_and_restitution_on_any_attractor() {
    for (restitution, frequency) in [(0.9, 2.6), (0.8, 3.4), (0.95, 2.2), (0.7, 4.5)] {
        let scene = source(frequency, restitution);
        let period = 1.0 / frequency;
        let (from, to) = (100.0 * period, 600.0 * period);
        let mut exponents = Exponents::new(&scene, 2, [from, to]).unwrap();
        let mut stepper = Stepper::new(&scene, &Scheme::Event, period).unwrap();
        let (mut impacts, mut length, mut rests) = (0.0, 0.0, false);
        while stepper.time() < to * (1.0 - 1e-12) {
            let step = stepper.step().unwrap();
            exponents.observe(&step).unwrap();
            if step.start >= from {
                let struck = step.jump.iter().filter(|p| **p != 0.0).count();
                impacts += struck as f64;
                length += step.end - step.start;
                rests |= struck > 0 && step.v[0] == 0.0;
            }
        }
        let both = exponents.all();
        if rests {
            assert!(both[0].per_s == f64::NEG_INFINITY && both[0].error_per_s.is_none(), "{both:?}");
            continue;
        }
        let sum = -0.2 + 2.0 * restitution.ln() * impacts / length;
        // The smaller axis of a step of growth 1e3 is known to 1e-10 of it; 1e4 steps.
        assert!((both[0].per_s + both[1].per_s - sum).abs() < 1e-6, "{restitution} {frequency} {both:?} {sum}");
        let error = both[0].error_per_s.unwrap();
        assert!(error > 0.0 && error < 5.0, "{both:?}");
    }
}

#[test]
fn a_run_that_rests_has_an_exponent_of_minus_infinity() {
    // e = 0 at 1 Hz: it sticks to each wall once a period.
    let scene = source(1.0, 0.0);
    let mut exponents = Exponents::new(&scene, 1, [10.0, 20.0]).unwrap();
    let mut stepper = Stepper::new(&scene, &Scheme::Event, 1.0).unwrap();
    while stepper.time() < 20.0 {
        exponents.observe(&stepper.step().unwrap()).unwrap();
    }
    let largest = exponents.largest();
    assert_eq!((largest.per_s, largest.error_per_s), (f64::NEG_INFINITY, None));
}

/// A stretch of exact motion may begin before the window or end after it.
#[test]
fn a_window_has_the_exponent_of_the_parts_of_steps_in_it() {
    let largest = |scene: &Scene| {
        let mut exponents = Exponents::new(scene, 1, [3.0, 13.0]).unwrap();
        let mut stepper = Stepper::new(scene, &Scheme::Event, 20.0).unwrap();
        let mut steps = 0;
        while stepper.time() < 20.0 {
            exponents.observe(&stepper.step().unwrap()).unwrap();
            steps += 1;
        }
        (steps, exponents.largest().per_s)
    };
    let free = Scene::oscillator(1.0, 0.2, 100.0);
    // A change decays by c/2m, and its size swings by at most c/2mω = 0.01 in two stretches of 10
    // s.
    let (steps, exponent) = largest(&free);
    assert!(steps == 2 && (exponent + 0.1).abs() < 0.01 / 20.0, "{steps} {exponent}");
    let resting =
        free.with_wall(Wall::upper("stop", 5e-3)).with_initial(&[5e-3], &[0.0]).with_load(Load::constant(4.0));
    assert_eq!(largest(&resting).1, f64::NEG_INFINITY);
}

#[test]
fn exponents_without_walls_are_those_of_the_modes() {
    // C = 0.3 M + 0.002 K: each mode decays by half of 0.3 + 0.002 ω², twice.
    let (mass, stiffness) = ([2.0, 1.0], [[300.0, -100.0], [-100.0, 120.0]]);
    let damping = |i: usize, j: usize| 0.002 * stiffness[i][j] + if i == j { 0.3 * mass[i] } else { 0.0 };
    let symmetric = |of: &dyn Fn(usize, usize) -> f64| {
        Symmetric::from_entries(2, [(0, 0), (1, 0), (1, 1)].map(|(i, j)| (i, j, of(i, j))))
    };
    let structure = Structure {
        mass: Symmetric::diagonal(&mass),
        damping: symmetric(&damping),
        stiffness: symmetric(&|i, j| stiffness[i][j]),
    };
    let scene = Scene::structure(structure).with_initial(&[1e-3, 0.0], &[0.0, 0.0]);
    let mut exponents = Exponents::new(&scene, 4, [100.0, 400.0]).unwrap();
    let mut stepper = Stepper::new(&scene, &Scheme::Event, 1.0).unwrap();
    while stepper.time() < 400.0 {
        exponents.observe(&stepper.step().unwrap()).unwrap();
    }
    // ω² of K − ω² M.
    let (trace, product) = (150.0 + 120.0, 150.0 * 120.0 - 100.0 * 50.0);
    let root = f64::sqrt(trace * trace / 4.0 - product);
    for (k, exponent) in exponents.all().iter().enumerate() {
        let square = trace / 2.0 + if k < 2 { -root } else { root };
        let expected = -0.5 * (0.3 + 0.002 * square);
        // Of a pair the mean swings by the logarithm of a ratio of axes, of order 1, over 300 s.
        assert!((exponent.per_s - expected).abs() < 5e-3, "{k} {exponent:?} {expected}");
    }
}

#[test]
fn a_graze_grows_without_bound() {
    let s = saltation::impact(0.8, 1e-9, [-1.0, -1.0]);
    assert!(s[1][0] < -1e9);
    assert_eq!(saltation::entry(3.0, 2.0), [[1.0, 0.0], [-1.5, 1.0]]);
    assert_eq!(saltation::multiply(s, saltation::IDENTITY), s);
    assert_eq!(saltation::apply(saltation::REST, [1.0, 2.0]), [0.0, 0.0]);
}

#[test]
fn what_makes_no_exponents_is_refused() {
    let scene = source(5.0, 0.8);
    let text = |count, window| Exponents::new(&scene, count, window).unwrap_err().to_string();
    assert!(text(0, [0.0, 1.0]).contains("from 1 to 2"));
    assert!(text(3, [0.0, 1.0]).contains("from 1 to 2"));
    assert!(text(1, [1.0, 1.0]).contains("two times"));
    assert!(OscillatorVariation::new(&two_masses(0.5)).is_err());
}

#[test]
fn a_rest_before_the_window_does_not_end_the_growth_in_it() {
    // The body lies on the stop under 3 N until the load turns round; then it bounces between stop
    // and spring.
    let scene = source(5.0, 0.8);
    let mut held = scene.clone();
    let from = 40.0;
    held.loads.push(Load::table(Table::new(vec![0.0, 20.0], vec![1e2, 1e2]).unwrap()));
    let of = |scene: &Scene| {
        let mut stepper = Stepper::new(scene, &Scheme::Event, 0.2).unwrap();
        let mut exponents = Exponents::new(scene, 2, [from, 200.0]).unwrap();
        let mut rests = false;
        while stepper.time() < 200.0 * (1.0 - 1e-12) {
            let step = stepper.step().unwrap();
            exponents.observe(&step).unwrap();
            rests |= step.end < from && step.v == [0.0];
        }
        (exponents.all(), rests)
    };
    let ((free, false), (after, true)) = (of(&scene), of(&held)) else { panic!("one of them rests") };
    // Both end on the same orbit, with (ln det)/2T = −2.33 /s each; they reach it by other ways.
    let known = -2.331_435_513_142_098;
    for both in [free, after] {
        assert!((both[0].per_s + both[1].per_s - 2.0 * known).abs() < 0.01 * known.abs(), "{both:?}");
        assert!((both[0].per_s - known).abs() < 0.1, "{both:?}");
    }
}
