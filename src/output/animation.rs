//! `animation.svg`: the last stretch of a tube's motion between its walls, as a picture that moves
//! in a browser, on a page or in a presentation; likewise of matrices and modes whose points lie
//! along a line that the case states.
//!
//! Above, the tube from the side, with its walls at their places; below, of a tube in two planes,
//! the path of its axis within each support. Deflections are magnified: a gap is a thousandth of a
//! span.

use super::colours::Places;
use super::shape::{BodyStations, Stations};
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
/// Half the width at which a wall is drawn, as a share of the length drawn.
const HALF_WALL: f64 = 0.012;
/// Corners of a circle, and half the length of a flat as a share of its gap.
const CORNERS: usize = 90;
const HALF_FLAT: f64 = 0.7;

/// The picture of a beam or of a structure on a line, or of those among several bodies, whose
/// `stations` had the displacements `moved` (m, in the order of the stations, plane by plane) at
/// the instants `time` (s); `None` for other structures and for a run of one row.
#[must_use]
pub(crate) fn animation(case: &Case, stations: &Stations, time: &[f64], moved: &[Vec<f64>]) -> Option<String> {
    let drawn: Vec<&BodyStations> = stations.bodies.iter().filter(|body| has_line(case, &body.name)).collect();
    if drawn.is_empty() {
        return None;
    }
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
    let mut caption = format!("{begin:.3} s to {end:.3} s, {shown}; deflections and gaps to one scale a view");
    let hidden = case.scene.supports.len().saturating_sub(MOST_SUPPORTS);
    if stations.planes == 2 && hidden > 0 {
        caption += &format!("; without views of the last {hidden} supports");
    }
    let undrawn = undrawn(case, &drawn);
    if !undrawn.is_empty() {
        caption += &format!("; without {}", undrawn.join(", "));
    }
    let motion = Motion { case, stations, moved };
    let side = |body: &BodyStations, plane: usize| {
        let seen = if stations.planes == 1 { "from the side" } else { ["plane y", "plane z"][plane.min(1)] };
        let name = if body.name.is_empty() { seen.to_owned() } else { format!("{}, {seen}", body.name) };
        let view = walls(case, plane, body).into_iter();
        let view = view.fold(View::new(&name, false), |view, (look, points)| view.line(look, points));
        view.moving(rows.iter().map(|&row| motion.line(body, plane, row)).collect())
    };
    let mut picture = Animation::new(case.heading(), &caption, SECONDS);
    for body in drawn {
        for plane in 0..stations.planes {
            picture = picture.row(SIDE / stations.planes as f64, vec![side(body, plane)]);
        }
    }
    if stations.planes == 2 {
        let paths = case.scene.supports.iter().zip(&case.written.supports).take(MOST_SUPPORTS);
        let paths = paths.filter_map(|(support, written)| {
            let point = |row: usize| Some((motion.at(&written.place, 0, row)?, motion.at(&written.place, 1, row)?));
            let path: Vec<(f64, f64)> = (first..time.len()).map(point).collect::<Option<_>>()?;
            let view = outlines(&case.scene, support).path(path);
            Some(view.moving(rows.iter().filter_map(|&row| Some(vec![point(row)?])).collect()))
        });
        let views: Vec<View> = paths.collect();
        if !views.is_empty() {
            picture = picture.row(SUPPORT, views);
        }
    }
    Some(picture.to_svg())
}

/// True of a beam, and of matrices and modes on a line: of the system, or of the body of that name.
fn has_line(case: &Case, body: &str) -> bool {
    let (model, name) = match body {
        "" => (Some(&case.model), None),
        name => (case.model.body(name).map(|body| &body.model), Some(name)),
    };
    matches!(model, Some(Model::Beam(_))) || case.line(name).is_some()
}

/// What is not drawn since the file does not say where its points lie, and what would draw it;
/// `None` where nothing is.
pub(crate) fn refused(case: &Case) -> Option<String> {
    let named = |name: &str, model: &Model| {
        let (of, line) = match model {
            Model::Matrices(_) if case.planes.is_two() => ("matrices", "[[0, 1, 0.0], [2, 3, 0.5], ..]"),
            Model::Matrices(_) => ("matrices", "[[0, 0.0], [1, 0.5], ..]"),
            Model::Modal(_) => ("modal", "{ POINT = 0.0, POINT = 0.5, .. }"),
            _ => return None,
        };
        let (table, name) = if name.is_empty() { ("system", None) } else { ("body", Some(name)) };
        let of_body = name.map(|name| format!(" of {name:?}")).unwrap_or_default();
        let unknown = case.line(name).is_none();
        unknown.then(|| format!("[{table}.{of}]{of_body}, expected line = {line} there"))
    };
    let found: Vec<String> = match &case.model {
        Model::Bodies(bodies) => bodies.iter().filter_map(|body| named(&body.name, &body.model)).collect(),
        model => named("", model).into_iter().collect(),
    };
    let of = found.join(", and of ");
    (!found.is_empty()).then(|| format!("{FILE}: nothing says where the points lie of {of}, positions in m"))
}

/// The names of the bodies of `case` that are none of `drawn`.
fn undrawn(case: &Case, drawn: &[&BodyStations]) -> Vec<String> {
    let Model::Bodies(bodies) = &case.model else { return Vec::new() };
    let is_drawn = |name: &str| drawn.iter().any(|body| body.name == name);
    bodies.iter().filter(|body| !is_drawn(&body.name)).map(|body| format!("{:?}", body.name)).collect()
}

/// The displacements of all stations.
struct Motion<'a> {
    case: &'a Case,
    stations: &'a Stations,
    moved: &'a [Vec<f64>],
}

impl Motion<'_> {
    /// The displacement of station `index` of a body, m.
    fn value(&self, body: &BodyStations, plane: usize, index: usize, row: usize) -> f64 {
        let column = self.moved.get(plane * self.stations.count() + body.first + index);
        column.and_then(|column| column.get(row)).copied().unwrap_or(0.0)
    }

    /// The line of a body.
    fn line(&self, body: &BodyStations, plane: usize, row: usize) -> Vec<(f64, f64)> {
        body.places.iter().enumerate().map(|(index, &x)| (x, self.value(body, plane, index, row))).collect()
    }

    /// The displacement of a place, of a relative one that of the first place less that of the
    /// other; `None` where there are no stations.
    fn at(&self, place: &Place, plane: usize, row: usize) -> Option<f64> {
        let station = |(name, x): &(Option<&str>, Option<f64>)| {
            let body = self.stations.bodies.iter().find(|body| body.name == name.unwrap_or_default())?;
            let off = |i: &usize| body.places.get(*i).map_or(f64::INFINITY, |at| (at - x.unwrap_or(0.0)).abs());
            let nearest = (0..body.places.len()).min_by(|a, b| off(a).total_cmp(&off(b)));
            (x.is_some() || body.places.len() == 1).then_some(self.value(body, plane, nearest?, row))
        };
        match self.case.ends(place).as_slice() {
            [one] => station(one),
            [one, other] => Some(station(one)? - station(other)?),
            _ => None,
        }
    }
}

/// The walls that stand beside a body in a plane (0 of y), each as a short line at its place with
/// the look of its colour; those that bound a relative motion have no place of their own.
fn walls(case: &Case, plane: usize, body: &BodyStations) -> Vec<(usize, Vec<(f64, f64)>)> {
    let (scene, colours) = (&case.scene, Places::of(&case.scene));
    let [first, last] = [body.places.first(), body.places.last()].map(|end| end.copied().unwrap_or(0.0));
    let half = HALF_WALL * (last - first);
    let mut lines = Vec::new();
    let mut add = |name: &str, place: &Place, at: f64| {
        let [(on, Some(x))] = case.ends(place)[..] else { return };
        if on.unwrap_or_default() == body.name {
            lines.push((colours.colour(name), vec![(x - half, at), (x + half, at)]));
        }
    };
    for (index, (wall, place)) in scene.walls.iter().zip(&case.places).enumerate() {
        if let (Face::Flat { position, direction: None, .. }, None) = (&wall.face, scene.support_of(index)) {
            add(&wall.name, place, *position);
        }
    }
    let supports = scene.supports.iter().zip(&case.written.supports);
    for (support, written) in supports.filter(|(_, written)| written.shape != SupportShape::Slider) {
        let Some(centre) = support.centre.get(plane) else { continue };
        let gap = support.gaps(&scene.walls).into_iter().fold(f64::INFINITY, f64::min);
        for side in [-gap, gap] {
            add(&support.name, &written.place, centre + side);
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
