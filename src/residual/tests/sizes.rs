//! Sums and largest values on which scales and rounding errors rest.

use super::*;
use crate::residual::energy::Instants;
use crate::residual::matrices::Part;
use crate::residual::place::terms;
use pulp::Scalar;

#[test]
fn the_terms_of_a_place_are_those_of_both_rows_by_magnitude() {
    let at = PlaneRows { y: Row::new(vec![(0, 2.0), (1, -0.5)]), z: Row::new(vec![(1, -3.0)]) };
    assert_eq!(terms(&at, &[-1.5, 4.0]), 3.0 + 2.0 + 12.0);
    assert_eq!(terms(&at, &[0.0, 0.0]), 0.0);
}

#[test]
fn the_extent_of_a_run_is_that_of_its_largest_values_in_their_own_metric() {
    let weights = Weights {
        root_mass: vec![2.0, 8.0],
        per_root_mass: vec![0.5, 0.125],
        roots: [vec![2.0, 8.0], vec![0.0; 2], vec![0.0; 2]],
        seen: vec![4.0, 0.5],
    };
    let mut extent = Extent::default();
    extent.observe(Scalar, &[-3.0, 0.5], &[-1.0, 4.0], &weights, 2);
    // The first mass is further away and seen faster: 4 · 1 m/s; 3 m · 2 √kg.
    assert_eq!((extent.reach, extent.normal_reach, extent.speed), (3.0, 6.0, 4.0));
    extent.observe(Scalar, &[1.0, -2.0], &[0.0, -16.0], &weights, 2);
    assert_eq!((extent.reach, extent.normal_reach, extent.speed), (3.0, 16.0, 8.0));
    // Only the first of both.
    extent.observe(Scalar, &[4.0, 9.0], &[1.5, 99.0], &weights, 1);
    assert_eq!((extent.reach, extent.normal_reach, extent.speed), (4.0, 16.0, 8.0));
}

#[test]
fn products_and_forms_of_one_number_are_those_of_its_matrix() {
    let one = |x: f64| Symmetric::diagonal(&[x]);
    let numbers = Matrices::new(&Scene::oscillator(2.0, 8.0, 32.0).system);
    let structure = Structure { mass: one(2.0), damping: one(8.0), stiffness: one(32.0) };
    let many = Matrices::new(&Scene::structure(structure).system);
    for (part, number) in [(Part::Mass, 2.0), (Part::Damping, 8.0), (Part::Stiffness, 32.0)] {
        for matrices in [&numbers, &many] {
            let mut out = [99.0];
            matrices.product(part, 0.25, &[-3.0], &mut out);
            assert_eq!((out[0], matrices.form(part, &[-3.0])), (0.25 * number * -3.0, number * 9.0), "{part:?}");
        }
    }
}

#[test]
fn the_instants_of_a_panel_are_its_nodes_in_order() {
    let nodes = [(0.5, 2.0), (0.75, 4.0), (1.5, 8.0)];
    let instants = Instants::of(nodes.into_iter());
    assert_eq!(
        (instants.count, &instants.t[..3], &instants.weight[..3]),
        (3, &[0.5, 0.75, 1.5][..], &[2.0, 4.0, 8.0][..])
    );
}
