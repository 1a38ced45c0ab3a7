//! The model of a case in words: structure, supports, walls and loads.

use crate::case::{Case, Model, Origin, ScatteredStart, Support, SupportShape, WallsOverBase};
use crate::output::supports::NO_SERVICE;
use crate::scene::{self, Density, Flats, LoadKind, Modes, Slider, System, Turbulence, WallSpring};
use crate::study::choice;
use crate::study::truncation::Start;

/// Most walls that are listed one by one.
pub(super) const MOST_WALLS: usize = 12;

/// Most natural frequencies that are listed.
const MOST_FREQUENCIES: usize = 12;

/// The structure as the file describes it, and its reduction; nothing for an oscillator.
pub(super) fn what(case: &Case) -> Vec<String> {
    if let (Model::Oscillator, false) = (&case.model, case.planes.is_two()) {
        return Vec::new();
    }
    let what = described(&case.model);
    let what = if case.planes.is_two() { format!("{what}, in two planes") } else { what };
    let mut lines = Vec::new();
    if let Some(truncated) = &case.truncated {
        let next = truncated.reduction.next_omega.map_or("nothing is left out".to_owned(), |omega| {
            format!("the next, left out, has {:.6} Hz", omega / std::f64::consts::TAU)
        });
        let n = truncated.reduction.degrees_of_freedom;
        let each = if case.planes.modes() > 1 { " in each plane" } else { "" };
        let modes = truncated.reduction.modes.count() / case.planes.modes();
        lines.push(format!("{what}: {n} degrees of freedom, cut to {modes} modes{each}; {next}"));
    } else {
        lines.push(format!("{what}, in full"));
    }
    lines
}

/// The natural frequencies of the structure as it is run, Hz: the slowest up to
/// [`MOST_FREQUENCIES`]; none of an oscillator, and where its modes are not found.
pub(super) fn frequencies(case: &Case) -> Vec<f64> {
    let scene = case.without_sliders();
    let System::Structure(structure) = &scene.system else { return Vec::new() };
    let modes = Modes::lowest(structure, structure.mass.size().min(MOST_FREQUENCIES));
    modes.map_or_else(|_| Vec::new(), |modes| modes.omega.iter().map(|omega| omega / std::f64::consts::TAU).collect())
}

/// These frequencies in a line; nothing where the range above has them all.
pub(super) fn frequencies_in_words(case: &Case, frequencies: &[f64]) -> Option<String> {
    let all = case.without_sliders().system.degrees_of_freedom();
    let which =
        if all > frequencies.len() { format!("the slowest {} of them", frequencies.len()) } else { "all".into() };
    let listed: Vec<String> = frequencies.iter().map(|f| choice::hertz(*f)).collect();
    (listed.len() > 1).then(|| format!("natural frequencies, {which}: {} Hz", listed.join(", ")))
}

/// A model in words.
fn described(model: &Model) -> String {
    match model {
        Model::Oscillator => "an oscillator".to_owned(),
        Model::Chain(_) => "a chain".to_owned(),
        Model::Bar(bar) => format!("a bar of {} m, {} elements", bar.length, bar.elements),
        Model::Beam(beam) => format!(
            "a {} of {} m, {} elements, EI = {:.4} N m² and {:.4} kg/m",
            if beam.section.outer_diameter().is_some() { "tube" } else { "rectangular beam" },
            beam.length,
            beam.elements,
            beam.bending_stiffness(),
            beam.mass_per_metre()
        ),
        Model::Matrices(_) => "a structure by its matrices".to_owned(),
        Model::Modal(_) => "a structure by its modes".to_owned(),
        Model::Bodies(bodies) => {
            let each = bodies.iter().map(|body| format!("{:?}, {}", body.name, described(&body.model)));
            format!("{} bodies: {}", bodies.len(), each.collect::<Vec<_>>().join("; "))
        }
    }
}

/// How many loads and fields of turbulence the file has, in words.
pub(super) fn excitation_count(case: &Case) -> String {
    let loads = choice::loads_in_words(case.loads_of_file());
    match case.turbulence().iter().filter(|field| field.is_first()).count() {
        0 => loads,
        1 => format!("{loads}; one turbulence"),
        n => format!("{loads}; {n} turbulences"),
    }
}

/// Where a random force acts that may have an independent twin in the second plane.
fn in_planes(both: bool) -> &'static str {
    if both { " along y, and an independent one along z" } else { "" }
}

/// Random loads, motions of the base, and the start, in words.
pub(super) fn excitations(case: &Case) -> Vec<String> {
    let line = |(index, origin): (usize, &Origin)| match origin {
        Origin::Random { force, file, both } => {
            let density = match (&force.density, file) {
                (_, Some(file)) => format!("of the density in {file}"),
                (Density::Flat { rms, from, to }, _) => format!("{rms} N RMS from {from} to {to} Hz"),
                (Density::Points(points), _) => format!("of a density of {} points", points.len()),
            };
            let rows = match case.scene.loads.get(index).map(|load| &load.kind) {
                Some(LoadKind::Table(table)) => table.time().len(),
                _ => 0,
            };
            Some(format!(
                "load {}: random{}, {density}, seed {}: a table of {rows} rows, the same for every step and scheme",
                index + 1,
                in_planes(*both),
                force.seed
            ))
        }
        Origin::RandomBase { force, mass } => {
            let density = match &force.density {
                Density::Flat { rms, from, to } => format!("{} m/s² RMS from {from} to {to} Hz", rms / mass),
                Density::Points(points) => format!("of a density of {} points", points.len()),
            };
            Some(format!(
                "load {}: the base moves at random, {density}, seed {}; displacements are relative to it, and walls \
                 move with it",
                index + 1,
                force.seed
            ))
        }
        Origin::Gravity(acceleration) => Some(format!("load {}: gravity of {acceleration} m/s²", index + 1)),
        Origin::Base { motion, walls } => {
            let walls = match walls {
                WallsOverBase::Moving => "displacements are relative to it, and walls move with it",
                WallsOverBase::Fixed => "walls stay where they are, and displacements are those in space",
            };
            Some(format!("load {}: the base moves {motion}; {walls}", index + 1))
        }
        Origin::Stated | Origin::Second(_) | Origin::Dashpots => None,
    };
    let mut lines: Vec<String> = case.written.origins.iter().enumerate().filter_map(line).collect();
    lines.extend(turbulence(case));
    if case.written.start == Start::Equilibrium {
        lines.push("start: at rest in static equilibrium under the constant loads".to_owned());
    }
    if let Some(ScatteredStart { scatter, .. }) = &case.written.scattered {
        let [what, unit] =
            if case.truncated.is_some() { ["modal velocities", "√kg m/s"] } else { ["velocities", "m/s"] };
        lines.push(format!("start: its {what} scatter by {:?} {unit}, seed {}", scatter.deviation, scatter.seed));
    }
    lines
}

/// Each table of turbulence, of which each field has a direction.
fn turbulence(case: &Case) -> Vec<String> {
    let fields = case.turbulence();
    let line = |field: &Turbulence| {
        let others = fields.iter().filter(|other| other.number() == field.number()).count() > 1;
        let both = in_planes(others);
        let rms = field.root_mean_squares(case.scene.duration).unwrap_or_default();
        let [least, most] =
            [rms.iter().copied().fold(f64::INFINITY, f64::min), rms.iter().copied().fold(0.0, f64::max)];
        let [[start, end], [from, to]] = [field.along, field.band];
        format!(
            "turbulence {}: a field of force{both} from {start} to {end} m, {least:.4} to {most:.4} N/m RMS from \
             {from} to {to} Hz, coherent over {} m, seed {}: a table for each mode, the same for every step and \
             scheme, and for the first modes with more of them",
            field.number(),
            field.correlation_length,
            field.seed
        )
    };
    fields.iter().filter(|field| field.is_first()).map(line).collect()
}

/// Each support, and how its flats are treated by the schemes.
pub(super) fn supports(case: &Case) -> Vec<String> {
    let masses = case.scene.wall_masses();
    let line = |(index, (support, there)): (usize, (&Support, &scene::Support))| {
        let off = match there.centre {
            [0.0, 0.0] => String::new(),
            [y, z] => format!(", its centre at ({y}, {z}) m"),
        };
        let friction = there.friction(&case.scene.walls);
        let rubs = match friction.sliding {
            0.0 if friction.acts() => format!("friction {friction}, so that its work rate is an upper figure"),
            0.0 => "without friction, so that its work rate is an upper figure".to_owned(),
            _ => format!("friction {friction}"),
        };
        let (name, place) = (&support.name, &support.place);
        let SupportShape::Flats(Flats { flats, .. }) = &support.shape else {
            if let (SupportShape::Slider, Some(Slider { normal_force, .. })) = (&support.shape, case.sliders.get(index))
            {
                let on = if case.has_places() { format!(", on {place}") } else { String::new() };
                return format!("slider {name:?}{on}: pressed by {normal_force} N, {rubs}");
            }
            let Some(hole) = there.hole(&case.scene.walls) else { return String::new() };
            let elastic = |s: WallSpring| format!("elastic, {:?} N/m and {:?} N s/m", s.stiffness, s.damping);
            let rigid = || format!("rigid, restitution {}", hole.restitution);
            let (gap, law) = (hole.gap, hole.law.spring().map_or_else(rigid, elastic));
            let feels =
                masses.get(hole.index).map_or_else(String::new, |mass| format!("; feels at least {mass:.4e} kg"));
            return format!(
                "support {name:?}, on {place}: a round hole, a gap of {gap} m all round{off}; {law}, {rubs}{feels}"
            );
        };
        let mut gaps: Vec<f64> = flats.iter().map(|flat| flat.gap).collect();
        gaps.sort_by(f64::total_cmp);
        let gap = match (gaps.first(), gaps.last()) {
            (Some(least), Some(most)) if least < most => format!("gaps of {least} to {most} m"),
            (Some(gap), _) => format!("a gap of {gap} m"),
            _ => String::new(),
        };
        let directions: Vec<String> =
            flats.iter().take(MOST_WALLS).map(|flat| format!("{}°", flat.direction)).collect();
        let more = if flats.len() > MOST_WALLS { ", .." } else { "" };
        format!(
            "support {name:?}, on {place}: {} flats towards {}{more}, {gap}{off}; each flat is a wall along its \
             normal, {rubs}",
            flats.len(),
            directions.join(", ")
        )
    };
    let mut lines: Vec<String> =
        case.written.supports.iter().zip(&case.scene.supports).enumerate().take(MOST_WALLS).map(line).collect();
    if let Some(service) = case.wear.service {
        lines.push(format!("wear: volume = coefficient x work rate x {service:e} s"));
    }
    lines.extend(case.lacks_service().then(|| format!("wear: {NO_SERVICE}")));
    lines
}

/// Each wall, its location, and the share of the structure's compliance there that a truncation
/// keeps.
pub(super) fn walls(case: &Case) -> Vec<String> {
    let line = |(index, mut line): (usize, String)| {
        if let Some(place) = case.places.get(index).filter(|_| case.has_places()) {
            line.push_str(&format!(", on {place}"));
        }
        if let Some(left) = case.truncated.as_ref().and_then(|t| t.reduction.walls.get(index)) {
            line.push_str(&format!(
                " (all modes: {:.4e} kg; kept of the static compliance: {:.2} %)",
                left.mass,
                100.0 * left.share()
            ));
        }
        line
    };
    let mut lines: Vec<String> = choice::walls(&case.without_sliders()).into_iter().map(line).collect();
    let all = lines.len();
    if all > MOST_WALLS {
        lines.truncate(MOST_WALLS);
        lines.push(format!("and {} walls more", all - MOST_WALLS));
    }
    lines
}
