//! Reads the tables `[[support]]`.

use super::builder::Builder;
use super::file;
use super::model::Place;
use super::value::{Number, Section, Value};
use super::walls::{MOST_WALLS, NewWall};
use super::written::Support;
use crate::error::{Result, Subject};
use crate::scene::{Flat, Flats, MOST_FLATS};
use std::ops::Range;
use toml::Spanned;

impl Builder<'_> {
    /// The walls of the support in table `index`, the first of which has index `first` in the
    /// scene.
    pub fn support(&mut self, index: usize, first: usize, section: Section<file::Support>) -> Result<Vec<NewWall>> {
        let Section { span, value: support } = section;
        let name = self.name(&format!("support {}: name", index + 1), &support.name)?;
        let owner = format!("support {name:?}");
        if !self.planes.is_two() {
            let help =
                "expected planes = 2 in [system]; in one plane, two walls: [[wall]] with side = \"both\" and gap";
            return Err(self.source.error(span, &format!("{owner}, and the system moves in one plane"), help));
        }
        if self.written.supports.iter().any(|other| other.flats.name == name) {
            return Err(self.refuse(
                support.name.span(),
                &format!("{owner}: name"),
                "a name of its own for each support",
            ));
        }
        if support.shape.get_ref() != "flats" {
            return Err(self.refuse(support.shape.span(), &format!("{owner}: shape"), "\"flats\""));
        }
        let law = self.law_of(&owner, [&support.restitution, &support.stiffness, &support.damping])?;
        let subject = Subject::support(&name);
        let directions = self.flat_directions(&owner, &subject, &support, &span)?;
        let gaps = self.gaps(&owner, &subject, &support.gap, directions.len())?;
        let centre = self.centre(&owner, &subject, support.centre.as_ref())?;
        let sites = self.sites((&owner, subject), support.at.as_ref(), span.clone(), false)?;
        let place = match sites.into_iter().map(|site| (site.suffix, site.place)).collect::<Vec<_>>().as_slice() {
            [(suffix, place)] if suffix.is_empty() && !matches!(place, Place::Row(_)) => place.clone(),
            _ => {
                let at = support.at.as_ref().map_or(span, Spanned::span);
                let help =
                    "expected a place with a displacement along y and one along z: a position, a dof, or y and z";
                return Err(self.source.error(at, &format!("{owner}: at is not one place in two planes"), help));
            }
        };
        let flats = Flats {
            name: name.clone(),
            at: self.planes.rows(&self.model, &place)?,
            flats: directions.iter().zip(gaps).map(|(&direction, gap)| Flat { direction, gap }).collect(),
            centre,
            law,
        };
        let walls = flats.walls().map_err(|error| self.at_key(error))?;
        if first + walls.len() > MOST_WALLS {
            let title = format!("{owner} makes {} walls", first + walls.len());
            return Err(self.source.error(span, &title, &format!("expected at most {MOST_WALLS} in all")));
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
            NewWall { wall, site: name.clone(), place }
        };
        let new = walls.into_iter().zip(&flats.flats).map(directed).collect();
        self.written.supports.push(Support { flats, place, first });
        Ok(new)
    }

    /// The directions of the flats, as a list or as a number of sides.
    fn flat_directions(
        &mut self,
        owner: &str,
        subject: &Subject,
        support: &file::Support,
        span: &Range<usize>,
    ) -> Result<Vec<f64>> {
        let subject = subject.clone().part("directions");
        let one = "expected directions = [0, 120, 240], in deg, or sides = 3 and, where wanted, turn";
        match (&support.directions, &support.sides, &support.turn) {
            (Some(_), Some(at), _) | (Some(_), None, Some(at)) => {
                Err(self.source.error(at.span(), &format!("{owner} has directions and sides"), one))
            }
            (None, None, _) => {
                Err(self.source.error(span.clone(), &format!("`directions` is missing in {owner}"), one))
            }
            (Some(list), None, None) => {
                self.places.push((subject.clone(), list.span()));
                let each = |(i, x): (usize, &Spanned<Number>)| self.number(subject.clone().value(i), x);
                Ok(list.get_ref().iter().enumerate().map(each).collect())
            }
            (None, Some(sides), turn) => {
                self.places.push((subject, sides.span()));
                let count = self.whole(Subject::support(owner).part("sides"), sides, MOST_FLATS);
                let count = count.map_err(|_| {
                    let expected = format!("a whole number from 1 to {MOST_FLATS}");
                    self.refuse(sides.span(), &format!("{owner}: sides"), &expected)
                })?;
                let from = turn.as_ref().map_or(0.0, |turn| turn.get_ref().0);
                match turn {
                    Some(turn) if !from.is_finite() => {
                        Err(self.refuse(turn.span(), &format!("{owner}: turn"), "a finite number, in deg"))
                    }
                    _ => Ok((0..count).map(|k| from + 360.0 * k as f64 / count as f64).collect()),
                }
            }
        }
    }

    /// The gap of each of `count` flats.
    fn gaps(&mut self, owner: &str, subject: &Subject, gap: &Spanned<Value>, count: usize) -> Result<Vec<f64>> {
        let (key, subject) = (format!("{owner}: gap"), subject.clone().part("gap"));
        self.places.push((subject.clone(), gap.span()));
        let wanted = format!("a number, 0 or more, in m, or a list of {count} of them, one for each flat");
        match gap.get_ref() {
            Value::Number(x) => Ok(vec![*x; count]),
            Value::List(items) if items.len() == count => {
                let mut gaps = Vec::with_capacity(count);
                for (i, item) in items.iter().enumerate() {
                    let Value::Number(x) = item.get_ref() else { return Err(self.refuse(item.span(), &key, &wanted)) };
                    self.places.push((subject.clone().value(i), item.span()));
                    gaps.push(*x);
                }
                Ok(gaps)
            }
            _ => Err(self.refuse(gap.span(), &key, &wanted)),
        }
    }

    fn centre(
        &mut self,
        owner: &str,
        subject: &Subject,
        centre: Option<&Spanned<Vec<Spanned<Number>>>>,
    ) -> Result<[f64; 2]> {
        let Some(centre) = centre else { return Ok([0.0; 2]) };
        self.places.push((subject.clone().part("centre"), centre.span()));
        match centre.get_ref().as_slice() {
            [y, z] => Ok([y.get_ref().0, z.get_ref().0]),
            _ => Err(self.refuse(centre.span(), &format!("{owner}: centre"), "[y, z], two numbers in m")),
        }
    }
}
