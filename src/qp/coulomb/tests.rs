//! Contacts of which one slides far faster than the impulses change velocities.

use super::*;

/// A number between −1 and 1.
fn draw(k: &mut u64) -> f64 {
    2.0 * crate::hash::next_unit(k) - 1.0
}

/// Three contacts of a body of six coordinates, coupled with one another, which move along their
/// normals and tangents at about `slow`; the last slides at 1 m/s.
fn jam(k: &mut u64, slow: f64) -> (Vec<CoulombContact>, Vec<f64>) {
    const CONTACTS: usize = 3;
    let rows: Vec<[f64; 6]> = (0..2 * CONTACTS).map(|_| [(); 6].map(|()| draw(k))).collect();
    let dot = |a: [f64; 6], b: [f64; 6]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let response = rows.iter().flat_map(|&a| rows.iter().map(move |&b| dot(a, b))).collect();
    let contact = |index: usize| {
        let free = [(); 2].map(|()| slow * draw(k));
        CoulombContact { free, friction: 0.1 + 0.2 * index as f64, rebound: 0.0 }
    };
    let mut contacts: Vec<CoulombContact> = (0..CONTACTS).map(contact).collect();
    contacts[CONTACTS - 1].free[1] += 1.0;
    (contacts, response)
}

#[test]
fn impulses_obey_the_law_to_their_own_rounding_beside_a_fast_slide() {
    let (mut k, slow, mut pushing) = (1, 1e-9, 0);
    for case in 0..2000 {
        let (contacts, response) = jam(&mut k, slow);
        let n = 2 * contacts.len();
        let (impulses, wedged) = Coulomb::new(contacts.clone(), response.clone(), 0.0).solve().expect("an answer");
        assert!(wedged.is_empty());
        let x = impulses.as_flattened();
        let largest = x.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
        // Ten digits of the impulses: roundings, times what the directions amplify.
        let near = 1e-10 * largest;
        for (index, (contact, &[p, f])) in contacts.iter().zip(&impulses).enumerate() {
            let [normal, tangent] = [0, 1].map(|j: usize| {
                let row = &response[(2 * index + j) * n..(2 * index + j + 1) * n];
                (contact.free[j] + row.iter().zip(x).map(|(w, x)| w * x).sum::<f64>(), row[2 * index + j])
            });
            let rate = 10.0 * near + 1e-10 * slow;
            assert!(p >= 0.0 && normal.0 >= -rate && (p <= near || normal.0 <= rate), "{case} {index}: {impulses:?}");
            let full = contact.friction * p;
            assert!(f.abs() <= full + near, "{case} {index}: {f:e} of {full:e}");
            let slips = (f + full * tangent.0.signum()).abs() <= near;
            assert!(slips || tangent.0.abs() <= rate, "{case} {index}: {f:e} of {full:e} at {:e}", tangent.0);
        }
        pushing += usize::from(x.iter().filter(|x| **x != 0.0).count() > 2);
    }
    assert!(pushing > 500, "{pushing}");
}

#[test]
fn a_contact_that_the_body_leaves_by_rounding_alone_is_open() {
    // A mass of 0.23 kg strikes one of two flats at right angles and rebounds; along the other it
    // moves by rounding. With friction above 1 on both, a push of the other one would ask for more
    // of the first, and so on.
    let contacts = vec![
        CoulombContact { free: [-5.056653955327213e-5, 1.7e-18], friction: 1.77, rebound: 1.166920143537049e-5 },
        CoulombContact { free: [-2.2e-18, -3.8897338117901635e-5], friction: 1.77, rebound: 0.0 },
    ];
    let w = 4.322889638786276;
    let responses = vec![w, 0.0, 0.0, w, 0.0, w, -w, 0.0, 0.0, -w, w, 0.0, w, 0.0, 0.0, w];
    // Velocities of 0.07 m/s, of which these rates are differences.
    let (impulses, wedged) = Coulomb::new(contacts, responses, 1e-15).solve().expect("an answer");
    assert!(wedged.is_empty(), "{wedged:?}");
    let [[push, _], [other, _]] = impulses[..] else { panic!("{impulses:?}") };
    assert!((w * push / 5.056653955327213e-5 - 1.0).abs() < 1e-12, "{push:e}");
    assert!(other < 1e-15 * push.max(1.0), "{other:e}");
}
