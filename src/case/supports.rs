//! Reads the tables `[[support]]`.

use super::builder::Builder;
use super::model::Place;
use super::place::{Located, MOST_PLACES};
use super::value::{Section, Value};
use super::walls::NewWall;
use super::written::{Support, SupportShape, WearData};
use crate::error::{Error, Result, Subject};
use crate::scene::{self, Face, Flat, Flats, FrictionCoefficients, PlaneRows, Wall, WallLaw};
use crate::wear::Growth;
use std::ops::Range;
use toml::Spanned;

/// What stands at the friction of a support.
const BOTH_COEFFICIENTS: &str = "friction = a number, or { static = .., kinetic = .. }, numbers from 0 to 10";

/// A support or slider that is read: its name in messages and as the subject of errors, and its
/// table.
pub(super) struct Owner {
    pub name: String,
    /// The name of the list of tables.
    pub table: &'static str,
    pub subject: Subject,
    pub span: Range<usize>,
}

impl Builder<'_> {
    /// The support in table `index`, and the walls of its flats, the first of which has index
    /// `first` in the scene.
    pub fn support(
        &mut self,
        index: usize,
        first: usize,
        support: &Section<'_>,
    ) -> Result<(scene::Support, Vec<NewWall>)> {
        let name = self.name_of(&format!("support {}: name", index + 1), support)?;
        let owner = Owner {
            name: format!("support {name:?}"),
            table: "support",
            subject: Subject::support(&name),
            span: support.span.clone(),
        };
        if !self.planes.is_two() {
            let help =
                "expected planes = 2 in [system]; in one plane, two walls: [[wall]] with side = \"both\" and gap";
            let title = format!("{}, and the system moves in one plane", owner.name);
            return Err(self.source.error(owner.span, &title, help));
        }
        if self.written.supports.iter().any(|other| other.name == name) {
            let key = format!("{}: name", owner.name);
            return Err(self.refuse(support.required_word("name").span(), &key, "a name of its own for each support"));
        }
        let centre = self.centre(&owner, support.numbers("centre"))?;
        let place = self.place_in_two_planes(&owner, support)?;
        let at = self.planes.rows(&self.model, &place)?;
        let friction = self.friction(&owner, support)?;
        let wear = self.wear_data(&owner, &place, support)?;
        let word = support.required_word("shape");
        let (made, shape, walls) = match *word.get_ref() {
            "flats" => {
                let flats = self.flats(&owner, (&name, at, centre), friction, support)?;
                let walls = self.walls_of(&owner, support, &flats, (&place, first))?;
                (flats.support(first), SupportShape::Flats(flats), walls)
            }
            "round" => {
                let (gap, law) = self.hole(&owner, support)?;
                let face = Face::Round { at: at.clone(), centre, gap };
                let wall = Wall { name: name.clone(), face, law, friction };
                let walls = vec![NewWall { wall, site: name.clone(), place: place.clone() }];
                (scene::Support { name: name.clone(), at, centre, walls: first..first + 1 }, SupportShape::Round, walls)
            }
            _ => {
                let key = format!("{}: shape", owner.name);
                return Err(self.refuse(word.span(), &key, "\"flats\" or \"round\""));
            }
        };
        let growth = self.growth(&owner, support, shape != SupportShape::Round)?;
        self.written.supports.push(Support { name, place, shape, wear, growth });
        Ok((made, walls))
    }

    /// The flats of a support.
    fn flats(
        &mut self,
        owner: &Owner,
        (name, at, centre): (&str, PlaneRows, [f64; 2]),
        friction: FrictionCoefficients,
        support: &Section<'_>,
    ) -> Result<Flats> {
        let law = self.law_of(&owner.name, support)?;
        let directions = self.flat_directions(owner, support)?;
        let gaps = self.gaps(owner, support, directions.len())?;
        let flats = directions.iter().zip(gaps).map(|(&direction, gap)| Flat { direction, gap }).collect();
        Ok(Flats { name: name.to_owned(), at, flats, centre, law, friction })
    }

    /// The walls of flats around `place`, the first of which has index `first` in the scene.
    fn walls_of(
        &mut self,
        owner: &Owner,
        support: &Section<'_>,
        flats: &Flats,
        (place, first): (&Place, usize),
    ) -> Result<Vec<NewWall>> {
        let walls = flats.walls().map_err(|error| self.at_key(error))?;
        if first + walls.len() > MOST_PLACES {
            let title = format!("{} makes {} walls", owner.name, first + walls.len());
            return Err(self.source.error(
                owner.span.clone(),
                &title,
                &format!("expected at most {MOST_PLACES} in all"),
            ));
        }
        for (number, wall) in walls.iter().enumerate() {
            self.note_wall(first + number, &wall.name, support);
        }
        let directed = |(wall, flat): (_, &Flat)| {
            let degrees = flat.direction.rem_euclid(180.0) % 180.0;
            let place = Place::Towards { place: Box::new(place.clone()), degrees };
            NewWall { wall, site: flats.name.clone(), place }
        };
        Ok(walls.into_iter().zip(&flats.flats).map(directed).collect())
    }

    /// A round hole: a radial gap, and a contact law.
    fn hole(&mut self, owner: &Owner, support: &Section<'_>) -> Result<(f64, WallLaw)> {
        let of_flats = ["directions", "sides", "turn"].into_iter();
        if let Some((key, at)) = of_flats.filter_map(|key| Some((key, support.span_of(key)?))).next() {
            let title = format!("{} is round and has {key}", owner.name);
            return Err(self.source.error(at, &title, "expected shape = \"flats\" beside it, or gap alone: a radius"));
        }
        if self.static_correction {
            let help = "expected shape = \"flats\", or no static_correction: the compliance that modes leave out \
                        makes a flat softer, which is not done for a round hole";
            let title = format!("{} is round, and static_correction is true", owner.name);
            return Err(self.source.error(support.required_word("shape").span(), &title, help));
        }
        let gap = match support.number("gap").map(Spanned::into_inner) {
            Some(gap) if gap.is_finite() && gap > 0.0 => gap,
            _ => {
                let wanted = "a number above 0, in m: the radius of the hole less that of the tube; without any \
                              gap the place is a pin, not a support";
                return Err(self.refuse(
                    support.span_of("gap").unwrap_or(0..0),
                    &format!("{}: gap", owner.name),
                    wanted,
                ));
            }
        };
        let law = self.law_of(&owner.name, support)?;
        for key in ["gap", "restitution", "stiffness", "damping"] {
            self.note(owner.subject.clone().part(key), support.span_of(key));
        }
        Ok((gap, law))
    }

    /// The coefficients of friction: a number, or a table of both.
    pub fn friction(&mut self, owner: &Owner, section: &Section<'_>) -> Result<FrictionCoefficients> {
        let Some(value) = section.get("friction") else { return Ok(FrictionCoefficients::default()) };
        let (subject, table) = (owner.subject.clone().part("friction"), owner.table);
        self.note(subject.clone(), Some(value.span()));
        let entries = match value.get_ref() {
            Value::Number(both) => return Ok((*both).into()),
            Value::Table(entries) => entries,
            other => {
                let title = format!("`{table}.friction` takes a number or a table, not {}", other.kind());
                return Err(self.source.error(value.span(), &title, &format!("expected {BOTH_COEFFICIENTS}")));
            }
        };
        let [mut sticking, mut sliding] = [None; 2];
        for (name, value) in entries {
            let (part, coefficient) = match name.get_ref().as_ref() {
                "static" => ("static", &mut sticking),
                "kinetic" => ("kinetic", &mut sliding),
                other => {
                    let title = format!("unknown key `{other}` in `{table}.friction`");
                    return Err(self.source.error(name.span(), &title, &format!("expected {BOTH_COEFFICIENTS}")));
                }
            };
            let Value::Number(x) = value.get_ref() else {
                let title = format!("`{table}.friction.{part}` takes a number, not {}", value.get_ref().kind());
                return Err(self.source.error(value.span(), &title, "expected a number from 0 to 10"));
            };
            *coefficient = Some(*x);
            self.note(subject.clone().part(part), Some(value.span()));
        }
        let missing = |key: &str| {
            let title = format!("{}: friction has no {key} coefficient", owner.name);
            self.source.error(value.span(), &title, &format!("expected {BOTH_COEFFICIENTS}"))
        };
        Ok(FrictionCoefficients {
            sticking: sticking.ok_or_else(|| missing("static"))?,
            sliding: sliding.ok_or_else(|| missing("kinetic"))?,
        })
    }

    /// The place that a support surrounds.
    fn place_in_two_planes(&mut self, owner: &Owner, support: &Section<'_>) -> Result<Place> {
        let sites = self.sites((&owner.name, owner.subject.clone()), support, Located::Support)?;
        match sites.into_iter().map(|site| (site.suffix, site.place)).collect::<Vec<_>>().as_slice() {
            [(suffix, place)] if suffix.is_empty() && !matches!(place, Place::Row(_)) => Ok(place.clone()),
            _ => {
                let at = support.span_of("at").unwrap_or(owner.span.clone());
                let help =
                    "expected a place with a displacement along y and one along z: a position, a dof, or y and z";
                Err(self.source.error(at, &format!("{}: at is not one place in two planes", owner.name), help))
            }
        }
    }

    fn centre(&mut self, owner: &Owner, centre: Option<Spanned<Vec<Spanned<f64>>>>) -> Result<[f64; 2]> {
        let Some(centre) = centre else { return Ok([0.0; 2]) };
        self.positions.push((owner.subject.clone().part("centre"), centre.span()));
        match centre.get_ref().as_slice() {
            [y, z] => Ok([*y.get_ref(), *z.get_ref()]),
            _ => Err(self.refuse(centre.span(), &format!("{}: centre", owner.name), "[y, z], two numbers in m")),
        }
    }

    /// The values on which the depth of a scar depends.
    fn wear_data(&self, owner: &Owner, place: &Place, support: &Section<'_>) -> Result<WearData> {
        let number = |key, unit| self.above_0(&owner.name, key, unit, support);
        let (width, radius) = (number("width", "m")?, number("radius", "m")?);
        let [coefficient, support_coefficient] = ["coefficient", "support_coefficient"].map(|key| number(key, "1/Pa"));
        let material = self.material(&owner.name, support)?;
        let missing = |at, what: &str, help: &str| -> Error {
            self.source.error(at, &format!("{} has {what}", owner.name), help)
        };
        let beam = self.model.beam(place);
        if let Some((given, span)) = width.zip(support.span_of("width"))
            && beam.is_some_and(|beam| given > beam.length)
        {
            return Err(self.refuse(
                span,
                &format!("{}: width", owner.name),
                "a number above 0, in m, at most the beam's length",
            ));
        }
        let radius_of = |place| self.model.beam(place)?.section.outer_diameter().map(|outer| 0.5 * outer);
        let tube = radius_of(place);
        let other_tube = if let Place::Relative { to, .. } = place { radius_of(to) } else { None };
        let bore = beam.and_then(|beam| beam.section.inner_diameter());
        if let (Some(_), Some((other, bore))) = (width, other_tube.zip(bore))
            && *support.required_word("shape").get_ref() == "round"
            && 2.0 * other <= bore
        {
            let title = format!("{}: `at` names first the tube around the other", owner.name);
            let help = "expected the inner tube first, which bears on the hole: scars are those of its outside";
            let at = support.span_of("at").unwrap_or(owner.span.clone());
            return Err(self.source.error(at, &title, help));
        }
        match (support.span_of("width"), support.span_of("radius")) {
            (None, Some(at)) => {
                let help = "expected width beside it, in m along the tube: both make the depth of a scar";
                return Err(missing(at, "a radius and no width", help));
            }
            (Some(_), Some(at)) if tube.is_some() => {
                let help = "expected no radius: that of a beam is half its outer_diameter";
                return Err(missing(at, "a radius, and the system is a beam", help));
            }
            (Some(at), None) if tube.is_none() => {
                let help = "expected radius beside it, in m: that of what slides there, which only a beam has in \
                            outer_diameter";
                return Err(missing(at, "a width and no radius", help));
            }
            _ => {}
        }
        Ok(WearData {
            scar: width.zip(radius.or(tube)),
            other_tube,
            wall: self.wall_of(owner, support, radius, tube.is_some())?,
            coefficient: coefficient?.or(material.and_then(|own| own.coefficient)),
            support_coefficient: support_coefficient?.or(material.and_then(|own| own.support_coefficient)),
        })
    }

    /// The thickness of the wall of a tube of the radius `radius`; a beam has it in its diameters.
    fn wall_of(&self, owner: &Owner, support: &Section<'_>, radius: Option<f64>, is_beam: bool) -> Result<Option<f64>> {
        let (Some(wall), Some(at)) = (self.above_0(&owner.name, "wall", "m", support)?, support.span_of("wall")) else {
            return Ok(None);
        };
        if is_beam {
            let title = format!("{} has a wall, and the system is a beam", owner.name);
            return Err(self.source.error(at, &title, "expected no wall: that of a beam follows from its diameters"));
        }
        let Some(radius) = radius else {
            let title = format!("{} has a wall and no radius", owner.name);
            let help = "expected width and radius beside it, in m";
            return Err(self.source.error(at, &title, help));
        };
        if wall > radius {
            let wanted = "a number above 0, in m, at most radius: the thickness of the tube's wall";
            return Err(self.refuse(at, &format!("{}: wall", owner.name), wanted));
        }
        Ok(Some(wall))
    }

    /// What wear does to the gaps of a support, of flats or round.
    fn growth(&self, owner: &Owner, support: &Section<'_>, flats: bool) -> Result<Growth> {
        let Some(word) = support.word("growth") else { return Ok(if flats { Growth::Kept } else { Growth::Even }) };
        let (fitting, expected): (&[Growth], _) = if flats {
            (&[Growth::Flats], "\"flats\", of flats each by its scar; or none of it: their gaps stay")
        } else {
            (&[Growth::Even, Growth::Shifted], "\"even\" or \"shifted\", of a round support")
        };
        let found = fitting.iter().find(|growth| growth.name() == *word.get_ref());
        found.copied().ok_or_else(|| self.refuse(word.span(), &format!("{}: growth", owner.name), expected))
    }

    /// A number above 0 at `key` of the table of `owner`.
    pub fn above_0(&self, owner: &str, key: &str, unit: &str, table: &Section<'_>) -> Result<Option<f64>> {
        let Some(value) = table.number(key) else { return Ok(None) };
        match *value.get_ref() {
            x if x.is_finite() && x > 0.0 => Ok(Some(x)),
            _ => Err(self.refuse(value.span(), &format!("{owner}: {key}"), &format!("a number above 0, in {unit}"))),
        }
    }
}
