//! Keys: the path of a value in a case file, as `--set` and sweeps write it.

use super::accepted::{accepted, paths};
use crate::error::{Error, Result};
use std::fmt;
use std::str::FromStr;

/// The path of a value in a case file: names of tables and keys, joined by dots.
///
/// A `[[wall]]`, `[[support]]` or `[[probe]]` is addressed by its `name`, a `[[load]]` by its
/// number from 1, as in messages; `*` stands for all of them. Entries of number lists count from 0,
/// as degrees of freedom do.
///
/// ```
/// use signorini::case::Key;
///
/// let key: Key = "load.1.harmonic.frequency".parse()?;
/// assert_eq!(key.unit(), Some("Hz"));
/// assert_eq!("wall.*.restitution".parse::<Key>()?.unit(), None);
/// assert!("wall.upper.restituton".parse::<Key>().unwrap_err().to_string().contains("did you mean"));
/// # Ok::<(), signorini::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct Key {
    parts: Vec<String>,
}

/// Keys inside values that the reader checks itself: those of `at` and of the ends of models.
const INNER: [&str; 38] = [
    "wall.at",
    "wall.at.dof",
    "wall.at.point",
    "wall.at.points",
    "wall.at.position",
    "wall.at.row",
    "wall.at.y",
    "wall.at.z",
    "support.at",
    "support.at.dof",
    "support.at.position",
    "support.at.y",
    "support.at.z",
    "load.at",
    "load.at.dof",
    "load.at.point",
    "load.at.points",
    "load.at.position",
    "load.at.row",
    "load.at.spread",
    "load.base.influence.row",
    "load.at.y",
    "load.at.z",
    "probe.at",
    "probe.at.dof",
    "probe.at.point",
    "probe.at.points",
    "probe.at.position",
    "probe.at.row",
    "probe.at.y",
    "probe.at.z",
    "initial.displacement.dofs",
    "initial.velocity.dofs",
    "initial.displacement.y",
    "initial.displacement.z",
    "initial.velocity.y",
    "initial.velocity.z",
    "system.modal.shapes",
];

/// Conditions at the ends of models: stiffnesses in N/m, for a beam also in N m/rad.
const ENDS: [&str; 3] = ["system.chain", "system.bar", "system.beam"];

/// Units as written in column names, by the path without names and numbers.
const UNITS: [(&str, &[&str]); 21] = [
    ("kg", &["system.oscillator.mass", "system.chain.masses", "system.chain.mass", "system.modal.masses"]),
    ("N_s_per_m", &["system.oscillator.damping", "wall.damping", "support.damping", "penalty.damping"]),
    (
        "N_per_m",
        &[
            "system.oscillator.stiffness",
            "system.chain.springs",
            "wall.stiffness",
            "support.stiffness",
            "penalty.stiffness",
        ],
    ),
    (
        "m",
        &[
            "system.bar.length",
            "system.beam.length",
            "system.beam.outer_diameter",
            "system.beam.inner_diameter",
            "wall.position",
            "wall.gap",
            "wall.at.position",
            "support.gap",
            "support.centre",
            "support.width",
            "support.radius",
            "support.at.position",
            "load.at.position",
            "load.at.spread",
            "probe.at.position",
            "initial.displacement",
            "initial.displacement.dofs",
            "initial.displacement.y",
            "initial.displacement.z",
        ],
    ),
    ("deg", &["wall.direction", "support.directions", "support.turn", "load.direction", "probe.direction"]),
    ("Pa", &["system.bar.youngs_modulus", "system.beam.youngs_modulus"]),
    ("kg_per_m3", &["system.bar.density", "system.beam.density"]),
    ("m2", &["system.bar.area"]),
    ("kg_per_m", &["system.beam.added_mass"]),
    ("Hz", &["system.modal.frequencies", "load.harmonic.frequency", "load.random.from", "load.random.to"]),
    ("rad_per_s", &["system.modal.omega"]),
    ("per_s", &["system.damping.rayleigh.mass"]),
    (
        "s",
        &[
            "system.damping.rayleigh.stiffness",
            "load.impulse.time",
            "time.end",
            "time.step",
            "time.sample",
            "time.statistics_from",
            "time.force_averaging",
            "wear.service",
            "statistics.rest",
        ],
    ),
    ("per_Pa", &["wear.coefficient", "wear.support_coefficient", "support.coefficient", "support.support_coefficient"]),
    ("N", &["load.constant.force", "load.harmonic.amplitude", "load.random.rms"]),
    ("rad", &["load.harmonic.phase"]),
    ("N_s", &["load.impulse.impulse"]),
    ("m_per_s", &["initial.velocity", "initial.velocity.dofs", "initial.velocity.y", "initial.velocity.z"]),
    ("m3_per_N", &["penalty.epsilon"]),
    ("N_per_m", &["system.chain.left.stiffness", "system.chain.right.stiffness", "system.bar.left.stiffness"]),
    ("N_per_m", &["system.bar.right.stiffness", "system.beam.left.stiffness", "system.beam.right.stiffness"]),
];

impl Key {
    /// The parts between the dots.
    pub(super) fn parts(&self) -> &[String] {
        &self.parts
    }

    /// The last part that is a word, which is the default name of a column of its values.
    #[must_use]
    pub fn word(&self) -> &str {
        let word = |part: &&String| part.parse::<usize>().is_err() && *part != "*";
        self.parts.iter().rev().find(word).map_or("", String::as_str)
    }

    /// The unit of its values as written in column names, `N_per_m`; `None` for a value without a
    /// unit.
    #[must_use]
    pub fn unit(&self) -> Option<&'static str> {
        let pattern = self.pattern();
        if ENDS
            .iter()
            .any(|end| [".left.rotational", ".right.rotational"].iter().any(|x| pattern == format!("{end}{x}")))
        {
            return Some("N_m_per_rad");
        }
        UNITS.iter().find(|(_, paths)| paths.contains(&pattern.as_str())).map(|(unit, _)| *unit)
    }

    /// True for a value of `[system]`, which changes the structure, its modes or its coordinates.
    #[must_use]
    pub fn shapes_system(&self) -> bool {
        self.parts.first().is_some_and(|part| part == "system")
    }

    /// The path without names and numbers: `wall.restitution`.
    fn pattern(&self) -> String {
        let listed =
            self.parts.first().is_some_and(|first| ["wall", "support", "load", "probe"].contains(&first.as_str()));
        let shapes = self.parts.starts_with(&["system", "modal", "shapes"].map(str::to_owned));
        let named = |index: usize, part: &str| {
            (listed && index == 1) || (shapes && index == 3) || part == "*" || part.parse::<usize>().is_ok()
        };
        let kept = self.parts.iter().enumerate().filter(|(index, part)| !named(*index, part));
        kept.map(|(_, part)| part.as_str()).collect::<Vec<_>>().join(".")
    }

    fn is_known(&self) -> bool {
        let pattern = self.pattern();
        let listed = ["wall", "support", "load", "probe"].contains(&pattern.as_str());
        let support = |end: &str| {
            ["left", "right"].iter().any(|side| {
                let [stiffness, rotational] = ["stiffness", "rotational"].map(|what| format!("{end}.{side}.{what}"));
                pattern == stiffness || (end == "system.beam" && pattern == rotational)
            })
        };
        !listed
            && (accepted(&pattern).is_some()
                || INNER.contains(&pattern.as_str())
                || ENDS.iter().any(|end| support(end)))
    }

    /// Keys that could have been meant, with the names used in this one.
    fn alternatives(&self) -> Vec<String> {
        let first = self.parts.first().map_or("", String::as_str);
        let name = self.parts.get(1).map_or("*", String::as_str);
        let known: Vec<String> = paths()
            .filter(|path| path.split('.').next() == Some(first))
            .map(|path| match path.split_once('.') {
                Some((list @ ("wall" | "support" | "load" | "probe"), rest)) => format!("{list}.{name}.{rest}"),
                _ => path.to_owned(),
            })
            .filter(|path| path.contains('.'))
            .collect();
        let top = || paths().filter(|path| !path.contains('.')).map(str::to_owned).collect();
        if known.is_empty() { top() } else { known }
    }
}

impl fmt::Display for Key {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.parts.join("."))
    }
}

impl FromStr for Key {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self> {
        let parts: Vec<String> = text.trim().split('.').map(|part| part.trim().to_owned()).collect();
        if parts.iter().any(String::is_empty) {
            let expected = "the path of a value in a case file, such as wall.upper.restitution";
            return Err(Error::invalid("key", format_args!("{text:?}"), expected));
        }
        let key = Self { parts };
        if key.is_known() {
            return Ok(key);
        }
        Err(Error::Unknown { kind: "value of a case file", name: key.to_string(), known: key.alternatives() })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn key(text: &str) -> Key {
        text.parse().unwrap()
    }

    #[test]
    fn every_number_of_a_case_file_is_a_key_with_the_unit_that_the_reader_of_files_states() {
        let mut with_units = 0;
        for path in paths().filter(|path| path.contains('.')) {
            let full = match path.split_once('.') {
                Some((list @ ("wall" | "support" | "probe"), rest)) => format!("{list}.a.{rest}"),
                Some(("load", rest)) => format!("load.1.{rest}"),
                _ => path.to_owned(),
            };
            let found = key(&full).unit();
            let text = accepted(path).unwrap();
            // The text of every number with a unit contains "…, in N s/m".
            let Some(at) = text.find(", in ") else { continue };
            let unit: String = text[at + 5..].chars().take_while(|c| !matches!(c, ':' | ';' | ',')).collect();
            // For tables the text lists the units of several keys; words are in quotes.
            if unit.contains('}') || ["quotes", "double brackets"].contains(&unit.as_str()) {
                continue;
            }
            let unit = unit.replace('^', "");
            let column = match unit.split_once('/') {
                Some(("1", below)) => format!("per_{below}"),
                Some((above, below)) => format!("{above}_per_{below}"),
                None => unit,
            };
            assert_eq!(found, Some(column.replace(' ', "_").as_str()), "{path}");
            with_units += 1;
        }
        assert!(with_units > 35, "{with_units}");
    }

    #[test]
    fn names_and_numbers_are_no_part_of_what_a_key_is() {
        assert_eq!(key("wall.upper.position").unit(), Some("m"));
        assert_eq!(key("initial.displacement.3").unit(), Some("m"));
        assert_eq!(key("penalty.epsilon.0").unit(), Some("m3_per_N"));
        assert_eq!(key("system.beam.left.rotational").unit(), Some("N_m_per_rad"));
        assert_eq!(key("initial.displacement.3").word(), "displacement");
        assert_eq!(key("wall.*.at.position").word(), "position");
        assert_eq!(key("system.modal.shapes.tip.0").pattern(), "system.modal.shapes");
    }

    #[test]
    fn what_is_no_key_is_refused_with_the_one_that_was_meant() {
        for (text, meant) in [
            ("wall.upper.restituton", "did you mean wall.upper.restitution?"),
            ("load.1.harmonic.frequncy", "did you mean load.1.harmonic.frequency?"),
            ("system.oscilator.mass", "did you mean system.oscillator.mass?"),
            ("tim.end", "there is title, source, system"),
            ("wall", "there is wall."),
        ] {
            let error = text.parse::<Key>().unwrap_err();
            assert!(error.is_request() && error.to_string().contains(meant), "{error}");
        }
        assert!("wall..restitution".parse::<Key>().is_err() && "".parse::<Key>().is_err());
    }
}
