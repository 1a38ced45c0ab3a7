//! Looks keys up, and says what would be accepted there.

use super::key_entry::{KeyEntry, Kind};
use super::keys::LISTED;
use std::collections::HashMap;
use std::sync::LazyLock;

/// Keys that users may write in the wrong table, with the right one.
const ELSEWHERE: &[(&str, &str)] = &[
    ("statistics.force_window", "`force_averaging` in [time]: the stretch over which forces are averaged"),
    ("statistics.force_averaging", "`force_averaging` in [time]"),
    ("statistics.statistics_from", "`statistics_from` in [time]"),
    ("wall.friction", "`friction` in [[slider]] in one plane, in [[support]] in two: a wall has none"),
    ("time.rest", "`rest` in [statistics]"),
    ("time.spectra", "`spectra` in [statistics]"),
];

/// The key that was probably meant by a key in the wrong table.
pub(super) fn elsewhere(path: &str) -> Option<&'static str> {
    ELSEWHERE.iter().find(|(key, _)| *key == path).map(|(_, text)| *text)
}

/// The keys of a kind of file.
#[derive(Debug)]
pub(crate) struct Schema {
    /// What messages call the whole file.
    pub file: &'static str,
    /// The keys of each table, in their order; those of the whole file under the empty path.
    tables: HashMap<&'static str, Vec<&'static KeyEntry>>,
}

/// The keys of a case file: those listed, and under `body` those of every system and its damping.
static KEYS: LazyLock<Vec<KeyEntry>> = LazyLock::new(|| {
    let of_body = |entry: &KeyEntry| {
        let (_, key) = entry.key.split_once("system.")?;
        let kept = !["planes", "modes", "static_correction"].contains(&key);
        // The keys are made once, and hold as long as the program runs.
        kept.then(|| KeyEntry { key: format!("body.{key}").leak(), ..*entry })
    };
    LISTED.iter().copied().chain(LISTED.iter().filter_map(of_body)).collect()
});

/// The keys of a case file.
pub(super) static CASE: LazyLock<Schema> = LazyLock::new(|| Schema::new("the case file", &KEYS));

impl Schema {
    pub fn new(file: &'static str, keys: &'static [KeyEntry]) -> Self {
        let mut tables: HashMap<_, Vec<_>> = HashMap::new();
        for entry in keys.iter().filter(|entry| !entry.is_inner()) {
            tables.entry(entry.key.rsplit_once('.').map_or("", |(table, _)| table)).or_default().push(entry);
        }
        Self { file, tables }
    }

    /// The keys of the table with that path, in their order.
    pub fn children(&self, table: &str) -> impl Iterator<Item = &'static KeyEntry> + Clone {
        self.tables.get(table).into_iter().flatten().copied()
    }

    /// What would be accepted at a key, for messages.
    pub fn help(&self, entry: &KeyEntry) -> String {
        let KeyEntry { key, kind, accepted, .. } = entry;
        let keys = |one: &dyn Fn(&KeyEntry) -> String| self.children(key).map(one).collect::<Vec<_>>().join(", ");
        match kind {
            Kind::Tables => format!("one [[{key}]] table, in double brackets, for each {key}"),
            Kind::Table => {
                let one = |child: &KeyEntry| match (child.kind, child.unit) {
                    (Kind::Table, _) => format!("[{}]", child.key),
                    (_, "") => child.word.to_owned(),
                    _ => format!("{} ({})", child.word, child.unit_in_words()),
                };
                format!("the table [{key}] with {}", keys(&one))
            }
            Kind::Inline => {
                let unit = |child: &KeyEntry| if child.unit.is_empty() { "..".into() } else { child.unit_in_words() };
                format!("{} = {{ {} }}", entry.word, keys(&|child| format!("{} = {}", child.word, unit(child))))
            }
            _ => {
                // What stands below in the table of keys does not stand below a message.
                let accepted = &*accepted.replace(", see below", "");
                let (values, remark) = accepted.split_once(": ").map_or((accepted, None), |(a, b)| (a, Some(b)));
                let unit =
                    if entry.unit.is_empty() { String::new() } else { format!(", in {}", entry.unit_in_words()) };
                let remark = remark.map_or_else(String::new, |remark| format!(": {remark}"));
                format!("{} = {values}{unit}{remark}", entry.word)
            }
        }
    }
}

/// The key with that path, also within a place.
pub(super) fn find(path: &str) -> Option<&'static KeyEntry> {
    let place = path.split_once('.').filter(|(list, rest)| is_list(list) && rest.starts_with("at."));
    let sought = place.map_or(path, |(_, place)| place);
    // Of a place to which another is relative, the keys are those of a place.
    let sought = sought.replacen("at.relative_to.", "at.", 1);
    KEYS.iter().find(|entry| entry.key == sought).filter(|_| !path.starts_with("at."))
}

/// What would be accepted at the key with that path.
pub(super) fn accepted(path: &str) -> Option<String> {
    find(path).map(|entry| CASE.help(entry))
}

/// The name of a list of tables, such as those of walls.
pub(super) fn list(name: &str) -> Option<&'static str> {
    ["body", "material", "wall", "support", "slider", "load", "turbulence", "probe"]
        .into_iter()
        .find(|list| *list == name)
}

/// True for the name of a list of tables.
pub(super) fn is_list(name: &str) -> bool {
    list(name).is_some()
}

/// True for the name of a list whose tables have numbers, from 1, in place of names.
pub(super) fn is_numbered(name: &str) -> bool {
    matches!(name, "load" | "turbulence")
}

/// The path of every key but those within values, without names and numbers of walls, supports,
/// loads and probes.
pub(super) fn paths() -> impl Iterator<Item = &'static str> + Clone {
    KEYS.iter().filter(|entry| !entry.is_inner()).map(|entry| entry.key)
}

/// The keys of values as `--set` takes them, with `=` behind, for shells to complete.
#[cfg(feature = "cli")]
pub(crate) static SETTABLE: LazyLock<Vec<String>> = LazyLock::new(|| {
    let values = KEYS.iter().filter(|entry| !entry.is_inner() && !entry.is_table());
    let key = |entry: &KeyEntry| match entry.key.split_once('.') {
        Some((list, rest)) if is_list(list) => format!("{list}.*.{rest}="),
        _ => format!("{}=", entry.key),
    };
    values.map(key).collect()
});

#[cfg(test)]
mod tests {
    use super::super::{Case, CaseFile, Embedded, Key, KeyValue};
    use super::*;

    const README: &str = include_str!("../../cases/README.md");
    const HEADER: &str = "| key | unit | if left out | accepted | refused |\n|---|---|---|---|---|\n";

    /// A cell of a Markdown table: brackets outside of code are no links.
    fn cell(text: &str) -> String {
        let parts = text.split('`').enumerate();
        let escaped = parts.map(|(i, part)| if i % 2 == 0 { part.replace('[', "\\[") } else { part.to_owned() });
        format!(" {} |", escaped.collect::<Vec<_>>().join("`").replace('|', "\\|")).replace("  |", " |")
    }

    /// The keys in the form of `cases/README.md`.
    fn table() -> String {
        let mut section = "";
        let mut rows = String::from(HEADER);
        for entry in LISTED.iter().filter(|entry| !entry.is_inner()) {
            let name = match entry.kind {
                Kind::Table => format!("[{}]", entry.key),
                Kind::Tables => format!("[[{}]]", entry.key),
                _ => {
                    let within = entry.key.strip_prefix(section).and_then(|rest| rest.strip_prefix('.'));
                    within.unwrap_or(entry.key).to_owned()
                }
            };
            if matches!(entry.kind, Kind::Table | Kind::Tables) {
                section = entry.key;
            }
            let unit = entry.unit_in_words().replace("^2", "²").replace("^3", "³");
            let cells = [&format!("`{name}`"), &unit, entry.default, entry.accepted, entry.refused];
            rows += &format!("|{}\n", cells.map(cell).concat());
        }
        rows
    }

    #[test]
    fn the_format_in_the_readme_of_the_cases_is_that_of_the_keys() {
        let (before, rest) = README.split_once(HEADER).unwrap();
        let after = rest.split_once("\n\n").unwrap().1;
        let made = format!("{before}{}\n{after}", table());
        if std::env::var_os("SIGNORINI_UPDATE_KEYS").is_some() {
            std::fs::write(concat!(env!("CARGO_MANIFEST_DIR"), "/cases/README.md"), &made).unwrap();
        } else {
            assert!(made == README, "SIGNORINI_UPDATE_KEYS=1 cargo test --lib schema writes the table anew");
        }
    }

    #[test]
    fn each_key_stands_once_below_its_table_and_its_help_is_ascii() {
        for (index, entry) in KEYS.iter().enumerate() {
            assert!(KEYS[..index].iter().all(|other| other.key != entry.key), "{} twice", entry.key);
            let help = CASE.help(entry);
            assert!(help.is_ascii(), "{}: {help}", entry.key);
            let table = entry.key.rsplit_once('.').map(|(table, _)| table).filter(|_| !entry.is_inner());
            assert!(table.is_none_or(|table| find(table).is_some_and(KeyEntry::is_table)), "{}", entry.key);
        }
    }

    #[test]
    fn what_holds_where_a_key_is_left_out_is_what_its_entry_says() {
        // Set to its default, a key makes the case that it makes where it is left out. Each key is
        // tried in the first few cases that may have it: some take long to read.
        let mut tried = HashMap::new();
        for embedded in Embedded::all() {
            let file = CaseFile::of_embedded(*embedded);
            let (case, text): (_, toml::Table) = (file.case().unwrap(), toml::from_str(embedded.text).unwrap());
            let first = |list: &str| {
                let name = text.get(list)?.get(0)?.get("name").and_then(toml::Value::as_str);
                Some(name.unwrap_or("1").to_owned())
            };
            for entry in KEYS.iter().filter(|entry| !entry.is_inner() && !entry.is_table()) {
                if tried.get(entry.key) == Some(&4) {
                    continue;
                }
                let Ok(value) = entry.default.trim_matches('`').parse::<KeyValue>() else { continue };
                let written = value.0.as_str().is_none() || entry.default.starts_with("`\"");
                let table = entry.key.rsplit_once('.').map_or("", |(table, _)| table);
                let full = |path: &str| match path.split_once('.') {
                    Some((list, rest)) if is_list(list) => {
                        format!("{list}.{}.{rest}", first(list)?).parse::<Key>().ok()
                    }
                    _ => path.parse().ok(),
                };
                let has = |path: &str| full(path).is_some_and(|key| file.get(&key).unwrap().is_some());
                let Some(key) = full(entry.key).filter(|_| written && !has(entry.key)) else { continue };
                if !is_list(table) && !has(table) {
                    continue;
                }
                let mut set = file.clone();
                set.set(&key, &value).unwrap();
                // Some make no sense beside other keys, such as the damping of a rigid wall.
                let Ok(set) = set.case() else { continue };
                assert_eq!(Case { document: case.document.clone(), ..set }, case, "{}: {}", embedded.name, entry.key);
                *tried.entry(entry.key).or_insert(0) += 1;
            }
        }
        assert!(tried.len() > 12, "{tried:?}");
    }

    #[test]
    fn help_has_the_unit_before_the_remark() {
        let words = |key: &str| accepted(key).unwrap();
        assert_eq!(words("wall.position"), "position = a number, in m");
        assert_eq!(
            words("wear.sectors"),
            "sectors = a whole number from 1 to 3600: equal parts of the circle around each support"
        );
        assert_eq!(words("system.bar.area"), "area = a number above 0, in m^2");
        assert_eq!(words("load.impulse"), "impulse = { impulse = N s, time = s }");
        assert_eq!(words("statistics"), "the table [statistics] with rest (s), spectra");
        assert!(words("system.damping.rayleigh.mass").ends_with(", in 1/s"));
        assert!(words("wall.damping").contains(", in N s/m: of an elastic wall"));
    }
}
