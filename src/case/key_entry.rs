//! What a case or sweep file may have at a key.

/// What stands at a key.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Kind {
    /// A table under a header of its own.
    Table,
    /// A table within braces.
    Inline,
    /// One table in double brackets for each wall, support, load or probe.
    Tables,
    Number,
    Numbers,
    Word,
    #[cfg_attr(not(feature = "cli"), expect(dead_code, reason = "only sweep files have lists of words"))]
    Words,
    Truth,
    /// One of several types; the reader of the key decides.
    Any,
}

/// A key of a case or sweep file.
#[derive(Debug, Clone, Copy)]
pub(crate) struct KeyEntry {
    /// Its path, without the names and numbers of walls, supports, loads and probes.
    pub key: &'static str,
    /// The last part of its path.
    pub word: &'static str,
    pub kind: Kind,
    /// Its unit, as columns have it: `N_per_m`; empty where it has none.
    pub unit: &'static str,
    /// What holds where it is left out.
    pub default: &'static str,
    /// The accepted values; of a table what it describes.
    pub accepted: &'static str,
    /// Values that are refused although one might expect them to be accepted.
    #[cfg_attr(not(test), expect(dead_code, reason = "stands in cases/README.md, which a test writes"))]
    pub refused: &'static str,
}

/// What is written under `default` of a key that its table must have.
pub(crate) const REQUIRED: &str = "required";

/// A key from its path, type and unit, and what holds where it is left out, what is accepted and
/// what is refused.
pub(crate) const fn entry(key: &'static str, kind: Kind, unit: &'static str, words: [&'static str; 3]) -> KeyEntry {
    let [default, accepted, refused] = words;
    KeyEntry { key, word: last_part(key), kind, unit, default, accepted, refused }
}

const fn last_part(path: &'static str) -> &'static str {
    let mut at = path.len();
    while at > 0 && path.as_bytes()[at - 1] != b'.' {
        at -= 1;
    }
    path.split_at(at).1
}

impl KeyEntry {
    pub fn is_required(&self) -> bool {
        self.default == REQUIRED
    }

    /// True for a key within a value of several types, which the reader of that value reads.
    pub fn is_inner(&self) -> bool {
        self.accepted.is_empty() && !self.is_table()
    }

    pub fn is_table(&self) -> bool {
        matches!(self.kind, Kind::Table | Kind::Inline | Kind::Tables)
    }

    /// Its unit in words: `N/m`, `1/s`, `m^2`.
    pub fn unit_in_words(&self) -> String {
        let unit = match self.unit.strip_prefix("per_") {
            Some(below) => format!("1/{below}"),
            None => self.unit.replace("_per_", "/"),
        };
        unit.replace('_', " ").replace("m2", "m^2").replace("m3", "m^3")
    }
}
