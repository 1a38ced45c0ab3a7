//! A function of time as a load.

use std::fmt;
use std::sync::Arc;

/// A force f(t), N, of the time in s. Two are equal if they are clones of the same one.
#[derive(Clone)]
pub struct TimeFunction(Arc<dyn Fn(f64) -> f64 + Send + Sync>);

impl TimeFunction {
    /// The function `f`, which must depend on the time only.
    #[must_use]
    pub fn new(f: impl Fn(f64) -> f64 + Send + Sync + 'static) -> Self {
        Self(Arc::new(f))
    }

    /// f(`t`), N.
    #[must_use]
    pub fn at(&self, t: f64) -> f64 {
        (self.0)(t)
    }
}

impl fmt::Debug for TimeFunction {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("TimeFunction(..)")
    }
}

impl PartialEq for TimeFunction {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}
