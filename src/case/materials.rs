//! Reads the tables `[[material]]`: wear coefficients of pairs of materials, which supports name.

use super::builder::{Builder, Material};
use super::value::Section;
use crate::error::Result;

impl Builder<'_> {
    /// The materials of the file.
    pub fn materials(&self, file: &Section<'_>) -> Result<Vec<Material>> {
        let mut materials: Vec<Material> = Vec::new();
        for table in file.sections("material") {
            let name = table.required_word("name");
            self.name("material: name", name.get_ref(), name.span())?;
            if materials.iter().any(|other| other.name == *name.get_ref()) {
                let title = format!("two materials are named {:?}", name.get_ref());
                return Err(self.source.error(name.span(), &title, "expected a name of its own for each"));
            }
            let number = |key| self.above_0(&format!("material {:?}", name.get_ref()), key, "1/Pa", &table);
            let (coefficient, support_coefficient) = (number("coefficient")?, number("support_coefficient")?);
            if coefficient.or(support_coefficient).is_none() {
                let title = format!("material {:?} has no wear coefficient", name.get_ref());
                let help = "expected coefficient of the tube, support_coefficient or both, in 1/Pa";
                return Err(self.source.error(table.span.clone(), &title, help));
            }
            let name = (*name.get_ref()).to_owned();
            materials.push(Material { name, coefficient, support_coefficient });
        }
        Ok(materials)
    }

    /// The material that the `support` called `owner` names.
    pub fn material(&self, owner: &str, support: &Section<'_>) -> Result<Option<&Material>> {
        let Some(name) = support.word("material") else { return Ok(None) };
        for key in ["coefficient", "support_coefficient"] {
            if let Some(at) = support.span_of(key) {
                let title = format!("{owner} has a material and a {key}");
                return Err(self.source.error(at, &title, "expected one of both: a material has the coefficients"));
            }
        }
        let known = self.materials.iter().find(|material| material.name == *name.get_ref());
        known.map(Some).ok_or_else(|| {
            let names: Vec<String> = self.materials.iter().map(|material| format!("{:?}", material.name)).collect();
            let help = match names.as_slice() {
                [] => "expected the name of a [[material]], of which there is none".to_owned(),
                _ => format!("expected the name of a [[material]]: {}", names.join(", ")),
            };
            self.source.error(name.span(), &format!("{owner}: no material is named {:?}", name.get_ref()), &help)
        })
    }
}
