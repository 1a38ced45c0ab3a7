//! Chains, bars, tubes and matrices: statics against textbook solutions, exact at nodes; and every
//! misuse is reported.

use signorini::linear::{Factor, Symmetric};
use signorini::matrices::{TextError, read_csv, read_matrix_market};
use signorini::{Bar, BarEnd, Beam, BeamEnd, BeamSection, Chain, Damping, Error, MassMatrix, Row, Scene, Structure};

const FORCE: f64 = 100.0;

/// A steel tube of 2 m.
pub fn beam(elements: usize, left: BeamEnd, right: BeamEnd) -> Beam {
    Beam {
        length: 2.0,
        youngs_modulus: 2.0e11,
        density: 7850.0,
        section: BeamSection::Tube { outer_diameter: 0.01905, inner_diameter: 0.01575 },
        added_mass: 0.3,
        elements,
        left,
        right,
    }
}

/// A steel rod of 2 m.
fn bar(elements: usize, left: BarEnd, right: BarEnd) -> Bar {
    Bar {
        length: 2.0,
        area: 1e-4,
        youngs_modulus: 2e11,
        density: 7850.0,
        elements,
        left,
        right,
        mass: MassMatrix::Consistent,
    }
}

/// K⁻¹ Σ gᵀ F.
fn deflection(structure: &Structure, loads: &[(Row, f64)]) -> Vec<f64> {
    let mut x = vec![0.0; structure.mass.size()];
    for (row, force) in loads {
        row.entries().iter().for_each(|&(i, w)| x[i] += w * force);
    }
    Factor::new(&structure.stiffness).unwrap().solve(&mut x);
    x
}

/// Rounding of K⁻¹: its condition number is some 50 elements⁴ for a beam; the meshes here have 12
/// elements at most, so 1e6 · 2e-16 and a margin.
const ROUNDING: f64 = 1e-9;

#[track_caller]
fn near(found: f64, exact: f64) {
    assert!((found - exact).abs() <= ROUNDING * exact.abs(), "{found:e}, expected {exact:e}");
}

#[test]
fn a_pinned_tube_bends_as_the_textbook_says() {
    for elements in [2, 4, 12] {
        let tube = beam(elements, BeamEnd::Pinned, BeamEnd::Pinned);
        let (structure, l, ei) = (tube.structure().unwrap(), tube.length, tube.bending_stiffness());
        let centre = tube.at(1.0).unwrap();
        assert_eq!(centre.entries().len(), 1);
        near(centre.dot(&deflection(&structure, &[(centre.clone(), FORCE)])), FORCE * l.powi(3) / (48.0 * ei));
        // The resultant F of an even load, F/L per metre; and its half on the left half, which
        // bends the centre half as much.
        let whole = tube.spread(0.0, 2.0).unwrap();
        near(centre.dot(&deflection(&structure, &[(whole, FORCE)])), 5.0 * FORCE * l.powi(3) / (384.0 * ei));
        let half = tube.spread(0.0, 1.0).unwrap();
        near(centre.dot(&deflection(&structure, &[(half, FORCE)])), 5.0 * FORCE * l.powi(3) / (384.0 * ei));
    }
}

#[test]
fn a_force_between_nodes_is_carried_as_if_by_the_exact_line_at_the_nodes() {
    // Hermite elements with consistent loads are exact at the nodes wherever the force is: F at a,
    // seen at x < a, is F b x (L² − b² − x²)/6LEI.
    let tube = beam(4, BeamEnd::Pinned, BeamEnd::Pinned);
    let (structure, l, ei) = (tube.structure().unwrap(), tube.length, tube.bending_stiffness());
    let (a, x) = (1.37, 0.5);
    let b = l - a;
    let q = deflection(&structure, &[(tube.at(a).unwrap(), FORCE)]);
    near(tube.at(x).unwrap().dot(&q), FORCE * b * x * (l * l - b * b - x * x) / (6.0 * l * ei));
}

#[test]
fn a_support_takes_the_textbook_share_of_the_load() {
    // Two spans, a force in the middle of each: the middle support takes 11/8 F, the outer ones
    // 5/16 F each.
    let tube = beam(8, BeamEnd::Pinned, BeamEnd::Pinned);
    let structure = tube.structure().unwrap();
    let support = tube.at(1.0).unwrap();
    let free = deflection(&structure, &[(tube.at(0.5).unwrap(), FORCE), (tube.at(1.5).unwrap(), FORCE)]);
    let unit = deflection(&structure, &[(support.clone(), 1.0)]);
    let reaction = support.dot(&free) / support.dot(&unit);
    near(reaction, 11.0 / 8.0 * FORCE);
    near(0.5 * (2.0 * FORCE - reaction), 5.0 / 16.0 * FORCE);
    // Half way the deflection is 7 F l³/768 EI with l one span.
    let held =
        deflection(&structure, &[(tube.at(0.5).unwrap(), FORCE), (tube.at(1.5).unwrap(), FORCE), (support, -reaction)]);
    near(tube.at(0.5).unwrap().dot(&held), 7.0 * FORCE / (768.0 * tube.bending_stiffness()));
}

#[test]
fn a_cantilever_and_its_springs_bend_as_the_textbook_says() {
    let (k, rotational) = (3e4, 2e3);
    for (left, give, turn) in
        [(BeamEnd::Clamped, 0.0, 0.0), (BeamEnd::Sprung { stiffness: k, rotational }, 1.0 / k, 1.0 / rotational)]
    {
        let tube = beam(6, left, BeamEnd::Free);
        let (structure, l, ei) = (tube.structure().unwrap(), tube.length, tube.bending_stiffness());
        let tip = tube.at(l).unwrap();
        let q = deflection(&structure, &[(tip.clone(), FORCE)]);
        near(tip.dot(&q), FORCE * (l.powi(3) / (3.0 * ei) + give + l * l * turn));
        let x = l / 3.0;
        near(tube.at(x).unwrap().dot(&q), FORCE * (x * x * (3.0 * l - x) / (6.0 * ei) + give + l * x * turn));
    }
    // Mirrored, the same.
    let tube = beam(6, BeamEnd::Free, BeamEnd::Clamped);
    let tip = tube.at(0.0).unwrap();
    let q = deflection(&tube.structure().unwrap(), &[(tip.clone(), FORCE)]);
    near(tip.dot(&q), FORCE * tube.length.powi(3) / (3.0 * tube.bending_stiffness()));
}

#[test]
fn a_rectangular_cantilever_bends_by_its_width_and_the_cube_of_its_height() {
    let (width, height, l) = (0.05, 0.02, 2.0_f64);
    let section = BeamSection::Rectangle { width, height };
    let plank = Beam { section, added_mass: 0.0, ..beam(6, BeamEnd::Clamped, BeamEnd::Free) };
    let tip = plank.at(l).unwrap();
    let q = deflection(&plank.structure().unwrap(), &[(tip.clone(), FORCE)]);
    let i = width * height * height * height / 12.0;
    near(tip.dot(&q), FORCE * l.powi(3) / (3.0 * 2.0e11 * i));
    near(plank.mass_per_metre(), 7850.0 * width * height);
    assert_eq!([section.outer_diameter(), section.wall_thickness()], [None; 2]);
}

#[test]
fn a_bar_stretches_as_the_textbook_says() {
    let (l, ea, k) = (2.0, 2e7, 1e6);
    for elements in [1, 5, 12] {
        for (left, give) in [(BarEnd::Fixed, 0.0), (BarEnd::Sprung { stiffness: k }, 1.0 / k)] {
            let rod = bar(elements, left, BarEnd::Free);
            let structure = rod.structure().unwrap();
            let tip = rod.at(l).unwrap();
            near(tip.dot(&deflection(&structure, &[(tip.clone(), FORCE)])), FORCE * (l / ea + give));
            let spread = rod.spread(0.0, l).unwrap();
            near(tip.dot(&deflection(&structure, &[(spread, FORCE)])), FORCE * (l / (2.0 * ea) + give));
        }
    }
}

#[test]
fn rows_see_what_their_elements_can_hold() {
    let rod = bar(7, BarEnd::Free, BarEnd::Free);
    let tube = beam(7, BeamEnd::Free, BeamEnd::Free);
    let line = rod.field("field", &|x| 3.0 - 2.0 * x).unwrap();
    let cubic = |x: f64| [1.0 - x + 0.5 * x * x - 2.0 * x.powi(3), -1.0 + x - 6.0 * x * x];
    let curve = tube.field("field", &cubic).unwrap();
    for x in [0.0, 1e-3, 2.0 / 7.0, 0.77, 1.999, 2.0] {
        // A line and a cubic are in the elements' own spaces: rounding only.
        assert!((rod.at(x).unwrap().dot(&line) - (3.0 - 2.0 * x)).abs() < 1e-14);
        assert!((tube.at(x).unwrap().dot(&curve) - cubic(x)[0]).abs() < 1e-13);
    }
    // A spread force sees the mean: of the line at the centre of the stretch, of the cubic by its
    // integral.
    let integral = |x: f64| x - x * x / 2.0 + x.powi(3) / 6.0 - x.powi(4) / 2.0;
    for (from, to) in [(0.0, 2.0), (0.1, 0.15), (0.3, 1.9), (4.0 / 7.0, 6.0 / 7.0)] {
        let mean = 3.0 - (from + to);
        assert!((rod.spread(from, to).unwrap().dot(&line) - mean).abs() < 1e-13, "{from} {to}");
        let mean = (integral(to) - integral(from)) / (to - from);
        assert!((tube.spread(from, to).unwrap().dot(&curve) - mean).abs() < 1e-12, "{from} {to}");
    }
    // A held end has no displacement, so its row is empty.
    assert!(beam(3, BeamEnd::Pinned, BeamEnd::Free).at(0.0).unwrap().entries().is_empty());
    assert!(bar(3, BarEnd::Free, BarEnd::Fixed).at(2.0).unwrap().entries().is_empty());
}

#[test]
fn masses_are_those_of_rigid_motions() {
    let tube = beam(9, BeamEnd::Free, BeamEnd::Free);
    let (structure, m, l) = (tube.structure().unwrap(), tube.mass_per_metre(), tube.length);
    let area = std::f64::consts::PI / 4.0 * (0.01905_f64.powi(2) - 0.01575_f64.powi(2));
    near(m, 7850.0 * area + 0.3);
    let slide = tube.field("field", &|_| [1.0, 0.0]).unwrap();
    let turn = tube.field("field", &|x| [x, 1.0]).unwrap();
    near(structure.mass.form(&slide, &slide), m * l);
    near(structure.mass.form(&slide, &turn), m * l * l / 2.0);
    near(structure.mass.form(&turn, &turn), m * l.powi(3) / 3.0);
    assert_eq!(structure.mass.half_bandwidth(), 3);
    for mass in [MassMatrix::Consistent, MassMatrix::Lumped] {
        let rod = Bar { mass, ..bar(9, BarEnd::Free, BarEnd::Free) };
        let structure = rod.structure().unwrap();
        near(structure.mass.form(&[1.0; 10], &[1.0; 10]), 7850.0 * 1e-4 * 2.0);
        assert_eq!(structure.mass.half_bandwidth(), usize::from(mass == MassMatrix::Consistent));
    }
}

#[test]
fn the_smoothest_curve_through_points_is_the_bent_tube() {
    // A force in the middle bends a clamped tube into two cubics: the spline through three points
    // with slope 0 at the ends. With one end pinned, the same with its moment 0.
    for ends in
        [[BeamEnd::Clamped, BeamEnd::Clamped], [BeamEnd::Clamped, BeamEnd::Pinned], [BeamEnd::Pinned, BeamEnd::Pinned]]
    {
        let tube = beam(8, ends[0], ends[1]);
        let centre = tube.at(1.0).unwrap();
        let q = deflection(&tube.structure().unwrap(), &[(centre.clone(), FORCE)]);
        let points = [(0.0, 0.0), (1.0, centre.dot(&q)), (2.0, 0.0)];
        let spline = tube.field_through("initial.displacement", &points).unwrap();
        let largest = q.iter().fold(0.0_f64, |a, x| a.max(x.abs()));
        assert!(q.iter().zip(&spline).all(|(a, b)| (a - b).abs() < ROUNDING * largest), "{q:?} {spline:?}");
    }
    // A bar takes points linearly: pressed evenly from its free end.
    let rod = bar(4, BarEnd::Free, BarEnd::Fixed);
    let q = rod.field_through("initial.displacement", &[(0.0, 0.5), (2.0, 0.0)]).unwrap();
    assert_eq!(q, [0.5, 0.375, 0.25, 0.125]);
    let kinked = rod.field_through("initial.displacement", &[(0.0, 1.0), (0.5, 0.0), (2.0, 0.0)]).unwrap();
    assert_eq!(kinked, [1.0, 0.0, 0.0, 0.0]);
}

#[test]
fn a_chain_is_its_matrices() {
    let chain = Chain { masses: vec![1.0, 2.0, 3.0], springs: vec![10.0, 20.0], grounds: [5.0, 0.0] };
    let structure = chain.structure().unwrap();
    assert_eq!(structure.mass, Symmetric::diagonal(&[1.0, 2.0, 3.0]));
    let entries = [(0, 0, 15.0), (1, 1, 30.0), (2, 2, 20.0), (1, 0, -10.0), (2, 1, -20.0)];
    assert_eq!(structure.stiffness, Symmetric::from_entries(3, entries));
    assert_eq!(structure.damping, Symmetric::zeros(3));
    let one = Chain { masses: vec![2.0], springs: vec![], grounds: [3.0, 4.0] }.structure().unwrap();
    assert_eq!(one.stiffness.get(0, 0), 7.0);
    let damped = structure.clone().with_damping(&Damping::Rayleigh { mass: 0.5, stiffness: 0.1 }).unwrap();
    assert_eq!(damped.damping.get(1, 0), -1.0);
    assert_eq!(damped.damping.get(2, 2), 3.5);
}

#[track_caller]
fn refused<T: std::fmt::Debug>(result: Result<T, Error>, key: &str, said: &str) {
    match result.unwrap_err() {
        Error::Invalid { subject: found, value, expected } => {
            assert_eq!(found.to_string(), key);
            let text = format!("{value}; {expected}");
            assert!(text.contains(said), "{text:?} does not say {said:?}");
        }
        other => panic!("{other:?}"),
    }
}

#[test]
fn values_that_make_no_structure_are_refused_by_name() {
    let chain = |masses: &[f64], springs: &[f64], grounds| {
        Chain { masses: masses.to_vec(), springs: springs.to_vec(), grounds }.structure()
    };
    refused(chain(&[], &[], [0.0; 2]), "chain: masses", "one mass or more");
    refused(chain(&[1.0, 0.0], &[1.0], [0.0; 2]), "chain: masses: value 2", "above 0");
    refused(chain(&[1.0, 1.0], &[], [0.0; 2]), "chain: springs", "1, one between");
    refused(chain(&[1.0, 1.0], &[-1.0], [0.0; 2]), "chain: springs: value 1", "0 or more");
    refused(chain(&[1.0], &[], [0.0, f64::NAN]), "chain: grounds: value 2", "NaN");

    let good = bar(3, BarEnd::Fixed, BarEnd::Free);
    let wrong = |change: &dyn Fn(&mut Bar), key: &str, said: &str| {
        let mut rod = good.clone();
        change(&mut rod);
        refused(rod.structure(), key, said);
        refused(rod.at(0.5), key, said);
        refused(rod.spread(0.0, 1.0), key, said);
    };
    wrong(&|b| b.length = 0.0, "bar: length", "above 0");
    wrong(&|b| b.area = -1.0, "bar: area", "above 0");
    wrong(&|b| b.youngs_modulus = f64::INFINITY, "bar: youngs_modulus", "finite");
    wrong(&|b| b.density = f64::NAN, "bar: density", "finite");
    wrong(&|b| b.elements = 0, "bar: elements", "from 1 to 100000");
    wrong(&|b| b.elements = usize::MAX, "bar: elements", "from 1 to 100000");
    wrong(&|b| b.right = BarEnd::Sprung { stiffness: -2.0 }, "bar: right: stiffness", "0 or more");
    wrong(&|b| (b.elements, b.right) = (1, BarEnd::Fixed), "bar: elements", "2 or more");

    let good = beam(3, BeamEnd::Clamped, BeamEnd::Free);
    let wrong = |change: &dyn Fn(&mut Beam), key: &str, said: &str| {
        let mut tube = good.clone();
        change(&mut tube);
        refused(tube.structure(), key, said);
        refused(tube.at(0.5), key, said);
        refused(tube.spread(0.0, 1.0), key, said);
    };
    let tube = |outer_diameter, inner_diameter| BeamSection::Tube { outer_diameter, inner_diameter };
    let rectangle = |width, height| BeamSection::Rectangle { width, height };
    for side in [0.0, -0.01, f64::NAN, f64::INFINITY] {
        wrong(&|b| b.section = rectangle(side, 0.02), "beam: width", "finite number above 0");
        wrong(&|b| b.section = rectangle(0.05, side), "beam: height", "finite number above 0");
    }
    wrong(&|b| b.length = -1.0, "beam: length", "above 0");
    wrong(&|b| b.youngs_modulus = 0.0, "beam: youngs_modulus", "above 0");
    wrong(&|b| b.density = 0.0, "beam: density", "above 0");
    wrong(&|b| b.section = tube(f64::NAN, 0.0), "beam: outer_diameter", "finite");
    wrong(&|b| b.section = tube(0.01905, 0.01905), "beam: inner_diameter", "less than the outer diameter, 0.01905 m");
    wrong(&|b| b.added_mass = -0.1, "beam: added_mass", "0 or more");
    wrong(&|b| b.elements = 1_000_000_000, "beam: elements", "from 1 to 100000");
    let sprung = |stiffness, rotational| BeamEnd::Sprung { stiffness, rotational };
    wrong(&|b| b.left = sprung(-1.0, 0.0), "beam: left: stiffness", "0 or more");
    wrong(&|b| b.right = sprung(0.0, f64::NAN), "beam: right: rotational", "0 or more");
    wrong(&|b| (b.elements, b.right) = (1, BeamEnd::Clamped), "beam: elements", "2 or more");

    for position in [-0.1, 2.1, f64::NAN, f64::INFINITY] {
        refused(good.at(position), "position", "from 0 to 2.0 m");
    }
    refused(good.spread(-1.0, 1.0), "from", "from 0 to 2.0 m");
    refused(good.spread(0.0, 3.0), "to", "from 0 to 2.0 m");
    refused(good.spread(1.0, 1.0), "to", "more than the start");
    refused(good.spread(1.0, 0.5), "to", "more than the start");

    refused(good.field("initial.velocity", &|x| [x - 1.0, 1.0]), "initial.velocity", "0 at an end that is held");
    refused(good.field("initial.velocity", &|x| [x, 1.0]), "initial.velocity", "slope 0 at an end that is clamped");
    refused(good.field("initial.velocity", &|x| [1.0 / x, 1.0]), "initial.velocity", "finite");
    for (points, said) in [
        (vec![(0.0, 0.0)], "two points or more"),
        (vec![(0.0, 0.0), (1.0, 1.0)], "from 0 to 2.0 m"),
        (vec![(0.0, 0.0), (1.5, 1.0), (1.5, 2.0), (2.0, 0.0)], "1.5 after 1.5"),
        (vec![(0.0, 0.0), (1.5, f64::NAN), (2.0, 0.0)], "finite numbers"),
        (vec![(0.0, 0.1), (2.0, 0.0)], "0 at an end that is held"),
    ] {
        refused(good.field_through("initial.displacement", &points), "initial.displacement", said);
    }
}

#[test]
fn damping_that_makes_no_sense_is_refused_by_name() {
    let structure = Chain { masses: vec![1.0; 3], springs: vec![1.0; 2], grounds: [0.0; 2] }.structure().unwrap();
    let with = |damping| structure.clone().with_damping(&damping);
    refused(with(Damping::Rayleigh { mass: -1.0, stiffness: 0.0 }), "damping: mass", "0 or more");
    refused(with(Damping::Rayleigh { mass: 0.0, stiffness: f64::NAN }), "damping: stiffness", "0 or more");
    refused(with(Damping::Modal(vec![])), "damping: ratios", "one ratio or more");
    refused(with(Damping::Modal(vec![0.1, -0.1])), "damping: ratios: value 2", "0 or more");
    refused(with(Damping::Matrix(Symmetric::zeros(2))), "damping: matrix", "3 × 3");
    let long = Chain { masses: vec![1.0; 601], springs: vec![1.0; 600], grounds: [0.0; 2] }.structure().unwrap();
    refused(long.with_damping(&Damping::Modal(vec![0.1])), "damping: ratios", "at most 600");
    assert_eq!(with(Damping::None).unwrap(), structure);
}

#[test]
fn modal_damping_brakes_each_mode_and_no_rigid_motion() {
    let plain =
        Chain { masses: vec![1.0, 2.0, 1.5], springs: vec![100.0, 50.0], grounds: [0.0; 2] }.structure().unwrap();
    let structure = plain.clone().with_damping(&Damping::Modal(vec![0.03])).unwrap();
    let mut product = vec![0.0; 3];
    structure.damping.add_product(1.0, &[1.0; 3], &mut product);
    // Sliding is no mode of the springs: rounding of entries of about 1 N s/m.
    assert!(product.iter().all(|x| x.abs() < 1e-14), "{product:?}");
    // C M⁻¹ C = 4ζ² K for equal ratios: (2ζΩ)² in modal coordinates.
    for (i, j) in [(0, 0), (1, 0), (2, 0), (1, 1), (2, 1), (2, 2)] {
        let square: f64 =
            (0..3).map(|k| structure.damping.get(i, k) * structure.damping.get(k, j) / plain.mass.get(k, k)).sum();
        assert!((square - 4.0 * 0.03_f64.powi(2) * plain.stiffness.get(i, j)).abs() < 1e-13, "{i} {j}");
    }
    Scene::structure(structure).validate().unwrap();
}

#[test]
fn matrices_that_are_not_definite_are_refused_with_their_entry() {
    let check = |mass: Symmetric, stiffness: Symmetric, key: &str, said: &str| {
        let n = mass.size();
        let scene = Scene::structure(Structure { mass, damping: Symmetric::zeros(n), stiffness });
        refused(scene.validate(), key, said);
    };
    let unit = || Symmetric::diagonal(&[1.0; 3]);
    check(Symmetric::diagonal(&[1.0, 0.0, 1.0]), unit(), "system: mass matrix, row 2, column 2", "more than 0");
    check(Symmetric::diagonal(&[1.0, 1.0, -1.0]), unit(), "system: mass matrix, row 3, column 3", "more than 0");
    let coupled = |x: f64| Symmetric::sum(&[(1.0, &unit()), (1.0, &Symmetric::from_entries(3, [(2, 0, x)]))]);
    check(coupled(1.0), unit(), "system: mass matrix, row 3, column 1", "less than 1.0");
    check(unit(), coupled(-1.1), "system: stiffness matrix, row 3, column 1", "at most 1.0");
    check(unit(), Symmetric::diagonal(&[1.0, -1e-6, 1.0]), "system: stiffness matrix, row 2, column 2", "0 or more");
    check(
        unit(),
        Symmetric::from_entries(3, [(1, 0, 1e-3)]),
        "system: stiffness matrix, row 2, column 1",
        "at most 0.0",
    );
    // No pair of entries shows that it is indefinite: three masses that pull one another.
    let all =
        |x: f64| Symmetric::from_entries(3, [(0, 0, 1.0), (1, 1, 1.0), (2, 2, 1.0), (1, 0, x), (2, 1, x), (2, 0, x)]);
    check(unit(), all(-0.6), "system: stiffness matrix, row 3, column 3", "negative pivot");
    check(all(-0.6), unit(), "system: mass matrix, row 3, column 3", "without a positive pivot");
    check(unit(), Symmetric::zeros(2), "system: stiffness matrix", "3 × 3");
    check(unit(), Symmetric::diagonal(&[1.0, f64::NAN, 1.0]), "system: stiffness matrix, row 2, column 2", "finite");
    // The limit is semidefinite, and accepted.
    let edge = Structure { mass: unit(), damping: Symmetric::zeros(3), stiffness: all(-0.5) };
    Scene::structure(edge).validate().unwrap();
}

/// The text of a matrix in each format.
fn written(matrix: &Symmetric) -> Vec<(&'static str, String)> {
    let n = matrix.size();
    let all: Vec<(usize, usize)> = (0..n).flat_map(|i| (0..n).map(move |j| (i, j))).collect();
    let stored = all.iter().filter(|&&(i, j)| matrix.get(i, j) != 0.0);
    let lower: Vec<_> = stored.clone().filter(|&&(i, j)| j <= i).collect();
    let triplets = |places: Vec<&(usize, usize)>| {
        let line = |&&(i, j): &&(usize, usize)| format!("{} {} {:e}\n", i + 1, j + 1, matrix.get(i, j));
        format!("% a remark\n{n} {n} {}\n{}", places.len(), places.iter().map(line).collect::<String>())
    };
    let column = |half: bool| {
        let values = (0..n).flat_map(|j| (if half { j } else { 0 }..n).map(move |i| (i, j)));
        format!("{n} {n}\n{}", values.map(|(i, j)| format!("{:?}\n", matrix.get(i, j))).collect::<String>())
    };
    let row = |i: usize| (0..n).map(|j| format!("{:?}", matrix.get(i, j))).collect::<Vec<_>>().join(", ");
    vec![
        ("mm", format!("%%MatrixMarket matrix coordinate real symmetric\n{}", triplets(lower))),
        ("mm", format!("%%matrixmarket MATRIX Coordinate Real General\r\n{}", triplets(stored.collect()))),
        ("mm", format!("%%MatrixMarket matrix array real symmetric\n{}", column(true))),
        ("mm", format!("\u{feff}%%MatrixMarket matrix array real general\n\n{}", column(false))),
        ("csv", (0..n).map(|i| row(i) + "\r\n").collect()),
        ("csv", format!("\u{feff}\n{}", (0..n).map(row).collect::<Vec<_>>().join("\n"))),
    ]
}

fn read(format: &str, text: &str) -> Result<Symmetric, TextError> {
    if format == "mm" { read_matrix_market(text) } else { read_csv(text) }
}

#[test]
fn matrices_come_back_from_every_format() {
    let beam = beam(3, BeamEnd::Clamped, BeamEnd::Free).structure().unwrap();
    let small = Symmetric::diagonal(&[0.1]);
    for matrix in [&beam.stiffness, &beam.mass, &small] {
        for (format, text) in written(matrix) {
            let back = read(format, &text).unwrap();
            assert_eq!(back.size(), matrix.size());
            for (i, j, value) in matrix.entries() {
                // {:e} and {:?} write the shortest digits that read back the same.
                assert_eq!(back.get(i, j), value, "{format} {i} {j}");
            }
        }
    }
    let whole = read_matrix_market("%%MatrixMarket matrix array integer general\n2 2\n2\n-1\n-1\n2\n").unwrap();
    assert_eq!(whole, Symmetric::from_entries(2, [(0, 0, 2.0), (1, 1, 2.0), (1, 0, -1.0)]));
    // Rounding across the diagonal is no asymmetry, even where the entry itself is rounding.
    let nearly = read_csv("1, 1e-17\n3e-17, 1\n").unwrap();
    assert_eq!(nearly.get(1, 0), 2e-17);
}

#[test]
fn matrices_that_cannot_be_read_are_refused_with_their_line() {
    const C: &str = "%%MatrixMarket matrix coordinate real general\n";
    const S: &str = "%%MatrixMarket matrix coordinate real symmetric\n";
    const A: &str = "%%MatrixMarket matrix array real general\n";
    let cases: Vec<(&str, String, usize, &str, &str)> = vec![
        ("mm", String::new(), 1, "an empty text", ""),
        ("mm", "2 2 1\n1 1 1\n".into(), 1, "no header", "2 2 1"),
        ("mm", "%%MatrixMarket tensor coordinate real general\n".into(), 1, "tensor", ""),
        ("mm", "%%MatrixMarket matrix sparse real general\n".into(), 1, "sparse", "sparse"),
        ("mm", "%%MatrixMarket matrix coordinate complex general\n".into(), 1, "real or integer", "complex"),
        ("mm", "%%MatrixMarket matrix coordinate pattern general\n".into(), 1, "real or integer", "pattern"),
        ("mm", "%%MatrixMarket matrix coordinate real skew-symmetric\n".into(), 1, "symmetric", "skew-symmetric"),
        ("mm", format!("{C}% nothing\n"), 2, "no line of sizes", ""),
        ("mm", format!("{C}2 2\n"), 2, "3 whole numbers", "2 2"),
        ("mm", format!("{C}2 x 2\n"), 2, "\"x\" is no whole number", "x"),
        ("mm", format!("{C}2 -2 2\n"), 2, "no whole number", "-2"),
        ("mm", format!("{C}2 3 2\n"), 2, "2 × 3", "2 3 2"),
        ("mm", format!("{C}0 0 0\n"), 2, "1 × 1 or more", ""),
        ("mm", format!("{C}1000000000000 1000000000000 1\n1 1 1\n"), 2, "at most 200000 rows", ""),
        ("mm", format!("{C}10 10 99999999999999\n1 1 1\n"), 2, "at most 4000000", ""),
        ("mm", format!("{C}99999999999999999999 1 1\n"), 2, "no whole number", ""),
        ("mm", format!("{A}100000 100000\n1\n"), 2, "10000000000 entries", ""),
        ("mm", format!("{C}2 2 2\n1 1 1\n"), 3, "1 entries of 2", ""),
        ("mm", format!("{C}2 2 1\n1 1 1\n2 2 1\n"), 4, "after the last of 1", "2 2 1"),
        ("mm", format!("{C}2 2 1\n1 1\n"), 3, "2 values", "1 1"),
        ("mm", format!("{C}2 2 1\n3 1 1\n"), 3, "\"3\" is no row or column", "3"),
        ("mm", format!("{C}2 2 1\n1 0 1\n"), 3, "\"0\" is no row or column", "0"),
        ("mm", format!("{C}2 2 1\n1 1 nan\n"), 3, "no finite number", "nan"),
        ("mm", format!("{C}2 2 1\n1 1 1e999\n"), 3, "no finite number", "1e999"),
        ("mm", format!("{C}2 2 3\n1 1 1\n2 2 1\n2 1 5\n"), 5, "entry across the diagonal is missing", "2 1 5"),
        (
            "mm",
            format!("{C}2 2 4\n1 1 1\n2 1 5\n\n1 2 5.1\n2 2 1\n"),
            6,
            "5.0 as across the diagonal, on line 4",
            "1 2 5.1",
        ),
        ("mm", format!("{C}2 2 3\n1 1 1\n2 2 1\n1 1 2\n"), 5, "row 1, column 1 comes a second time", "1 1 2"),
        ("mm", format!("{C}2 2 4\n1 1 1\n2 1 5\n2 1 5\n1 2 5\n"), 5, "row 2, column 1 comes a second time", "2 1 5"),
        ("mm", format!("{C}2 2 4\n1 1 1\n2 1 5\n1 2 5\n2 1 5\n"), 6, "row 2, column 1 comes a second time", "2 1 5"),
        ("mm", format!("{S}2 2 4\n1 1 1\n2 1 5\n1 2 5\n2 2 1\n"), 5, "row 1, column 2 comes a second time", "1 2 5"),
        ("mm", format!("{A}2 2\n1\n2\n3\n1\n"), 5, "row 1, column 2 is 3.0", "3"),
        ("mm", format!("{A}2 2\n1\n2 2\n"), 4, "no finite number", "2 2"),
        ("mm", format!("{A}2 2\n1\n2\n2\n"), 5, "3 entries of 4", ""),
        ("csv", String::new(), 1, "0 rows", ""),
        ("csv", "u1,u2\n1,0\n0,1\n".into(), 1, "\"u1\" is no finite number", "u1"),
        ("csv", "1,0\n0,inf\n".into(), 2, "no finite number", "inf"),
        ("csv", "1,0\n0;1\n".into(), 2, "1 values in row 2", "0;1"),
        ("csv", "1,0\n0,1,2\n".into(), 2, "3 values in row 2", "0,1,2"),
        ("csv", "1,0\n\n0,\n".into(), 3, "\"\" is no finite number", ""),
        ("csv", "1,0,2\n0,1,3\n".into(), 2, "2 rows of 3 values", ""),
        ("csv", "1,0\n0,1\n0,1\n".into(), 3, "row 3 of a matrix of 2 columns", "0,1"),
        ("csv", "1,2\n3,1\n".into(), 2, "row 2, column 1 is 3.0", "3,1"),
        ("csv", format!("1{}\n", ",1".repeat(3000)), 1, "at most 2000", ""),
    ];
    for (format, text, line, said, place) in cases {
        let error = read(format, &text).unwrap_err();
        assert_eq!(error.line, line, "{text:?}: {error}");
        assert!(error.to_string().contains(said), "{error} does not say {said:?}");
        let meant = &text[error.span.clone()];
        assert!(place.is_empty() || meant == place, "{text:?}: {meant:?} at {:?}", error.span);
        assert_eq!(text[..error.span.start].matches('\n').count() + 1, line, "{text:?}: {:?}", error.span);
    }
}
