//! Absolute paths, which a page that is forwarded does not show: they name people and machines.

use serde_json::Value;
use std::path::Path;

/// Takes the folders out of a page's data: in every `command` absolute paths become relative to the
/// folder of the case, or their last part where they lie elsewhere; of the `files` that a run has
/// read the path is left out, since `file` is the one relative to the case. Where a case itself
/// names a file by an absolute path, the last part of it stands everywhere.
pub(super) fn shorten(data: &mut Value) {
    let mut named = Vec::new();
    files_by_absolute_paths(data, &mut named);
    shorten_with(data, &named);
}

/// Adds the absolute paths of files that a run has read by them.
fn files_by_absolute_paths(data: &Value, named: &mut Vec<String>) {
    match data {
        Value::Object(map) => {
            let files = map.get("files").and_then(Value::as_array).into_iter().flatten();
            let paths = files.filter_map(|file| file.get("file")?.as_str());
            named.extend(paths.filter(|path| absolute(path).is_some()).map(str::to_owned));
            map.values().for_each(|value| files_by_absolute_paths(value, named));
        }
        Value::Array(list) => list.iter().for_each(|value| files_by_absolute_paths(value, named)),
        _ => {}
    }
}

fn shorten_with(data: &mut Value, named: &[String]) {
    match data {
        Value::Object(map) => {
            for (key, value) in map.iter_mut() {
                match (key.as_str(), value) {
                    ("command" | "command_line", Value::String(text)) => *text = command(text),
                    ("files", Value::Array(files)) => {
                        for file in files.iter_mut() {
                            file.as_object_mut().map(|file| file.remove("path"));
                            shorten_with(file, named);
                        }
                    }
                    (_, value) => shorten_with(value, named),
                }
            }
        }
        Value::Array(list) => list.iter_mut().for_each(|value| shorten_with(value, named)),
        Value::String(text) => {
            for path in named {
                if text.contains(path.as_str()) {
                    *text = text.replace(path.as_str(), last_part(path));
                }
            }
        }
        _ => {}
    }
}

/// The name of a file or folder without the folders that it is in.
fn last_part(path: &str) -> &str {
    path.trim_end_matches(['/', '\\']).rsplit(['/', '\\']).next().unwrap_or_default()
}

/// A command line without absolute paths. Its third word is the case.
fn command(text: &str) -> String {
    let words = words(text);
    let case = words.get(2).and_then(|word| absolute(word)).map_or("", |(_, path)| path);
    let folder = Path::new(case.trim_end_matches('\'')).parent().and_then(Path::to_str).filter(|dir| !dir.is_empty());
    let shown = words.iter().map(|word| {
        let Some((before, path)) = absolute(word) else { return (*word).to_owned() };
        let within = folder.and_then(|folder| path.strip_prefix(folder)?.strip_prefix(['/', '\\']));
        format!("{before}{}", within.unwrap_or_else(|| last_part(path)))
    });
    shown.collect::<Vec<_>>().join(" ")
}

/// The absolute path that ends a word of a command, and what stands before it: a quote, or an
/// option and `=`.
fn absolute(word: &str) -> Option<(&str, &str)> {
    let option = if word.trim_start_matches('\'').starts_with('-') { word.find('=').map_or(0, |at| at + 1) } else { 0 };
    let quote = word.get(option..)?.len() - word.get(option..)?.trim_start_matches('\'').len();
    let (before, path) = word.split_at_checked(option + quote)?;
    let bytes = path.as_bytes();
    let drive = bytes.first().is_some_and(u8::is_ascii_alphabetic)
        && bytes.get(1) == Some(&b':')
        && matches!(bytes.get(2), Some(b'/' | b'\\'));
    (path.starts_with('/') || path.starts_with("\\\\") || drive).then_some((before, path))
}

/// The words of a command line, quoted as they are.
fn words(text: &str) -> Vec<&str> {
    let mut quoted = false;
    text.split(|c: char| {
        quoted ^= c == '\'';
        c == ' ' && !quoted
    })
    .collect()
}

#[cfg(test)]
mod tests {
    use super::{command, shorten};
    use serde_json::json;

    #[test]
    fn commands_name_no_folder_of_a_machine() {
        for (typed, shown) in [
            ("signorini run case.toml --out out/a", "signorini run case.toml --out out/a"),
            ("signorini run /home/jane/p/case.toml --out /home/jane/p/out/a", "signorini run case.toml --out out/a"),
            ("signorini orbit tube --from /tmp/x/orbit.json", "signorini orbit tube --from orbit.json"),
            ("signorini run case.toml --out=/tmp/x/", "signorini run case.toml --out=x"),
            ("signorini run '/home/jane doe/p/a b.toml' --force", "signorini run 'a b.toml' --force"),
            ("signorini run 'C:\\jane\\case.toml' --out 'C:\\jane\\out'", "signorini run 'case.toml' --out 'out'"),
            ("signorini run a --set 'wall.*.restitution=0.8'", "signorini run a --set 'wall.*.restitution=0.8'"),
        ] {
            assert_eq!(command(typed), shown);
        }
    }

    #[test]
    fn files_keep_their_names_relative_to_the_case() {
        let mut data = json!({ "methods": [{ "summary": {
            "files": [{ "file": "f.csv", "path": "/home/jane/f.csv", "bytes": 3 }], "unit": "N s/m",
        } }] });
        shorten(&mut data);
        let expected = json!({ "methods": [{ "summary": {
            "files": [{ "file": "f.csv", "bytes": 3 }], "unit": "N s/m",
        } }] });
        assert_eq!(data, expected);
    }

    #[test]
    fn a_file_that_the_case_names_by_an_absolute_path_stands_by_its_name() {
        let mut data = json!({ "methods": [{ "summary": {
            "files": [{ "file": "/home/jane/m.csv", "path": "/home/jane/m.csv" }, { "file": "k.csv" }],
            "case_file": { "system": { "matrices": { "mass": "/home/jane/m.csv", "stiffness": "k.csv" } } },
        } }], "case": "mass = \"/home/jane/m.csv\"\nstiffness = \"k.csv\"" });
        shorten(&mut data);
        let expected = json!({ "methods": [{ "summary": {
            "files": [{ "file": "m.csv" }, { "file": "k.csv" }],
            "case_file": { "system": { "matrices": { "mass": "m.csv", "stiffness": "k.csv" } } },
        } }], "case": "mass = \"m.csv\"\nstiffness = \"k.csv\"" });
        assert_eq!(data, expected);
    }
}
