//! The places where walls stand and probes look, and which of them fit on a page.

use super::window::Span;
use crate::order::sort_by_number;
use crate::scene::Scene;
use crate::trajectory::Trajectory;

/// Most panels on one page, one below the other.
const MOST: usize = 4;

/// Most names in a title of what is left out.
const MOST_NAMED: usize = 6;

/// A place at which walls stand: all walls with the same row.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct WallPlace {
    /// Indices of the walls, in the scene's order.
    pub walls: Vec<usize>,
}

impl WallPlace {
    /// The names of its walls.
    pub fn name(&self, scene: &Scene) -> String {
        let names = self.walls.iter().filter_map(|&wall| scene.walls.get(wall)).map(|wall| wall.name.as_str());
        names.collect::<Vec<_>>().join(", ")
    }

    /// Every place of a scene, in the order of its first wall.
    fn all(scene: &Scene) -> Vec<Self> {
        let mut places: Vec<Self> = Vec::new();
        for (index, wall) in scene.walls.iter().enumerate().filter(|(_, wall)| !wall.is_round()) {
            let same = |place: &&mut Self| {
                place
                    .walls
                    .first()
                    .and_then(|&first| scene.walls.get(first))
                    .is_some_and(|first| first.row() == wall.row())
            };
            match places.iter_mut().find(same) {
                Some(place) => place.walls.push(index),
                None => places.push(Self { walls: vec![index] }),
            }
        }
        places
    }

    /// Sum of the impulses of its walls over a stretch of a run, as magnitudes, N s.
    fn impulse(&self, motion: Option<&Trajectory>, span: Span) -> f64 {
        let Some(motion) = motion else { return 0.0 };
        let columns = self.walls.iter().filter_map(|&wall| motion.contact_impulses().get(wall));
        columns
            .flat_map(|column| motion.time().iter().zip(column))
            .filter(|(t, _)| span.holds(**t))
            .map(|(_, p)| p.abs())
            .sum()
    }
}

/// A selection of items to draw.
#[derive(Debug)]
pub(super) struct Chosen<T> {
    /// The items selected, in their order.
    pub shown: Vec<T>,
    /// The others, in their order.
    pub left: Vec<T>,
}

impl<T> Chosen<T> {
    /// Text for the title where some are left out, with their names, of which the first few are
    /// given.
    pub fn left_out(&self, what: &str, name: impl Fn(&T) -> String) -> Option<String> {
        if self.left.is_empty() {
            return None;
        }
        let (shown, all) = (self.shown.len(), self.shown.len() + self.left.len());
        Some(format!("the {shown} of {all} {what} with the most contact, without {}", named(&self.left, name)))
    }

    /// At most `most` of `items`, those of the largest weight; of equal weights, the first ones.
    pub fn heaviest(items: impl IntoIterator<Item = T>, most: usize, weight: impl Fn(&T) -> f64) -> Self {
        let mut numbered: Vec<(usize, T)> = items.into_iter().enumerate().collect();
        sort_by_number(&mut numbered, |a| -weight(&a.1));
        let others = numbered.split_off(most.min(numbered.len()));
        let [shown, left] = [numbered, others].map(|mut some| {
            sort_by_number(&mut some, |entry| entry.0 as f64);
            some.into_iter().map(|(_, item)| item).collect()
        });
        Self { shown, left }
    }
}

/// The names of the first few items, and the number of the others.
fn named<T>(items: &[T], name: impl Fn(&T) -> String) -> String {
    let mut names: Vec<String> = items.iter().take(MOST_NAMED).map(name).collect();
    if items.len() > MOST_NAMED {
        names.push(format!("{} more", items.len() - MOST_NAMED));
    }
    names.join(", ")
}

impl Chosen<WallPlace> {
    /// The places with the largest impulses in `motion` within `span`.
    pub fn places(scene: &Scene, motion: Option<&Trajectory>, span: Span) -> Self {
        Self::heaviest(WallPlace::all(scene), MOST, |place| place.impulse(motion, span))
    }
}

impl Chosen<usize> {
    /// The probes on the rows of these places; their weights are the impulses of the places.
    pub fn probes(scene: &Scene, motion: Option<&Trajectory>, span: Span) -> Self {
        let places = WallPlace::all(scene);
        let weight = |index: usize| {
            let at = scene.probes.get(index).map(|p| &p.at);
            let seen =
                |place: &&WallPlace| place.walls.first().and_then(|&wall| scene.walls.get(wall)).map(|w| w.row()) == at;
            places.iter().find(seen).map_or(0.0, |place| place.impulse(motion, span))
        };
        Self::heaviest(0..scene.probes.len(), MOST, |&index| weight(index))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Row, Wall};

    #[test]
    fn walls_of_one_row_are_one_place_and_carry_its_names() {
        let there = Wall::upper("there", 1.0).at(Row::new(vec![(0, 1.0), (1, -1.0)]));
        let scene = Scene::oscillator(1.0, 0.0, 1.0)
            .with_wall(Wall::upper("upper", 1.0))
            .with_wall(there)
            .with_wall(Wall::lower("lower", -1.0));
        let places = WallPlace::all(&scene);
        assert_eq!(places, [WallPlace { walls: vec![0, 2] }, WallPlace { walls: vec![1] }]);
        assert_eq!(places[0].name(&scene), "upper, lower");
    }

    #[test]
    fn the_heaviest_are_kept_in_their_order_and_the_title_names_the_others() {
        let weights = [1.0, 5.0, 2.0, 0.0, 3.0, 4.0];
        let chosen = Chosen::heaviest(0..6, MOST, |&index: &usize| weights[index]);
        assert_eq!(chosen.shown, [1, 2, 4, 5]);
        let text = "the 4 of 6 probes with the most contact, without p0, p3";
        assert_eq!(chosen.left_out("probes", |i| format!("p{i}")).unwrap(), text);
        assert_eq!(Chosen::heaviest([7], MOST, |_| 0.0).left_out("probes", i32::to_string), None);
        let many: Vec<i32> = (0..9).collect();
        assert_eq!(named(&many, i32::to_string), "0, 1, 2, 3, 4, 5, 3 more");
    }
}
