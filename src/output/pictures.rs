//! The figures of one run, or of several laid over one another.
//!
//! One degree of freedom has one panel a figure. Of several, each probe has its panel, and in the figure of forces each place at which
//! walls stand; where there are more than a page holds, those with the most contact are drawn, and the title says of how many.

use super::figure::{Curve, Figure, Mark, Panel, Stems};
use super::places::{Chosen, Place};
use crate::error::Result;
use crate::run::Run;
use crate::scene::{Row, Scene, Side};
use crate::step::Contact;

/// Rows of the CSV are SI; figures of vibrations read better in millimetres.
const MM: f64 = 1e3;

/// A run with the label its curves carry.
#[derive(Debug, Clone, Copy)]
pub struct Labelled<'a> {
    /// What the legend says.
    pub label: &'a str,
    /// The run.
    pub run: &'a Run,
    /// True for the reference, drawn wide and pale beneath the others.
    pub reference: bool,
}

/// What is drawn: a title, the walls, the runs and how much of their time.
#[derive(Debug, Clone, Copy)]
pub struct Sheet<'a> {
    /// Title of every figure.
    pub title: &'a str,
    /// The scene, for its walls.
    pub scene: &'a Scene,
    /// The runs, in the order of the legend.
    pub runs: &'a [Labelled<'a>],
    /// Time up to which curves are drawn, s.
    pub until: f64,
}

impl Sheet<'_> {
    /// The four figures by file name: displacement, velocity, phase plot, contact force (the last only where there are walls).
    ///
    /// # Errors
    /// None beyond those of a trajectory asked for its own walls.
    pub fn figures(&self) -> Result<Vec<(&'static str, String)>> {
        let mut figures = Vec::new();
        let probes = self.probes();
        if !probes.shown.is_empty() {
            figures.push(("displacement.svg", self.displacement(&probes)));
            figures.push(("velocity.svg", self.velocity(&probes)));
            figures.push(("phase.svg", self.phase(&probes)));
        }
        if !self.scene.walls.is_empty() {
            figures.push(("contact-force.svg", self.contact_force()?));
        }
        Ok(figures)
    }

    /// The run whose contacts decide what is drawn: the reference, else the first.
    fn leading(&self) -> Option<&Run> {
        self.runs.iter().find(|r| r.reference).or(self.runs.first()).map(|r| r.run)
    }

    fn probes(&self) -> Chosen<usize> {
        Chosen::probes(self.scene, self.leading().map(|run| &run.trajectory), self.until)
    }

    fn title(&self, left_out: Option<String>) -> String {
        left_out.map_or_else(|| self.title.to_owned(), |what| format!("{} ({what})", self.title))
    }

    /// A panel for a probe: with its name, where there are several.
    fn panel(&self, label: &str, probe: usize) -> Panel {
        let name = self.scene.probes.get(probe).map_or("", |p| p.name.as_str());
        let panel = Panel::new(label);
        if self.scene.probes.len() > 1 { panel.heading(name) } else { panel }
    }

    /// The walls that stand where the probe looks: its panel alone shows them.
    fn marks(&self, probe: usize) -> impl Iterator<Item = Mark> {
        let place: Option<&Row> = self.scene.probes.get(probe).map(|p| &p.at);
        let seen = self.scene.walls.iter().filter(move |wall| Some(&wall.at) == place);
        seen.map(|wall| Mark::wall(MM * wall.position, wall.name.as_str()))
    }

    fn curve(&self, labelled: &Labelled<'_>, points: impl Iterator<Item = (f64, f64)>) -> Curve {
        let curve = Curve::new(labelled.label, points);
        if labelled.reference { curve.backdrop() } else { curve }
    }

    fn rows<'b>(&self, run: &'b Run, probe: usize) -> impl Iterator<Item = (f64, f64, f64)> + 'b {
        let t = &run.trajectory;
        let until = self.until;
        let displacement = t.displacements().get(probe).into_iter().flatten();
        let velocity = t.velocities().get(probe).into_iter().flatten();
        let rows = t.time().iter().zip(displacement).zip(velocity).map(|((&t, &q), &v)| (t, q, v));
        rows.take_while(move |row| row.0 <= until * (1.0 + 1e-12))
    }

    fn displacement(&self, probes: &Chosen<usize>) -> String {
        let mut figure = Figure::new(self.title(probes.left_out("probes")), "Time (s)");
        for &probe in &probes.shown {
            let mut panel = self.panel("Displacement (mm)", probe);
            for labelled in self.runs {
                let rows = self.rows(labelled.run, probe);
                panel = panel.curve(self.curve(labelled, rows.map(|(t, q, _)| (t, MM * q))));
            }
            figure = figure.panel(self.marks(probe).fold(panel, Panel::mark));
        }
        figure.to_svg()
    }

    fn velocity(&self, probes: &Chosen<usize>) -> String {
        let mut figure = Figure::new(self.title(probes.left_out("probes")), "Time (s)");
        for &probe in &probes.shown {
            let mut panel = self.panel("Velocity (mm/s)", probe);
            for labelled in self.runs {
                let rows = self.rows(labelled.run, probe);
                panel = panel.curve(self.curve(labelled, rows.map(|(t, _, v)| (t, MM * v))));
            }
            figure = figure.panel(panel);
        }
        figure.to_svg()
    }

    fn phase(&self, probes: &Chosen<usize>) -> String {
        let mut figure = Figure::new(self.title(probes.left_out("probes")), "Displacement (mm)");
        for &probe in &probes.shown {
            let mut panel = self.panel("Velocity (mm/s)", probe);
            for labelled in self.runs {
                panel = panel.curve(self.curve(labelled, self.orbit(labelled.run, probe).into_iter()));
            }
            figure = figure.panel(self.marks(probe).map(Mark::upright).fold(panel, Panel::mark));
        }
        figure.to_svg()
    }

    /// The orbit with the corners of its rigid impacts put in, so that they are drawn at the wall and upright.
    fn orbit(&self, run: &Run, probe: usize) -> Vec<(f64, f64)> {
        let place = self.scene.probes.get(probe).map(|p| &p.at);
        let seen = |c: &&Contact| self.scene.walls.get(c.wall).map(|w| &w.at) == place;
        let mut impacts = run.trajectory.contacts().iter().filter(|c| is_impact(c)).filter(seen).peekable();
        let mut points = Vec::new();
        for (t, q, v) in self.rows(run, probe) {
            while let Some(c) = impacts.next_if(|c| c.start <= t) {
                if let (Some(wall), Some(departure)) = (self.scene.walls.get(c.wall), c.departure_speed) {
                    let sign = wall.side.sign();
                    points.push((MM * wall.position, -MM * sign * c.approach_speed));
                    points.push((MM * wall.position, MM * sign * departure));
                }
            }
            points.push((MM * q, MM * v));
        }
        points
    }

    /// Of each place, finite forces as curves in N, impulses of impacts as stems in N s, each in a panel of its own where it occurs.
    fn contact_force(&self) -> Result<String> {
        let places = Chosen::places(self.scene, self.leading().map(|run| &run.trajectory), self.until);
        let mut figure = Figure::new(self.title(places.left_out("places")), "Time (s)");
        let headed = |label: &str, place: &Place| {
            let panel = Panel::new(label);
            if places.count > 1 { panel.heading(place.name(self.scene)) } else { panel }
        };
        for place in &places.shown {
            let mut force = headed("Contact force (N)", place);
            let mut impulse = headed("Contact impulse (N s)", place);
            let (mut forces, mut impulses) = (false, false);
            for labelled in self.runs {
                let run = labelled.run;
                let here = run.trajectory.contacts().iter().filter(|c| place.walls.contains(&c.wall));
                let none = here.clone().next().is_none();
                let seen = here.filter(|c| c.start <= self.until);
                let impacts: Vec<_> = seen.clone().filter(|c| is_impact(c)).map(|c| (c.start, c.impulse)).collect();
                if seen.clone().any(|c| !is_impact(c)) || none {
                    force = force.curve(self.curve(labelled, self.force_points(run, place)?.into_iter()));
                    forces = true;
                }
                if !impacts.is_empty() {
                    impulse = impulse.stems(Stems::new(labelled.label, impacts));
                    impulses = true;
                }
            }
            if forces || !impulses {
                figure = figure.panel(force);
            }
            if impulses {
                figure = figure.panel(impulse);
            }
        }
        Ok(figure.to_svg())
    }

    /// Sum of the forces of a place's walls at the rows, without rigid impacts, and with the peak of every contact too short for the rows to show.
    fn force_points(&self, run: &Run, place: &Place) -> Result<Vec<(f64, f64)>> {
        let t = &run.trajectory;
        let spacing = t.time().get(1).copied().unwrap_or(0.0);
        let rows = t.time().iter().take_while(|time| **time <= self.until * (1.0 + 1e-12));
        let mut points: Vec<(f64, f64)> = rows.map(|&time| (time, 0.0)).collect();
        for column in place.walls.iter().filter_map(|&wall| t.contact_forces().get(wall)) {
            for (point, f) in points.iter_mut().zip(column) {
                point.1 += f;
            }
        }
        // An exact run knows its forces at every row; a step that met a rigid wall reports impulse/h, which is none.
        let exact = run.scheme == crate::scheme::Scheme::Event;
        let blur = if exact { 0.0 } else { 1.5 * spacing.max(2.0 * run.grid.step) };
        // A penalty's walls are springs, whatever the scene calls them.
        let springs = matches!(run.scheme, crate::scheme::Scheme::Penalty { .. });
        let rigid = |c: &Contact| !springs && self.scene.walls.get(c.wall).is_some_and(|w| w.law.is_rigid());
        let here = |c: &&Contact| place.walls.contains(&c.wall) && c.start <= self.until;
        for c in t.contacts().iter().filter(here) {
            let end = c.end.unwrap_or(self.until);
            let sign = self.scene.walls.get(c.wall).map_or(0.0, |w| if w.side == Side::Upper { -1.0 } else { 1.0 });
            let Some(peak) = c.peak_force else {
                let near = |point: &&mut (f64, f64)| (point.0 - c.start).abs() <= blur;
                points.iter_mut().filter(near).for_each(|point| point.1 = 0.0);
                continue;
            };
            if rigid(c) {
                let start = |point: &&mut (f64, f64)| (point.0 - c.start).abs() <= blur && point.1.abs() > peak;
                points.iter_mut().filter(start).for_each(|point| point.1 = 0.0);
            } else if end - c.start < 3.0 * spacing {
                points.extend([(c.start, 0.0), (0.5 * (c.start + end), sign * peak), (end, 0.0)]);
            }
        }
        points.sort_by(|a, b| a.0.total_cmp(&b.0));
        Ok(points)
    }
}

/// An instantaneous impact on a rigid wall: its force is not finite.
fn is_impact(contact: &Contact) -> bool {
    contact.peak_force.is_none()
}
