//! The colours of walls and supports, of rising and falling values: one for each in every figure,
//! and the same on the page of a report (`look.js`).

use crate::scene::Scene;
use std::collections::HashMap;

/// The looks whose colours places have in turn: neighbours differ, and black comes last.
const PLACES: [usize; 8] = [1, 2, 3, 5, 4, 6, 7, 0];

/// The look whose colour rows of a sweep have along rising values.
pub(crate) const UP: usize = 1;
/// The look whose colour they have along falling values.
pub(crate) const DOWN: usize = 2;

/// The support that the wall of that name is a flat of, or the wall itself.
pub(crate) fn place_of(wall: &str) -> &str {
    match wall.rsplit_once("-flat-") {
        Some((support, number)) if !number.is_empty() && number.bytes().all(|c| c.is_ascii_digit()) => support,
        _ => wall,
    }
}

/// The walls and supports of a scene, each once with its number; the flats of a support are the
/// support.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Places(HashMap<String, usize>);

impl Places {
    /// The places of these walls that are none of a support, then of these supports, by their names
    /// and in their order.
    pub fn new<'a>(walls: impl IntoIterator<Item = &'a str>, supports: impl IntoIterator<Item = &'a str>) -> Self {
        let supports: Vec<&str> = supports.into_iter().collect();
        let own = walls.into_iter().map(place_of).filter(|wall| !supports.contains(wall));
        let mut numbers = HashMap::new();
        for name in own.chain(supports.iter().copied()) {
            if !numbers.contains_key(name) {
                numbers.insert(name.to_owned(), numbers.len());
            }
        }
        Self(numbers)
    }

    /// The places of a scene.
    pub fn of(scene: &Scene) -> Self {
        Self::new(
            scene.walls.iter().map(|wall| wall.name.as_str()),
            scene.supports.iter().map(|support| support.name.as_str()),
        )
    }

    /// The look whose colour the wall or support of that name has.
    pub fn colour(&self, name: &str) -> usize {
        let index = self.0.get(place_of(name)).copied().unwrap_or(0);
        PLACES.get(index % PLACES.len()).copied().unwrap_or(0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_support_and_all_its_flats_have_one_colour() {
        let walls = ["upper", "bars-flat-1", "bars-flat-2", "lower"];
        let places = Places::new(walls, ["plate", "bars"]);
        assert_eq!(["upper", "lower", "plate", "bars"].map(|name| places.0[name]), [0, 1, 2, 3]);
        let colours = ["upper", "bars-flat-1", "bars-flat-2", "bars", "lower", "plate"].map(|name| places.colour(name));
        assert_eq!(colours, [1, 5, 5, 5, 2, 3]);
        // Not the name of a flat.
        assert_eq!(["a-flat-", "a-flat-x", "-flat"].map(place_of), ["a-flat-", "a-flat-x", "-flat"]);
    }
}
