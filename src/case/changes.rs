//! Changes values of a case file by their keys, before it is built.

use super::key::Key;
use super::key_value::KeyValue;
use super::schema::{self, is_list, is_numbered};
use crate::error::{Error, Result};
use toml::{Table, Value};

/// Sets `key` to `new`; tables that the file left out are created.
pub(super) fn set(file: &mut Table, key: &Key, new: &KeyValue) -> Result<()> {
    let Some((first, rest)) = key.parts().split_first() else { return Ok(()) };
    match first.as_str() {
        first if is_list(first) => {
            for entry in entries(file, key)? {
                put(entry, rest.get(1..).unwrap_or_default(), key, &new.0)?;
            }
            Ok(())
        }
        _ => {
            if rest.is_empty() {
                file.insert(first.clone(), new.0.clone());
                return Ok(());
            }
            put(file.entry(first.clone()).or_insert_with(empty), rest, key, &new.0)
        }
    }
}

/// The value at `key`; `None` where the file leaves it out, or where `*` refers to several values
/// that differ.
pub(super) fn get(file: &Table, key: &Key) -> Option<KeyValue> {
    let (first, rest) = key.parts().split_first()?;
    let mut found: Vec<&Value> = vec![file.get(first)?];
    for (index, part) in rest.iter().enumerate() {
        let named = index == 0 && is_list(first) && !is_numbered(first);
        let mut next = Vec::new();
        for value in found {
            match value {
                Value::Array(list) if part == "*" => next.extend(list),
                Value::Array(list) if named => next.extend(list.iter().filter(|entry| is_named(entry, part))),
                Value::Array(list) => {
                    let from = usize::from(index == 0 && is_numbered(first));
                    next.extend(part.parse::<usize>().ok().and_then(|i| list.get(i.checked_sub(from)?)));
                }
                Value::Table(table) => next.extend(table.get(part)),
                _ => {}
            }
        }
        found = next;
    }
    let (one, others) = found.split_first()?;
    others.iter().all(|other| other == one).then(|| KeyValue((*one).clone()))
}

/// Removes the value at `key` within a table that is no list, such as `time.sample`.
#[cfg(feature = "cli")]
pub(super) fn remove(file: &mut Table, key: &Key) {
    let Some((last, tables)) = key.parts().split_last() else { return };
    let mut table = Some(file);
    for name in tables {
        table = table.and_then(|table| table.get_mut(name)?.as_table_mut());
    }
    table.and_then(|table| table.remove(last));
}

fn empty() -> Value {
    Value::Table(Table::new())
}

fn is_named(entry: &Value, name: &str) -> bool {
    entry.get("name").and_then(Value::as_str) == Some(name)
}

/// The tables of a list, as `[[wall]]`, to which the second part of
/// `key` refers.
fn entries<'a>(file: &'a mut Table, key: &Key) -> Result<Vec<&'a mut Value>> {
    let part = |index: usize| key.parts().get(index).map_or("", String::as_str);
    let (list, name) = (part(0), part(1));
    let mut all: Vec<&mut Value> =
        file.get_mut(list).and_then(Value::as_array_mut).map_or_else(Vec::new, |list| list.iter_mut().collect());
    let names: Vec<String> = if is_numbered(list) {
        (1..=all.len()).map(|number| number.to_string()).collect()
    } else {
        all.iter().filter_map(|entry| entry.get("name")?.as_str()).map(str::to_owned).collect()
    };
    if name == "*" && !all.is_empty() {
        return Ok(all);
    }
    let kind = schema::list(list).unwrap_or("wall");
    match names.iter().position(|known| known == name) {
        Some(index) if index < all.len() => Ok(vec![all.swap_remove(index)]),
        _ => Err(Error::Unknown { kind, name: name.to_owned(), known: names }),
    }
}

fn put(value: &mut Value, path: &[String], key: &Key, new: &Value) -> Result<()> {
    let Some((first, rest)) = path.split_first() else {
        *value = new.clone();
        return Ok(());
    };
    match value {
        Value::Table(table) if rest.is_empty() => {
            table.insert(first.clone(), new.clone());
            Ok(())
        }
        Value::Table(table) => put(table.entry(first.clone()).or_insert_with(empty), rest, key, new),
        Value::Array(list) if first == "*" => list.iter_mut().try_for_each(|entry| put(entry, rest, key, new)),
        Value::Array(list) => {
            let count = list.len();
            match first.parse::<usize>().ok().and_then(|index| list.get_mut(index)) {
                Some(entry) => put(entry, rest, key, new),
                None => Err(Error::invalid("key", key, format!("an entry of that list from 0 to below {count}"))),
            }
        }
        _ => Err(Error::invalid("key", key, in_place_of(value, path, key))),
    }
}

/// What is needed in place of the `value` of the file, which has no parts, where `key` goes on with
/// `path`.
fn in_place_of(value: &Value, path: &[String], key: &Key) -> String {
    let (whole, _) = key.parts().split_at(key.parts().len().saturating_sub(path.len()));
    match (whole.last().map(String::as_str), value) {
        (Some("friction"), Value::Float(_) | Value::Integer(_)) => format!(
            "friction = {{ static = {value}, kinetic = {value} }} there, in the file or by --set: it says the same as \
             the file's friction = {value}, and has both coefficients as keys"
        ),
        _ => {
            let first = path.first().map_or("", String::as_str);
            format!("a list or a table before .{first}; the file has {value} there")
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const FILE: &str = "[system.oscillator]\nmass = 1.0\ndamping = 0.2\nstiffness = 100.0\n\
        [[wall]]\nname = \"a\"\nside = \"upper\"\nposition = 1.0\nrestitution = 0.5\n\
        [[wall]]\nname = \"b\"\nside = \"lower\"\nposition = -1.0\nrestitution = 0.5\n\
        [[load]]\nharmonic = { amplitude = 3.0, frequency = 5.0 }\n\
        [time]\nend = 1.0\nstep = 0.1\n[penalty]\nepsilon = [1e-9, 1e-6]\n";

    fn file() -> Table {
        toml::from_str(FILE).unwrap()
    }

    fn key(text: &str) -> Key {
        text.parse().unwrap()
    }

    #[test]
    fn what_is_set_is_read_again_and_nothing_else_has_changed() {
        for (path, value) in [
            ("wall.b.restitution", KeyValue::from(0.25)),
            ("load.1.harmonic.phase", KeyValue::from(0.5)),
            ("initial.displacement", KeyValue::from(1e-3)),
            ("penalty.epsilon.1", KeyValue::from(2e-6)),
            ("system.oscillator.mass", KeyValue::from(2)),
        ] {
            let mut changed = file();
            set(&mut changed, &key(path), &value).unwrap();
            assert_eq!(get(&changed, &key(path)), Some(value), "{path}");
            assert_ne!(changed, file());
        }
        let mut changed = file();
        set(&mut changed, &key("wall.*.restitution"), &0.1.into()).unwrap();
        assert_eq!(get(&changed, &key("wall.*.restitution")), Some(0.1.into()));
        set(&mut changed, &key("wall.a.restitution"), &0.2.into()).unwrap();
        assert_eq!(get(&changed, &key("wall.*.restitution")), None);
        assert_eq!(get(&changed, &key("wall.b.restitution")), Some(0.1.into()));
        set(&mut changed, &key("wall.*.restitution"), &0.5.into()).unwrap();
        assert_eq!(changed, file());
    }

    #[test]
    fn what_is_not_there_is_said_with_what_is() {
        for (path, words) in [
            ("wall.uper.position", "no wall is named \"uper\"; there is a, b"),
            ("load.2.harmonic.phase", "no load is named \"2\"; there is 1"),
            ("probe.*.name", "no probe is named \"*\": none exists"),
            ("penalty.epsilon.2", "an entry of that list from 0 to below 2"),
            ("time.end.3", "a list or a table before .3"),
        ] {
            let error = set(&mut file(), &key(path), &1.0.into()).unwrap_err();
            assert!(error.is_request() && error.to_string().contains(words), "{path}: {error}");
        }
    }
}
