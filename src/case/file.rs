//! The format of a case file, as serde reads it. Every value keeps its position in the text.

use super::value::{Number, Section, Value};
use serde::Deserialize;
use toml::Spanned;

/// A whole case file.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct File {
    pub title: Option<String>,
    pub source: Option<String>,
    pub system: Section<System>,
    #[serde(default)]
    pub wall: Vec<Section<Wall>>,
    #[serde(default)]
    pub support: Vec<Section<Support>>,
    #[serde(default)]
    pub load: Vec<Section<Load>>,
    pub initial: Option<Section<Initial>>,
    #[serde(default)]
    pub probe: Vec<Section<Probe>>,
    pub wear: Option<Section<Wear>>,
    pub time: Section<Time>,
    pub statistics: Option<Section<Statistics>>,
    pub penalty: Option<Section<Penalty>>,
}

/// Exactly one of the systems must be set.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct System {
    pub oscillator: Option<Section<Oscillator>>,
    pub chain: Option<Section<Chain>>,
    pub bar: Option<Section<Bar>>,
    pub beam: Option<Section<Beam>>,
    pub matrices: Option<Section<Matrices>>,
    pub modal: Option<Section<Modal>>,
    pub damping: Option<Section<Damping>>,
    pub planes: Option<Spanned<Number>>,
    pub modes: Option<Spanned<Number>>,
    pub static_correction: Option<Spanned<bool>>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Oscillator {
    pub mass: Spanned<Number>,
    pub damping: Spanned<Number>,
    pub stiffness: Spanned<Number>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Chain {
    pub masses: Spanned<Value>,
    pub mass: Option<Spanned<Number>>,
    pub springs: Spanned<Value>,
    pub left: Option<Spanned<Value>>,
    pub right: Option<Spanned<Value>>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Bar {
    pub length: Spanned<Number>,
    pub youngs_modulus: Spanned<Number>,
    pub density: Spanned<Number>,
    pub area: Spanned<Number>,
    pub elements: Spanned<Number>,
    pub mass_matrix: Option<Spanned<String>>,
    pub left: Spanned<Value>,
    pub right: Spanned<Value>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Beam {
    pub length: Spanned<Number>,
    pub youngs_modulus: Spanned<Number>,
    pub density: Spanned<Number>,
    pub outer_diameter: Spanned<Number>,
    pub inner_diameter: Option<Spanned<Number>>,
    pub added_mass: Option<Spanned<Number>>,
    pub elements: Spanned<Number>,
    pub left: Spanned<Value>,
    pub right: Spanned<Value>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Matrices {
    pub mass: Spanned<String>,
    pub damping: Option<Spanned<String>>,
    pub stiffness: Spanned<String>,
}

/// One of frequencies and omega must be set.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Modal {
    pub frequencies: Option<Spanned<Vec<Spanned<Number>>>>,
    pub omega: Option<Spanned<Vec<Spanned<Number>>>>,
    pub masses: Option<Spanned<Value>>,
    pub damping_ratios: Option<Spanned<Value>>,
    pub shapes: Option<Spanned<Value>>,
}

/// Exactly one of these must be set.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Damping {
    pub rayleigh: Option<Section<Rayleigh>>,
    pub ratio: Option<Spanned<Number>>,
    pub ratios: Option<Spanned<Vec<Spanned<Number>>>>,
    pub matrix: Option<Spanned<String>>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Rayleigh {
    pub mass: Option<Spanned<Number>>,
    pub stiffness: Option<Spanned<Number>>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Wall {
    pub name: Spanned<String>,
    pub at: Option<Spanned<Value>>,
    pub direction: Option<Spanned<Number>>,
    pub side: Spanned<String>,
    pub position: Option<Spanned<Number>>,
    pub gap: Option<Spanned<Number>>,
    pub restitution: Option<Spanned<Number>>,
    pub stiffness: Option<Spanned<Number>>,
    pub damping: Option<Spanned<Number>>,
}

/// Of flats one of `directions` and `sides` must be set.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Support {
    pub name: Spanned<String>,
    pub at: Option<Spanned<Value>>,
    pub shape: Spanned<String>,
    pub directions: Option<Spanned<Vec<Spanned<Number>>>>,
    pub sides: Option<Spanned<Number>>,
    pub turn: Option<Spanned<Number>>,
    pub gap: Spanned<Value>,
    pub centre: Option<Spanned<Vec<Spanned<Number>>>>,
    pub restitution: Option<Spanned<Number>>,
    pub stiffness: Option<Spanned<Number>>,
    pub damping: Option<Spanned<Number>>,
    pub friction: Option<Spanned<Number>>,
    pub width: Option<Spanned<Number>>,
    pub radius: Option<Spanned<Number>>,
    pub coefficient: Option<Spanned<Number>>,
    pub support_coefficient: Option<Spanned<Number>>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Wear {
    pub coefficient: Option<Spanned<Number>>,
    pub support_coefficient: Option<Spanned<Number>>,
    pub service: Option<Spanned<Number>>,
    pub sectors: Option<Spanned<Number>>,
}

/// Exactly one of the kinds must be set.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Load {
    pub at: Option<Spanned<Value>>,
    pub direction: Option<Spanned<Value>>,
    pub constant: Option<Section<Constant>>,
    pub harmonic: Option<Section<Harmonic>>,
    pub impulse: Option<Section<Impulse>>,
    pub table: Option<Section<Table>>,
    pub random: Option<Section<Random>>,
    pub base: Option<Section<Base>>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Constant {
    pub force: Spanned<Number>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Harmonic {
    pub amplitude: Spanned<Number>,
    pub frequency: Spanned<Number>,
    pub phase: Option<Spanned<Number>>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Impulse {
    pub impulse: Spanned<Number>,
    pub time: Option<Spanned<Number>>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Table {
    pub file: Spanned<String>,
    pub time: Option<Spanned<String>>,
    pub force: Option<Spanned<String>>,
    pub delimiter: Option<Spanned<String>>,
    pub decimal: Option<Spanned<String>>,
    pub scale: Option<Spanned<Number>>,
}

/// One of rms (with from and to), psd and file must be set.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Random {
    pub rms: Option<Spanned<Number>>,
    pub from: Option<Spanned<Number>>,
    pub to: Option<Spanned<Number>>,
    pub psd: Option<Spanned<Value>>,
    pub file: Option<Spanned<String>>,
    pub seed: Option<Spanned<Number>>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Base {
    pub file: Spanned<String>,
    pub time: Option<Spanned<String>>,
    pub acceleration: Option<Spanned<String>>,
    pub delimiter: Option<Spanned<String>>,
    pub decimal: Option<Spanned<String>>,
    pub scale: Option<Spanned<Number>>,
    pub influence: Option<Spanned<Value>>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Initial {
    pub equilibrium: Option<Spanned<bool>>,
    pub displacement: Option<Spanned<Value>>,
    pub velocity: Option<Spanned<Value>>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Probe {
    pub name: Spanned<String>,
    pub at: Option<Spanned<Value>>,
    pub direction: Option<Spanned<Number>>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Time {
    pub end: Spanned<Number>,
    pub step: Spanned<Number>,
    pub sample: Option<Spanned<Number>>,
    pub statistics_from: Option<Spanned<Number>>,
    pub force_averaging: Option<Spanned<Number>>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Statistics {
    pub rest: Option<Spanned<Number>>,
    pub spectra: Option<Spanned<bool>>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Penalty {
    pub epsilon: Option<Spanned<Vec<Spanned<Number>>>>,
    pub stiffness: Option<Spanned<Vec<Spanned<Number>>>>,
    pub damping: Option<Spanned<Number>>,
    pub integrator: Option<Spanned<String>>,
}
