//! Work space of the judge for one step.

/// Vectors of length n that a step needs.
#[derive(Debug, Clone)]
pub(super) struct Scratch {
    pub load_end: Vec<f64>,
    pub load: Vec<f64>,
    pub blow: Vec<f64>,
    /// Change of velocity by the blows, m/s.
    pub struck: Vec<f64>,
    /// The displacement that the blows of a step add to that of its rule, m, zero in steps without
    /// a blow; and the displacement at the step's end without it.
    pub beyond: Vec<f64>,
    pub arrived: Vec<f64>,
    /// The displacement by blows whose velocity the damper feels in the step's balance, m.
    pub felt: Vec<f64>,
    pub mean_q: Vec<f64>,
    pub mean_v: Vec<f64>,
    /// Change of velocity, m/s.
    pub gained: Vec<f64>,
    pub residual: Vec<f64>,
    pub inertia: Vec<f64>,
    pub damper: Vec<f64>,
    pub spring: Vec<f64>,
}

impl Scratch {
    /// Zeros for n degrees of freedom.
    pub fn new(n: usize) -> Self {
        let zero = || vec![0.0; n];
        Self {
            load_end: zero(),
            load: zero(),
            blow: zero(),
            struck: zero(),
            beyond: zero(),
            arrived: zero(),
            felt: zero(),
            mean_q: zero(),
            mean_v: zero(),
            gained: zero(),
            residual: zero(),
            inertia: zero(),
            damper: zero(),
            spring: zero(),
        }
    }
}
