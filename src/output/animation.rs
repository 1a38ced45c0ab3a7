//! `animation.svg`: the last stretch of a tube's motion between its walls, as a picture that moves
//! in a browser, on a page or in a presentation.
//!
//! Above, the tube from the side, with its walls at their places; below, of a tube in two planes,
//! the path of its axis within each support. Deflections are magnified: a gap is a thousandth of a
//! span.

use super::colours::Places;
use super::shape::Stations;
use crate::case::{Case, Model, Place, SupportShape};
use crate::scene::{Face, Scene, Support};
use signorini_figure::{Animation, View};
use std::f64::consts::TAU;

/// The file's name.
pub const FILE: &str = "animation.svg";

/// Periods of the slowest natural frequency that are shown, and the time that they take, s.
const PERIODS: f64 = 8.0;
const SECONDS: f64 = 10.0;
/// Most frames, and most supports that have a view.
const MOST_FRAMES: usize = 240;
const MOST_SUPPORTS: usize = 4;
/// Heights of the views.
const SIDE: f64 = 150.0;
const SUPPORT: f64 = 140.0;
/// Half the width at which a wall is drawn, as a share of the tube's length.
const HALF_WALL: f64 = 0.012;
/// Corners of a circle, and half the length of a flat as a share of its gap.
const CORNERS: usize = 90;
const HALF_FLAT: f64 = 0.7;

/// The picture of a beam whose `stations` had the displacements `moved` (m, in the order of the
/// stations, plane by plane) at the instants `time` (s); `None` for another structure and for a run
/// of one row.
#[must_use]
pub(crate) fn animation(case: &Case, stations: &Stations, time: &[f64], moved: &[Vec<f64>]) -> Option<String> {
    let Model::Beam(beam) = &case.model else { return None };
    let [slowest, _] = case.scene.system.frequencies();
    let end = *time.last()?;
    let first = time.iter().position(|&t| t >= end - PERIODS * TAU / slowest)?;
    let every = (time.len() - first).div_ceil(MOST_FRAMES);
    let rows: Vec<usize> = (first..time.len()).step_by(every).collect();
    let begin = *time.get(first)?;
    if end <= begin {
        return None;
    }
    let slowed = SECONDS / (end - begin);
    let shown = if slowed < 1.0 { format!("in {SECONDS} s") } else { format!("slowed down {slowed:.1} times") };
    let mut caption = format!("{begin:.3} s to {end:.3} s, {shown}; deflections and gaps magnified alike");
    let hidden = case.scene.supports.len().saturating_sub(MOST_SUPPORTS);
    if stations.planes == 2 && hidden > 0 {
        caption += &format!("; without views of the last {hidden} supports");
    }
    let count = stations.places.len();
    let planes: Vec<&[Vec<f64>]> = moved.chunks(count).take(stations.planes).collect();
    let side = |(plane, columns): (usize, &&[Vec<f64>])| {
        let name = if planes.len() == 1 { "from the side" } else { ["plane y", "plane z"][plane.min(1)] };
        let frame = |&row: &usize| {
            stations.places.iter().zip(columns.iter()).map(|(&x, column)| (x, value(column, row))).collect()
        };
        let view = walls(case, plane, beam.length).into_iter();
        let view = view.fold(View::new(name, false), |view, (look, points)| view.line(look, points));
        view.moving(rows.iter().map(frame).collect())
    };
    let mut picture = Animation::new(case.title.as_deref().unwrap_or(&case.name), &caption, SECONDS);
    for plane in planes.iter().enumerate() {
        picture = picture.row(SIDE / planes.len() as f64, vec![side(plane)]);
    }
    if let [y, z] = planes[..] {
        let paths = case.scene.supports.iter().zip(&case.written.supports).take(MOST_SUPPORTS);
        let paths = paths.filter_map(|(support, written)| {
            let at = station(stations, &written.place)?;
            let (y, z) = (y.get(at)?, z.get(at)?);
            let point = |row: usize| (value(y, row), value(z, row));
            let view = outlines(&case.scene, support).path((first..time.len()).map(point).collect());
            Some(view.moving(rows.iter().map(|&row| vec![point(row)]).collect()))
        });
        let views: Vec<View> = paths.collect();
        if !views.is_empty() {
            picture = picture.row(SUPPORT, views);
        }
    }
    Some(picture.to_svg())
}

fn value(column: &[f64], row: usize) -> f64 {
    column.get(row).copied().unwrap_or(0.0)
}

/// The index of the station at a place, if it is one along the structure.
fn station(stations: &Stations, place: &Place) -> Option<usize> {
    let x = place.position()?;
    let off = |i: &usize| stations.places.get(*i).map_or(f64::INFINITY, |at| (at - x).abs());
    (0..stations.places.len()).min_by(|a, b| off(a).total_cmp(&off(b)))
}

/// The walls in a plane (0 of y), each as a short line at its place with the look of its colour.
fn walls(case: &Case, plane: usize, length: f64) -> Vec<(usize, Vec<(f64, f64)>)> {
    let (scene, colours) = (&case.scene, Places::of(&case.scene));
    let mut lines = Vec::new();
    let mut add = |name: &str, x: Option<f64>, at: f64| {
        let Some(x) = x else { return };
        let half = HALF_WALL * length;
        lines.push((colours.colour(name), vec![(x - half, at), (x + half, at)]));
    };
    for (index, (wall, place)) in scene.walls.iter().zip(&case.places).enumerate() {
        if let (Face::Flat { position, direction: None, .. }, None) = (&wall.face, scene.support_of(index)) {
            add(&wall.name, place.position(), *position);
        }
    }
    let supports = scene.supports.iter().zip(&case.written.supports);
    for (support, written) in supports.filter(|(_, written)| written.shape != SupportShape::Slider) {
        let Some(centre) = support.centre.get(plane) else { continue };
        let gap = support.gaps(&scene.walls).into_iter().fold(f64::INFINITY, f64::min);
        for side in [-gap, gap] {
            add(&support.name, written.place.position(), centre + side);
        }
    }
    lines
}

/// The view of a support: the circle of a round wall, and of a flat the line before which the axis
/// stays.
fn outlines(scene: &Scene, support: &Support) -> View {
    let look = Places::of(scene).colour(&support.name);
    let [y, z] = support.centre;
    let lines = support.members(&scene.walls).zip(support.gaps(&scene.walls)).map(|((_, wall), gap)| {
        let point = |degrees: f64, along: f64| {
            let (sin, cos) = degrees.to_radians().sin_cos();
            (y + gap * cos - along * sin, z + gap * sin + along * cos)
        };
        match wall.face {
            Face::Round { .. } => (0..=CORNERS).map(|k| point(360.0 * k as f64 / CORNERS as f64, 0.0)).collect(),
            Face::Flat { direction, .. } => {
                [-HALF_FLAT, HALF_FLAT].map(|half| point(direction.unwrap_or(0.0), half * gap)).to_vec()
            }
        }
    });
    lines.fold(View::new(&support.name, true), |view, line| view.line(look, line))
}
