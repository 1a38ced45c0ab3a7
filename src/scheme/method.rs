//! A method: a scheme and the solver of its quadratic programmes, as one word.

use super::Scheme;
use crate::error::{Error, Result};
use crate::qp::Backend;
use std::fmt;
use std::str::FromStr;

/// The scheme and the solver of one run. Written `moreau-jean`,
/// `moreau-jean:theta=0.6,qp=clarabel`, `penalty:epsilon=1e-9` and the like.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Method {
    /// The scheme.
    pub scheme: Scheme,
    /// The solver of the quadratic programmes of the steps that meet a wall.
    pub backend: Backend,
}

impl Method {
    /// A scheme with the solver that is chosen by the size of the scene.
    #[must_use]
    pub fn new(scheme: Scheme) -> Self {
        Self { scheme, backend: Backend::Auto }
    }
}

impl From<Scheme> for Method {
    fn from(scheme: Scheme) -> Self {
        Self::new(scheme)
    }
}

impl fmt::Display for Method {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let scheme = self.scheme.to_string();
        f.write_str(&scheme)?;
        match self.backend {
            Backend::Auto => Ok(()),
            backend => write!(f, "{}qp={backend}", if scheme.contains(':') { ',' } else { ':' }),
        }
    }
}

impl FromStr for Method {
    type Err = crate::error::Error;

    fn from_str(text: &str) -> Result<Self> {
        let (name, settings) = text.trim().split_once(':').unwrap_or((text.trim(), ""));
        let mut backend = Backend::Auto;
        let mut rest = Vec::new();
        for part in settings.split(',').filter(|part| !part.trim().is_empty()) {
            match part.trim().strip_prefix("qp=") {
                Some(solver) => backend = solver.trim().parse()?,
                None => rest.push(part),
            }
        }
        let scheme: Scheme =
            if rest.is_empty() { name.parse()? } else { format!("{name}:{}", rest.join(",")).parse()? };
        if backend != Backend::Auto && !scheme.has_qp() {
            let expected = "a scheme that solves quadratic programmes";
            return Err(Error::invalid(format!("qp={backend}"), format!("beside {scheme}"), expected));
        }
        Ok(Self { scheme, backend })
    }
}
