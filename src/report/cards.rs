//! How reliable a run is, in sentences: one card for each check, with its number.
//!
//! Only the judge decides, in its findings, whether a promise is broken; the limits here only
//! decide where a change by refinement deserves attention.

use crate::case::UNSTABLE;
use crate::residual::Refuted;
use crate::run::notes::{NO_CONTACT, UNRESOLVED_LOAD};
use crate::study::verdict::largest_change;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

/// Changes by refinement up to this share need no attention, and energy unaccounted for up to this
/// share of what was exchanged.
const SMALL: f64 = 1e-2;

/// An error of a mean over realisations up to this share of it needs no attention.
const SCATTER: f64 = 0.1;

/// The cards of the run with this summary.
pub(super) fn cards(summary: &Value) -> Vec<Value> {
    let checks = [refinement(summary), realisations(summary), accuracy(summary), modes(summary)];
    let judged = [contact(summary), energy(summary), momentum(summary)];
    let first = [run(summary), flow(summary)];
    first.into_iter().flatten().chain(checks.into_iter().flatten()).chain(judged).collect()
}

/// The state of a card: the promise is kept, needs attention, is broken, or was not checked.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum State {
    Good,
    Mind,
    Bad,
    Open,
}

pub(super) fn card(title: &str, state: State, verdict: String, text: String) -> Value {
    json!({ "title": title, "state": state, "verdict": verdict, "text": text })
}

/// A number with three digits.
pub(super) fn short(x: f64) -> String {
    let rounded: f64 = format!("{x:.2e}").parse().unwrap_or(x);
    if rounded == 0.0 || (1e-3..1e5).contains(&rounded.abs()) {
        format!("{rounded}").replace('-', "−")
    } else {
        format!("{rounded:e}").replace('-', "−")
    }
}

/// A share as a percentage.
fn percent(x: f64) -> String {
    format!("{} %", short(100.0 * x))
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or(f64::NAN)
}

fn list(value: &Value) -> &[Value] {
    value.as_array().map_or(&[], Vec::as_slice)
}

/// The note of a run that begins with `words`.
fn note<'a>(summary: &'a Value, words: &str) -> Option<&'a str> {
    list(&summary["notes"]).iter().filter_map(Value::as_str).find(|note| note.starts_with(words))
}

fn refinement(summary: &Value) -> Option<Value> {
    let check = &summary["refinement"];
    if check.is_null() {
        let text = "The run was not repeated with half the step.".to_owned();
        return summary["accuracy"].is_null().then(|| card("Refinement", State::Open, "Not checked".to_owned(), text));
    }
    let (walls, supports) = (list(&check["walls"]), list(&check["work_rates"]));
    // Sliders have no impulse of their own: a scene of them alone is judged by their work rates.
    let (what, key, places) = match walls {
        [] if !supports.is_empty() => ("work rates", "work_rate_w", supports),
        _ => ("impulses", "impulse_n_s", walls),
    };
    let change = largest_change(places.iter().map(|place| [0, 1].map(|i| number(&place[key][i]))));
    let contacts = [0, 1].map(|i| walls.iter().filter_map(|wall| wall["contacts"][i].as_u64()).sum::<u64>());
    // `null` where the horizon is before the first row.
    let displacement = check["displacement"].as_f64();
    let (horizon, end) = (number(&check["horizon_s"]), number(&summary["scene"]["duration_s"]));
    let until = if horizon < end * (1.0 - 1e-9) {
        format!("up to t = {} s, the horizon of prediction", short(horizon))
    } else {
        "over the whole run".to_owned()
    };
    let by = |share: f64| {
        let length = number(&check["length_m"]);
        if check["is_gap"] == json!(false) {
            format!("{} m", short(share * length))
        } else {
            format!("{} of the gap", percent(share))
        }
    };
    let moved = match displacement {
        None => format!("was not compared: the horizon of prediction, {} s, is before the first row", short(horizon)),
        Some(share) => format!("changes by {} {until}", by(share)),
    };
    let changed =
        if change > 1.0 { both_largest(places, key) } else { format!("by up to {} of the largest", percent(change)) };
    let text = match walls {
        [] => format!("The displacement {moved}; {what}: {changed}."),
        [..] => format!("Contacts {} → {}; the displacement {moved}; {what}: {changed}.", contacts[0], contacts[1]),
    };
    if !list(&check["findings"]).is_empty() {
        let verdict = "The run it was checked against is refuted".to_owned();
        return Some(card("Refinement", State::Bad, verdict, text));
    }
    let how = if check["check"]["half_step"].is_object() { "Half the step" } else { "Other rounding" };
    // The number that decides stands in the headline.
    let verdict = match displacement {
        Some(share) if change == 0.0 || (share > SMALL && share > change) => {
            format!("{how} changes the displacement by {}", by(share))
        }
        _ => format!("{how} changes {what}{} {changed}", if change > 1.0 { ":" } else { "" }),
    };
    let settled = change <= SMALL && displacement.is_some_and(|share| share <= SMALL);
    let (state, text) = match note(summary, UNRESOLVED_LOAD) {
        Some(note) => (State::Mind, format!("{text} But {note}.")),
        None if settled => (State::Good, text),
        None => (State::Mind, text),
    };
    Some(card("Refinement", state, verdict, text))
}

/// The largest value of each of two runs under `key`, in words.
fn both_largest(places: &[Value], key: &str) -> String {
    let largest = |i: usize| places.iter().map(|place| number(&place[key][i]).abs()).fold(0.0, f64::max);
    format!("the largest is {} and was {}", short(largest(1)), short(largest(0)))
}

/// The largest work rate over realisations, or without one the largest mean force: its error in
/// parts, or its interval where that is not known.
fn realisations(summary: &Value) -> Option<Value> {
    let study = summary.get("realisations")?;
    let largest = |measure: &str, least: f64| {
        let all = list(&study["estimates"]).iter();
        let own = all.filter(|one| one["measure"] == *measure && number(&one["mean"]) >= least);
        own.max_by(|a, b| number(&a["mean"]).total_cmp(&number(&b["mean"])))
    };
    let most = largest("work_rate", f64::MIN_POSITIVE).or_else(|| largest("force_mean", 0.0))?;
    let mean = number(&most["mean"]);
    let what = if most["measure"] == "work_rate" { "work rate" } else { "mean force" };
    let half = most["half_width_95"].as_f64().map_or_else(String::new, |half| format!(" ± {}", short(half)));
    let part = |name: &str| {
        let part = &most["error"][name];
        let [change, half] = [part["mean"].as_f64()?, part["half_width_95"].as_f64()?].map(|x| short(100.0 * x / mean));
        Some(format!("; {name} {change} ± {half} %"))
    };
    let text = format!(
        "{}: {what} {}{half} {}{}.",
        most["place"].as_str().unwrap_or_default(),
        short(mean),
        most["unit"].as_str().unwrap_or_default(),
        ["start", "step", "modes"].into_iter().filter_map(part).collect::<String>()
    );
    let mut refuted = list(&study["checks"]).iter().chain([study]).map(|runs| list(&runs["refuted"]).len());
    if refuted.any(|count| count > 0) {
        return Some(card("Realisations", State::Bad, "Some of them are refuted".to_owned(), text));
    }
    let total = most["error"]["total"].as_f64();
    let relative = total.unwrap_or_else(|| number(&most["half_width_95"])) / mean;
    let state = if relative <= SCATTER { State::Good } else { State::Mind };
    let count = number(&study["count"]);
    let of = if count > 1.0 { format!("over {count} realisations") } else { "from the batches of one".to_owned() };
    let verdict = match total {
        _ if !relative.is_finite() => format!("The largest {what} has no interval: too few contacts"),
        Some(_) => format!("The largest {what} has an error of {}, {of}", percent(relative)),
        None => format!("The largest {what} is known to ±{} {of}", percent(relative)),
    };
    Some(card("Realisations", state, verdict, text))
}

fn accuracy(summary: &Value) -> Option<Value> {
    let found = summary.get("accuracy").filter(|found| found.is_object())?;
    let failed = summary["error"].as_str();
    let state = if failed.is_some() { State::Mind } else { State::Good };
    let asked = ["tolerance", "asked"].iter().find_map(|key| found[*key].as_f64());
    let verdict = match (asked, failed) {
        (Some(asked), None) => format!("Keeps the error of {} that was asked for", short(asked)),
        (_, None) => "Keeps the error that was asked for".to_owned(),
        (_, Some(_)) => "Falls short of the error that was asked for".to_owned(),
    };
    Some(card("Accuracy", state, verdict, failed.unwrap_or("All its numbers are in the summary below.").to_owned()))
}

fn modes(summary: &Value) -> Option<Value> {
    let check = summary.get("truncation").filter(|check| check.is_object())?;
    let walls = list(&check["walls"]);
    let worst = |key: &str| walls.iter().map(|wall| number(&wall[key]).abs()).fold(0.0, f64::max);
    let (impulse, peak) = (worst("impulse_change"), worst("peak_change"));
    let state = match list(&check["findings"]) {
        [_, ..] => State::Bad,
        [] if impulse.max(peak) <= SMALL => State::Good,
        [] => State::Mind,
    };
    let verdict = format!(
        "More modes change impulses by up to {} of the largest, peaks by up to {} of the largest",
        percent(impulse),
        percent(peak)
    );
    let text = format!(
        "{} of {} modes are kept; checked with {}.",
        check["modes"][0], check["degrees_of_freedom"], check["modes"][1]
    );
    Some(card("Modes", state, verdict, text))
}

/// What a card of the judge is about.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Promise {
    Contact,
    Energy,
    Momentum,
    /// The run as a whole.
    Run,
}

/// The promise that a finding says is broken.
fn promise(finding: &Value) -> Promise {
    match Refuted::deserialize(&finding["refuted"]) {
        Ok(
            Refuted::Penetration
            | Refuted::Tension
            | Refuted::Complementarity
            | Refuted::WallLaw
            | Refuted::Normal
            | Refuted::Friction,
        ) => Promise::Contact,
        Ok(Refuted::Energy) => Promise::Energy,
        Ok(Refuted::MomentumBalance | Refuted::Impulses | Refuted::Kinematics) => Promise::Momentum,
        // Another version may know further promises; the card then tells its reason.
        Ok(Refuted::NotFinite | Refuted::Diverged) | Err(_) => Promise::Run,
    }
}

/// The judge's findings about this promise.
fn findings(summary: &Value, about: Promise) -> impl Iterator<Item = &Value> {
    list(&summary["findings"]).iter().filter(move |finding| promise(finding) == about)
}

/// The judge's findings about this promise, one sentence each.
fn broken(summary: &Value, about: Promise) -> Vec<String> {
    let sentence = |finding: &Value| {
        let wall = finding["wall"].as_str().map_or_else(String::new, |wall| format!(" at {wall}"));
        format!(
            "{}: {} where {} is allowed{wall}, t = {} s.",
            finding["refuted"].as_str().unwrap_or_default().replace('_', " "),
            short(number(&finding["residual"])),
            short(number(&finding["tolerance"])),
            short(number(&finding["time_s"]))
        )
    };
    findings(summary, about).map(sentence).collect()
}

/// The card of a run that diverged or has a result that is not finite.
fn run(summary: &Value) -> Option<Value> {
    let sentence = |finding: &Value| {
        let reason = finding["reason"].as_str().unwrap_or("Refuted by the judge");
        format!("At t = {} s: {reason}.", short(number(&finding["time_s"])))
    };
    let sentences: Vec<String> = findings(summary, Promise::Run).map(sentence).collect();
    let verdict = "Refuted by the judge: do not use its numbers".to_owned();
    (!sentences.is_empty()).then(|| card("Run", State::Bad, verdict, sentences.join(" ")))
}

/// The card of a flow beyond the fluid-elastic limit.
fn flow(summary: &Value) -> Option<Value> {
    let why = note(summary, UNSTABLE)?.trim_start_matches(UNSTABLE).trim_start_matches(['.', ' ']);
    Some(card("Flow", State::Bad, "Unstable: work rates mean nothing".to_owned(), format!("{why}.")))
}

/// The card of a promise that the judge checks.
fn judged(title: &str, broken: &[String], verdict: (&str, String), text: String) -> Value {
    match broken {
        [] => card(title, State::Good, verdict.1, text),
        [..] => card(title, State::Bad, verdict.0.to_owned(), broken.join(" ")),
    }
}

fn contact(summary: &Value) -> Value {
    let residuals = &summary["residuals"];
    let broken = broken(summary, Promise::Contact);
    if let (true, Some(note)) = (broken.is_empty(), note(summary, NO_CONTACT)) {
        let text = note.trim_start_matches(NO_CONTACT).trim_start_matches([':', ',', ' ']);
        let (verdict, text) = ("No contact at all".to_owned(), format!("In this run: {text}."));
        return card("Contact conditions", State::Mind, verdict, text);
    }
    let [depth, pull] = ["penetration_m", "tension_n"].map(|key| number(&residuals[key]));
    let text = format!("Deepest {} µm behind a rigid wall; strongest pull {} N.", short(1e6 * depth), short(pull));
    if broken.is_empty() && depth > 0.0 && summary["scheme"].as_str().is_some_and(|name| name.starts_with("penalty")) {
        let deep = depth > SMALL * number(&summary["refinement"]["length_m"]);
        let verdict = format!("The springs in place of rigid walls give way by up to {} µm", short(1e6 * depth));
        return card("Contact conditions", if deep { State::Mind } else { State::Good }, verdict, text);
    }
    let kept = format!("Kept, complementarity to {}", short(number(&residuals["complementarity"])));
    judged("Contact conditions", &broken, ("Refuted by the judge", kept), text)
}

fn energy(summary: &Value) -> Value {
    let energy = &summary["residuals"]["energy"];
    let part = |key: &str| short(number(&energy[key]));
    let friction = if number(&energy["friction_j"]) == 0.0 {
        String::new()
    } else {
        format!(", friction {} J", part("friction_j"))
    };
    let text = format!(
        "The load put in {} J; damping took {} J, impacts {} J, dampers of walls {} J{friction}; \
         {} J at first, {} J at last.",
        part("load_work_j"),
        part("damping_j"),
        part("impact_loss_j"),
        part("wall_damping_j"),
        part("initial_j"),
        part("final_j")
    );
    let open = number(&energy["residual"]).abs();
    let broken = broken(summary, Promise::Energy);
    if broken.is_empty() && open > SMALL {
        let verdict =
            format!("{} of the energy exchanged is unaccounted for; the scheme promises no less", percent(open));
        return card("Energy", State::Mind, verdict, text);
    }
    let kept = format!("The energy balance closes to {} of what was exchanged", short(open));
    judged("Energy", &broken, ("The energy balance does not close", kept), text)
}

fn momentum(summary: &Value) -> Value {
    let residuals = &summary["residuals"];
    let broken = broken(summary, Promise::Momentum);
    let kept = format!("Every step's balance closes to {}", short(number(&residuals["force_balance"])));
    let text = format!("{} N where it is worst.", short(number(&residuals["force_balance_n"])));
    judged("Momentum", &broken, ("Refuted by the judge", kept), text)
}

#[cfg(test)]
mod tests;
