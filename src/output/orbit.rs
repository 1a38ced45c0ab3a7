//! The orbit of a station that moves in two planes, between the flats around it or in its hole,
//! with the work of wear by sectors.

use super::colours::Places;
use super::figure::{Figure, Panel};
use super::labelled::Labelled;
use super::ring::Ring;
use super::window::{Span, extent};
use crate::scene::{Row, Scene};
use crate::trajectory::Trajectory;

/// Millimetres per metre.
const MM: f64 = 1e3;
/// Most orbits in one figure.
const MOST: usize = 4;
/// Room around an orbit, as a share of its size.
const ROOM: f64 = 0.08;
/// A wall whose row differs from a combination of the station's two rows by more than this share is
/// not at the station.
const ELSEWHERE: f64 = 1e-9;

/// A station along the structure: its displacements along y and z are both recorded.
struct Station {
    name: String,
    /// Indices of its probes.
    probes: [usize; 2],
    flats: Vec<Flat>,
    rings: Vec<Ring>,
}

/// A wall seen from the station: the motion stays where a y + b z ≤ c.
struct Flat {
    a: f64,
    b: f64,
    c: f64,
}

/// The figure of all stations that have a probe NAME-y and a probe NAME-z, those with the most
/// walls first; `None` where there is none. `title` makes the title with what is left out.
pub(super) fn orbits(
    title: &dyn Fn(Vec<String>) -> String,
    scene: &Scene,
    runs: &[Labelled<'_>],
    span: Span,
) -> Option<String> {
    let mut stations = stations(scene);
    stations.sort_by_key(|station| std::cmp::Reverse((station.rings.len(), station.flats.len())));
    let count = stations.len();
    stations.truncate(MOST);
    // Frames one below the other have one horizontal axis: the same ranges for all.
    let mut half = 0.0_f64;
    let views: Vec<(Station, [f64; 2])> = stations
        .into_iter()
        .filter_map(|station| {
            let (centre, size) = view(&station, runs, span)?;
            half = half.max(size);
            Some((station, centre))
        })
        .collect();
    views.first()?;
    let whole = (1.0 + ROOM) * half;
    // The horizontal range holds every station.
    let (low, high) = extent(views.iter().map(|(_, centre)| centre[0]));
    let (middle, whole) = (0.5 * (low + high), whole + 0.5 * (high - low));
    let left_out = (views.len() < count).then(|| format!("{} of {count} places", views.len()));
    let rings = views.iter().flat_map(|(station, _)| &station.rings).filter_map(|ring| ring.largest(runs));
    let ring = rings.map(|(_, upper)| upper).reduce(|a, b| a || b).map(|upper| {
        let upper = if upper { ", without friction an upper figure" } else { "" };
        format!("ring: work rate by sector{upper}")
    });
    let remarks = left_out.into_iter().chain(ring).collect();
    let mut figure = Figure::new(title(remarks), "Displacement along y (mm)").square();
    figure = figure.range(MM * (middle - whole), MM * (middle + whole));
    let places = Places::of(scene);
    for (station, centre) in views {
        let mut panel = Panel::new("Displacement along z (mm)").heading(heading(&station, runs));
        panel = panel.range(MM * (centre[1] - whole), MM * (centre[1] + whole));
        for labelled in runs {
            let points = points(&station, &labelled.run.trajectory, span).map(|[y, z]| (MM * y, MM * z));
            panel = panel.curve(labelled.curve(points));
        }
        if let Some(ring) = station.rings.first() {
            panel = panel.colour(places.colour(ring.name(scene)));
        }
        for edge in edges(&station.flats, [middle, centre[1]], whole) {
            panel = panel.outline(edge.map(|[y, z]| (MM * y, MM * z)));
        }
        for ring in &station.rings {
            panel = ring.circle().into_iter().fold(panel, |panel, circle| panel.outline(in_mm(circle)));
            panel = ring.areas(runs).into_iter().fold(panel, |panel, area| panel.area(in_mm(area)));
        }
        figure = figure.panel(panel);
    }
    Some(figure.to_svg())
}

fn in_mm(points: Vec<[f64; 2]>) -> impl Iterator<Item = (f64, f64)> {
    points.into_iter().map(|[y, z]| (MM * y, MM * z))
}

/// The name of the station, and the work rate that the highest part of its ring stands for.
fn heading(station: &Station, runs: &[Labelled<'_>]) -> String {
    match station.rings.iter().find_map(|ring| ring.largest(runs)) {
        Some((most, _)) => format!("{}: up to {most:.2e} W a sector", station.name),
        None => station.name.clone(),
    }
}

/// Every station with a probe along y and one along z.
fn stations(scene: &Scene) -> Vec<Station> {
    let along = |name: &str| scene.probes.iter().position(|probe| probe.name == name);
    let station = |(index, probe): (usize, &crate::scene::Probe)| {
        let name = probe.name.strip_suffix("-y")?;
        let other = along(&format!("{name}-z"))?;
        let rows = [&probe.at, &scene.probes.get(other)?.at];
        let flats = scene.walls.iter().filter_map(|wall| {
            let [a, b] = seen(wall.row(), rows)?;
            let sign = -wall.side().sign();
            Some(Flat { a: sign * a, b: sign * b, c: sign * wall.position() })
        });
        let rings = Ring::around(scene, [probe, scene.probes.get(other)?]);
        Some(Station { name: name.to_owned(), probes: [index, other], flats: flats.collect(), rings })
    };
    scene.probes.iter().enumerate().filter_map(station).collect()
}

/// The weights with which `row` is a sum of the two rows of a station, which share no degree of
/// freedom; `None` for a row elsewhere.
fn seen(row: &Row, rows: [&Row; 2]) -> Option<[f64; 2]> {
    let size =
        row.entries().iter().map(|entry| entry.0 + 1).chain(rows.iter().flat_map(|row| row.entries()).map(|e| e.0 + 1));
    let mut dense = vec![0.0; size.max().unwrap_or(0)];
    row.entries().iter().for_each(|&(i, weight)| dense[i] += weight);
    let square = |of: &Row| of.entries().iter().map(|(_, weight)| weight * weight).sum::<f64>();
    let whole = square(row);
    let weights = rows.map(|of| of.dot(&dense) / square(of));
    for (of, weight) in rows.into_iter().zip(weights) {
        of.entries().iter().for_each(|&(i, x)| dense[i] -= weight * x);
    }
    let left: f64 = dense.iter().map(|x| x * x).sum();
    (left <= ELSEWHERE * whole && weights.iter().all(|weight| weight.is_finite())).then_some(weights)
}

fn points<'a>(station: &Station, motion: &'a Trajectory, span: Span) -> impl Iterator<Item = [f64; 2]> + 'a {
    let [y, z] = station.probes.map(|probe| motion.displacements().get(probe).into_iter().flatten());
    let rows = motion.time().iter().zip(y.zip(z));
    rows.filter(move |(t, _)| span.holds(**t)).map(|(_, (&y, &z))| [y, z])
}

/// The middle of the motion and of the nearest points of the flats, and half the side of the square
/// that holds them, m.
fn view(station: &Station, runs: &[Labelled<'_>], span: Span) -> Option<([f64; 2], f64)> {
    let mut ends = [[f64::INFINITY, f64::NEG_INFINITY]; 2];
    let include = |ends: &mut [[f64; 2]; 2], point: [f64; 2]| {
        for (end, x) in ends.iter_mut().zip(point).filter(|(_, x)| x.is_finite()) {
            *end = [end[0].min(x), end[1].max(x)];
        }
    };
    let moved = runs.iter().flat_map(|run| points(station, &run.run.trajectory, span));
    moved.for_each(|point| include(&mut ends, point));
    let middle = ends.map(|[low, high]| 0.5 * (low + high));
    for Flat { a, b, c } in &station.flats {
        let beyond = (c - a * middle[0] - b * middle[1]) / (a * a + b * b);
        include(&mut ends, [middle[0] + beyond * a, middle[1] + beyond * b]);
    }
    let rings = station.rings.iter().filter_map(|ring| ring.reach(runs)).flatten();
    rings.for_each(|point| include(&mut ends, point));
    let half = ends.iter().map(|[low, high]| 0.5 * (high - low)).fold(0.0, f64::max);
    (half > 0.0 && half.is_finite()).then(|| (ends.map(|[low, high]| 0.5 * (low + high)), half))
}

/// The part of each flat that bounds the motion, within a square around `centre`.
fn edges(flats: &[Flat], centre: [f64; 2], half: f64) -> Vec<[[f64; 2]; 2]> {
    // The frame cuts off what lies beyond it.
    let reach = 4.0 * half;
    let cut = |(index, flat): (usize, &Flat)| {
        let square = flat.a * flat.a + flat.b * flat.b;
        let beyond = (flat.c - flat.a * centre[0] - flat.b * centre[1]) / square;
        let foot = [centre[0] + beyond * flat.a, centre[1] + beyond * flat.b];
        let length = square.sqrt();
        let along = [-flat.b / length, flat.a / length];
        let (mut from, mut to) = (-reach, reach);
        for (_, other) in flats.iter().enumerate().filter(|(i, _)| *i != index) {
            // other.a y + other.b z ≤ other.c at foot + t along.
            let rate = other.a * along[0] + other.b * along[1];
            let room = other.c - other.a * foot[0] - other.b * foot[1];
            if rate > 0.0 {
                to = to.min(room / rate);
            } else if rate < 0.0 {
                from = from.max(room / rate);
            } else if room < 0.0 {
                return None;
            }
        }
        let at = |t: f64| [foot[0] + t * along[0], foot[1] + t * along[1]];
        (from < to).then(|| [at(from), at(to)])
    };
    flats.iter().enumerate().filter_map(cut).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Flats, PlaneRows, Probe, WallLaw};

    #[test]
    fn the_edges_of_a_square_hole_meet_at_its_corners() {
        let at = PlaneRows::doubled(&Row::new(vec![(0, 0.5), (1, 2.0)]), 3);
        let flats = [20.0, 110.0, 200.0, 290.0].map(|direction| crate::scene::Flat { direction, gap: 1e-3 }).to_vec();
        let law = WallLaw::Rigid { restitution: 1.0 };
        let support = Flats { name: "s".to_owned(), at, flats, centre: [2e-3, 0.0], law, friction: 0.0.into() };
        let mut scene = Scene::oscillator(1.0, 0.0, 1.0);
        scene.walls = support.walls().unwrap();
        scene.probes = vec![
            Probe { name: "s-y".to_owned(), at: support.at.y.clone() },
            Probe { name: "s-z".to_owned(), at: support.at.z.clone() },
            Probe { name: "else-y".to_owned(), at: Row::dof(2) },
        ];
        let [station] = <[Station; 1]>::try_from(stations(&scene)).ok().unwrap();
        assert_eq!((station.probes, station.flats.len()), ([0, 1], 4));
        for edge in edges(&station.flats, [2e-3, 0.0], 2e-3) {
            for [y, z] in edge {
                // A corner is √2 gaps from the centre, to some roundings.
                assert!(((y - 2e-3).hypot(z) / 1e-3 - 2.0_f64.sqrt()).abs() < 1e-12, "{y} {z}");
            }
        }
        // One flat alone is a line through the frame.
        let [one] = <[_; 1]>::try_from(edges(&station.flats[..1], [2e-3, 0.0], 2e-3)).unwrap();
        assert!((one[0][0] - one[1][0]).hypot(one[0][1] - one[1][1]) > 1.5e-2);
    }
}
