//! The page of one periodic orbit.

use super::cards::{State, card, short};
use super::column;
use super::folder::{Folder, Numbers};
use super::run::{case_text, derivatives};
use crate::error::Result;
use crate::orbit::strobe::is_on_the_circle;
use crate::output::derivatives::FILE;
use crate::output::periodic;
use serde_json::{Value, json};

/// Most walls whose impulses are among the facts; a table has all.
const MOST_WALLS: usize = 4;

/// The contents of the page of an orbit; for a structure only the multipliers and the walls, since
/// its motion is not written.
pub(super) fn contents(folder: &Folder<'_>) -> Result<Value> {
    let document = folder.json("orbit.json")?;
    let mut orbit = json!({
        "forcing": document["forcing_period_s"],
        "periods": document["periods"],
        "events": document["events"],
        "multipliers": document["multipliers"],
        "half": document["half_map_multipliers"],
        "walls": document["walls"],
        "run": was_run(&document),
        "state": {
            "coordinates": document["coordinates"],
            "time": document["time_s"],
            "q": document["displacement_m"],
            "v": document["velocity_m_per_s"],
        },
    });
    orbit["motion"] = read_motion(folder, &document)?;
    if !orbit["motion"].is_null() {
        let contacts = folder.cells("contacts.csv")?;
        for name in ["start_s", "impulse_N_s", "approach_speed_m_per_s", "departure_speed_m_per_s", "peak_force_N"] {
            contacts.column(name)?;
        }
        orbit["contacts"] = contacts.for_page(None);
    }
    let derivatives = if folder.has(FILE) { derivatives(folder)? } else { Value::Null };
    Ok(json!({
        "subtitle": format!("periodic orbit: {}", headline(&document)),
        "orbit": orbit,
        "derivatives": derivatives,
        "facts": facts(&document),
        "cards": cards(&document),
        "case": case_text(&folder.manifest["case_file"]),
        "summary": document,
    }))
}

/// The motion of the orbit in a folder; null where none was written.
pub(super) fn read_motion(folder: &Folder<'_>, document: &Value) -> Result<Value> {
    if !folder.has("orbit.csv") {
        return Ok(Value::Null);
    }
    motion(&folder.numbers("orbit.csv")?, document["walls"].as_array().map_or(0, Vec::len))
}

/// The motion: phase, displacement, velocity, and the force of each wall that pushes for a while.
fn motion(table: &Numbers, walls: usize) -> Result<Value> {
    let wrong = || {
        let expected = "time_s, phase_cycles, displacement_m, velocity_m_per_s and the force of each";
        table.wrong(format!("has {} columns; expected {expected} of {walls} walls", table.columns.len()))
    };
    let [_, phase, q, v, forces @ ..] = &table.columns[..] else { return Err(wrong()) };
    if forces.len() != walls {
        return Err(wrong());
    }
    let lasting = forces.iter().enumerate().filter(|(_, force)| force.iter().any(|f| *f != 0.0));
    let force =
        |(wall, force): (usize, &Vec<f64>)| json!({ "wall": wall, "force": column::f32(force.iter().copied()) });
    Ok(json!({
        "phase": column::f64(phase),
        "q": column::f32(q.iter().copied()),
        "v": column::f32(v.iter().copied()),
        "forces": lasting.map(force).collect::<Vec<_>>(),
    }))
}

/// The orbit in a few words.
fn headline(document: &Value) -> String {
    let symmetric = document["symmetric"] == true;
    match (document["signature"].as_str(), document["periods"].as_u64()) {
        (Some(signature), Some(periods)) => periodic::headline(signature, symmetric, periods),
        _ => String::new(),
    }
}

fn moduli(list: &Value) -> Vec<f64> {
    let modulus = |pair: &Value| pair[0].as_f64().zip(pair[1].as_f64()).map(|(re, im)| re.hypot(im));
    list.as_array().into_iter().flatten().filter_map(modulus).collect()
}

/// True if the free run over the orbit was made; an orbit that no body can follow is not run, and
/// has no impulses.
fn was_run(document: &Value) -> bool {
    document["judge"]["closure"].is_number() || document["closure"].is_number()
}

/// The key figures.
fn facts(document: &Value) -> Value {
    let fact = |label: &str, value: String, unit: &str| json!({ "label": label, "value": value, "unit": unit });
    let mut facts = Vec::new();
    let number = |key: &str| document[key].as_f64();
    if let (Some(forcing), Some(periods)) = (number("forcing_period_s"), number("periods")) {
        facts.push(fact("period", format!("{:.9}", forcing * periods), "s"));
    }
    let largest = moduli(&document["multipliers"]).into_iter().reduce(f64::max);
    facts.extend(largest.map(|modulus| fact("largest |multiplier|", short(modulus), "")));
    facts.extend(number("displacement_max_m").map(|q| fact("largest |displacement|", short(1e3 * q), "mm")));
    facts.extend(number("least_gap_m").map(|gap| fact("least gap to a wall not met", short(1e3 * gap), "mm")));
    let walls = document["walls"].as_array().map_or(&[][..], Vec::as_slice);
    for wall in walls.iter().filter(|_| walls.len() <= MOST_WALLS && was_run(document)) {
        let name = wall["wall"].as_str().unwrap_or_default();
        facts.extend(wall["impulse_n_s"].as_f64().map(|p| fact(&format!("impulse, {name}"), short(p), "N s")));
        let peak = wall["peak_force_n"].as_f64().filter(|peak| *peak > 0.0);
        facts.extend(peak.map(|peak| fact(&format!("largest lasting force, {name}"), short(peak), "N")));
    }
    json!(facts)
}

/// The checks of the orbit: whether the free run comes back, whether a body can follow it, whether
/// runs settle on it.
fn cards(document: &Value) -> Vec<Value> {
    let mut cards = Vec::new();
    let largest = moduli(&document["multipliers"]).into_iter().fold(0.0, f64::max);
    // For an orbit that no body can follow, the multipliers say nothing about runs.
    let (state, verdict) = match (document["admissible"] == false, document["stable"] == true) {
        (true, _) => (State::Open, "As a solution of the equations only"),
        (false, true) => (State::Good, "Stable: runs settle on it"),
        (false, false) if is_on_the_circle(largest) => (State::Mind, "Neutral: runs stay beside it"),
        (false, false) => (State::Mind, "Unstable: runs leave it"),
    };
    let text = format!("The largest multiplier has the modulus {}; below 1 a small change dies out.", short(largest));
    cards.push(card("Stability", state, verdict.to_owned(), text));
    if document["admissible"].is_boolean() {
        let reason = document["not_admissible_because"].as_str();
        cards.push(match reason {
            None => card(
                "Admissible",
                State::Good,
                "A body can follow it".to_owned(),
                "It passes no wall between its events, and walls only push.".to_owned(),
            ),
            Some(reason) => {
                let text = format!("Reason: {reason}.");
                card("Admissible", State::Bad, "No body can follow it".to_owned(), text)
            }
        });
    }
    let judge = &document["judge"];
    let closure = judge["closure"].as_f64().or(document["closure"].as_f64());
    let same = judge["same_events"].as_bool().unwrap_or(true);
    cards.push(match (closure, judge["tolerance"].as_f64()) {
        (None, _) => card("Free run", State::Open, "Not run".to_owned(), String::new()),
        (Some(closure), tolerance) => {
            let of = judge["closure_of"].as_str().or(document["closure_of"].as_str()).unwrap_or("the gap");
            let back = format!("It ends within {} of {of} from where it began", short(closure));
            let text = tolerance.map_or(format!("{back}."), |most| format!("{back}; rounding allows {}.", short(most)));
            let holds = same && tolerance.is_none_or(|most| closure <= most);
            match (holds, same) {
                (true, _) => card("Free run", State::Good, "The free run over one period comes back".to_owned(), text),
                (false, true) => card("Free run", State::Bad, "The free run does not come back".to_owned(), text),
                (false, false) => {
                    card("Free run", State::Bad, "The free run goes through other events".to_owned(), text)
                }
            }
        }
    });
    cards
}
