//! The derivatives of mass, damping and stiffness.

use super::stencil::Stencil;
use crate::linear::{Operator, Symmetric};
use crate::scene::{Scene, Structure};
use std::collections::BTreeSet;

/// δM, δC and δK of the scenes of a stencil; `None` where one is 0.
pub(super) fn changes(stencil: &mut Stencil) -> [Option<Operator>; 3] {
    let parts: [fn(&Structure) -> &Symmetric; 3] = [|s| &s.mass, |s| &s.damping, |s| &s.stiffness];
    parts.map(|part| change(stencil, part))
}

fn change(stencil: &mut Stencil, part: fn(&Structure) -> &Symmetric) -> Option<Operator> {
    let n = stencil.base.system.degrees_of_freedom();
    let places = places(stencil, part);
    let value = |scene: &Scene, i: usize, j: usize| part(&scene.system.structure()).get(i, j);
    let diagonal = part(&stencil.base.system.structure()).diagonal_entries();
    let own = |i: usize| diagonal.get(i).copied().unwrap_or(0.0).abs();
    let mut entry = |i: usize, j: usize| stencil.derivative_among((own(i) * own(j)).sqrt(), |scene| value(scene, i, j));
    let entries: Vec<(usize, usize, f64)> = places.into_iter().map(|(i, j)| (i, j, entry(i, j))).collect();
    let any = entries.iter().any(|entry| entry.2 != 0.0);
    any.then(|| Operator::new(&Symmetric::from_entries(n, entries)))
}

/// The entries that the matrix has in any of the scenes; none if it is the same in all of them.
fn places(stencil: &Stencil, part: fn(&Structure) -> &Symmetric) -> BTreeSet<(usize, usize)> {
    let base = stencil.base.system.structure();
    let own = part(&base);
    let mut places = BTreeSet::new();
    for scene in stencil.scenes() {
        let structure = scene.system.structure();
        let other = part(&structure);
        if other != own {
            places.extend(other.entries().chain(own.entries()).map(|(i, j, _)| (i, j)));
        }
    }
    places
}
