//! Every key of a sweep file, once.

use crate::case::Kind::{Any, Inline, Number, Numbers, Table, Tables, Word, Words};
use crate::case::{KeyEntry, REQUIRED, Schema, entry};
use std::sync::LazyLock;

/// The keys of a sweep file.
pub(super) static SWEEP: LazyLock<Schema> = LazyLock::new(|| Schema::new("the sweep file", KEYS));

const PERIODS: &str = "a whole number of forcing periods";
const SECONDS: &str = "a number, in s";

#[rustfmt::skip]
const KEYS: &[KeyEntry] = &[
    entry("case", Word, "", [REQUIRED, "a case file in quotes, relative to the sweep file, or the \
        name of a built-in case", ""]),
    entry("set", Any, "", ["", "a table of values of the case by their keys: \
        \"wall.*.restitution\" = 0.8", ""]),
    entry("vary", Tables, "", ["", "what varies", ""]),
    entry("vary.key", Word, "", ["`keys`", "the key of a value of the case, in quotes, or \
        \"scheme\"", ""]),
    entry("vary.keys", Words, "", ["`key`", "a list of keys in quotes: they vary together", ""]),
    entry("vary.factors", Numbers, "", ["1 each", "a list of numbers: one for each of keys", ""]),
    entry("vary.name", Word, "", ["from the key", "the name of the column, in quotes", ""]),
    entry("vary.values", Any, "", ["", "a list of values", ""]),
    entry("vary.from", Number, "", ["", "a number", ""]),
    entry("vary.to", Number, "", ["", "a number", ""]),
    entry("vary.points", Number, "", ["", "a whole number from 2", ""]),
    entry("vary.scale", Word, "", ["linear", "\"linear\" or \"log\"", ""]),
    entry("vary.normal", Inline, "", ["", "a normal distribution", ""]),
    entry("vary.normal.mean", Number, "", [REQUIRED, "a number", ""]),
    entry("vary.normal.deviation", Number, "", [REQUIRED, "a number above 0", ""]),
    entry("vary.normal.least", Number, "", ["", "a number", ""]),
    entry("vary.normal.most", Number, "", ["", "a number", ""]),
    entry("vary.follow", Word, "", ["no", "\"up\", \"down\", \"both\" or \"no\"", ""]),
    entry("random", Table, "", ["", "values drawn at random", ""]),
    entry("random.kind", Word, "", [REQUIRED, "\"uniform\", \"lhs\" (a Latin hypercube) or \
        \"sobol\"", ""]),
    entry("random.points", Number, "", [REQUIRED, "a whole number from 1", ""]),
    entry("random.seed", Number, "", ["", "a whole number from 0 to 2^53", ""]),
    entry("run", Table, "", ["", "how each row runs", ""]),
    entry("run.scheme", Word, "", ["chosen", "a scheme in quotes, such as \"event\"", ""]),
    entry("run.settle", Inline, "", ["", "the time before the window", ""]),
    entry("run.settle.periods", Number, "", ["", PERIODS, ""]),
    entry("run.settle.seconds", Number, "", ["", SECONDS, ""]),
    entry("run.keep", Inline, "", ["", "the window", ""]),
    entry("run.keep.periods", Number, "", ["", PERIODS, ""]),
    entry("run.keep.seconds", Number, "", ["", SECONDS, ""]),
    entry("run.judged", Number, "", ["", "how many rows are judged, a whole number", ""]),
    entry("run.seeds", Number, "", ["", "how many realisations of its random loads each row has, a \
        whole number from 2", ""]),
    entry("run.until_interval", Number, "", ["", "a share above 0 and below 1, such as 0.05", ""]),
    entry("run.most_seeds", Number, "", ["200", "a whole number from 6", ""]),
    entry("run.design", Word, "", ["grid", "\"grid\" or \"one-at-a-time\"", ""]),
    entry("run.kernel", Word, "", ["scalar", "\"scalar\" or \"batch\"", ""]),
    entry("measure", Table, "", ["", "what is measured", ""]),
    entry("measure.columns", Words, "", ["", "a list of measures in quotes", ""]),
    entry("measure.samples", Word, "", ["no", "\"impacts\", \"periods\" or \"no\"", ""]),
    entry("measure.most_samples", Number, "", ["", "a whole number", ""]),
    entry("figure", Table, "", ["", "the picture", ""]),
    entry("figure.kind", Word, "", ["", "a kind of picture in quotes, such as \"bifurcation\"",
        ""]),
    entry("figure.x", Word, "", ["", "a column in quotes", ""]),
    entry("figure.y", Word, "", ["", "a column in quotes", ""]),
    entry("figure.z", Word, "", ["", "a column in quotes", ""]),
    entry("figure.wall", Word, "", ["", "a wall in quotes", ""]),
];
