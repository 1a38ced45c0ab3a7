//! The loci of special points in the plane of two keys.

use super::args::Args;
use crate::cli::ui::Ui;
use crate::error::Result;
use crate::orbit::branch::{Graph, Label, Locus, locus};
use crate::output::scene_family::SceneFamily;
use crate::output::varied::Varied;

/// The loci of the special points that `args` names, of all special points if it names none. For
/// those that cannot be followed the reason is printed.
pub(super) fn follow(family: &SceneFamily, second: &Varied, found: &Graph, args: &Args, ui: &Ui) -> Result<Vec<Locus>> {
    let (key, names) = (&family.key, &args.locus);
    let scene = |[first, other]: [f64; 2]| family.scene_with(&[(key, first), (second, other)]);
    let has_locus = |label: Label| {
        Label::WITH_LOCUS.contains(&label) && (names.is_empty() || names.iter().any(|name| name == label.name()))
    };
    let wanted: Vec<_> = found.specials.iter().filter(|special| has_locus(special.label)).collect();
    let ranges = [key.range, second.range];
    if wanted.is_empty() {
        let among = Label::WITH_LOCUS.map(Label::name).join(", ");
        let asked = if names.is_empty() { among } else { names.join(", ") };
        ui.message(&format!("no special point was found whose locus can be followed ({asked}): loci.csv is empty"));
    }
    ui.with_bar("loci", |bar| {
        let mut traced = Vec::new();
        for (index, special) in wanted.iter().enumerate() {
            bar.set_share(index as f64 / wanted.len() as f64);
            match locus(&scene, special, second.value, ranges, args.points as usize) {
                Ok(locus) => traced.push(locus),
                Err(error) => {
                    bar.message(&format!("the {} at {} was not followed: {error}", special.label, special.point.value));
                }
            }
        }
        Ok(traced)
    })
}
