//! `orbit.json`, `orbit.csv` and the pictures of a periodic orbit.

use super::csv;
use super::figure::{Curve, Figure, Mark, Panel};
use super::request::program;
use crate::case::read_text;
use crate::error::{Error, Result, amount, counted};
use crate::orbit::{Admissible, ClosedForm, Event, Floquet, Judged, Orbit, Problem, Shot, Signature};
use crate::scene::{Scene, State};
use serde_json::{Value, json};
use std::path::Path;

/// Largest file that is read, bytes.
const MOST_BYTES: u64 = 1 << 24;

/// An orbit with all its results.
#[derive(Debug)]
pub struct Known<'a> {
    /// The scene it belongs to.
    pub problem: &'a Problem,
    /// The orbit.
    pub orbit: &'a Orbit,
    /// Its multipliers.
    pub floquet: Floquet,
    /// Whether a body can follow it.
    pub admissible: Admissible,
    /// The free run over one period.
    pub judged: &'a Judged,
}

/// An orbit in a few words, by its signature as it is written.
pub(crate) fn headline(signature: &str, symmetric: bool, periods: u64) -> String {
    let touches = match signature {
        "" => "touches no wall",
        written => written,
    };
    let mirror = if symmetric && !signature.is_empty() { " and its mirror image" } else { "" };
    format!("{touches}{mirror}, {}", counted(periods as usize, "forcing period"))
}

/// What the closure of an orbit of one degree of freedom is a share of.
#[must_use]
pub fn closure_of(scene: &Scene) -> &'static str {
    if scene.orbit_gap().is_some() { "the gap" } else { "max |u|" }
}

/// What the closure of an orbit of a structure is a share of.
#[must_use]
pub fn shot_closure_of(scene: &Scene) -> String {
    scene.orbit_gap().map_or_else(|| format!("{} m", amount(scene.orbit_length(), 4)), |_| "the gap".to_owned())
}

fn pairs(multipliers: &[[f64; 2]]) -> Value {
    Value::Array(multipliers.iter().map(|[re, im]| json!([re, im])).collect())
}

fn events(orbit: &Orbit, scene: &Scene) -> Value {
    let events = orbit.signature.events.iter().enumerate().map(|(index, event)| {
        json!({
            "wall": scene.wall_name(event.wall).unwrap_or_default(),
            "kind": event.kind.name(),
            "phase_cycles": orbit.phases.get(index),
            "speed_m_per_s": orbit.speeds.get(index),
        })
    });
    events.collect()
}

impl Known<'_> {
    /// The orbit as a document; [`read`] reads it back.
    #[must_use]
    pub fn document(&self, case: &str) -> Value {
        let Self { problem, orbit, floquet, admissible, judged } = self;
        let scene = problem.scene();
        let walls = judged.walls.iter().zip(&scene.walls).map(|(share, wall)| {
            json!({
                "wall": wall.name,
                "side": wall.side().name(),
                "position_m": wall.position(),
                "rigid": wall.law.is_rigid(),
                "contacts": share.contacts,
                "impulse_n_s": share.impulse,
                "peak_force_n": Some(share.peak_force).filter(|peak| *peak > 0.0),
                "approach_speed_max_m_per_s": share.approach_speed,
            })
        });
        json!({
            "program": program(),
            "case": case,
            "forcing_period_s": orbit.forcing_period,
            "periods": orbit.signature.periods,
            "symmetric": orbit.signature.symmetric,
            "signature": orbit.signature.written(scene),
            "events": events(orbit, scene),
            "multipliers": pairs(&floquet.multipliers),
            "half_map_multipliers": floquet.half.as_deref().map(pairs),
            "stable": floquet.is_stable(),
            "admissible": admissible.holds(),
            "not_admissible_because": admissible.reason(scene),
            "least_speed_m_per_s": admissible.least_speed,
            "least_gap_m": admissible.nearest.map(|nearest| nearest.gap),
            "displacement_max_m": admissible.largest,
            "judge": {
                "closure": judged.closure,
                "closure_of": closure_of(scene),
                "tolerance": judged.tolerance,
                "same_events": judged.same_events,
            },
            "walls": walls.collect::<Vec<_>>(),
        })
    }

    /// Writes the motion over one orbit: time, phase, state and the force of each wall.
    pub fn motion(&self, path: &Path) -> Result<()> {
        let scene = self.problem.scene();
        let names: Vec<&str> = scene.walls.iter().map(|wall| wall.name.as_str()).collect();
        let header = ["time_s", "phase_cycles", "displacement_m", "velocity_m_per_s"].map(str::to_owned);
        let forces = csv::words(&names).into_iter().map(|word| format!("contact_force_{word}_N"));
        let header: Vec<String> = header.into_iter().chain(forces).collect();
        let rows = self.judged.motion.iter().map(|at| {
            let cells = [at.time, at.time / self.orbit.forcing_period, at.displacement, at.velocity];
            cells.iter().chain(&at.forces).map(|x| csv::digits(Some(*x))).collect()
        });
        csv::table(path, &header, rows)
    }

    /// Writes the contact episodes of the free run over one period, as `contacts.csv` of a run.
    pub fn contacts(&self, path: &Path) -> Result<()> {
        let name = |wall: usize| self.problem.scene().wall_name(wall).unwrap_or_default().to_owned();
        let rows = self.judged.contacts.iter().map(|c| csv::contact_cells(name(c.wall), c));
        csv::table(path, &csv::CONTACT, rows)
    }

    /// The orbit in the plane of displacement and velocity.
    #[must_use]
    pub fn portrait(&self, title: &str) -> String {
        let points = self.judged.motion.iter().map(|at| (at.displacement, at.velocity));
        let mut panel = Panel::new("Velocity (m/s)").curve(Curve::new("", points));
        for wall in &self.problem.scene().walls {
            panel = panel.mark(Mark::wall(wall.position(), wall.name.clone()).upright());
        }
        Figure::new(title, "Displacement (m)").panel(panel).to_svg()
    }

    /// Displacement, velocity and, where walls push for a while, their force over time.
    #[must_use]
    pub fn picture(&self, title: &str) -> String {
        let motion = &self.judged.motion;
        let over = |value: fn(&crate::orbit::Instant) -> f64| motion.iter().map(move |at| (at.time, value(at)));
        let mut first = Panel::new("Displacement (m)").curve(Curve::new("", over(|at| at.displacement)));
        for wall in &self.problem.scene().walls {
            first = first.mark(Mark::wall(wall.position(), wall.name.clone()));
        }
        let second = Panel::new("Velocity (m/s)").curve(Curve::new("", over(|at| at.velocity)));
        let mut figure = Figure::new(title, "Time (s)").panel(first).panel(second);
        if motion.iter().any(|at| at.forces.iter().any(|force| *force != 0.0)) {
            let force = Panel::new("Contact force (N)").curve(Curve::new("", over(|at| at.forces.iter().sum())));
            figure = figure.panel(force);
        }
        figure.to_svg()
    }
}

/// The orbit in a file that [`Known::document`] has written, for the walls of `scene`.
///
/// # Errors
/// [`Error::Io`] for a file that cannot be read; [`Error::Invalid`] naming the key that is missing
/// or not what it should be; [`Error::Unknown`] for a wall that the scene does not have.
pub fn read(path: &Path, scene: &Scene) -> Result<Orbit> {
    let document = document(path)?;
    let key = |name: &str| format!("{}: {name}", path.display());
    let get = |name: &str| document.get(name).unwrap_or(&Value::Null);
    let wrong = |name: &str, found: &Value, expected: &str| Err(Error::invalid(key(name), found, expected));
    let Some(periods) = get("periods").as_u64().and_then(|n| u32::try_from(n).ok()) else {
        return wrong("periods", get("periods"), "a whole number of forcing periods");
    };
    let Some(symmetric) = get("symmetric").as_bool() else {
        return wrong("symmetric", get("symmetric"), "true or false");
    };
    let Some(forcing_period) = get("forcing_period_s").as_f64() else {
        return wrong("forcing_period_s", get("forcing_period_s"), "a number, s");
    };
    let Some(listed) = get("events").as_array() else {
        return wrong("events", get("events"), "a list of events");
    };
    let signature = Signature { events: Vec::new(), periods, symmetric };
    let mut orbit = Orbit { signature, phases: Vec::new(), speeds: Vec::new(), forcing_period };
    for (index, entry) in listed.iter().enumerate() {
        let get = |name: &str| entry.get(name).unwrap_or(&Value::Null);
        let at = |name: &str| format!("events, entry {}, {name}", index + 1);
        let (Some(wall), Some(kind)) = (get("wall").as_str(), get("kind").as_str()) else {
            return wrong(&at("wall and kind"), entry, "words");
        };
        let (Some(phase), Some(speed)) = (get("phase_cycles").as_f64(), get("speed_m_per_s").as_f64()) else {
            return wrong(&at("phase_cycles and speed_m_per_s"), entry, "numbers");
        };
        orbit.signature.events.push(Event { kind: kind.parse()?, wall: scene.wall_index(wall)? });
        orbit.phases.push(phase);
        orbit.speeds.push(speed);
    }
    orbit.signature.check(scene)?;
    Ok(orbit)
}

/// True if the file `path` tells its orbit by a state, as [`shot`] writes it, and not by events.
///
/// # Errors
/// [`Error::Io`] for a file that cannot be read.
pub fn tells_state(path: &Path) -> Result<bool> {
    Ok(document(path)?.get("coordinates").is_some())
}

/// The orbit of a structure in a file that [`shot`] has made; `modal` is true if the coordinates of
/// `scene` are modal.
///
/// # Errors
/// [`Error::Io`] for a file that cannot be read; [`Error::Invalid`] naming the key that is missing
/// or not what it should be.
pub fn read_shot(path: &Path, scene: &Scene, modal: bool) -> Result<Shot> {
    let document = document(path)?;
    let get = |name: &str| document.get(name).unwrap_or(&Value::Null);
    let wrong = |name: &str, expected: &str| {
        let found = match get(name) {
            Value::Null => "missing".to_owned(),
            value => value.to_string().chars().take(60).collect(),
        };
        Err(Error::invalid(format!("{}: {name}", path.display()), found, expected))
    };
    let Some(periods) = get("periods").as_u64().and_then(|n| u32::try_from(n).ok()) else {
        return wrong("periods", "a whole number of forcing periods");
    };
    if get("events").is_array() && get("coordinates").is_null() {
        let expected = "that of a structure, by its state";
        return Err(Error::invalid(
            path.display().to_string(),
            "an orbit of one degree of freedom, by its events",
            expected,
        ));
    }
    if get("coordinates").as_str() != Some(coordinates(modal)) {
        return wrong("coordinates", &format!("those of the case: {}", coordinates(modal)));
    }
    let (Some(forcing_period), Some(time)) = (get("forcing_period_s").as_f64(), get("time_s").as_f64()) else {
        let missing = if get("time_s").is_f64() { "forcing_period_s" } else { "time_s" };
        return wrong(missing, "a number, s: that of the orbit of a structure");
    };
    let list = |name: &str| -> Option<Vec<f64>> { get(name).as_array()?.iter().map(Value::as_f64).collect() };
    let (Some(q), Some(v)) = (list("displacement_m"), list("velocity_m_per_s")) else {
        let missing = if list("displacement_m").is_some() { "velocity_m_per_s" } else { "displacement_m" };
        return wrong(missing, "a list of numbers, one for each degree of freedom");
    };
    let walls = scene.walls.len();
    let signature = Signature { events: Vec::new(), periods, symmetric: false };
    Ok(Shot {
        periods,
        forcing_period,
        orbit: Orbit { signature, phases: Vec::new(), speeds: Vec::new(), forcing_period },
        time,
        state: State { q, v },
        multipliers: Vec::new(),
        closure: f64::INFINITY,
        contacts: vec![0; walls],
        impulses: vec![0.0; walls],
    })
}

/// The document in a file of an orbit.
fn document(path: &Path) -> Result<Value> {
    let unreadable = |reason: String| Error::io(path.display(), reason, true);
    let expected = "expected the orbit.json of `signorini orbit`";
    let text = read_text(path, MOST_BYTES).map_err(|reason| unreadable(format!("{reason}; {expected}")))?;
    serde_json::from_str(&text).map_err(|error| unreadable(format!("not valid JSON: {error}")))
}

/// The kind of coordinates of states.
fn coordinates(modal: bool) -> &'static str {
    if modal { "modal" } else { "degrees of freedom" }
}

/// A list of closed forms as a document.
#[must_use]
pub fn listed(found: &[(ClosedForm, Option<bool>)], scene: &Scene) -> Value {
    let one = |(form, admissible): &(ClosedForm, Option<bool>)| {
        json!({
            "wall": scene.wall_name(form.wall),
            "periods": form.periods,
            "symmetric": form.symmetric,
            "phase_cycles": form.phase,
            "speed_m_per_s": form.speed,
            "multipliers": pairs(&form.multipliers),
            "stable": form.is_stable(),
            "admissible": admissible,
        })
    };
    json!({ "orbits": found.iter().map(one).collect::<Vec<_>>() })
}

/// The orbit of a structure as a document, which [`read_shot`] reads back; `modal` is true if its
/// coordinates are modal.
#[must_use]
pub fn shot(found: &Shot, scene: &Scene, case: &str, modal: bool) -> Value {
    let walls =
        scene.walls.iter().zip(&found.contacts).zip(&found.impulses).map(
            |((wall, contacts), impulse)| json!({ "wall": wall.name, "contacts": contacts, "impulse_n_s": impulse }),
        );
    json!({
        "program": program(),
        "case": case,
        "forcing_period_s": found.forcing_period,
        "periods": found.periods,
        "coordinates": coordinates(modal),
        "time_s": found.time,
        "displacement_m": found.state.q,
        "velocity_m_per_s": found.state.v,
        "signature": found.orbit.signature.written(scene),
        "events": events(&found.orbit, scene),
        "multipliers": pairs(&found.multipliers),
        "stable": found.is_stable(),
        "closure": found.closure,
        "closure_of": shot_closure_of(scene),
        "walls": walls.collect::<Vec<_>>(),
    })
}
