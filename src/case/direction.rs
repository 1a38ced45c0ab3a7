//! Reads the key `direction`: that of walls, loads and probes in two planes.

use super::builder::Builder;
use super::model::Place;
use super::place::Site;
use super::planes::Planes;
use crate::error::{Error, Result};
use std::ops::Range;
use toml::Spanned;

/// What to write in place of a missing direction.
pub(super) const DIRECTION: &str = "expected direction = a number, in deg, from +y (0) towards +z (90)";

impl Builder<'_> {
    /// Degrees of freedom in all planes.
    pub fn total(&self) -> usize {
        if let Planes::Two(n) = self.planes { 2 * n } else { self.n }
    }

    /// The location in a direction, as the row of its displacement. `owner` stands at `span`.
    pub fn towards(
        &self,
        site: Site,
        direction: Option<&Spanned<f64>>,
        owner: &str,
        span: &Range<usize>,
    ) -> Result<Site> {
        let degrees = direction.map(|value| (*value.get_ref(), value.span()));
        match (degrees, self.planes.is_two(), &site.place) {
            (None, false, _) | (None, true, Place::Row(_)) => Ok(site),
            (None, true, _) => {
                Err(self.source.error(span.clone(), &format!("`direction` is missing in {owner}"), DIRECTION))
            }
            (Some((_, at)), _, _) if !self.planes.is_two() => Err(self.undirected(owner, at)),
            (Some((_, at)), _, Place::Row(_)) => {
                let help = "expected no direction beside row, whose weights are of all degrees of freedom of both \
                            planes";
                Err(self.source.error(at, &format!("{owner} has a row and a direction"), help))
            }
            (Some((degrees, at)), _, _) if !degrees.is_finite() => {
                Err(self.refuse(at, &format!("{owner}: direction"), "a finite number, in deg"))
            }
            (Some((degrees, at)), _, _) => {
                let place = Place::Towards { place: Box::new(site.place), degrees };
                // The place was read already, so that this cannot fail.
                let row = self.planes.row(&self.model, &place)?;
                if row.is_blind() {
                    let title = format!("{owner}: nothing moves there towards {degrees} deg");
                    Err(self.source.error(at, &title, "expected a direction in which the place can move"))
                } else {
                    Ok(Site { place, row, ..site })
                }
            }
        }
    }

    /// The location along y and along z, each with its suffix; what moves in neither is left out.
    pub fn both_ways(&self, site: &Site) -> Result<Vec<(&'static str, Site)>> {
        if !self.planes.is_two() || matches!(site.place, Place::Row(_)) {
            return Ok(vec![("", site.clone())]);
        }
        let mut ways = Vec::new();
        for (suffix, degrees) in [("-y", 0.0), ("-z", 90.0)] {
            let place = Place::Towards { place: Box::new(site.place.clone()), degrees };
            let row = self.planes.row(&self.model, &place)?;
            if !row.is_blind() {
                ways.push((suffix, Site { place, row, suffix: site.suffix.clone() }));
            }
        }
        Ok(ways)
    }

    /// The error for a direction, at `at`, in one plane.
    pub fn undirected(&self, owner: &str, at: Range<usize>) -> Error {
        let help = "expected planes = 2 in [system], or no direction: in one plane there is one only";
        self.source.error(at, &format!("{owner} has a direction, and the system moves in one plane"), help)
    }
}
