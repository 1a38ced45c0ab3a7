//! Reads the tables `[[body]]`: several systems in one scene, which only walls and supports couple.
//!
//! M, C and K are block-diagonal, and the row of a wall between two bodies is the difference of two
//! rows, each on one body: w = g₁ q₁ − g₂ q₂.

use super::builder::Builder;
use super::model::{Body, Model};
use super::system::has_damping;
use super::value::Section;
use crate::error::Result;
use crate::scene::Structure;
use std::ops::Range;

impl Builder<'_> {
    /// All bodies and their structure in one plane, uncoupled.
    pub fn bodies(&mut self, tables: &[Section<'_>], two: bool) -> Result<(Model, Structure)> {
        let (mut bodies, mut structures): (Vec<Body>, Vec<Structure>) = (Vec::new(), Vec::new());
        let mut first = 0;
        for (index, table) in tables.iter().enumerate() {
            let key = format!("body {}: name", index + 1);
            let name = self.name_of(&key, table)?;
            if bodies.iter().any(|other| other.name == name) {
                let span = table.required_word("name").span();
                return Err(self.refuse(span, &key, "a name of its own for each body"));
            }
            // The values of a body stand under the same subjects as those of the others; once it is
            // built, no error is about them.
            let others = std::mem::take(&mut self.positions);
            self.owner = "body";
            let (model, structure) = self.one_body(&name, table, two)?;
            self.owner = "system";
            self.positions = others;
            let joints = std::mem::take(&mut self.joints);
            let dofs = first..first + structure.mass.size();
            first = dofs.end;
            bodies.push(Body { name, model, joints, dofs });
            structures.push(structure);
        }
        let structure = Structure::uncoupled(&structures.iter().collect::<Vec<_>>());
        Ok((Model::Bodies(bodies), structure))
    }

    /// The model and the structure in one plane of the body `name`.
    fn one_body(&mut self, name: &str, table: &Section<'_>, two: bool) -> Result<(Model, Structure)> {
        let (kind, system) = self.kind_of(table)?;
        if let ("matrices" | "modal", true) = (kind, two) {
            let title = format!("`system.planes` is 2, and the body {name:?} is given by {kind}");
            let help = "expected an oscillator, chain or beam, the same in both planes; or no planes";
            return Err(self.source.error(system.span, &title, help));
        }
        if let ("bar", true) = (kind, two) {
            return Err(self.bar_in_two_planes(system.span));
        }
        let (model, structure) = if kind == "oscillator" {
            let oscillator = self.oscillator_of(&system);
            oscillator.validate().map_err(|error| self.at_key(error))?;
            (Model::Oscillator, Structure::clone(&oscillator.structure()))
        } else {
            self.structure(table, kind, &system, two)?
        };
        let own = kind == "oscillator" || has_damping(kind, &system);
        match self.damped(table, structure, own, false)? {
            (structure, None) => Ok((model, structure)),
            (_, Some(_)) => {
                let title = format!("the body {name:?} is damped by its stiffness, and has a place without mass");
                let help = "expected [system.damping] for all bodies, in place of [body.damping]";
                Err(self.source.error(table.span_of("damping").unwrap_or(table.span.clone()), &title, help))
            }
        }
    }

    /// The body that `name`, at `span`, names.
    pub fn body_named(&self, key: &str, name: &str, span: Range<usize>) -> Result<Body> {
        self.model.body(name).cloned().ok_or_else(|| self.refuse(span, key, &self.names_of_bodies()))
    }

    /// The names of the bodies, as a message lists them.
    pub fn names_of_bodies(&self) -> String {
        let Model::Bodies(bodies) = &self.model else { return "no body: the case has one system".to_owned() };
        let names: Vec<String> = bodies.iter().map(|body| format!("{:?}", body.name)).collect();
        format!("the name of a body: {}", names.join(", "))
    }

    /// What `read` reads of the places of `body`, as if it were the only system.
    pub fn on_body<T>(&mut self, body: Body, read: impl FnOnce(&mut Self) -> Result<T>) -> Result<T> {
        let model = std::mem::replace(&mut self.model, body.model);
        let joints = std::mem::replace(&mut self.joints, body.joints);
        let n = std::mem::replace(&mut self.n, body.dofs.len());
        self.body = Some(body.name);
        let found = read(self);
        (self.model, self.joints, self.n, self.body) = (model, joints, n, None);
        found
    }
}
