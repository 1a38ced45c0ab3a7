//! The figures of one run, or of several laid over one another.
//!
//! With one degree of freedom each figure has one panel. With several, each probe has a panel, and
//! in the figure of forces each place at which walls stand. Where there are more than a page holds,
//! those with the most contact are drawn, and the title names the others.

use super::figure::{Figure, Mark, Panel};
pub use super::labelled::Labelled;
use super::motion::{Instant, motion};
use super::orbit::orbits;
use super::part::Part;
use super::places::{Chosen, WallPlace};
use super::rubbed::Rubbed;
use super::window::{Span, Window, extent};
use crate::order::sort_by_number;
use crate::run::Run;
use crate::scene::{Row, Scene, Side};
use crate::step::Contact;
use crate::study::difference::largest;
use crate::trajectory::Trajectory;

/// Millimetres per metre: the CSV is in SI units, the figures are in millimetres.
const MM: f64 = 1e3;
/// Of a contact with a spring that ends within this many rows the peak is drawn: the means of the
/// rows hide it.
pub(crate) const FEW_ROWS: f64 = 3.0;

/// A probe that moves by less than this share of the largest motion is drawn as a flat line.
const STILL: f64 = 1e-9;

/// The rows of a quantity, a list for each probe.
type Columns = fn(&Trajectory) -> &[Vec<f64>];

/// What is drawn: a title, the walls, the runs and the stretch of time.
#[derive(Debug, Clone, Copy)]
pub struct FigureSet<'a> {
    /// Title of every figure.
    pub title: &'a str,
    /// The scene, for its walls.
    pub scene: &'a Scene,
    /// The runs, in the order of the legend.
    pub runs: &'a [Labelled<'a>],
    /// The stretch of time that is drawn.
    pub span: Span,
}

impl FigureSet<'_> {
    /// The figures, each with its file name without extension: displacement, velocity, phase plot,
    /// the orbit of each place with probes NAME`-y` and NAME`-z` with the work of wear by sectors,
    /// contact force (where there are walls), force of round supports, work of wear. For a run of
    /// many periods the figures over time show the whole run and, beside it, the last periods; the
    /// phase plot shows the last periods only.
    #[must_use]
    pub fn figures(&self) -> Vec<(&'static str, String)> {
        let mut figures = Vec::new();
        let probes = self.probes();
        let window = Window::new(self.scene, self.leading(), probes.shown.first().copied(), self.span);
        if !probes.shown.is_empty() {
            let marked = |panel, probe| self.marks(probe).fold(panel, Panel::mark);
            let (q, v, shown) = (Trajectory::displacements, Trajectory::velocities, &probes);
            let displacement = self.over_time("Displacement (mm)", q, |k| k.q, shown, &window, &marked);
            let velocity = self.over_time("Velocity (mm/s)", v, |k| k.v, shown, &window, &|panel, _| panel);
            figures.extend([("displacement", displacement), ("velocity", velocity)]);
            figures.push(("phase", self.phase(&probes, &window)));
        }
        let title = |remarks: Vec<String>| self.title(remarks.into_iter().chain(window.words()));
        if let Some(orbits) = orbits(&title, self.scene, self.runs, window.detail()) {
            figures.push(("orbit", orbits));
        }
        if self.scene.walls.iter().any(|wall| !wall.is_round()) {
            figures.push(("contact-force", self.contact_force(&window)));
        }
        let title = |remarks: Vec<String>| self.title(remarks);
        let rubbed = Rubbed { scene: self.scene, runs: self.runs, window: &window, title: &title };
        figures.extend(rubbed.force().map(|figure| ("support-force", figure)));
        figures.extend(rubbed.work().map(|figure| ("wear-work", figure)));
        figures
    }

    /// The run whose contacts decide what is drawn: the reference, else the first.
    fn leading(&self) -> Option<&Run> {
        self.runs.iter().find(|r| r.reference).or(self.runs.first()).map(|r| r.run)
    }

    fn probes(&self) -> Chosen<usize> {
        Chosen::probes(self.scene, self.leading().map(|run| &run.trajectory), self.span)
    }

    /// Text for the title where probes are left out.
    fn unshown(&self, probes: &Chosen<usize>) -> Option<String> {
        let name = |&probe: &usize| self.scene.probes.get(probe).map_or_else(String::new, |p| p.name.clone());
        probes.left_out("probes", name)
    }

    /// The title, with the method where there is only one run, and with what is left out.
    fn title(&self, remarks: impl IntoIterator<Item = String>) -> String {
        let mut title = self.title.to_owned();
        if let [only] = self.runs {
            title = format!("{title}: {}", only.label);
        }
        let remarks: Vec<String> = remarks.into_iter().collect();
        if remarks.is_empty() { title } else { format!("{title} ({})", remarks.join("; ")) }
    }

    /// A panel for a probe, headed by its name where there are several.
    fn panel(&self, label: &str, probe: usize) -> Panel {
        let name = self.scene.probes.get(probe).map_or("", |p| p.name.as_str());
        let panel = Panel::new(label);
        if self.scene.probes.len() > 1 { panel.heading(name) } else { panel }
    }

    /// The walls on the probe's row; they are marked in its panel only.
    fn marks(&self, probe: usize) -> impl Iterator<Item = Mark> {
        let place: Option<&Row> = self.scene.probes.get(probe).map(|p| &p.at);
        let seen = self.scene.walls.iter().filter(move |wall| Some(wall.row()) == place);
        seen.map(|wall| Mark::wall(MM * wall.position(), wall.name.as_str()))
    }

    fn motion(&self, run: &Run, probe: usize, window: &Window) -> Vec<Instant> {
        motion(self.scene, run, probe, window.whole, window.detail(), false)
    }

    /// The panel of a probe. The smallest range that it draws as motion is a share of the largest
    /// motion of any probe in the leading run.
    fn moving(&self, label: &str, probe: usize, columns: Columns) -> Panel {
        let largest = MM * self.leading().map_or(0.0, |run| largest(columns(&run.trajectory)));
        self.panel(label, probe).still_below(STILL * largest, largest)
    }

    /// A panel over time for each probe: of what has these columns, and this value at an instant.
    fn over_time(
        &self,
        label: &str,
        columns: Columns,
        value: fn(&Instant) -> f64,
        probes: &Chosen<usize>,
        window: &Window,
        finish: &dyn Fn(Panel, usize) -> Panel,
    ) -> String {
        let mut figure = window.over_time(Figure::new(self.title(self.unshown(probes)), "Time (s)"));
        for &probe in &probes.shown {
            let mut panel = self.moving(label, probe, columns);
            for labelled in self.runs {
                let points = self.motion(labelled.run, probe, window);
                panel = panel.curve(labelled.curve(points.iter().map(|k| (k.t, MM * value(k)))).oscillating());
            }
            figure = figure.panel(finish(panel, probe));
        }
        figure.to_svg()
    }

    /// Orbits of the last periods. A rigid impact is a vertical line at the wall.
    fn phase(&self, probes: &Chosen<usize>, window: &Window) -> String {
        let remarks = self.unshown(probes).into_iter().chain(window.words());
        let mut figure = Figure::new(self.title(remarks), "Displacement (mm)");
        let leading = self.leading().map(|run| &run.trajectory);
        let still = leading.map_or((0.0, 0.0), |t| (largest(t.displacements()), largest(t.velocities())));
        let still = (STILL * MM * still.0, STILL * MM * still.1);
        for &probe in &probes.shown {
            let mut panel = self.moving("Velocity (mm/s)", probe, Trajectory::velocities);
            for labelled in self.runs {
                let shown = window.detail();
                let orbit = motion(self.scene, labelled.run, probe, shown, shown, true);
                let points: Vec<_> = orbit.iter().map(|k| (MM * k.q, MM * k.v)).collect();
                panel = panel.curve(match (stays(&points, still), points.last()) {
                    (true, Some(&end)) => labelled.curve([end]).marked(),
                    _ => labelled.curve(points),
                });
            }
            figure = figure.panel(self.marks(probe).map(Mark::upright).fold(panel, Panel::mark));
        }
        figure.to_svg()
    }

    /// For each place: finite forces as curves in N and impulses of impacts as stems in N s, in
    /// separate panels, each drawn only where it occurs.
    fn contact_force(&self, window: &Window) -> String {
        let places = Chosen::places(self.scene, self.leading().map(|run| &run.trajectory), self.span);
        let mut figure = window
            .over_time(Figure::new(self.title(places.left_out("places", |place| place.name(self.scene))), "Time (s)"));
        let headed = |label: &str, place: &WallPlace| {
            let panel = Panel::new(label);
            if places.shown.len() + places.left.len() > 1 { panel.heading(place.name(self.scene)) } else { panel }
        };
        for place in &places.shown {
            let mut force = headed("Contact force (N)", place);
            let mut impulse = headed("Contact impulse (N s)", place);
            let (mut forces, mut impulses) = (false, false);
            for labelled in self.runs {
                let all = labelled.run.trajectory.contacts();
                let none = !all.iter().any(|c| place.walls.contains(&c.wall));
                for part in Part::all(self.scene, labelled, &place.walls, self.runs.len() == 1) {
                    let seen = all.iter().filter(|c| part.walls.contains(&c.wall) && self.shows(c));
                    let impacts: Vec<_> = seen.clone().filter(|c| is_impact(c)).map(|c| (c.start, c.impulse)).collect();
                    if none || seen.clone().any(|c| !is_impact(c)) {
                        force = force.curve(part.curve(self.force_points(labelled.run, &part.walls)));
                        forces = true;
                    }
                    if !impacts.is_empty() {
                        impulse = impulse.stems(part.curve(impacts));
                        impulses = true;
                    }
                }
            }
            if forces || !impulses {
                figure = figure.panel(force);
            }
            if impulses {
                figure = figure.panel(impulse);
            }
        }
        figure.to_svg()
    }

    /// True for a contact that overlaps the stretch drawn.
    fn shows(&self, contact: &Contact) -> bool {
        contact.start <= self.span.to && contact.end.is_none_or(|end| end >= self.span.from)
    }

    /// Sum of the mean forces of `walls` in the rows, without rigid impacts, plus the peak of each
    /// contact too short for the rows to show.
    fn force_points(&self, run: &Run, walls: &[usize]) -> Vec<(f64, f64)> {
        let t = &run.trajectory;
        let spacing = t.time().get(1).copied().unwrap_or(0.0);
        let mut points: Vec<(f64, f64)> = t.time().iter().map(|&time| (time, 0.0)).collect();
        for column in walls.iter().filter_map(|&wall| t.contact_forces().get(wall)) {
            for (point, f) in points.iter_mut().zip(column) {
                point.1 += f;
            }
        }
        points.retain(|point| self.span.holds(point.0));
        // The mean force of a row with an impact would dwarf the others: an exact impact is in the
        // row whose interval holds it, one on a grid in a row nearby.
        let exact = run.scheme.is_exact();
        let reach = if exact { 0.5 * spacing } else { 1.5 * spacing.max(2.0 * run.grid.step) };
        let middle = |start: f64| if exact { start + reach } else { start };
        // In a penalty run the walls are springs, also those that the scene calls rigid.
        let springs = matches!(run.scheme, crate::scheme::Scheme::Penalty { .. });
        let rigid = |c: &Contact| !springs && self.scene.walls.get(c.wall).is_some_and(|w| w.law.is_rigid());
        let here = |c: &&Contact| walls.contains(&c.wall) && self.shows(c);
        let mut peaks = Vec::new();
        for c in t.contacts().iter().filter(here) {
            let end = c.end.unwrap_or(self.span.to);
            let sign = self.scene.walls.get(c.wall).map_or(0.0, |w| if w.side() == Side::Upper { -1.0 } else { 1.0 });
            match c.peak_force {
                None => near(&mut points, middle(c.start), reach).for_each(|point| point.1 = 0.0),
                Some(peak) if rigid(c) => near(&mut points, middle(c.start), reach)
                    .filter(|point| point.1.abs() > peak)
                    .for_each(|point| point.1 = 0.0),
                Some(peak) if end - c.start < FEW_ROWS * spacing => {
                    peaks.extend([(c.start, 0.0), (0.5 * (c.start + end), sign * peak), (end, 0.0)]);
                }
                Some(_) => {}
            }
        }
        points.extend(peaks);
        sort_by_number(&mut points, |a| a.0);
        points
    }
}

/// An instantaneous impact on a rigid wall: its force is not finite.
fn is_impact(contact: &Contact) -> bool {
    contact.peak_force.is_none()
}

/// Those of `points`, sorted by time, that lie at most `distance` from `time`: found by bisection,
/// since a long run has as many contacts as rows.
fn near(points: &mut [(f64, f64)], time: f64, distance: f64) -> impl Iterator<Item = &mut (f64, f64)> {
    // Twice the distance, so that the rounding of a bound leaves none out.
    let from = points.partition_point(|point| point.0 < time - 2.0 * distance);
    let upto = points.partition_point(|point| point.0 <= time + 2.0 * distance);
    let found = points.get_mut(from..upto).unwrap_or_default();
    found.iter_mut().filter(move |point| (point.0 - time).abs() <= distance)
}

/// True if an orbit moves by less than `limit` in displacement and velocity: it would be drawn as a
/// point, which a line does not show.
fn stays(orbit: &[(f64, f64)], limit: (f64, f64)) -> bool {
    let range = |of: fn(&(f64, f64)) -> f64| {
        let (low, high) = extent(orbit.iter().map(of));
        high - low
    };
    range(|point| point.0) <= limit.0 && range(|point| point.1) <= limit.1
}

#[cfg(test)]
mod tests {
    use super::near;

    #[test]
    fn points_near_an_instant_are_those_that_every_point_looked_at_would_give() {
        let rows: Vec<(f64, f64)> = (0..500).map(|k| (1e-3 * f64::from(k / 2), 1.0)).collect();
        for (time, distance) in [(0.0, 3e-3), (0.1, 3e-3), (0.1, 0.0), (0.10005, 1.5e-3), (0.2495, 1.0), (9.0, 1e-3)] {
            let mut found = rows.clone();
            near(&mut found, time, distance).for_each(|point| point.1 = 0.0);
            let expected = rows.iter().map(|p| (p.0, if (p.0 - time).abs() <= distance { 0.0 } else { 1.0 }));
            assert!(found.into_iter().eq(expected), "{time} ± {distance}");
        }
    }
}
