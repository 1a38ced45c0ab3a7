//! The largest values of residuals over a run, with and without their rounding errors.

/// The worst residual so far: its value, time (s) and wall. NaN is worse than any number.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct LargestResidual {
    pub value: f64,
    pub time: f64,
    pub wall: Option<usize>,
}

impl LargestResidual {
    pub fn observe(&mut self, value: f64, time: f64, wall: Option<usize>) {
        if !self.value.is_nan() && (value > self.value || value.is_nan()) {
            *self = Self { value, time, wall };
        }
    }

    pub fn over(self, scale: f64) -> Self {
        Self { value: over(self.value, scale), ..self }
    }
}

/// A residual of a run: the largest value, and the largest excess over the rounding error of its
/// terms, by which the run is accused.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Residual {
    pub value: f64,
    pub excess: LargestResidual,
}

impl Residual {
    /// Notes a residual with its rounding error `noise`, of the step that ends at `time` (s).
    pub fn observe(&mut self, value: f64, noise: f64, time: f64, wall: Option<usize>) {
        self.value = self.value.max(value);
        self.excess.observe(value - noise, time, wall);
    }
}

/// x over a scale; 0 where x is, whatever the scale.
pub(super) fn over(x: f64, scale: f64) -> f64 {
    if x == 0.0 { 0.0 } else { x / scale }
}
