//! The figures of one run, or of several laid over one another.

use super::figure::{Curve, Figure, Mark, Panel, Stems};
use crate::error::Result;
use crate::run::Run;
use crate::scene::{Scene, Side};
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
        let mut figures = vec![
            ("displacement.svg", self.displacement()),
            ("velocity.svg", self.velocity()),
            ("phase.svg", self.phase()),
        ];
        if !self.scene.walls.is_empty() {
            figures.push(("contact-force.svg", self.contact_force()?));
        }
        Ok(figures)
    }

    fn curve(&self, labelled: &Labelled<'_>, points: impl Iterator<Item = (f64, f64)>) -> Curve {
        let curve = Curve::new(labelled.label, points);
        if labelled.reference { curve.backdrop() } else { curve }
    }

    fn rows<'b>(&self, run: &'b Run) -> impl Iterator<Item = (f64, f64, f64)> + 'b {
        let t = &run.trajectory;
        let until = self.until;
        let rows = t.time().iter().zip(t.displacement()).zip(t.velocity()).map(|((&t, &q), &v)| (t, q, v));
        rows.take_while(move |row| row.0 <= until * (1.0 + 1e-12))
    }

    fn displacement(&self) -> String {
        let mut panel = Panel::new("Displacement (mm)");
        for labelled in self.runs {
            panel = panel.curve(self.curve(labelled, self.rows(labelled.run).map(|(t, q, _)| (t, MM * q))));
        }
        for wall in &self.scene.walls {
            panel = panel.mark(Mark::wall(MM * wall.position, wall.name.as_str()));
        }
        Figure::new(self.title, "Time (s)").panel(panel).to_svg()
    }

    fn velocity(&self) -> String {
        let mut panel = Panel::new("Velocity (mm/s)");
        for labelled in self.runs {
            panel = panel.curve(self.curve(labelled, self.rows(labelled.run).map(|(t, _, v)| (t, MM * v))));
        }
        Figure::new(self.title, "Time (s)").panel(panel).to_svg()
    }

    fn phase(&self) -> String {
        let mut panel = Panel::new("Velocity (mm/s)");
        for labelled in self.runs {
            panel = panel.curve(self.curve(labelled, self.orbit(labelled.run).into_iter()));
        }
        for wall in &self.scene.walls {
            panel = panel.mark(Mark::wall(MM * wall.position, wall.name.as_str()).upright());
        }
        Figure::new(self.title, "Displacement (mm)").panel(panel).to_svg()
    }

    /// The orbit with the corners of its rigid impacts put in, so that they are drawn at the wall and upright.
    fn orbit(&self, run: &Run) -> Vec<(f64, f64)> {
        let mut impacts = run.trajectory.contacts().iter().filter(|c| is_impact(c)).peekable();
        let mut points = Vec::new();
        for (t, q, v) in self.rows(run) {
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

    /// Finite forces as curves in N, impulses of impacts as stems in N s, each in a panel of its own where it occurs.
    fn contact_force(&self) -> Result<String> {
        let mut force = Panel::new("Contact force (N)");
        let mut impulse = Panel::new("Contact impulse (N s)");
        let (mut forces, mut impulses) = (false, false);
        for labelled in self.runs {
            let run = labelled.run;
            let seen = run.trajectory.contacts().iter().filter(|c| c.start <= self.until);
            let impacts: Vec<_> = seen.clone().filter(|c| is_impact(c)).map(|c| (c.start, c.impulse)).collect();
            if seen.clone().any(|c| !is_impact(c)) || run.trajectory.contacts().is_empty() {
                force = force.curve(self.curve(labelled, self.force_points(run)?.into_iter()));
                forces = true;
            }
            if !impacts.is_empty() {
                impulse = impulse.stems(Stems::new(labelled.label, impacts));
                impulses = true;
            }
        }
        let mut figure = Figure::new(self.title, "Time (s)");
        if forces || !impulses {
            figure = figure.panel(force);
        }
        if impulses {
            figure = figure.panel(impulse);
        }
        Ok(figure.to_svg())
    }

    /// Sum of the walls' forces at the rows, without rigid impacts, and with the peak of every contact too short for the rows to show.
    fn force_points(&self, run: &Run) -> Result<Vec<(f64, f64)>> {
        let t = &run.trajectory;
        let spacing = t.time().get(1).copied().unwrap_or(0.0);
        let mut points: Vec<(f64, f64)> = self.rows(run).map(|(time, _, _)| (time, 0.0)).collect();
        for name in t.walls() {
            for (point, f) in points.iter_mut().zip(t.contact_force(name)?) {
                point.1 += f;
            }
        }
        // An exact run knows its forces at every row; a step that met a rigid wall reports impulse/h, which is none.
        let exact = run.scheme == crate::scheme::Scheme::Event;
        let blur = if exact { 0.0 } else { 1.5 * spacing.max(2.0 * run.grid.step) };
        // A penalty's walls are springs, whatever the scene calls them.
        let springs = matches!(run.scheme, crate::scheme::Scheme::Penalty { .. });
        let rigid = |c: &Contact| !springs && self.scene.walls.get(c.wall).is_some_and(|w| w.law.is_rigid());
        for c in t.contacts().iter().filter(|c| c.start <= self.until) {
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
