//! `spectrum-NAME.csv`: power spectral densities of displacements and of averaged forces, and their
//! figures.

use super::csv;
use super::figure::{Curve, Figure, Panel};
use super::results::Results;
use crate::case::{Case, rows_of};
use crate::error::Result;
use crate::run::Run;
use crate::scene::{Face, heading};
use crate::statistics::Spectrum;
use serde::Serialize;

/// Most panels of a figure.
const MOST: usize = 4;

/// The spectra of one probe, wall or support.
#[derive(Debug, Clone, Serialize)]
pub struct SpectrumFile {
    /// Its file, without the extension.
    #[serde(rename = "file")]
    pub name: String,
    /// Name of the probe, wall or support; empty for the only probe of one degree of freedom.
    pub place: String,
    /// What it is a spectrum of.
    pub quantity: Quantity,
    /// Length over which a force was averaged, s.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub averaged_over_s: Option<f64>,
    /// Number of segments.
    pub segments: usize,
    /// Distance of its frequencies, Hz.
    pub spacing_hz: f64,
    /// Degrees of freedom of the estimate at a frequency.
    pub degrees_of_freedom: f64,
    /// The spectra: of one signal, or along y and along z.
    #[serde(skip)]
    spectra: Vec<(&'static str, Spectrum)>,
}

/// What a spectrum is of.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Quantity {
    /// The displacement of a probe, m.
    Displacement,
    /// The force of a wall or a support, averaged, N.
    ContactForce,
}

impl Quantity {
    fn column(self, way: &str) -> String {
        let way = if way.is_empty() { String::new() } else { format!("_{way}") };
        match self {
            Self::Displacement => format!("displacement{way}_m2_per_Hz"),
            Self::ContactForce => format!("contact_force{way}_N2_per_Hz"),
        }
    }
}

impl SpectrumFile {
    /// The spectra of `signals` (along the ways that they are called by) at a place, sampled at a
    /// `spacing` (s); `None` without signals, and of a run that diverged.
    fn of(
        name: String,
        (place, quantity): (&str, Quantity),
        signals: Vec<(&'static str, Vec<f64>)>,
        spacing: f64,
    ) -> Result<Option<Self>> {
        if signals.iter().any(|(_, signal)| signal.iter().any(|x| !x.is_finite())) {
            return Ok(None);
        }
        let spectra = signals.into_iter().map(|(way, signal)| Ok((way, Spectrum::of(&signal, spacing)?)));
        let spectra = spectra.collect::<Result<Vec<_>>>()?;
        let Some((_, one)) = spectra.first() else { return Ok(None) };
        let (segments, spacing_hz, degrees_of_freedom) = (one.segments, one.spacing, one.degrees_of_freedom());
        let averaged_over_s = (quantity == Quantity::ContactForce).then_some(spacing);
        let place = place.to_owned();
        Ok(Some(Self { name, place, quantity, averaged_over_s, segments, spacing_hz, degrees_of_freedom, spectra }))
    }
}

/// `spectrum-` and the stem, with a number where one of `files` is called so.
fn new_name(files: &[SpectrumFile], stem: &str) -> String {
    let taken = |name: &String| files.iter().any(|file| file.name == *name);
    let plain = format!("spectrum-{stem}");
    let number = (2..).find(|number| !taken(&format!("{plain}-{number}")));
    match number {
        Some(number) if taken(&plain) => format!("{plain}-{number}"),
        _ => plain,
    }
}

/// The spectra of every probe, of every wall that is no flat of a support, and of every support,
/// over the window of the statistics.
///
/// # Errors
/// [`crate::Error::Invalid`] for a run with too few rows.
pub(super) fn of(case: &Case, run: &Run) -> Result<Vec<SpectrumFile>> {
    let (motion, scene) = (&run.trajectory, &case.scene);
    let row = run.grid.row_spacing();
    // The first row in the window, up to rounding.
    let from = run.statistics.from_s - 1e-9 * row;
    let first = motion.time().partition_point(|t| *t < from);
    let mut files: Vec<SpectrumFile> = Vec::new();
    let mut add = |place: &str, quantity: Quantity, signals: Vec<(&'static str, Vec<f64>)>, spacing: f64| {
        let name = new_name(&files, if place.is_empty() { "displacement" } else { place });
        files.extend(SpectrumFile::of(name, (place, quantity), signals, spacing)?);
        Result::Ok(())
    };
    for (probe, values) in motion.probes().iter().zip(motion.displacements()) {
        add(probe, Quantity::Displacement, vec![("", values.get(first..).unwrap_or_default().to_vec())], row)?;
    }
    // The impulse in a row is that since the row before it.
    let rows = rows_of(case.time.force_averaging, row);
    let stretch = rows as f64 * row;
    let averaged = |impulses: &[f64]| -> Vec<f64> {
        let here = impulses.get(first + 1..).unwrap_or_default();
        here.chunks_exact(rows).map(|part| part.iter().sum::<f64>() / stretch).collect()
    };
    let of_wall = |wall: usize| averaged(motion.contact_impulses().get(wall).map_or(&[], Vec::as_slice));
    // Scenes in which nothing rubs have no columns of friction.
    let friction_of = |wall: usize| averaged(motion.friction_impulses().get(wall).map_or(&[], Vec::as_slice));
    for (index, wall) in scene.walls.iter().enumerate().filter(|(index, _)| scene.support_of(*index).is_none()) {
        add(&wall.name, Quantity::ContactForce, vec![("", of_wall(index))], stretch)?;
    }
    for support in &scene.supports {
        if let Some(hole) = support.hole(&scene.walls) {
            let number = scene.holes().position(|other| other.index == hole.index);
            let Some([y, z]) = number.and_then(|number| motion.hole_impulses().get(number)) else { continue };
            add(&support.name, Quantity::ContactForce, vec![("y", averaged(y)), ("z", averaged(z))], stretch)?;
            continue;
        }
        let mut ways = [("y", Vec::new()), ("z", Vec::new())];
        for (index, wall) in support.members(&scene.walls) {
            let Face::Flat { side, direction: Some(degrees), .. } = wall.face else { continue };
            let [y, z] = heading(degrees);
            let normal = [y, z].map(|x| -side.sign() * x);
            for (force, direction) in [(of_wall(index), normal), (friction_of(index), [-z, y])] {
                for ((_, sum), share) in ways.iter_mut().zip(direction) {
                    sum.resize(sum.len().max(force.len()), 0.0);
                    sum.iter_mut().zip(&force).for_each(|(sum, f)| *sum += share * f);
                }
            }
        }
        add(&support.name, Quantity::ContactForce, ways.to_vec(), stretch)?;
    }
    Ok(files)
}

/// Writes the files of `spectra` and their figures into the folder of `results`, under the names
/// that `named` gives; `title` is that of the figures.
pub(super) fn write(
    spectra: &[SpectrumFile],
    results: &mut Results,
    title: &str,
    named: impl Fn(&str) -> String,
) -> Result<()> {
    for file in spectra {
        let Some((_, one)) = file.spectra.first() else { continue };
        let mut header = vec!["frequency_Hz".to_owned()];
        header.extend(file.spectra.iter().map(|(way, _)| file.quantity.column(way)));
        let frequencies: Vec<f64> = one.frequencies().collect();
        let mut columns = vec![frequencies.as_slice()];
        columns.extend(file.spectra.iter().map(|(_, spectrum)| spectrum.density.as_slice()));
        csv::numbers(&results.place(&named(&format!("{}.csv", file.name)))?, &header, &columns)?;
    }
    for (quantity, name, label) in [
        (Quantity::Displacement, "displacement-spectrum", "Displacement (mm²/Hz)"),
        (Quantity::ContactForce, "contact-force-spectrum", "Averaged contact force (N²/Hz)"),
    ] {
        let own: Vec<&SpectrumFile> = spectra.iter().filter(|file| file.quantity == quantity).collect();
        if let Some(svg) = figure(&own, title, label) {
            results.draw(&named(name), &svg)?;
        }
    }
    Ok(())
}

/// The figure of one quantity: a panel for each place, the first ones where there are many. `None`
/// where nothing moves.
fn figure(files: &[&SpectrumFile], title: &str, label: &str) -> Option<String> {
    let scale = |quantity: Quantity| if quantity == Quantity::Displacement { 1e6 } else { 1.0 };
    // A density of 0 has no place on a logarithmic axis.
    let points = |file: &SpectrumFile, spectrum: &Spectrum| -> Vec<(f64, f64)> {
        let all = spectrum.frequencies().zip(&spectrum.density).skip(1);
        all.filter(|(_, s)| **s > 0.0).map(|(f, s)| (f, scale(file.quantity) * s)).collect()
    };
    let moving: Vec<&&SpectrumFile> =
        files.iter().filter(|file| file.spectra.iter().any(|(_, one)| !points(file, one).is_empty())).collect();
    let title = match moving.len() {
        0 => return None,
        count if count > MOST => format!("{title}: spectra (the first {MOST} of {count})"),
        _ => format!("{title}: spectra"),
    };
    let mut figure = Figure::new(title, "Frequency (Hz)").log();
    for file in moving.into_iter().take(MOST) {
        let mut panel = Panel::new(label).log().heading(&file.place);
        for (look, (way, spectrum)) in file.spectra.iter().enumerate() {
            let way = if way.is_empty() { String::new() } else { format!("along {way}") };
            let points = points(file, spectrum);
            if !points.is_empty() {
                panel = panel.curve(Curve::new(way, points).look(look));
            }
        }
        figure = figure.panel(panel);
    }
    Some(figure.to_svg())
}
