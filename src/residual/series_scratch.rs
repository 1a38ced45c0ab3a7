//! Work space of the judge for exact motion of structures.

/// Work space for a stretch of exact motion, one entry per degree of freedom.
#[derive(Debug)]
pub(super) struct SeriesScratch {
    /// State at an instant, m and m/s, and the load there, N.
    pub q: Vec<f64>,
    pub v: Vec<f64>,
    pub load: Vec<f64>,
    /// ∫q (m s) and ∫q̇ (m) over the stretch, which are multiplied by K and C once at its end, and
    /// ∫ of the net force, N s.
    pub place: Vec<f64>,
    pub way: Vec<f64>,
    pub net: Vec<f64>,
    /// Mean force of the dashpots, N.
    pub rub: Vec<f64>,
    /// Velocity at the end, before the blows there and after them, m/s.
    pub left: Vec<f64>,
    pub mid: Vec<f64>,
    /// A change of velocity, m/s, and the momentum that the stretch gained and that its start
    /// removed, N s.
    pub change: Vec<f64>,
    pub gained: Vec<f64>,
    pub stopped: Vec<f64>,
}

impl SeriesScratch {
    /// Zeros, n of each.
    pub fn new(n: usize) -> Self {
        let [q, v, load, place, way, net, rub, left, mid, change, gained, stopped] =
            std::array::from_fn(|_| vec![0.0; n]);
        Self { q, v, load, place, way, net, rub, left, mid, change, gained, stopped }
    }
}
