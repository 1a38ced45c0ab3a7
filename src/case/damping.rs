//! Matrices from files, and the table `[system.damping]`.

use super::builder::Builder;
use super::file;
use super::report::Source;
use super::value::Section;
use crate::error::{Result, Subject};
use crate::linear::Symmetric;
use crate::scene::matrices::{read_csv, read_matrix_market};
use crate::scene::{Damping, Structure};
use std::path::Path;
use toml::Spanned;

impl Builder<'_> {
    /// Reads `[system.matrices]`: a structure from three files.
    pub fn matrices(&mut self, matrices: &file::Matrices) -> Result<Structure> {
        let mass = self.matrix("mass", &matrices.mass)?;
        let stiffness = self.matrix("stiffness", &matrices.stiffness)?;
        let damping = match &matrices.damping {
            Some(file) => self.matrix("damping", file)?,
            None => Symmetric::zeros(mass.size()),
        };
        let files = [
            ("mass", Some(&matrices.mass)),
            ("stiffness", Some(&matrices.stiffness)),
            ("damping", matrices.damping.as_ref()),
        ];
        let named = files.into_iter().filter_map(|(key, file)| Some((key, file?.get_ref().clone())));
        self.written.matrices.extend(named);
        Ok(Structure { mass, damping, stiffness })
    }

    fn matrix(&mut self, what: &str, file: &Spanned<String>) -> Result<Symmetric> {
        // The structure names an invalid matrix by this key.
        self.places.push((Subject::of("system").part(format!("{what} matrix")), file.span()));
        let name = file.get_ref();
        let opened = self.open(name);
        let refuse = |reason: &str| {
            let help = "expected a Matrix Market file (.mtx) or a CSV file of all rows (.csv); its path is \
                        relative to the case file";
            self.source.error(file.span(), &format!("{what} matrix {name:?}: {reason}"), help)
        };
        let extension = Path::new(name).extension().and_then(|e| e.to_str()).map(str::to_ascii_lowercase);
        let read = match extension.as_deref() {
            Some("mtx") => read_matrix_market,
            Some("csv") => read_csv,
            _ => return Err(refuse("neither .mtx nor .csv")),
        };
        let (path, text) = opened.map_err(|reason| refuse(&reason))?;
        read(&text).map_err(|error| {
            let source = Source { name: &path, text: &text };
            source.error(error.span.clone(), &error.message, &format!("expected {}", error.expected))
        })
    }

    /// Reads `[system.damping]`, which must specify exactly one kind of damping.
    pub fn damping(&mut self, section: Section<file::Damping>) -> Result<Damping> {
        let Section { span, value: damping } = section;
        self.places.push(("damping".into(), span.clone()));
        let given: Vec<_> = [
            ("rayleigh", damping.rayleigh.as_ref().map(|s| s.span.clone())),
            ("ratio", damping.ratio.as_ref().map(Spanned::span)),
            ("ratios", damping.ratios.as_ref().map(Spanned::span)),
            ("matrix", damping.matrix.as_ref().map(Spanned::span)),
        ]
        .into_iter()
        .filter_map(|(kind, span)| Some((kind, span?)))
        .collect();
        let help = "expected one of rayleigh = { mass, stiffness }, ratio, ratios, matrix";
        if let [(first, _), (second, span), ..] = given.as_slice() {
            let title = format!("`system.damping` has two kinds, `{first}` and `{second}`");
            return Err(self.source.error(span.clone(), &title, help));
        }
        if let Some(Section { value: rayleigh, .. }) = &damping.rayleigh {
            let coefficient = |key: &str, value: &Option<_>| -> Result<f64> {
                let Some(value) = value else { return Ok(0.0) };
                self.nonnegative(&format!("system.damping.rayleigh.{key}"), value)
            };
            let mass = coefficient("mass", &rayleigh.mass)?;
            let stiffness = coefficient("stiffness", &rayleigh.stiffness)?;
            return Ok(Damping::Rayleigh { mass, stiffness });
        }
        if let Some(ratio) = &damping.ratio {
            return Ok(Damping::Modal(vec![self.nonnegative("system.damping.ratio", ratio)?]));
        }
        if let Some(ratios) = &damping.ratios {
            if ratios.get_ref().is_empty() {
                return Err(self.refuse(ratios.span(), "system.damping.ratios", "one ratio or more"));
            }
            let subject = Subject::from(("damping", "ratios"));
            let mut all = Vec::with_capacity(ratios.get_ref().len());
            for (i, ratio) in ratios.get_ref().iter().enumerate() {
                self.places.push((subject.clone().value(i), ratio.span()));
                all.push(self.above_minus_one("system.damping.ratios", ratio)?);
            }
            return Ok(Damping::Modal(all));
        }
        match &damping.matrix {
            Some(file) => {
                self.places.push((("damping", "matrix").into(), file.span()));
                self.written.matrices.push(("matrix", file.get_ref().clone()));
                Ok(Damping::Matrix(self.matrix("damping", file)?))
            }
            None => Err(self.source.error(span, "`system.damping` has no kind of damping", help)),
        }
    }

    fn above_minus_one(&self, key: &str, value: &Spanned<super::value::Number>) -> Result<f64> {
        let x = value.get_ref().0;
        if x.is_finite() && x > -1.0 { Ok(x) } else { Err(self.refuse(value.span(), key, "a finite number above -1")) }
    }

    fn nonnegative(&self, key: &str, value: &Spanned<super::value::Number>) -> Result<f64> {
        let x = value.get_ref().0;
        if x.is_finite() && x >= 0.0 {
            Ok(x)
        } else {
            Err(self.refuse(value.span(), key, "a finite number, 0 or more"))
        }
    }
}
