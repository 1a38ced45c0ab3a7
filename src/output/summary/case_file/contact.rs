//! The tables `[[wall]]` and `[[support]]`.

use super::place::{at, put_place};
use super::put::put;
use crate::case::{Case, Place, Scarred, Support};
use crate::scene::{self, Flats, Side, Wall, WallLaw};
use serde_json::{Map, Value, json};

/// A wall; null where a case file cannot express it.
pub(super) fn wall(case: &Case, wall: &Wall, place: Option<&Place>, several: bool) -> Value {
    let mut out = Map::new();
    out.insert("name".to_owned(), json!(wall.name));
    if several {
        put_place(&mut out, case, place, &wall.at);
    }
    out.insert("side".to_owned(), json!(if wall.side == Side::Upper { "upper" } else { "lower" }));
    out.insert("position".to_owned(), json!(wall.position));
    if let WallLaw::Quartic { .. } = wall.law {
        return Value::Null;
    }
    put_law(&mut out, wall.law);
    Value::Object(out)
}

/// Adds a law that a case file can express.
fn put_law(out: &mut Map<String, Value>, law: WallLaw) {
    match law {
        // Where a static correction replaces the restitution, the file must not name one.
        WallLaw::Rigid { restitution } => put(out, "restitution", (restitution != 1.0).then(|| json!(restitution))),
        WallLaw::Elastic { stiffness, damping } => {
            out.insert("stiffness".to_owned(), json!(stiffness));
            put(out, "damping", (damping != 0.0).then(|| json!(damping)));
        }
        WallLaw::Quartic { .. } => {}
    }
}

/// The keys of the shape of flats.
pub(super) fn flats_of(Flats { flats, .. }: &Flats) -> Map<String, Value> {
    let mut out = Map::new();
    out.insert("shape".to_owned(), json!("flats"));
    out.insert("directions".to_owned(), flats.iter().map(|flat| flat.direction).collect());
    let gap = match flats.split_first() {
        Some((first, rest)) if rest.iter().all(|flat| flat.gap == first.gap) => json!(first.gap),
        _ => flats.iter().map(|flat| flat.gap).collect(),
    };
    out.insert("gap".to_owned(), gap);
    out
}

/// The keys of the shape of a round hole.
pub(super) fn round_of(gap: f64) -> Map<String, Value> {
    [("shape".to_owned(), json!("round")), ("gap".to_owned(), json!(gap))].into_iter().collect()
}

/// A support.
pub(super) fn support(
    (written, there): (&Support, &scene::Support),
    shape: Map<String, Value>,
    law: WallLaw,
    is_beam: bool,
) -> Value {
    let mut out = Map::new();
    out.insert("name".to_owned(), json!(written.name));
    out.insert("at".to_owned(), at(&written.place));
    out.extend(shape);
    put(&mut out, "centre", (there.centre != [0.0; 2]).then(|| json!(there.centre)));
    put_law(&mut out, law);
    put(&mut out, "friction", (there.friction != 0.0).then(|| json!(there.friction)));
    let Scarred { scar, coefficient, support_coefficient, .. } = written.scarred;
    put(&mut out, "width", scar.map(|(width, _)| json!(width)));
    // The radius of a beam follows from its diameter.
    put(&mut out, "radius", scar.filter(|_| !is_beam).map(|(_, radius)| json!(radius)));
    put(&mut out, "coefficient", coefficient.map(|k| json!(k)));
    put(&mut out, "support_coefficient", support_coefficient.map(|k| json!(k)));
    Value::Object(out)
}
