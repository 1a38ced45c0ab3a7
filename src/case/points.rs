//! Points of modes: their names, and how `at` gives them.

use super::builder::Builder;
use super::model::{Model, Place};
use super::planes::Planes;
use super::value::Value;
use crate::error::Result;
use crate::scene::ModalData;
use toml::Spanned;

/// Most points that a message lists.
const MOST_POINTS: usize = 20;

/// These names, the first of them where there are many.
pub(super) fn listed(names: &[&str]) -> String {
    let more = if names.len() > MOST_POINTS { ", .." } else { "" };
    format!("{}{more}", names.iter().take(MOST_POINTS).copied().collect::<Vec<_>>().join(", "))
}

impl Builder<'_> {
    /// One point of modes by its name, or pairs of a name and a weight.
    pub fn points(&self, key: &str, value: &Spanned<Value<'_>>) -> Result<Place> {
        let Model::Modal(modal) = &self.model else { return Ok(Place::Points(Vec::new())) };
        let names = self.points_of(modal);
        let known = |word: &Spanned<Value<'_>>| match word.get_ref() {
            Value::Word(name) if names.iter().any(|point| *point == name.as_ref()) => Ok(name.to_string()),
            _ => Err(self.refuse(word.span(), key, &self.wanted_point(&names))),
        };
        if key.ends_with(": point") {
            return Ok(Place::Points(vec![(known(value)?, 1.0)]));
        }
        let mut points: Vec<(String, f64)> = Vec::new();
        for (name, weight) in
            self.pairs(key, value, "pairs of a point and a weight, each once: [[\"tip\", 1.0], [\"base\", -1.0]]")?
        {
            let point = known(name)?;
            if points.iter().any(|other| other.0 == point) {
                return Err(self.refuse(name.span(), key, "each point once"));
            }
            points.push((point, self.finite(&format!("{key}: weight"), weight, "a finite number")?));
        }
        Ok(Place::Points(points))
    }

    /// The names of points: those of their shapes, in two planes without the plane at the end,
    /// where both planes have one.
    pub fn points_of<'m>(&self, modal: &'m ModalData) -> Vec<&'m str> {
        let names = modal.points.iter().map(|point| point.name.as_str());
        if self.planes != Planes::Named {
            return names.collect();
        }
        let other = |name: &str| modal.points.iter().any(|point| point.name.strip_suffix("-z") == Some(name));
        names.filter_map(|name| name.strip_suffix("-y")).filter(|name| other(name)).collect()
    }

    /// What is accepted as a point, of these.
    pub fn wanted_point(&self, names: &[&str]) -> String {
        let two = self.planes == Planes::Named;
        let what = if two { "a point with the shapes NAME-y and NAME-z" } else { "a point of shapes" };
        match names {
            [] if two => format!("{what}: in two planes shapes must define both"),
            [] => "the name of a point, which shapes must define".to_owned(),
            _ => format!("{what}: {}", listed(names)),
        }
    }
}
