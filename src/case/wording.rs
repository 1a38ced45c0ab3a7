//! The keys of a case file for the values of a scene.

use crate::error::{Part, Subject};

/// The subject of an error, as a case file writes it; `owner` is the table that says what vibrates,
/// "system" or "body".
pub(super) fn written(subject: &Subject, owner: &str) -> String {
    let (mut names, mut rest) = (Vec::new(), String::new());
    for part in subject.parts() {
        match part {
            Part::Name(name) if rest.is_empty() => names.push(name.as_ref()),
            Part::Numbered("value", number) if !names.is_empty() => rest = format!("{rest}: value {number}"),
            _ => return subject.to_string(),
        }
    }
    let key = match names.as_slice() {
        ["duration"] => "time.end".to_owned(),
        [key @ ("step" | "sample" | "statistics_from" | "force_averaging")] => format!("time.{key}"),
        ["output times"] => "time.output_times".to_owned(),
        ["sectors"] => "wear.sectors".to_owned(),
        ["statistics", key] => format!("statistics.{key}"),
        ["static correction"] => "static_correction".to_owned(),
        ["initial state", part] => format!("initial.{part}"),
        // For an end of a structure the key is that of the end; its parts are inside that value.
        [table @ ("bar" | "beam"), end @ ("left" | "right"), part] => format!("{owner}.{table}.{end}: {part}"),
        ["modal data", "ratios"] => format!("{owner}.modal.damping_ratios"),
        ["modal data", names @ ..] => format!("{owner}.modal.{}", names.join(".")),
        [table @ ("oscillator" | "chain" | "bar" | "beam" | "damping"), names @ ..] => {
            [&[owner, table], names].concat().join(".")
        }
        _ => return subject.to_string(),
    };
    key + &rest
}
