//! Fluid-elastic stability of tubes in a cross flow, by Connors' criterion.
//!
//! A flow of the density ρ and the velocity V in the gaps between the tubes feeds energy into a
//! mode φ of the frequency f and the damping ratio ζ, once its effective velocity V_e exceeds the
//! critical one V_c:
//!
//! V_e² = ∫ ρV²φ²/ρ₀ dx ÷ ∫ mφ²/m₀ dx,   V_c = K f D √(2πζ m₀/(ρ₀D²)),
//!
//! with the mass per metre m, the outer diameter D and the constant K of the bundle; the ratio of
//! the two depends on neither of the references ρ₀ and m₀ (Connors 1970, "Fluidelastic vibration of
//! tube arrays excited by cross flow", ASME Symposium on Flow-Induced Vibration in Heat Exchangers;
//! the weights by the shape of the mode as in Pettigrew & Taylor 1991, doi:10.1115/1.2928755). The
//! margin is V_c/V_e, below 1 the mode is unstable.
//!
//! Where supports couple tubes, a mode moves several, and both integrals are sums over them: the
//! flow along each feeds the one mode. Its margin depends on no tube's own m₀, ρ₀ or D; V_e and V_c
//! are told by those of the tube that gets most of what the flow feeds in.
//!
//! A margin is a warning, and no force: what a flow feeds into a rattling tube depends on its
//! frequency, which moves between those of free and of held modes, so that no damping matrix of the
//! free modes has it.

#[cfg(feature = "case")]
mod flow;

use super::modal::Modes;
use super::row::Row;
use super::system::positive;
use super::{Damping, Scene, System};
use crate::error::{Error, Result};
use nalgebra::DMatrix;
use serde::{Deserialize, Serialize};
use std::f64::consts::TAU;

/// Margins of neighbours within this share of each other are those of one motion in two planes.
const SAME: f64 = 1e-9;

/// What a mode moves by less than this share of its largest displacement in the flow, stands still.
const STILL: f64 = 1e-9;

/// Frequencies within this share of each other are one: any sum of their modes is a mode as well.
const ONE_FREQUENCY: f64 = 1e-6;

/// Tubes in a cross flow, for Connors' criterion.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Connors {
    /// K; above 0.
    pub constant: f64,
    /// The tubes in the flow.
    pub tubes: Vec<FlowTube>,
}

/// A tube in a cross flow.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct FlowTube {
    /// The name of its body; `None` where the tube is the whole system.
    pub body: Option<String>,
    /// Outer diameter D of the tube, m.
    pub diameter: f64,
    /// Mass per metre m of the tube with the fluid that moves with it, kg/m: also m₀.
    pub mass_per_metre: f64,
    /// ρ₀, kg/m³.
    pub density: f64,
    /// The flow: pieces of the tube.
    pub pieces: Vec<FlowPiece>,
}

/// A piece of a tube in a flow.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct FlowPiece {
    /// The displacement across the tube there: a row for each plane in which it moves.
    pub at: Vec<Row>,
    /// ρV² times the length of the piece, kg/s²; 0 or more.
    pub pressure: f64,
}

/// A mode in a flow.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct FlowMargin {
    /// The bodies in the flow that it moves; empty where the tube is the whole system.
    pub bodies: Vec<String>,
    /// Its frequency f, Hz.
    pub frequency_hz: f64,
    /// Its damping ratio ζ.
    pub damping_ratio: f64,
    /// V_e, m/s.
    pub effective_velocity_m_per_s: f64,
    /// V_c, m/s.
    pub critical_velocity_m_per_s: f64,
    /// V_c/V_e: below 1 the mode is unstable. `None` where no flow reaches it.
    pub margin: Option<f64>,
}

/// The margins of the modes that move a tube in a flow, slowest modes first. A mode that is the
/// same in two planes is listed once; rigid-body motions are left out.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct FluidElastic {
    /// K.
    pub connors: f64,
    /// Of the modes that no support holds.
    pub inactive: Vec<FlowMargin>,
    /// Of the modes with all supports active; empty without supports.
    pub active: Vec<FlowMargin>,
}

impl FlowMargin {
    /// The bodies that the mode moves, as they stand after it: ` of "left", "right"`; nothing where
    /// the tube is the whole system.
    #[cfg(feature = "case")]
    pub(crate) fn of_bodies(&self) -> String {
        let names: Vec<String> = self.bodies.iter().map(|name| format!("{name:?}")).collect();
        if names.is_empty() { String::new() } else { format!(" of {}", names.join(", ")) }
    }
}

impl FluidElastic {
    /// The least margin of a list; `None` where no flow reaches a mode.
    #[must_use]
    pub fn least(margins: &[FlowMargin]) -> Option<&FlowMargin> {
        let known = margins.iter().filter_map(|one| Some((one, one.margin?)));
        known.min_by(|a, b| a.1.total_cmp(&b.1)).map(|(one, _)| one)
    }
}

/// The damping ratio of any mode of a structure whose own modes have known ones.
struct Ratios<'a> {
    scene: &'a Scene,
    /// ω (rad/s, increasing) and ζ of the own modes; empty where the matrix C is known.
    known: Vec<(f64, f64)>,
}

impl<'a> Ratios<'a> {
    /// Of `scene` with its own C, or with `damping` given to its modes `own`.
    fn new(scene: &'a Scene, damping: Option<&Damping>, own: &Modes) -> Result<Self> {
        let Some(Damping::Modal(ratios)) = damping else { return Ok(Self { scene, known: Vec::new() }) };
        if let Some(ratio) = ratios.iter().find(|ratio| **ratio < 0.0) {
            let expected = "0 or more beside connors: a negative ratio is what the flow feeds into a mode already";
            return Err(Error::invalid(("damping", "ratios"), format!("a list with {ratio:?}"), expected));
        }
        let last = ratios.last().copied().unwrap_or(0.0);
        let ratio = |i: usize| ratios.get(i).copied().unwrap_or(last);
        Ok(Self { scene, known: own.omega.iter().enumerate().map(|(i, omega)| (*omega, ratio(i))).collect() })
    }

    /// ζ of a mode with φᵀMφ = 1: φᵀCφ/2ω; or, where ratios are given to the own modes, straight in
    /// ω between these, and beyond them that of the nearest.
    fn of(&self, omega: f64, shape: &[f64]) -> f64 {
        match (&self.scene.system, self.known.first(), self.known.last()) {
            (System::Structure(structure), None, _) => structure.damping.form(shape, shape) / (2.0 * omega),
            (_, Some(first), _) if omega <= first.0 => first.1,
            (_, _, Some(last)) if omega >= last.0 => last.1,
            _ => {
                let around = self.known.windows(2).find(|pair| omega <= pair[1].0);
                around.map_or(0.0, |pair| {
                    let [(below, low), (above, high)] = [pair[0], pair[1]];
                    low + (high - low) * (omega - below) / (above - below)
                })
            }
        }
    }
}

impl Connors {
    /// The margins of the modes of `scene`, with supports inactive and active: as many modes as
    /// `own`, the modes of the scene's structure, has. `damping` is that of the modes where it is
    /// not the scene's own.
    ///
    /// # Errors
    /// [`Error::Invalid`] under `flow` for a constant, diameter, mass or density that is not above
    /// 0; under `damping` for a negative ratio; errors of [`Modes::lowest`] for the modes that the
    /// supports hold.
    pub fn margins(&self, scene: &Scene, damping: Option<&Damping>, own: &Modes) -> Result<FluidElastic> {
        positive(("flow", "connors"), self.constant)?;
        for tube in &self.tubes {
            positive(("flow", "diameter"), tube.diameter)?;
            positive(("flow", "mass"), tube.mass_per_metre)?;
            positive(("flow", "density"), tube.density)?;
        }
        let ratios = Ratios::new(scene, damping, own)?;
        let margin = |omega: f64, shape: &[f64]| self.margin(omega, ratios.of(omega, shape), shape);
        let own_margin = |(i, (omega, shape)): (usize, (&f64, &Vec<f64>))| match ratios.known.get(i) {
            Some((_, ratio)) => self.margin(*omega, *ratio, shape),
            None => margin(*omega, shape),
        };
        let inactive = own.omega.iter().zip(&own.shapes).enumerate().filter_map(own_margin).collect();
        let mut active = Vec::new();
        if let Some(held) = scene.all_active() {
            let count = own.count().min(held.structure.mass.size());
            if count > 0 {
                let modes = Modes::lowest(&held.structure, count)?;
                let shapes = modes.shapes.iter().map(|shape| held.expand(shape)).collect();
                let shapes = self.apart(&modes.omega, shapes);
                active = modes.omega.iter().zip(&shapes).filter_map(|(omega, shape)| margin(*omega, shape)).collect();
            }
        }
        Ok(FluidElastic { connors: self.constant, inactive: each_once(inactive), active: each_once(active) })
    }

    /// The margin of a mode with φᵀMφ = 1 and ω (rad/s); `None` where it moves no tube in the flow.
    fn margin(&self, omega: f64, ratio: f64, shape: &[f64]) -> Option<FlowMargin> {
        let largest: Vec<f64> = self.tubes.iter().map(|tube| tube.largest(shape)).collect();
        let still = STILL * largest.iter().copied().fold(0.0, f64::max);
        let moved = || self.tubes.iter().zip(&largest).filter(|(_, largest)| **largest > still).map(|(tube, _)| tube);
        let most = moved().max_by(|a, b| a.fed(shape, shape).total_cmp(&b.fed(shape, shape)))?;
        let effective = (most.mass_per_metre / most.density * self.fed(shape, shape)).sqrt();
        let reduced = TAU * ratio * most.mass_per_metre / (most.density * most.diameter * most.diameter);
        let critical = self.constant * (omega / TAU) * most.diameter * reduced.max(0.0).sqrt();
        Some(FlowMargin {
            bodies: moved().filter_map(|tube| tube.body.clone()).collect(),
            frequency_hz: omega / TAU,
            damping_ratio: ratio,
            effective_velocity_m_per_s: effective,
            critical_velocity_m_per_s: critical,
            margin: Some(critical / effective).filter(|margin| margin.is_finite()),
        })
    }

    /// ∫ρV²φψ dx over all tubes, kg m/s² per m of the coordinates.
    fn fed(&self, one: &[f64], other: &[f64]) -> f64 {
        self.tubes.iter().map(|tube| tube.fed(one, other)).sum()
    }

    /// The modes `shapes`, where those of one frequency are replaced by the sums of them that the
    /// flow feeds apart, ∫ρV²φᵢφⱼ = 0. Of equal tubes the one in the faster flow so has its own
    /// margin, whatever sums of their motions a solver finds.
    fn apart(&self, omega: &[f64], mut shapes: Vec<Vec<f64>>) -> Vec<Vec<f64>> {
        let mut rest = shapes.as_mut_slice();
        for group in omega.chunk_by(|a, b| (b - a).abs() <= ONE_FREQUENCY * b.abs()) {
            let (these, after) = rest.split_at_mut(group.len().min(rest.len()));
            rest = after;
            let fed = DMatrix::from_fn(these.len(), these.len(), |i, j| self.fed(&these[i], &these[j]));
            let mixed = (0..fed.nrows()).any(|i| (0..i).any(|j| fed[(i, j)].abs() > STILL * fed.trace()));
            if mixed {
                let turned = fed.symmetric_eigen().eigenvectors;
                let sum = |column: usize, i: usize| {
                    these.iter().enumerate().map(|(k, shape)| turned[(k, column)] * shape[i]).sum::<f64>()
                };
                let size = these.first().map_or(0, Vec::len);
                let sums: Vec<Vec<f64>> =
                    (0..these.len()).map(|column| (0..size).map(|i| sum(column, i)).collect()).collect();
                these.clone_from_slice(&sums);
            }
        }
        shapes
    }
}

impl FlowTube {
    /// ∫ρV²φψ dx along it.
    fn fed(&self, one: &[f64], other: &[f64]) -> f64 {
        let product = |piece: &FlowPiece| piece.at.iter().map(|row| row.dot(one) * row.dot(other)).sum::<f64>();
        self.pieces.iter().map(|piece| piece.pressure * product(piece)).sum()
    }

    /// The largest displacement of a mode at its pieces.
    fn largest(&self, shape: &[f64]) -> f64 {
        self.pieces.iter().flat_map(|piece| &piece.at).map(|row| row.dot(shape).abs()).fold(0.0, f64::max)
    }
}

/// The margins without those of rigid-body motions, and those of two planes once.
fn each_once(margins: Vec<FlowMargin>) -> Vec<FlowMargin> {
    let same = |a: f64, b: f64| (a - b).abs() <= SAME * a.abs().max(b.abs());
    let mut all: Vec<FlowMargin> = Vec::new();
    for one in margins.into_iter().filter(|one| one.frequency_hz > 0.0) {
        let mut beside = all.iter().rev().take_while(|other| same(other.frequency_hz, one.frequency_hz));
        let known = beside.any(|other| {
            other.bodies == one.bodies
                && same(other.damping_ratio, one.damping_ratio)
                && same(other.effective_velocity_m_per_s, one.effective_velocity_m_per_s)
        });
        if !known {
            all.push(one);
        }
    }
    all
}
