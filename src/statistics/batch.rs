//! Batch means: how much a mean scatters from one part of the window to the next.
//!
//! The window is cut into ten equal batches. A mean over time has the 95 % interval of the mean of
//! its ten batch means, by Student's t with nine degrees of freedom (Schmeiser, Batch size effects
//! in the analysis of simulation output, Operations Research 30(3), 1982,
//! doi:10.1287/opre.30.3.556: ten to thirty batches, more bring no gain). A mean over episodes is a
//! ratio, Σ of a quantity over the number of episodes; both scatter, and its interval is that of
//! the ratio estimator (see [`ratio_half_width`]).

/// Number of batches of the window.
pub(super) const BATCHES: usize = 10;

/// Student's t for 95 %, two-sided, with nine degrees of freedom.
const STUDENT: f64 = 2.262_157_162_798_205;

/// The batch of a window of `length` (s) in which the time `after` (s) its start lies.
pub(super) fn batch_of(after: f64, length: f64) -> usize {
    ((after / length * BATCHES as f64) as usize).min(BATCHES - 1)
}

/// Half width of the 95 % interval of the mean of ten batch means.
pub(super) fn half_width(batches: &[f64; BATCHES]) -> f64 {
    let count = BATCHES as f64;
    let mean = batches.iter().sum::<f64>() / count;
    let square = batches.iter().map(|x| (x - mean) * (x - mean)).sum::<f64>() / (count - 1.0);
    STUDENT * (square / count).sqrt()
}

/// Half width of the 95 % interval of the ratio R = Σxₖ/Σnₖ, from the sums xₖ and the numbers nₖ of
/// ten batches.
///
/// The ratio estimator: to first order the error of R is the mean of zₖ = xₖ − R nₖ over the mean
/// of nₖ, so that the half width is t √(s_z²/10) / n̄ with s_z² = Σzₖ²/9 (Crane & Iglehart,
/// Simulating stable stochastic systems III, Operations Research 23(1), 1975,
/// doi:10.1287/opre.23.1.33, with batches in the place of regenerative cycles). `None` where
/// nothing was counted.
pub(super) fn ratio_half_width(sums: &[f64; BATCHES], numbers: &[f64; BATCHES]) -> Option<f64> {
    let all: f64 = numbers.iter().sum();
    if all <= 0.0 {
        return None;
    }
    let ratio = sums.iter().sum::<f64>() / all;
    let mut open = *sums;
    open.iter_mut().zip(numbers).for_each(|(z, n)| *z -= ratio * n);
    // The zₖ sum to 0 up to rounding, which half_width subtracts.
    Some(half_width(&open) * BATCHES as f64 / all)
}

/// The sums of the first and of the second half of the batches.
pub(super) fn halves(batches: &[f64; BATCHES]) -> [f64; 2] {
    let (first, second) = batches.split_at(BATCHES / 2);
    [first, second].map(|half| half.iter().sum())
}

/// Turns the sums over time of each batch into means over the window.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sums {
    /// Length of the window, s.
    pub length: f64,
    /// Length of an averaging interval, s.
    pub bin: f64,
}

impl Sums {
    /// Mean over time of what has the sums `sums` in the batches, and the half width of its 95 %
    /// interval; `None` unless ten `contacts` began in the window, or what pushed (Σ|p| of each
    /// batch, `pushed`) did so in all ten.
    pub fn mean(self, sums: &[f64; BATCHES], pushed: &[f64; BATCHES], contacts: usize) -> (f64, Option<f64>) {
        let batch = self.length / BATCHES as f64;
        let means = sums.map(|p| p / batch);
        let enough = contacts >= BATCHES || pushed.iter().all(|&p| p > 0.0);
        (means.iter().sum::<f64>() / BATCHES as f64, enough.then(|| half_width(&means)))
    }

    /// The means over time of the two halves of the window.
    pub fn mean_of_halves(self, sums: &[f64; BATCHES]) -> [f64; 2] {
        halves(sums).map(|sum| 2.0 * sum / self.length)
    }

    /// The root of that mean, and the half width of its interval: that of the mean divided by twice
    /// the root.
    pub fn root_mean(self, squares: &[f64; BATCHES], pushed: &[f64; BATCHES], contacts: usize) -> (f64, Option<f64>) {
        let (mean, half) = self.mean(squares, pushed, contacts);
        let root = mean.sqrt();
        (root, half.map(|half| if root > 0.0 { half / (2.0 * root) } else { 0.0 }))
    }
}
