//! `orbit --list`: orbits of one impact, in closed form.

use crate::case::Case;
use crate::cli::pipeline::Answer;
use crate::error::Result;
use crate::orbit::strobe::stability_in_words;
use crate::orbit::{ClosedForm, Problem, closed_forms};
use crate::output::periodic::listed;
use crate::output::table::Table;

/// Longest orbits of --list, forcing periods.
const LISTED: u32 = 8;

/// The closed forms.
pub(super) fn list(case: &Case) -> Result<Answer> {
    let scene = &case.scene;
    let forms = closed_forms(scene, LISTED)?;
    let problem = Problem::new(scene.clone()).ok();
    let holds = |form: &ClosedForm| match &problem {
        Some(problem) => Some(problem.admissible(&form.orbit(problem)).ok()?.holds()),
        None => form.admissible,
    };
    let found: Vec<_> = forms.into_iter().map(|form| (form.clone(), holds(&form))).collect();
    let mut answer = Answer::new(listed(&found, scene));
    if scene.walls.iter().any(|wall| !wall.law.is_rigid()) {
        answer.remarks(["elastic walls are left out: no orbit in closed form is known of them".to_owned()]);
    }
    if found.is_empty() {
        answer.prose(format!("no orbit of one impact per period of the orbit in up to {LISTED} forcing periods"));
        return Ok(answer);
    }
    let rows = found.iter().map(|(form, admissible)| {
        let wall = scene.walls.get(form.wall).map_or("", |wall| wall.name.as_str());
        let largest = form.multipliers.first().map_or(0.0, |m| m[0].hypot(m[1]));
        vec![
            wall.to_owned(),
            form.periods.to_string(),
            if form.symmetric { "yes" } else { "no" }.to_owned(),
            format!("{:.9}", form.phase),
            format!("{:.9e}", form.speed),
            format!("{largest:.6e}"),
            stability_in_words(&form.multipliers).to_owned(),
            match admissible {
                Some(true) => "yes",
                Some(false) => "no, passes a wall",
                None => "not looked at, too many instants",
            }
            .to_owned(),
        ]
    });
    let header =
        ["wall", "periods", "symmetric", "phase (cycles)", "speed (m/s)", "largest |μ|", "stability", "admissible"];
    answer.table(Table::new(&header, rows.collect()), "--json");
    Ok(answer)
}
