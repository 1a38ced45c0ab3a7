//! Means over a run, and their derivatives.
//!
//! Displacements are continuous and the window is fixed, so that ∫q dt and ∫q² dt change by ∫δq dt
//! and ∫2q δq dt: that δq jumps at an impact, whose instant moves, adds nothing. Over a stretch
//! both q and δq are polynomials, whose product is integrated term by term.

use super::key_terms::KeyTerms;
use crate::flow::{Changes, INVERSE, Series, TERMS};
use crate::scene::Row;
use crate::step::Step;

/// Means over a run from its start, and their derivatives with respect to each key.
#[derive(Debug, Clone, Default, PartialEq)]
#[non_exhaustive]
pub struct MeanDerivative {
    /// The length of the run, s.
    pub length: f64,
    /// The mean displacement of each probe, m.
    pub displacement: Vec<f64>,
    /// Its derivatives, m per unit of the key: for each probe a list of keys. NaN, as all others,
    /// for a key by which the derivatives end before the run does.
    pub displacement_by: Vec<Vec<f64>>,
    /// The root of the mean square of the displacement of each probe, m.
    pub rms: Vec<f64>,
    /// Its derivatives, m per unit of the key; NaN for a probe that does not move.
    pub rms_by: Vec<Vec<f64>>,
    /// The mean force of each wall, N, signed as the force: its impulses over the length, those of
    /// contacts that are still open included.
    pub force: Vec<f64>,
    /// Its derivatives, N per unit of the key: for each wall a list of keys.
    pub force_by: Vec<Vec<f64>>,
}

/// Integrals along the run.
#[derive(Debug)]
pub(super) struct MeanChanges {
    probes: Vec<Probe>,
    /// The impulse of each wall, N s.
    impulse: Vec<f64>,
    /// The times between which the run has been seen, s.
    span: Option<[f64; 2]>,
}

/// ∫q dt (m s) and ∫q² dt (m² s) of a probe, and their changes by each key.
#[derive(Debug)]
struct Probe {
    row: Row,
    own: [f64; 2],
    by: Vec<[f64; 2]>,
    /// ∫₀¹ q xᵏ of the present stretch, x being 1 at its end.
    weights: [f64; TERMS],
}

impl Probe {
    /// Begins the stretch of `base`, which ends at `x` and lasts `scale` (s), with its first
    /// `count` terms.
    fn begin(&mut self, base: &Series, (x, scale): (f64, f64), count: usize) {
        let (mut own, mut power) = ([0.0; TERMS], 1.0);
        for (k, own) in own.iter_mut().enumerate().take(count) {
            *own = power * self.row.dot(base.term(k));
            power *= x;
        }
        for (k, weight) in self.weights.iter_mut().enumerate() {
            *weight = dot(&own, INVERSE.get(k..).unwrap_or_default());
        }
        self.own[0] += scale * dot(&own, &INVERSE);
        self.own[1] += scale * dot(&own, &self.weights);
    }
}

impl MeanChanges {
    pub fn new(probes: &[Row], keys: usize) -> Self {
        let probe =
            |row: &Row| Probe { row: row.clone(), own: [0.0; 2], by: vec![[0.0; 2]; keys], weights: [0.0; TERMS] };
        Self { probes: probes.iter().map(probe).collect(), impulse: Vec::new(), span: None }
    }

    /// Adds the stretch of `base`, with its change by key number `column`.
    pub fn add_stretch(&mut self, column: usize, (base, changes): (&Series, &Changes), terms: &KeyTerms) {
        let (unit, x, count) = (base.unit(), base.span(), base.terms().min(TERMS));
        for (number, probe) in self.probes.iter_mut().enumerate() {
            let (scale, mut by) = (x * unit, [0.0; TERMS]);
            if column == 0 {
                probe.begin(base, (x, scale), count);
            }
            let of_key = terms.tangent.probes.get(number);
            let mut power = 1.0;
            for (k, by) in by.iter_mut().enumerate().take(count) {
                *by = power
                    * (changes.seen(probe.row.entries(), k, column) + of_key.map_or(0.0, |row| row.dot(base.term(k))));
                power *= x;
            }
            if let Some(changes) = probe.by.get_mut(column) {
                changes[0] += scale * dot(&by, &INVERSE);
                changes[1] += scale * 2.0 * dot(&by, &probe.weights);
            }
        }
    }

    /// True without probes.
    pub fn is_empty(&self) -> bool {
        self.probes.is_empty()
    }

    /// Adds a flight of one degree of freedom, with its change by key number `column`: ∫q and ∫q²,
    /// and ∫δq and ∫q δq.
    pub fn add_flight(&mut self, column: usize, own: [f64; 2], by: [f64; 2], terms: &KeyTerms) {
        for (number, probe) in self.probes.iter_mut().enumerate() {
            let weight = probe.row.dot(&[1.0]);
            let of_key = terms.tangent.probes.get(number).map_or(0.0, |row| row.dot(&[1.0]));
            if column == 0 {
                probe.own[0] += weight * own[0];
                probe.own[1] += weight * weight * own[1];
            }
            if let Some(changes) = probe.by.get_mut(column) {
                changes[0] += weight * by[0] + of_key * own[0];
                changes[1] += 2.0 * weight * (weight * by[1] + of_key * own[1]);
            }
        }
    }

    /// Gives up the means by key number `key`.
    pub fn lose(&mut self, key: usize) {
        self.probes.iter_mut().filter_map(|probe| probe.by.get_mut(key)).for_each(|by| *by = [f64::NAN; 2]);
    }

    /// Adds the impulses of `step`.
    pub fn add_impulses(&mut self, step: &Step<'_>) {
        self.impulse.resize(step.impulse.len(), 0.0);
        self.impulse.iter_mut().zip(step.impulse).for_each(|(sum, p)| *sum += p);
        self.span = Some([self.span.map_or(step.start, |span| span[0]), step.end]);
    }

    /// The means so far; `total` are the changes of the impulses of each wall by each key, N s.
    pub fn means(&self, total: &[Vec<f64>]) -> MeanDerivative {
        let length = self.span.map_or(0.0, |[from, to]| to - from);
        let rms = |probe: &Probe| (probe.own[1] / length).sqrt();
        let over = |list: &[f64]| list.iter().map(|x| x / length).collect::<Vec<f64>>();
        MeanDerivative {
            length,
            displacement: self.probes.iter().map(|probe| probe.own[0] / length).collect(),
            displacement_by: self.probes.iter().map(|p| p.by.iter().map(|by| by[0] / length).collect()).collect(),
            rms: self.probes.iter().map(rms).collect(),
            rms_by: self
                .probes
                .iter()
                .map(|probe| probe.by.iter().map(|by| by[1] / (2.0 * length * rms(probe))).collect())
                .collect(),
            force: over(&self.impulse),
            force_by: total.iter().map(|by| over(by)).collect(),
        }
    }
}

/// Σ aₖ bₖ.
fn dot(a: &[f64; TERMS], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
