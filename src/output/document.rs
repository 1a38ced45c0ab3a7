//! A chart and a stability study as the JSON documents that `--json` prints. A number that is
//! missing or not finite is null.

use super::request::program;
use super::work_precision::failure;
use crate::case::Case;
use crate::study::stability::lasting::{LastingForce, Quality};
use crate::study::stability::plan::Maps;
use crate::study::work_precision::{Errors, Measured, MethodPoints, Point, WorkPrecision};
use serde_json::{Value, json};

/// `value`, an object, with the keys that every document has: program and case.
pub(crate) fn under_head(case: &Case, mut value: Value) -> Value {
    value["program"] = json!(program());
    value["case"] = json!(case.name);
    value["title"] = json!(case.title);
    value["source"] = json!(case.source);
    value
}

/// Accuracy against speed: every point of every method.
#[must_use]
pub fn chart(case: &Case, chart: &WorkPrecision) -> Value {
    let walls: Vec<&str> = case.scene.walls.iter().map(|wall| wall.name.as_str()).collect();
    let floors = chart.floors.iter().map(|floor| {
        json!({
            "penalty": floor.law.to_string(),
            "errors": floor.errors.as_ref().map(|errors| self::errors(errors, &walls)),
            "compared_until_s": floor.end,
            "failure": floor.reference.as_ref().err().map(ToString::to_string),
        })
    });
    let value = json!({
        "compared_until_s": chart.horizon.end,
        "growth": chart.horizon.growth,
        "growth_of_all": chart.horizon.growth_of_all,
        "reference": { "how": chart.reference.how, "uncertainty": errors(&chart.reference.uncertainty, &walls) },
        "series": chart.series.iter().map(|one| series(chart, one, &walls)).collect::<Vec<_>>(),
        "floors": floors.collect::<Vec<_>>(),
        "notes": case.notes(),
    });
    under_head(case, value)
}

/// The order of convergence of each method of a chart, by its name: null where there is none.
#[must_use]
pub fn orders(chart: &WorkPrecision) -> Value {
    let order = |one: &MethodPoints| (one.method.to_string(), json!(one.order(chart.known(&one.method.scheme))));
    Value::Object(chart.series.iter().map(order).collect())
}

fn series(chart: &WorkPrecision, series: &MethodPoints, walls: &[&str]) -> Value {
    json!({
        "method": series.method.to_string(),
        "order": series.order(chart.known(&series.method.scheme)),
        "points": series.points.iter().map(|one| point(one, walls)).collect::<Vec<_>>(),
    })
}

fn point(point: &Point, walls: &[&str]) -> Value {
    let measured = point.measured();
    let number = |of: fn(&Measured) -> f64| measured.map(of);
    json!({
        "step_s": point.step,
        "seconds": number(|m| m.seconds),
        "errors": measured.map(|m| errors(&m.errors, walls)),
        "errors_against_own_springs": measured.and_then(|m| m.own.as_ref()).map(|own| errors(own, walls)),
        "counters": measured.map(|m| m.counters),
        "notes": measured.map(|m| &m.notes),
        "failure": failure(&point.outcome, ""),
    })
}

fn errors(errors: &Errors, walls: &[&str]) -> Value {
    let impulse = walls.iter().zip(&errors.impulse).map(|(wall, error)| ((*wall).to_owned(), json!(error)));
    json!({
        "displacement": errors.displacement,
        "velocity": errors.velocity,
        "impulse": impulse.collect::<serde_json::Map<_, _>>(),
        "contact_time": errors.contact_time,
        "contacts_missing": errors.missing,
        "contacts_spurious": errors.spurious,
    })
}

/// A stability study: its scale, and what each scheme does to the energy and to a lasting contact.
/// The CSV has every cell of the maps.
#[must_use]
pub fn stability(case: &Case, maps: &Maps, quality: &Quality) -> Value {
    let value = json!({
        "steps_s": maps.steps,
        "duration_s": maps.horizon,
        "omega_rad_per_s": maps.scale.omega,
        "omega_is": maps.scale.origin.describe(),
        "energy_j": quality.energy,
        "lasting_contacts": quality.lines.iter().map(lasting).collect::<Vec<_>>(),
        "notes": case.notes(),
    });
    under_head(case, value)
}

fn lasting(line: &LastingForce) -> Value {
    let seen = line.outcome.as_ref().ok();
    json!({
        "scheme": line.name,
        "step_s": line.step,
        "largest_energy": seen.map(|s| s.largest),
        "last_energy": seen.map(|s| s.last),
        "lost_at_walls": seen.map(|s| s.lost_at_walls),
        "unexplained_energy": seen.map(|s| s.unexplained),
        "contact": seen.and_then(|s| s.contact.as_ref()).map(|(wall, c)| json!({
            "wall": wall,
            "start_s": c.start,
            "end_s": c.end,
            "impulse_n_s": c.impulse,
            "ripple": c.ripple,
        })),
        "failure": line.outcome.as_ref().err().map(ToString::to_string),
    })
}
