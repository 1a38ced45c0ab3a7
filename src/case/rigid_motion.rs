//! The motion of a structure that moves rigidly with its base, and the mass that it carries along.

use super::model::{Body, Model};
use crate::error::Result;
use crate::scene::{Row, System};

/// Degrees of freedom, and how far each moves with the base.
pub(super) type Influence = [(usize, f64)];

/// ι over all `n` degrees of freedom for a motion along the first plane, of which a `model` has its
/// `own`.
pub(super) fn rigid_motion((model, own): (&Model, usize), n: usize, influence: Option<&Influence>) -> Vec<f64> {
    if let Some(influence) = influence {
        return displaced(n, influence);
    }
    let mut moved = vec![0.0; n];
    match model {
        Model::Bodies(bodies) => {
            bodies.iter().for_each(|body| translate(&body.model, &mut moved[body.dofs.clone()]));
        }
        model => translate(model, &mut moved[..own]),
    }
    moved
}

/// The same where it is stated.
fn displaced(n: usize, influence: &Influence) -> Vec<f64> {
    let mut moved = vec![0.0; n];
    influence.iter().filter(|&&(i, _)| i < n).for_each(|&(i, x)| moved[i] = x);
    moved
}

/// M ι/m of a model over one plane, and the mass m = ιᵀM ι that moves along with the base, kg;
/// in `system` its degrees of freedom come from the `first` on, in the row from 0. On a bar or
/// beam the inertia of held ends reaches their neighbours, so its row is that of an even
/// spread.
pub(super) fn carried(
    (model, first): (&Model, usize),
    system: &System,
    influence: Option<&Influence>,
) -> Result<(Row, f64)> {
    match model {
        Model::Bar(bar) => Ok((bar.spread(0.0, bar.length)?, bar.density * bar.area * bar.length)),
        Model::Beam(beam) => Ok((beam.spread(0.0, beam.length)?, beam.mass_per_metre() * beam.length)),
        Model::Chain(chain) => {
            let mass: f64 = chain.masses.iter().sum();
            Ok((Row::new(chain.masses.iter().map(|m| m / mass).enumerate().collect()), mass))
        }
        Model::Oscillator => {
            let moved = displaced(system.degrees_of_freedom(), &[(first, 1.0)]);
            Ok((Row::dof(0), system.mass_form(&moved, &moved)))
        }
        Model::Bodies(bodies) => {
            let of = |body: &Body| {
                let (row, mass) = carried((&body.model, body.dofs.start), system, influence)?;
                Ok((row.shifted(body.dofs.start), mass))
            };
            let parts = bodies.iter().map(of).collect::<Result<Vec<_>>>()?;
            let mass: f64 = parts.iter().map(|part| part.1).sum();
            Ok((Row::combination(parts.iter().map(|(row, own)| (own / mass, row))), mass))
        }
        Model::Matrices(_) | Model::Modal(_) => {
            let n = system.degrees_of_freedom();
            let moved = displaced(n, influence.unwrap_or_default());
            let mut momentum = vec![0.0; n];
            system.add_mass(1.0, &moved, &mut momentum);
            let mass = system.mass_form(&moved, &moved);
            let entries = momentum.into_iter().map(|p| p / mass).enumerate().filter(|entry| entry.1 != 0.0);
            Ok((Row::new(entries.collect()), mass))
        }
    }
}

/// Moves a system in one plane by 1: its displacements, and none of the rotations of a beam.
fn translate(model: &Model, moved: &mut [f64]) {
    if model.length().is_none() {
        return moved.fill(1.0);
    }
    for row in model.each(moved.len()).iter().filter_map(|(_, node)| model.row(node).ok()) {
        // At a node the row is that of its deflection, but for roundings.
        row.entries().iter().filter(|entry| entry.1 > 0.5).for_each(|&(i, _)| moved[i] = 1.0);
    }
}
