//! Matrices from files, and the table `[system.damping]`.

use super::builder::Builder;
use super::report::Source;
use super::value::Section;
use crate::error::{Result, Subject};
use crate::linear::Symmetric;
use crate::scene::matrices::{read_csv, read_matrix_market};
use crate::scene::{Damping, Structure, of_size};
use std::path::Path;
use toml::Spanned;

impl Builder<'_> {
    /// Reads `[system.matrices]`: a structure from three files.
    pub fn matrices(&mut self, matrices: &Section<'_>) -> Result<Structure> {
        let mass = self.matrix("mass", &matrices.required_word("mass"))?;
        let stiffness = self.matrix("stiffness", &matrices.required_word("stiffness"))?;
        let damping = match matrices.word("damping") {
            Some(file) => self.matrix("damping", &file)?,
            None => Symmetric::zeros(mass.size()),
        };
        // What is computed of them before the structure is checked takes them to be of one size.
        for (name, matrix) in [("stiffness", &stiffness), ("damping", &damping)] {
            of_size(name, matrix, mass.size()).map_err(|error| self.at_key(error))?;
        }
        Ok(Structure { mass, damping, stiffness })
    }

    fn matrix(&mut self, what: &str, file: &Spanned<&str>) -> Result<Symmetric> {
        // The structure names an invalid matrix by this key.
        self.positions.push((Subject::of("system").part(format!("{what} matrix")), file.span()));
        let (name, owner) = (*file.get_ref(), format!("{what} matrix"));
        let expected = "expected a Matrix Market file (.mtx) or a CSV file of all rows (.csv)";
        let opened = self.open(&owner, name, file.span(), expected);
        let extension = Path::new(name).extension().and_then(|e| e.to_str()).map(str::to_ascii_lowercase);
        let read = match extension.as_deref() {
            Some("mtx") => read_matrix_market,
            Some("csv") => read_csv,
            _ => {
                let help = format!("{expected}; its path is relative to the case file");
                return Err(self.source.error(file.span(), &format!("{owner} {name:?}: neither .mtx nor .csv"), &help));
            }
        };
        let (path, text) = opened?;
        read(&text).map_err(|error| {
            let source = Source { name: &path, text: &text };
            source.error(error.span.clone(), &error.message, &format!("expected {}", error.expected))
        })
    }

    /// Reads the table `damping` of a system or body, which must specify exactly one kind of
    /// damping.
    pub fn damping(&mut self, damping: &Section<'_>) -> Result<Damping> {
        self.positions.push(("damping".into(), damping.span.clone()));
        let kinds = ["rayleigh", "ratio", "ratios", "matrix"];
        let mut given = kinds.into_iter().filter_map(|kind| Some((kind, damping.span_of(kind)?)));
        let key = format!("{}.damping", self.owner);
        let help = "expected one of rayleigh = { mass, stiffness }, ratio, ratios, matrix";
        if let (Some((first, _)), Some((second, span))) = (given.next(), given.next()) {
            let title = format!("`{key}` has two kinds, `{first}` and `{second}`");
            return Err(self.source.error(span, &title, help));
        }
        if let Some(rayleigh) = damping.section("rayleigh") {
            let coefficient = |part: &str| -> Result<f64> {
                let Some(value) = rayleigh.number(part) else { return Ok(0.0) };
                self.nonnegative(&format!("{key}.rayleigh.{part}"), &value)
            };
            return Ok(Damping::Rayleigh { mass: coefficient("mass")?, stiffness: coefficient("stiffness")? });
        }
        if let Some(ratio) = damping.number("ratio") {
            return Ok(self.modal_damping(vec![self.nonnegative(&format!("{key}.ratio"), &ratio)?]));
        }
        if let Some(ratios) = damping.numbers("ratios") {
            if ratios.get_ref().is_empty() {
                return Err(self.refuse(ratios.span(), &format!("{key}.ratios"), "one ratio or more"));
            }
            let subject = Subject::from(("damping", "ratios"));
            self.positions.push((subject.clone(), ratios.span()));
            let mut all = Vec::with_capacity(ratios.get_ref().len());
            for (i, ratio) in ratios.get_ref().iter().enumerate() {
                self.positions.push((subject.clone().value(i), ratio.span()));
                all.push(self.above_minus_one(&format!("{key}.ratios"), ratio)?);
            }
            return Ok(self.modal_damping(all));
        }
        match damping.word("matrix") {
            Some(file) => {
                self.positions.push((("damping", "matrix").into(), file.span()));
                Ok(Damping::Matrix(self.matrix("damping", &file)?))
            }
            None => Err(self.source.error(damping.span.clone(), &format!("`{key}` has no kind of damping"), help)),
        }
    }

    /// Damping by the ratios of modes, which it notes.
    fn modal_damping(&mut self, ratios: Vec<f64>) -> Damping {
        self.note_ratios(&ratios);
        Damping::Modal(ratios)
    }

    /// Notes damping ratios that the file gives.
    pub fn note_ratios(&mut self, ratios: &[f64]) {
        let all = ratios.iter().copied().chain(self.written.damping_ratio);
        self.written.damping_ratio = all.reduce(f64::max);
    }

    fn above_minus_one(&self, key: &str, value: &Spanned<f64>) -> Result<f64> {
        let x = *value.get_ref();
        if x.is_finite() && x > -1.0 { Ok(x) } else { Err(self.refuse(value.span(), key, "a finite number above -1")) }
    }

    fn nonnegative(&self, key: &str, value: &Spanned<f64>) -> Result<f64> {
        let x = *value.get_ref();
        if x.is_finite() && x >= 0.0 {
            Ok(x)
        } else {
            Err(self.refuse(value.span(), key, "a finite number, 0 or more"))
        }
    }
}
