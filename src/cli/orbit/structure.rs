//! An orbit of a structure.

use super::args::Args;
use super::derivative::Wanted;
use crate::case::Case;
use crate::cli::pipeline::Answer;
use crate::cli::ui::Ui;
use crate::error::counted;
use crate::error::{Error, Result};
use crate::orbit::strobe::stability_in_words;
use crate::orbit::{Shot, shoot};
use crate::output::json;
use crate::output::periodic::{read_shot, shot, shot_closure_of};
use crate::output::results::Results;
use crate::output::table::Table;
use crate::scene::{Scene, Wall};

/// The orbit of a structure, by shooting.
pub(super) fn structure(args: &Args, case: &Case, wanted: &Wanted, ui: &Ui) -> Result<Answer> {
    if args.signature.is_some() {
        let expected = "a case of one degree of freedom; the orbit of a structure is the one on which its run settles \
                        (--settle), or one near that of a file (--from)";
        return Err(Error::invalid("--signature", "given", expected));
    }
    let (scene, modal) = (&case.scene, case.truncated.is_some());
    let from = args.from.as_deref().map(|path| read_shot(path, scene, modal)).transpose()?;
    let results = args.open(case)?;
    let found = ui.with_bar("settling", |bar| match from {
        Some(from) => from.corrected(scene),
        None => shoot(scene, args.settle, &|share| bar.set_share(share)),
    })?;
    told(args, case, wanted, &found, results)
}

/// The answer that tells an orbit by its state.
pub(super) fn told(args: &Args, case: &Case, wanted: &Wanted, found: &Shot, mut results: Results) -> Result<Answer> {
    let (scene, modal) = (&case.scene, case.truncated.is_some());
    let mut document = shot(found, scene, &case.name, modal);
    let derivatives = wanted.of_state(scene, found)?;
    if let Some(by_key) = &derivatives {
        document["derivatives"] = wanted.document(case, by_key);
        wanted.write(case, by_key, &mut results)?;
    }
    results.write("orbit.json", json::text(&document))?;
    let mut answer = Answer::of(results, !args.place.no_report, document);
    show_structure(&mut answer, found, scene);
    if let Some(by_key) = &derivatives {
        wanted.show(&mut answer, case, by_key);
    }
    Ok(answer)
}

/// Shows an orbit by its state.
fn show_structure(answer: &mut Answer, found: &Shot, scene: &Scene) {
    let period = f64::from(found.periods) * found.forcing_period;
    answer.prose(format!("orbit: {}, period {period:.9} s", counted(found.periods as usize, "forcing period")));
    let multipliers = found.multipliers.iter().take(4).map(|[re, im]| match im {
        0.0 => format!("{re:.9}"),
        im => format!("{re:.9} {im:+.9}i"),
    });
    let verdict = stability_in_words(&found.multipliers);
    answer.prose(format!(
        "largest of {} Floquet multipliers: {} ({verdict})",
        found.multipliers.len(),
        multipliers.collect::<Vec<_>>().join(", ")
    ));
    let rows = scene.walls.iter().zip(&found.contacts).zip(&found.impulses);
    let row = |((wall, contacts), impulse): ((&Wall, &u64), &f64)| {
        let contacts = if *contacts == 0 && *impulse != 0.0 { "always".to_owned() } else { contacts.to_string() };
        vec![wall.name.clone(), contacts, format!("{impulse:.9e}")]
    };
    answer.table(Table::new(&["wall", "contacts", "impulse (N s)"], rows.map(row).collect()), "orbit.json");
    answer.prose(format!(
        "free run over one period: comes back within {:.1e} of {}",
        found.closure,
        shot_closure_of(scene)
    ));
}
