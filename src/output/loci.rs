//! `loci.csv` and the picture of curves of special points in the plane of two keys.

use super::csv::{self, digits};
use super::figure::{Curve, Figure, Panel};
use crate::error::Result;
use crate::orbit::branch::Locus;
use crate::scene::Scene;
use std::path::Path;

/// Writes one row per point: number and label of the locus, the values of both keys (`columns`),
/// and signature, phases and speeds of the orbit.
pub fn table(path: &Path, loci: &[Locus], columns: &[String; 2], scene: &Scene) -> Result<()> {
    let events = loci.iter().flat_map(|locus| locus.points.first()).map(|point| point.orbit.phases.len()).max();
    let mut header: Vec<String> = ["locus", "label", "point"].map(str::to_owned).to_vec();
    header.extend(columns.iter().cloned());
    header.push("signature".to_owned());
    for event in 1..=events.unwrap_or(0) {
        header.extend([format!("phase_{event}_cycles"), format!("speed_{event}_m_per_s")]);
    }
    let rows = loci.iter().enumerate().flat_map(|(number, locus)| {
        locus.points.iter().enumerate().map(move |(index, point)| {
            let mut row = vec![(number + 1).to_string(), locus.label.name().to_owned(), (index + 1).to_string()];
            row.extend(point.values.iter().map(|x| digits(Some(*x))));
            row.push(point.orbit.signature.written(scene));
            for event in 0..events.unwrap_or(0) {
                row.extend([&point.orbit.phases, &point.orbit.speeds].map(|list| digits(list.get(event).copied())));
            }
            row
        })
    });
    csv::table(path, &header, rows)
}

/// The curves in the plane of both keys; `labels` are its axes.
#[must_use]
pub fn picture(loci: &[Locus], labels: &[String; 2], title: &str) -> String {
    let mut panel = Panel::new(labels[1].clone());
    for (number, locus) in loci.iter().enumerate() {
        let points = locus.points.iter().map(|point| (point.values[0], point.values[1]));
        panel = panel.curve(Curve::new(format!("{} {}", number + 1, locus.label), points));
    }
    Figure::new(title, labels[0].clone()).panel(panel).to_svg()
}
