//! The format of a case file, as serde reads it. Every value keeps the place where it stands.

use serde::Deserialize;
use serde::de::value::MapAccessDeserializer;
use serde::de::{Deserializer, MapAccess, Visitor};
use std::fmt;
use std::marker::PhantomData;
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
    pub load: Vec<Section<Load>>,
    pub initial: Option<Section<Initial>>,
    pub time: Section<Time>,
    pub penalty: Option<Section<Penalty>>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct System {
    pub oscillator: Section<Oscillator>,
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
pub(super) struct Wall {
    pub name: Spanned<String>,
    pub side: Spanned<String>,
    pub position: Spanned<Number>,
    pub restitution: Option<Spanned<Number>>,
    pub stiffness: Option<Spanned<Number>>,
    pub damping: Option<Spanned<Number>>,
}

/// Exactly one of the kinds is to be set.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Load {
    pub constant: Option<Section<Constant>>,
    pub harmonic: Option<Section<Harmonic>>,
    pub impulse: Option<Section<Impulse>>,
    pub table: Option<Section<Table>>,
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
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Initial {
    pub displacement: Option<Spanned<Number>>,
    pub velocity: Option<Spanned<Number>>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Time {
    pub end: Spanned<Number>,
    pub step: Spanned<Number>,
    pub sample: Option<Spanned<Number>>,
    pub statistics_from: Option<Spanned<Number>>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Penalty {
    pub epsilon: Option<Spanned<Vec<Spanned<Number>>>>,
    pub stiffness: Option<Spanned<Vec<Spanned<Number>>>>,
    pub damping: Option<Spanned<Number>>,
    pub integrator: Option<Spanned<String>>,
}

/// What each key takes, for messages: path of the key, then what is accepted.
const ACCEPTED: &[(&str, &str)] = &[
    ("title", "one line of text: title = \"Two rigid walls, 5 Hz sine\""),
    ("source", "one line of text: source = \"Fig. 4\""),
    ("system", "the table [system.oscillator] with mass (kg), damping (N s/m) and stiffness (N/m)"),
    ("system.oscillator", "the table [system.oscillator] with mass (kg), damping (N s/m) and stiffness (N/m)"),
    ("system.oscillator.mass", "mass = a number above 0, in kg"),
    ("system.oscillator.damping", "damping = a number, 0 or more, in N s/m"),
    ("system.oscillator.stiffness", "stiffness = a number, 0 or more, in N/m"),
    ("wall", "one [[wall]] table, in double brackets, for each wall"),
    ("wall.name", "name = letters, digits, - and _, in quotes"),
    ("wall.side", "side = \"upper\" (the body may not go above position) or \"lower\" (not below)"),
    ("wall.position", "position = a number, in m"),
    ("wall.restitution", "restitution = a number from 0 to 1; rigid walls only"),
    ("wall.stiffness", "stiffness = a number above 0, in N/m, which makes the wall elastic"),
    ("wall.damping", "damping = a number, 0 or more, in N s/m; elastic walls only"),
    ("load", "one [[load]] table, in double brackets, for each load"),
    ("load.constant", "constant = { force = a number, in N }"),
    ("load.constant.force", "force = a number, in N"),
    ("load.harmonic", "harmonic = { amplitude = N, frequency = Hz, phase = rad }"),
    ("load.harmonic.amplitude", "amplitude = a number, in N"),
    ("load.harmonic.frequency", "frequency = a number, 0 or more, in Hz"),
    ("load.harmonic.phase", "phase = a number, in rad"),
    ("load.impulse", "impulse = { impulse = N s, time = s }"),
    ("load.impulse.impulse", "impulse = a number, in N s"),
    ("load.impulse.time", "time = a number, 0 or more, in s"),
    ("load.table", "table = { file = \"force.csv\" }"),
    ("load.table.file", "file = a path in quotes, relative to the case file"),
    ("initial", "the table [initial] with displacement (m) and velocity (m/s)"),
    ("initial.displacement", "displacement = a number, in m"),
    ("initial.velocity", "velocity = a number, in m/s"),
    ("time", "the table [time] with end (s), step (s) and, where wanted, sample (s) and statistics_from (s)"),
    ("time.end", "end = a number above 0, in s"),
    ("time.step", "step = a number above 0 and below end, in s"),
    ("time.sample", "sample = a number above 0 and at most end, in s"),
    ("time.statistics_from", "statistics_from = a number, 0 or more and below end, in s"),
    ("penalty", "the table [penalty] with a list epsilon (m^3/N) or a list stiffness (N/m)"),
    ("penalty.epsilon", "epsilon = a list of numbers above 0, in m^3/N: [1e-12, 1e-9]"),
    ("penalty.stiffness", "stiffness = a list of numbers above 0, in N/m: [1e6, 1e8]"),
    ("penalty.damping", "damping = a number, 0 or more, in N s/m; linear penalty only"),
    ("penalty.integrator", "integrator = a name in quotes, such as \"discrete-gradient\""),
];

/// What the key of that path takes.
pub(super) fn accepted(path: &str) -> Option<&'static str> {
    ACCEPTED.iter().find(|(key, _)| *key == path).map(|(_, text)| *text)
}

/// A number, written as a float or an integer.
#[derive(Debug, Clone, Copy)]
pub(super) struct Number(pub f64);

impl<'de> Deserialize<'de> for Number {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct AnyNumber;
        impl Visitor<'_> for AnyNumber {
            type Value = Number;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a number")
            }
            fn visit_f64<E>(self, x: f64) -> Result<Number, E> {
                Ok(Number(x))
            }
            fn visit_i64<E>(self, x: i64) -> Result<Number, E> {
                Ok(Number(x as f64))
            }
            fn visit_u64<E>(self, x: u64) -> Result<Number, E> {
                Ok(Number(x as f64))
            }
            fn visit_i128<E>(self, x: i128) -> Result<Number, E> {
                Ok(Number(x as f64))
            }
            fn visit_u128<E>(self, x: u128) -> Result<Number, E> {
                Ok(Number(x as f64))
            }
        }
        deserializer.deserialize_any(AnyNumber)
    }
}

/// A table and where it stands. Unlike a bare struct, which serde also reads from a list by position, it takes nothing
/// but a table.
#[derive(Debug)]
pub(super) struct Section<T> {
    pub span: std::ops::Range<usize>,
    pub value: T,
}

impl<'de, T: Deserialize<'de>> Deserialize<'de> for Section<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let table = Spanned::<TableOnly<T>>::deserialize(deserializer)?;
        Ok(Self { span: table.span(), value: table.into_inner().0 })
    }
}

struct TableOnly<T>(T);

impl<'de, T: Deserialize<'de>> Deserialize<'de> for TableOnly<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct AnyTable<T>(PhantomData<T>);
        impl<'de, T: Deserialize<'de>> Visitor<'de> for AnyTable<T> {
            type Value = TableOnly<T>;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a table")
            }
            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<TableOnly<T>, A::Error> {
                T::deserialize(MapAccessDeserializer::new(map)).map(TableOnly)
            }
        }
        deserializer.deserialize_any(AnyTable(PhantomData))
    }
}
