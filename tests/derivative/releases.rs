//! Rests that end as the force on them vanishes: their ends, and what follows, against central
//! differences of exact runs.
//!
//! Where a rest ends the structure has a speed of rounding size, which differs from scene to scene.
//! What the exact scheme does with it must not show in the derivatives.

use signorini::linear::Symmetric;
use signorini::study::derivatives::Derivatives;
use signorini::variation::{NoDerivative, SceneTangent};
use signorini::{Load, Options, PlaneRows, Result, Row, Scene, Scheme, Structure, Wall, run};

/// Compares end, departure speed and impulse of all contacts with central differences of fourth
/// order over steps of `step` times the value. Returns the number of lasting contacts.
///
/// A run is exact to about 1e-14 s, so that the differences of instants are to 1e-14/(1e-4 ·
/// value), some 1e-10 where the derivatives are 1e-3; their own error is the fourth power of the
/// step. `WITHIN` of the largest derivative of its kind is thirty times as much, or of 1e-3 where
/// all are 0: the speeds of rests that end.
fn check(name: &str, build: &dyn Fn(f64) -> Result<Scene>, value: f64) -> usize {
    const WITHIN: f64 = 3e-6;
    let tangent = SceneTangent::new(name, value, build).expect("a tangent");
    let found = |x: f64| Derivatives::new(&build(x).unwrap(), std::slice::from_ref(&tangent), &[]).expect("a run");
    let own = found(value);
    assert!(own.ended.is_none(), "{name}: {:?}", own.ended);
    let h = 1e-4 * value;
    let others = [1.0, -1.0, 2.0, -2.0].map(|k| found(value + k * h));
    assert!(others.iter().all(|other| other.contacts.len() == own.contacts.len()), "{name}: other contacts");
    let numbers = |of: &Derivatives, index: usize| {
        let contact = *of.contacts.get(index).expect("a contact").contact;
        [contact.end.expect("an end"), contact.departure_speed.expect("an end"), contact.impulse]
    };
    let mut rows = Vec::new();
    for (index, contact) in own.contacts.iter().enumerate() {
        let [a, b, c, d] = others.each_ref().map(|other| numbers(other, index));
        let difference = |i: usize| (8.0 * (a[i] - b[i]) - (c[i] - d[i])) / (12.0 * h);
        rows.push((
            [contact.end_by[0], contact.departure_speed_by[0], contact.impulse_by[0]],
            [0, 1, 2].map(difference),
        ));
    }
    for (i, kind) in ["end", "departure speed", "impulse"].into_iter().enumerate() {
        let size = rows.iter().fold(1e-3, |most: f64, row| most.max(row.1[i].abs()));
        for (number, (ours, differences)) in rows.iter().enumerate() {
            let error = (ours[i] - differences[i]).abs();
            assert!(error <= WITHIN * size, "{name}: {kind} {number}: {} and {}", ours[i], differences[i]);
        }
    }
    own.contacts.iter().filter(|one| one.contact.end.is_some_and(|end| end > one.contact.start)).count()
}

/// Two masses in a row on the ground; the second is pressed against a stop without restitution.
fn pair(amplitude: f64, frequency: f64) -> Scene {
    let masses = [0.9785223298915116, 1.4100121232239804];
    let (left, spring, drag) = (174.29668897079426, 87.26175491684037, 0.4776406188446334);
    let structure = Structure {
        mass: Symmetric::diagonal(&masses),
        damping: Symmetric::diagonal(&masses.map(|m| drag * m)),
        stiffness: Symmetric::from_entries(2, [(0, 0, left + spring), (1, 0, -spring), (1, 1, spring)]),
    };
    Scene::structure(structure)
        .with_wall(Wall::upper("stop", 0.0010475586035714709).with_restitution(0.0).at(Row::dof(1)))
        .with_load(Load { at: Row::dof(0), ..Load::harmonic(amplitude, frequency, 4.42900142503639) })
        .with_load(Load { at: Row::dof(0), ..Load::constant(0.5580642558094722) })
        .with_duration(2.2)
}

#[test]
fn a_rest_has_the_derivative_of_its_end_whatever_rounding_leaves_of_its_speed() {
    let amplitude = 3.3471978023161557;
    let mut rests = 0;
    for frequency in [1.5, 1.58, 1.66, 1.74, 1.82, 1.9, 2.0, 2.08, 2.16, 2.24] {
        rests += check(&format!("{frequency} Hz"), &|x| Ok(pair(x, frequency)), amplitude);
    }
    assert!(rests >= 20, "{rests} lasting contacts");
}

/// Masses that are tied to each other and to the ground by strong dashpots, and by weak springs to
/// the ground: `drags` are the dashpots, the first to the ground.
fn dragged(masses: &[f64], drags: &[f64], ratio: f64) -> Structure {
    let n = masses.len();
    let next = |i: usize| drags.get(i + 1).copied().unwrap_or(0.0);
    let diagonal = (0..n).map(|i| (i, i, drags[i] + next(i)));
    Structure {
        mass: Symmetric::diagonal(masses),
        damping: Symmetric::from_entries(n, diagonal.chain((1..n).map(|i| (i, i - 1, -drags[i])))),
        stiffness: Symmetric::diagonal(&masses.iter().map(|m| ratio * m).collect::<Vec<f64>>()),
    }
}

#[test]
fn a_rest_whose_end_the_scheme_tells_a_step_later_has_its_derivative() {
    let build = |amplitude: f64| {
        let structure = dragged(
            &[0.9785223298915116, 1.4100121232239804],
            &[174.29668897079426, 87.26175491684037],
            0.4776406188446334,
        );
        let between = Row::new(vec![(0, 1.0), (1, -1.0)]);
        Ok(Scene::structure(structure)
            .with_wall(Wall::lower("between", -0.005960650725477818).with_restitution(0.93).at(between))
            .with_wall(Wall::lower("first", -0.003902228099351667).with_restitution(0.9).at(Row::dof(0)))
            .with_wall(Wall::upper("second", 0.0010475586035714709).with_restitution(0.0).at(Row::dof(1)))
            .with_load(Load { at: Row::dof(0), ..Load::harmonic(amplitude, 2.286431417764158, 4.42900142503639) })
            .with_load(Load { at: Row::dof(0), ..Load::constant(0.5580642558094722) })
            .with_duration(1.5))
    };
    assert_eq!(check("amplitude", &build, 3.3471978023161557), 3);
}

#[test]
fn a_body_that_is_just_released_does_not_graze() {
    // The rest at "third" ends 5e-5 s before that at "first"; the gap is 3e-14 m then.
    let build = |amplitude: f64| {
        let structure = dragged(
            &[1.0042628865706207, 1.0441854331668425, 1.2801186885673534, 0.8026020244749643],
            &[80.31746144303958, 169.5278396295632, 162.61609017532626, 148.9305105802167],
            0.18043452247438463,
        );
        Ok(Scene::structure(structure)
            .with_wall(
                Wall::lower("second", -0.004014182240148179).with_elasticity(547.44287704584, 0.0).at(Row::dof(1)),
            )
            .with_wall(Wall::lower("first", -0.0014262944882426605).with_restitution(0.0).at(Row::dof(0)))
            .with_wall(Wall::lower("third", -0.00565453881449196).with_restitution(0.0).at(Row::dof(2)))
            .with_load(Load { at: Row::dof(1), ..Load::harmonic(amplitude, 1.4098974378519231, 2.90696441907245) })
            .with_duration(1.5))
    };
    assert_eq!(check("amplitude", &build, 4.151356356527039), 3);
}

#[test]
fn a_body_that_comes_back_to_the_wall_without_speed_grazes_it() {
    // A wall without restitution stops the body, the spring draws it off, and it returns after a
    // period: 2π/10 s.
    let scene = |gap: f64| {
        let stop = Wall::upper("stop", gap).with_restitution(0.0);
        Ok(Scene::oscillator(1.0, 0.0, 100.0).with_wall(stop).with_initial(&[0.0], &[0.1]).with_duration(1.0))
    };
    let tangent = SceneTangent::new("gap", 5e-3, scene).expect("a tangent");
    let found = Derivatives::new(&scene(5e-3).unwrap(), &[tangent], &[]).expect("a run");
    let first = found.contacts.get(0).expect("an impact").contact.start;
    let Some(NoDerivative::Graze { time, wall }) = found.ended else { panic!("{:?}", found.ended) };
    let expected = first + std::f64::consts::TAU / 10.0;
    // Where the speed is 0 the instant is known to the root of rounding: ε^½ of the time.
    assert!(wall == "stop" && (time - expected).abs() < 1e-7, "{time} and {expected}");
}

/// A body in two planes in the corner of two oblique walls, in which its impacts accumulate to rest
/// at both; under a sine of this amplitude along them.
fn corner(amplitude: f64) -> Result<Scene> {
    let way = |degrees: f64| PlaneRows::doubled(&Row::dof(0), 1).along(degrees);
    let [mass, damping, stiffness] = [1.0, 1.0, 100.0].map(|x| Symmetric::diagonal(&[x, x]));
    let load = Load { at: way(18.24773691113187), ..Load::harmonic(amplitude, 2.0, 0.0) };
    Ok(Scene::structure(Structure { mass, damping, stiffness })
        .with_wall(Wall::upper("a", 2e-3).at(way(0.0)).with_restitution(0.0))
        .with_wall(Wall::upper("b", 2e-3).at(way(57.364563311164176)).with_restitution(0.6))
        .with_load(load)
        .with_duration(0.3))
}

#[test]
fn a_rest_that_rounding_lets_begin_without_an_impact_is_one_of_the_contacts() {
    let contacts = |amplitude: f64| {
        let run = run(&corner(amplitude).unwrap(), &Scheme::Event, &Options::with_step(1e-3)).expect("a run");
        run.trajectory.contacts().iter().map(|one| (one.wall, one.impulse)).collect::<Vec<_>>()
    };
    let sum = |of: &[(usize, f64)], wall: usize| of.iter().filter(|one| one.0 == wall).map(|one| one.1).sum::<f64>();
    // Four of them.
    for amplitude in [3.21, 3.22, 3.23, 3.24] {
        let key = SceneTangent::new("amplitude", amplitude, corner).expect("a tangent");
        let found = Derivatives::new(&corner(amplitude).unwrap(), &[key], &[]).expect("a run");
        assert_eq!(found.contacts.len(), contacts(amplitude).len(), "{amplitude}");
        for wall in [0, 1] {
            let own =
                found.contacts.iter().filter(|one| one.contact.wall == wall).map(|one| one.impulse_by[0]).sum::<f64>();
            let of = |more: f64| sum(&contacts(amplitude + more), wall);
            let difference = (of(3e-5) - of(-3e-5)) / 6e-5;
            // The difference errs by the square of 1e-5 and by rounding over it.
            assert!((own / difference - 1.0).abs() < 1e-8, "{amplitude} {wall}: {own} {difference}");
        }
    }
}
