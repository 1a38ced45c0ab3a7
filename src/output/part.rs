//! Walls at one place whose contacts are drawn together.

use super::colours::{Places, place_of};
use super::figure::Curve;
use super::labelled::Labelled;
use crate::scene::Scene;
use std::collections::HashMap;

/// Some walls at one place, and how their forces and impulses are drawn.
#[derive(Debug, Clone)]
pub(super) struct Part<'a> {
    label: &'a str,
    look: usize,
    /// The look whose colour they have instead of that of `look`.
    colour: Option<usize>,
    backdrop: bool,
    /// The indices of the walls.
    pub walls: Vec<usize>,
}

impl<'a> Part<'a> {
    /// The parts of `walls`: of a run that is drawn `alone` each wall, or the flats of each
    /// support, in its colour; beside other runs all walls together, in the look of the run.
    pub fn all(scene: &'a Scene, labelled: &Labelled<'a>, walls: &[usize], alone: bool) -> Vec<Self> {
        let of_run = |walls: Vec<usize>| Self {
            label: labelled.label,
            look: labelled.look,
            colour: None,
            backdrop: labelled.reference,
            walls,
        };
        if !alone {
            return vec![of_run(walls.to_vec())];
        }
        let places = Places::of(scene);
        let (mut parts, mut numbers): (Vec<Self>, HashMap<&str, usize>) = Default::default();
        for (index, wall) in walls.iter().filter_map(|&index| Some((index, scene.walls.get(index)?))) {
            let label = place_of(&wall.name);
            let number = *numbers.entry(label).or_insert(parts.len());
            match parts.get_mut(number) {
                Some(part) => part.walls.push(index),
                None => {
                    let colour = Some(places.colour(label));
                    parts.push(Self { label, look: 0, colour, ..of_run(vec![index]) });
                }
            }
        }
        parts
    }

    /// Their force over time, or their impulses.
    pub fn curve(&self, points: Vec<(f64, f64)>) -> Curve {
        let curve = Curve::new(self.label, points).look(self.look).colour(self.colour);
        if self.backdrop { curve.backdrop() } else { curve }
    }
}
