//! The methods of a comparison under the same realisations of random loads.

use super::Comparison;
use crate::error::{Error, Result};
use crate::run::Run;
use crate::scheme::Method;
use crate::study::realisations::{Difference, Estimate, RealisationStudy, Realisations, Refined};
use std::fmt::{self, Display, Formatter};

/// One method under all realisations.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct MethodStudy {
    /// The method.
    pub method: String,
    /// Its realisations.
    pub study: Realisations,
    /// What it differs by from the reference; empty for the reference itself.
    pub differences: Vec<Difference>,
}

impl MethodStudy {
    /// What its mean differs by from that of the reference.
    #[must_use]
    pub fn less(&self, mean: &Estimate) -> Option<&Difference> {
        self.differences.iter().find(|less| less.place == mean.place && less.measure == mean.measure)
    }
}

/// Why a method has no means, or why a part of their errors is not known.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct MethodFailure {
    /// The method.
    pub method: String,
    /// What is refined in the check that failed; `None` where a realisation did.
    pub refined: Option<Refined>,
    /// Why.
    pub error: Error,
    /// The number of realisations asked for.
    count: u64,
}

impl Display for MethodFailure {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let Self { method, refined, error, count } = self;
        match refined {
            Some(refined) => write!(f, "the check of the means of {method} with {refined} failed: {error}"),
            None => write!(f, "{method} has no means: one of {count} realisations failed: {error}"),
        }
    }
}

/// Methods under all realisations.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct MethodStudies {
    /// The number of realisations.
    pub count: u64,
    /// The method that differences are taken from: the exact one where it has means, else the
    /// first.
    pub reference: String,
    /// The methods that have means.
    pub methods: Vec<MethodStudy>,
    /// What kept methods or parts of errors out of it.
    pub failures: Vec<MethodFailure>,
}

impl MethodStudies {
    /// The studies of `count` realisations by each method of `comparison` that ran, whose runs are
    /// the first realisation; `make` makes each.
    ///
    /// # Errors
    /// [`Error::Stopped`] of `make`; its other errors are failures of the method.
    pub fn of(
        comparison: &Comparison,
        count: u64,
        make: &mut dyn FnMut(&Run, &Method) -> Result<RealisationStudy>,
    ) -> Result<Self> {
        let mut studies = Self { count, reference: String::new(), methods: Vec::new(), failures: Vec::new() };
        let mut exact = None;
        for row in &comparison.rows {
            let Ok(run) = &row.outcome else { continue };
            let method = row.method.to_string();
            match make(run, &row.method) {
                Ok(study) => {
                    exact = exact.or(row.method.scheme.is_exact().then_some(studies.methods.len()));
                    studies.add(method, study);
                }
                Err(Error::Stopped) => return Err(Error::Stopped),
                Err(error) => studies.failures.push(MethodFailure { method, refined: None, error, count }),
            }
        }
        studies.compare(exact.unwrap_or(0));
        Ok(studies)
    }

    /// Adds the study of `method`.
    fn add(&mut self, method: String, study: RealisationStudy) {
        self.failures.extend(study.failures.into_iter().map(|failed| MethodFailure {
            method: method.clone(),
            refined: Some(failed.refined),
            error: failed.error,
            count: self.count,
        }));
        self.methods.push(MethodStudy { method, study: study.realisations, differences: Vec::new() });
    }

    /// Fills in the differences from the method at `reference`.
    fn compare(&mut self, reference: usize) {
        let Some(other) = self.methods.get(reference) else { return };
        let less = |(index, one): (usize, &MethodStudy)| {
            if index == reference { Vec::new() } else { Difference::all(&one.study, &other.study) }
        };
        let all: Vec<Vec<Difference>> = self.methods.iter().enumerate().map(less).collect();
        self.reference.clone_from(&other.method);
        self.methods.iter_mut().zip(all).for_each(|(one, differences)| one.differences = differences);
    }
}
