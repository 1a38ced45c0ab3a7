//! Reads the tables `[[wall]]`, and makes the default probes.

use super::builder::Builder;
use super::model::Place;
use super::place::{Located, MOST_PLACES, Site};
use super::planes::Planes;
use super::value::Section;
use crate::error::{Error, Result, Subject};
use crate::scene::{Probe, Row, Side, Support, Wall, WallLaw};
use std::ops::Range;
use toml::Spanned;

/// A wall of the scene, the name of its table with the suffix of its location, and its location.
pub(super) struct NewWall {
    pub wall: Wall,
    pub site: String,
    pub place: Place,
}

impl NewWall {
    /// Where it stands, with the name of its table as suffix; of a flat in two planes the place,
    /// which has no row of one direction.
    pub fn location(&self) -> Site {
        let suffix = self.site.clone();
        match &self.place {
            Place::Towards { place, .. } => Site { suffix, place: Place::clone(place), row: Row::new(Vec::new()) },
            place => Site { suffix, place: place.clone(), row: self.wall.row().clone() },
        }
    }
}

impl Builder<'_> {
    /// All walls of the file, flat and round, in its order; adds its supports to `supports`.
    pub fn walls_and_supports(&mut self, file: &Section<'_>, supports: &mut Vec<Support>) -> Result<Vec<NewWall>> {
        let mut walls = Vec::new();
        for (index, wall) in file.sections("wall").iter().enumerate() {
            walls.extend(self.walls(index, walls.len(), wall)?);
        }
        for (index, support) in file.sections("support").iter().enumerate() {
            let (support, flats) = self.support(index, walls.len(), support)?;
            supports.push(support);
            walls.extend(flats);
        }
        Ok(walls)
    }

    /// The walls of table `index`, the first of which has index `first` in the scene.
    pub fn walls(&mut self, index: usize, first: usize, wall: &Section<'_>) -> Result<Vec<NewWall>> {
        let base = self.name_of(&format!("wall {}: name", index + 1), wall)?;
        let owner = format!("wall {base:?}");
        let sides = self.sides(&owner, wall)?;
        let law = self.wall_law(&owner, wall)?;
        let mut walls = Vec::new();
        let sites = self.sites((&owner, Subject::wall(&base)), wall, Located::Other)?;
        let count = first + sites.len() * sides.len();
        if count > MOST_PLACES {
            let place = wall.span_of("at").unwrap_or(wall.span.clone());
            return Err(self.source.error(
                place,
                &format!("{owner} makes {count} walls"),
                &format!("expected at most {MOST_PLACES} in all"),
            ));
        }
        for site in sites {
            let site = self.towards(site, wall.number("direction").as_ref(), &owner, &wall.span)?;
            let name = format!("{base}{}", site.suffix);
            for &(side, position, suffix) in &sides {
                let full = format!("{name}{suffix}");
                self.note_wall(first + walls.len(), &full, wall);
                let Site { place, row, .. } = &site;
                let wall = Wall { law, ..Wall::flat(&full, side, position).at(row.clone()) };
                walls.push(NewWall { wall, site: name.clone(), place: place.clone() });
            }
        }
        Ok(walls)
    }

    /// Notes the positions of the values of a wall, under the name that it has in the scene.
    pub fn note_wall(&mut self, number: usize, name: &str, table: &Section<'_>) {
        self.note(Subject::nth("wall", number).part("name"), table.span_of("name"));
        self.note(Subject::wall(name).part("position"), table.span_of("position").or(table.span_of("gap")));
        for key in ["restitution", "stiffness", "damping", "exponent", "dissipation", "at"] {
            self.note(Subject::wall(name).part(key), table.span_of(key));
        }
    }

    /// Side, position, and the suffix of its name.
    fn sides(&self, owner: &str, wall: &Section<'_>) -> Result<Vec<(Side, f64, &'static str)>> {
        let (word, span) = (wall.required_word("side"), wall.span.clone());
        let side = match *word.get_ref() {
            "upper" => Side::Upper,
            "lower" => Side::Lower,
            "both" => {
                let Some(gap) = wall.number("gap") else {
                    let help =
                        "expected gap = a number, 0 or more, in m: how far each of the two walls stands from position";
                    return Err(self.source.error(span, "`gap` is missing in `wall`", help));
                };
                let centre = wall.number("position").map_or(0.0, Spanned::into_inner);
                let half = *gap.get_ref();
                if !(half.is_finite() && half >= 0.0) {
                    return Err(self.refuse(gap.span(), &format!("{owner}: gap"), "a finite number, 0 or more, in m"));
                }
                return Ok(vec![(Side::Upper, centre + half, "-upper"), (Side::Lower, centre - half, "-lower")]);
            }
            _ => {
                let expected = "\"upper\" or \"lower\", or \"both\" with gap";
                return Err(self.refuse(word.span(), &format!("{owner}: side"), expected));
            }
        };
        if let Some(gap) = wall.span_of("gap") {
            let title = format!("{owner} has a gap and one side");
            let help = "expected position, in m; gap goes with side = \"both\"";
            return Err(self.source.error(gap, &title, help));
        }
        match wall.number("position") {
            Some(position) => Ok(vec![(side, position.into_inner(), "")]),
            None => {
                Err(self.source.error(span, "`position` is missing in `wall`", "expected position = a number, in m"))
            }
        }
    }

    /// The law of a wall.
    fn wall_law(&self, owner: &str, wall: &Section<'_>) -> Result<WallLaw> {
        let own = ["exponent", "dissipation"].into_iter().find_map(|key| Some((key, wall.span_of(key)?)));
        let Some((key, span)) = own else { return self.law_of(owner, wall) };
        let refuse = |beside: &str| {
            let help = "expected stiffness beside it, in N/m^exponent, and neither restitution nor damping: the law \
                        is k s^n (1 + dissipation ds/dt), with dissipation in s/m";
            Err(self.source.error(span.clone(), &format!("{owner} has {key} {beside}"), help))
        };
        let number = |key| wall.number(key).map(Spanned::into_inner);
        match number("stiffness") {
            _ if number("restitution").is_some() => refuse("with restitution"),
            _ if number("damping").is_some() => refuse("with damping"),
            None => refuse("without stiffness"),
            Some(stiffness) => Ok(match (number("exponent").unwrap_or(1.0), number("dissipation").unwrap_or(0.0)) {
                (1.0, 0.0) => WallLaw::Elastic { stiffness, damping: 0.0 },
                (exponent, dissipation) => WallLaw::HuntCrossley { stiffness, exponent, dissipation },
            }),
        }
    }

    /// The law of a wall or support from its restitution, stiffness and damping.
    pub fn law_of(&self, owner: &str, table: &Section<'_>) -> Result<WallLaw> {
        let number = |key| table.number(key).map(Spanned::into_inner);
        let at = |key| table.span_of(key).unwrap_or(0..0);
        let [restitution, stiffness, damping] = ["restitution", "stiffness", "damping"].map(number);
        if let (Some(_), true, None) = (restitution, self.static_correction, stiffness) {
            let help = "expected no restitution beside static_correction: the rigid wall becomes one of the \
                        compliance that the modes leave out, \
                        which has no mass, and what has no mass cannot rebound";
            let title = format!("{owner} has restitution, and static_correction is true");
            return Err(self.source.error(at("restitution"), &title, help));
        }
        match (restitution, stiffness, damping) {
            (None, None, None) => Ok(WallLaw::Rigid { restitution: 1.0 }),
            (Some(restitution), None, None) => Ok(WallLaw::Rigid { restitution }),
            (None, Some(stiffness), damping) => Ok(WallLaw::Elastic { stiffness, damping: damping.unwrap_or(0.0) }),
            (Some(_), Some(_), _) => Err(self.source.error(
                at("restitution"),
                &format!("{owner} has both restitution and stiffness"),
                "expected restitution for a rigid wall, or stiffness for an elastic one; what an elastic wall gives \
                 back follows from its stiffness and damping",
            )),
            (_, None, Some(_)) => Err(self.source.error(
                at("damping"),
                &format!("{owner} has damping without stiffness"),
                "expected stiffness beside it, in N/m (an elastic wall); a rigid wall loses energy by restitution",
            )),
        }
    }

    /// The probes of the file, or the default ones: one at each of the `sites` with walls or
    /// sliders, with the name of the first there; without any one in the middle of a bar or beam,
    /// else one at the first degree of freedom. One degree of freedom that is the displacement of
    /// them all has a single probe, without a name.
    pub fn probes(&mut self, probes: &[Section<'_>], sites: &[Site]) -> Result<Vec<Probe>> {
        let mut all: Vec<Probe> = Vec::new();
        if probes.is_empty() {
            return self.default_probes(sites);
        }
        for (index, probe) in probes.iter().enumerate() {
            let key = format!("probe {}: name", index + 1);
            let base = self.name_of(&key, probe)?;
            let owner = format!("probe {base:?}");
            for site in self.sites((&owner, Subject::probe(&base)), probe, Located::Other)? {
                let ways = match probe.number("direction") {
                    Some(direction) => vec![("", self.towards(site, Some(&direction), &owner, &probe.span)?)],
                    None => self.both_ways(&site)?,
                };
                for (way, Site { suffix, place, row }) in ways {
                    let name = format!("{base}{suffix}{way}");
                    if all.iter().any(|other| other.name == name) {
                        return Err(self.refuse(
                            probe.required_word("name").span(),
                            &key,
                            "a name of its own for each probe",
                        ));
                    }
                    self.written.probes.push(place);
                    all.push(Probe { name, at: row });
                }
            }
            if all.len() > MOST_PLACES {
                let title = format!("{} probes with those of {owner}", all.len());
                return Err(self.source.error(
                    probe.span.clone(),
                    &title,
                    &format!("expected at most {MOST_PLACES} in all"),
                ));
            }
        }
        Ok(all)
    }

    /// One probe at each of the `sites`, in two planes one along y and one along z; without any, at
    /// one location that the system has.
    fn default_probes(&mut self, sites: &[Site]) -> Result<Vec<Probe>> {
        let mut all: Vec<Probe> = Vec::new();
        for site in sites {
            for (way, Site { suffix, place, row }) in self.both_ways(site)? {
                if all.iter().all(|probe| probe.at != row) {
                    self.written.probes.push(place);
                    all.push(Probe { name: format!("{suffix}{way}"), at: row });
                }
            }
        }
        if all.is_empty() {
            let (suffix, place) = match self.planes {
                Planes::Named => ("dof-0".to_owned(), Place::Row(vec![(0, 1.0)])),
                _ => self.model.typical_place(),
            };
            let row = self.model.row(&place).map_err(|error| self.at_key(error))?;
            for (way, Site { suffix, place, row }) in self.both_ways(&Site { suffix, place, row })? {
                self.written.probes.push(place);
                all.push(Probe { name: format!("{suffix}{way}"), at: row });
            }
        }
        // A mode, or a degree of freedom behind a lever, is no displacement of a place.
        if self.total() == 1 && all.iter().all(|probe| probe.at == Row::dof(0)) {
            self.written.probes.clear();
            return Ok(vec![Probe { name: String::new(), at: Row::dof(0) }]);
        }
        Ok(all)
    }

    /// The name of a wall, support or probe.
    pub fn name_of(&self, key: &str, table: &Section<'_>) -> Result<String> {
        let name = table.required_word("name");
        self.name(key, name.get_ref(), name.span())?;
        Ok((*name.get_ref()).to_owned())
    }

    /// Refuses a name that is not valid in CSV headers.
    pub fn name(&self, key: &str, name: &str, span: Range<usize>) -> Result<()> {
        let fits = |c: char| c.is_ascii_alphanumeric() || c == '-' || c == '_';
        if name.is_empty() || !name.chars().all(fits) {
            return Err(self.refuse(span, key, "letters, digits, - and _"));
        }
        Ok(())
    }

    /// The error of a builder, shown at its key.
    pub fn at_key(&self, error: Error) -> Error {
        self.locate(error, &crate::scene::Scene::oscillator(1.0, 0.0, 0.0))
    }

    /// True for systems with positions.
    pub fn has_positions(&self) -> bool {
        self.model.length().is_some()
    }
}
