//! A structure shared by many users.

use super::scales;
use super::structure::{self, Structure};
use crate::error::Result;
use crate::linear::{Factor, NotDefinite, Operator};
use serde::{Deserialize, Serialize, Serializer};
use std::fmt;
use std::ops::{Deref, DerefMut};
use std::sync::{Arc, OnceLock};

/// A [`Structure`] that scenes, steppers and judges share without copying its matrices, together
/// with quantities derived from them once: whether they are valid, the factor of M, the
/// frequencies. A change through `DerefMut` applies to a copy if there are other users, and
/// discards the derived quantities.
#[derive(Clone, Default, Deserialize)]
#[serde(from = "Structure")]
pub struct SharedStructure(Arc<Inner>);

#[derive(Default)]
struct Inner {
    structure: Structure,
    checked: OnceLock<Result<()>>,
    mass: OnceLock<std::result::Result<Factor, NotDefinite>>,
    frequencies: OnceLock<[f64; 2]>,
    ratios: OnceLock<[f64; 2]>,
    operators: OnceLock<Arc<[Operator; 3]>>,
}

impl SharedStructure {
    /// As [`Structure::validate`], once.
    pub(super) fn validate(&self) -> Result<()> {
        self.0.checked.get_or_init(|| structure::validate(self, || self.mass_factor().map(|_| ()))).clone()
    }

    /// The factor of M, made once.
    pub(crate) fn mass_factor(&self) -> std::result::Result<Factor, NotDefinite> {
        self.0.mass.get_or_init(|| Factor::new(&self.mass)).clone()
    }

    /// M, C and K ready for products, made once.
    pub(crate) fn operators(&self) -> Arc<[Operator; 3]> {
        let new = || Arc::new([&self.mass, &self.damping, &self.stiffness].map(Operator::new));
        Arc::clone(self.0.operators.get_or_init(new))
    }

    /// The largest λ of C x = λ M x (1/s) and of K x = λ M x (1/s²), found once, by `find`.
    pub(crate) fn ratios(&self, find: impl FnOnce() -> [f64; 2]) -> [f64; 2] {
        *self.0.ratios.get_or_init(find)
    }

    /// As [`System::frequencies`](super::System::frequencies), computed once.
    pub(super) fn frequencies(&self) -> [f64; 2] {
        *self.0.frequencies.get_or_init(|| scales::frequencies(self, self.mass_factor().ok()))
    }
}

impl Deref for SharedStructure {
    type Target = Structure;

    fn deref(&self) -> &Structure {
        &self.0.structure
    }
}

impl DerefMut for SharedStructure {
    fn deref_mut(&mut self) -> &mut Structure {
        let inner = Arc::make_mut(&mut self.0);
        *inner = Inner::from(std::mem::take(&mut inner.structure));
        &mut inner.structure
    }
}

impl From<Structure> for Inner {
    fn from(structure: Structure) -> Self {
        Self { structure, ..Self::default() }
    }
}

impl Clone for Inner {
    fn clone(&self) -> Self {
        self.structure.clone().into()
    }
}

impl From<Structure> for SharedStructure {
    fn from(structure: Structure) -> Self {
        Self(Arc::new(structure.into()))
    }
}

impl Serialize for SharedStructure {
    fn serialize<S: Serializer>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error> {
        (**self).serialize(serializer)
    }
}

impl PartialEq for SharedStructure {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0) || **self == **other
    }
}

impl fmt::Debug for SharedStructure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        (**self).fmt(f)
    }
}
