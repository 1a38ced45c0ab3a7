//! Locations on the structure.

use super::put::put;
use crate::case::{Case, Place};
use crate::scene::Row;
use serde_json::{Map, Value, json};

/// Adds the location that the scene has as `row`: as the file gave it, with its direction, or as
/// the row itself where the location was changed or condensed.
pub(super) fn put_place(map: &mut Map<String, Value>, case: &Case, place: Option<&Place>, row: &Row) {
    match place.filter(|place| case.sees(place).is_some_and(|seen| seen == *row)) {
        Some(Place::Towards { place, degrees }) => {
            map.insert("at".to_owned(), at(place));
            map.insert("direction".to_owned(), json!(degrees));
        }
        Some(place) if !matches!(place, Place::Row(_)) => {
            map.insert("at".to_owned(), at(place));
        }
        _ => {
            let entries: Vec<(usize, f64)> =
                row.entries().iter().map(|&(i, weight)| (case.numbered(i), weight)).collect();
            map.insert("at".to_owned(), json!({ "row": entries }));
        }
    }
}

/// A location, without its direction.
pub(super) fn at(place: &Place) -> Value {
    match place {
        Place::Dof(i) => json!({ "dof": i }),
        Place::Position(x) => json!({ "position": x }),
        Place::Spread { from, to } => json!({ "spread": [from, to] }),
        Place::Points(points) => match points.as_slice() {
            [(name, 1.0)] => json!({ "point": name }),
            _ => json!({ "points": points }),
        },
        Place::Row(entries) => json!({ "row": entries }),
        Place::Rows { y, z } => {
            let mut out = Map::new();
            for (plane, row) in [("y", y), ("z", z)] {
                put(&mut out, plane, (!row.is_empty()).then(|| json!(row)));
            }
            Value::Object(out)
        }
        Place::Towards { place, .. } => at(place),
    }
}
