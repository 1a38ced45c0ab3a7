//! Reads the tables `[[support]]`.

use super::builder::Builder;
use super::file;
use super::model::{Model, Place};
use super::place::MOST_PLACES;
use super::value::{Number, Section, Value};
use super::walls::NewWall;
use super::written::{Scarred, Support};
use crate::error::{Error, Result, Subject};
use crate::scene::{self, Flat, Flats, PlaneRows, Shape};
use std::ops::Range;
use toml::Spanned;

/// A support that is read: its name in messages and as the subject of errors, and its table.
pub(super) struct Owner {
    pub name: String,
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
        section: Section<file::Support>,
    ) -> Result<(scene::Support, Vec<NewWall>)> {
        let Section { span, value: support } = section;
        let name = self.name(&format!("support {}: name", index + 1), &support.name)?;
        let owner = Owner { name: format!("support {name:?}"), subject: Subject::support(&name), span };
        if !self.planes.is_two() {
            let help =
                "expected planes = 2 in [system]; in one plane, two walls: [[wall]] with side = \"both\" and gap";
            let title = format!("{}, and the system moves in one plane", owner.name);
            return Err(self.source.error(owner.span, &title, help));
        }
        if self.written.supports.iter().any(|other| other.name == name) {
            let key = format!("{}: name", owner.name);
            return Err(self.refuse(support.name.span(), &key, "a name of its own for each support"));
        }
        let centre = self.centre(&owner, support.centre.as_ref())?;
        let place = self.place_in_two_planes(&owner, support.at.as_ref())?;
        let at = self.planes.rows(&self.model, &place)?;
        let friction = self.optional(owner.subject.clone().part("friction"), support.friction.as_ref());
        let friction = friction.unwrap_or(0.0);
        let scarred = self.scarred(&owner, &support)?;
        let (made, flats, walls) = match support.shape.get_ref().as_str() {
            "flats" => {
                let flats = self.flats(&owner, (&name, at, centre), &support)?;
                let walls = self.walls_of(&owner, &support, &flats, (&place, first))?;
                (flats.support(first, friction), Some((flats, first)), walls)
            }
            "round" => {
                let shape = self.hole(&owner, &support)?;
                (scene::Support { name: name.clone(), at, centre, shape, friction }, None, Vec::new())
            }
            _ => {
                let key = format!("{}: shape", owner.name);
                return Err(self.refuse(support.shape.span(), &key, "\"flats\" or \"round\""));
            }
        };
        self.written.supports.push(Support { name, place, flats, scarred });
        Ok((made, walls))
    }

    /// The flats of a support.
    fn flats(
        &mut self,
        owner: &Owner,
        (name, at, centre): (&str, PlaneRows, [f64; 2]),
        support: &file::Support,
    ) -> Result<Flats> {
        let law = self.law_of(&owner.name, [&support.restitution, &support.stiffness, &support.damping])?;
        let directions = self.flat_directions(owner, support)?;
        let gaps = self.gaps(owner, &support.gap, directions.len())?;
        let flats = directions.iter().zip(gaps).map(|(&direction, gap)| Flat { direction, gap }).collect();
        Ok(Flats { name: name.to_owned(), at, flats, centre, law })
    }

    /// The walls of flats around `place`, the first of which has index `first` in the scene.
    fn walls_of(
        &mut self,
        owner: &Owner,
        support: &file::Support,
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
        let keys = [
            ("position", Some(support.gap.span())),
            ("restitution", support.restitution.as_ref().map(Spanned::span)),
            ("stiffness", support.stiffness.as_ref().map(Spanned::span)),
            ("damping", support.damping.as_ref().map(Spanned::span)),
            ("at", support.at.as_ref().map(Spanned::span)),
        ];
        for (number, wall) in walls.iter().enumerate() {
            self.places.push((Subject::nth("wall", first + number).part("name"), support.name.span()));
            for (key, at) in &keys {
                self.places.extend(at.clone().map(|at| (Subject::wall(&wall.name).part(*key), at)));
            }
        }
        let directed = |(wall, flat): (_, &Flat)| {
            let degrees = flat.direction.rem_euclid(180.0) % 180.0;
            let place = Place::Towards { place: Box::new(place.clone()), degrees };
            NewWall { wall, site: flats.name.clone(), place }
        };
        Ok(walls.into_iter().zip(&flats.flats).map(directed).collect())
    }

    /// A round hole: a radial gap, and a contact law.
    fn hole(&mut self, owner: &Owner, support: &file::Support) -> Result<Shape> {
        let file::Support { directions, sides, turn, .. } = support;
        let flat =
            [("directions", directions.as_ref().map(Spanned::span)), ("sides", sides.as_ref().map(Spanned::span))];
        let flat = flat.into_iter().chain([("turn", turn.as_ref().map(Spanned::span))]);
        if let Some((key, Some(at))) = flat.into_iter().find(|(_, at)| at.is_some()) {
            let title = format!("{} is round and has {key}", owner.name);
            return Err(self.source.error(at, &title, "expected shape = \"flats\" beside it, or gap alone: a radius"));
        }
        if self.static_correction {
            let help = "expected shape = \"flats\", or no static_correction: the compliance that modes leave out \
                        makes a wall a spring, and a round hole is rigid";
            let title = format!("{} is round, and static_correction is true", owner.name);
            return Err(self.source.error(support.shape.span(), &title, help));
        }
        let gap = match support.gap.get_ref() {
            Value::Number(gap) if gap.is_finite() && *gap > 0.0 => *gap,
            _ => {
                let wanted = "a number above 0, in m: the radius of the hole less that of the tube; without any \
                              gap the place is a pin, not a support";
                return Err(self.refuse(support.gap.span(), &format!("{}: gap", owner.name), wanted));
            }
        };
        let law = self.law_of(&owner.name, [&support.restitution, &support.stiffness, &support.damping])?;
        let keys = [
            ("gap", Some(support.gap.span())),
            ("restitution", support.restitution.as_ref().map(Spanned::span)),
            ("stiffness", support.stiffness.as_ref().map(Spanned::span)),
            ("damping", support.damping.as_ref().map(Spanned::span)),
        ];
        for (key, at) in keys {
            self.places.extend(at.map(|at| (owner.subject.clone().part(key), at)));
        }
        Ok(Shape::Round { gap, law })
    }

    /// The place that a support surrounds.
    fn place_in_two_planes(&mut self, owner: &Owner, at: Option<&Spanned<Value>>) -> Result<Place> {
        let sites = self.sites((&owner.name, owner.subject.clone()), at, owner.span.clone(), false)?;
        match sites.into_iter().map(|site| (site.suffix, site.place)).collect::<Vec<_>>().as_slice() {
            [(suffix, place)] if suffix.is_empty() && !matches!(place, Place::Row(_)) => Ok(place.clone()),
            _ => {
                let at = at.map_or(owner.span.clone(), Spanned::span);
                let help =
                    "expected a place with a displacement along y and one along z: a position, a dof, or y and z";
                Err(self.source.error(at, &format!("{}: at is not one place in two planes", owner.name), help))
            }
        }
    }

    fn centre(&mut self, owner: &Owner, centre: Option<&Spanned<Vec<Spanned<Number>>>>) -> Result<[f64; 2]> {
        let Some(centre) = centre else { return Ok([0.0; 2]) };
        self.places.push((owner.subject.clone().part("centre"), centre.span()));
        match centre.get_ref().as_slice() {
            [y, z] => Ok([y.get_ref().0, z.get_ref().0]),
            _ => Err(self.refuse(centre.span(), &format!("{}: centre", owner.name), "[y, z], two numbers in m")),
        }
    }

    /// The values on which the depth of a scar depends.
    fn scarred(&mut self, owner: &Owner, support: &file::Support) -> Result<Scarred> {
        let width = self.above_0(&owner.name, "width", "m", support.width.as_ref())?;
        let radius = self.above_0(&owner.name, "radius", "m", support.radius.as_ref())?;
        let (coefficient, support_coefficient) = (&support.coefficient, &support.support_coefficient);
        let first = coefficient.as_ref().or(support_coefficient.as_ref()).map(Spanned::span);
        self.places.extend(first.map(|at| (owner.subject.clone().part("coefficient"), at)));
        let missing = |at: &Spanned<Number>, what: &str, help: &str| -> Error {
            self.source.error(at.span(), &format!("{} has {what}", owner.name), help)
        };
        let tube = if let Model::Beam(beam) = &self.model { Some(0.5 * beam.outer_diameter) } else { None };
        match (&support.width, &support.radius) {
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
        Ok(Scarred {
            scar: width.zip(radius.or(tube)),
            coefficient: self.above_0(&owner.name, "coefficient", "1/Pa", coefficient.as_ref())?,
            support_coefficient: self.above_0(
                &owner.name,
                "support_coefficient",
                "1/Pa",
                support_coefficient.as_ref(),
            )?,
        })
    }

    /// A number above 0 under `key` of `owner`.
    pub fn above_0(&self, owner: &str, key: &str, unit: &str, value: Option<&Spanned<Number>>) -> Result<Option<f64>> {
        let Some(value) = value else { return Ok(None) };
        match value.get_ref().0 {
            x if x.is_finite() && x > 0.0 => Ok(Some(x)),
            _ => Err(self.refuse(value.span(), &format!("{owner}: {key}"), &format!("a number above 0, in {unit}"))),
        }
    }
}
