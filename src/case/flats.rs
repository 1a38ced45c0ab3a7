//! Reads the directions and gaps of the flats of a `[[support]]`.

use super::builder::Builder;
use super::supports::Owner;
use super::value::{Section, Value};
use crate::error::{Result, Subject};
use crate::scene::MOST_FLATS;
use toml::Spanned;

impl Builder<'_> {
    /// The directions of the flats, as a list or as a number of sides.
    pub fn flat_directions(&mut self, owner: &Owner, support: &Section<'_>) -> Result<Vec<f64>> {
        let Owner { name: owner, subject, span, .. } = owner;
        let subject = subject.clone().part("directions");
        let one = "expected directions = [0, 120, 240], in deg, or sides = 3 and, where wanted, turn";
        match (support.numbers("directions"), support.number("sides"), support.number("turn")) {
            (Some(_), Some(at), _) | (Some(_), None, Some(at)) => {
                Err(self.source.error(at.span(), &format!("{owner} has directions and sides"), one))
            }
            (None, None, _) => {
                Err(self.source.error(span.clone(), &format!("`directions` is missing in {owner}"), one))
            }
            (Some(list), None, None) => {
                self.positions.push((subject.clone(), list.span()));
                let each = |(i, x): (usize, &Spanned<f64>)| self.number(subject.clone().value(i), x);
                Ok(list.get_ref().iter().enumerate().map(each).collect())
            }
            (None, Some(sides), turn) => {
                self.positions.push((subject, sides.span()));
                let count = self.whole_number(Subject::support(owner).part("sides"), &sides, MOST_FLATS);
                let count = count.map_err(|_| {
                    let expected = format!("a whole number from 1 to {MOST_FLATS}");
                    self.refuse(sides.span(), &format!("{owner}: sides"), &expected)
                })?;
                let from = turn.as_ref().map_or(0.0, |turn| *turn.get_ref());
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
    pub fn gaps(&mut self, owner: &Owner, support: &Section<'_>, count: usize) -> Result<Vec<f64>> {
        let Some(gap) = support.get("gap") else { return Ok(vec![f64::NAN; count]) };
        let (key, subject) = (format!("{}: gap", owner.name), owner.subject.clone().part("gap"));
        self.positions.push((subject.clone(), gap.span()));
        let wanted = format!("a number, 0 or more, in m, or a list of {count} of them, one for each flat");
        match gap.get_ref() {
            Value::Number(x) => Ok(vec![*x; count]),
            Value::List(items) if items.len() == count => {
                let mut gaps = Vec::with_capacity(count);
                for (i, item) in items.iter().enumerate() {
                    let Value::Number(x) = item.get_ref() else { return Err(self.refuse(item.span(), &key, &wanted)) };
                    self.positions.push((subject.clone().value(i), item.span()));
                    gaps.push(*x);
                }
                Ok(gaps)
            }
            _ => Err(self.refuse(gap.span(), &key, &wanted)),
        }
    }
}
