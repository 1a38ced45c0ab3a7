//! The loci of special points in the plane of two keys.

use super::super::ui::Ui;
use super::varied::Varied;
use crate::case::{CaseFile, KeyValue};
use crate::error::Result;
use crate::orbit::branch::{Graph, Label, Locus, locus};
use crate::scene::Scene;

/// The loci of the special points with these `names` (of all special points if there are no names),
/// with at most `points` points each. For those that cannot be followed the reason is printed.
pub(super) fn follow(
    file: &CaseFile,
    found: &Graph,
    [key, second]: [&Varied; 2],
    (names, points): (&[String], usize),
    ui: &Ui,
) -> Result<Vec<Locus>> {
    let plane = |[first, other]: [f64; 2]| -> Result<Scene> {
        let mut file = file.clone();
        file.set(&key.key, &KeyValue::from(first))?;
        file.set(&second.key, &KeyValue::from(other))?;
        Ok(file.case()?.scene)
    };
    let has_locus = |label: Label| {
        let named = ["fold", "period-doubling", "symmetry-breaking", "grazing-in", "grazing-out"];
        named.contains(&label.name()) && (names.is_empty() || names.iter().any(|name| name == label.name()))
    };
    let wanted: Vec<_> = found.specials.iter().filter(|special| has_locus(special.label)).collect();
    let bar = ui.progress("loci", wanted.len() as u64);
    let mut traced = Vec::new();
    for (index, special) in wanted.iter().enumerate() {
        bar.set(index as u64);
        match locus(&plane, special, second.value, [key.range, second.range], points) {
            Ok(locus) => traced.push(locus),
            Err(error) => {
                let text = format!("the {} at {} was not followed: {error}", special.label, special.point.value);
                ui.beside(&bar, &text);
            }
        }
    }
    bar.finish();
    Ok(traced)
}
