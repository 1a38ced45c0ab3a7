//! Why a row has no value of a measure of a support.

use super::measure::{Measure, Scope};
use crate::case::Case;

/// Which of `measures`, whose `values` go column by column, have no value at a support of `case`,
/// and why; `None` where all have one.
pub(super) fn reasons(measures: &[Measure], values: &[Option<f64>], case: &Case) -> Option<String> {
    let mut values = values.iter();
    let mut told = Vec::new();
    for &measure in measures {
        let columns = measure.columns(&case.scene);
        for (index, (column, value)) in columns.into_iter().zip(values.by_ref()).enumerate() {
            let of_support =
                matches!(measure.scope(), Scope::Support | Scope::Place) && index < case.scene.supports.len();
            if value.is_none() && of_support {
                told.push(format!("no {column}: {}", reason(measure, index, case)));
            }
        }
    }
    (!told.is_empty()).then(|| told.join("; "))
}

/// Why there is no value of `measure` at support number `index`.
fn reason(measure: Measure, index: usize, case: &Case) -> &'static str {
    let scene = &case.scene;
    let law = case.archard(index);
    let rigid = || {
        let support = scene.supports.get(index);
        support.is_some_and(|support| support.members(&scene.walls).any(|(_, wall)| wall.law.is_rigid()))
    };
    match measure {
        Measure::ImpactShare if rigid() => "nothing slid there",
        Measure::ImpactShare => "an elastic support has no impacts, only forces",
        _ if measure.needs_law() => match law {
            None => "the support has no wear coefficient",
            Some(_) if measure == Measure::SupportWornVolume => "the support itself has no wear coefficient",
            Some(law) if law.coefficient.is_none() => "the tube has no wear coefficient there",
            Some(law) if law.scar.is_none() => "a depth takes width and radius of the support",
            Some(_) => "one scar of that volume would cut the tube in two",
        },
        _ => "there is no force over time in the window",
    }
}
