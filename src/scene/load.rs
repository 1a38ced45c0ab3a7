//! Loads: forces that are given functions of time.

use super::row::Row;
use super::system::{finite, nonnegative};
use crate::error::{Error, Result};
use std::f64::consts::TAU;

/// A force of time, piecewise linear between rows and zero outside them.
#[derive(Debug, Clone, PartialEq)]
pub struct Table {
    time: Vec<f64>,
    force: Vec<f64>,
}

impl Table {
    /// A table of `time` (s, strictly increasing) and `force` (N), of one length, two rows or more.
    ///
    /// # Errors
    /// [`Error::Invalid`] naming the first row that breaks this.
    pub fn new(time: Vec<f64>, force: Vec<f64>) -> Result<Self> {
        if time.len() != force.len() || time.len() < 2 {
            let rows = format!("{} times and {} forces", time.len(), force.len());
            return Err(Error::invalid("load table", rows, "as many times as forces, two rows or more"));
        }
        for (i, (&t, &f)) in time.iter().zip(&force).enumerate() {
            finite(&format!("load table, row {}: time_s", i + 1), t)?;
            finite(&format!("load table, row {}: force_N", i + 1), f)?;
        }
        for (i, pair) in time.windows(2).enumerate() {
            if pair[1] <= pair[0] {
                let key = format!("load table, row {}: time_s", i + 2);
                return Err(Error::invalid(key, pair[1], format!("more than the row before, {}", pair[0])));
            }
        }
        Ok(Self { time, force })
    }

    /// Times of the rows, s.
    #[must_use]
    pub fn time(&self) -> &[f64] {
        &self.time
    }

    /// Forces of the rows, N.
    #[must_use]
    pub fn force(&self) -> &[f64] {
        &self.force
    }

    /// Value and slope (N, N/s) at `t`, from the right: the piece that starts at or before `t`; zero outside the rows.
    #[must_use]
    pub fn piece(&self, t: f64) -> (f64, f64) {
        let next = self.time.partition_point(|&x| x <= t);
        let (Some(&t0), Some(&t1)) = (next.checked_sub(1).and_then(|i| self.time.get(i)), self.time.get(next)) else {
            return (0.0, 0.0);
        };
        let (f0, f1) = (self.force[next - 1], self.force[next]);
        let slope = (f1 - f0) / (t1 - t0);
        (f0 + slope * (t - t0), slope)
    }
}

/// What a load does in time.
#[derive(Debug, Clone, PartialEq)]
pub enum LoadKind {
    /// A force that never changes.
    Constant {
        /// N.
        force: f64,
    },
    /// amplitude · sin(2π frequency t + phase).
    Harmonic {
        /// N.
        amplitude: f64,
        /// Hz.
        frequency: f64,
        /// rad.
        phase: f64,
    },
    /// A blow: the momentum jumps by `impulse` at `time`.
    Impulse {
        /// N s.
        impulse: f64,
        /// s, zero or more.
        time: f64,
    },
    /// Tabulated, linear between rows, zero outside.
    Table(Table),
}

/// One load and the row it acts through. Loads add up.
#[derive(Debug, Clone, PartialEq)]
pub struct Load {
    /// What it does in time.
    pub kind: LoadKind,
    /// The row it acts through.
    pub at: Row,
}

impl Load {
    /// A constant force (N) on the first degree of freedom.
    #[must_use]
    pub fn constant(force: f64) -> Self {
        Self::on_first(LoadKind::Constant { force })
    }

    /// amplitude · sin(2π frequency t + phase) on the first degree of freedom: N, Hz, rad.
    #[must_use]
    pub fn harmonic(amplitude: f64, frequency: f64, phase: f64) -> Self {
        Self::on_first(LoadKind::Harmonic { amplitude, frequency, phase })
    }

    /// An impulse (N s) at a time (s) on the first degree of freedom.
    #[must_use]
    pub fn impulse(impulse: f64, time: f64) -> Self {
        Self::on_first(LoadKind::Impulse { impulse, time })
    }

    /// A tabulated force on the first degree of freedom.
    #[must_use]
    pub fn table(table: Table) -> Self {
        Self::on_first(LoadKind::Table(table))
    }

    fn on_first(kind: LoadKind) -> Self {
        Self { kind, at: Row::dof(0) }
    }

    pub(crate) fn validate(&self, index: usize) -> Result<()> {
        let key = |what: &str| format!("load {}: {what}", index + 1);
        match &self.kind {
            LoadKind::Constant { force } => finite(&key("force"), *force),
            LoadKind::Harmonic { amplitude, frequency, phase } => {
                finite(&key("amplitude"), *amplitude)?;
                nonnegative(&key("frequency"), *frequency)?;
                finite(&key("frequency"), TAU * frequency)?;
                finite(&key("phase"), *phase)
            }
            LoadKind::Impulse { impulse, time } => {
                finite(&key("impulse"), *impulse)?;
                nonnegative(&key("time"), *time)
            }
            LoadKind::Table(_) => Ok(()),
        }
    }
}

/// One sine of a [`Forcing`]: amplitude · sin(ω t + phase).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Harmonic {
    /// N.
    pub amplitude: f64,
    /// Circular frequency ω, rad/s.
    pub omega: f64,
    /// rad.
    pub phase: f64,
}

/// All loads on one degree of freedom, sorted by what they are, so that a step sums without branching on kinds.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Forcing {
    /// Sum of the constant forces, N.
    pub constant: f64,
    /// The sines.
    pub harmonics: Vec<Harmonic>,
    /// The tables.
    pub tables: Vec<Table>,
    /// The blows (time s, impulse N s), in time order.
    pub impulses: Vec<(f64, f64)>,
}

impl Forcing {
    /// The loads that act on degree of freedom `dof`, weighted by their rows.
    #[must_use]
    pub fn on(dof: usize, loads: &[Load]) -> Self {
        let mut forcing = Self::default();
        for load in loads {
            let weight: f64 = load.at.entries().iter().filter(|&&(i, _)| i == dof).map(|&(_, w)| w).sum();
            if weight == 0.0 {
                continue;
            }
            match &load.kind {
                LoadKind::Constant { force } => forcing.constant += weight * force,
                LoadKind::Harmonic { amplitude, frequency, phase } => forcing.harmonics.push(Harmonic {
                    amplitude: weight * amplitude,
                    omega: TAU * frequency,
                    phase: *phase,
                }),
                LoadKind::Impulse { impulse, time } => forcing.impulses.push((*time, weight * impulse)),
                LoadKind::Table(table) => {
                    let force = table.force.iter().map(|f| weight * f).collect();
                    forcing.tables.push(Table { time: table.time.clone(), force });
                }
            }
        }
        forcing.impulses.sort_by(|a, b| a.0.total_cmp(&b.0));
        forcing
    }

    /// Force at `t`, N, without the impulses; right-continuous where a table begins or ends.
    #[inline]
    #[must_use]
    pub fn force(&self, t: f64) -> f64 {
        let mut f = self.constant;
        for h in &self.harmonics {
            f += h.amplitude * (h.omega * t + h.phase).sin();
        }
        for table in &self.tables {
            f += table.piece(t).0;
        }
        f
    }

    /// Sum of the impulses in the half-open interval (from, to], N s.
    #[inline]
    #[must_use]
    pub fn impulse(&self, from: f64, to: f64) -> f64 {
        if self.impulses.is_empty() {
            return 0.0;
        }
        self.impulses.iter().filter(|&&(t, _)| t > from && t <= to).map(|&(_, p)| p).sum()
    }

    /// Moment of the impulses in (from, to] about `about` (s), Σ (about − t_b) J_b, N s²: over the mass, where they take a free body from
    /// its place without them until then.
    #[must_use]
    pub fn impulse_moment(&self, from: f64, to: f64, about: f64) -> f64 {
        self.impulses.iter().filter(|&&(t, _)| t > from && t <= to).map(|&(t, p)| (about - t) * p).sum()
    }

    /// Sum of the impulses within half a step `h` (s) of the instant `step` · h, N s: each impulse after t = 0 in one step and no other.
    #[inline]
    #[must_use]
    pub fn impulse_about(&self, step: u64, h: f64) -> f64 {
        // Neighbours meet at one product: t − h/2 of one and t + h/2 of the other would differ in the last place.
        let edge = |half_steps: f64| (half_steps * h).max(0.0);
        self.impulse(edge(step as f64 - 0.5), edge(step as f64 + 0.5))
    }

    /// Sum of the impulses at t = 0, N s: the start is the state after them.
    #[must_use]
    pub fn initial_impulse(&self) -> f64 {
        self.impulses.iter().filter(|&&(t, _)| t == 0.0).map(|&(_, p)| p).sum()
    }
}
