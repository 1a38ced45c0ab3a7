//! Reads the tables `[[wall]]`, and makes the default probes.

use super::builder::Builder;
use super::file;
use super::model::{Model, Place};
use super::place::{MOST_PLACES, Site};
use super::planes::Planes;
use super::value::{Number, Section};
use crate::error::{Error, Result, Subject};
use crate::scene::{ModalData, Probe, Row, Side, Wall, WallLaw};
use std::ops::Range;
use toml::Spanned;

/// A wall of the scene, the name of its table with the suffix of its location, and its location.
pub(super) struct NewWall {
    pub wall: Wall,
    pub site: String,
    pub place: Place,
}

impl Builder<'_> {
    /// The walls of table `index`, the first of which has index `first` in the scene.
    pub fn walls(&mut self, index: usize, first: usize, section: Section<file::Wall>) -> Result<Vec<NewWall>> {
        let Section { span, value: wall } = section;
        let base = self.name(&format!("wall {}: name", index + 1), &wall.name)?;
        let owner = format!("wall {base:?}");
        let sides = self.sides(&owner, &wall, span.clone())?;
        let law = self.law_of(&owner, [&wall.restitution, &wall.stiffness, &wall.damping])?;
        let mut walls = Vec::new();
        let sites = self.sites((&owner, Subject::wall(&base)), wall.at.as_ref(), span.clone(), false)?;
        let count = first + sites.len() * sides.len();
        if count > MOST_PLACES {
            let place = wall.at.as_ref().map_or(span.clone(), Spanned::span);
            return Err(self.source.error(
                place,
                &format!("{owner} makes {count} walls"),
                &format!("expected at most {MOST_PLACES} in all"),
            ));
        }
        for site in sites {
            let site = self.towards(site, wall.direction.as_ref(), &owner, &span)?;
            let name = format!("{base}{}", site.suffix);
            for &(side, position, suffix) in &sides {
                let full = format!("{name}{suffix}");
                self.note(first + walls.len(), &full, &wall);
                let Site { place, row, .. } = &site;
                let wall = Wall { name: full, side, position, law, at: row.clone() };
                walls.push(NewWall { wall, site: name.clone(), place: place.clone() });
            }
        }
        Ok(walls)
    }

    /// Notes the positions of the values of a wall, under the name that it has in the scene.
    fn note(&mut self, number: usize, name: &str, wall: &file::Wall) {
        self.places.push((Subject::nth("wall", number).part("name"), wall.name.span()));
        let position = wall.position.as_ref().or(wall.gap.as_ref());
        let keys = [
            ("position", position.map(Spanned::span)),
            ("restitution", wall.restitution.as_ref().map(Spanned::span)),
            ("stiffness", wall.stiffness.as_ref().map(Spanned::span)),
            ("damping", wall.damping.as_ref().map(Spanned::span)),
            ("at", wall.at.as_ref().map(Spanned::span)),
        ];
        for (key, span) in keys {
            self.places.extend(span.map(|span| (Subject::wall(name).part(key), span)));
        }
    }

    /// Side, position, and the suffix of its name.
    fn sides(&self, owner: &str, wall: &file::Wall, span: Range<usize>) -> Result<Vec<(Side, f64, &'static str)>> {
        let side = match wall.side.get_ref().as_str() {
            "upper" => Side::Upper,
            "lower" => Side::Lower,
            "both" => {
                let Some(gap) = &wall.gap else {
                    let help =
                        "expected gap = a number, 0 or more, in m: how far each of the two walls stands from position";
                    return Err(self.source.error(span, "`gap` is missing in `wall`", help));
                };
                let centre = wall.position.as_ref().map_or(0.0, |x| x.get_ref().0);
                let half = gap.get_ref().0;
                if !(half.is_finite() && half >= 0.0) {
                    return Err(self.refuse(gap.span(), &format!("{owner}: gap"), "a finite number, 0 or more, in m"));
                }
                return Ok(vec![(Side::Upper, centre + half, "-upper"), (Side::Lower, centre - half, "-lower")]);
            }
            _ => {
                let expected = "\"upper\" or \"lower\", or \"both\" with gap";
                return Err(self.refuse(wall.side.span(), &format!("{owner}: side"), expected));
            }
        };
        if let Some(gap) = &wall.gap {
            let title = format!("{owner} has a gap and one side");
            return Err(self.source.error(
                gap.span(),
                &title,
                "expected position, in m; gap goes with side = \"both\"",
            ));
        }
        match &wall.position {
            Some(position) => Ok(vec![(side, position.get_ref().0, "")]),
            None => {
                Err(self.source.error(span, "`position` is missing in `wall`", "expected position = a number, in m"))
            }
        }
    }

    /// The law of a wall or support from its restitution, stiffness and damping.
    pub fn law_of(&self, owner: &str, values: [&Option<Spanned<Number>>; 3]) -> Result<WallLaw> {
        let number = |value: &Option<Spanned<Number>>| value.as_ref().map(|x| x.get_ref().0);
        let at = |value: &Option<Spanned<Number>>| value.as_ref().map_or(0..0, Spanned::span);
        let [restitution, stiffness, damping] = values;
        if let (Some(e), true, None) = (restitution, self.static_correction, stiffness) {
            let help = "expected no restitution beside static_correction: the rigid wall becomes one of the \
                        compliance that the modes leave out, \
                        which has no mass, and what has no mass cannot rebound";
            return Err(self.source.error(
                e.span(),
                &format!("{owner} has restitution, and static_correction is true"),
                help,
            ));
        }
        match (number(restitution), number(stiffness), number(damping)) {
            (None, None, None) => Ok(WallLaw::Rigid { restitution: 1.0 }),
            (Some(restitution), None, None) => Ok(WallLaw::Rigid { restitution }),
            (None, Some(stiffness), damping) => Ok(WallLaw::Elastic { stiffness, damping: damping.unwrap_or(0.0) }),
            (Some(_), Some(_), _) => Err(self.source.error(
                at(restitution),
                &format!("{owner} has both restitution and stiffness"),
                "expected restitution for a rigid wall, or stiffness for an elastic one; what an elastic wall gives \
                 back follows from its stiffness and damping",
            )),
            (_, None, Some(_)) => Err(self.source.error(
                at(damping),
                &format!("{owner} has damping without stiffness"),
                "expected stiffness beside it, in N/m (an elastic wall); a rigid wall loses energy by restitution",
            )),
        }
    }

    /// The probes of the file, or the default ones: one at each location with walls, with the name
    /// of the first wall there; without walls one in the middle of a bar or beam, else one at the
    /// first degree of freedom. With one degree of freedom there is a single probe, without a name.
    pub fn probes(&mut self, probes: Vec<Section<file::Probe>>, walls: &[NewWall]) -> Result<Vec<Probe>> {
        let mut all: Vec<Probe> = Vec::new();
        if probes.is_empty() {
            return self.default_probes(walls);
        }
        for (index, Section { span, value: probe }) in probes.into_iter().enumerate() {
            let key = format!("probe {}: name", index + 1);
            let base = self.name(&key, &probe.name)?;
            let owner = format!("probe {base:?}");
            for site in self.sites((&owner, Subject::probe(&base)), probe.at.as_ref(), span.clone(), false)? {
                let ways = match &probe.direction {
                    Some(_) => vec![("", self.towards(site, probe.direction.as_ref(), &owner, &span)?)],
                    None => self.both_ways(&site)?,
                };
                for (way, Site { suffix, place, row }) in ways {
                    let name = format!("{base}{suffix}{way}");
                    if all.iter().any(|other| other.name == name) {
                        return Err(self.refuse(probe.name.span(), &key, "a name of its own for each probe"));
                    }
                    self.written.probes.push(place);
                    all.push(Probe { name, at: row });
                }
            }
            if all.len() > MOST_PLACES {
                let title = format!("{} probes with those of {owner}", all.len());
                return Err(self.source.error(span, &title, &format!("expected at most {MOST_PLACES} in all")));
            }
        }
        Ok(all)
    }

    /// One probe at each location with walls, in two planes one along y and one along z; without
    /// walls, at one location that the system has.
    fn default_probes(&mut self, walls: &[NewWall]) -> Result<Vec<Probe>> {
        if self.total() == 1 {
            return Ok(vec![Probe { name: String::new(), at: Row::dof(0) }]);
        }
        let mut all: Vec<Probe> = Vec::new();
        for NewWall { wall, site, place } in walls {
            let site = match place {
                Place::Towards { place, .. } => {
                    Site { suffix: site.clone(), place: Place::clone(place), row: Row::new(Vec::new()) }
                }
                _ => Site { suffix: site.clone(), place: place.clone(), row: wall.at.clone() },
            };
            for (way, Site { suffix, place, row }) in self.both_ways(&site)? {
                if all.iter().all(|probe| probe.at != row) {
                    self.written.probes.push(place);
                    all.push(Probe { name: format!("{suffix}{way}"), at: row });
                }
            }
        }
        for support in self.written.supports.clone().into_iter().filter(|support| support.flats.is_none()) {
            let site = Site { suffix: support.name, place: support.place, row: Row::new(Vec::new()) };
            for (way, Site { suffix, place, row }) in self.both_ways(&site)? {
                if all.iter().all(|probe| probe.at != row) {
                    self.written.probes.push(place);
                    all.push(Probe { name: format!("{suffix}{way}"), at: row });
                }
            }
        }
        if all.is_empty() {
            let (name, place) = match (self.model.length(), &self.model, self.planes) {
                (_, _, Planes::Named) => ("dof-0", Place::Row(vec![(0, 1.0)])),
                (Some(length), _, _) => ("middle", Place::Position(0.5 * length)),
                (None, Model::Modal(ModalData { points, .. }), _) if !points.is_empty() => {
                    (points[0].name.as_str(), Place::point(&points[0].name))
                }
                _ => ("dof-0", Place::Dof(0)),
            };
            let (suffix, row) = (name.to_owned(), self.model.row(&place).map_err(|error| self.at_key(error))?);
            for (way, Site { suffix, place, row }) in self.both_ways(&Site { suffix, place, row })? {
                self.written.probes.push(place);
                all.push(Probe { name: format!("{suffix}{way}"), at: row });
            }
        }
        Ok(all)
    }

    /// A name that is valid in CSV headers.
    pub fn name(&self, key: &str, name: &Spanned<String>) -> Result<String> {
        let fits = |c: char| c.is_ascii_alphanumeric() || c == '-' || c == '_';
        let word = name.get_ref();
        if word.is_empty() || !word.chars().all(fits) {
            return Err(self.refuse(name.span(), key, "letters, digits, - and _"));
        }
        Ok(word.clone())
    }

    /// The error of a builder, shown at its key.
    pub fn at_key(&self, error: Error) -> Error {
        self.locate(error, &crate::scene::Scene::oscillator(1.0, 0.0, 0.0))
    }

    /// True for systems with positions.
    pub fn has_positions(&self) -> bool {
        matches!(self.model, Model::Bar(_) | Model::Beam(_))
    }
}
