//! The tables `[[load]]`.

use super::place::put_place;
use super::put::put;
use crate::case::{Case, Origin, TableColumns};
use crate::scene::{Density, Load, LoadKind, RandomForce};
use serde_json::{Map, Value, json};

/// A load; null where a case file cannot express it.
pub(super) fn load(case: &Case, index: usize, load: &Load, several: bool) -> Value {
    let mut out = Map::new();
    if several {
        put_place(&mut out, case, case.written.loads.get(index), &load.at);
    }
    let (kind, value) = match &load.kind {
        LoadKind::Constant { force } => ("constant", json!({ "force": force })),
        LoadKind::Harmonic { amplitude, frequency, phase } => {
            ("harmonic", json!({ "amplitude": amplitude, "frequency": frequency, "phase": phase }))
        }
        LoadKind::Impulse { impulse, time } => ("impulse", json!({ "impulse": impulse, "time": time })),
        LoadKind::Table(_) => match case.written.origins.get(index) {
            Some(Origin::Table { file, columns }) => ("table", table(file, columns, "force")),
            Some(Origin::Random { force, file, both }) => {
                if *both {
                    out.insert("direction".to_owned(), json!("both"));
                }
                ("random", random(force, file.as_deref()))
            }
            Some(Origin::Base { file, columns, influence, direction }) => {
                out.clear();
                put(&mut out, "direction", direction.map(|degrees| json!(degrees)));
                let mut base = table(file, columns, "acceleration");
                if let (Some(row), Some(map)) = (influence, base.as_object_mut()) {
                    map.insert("influence".to_owned(), json!({ "row": row }));
                }
                ("base", base)
            }
            _ => return Value::Null,
        },
        LoadKind::Function(_) => return Value::Null,
    };
    out.insert(kind.to_owned(), value);
    Value::Object(out)
}

/// A table: its file, its columns and the format of its numbers.
fn table(file: &str, columns: &TableColumns, values: &str) -> Value {
    json!({
        "file": file,
        "time": columns.time,
        values: columns.force,
        "delimiter": columns.delimiter,
        "decimal": columns.decimal,
        "scale": columns.scale,
    })
}

fn random(force: &RandomForce, file: Option<&str>) -> Value {
    match (&force.density, file) {
        (_, Some(file)) => json!({ "file": file, "seed": force.seed }),
        (Density::Flat { rms, from, to }, _) => json!({ "rms": rms, "from": from, "to": to, "seed": force.seed }),
        (Density::Points(points), _) => json!({ "psd": points, "seed": force.seed }),
    }
}
