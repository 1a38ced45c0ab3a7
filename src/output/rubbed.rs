//! Figures of supports over time: the force of round supports, and the work of wear.

use super::colours::Places;
use super::figure::{Curve, Figure, Panel};
use super::labelled::Labelled;
use super::places::Chosen;
use super::window::Window;
use crate::scene::Scene;
use crate::trajectory::Trajectory;

/// Most supports in one figure.
const MOST: usize = 4;

/// A quantity over time.
type Points = Vec<(f64, f64)>;

/// What is drawn: the supports of a scene in several runs.
pub(super) struct Rubbed<'a> {
    pub scene: &'a Scene,
    pub runs: &'a [Labelled<'a>],
    pub window: &'a Window,
    /// Makes the title with what is left out.
    pub title: &'a dyn Fn(Vec<String>) -> String,
}

impl Rubbed<'_> {
    /// The work of wear of each support since the start of the run; `None` without work.
    pub fn work(&self) -> Option<String> {
        let points = |motion: &Trajectory, index: usize| {
            let column = motion.wear_work().get(index)?;
            Some(motion.time().iter().copied().zip(column.iter().copied()).collect())
        };
        self.figure("Work of wear (J)", ", without friction: an upper figure", &points)
    }

    /// The force of each round support, in the mean from row to row; `None` without any.
    pub fn force(&self) -> Option<String> {
        let points = |motion: &Trajectory, index: usize| {
            let wall = self.scene.supports.get(index)?.hole(&self.scene.walls)?.index;
            let number = self.scene.holes().position(|hole| hole.index == wall)?;
            let [y, z] = motion.hole_impulses().get(number)?;
            let mean = |((pair, y), z): ((&[f64], &f64), &f64)| match pair {
                [from, to] => Some((*to, y.hypot(*z) / (to - from))),
                _ => None,
            };
            let rows = motion.time().windows(2).zip(y.iter().skip(1)).zip(z.iter().skip(1));
            Some(rows.filter_map(mean).collect())
        };
        self.figure("Force, mean from row to row (N)", "", &points)
    }

    /// A panel for each support of the largest values in the first run; `frictionless` is added to
    /// the heading of a support without friction.
    fn figure(
        &self,
        label: &str,
        frictionless: &str,
        points: &dyn Fn(&Trajectory, usize) -> Option<Points>,
    ) -> Option<String> {
        let first = self.runs.first()?;
        let largest = |points: Points| points.iter().map(|point| point.1.abs()).fold(0.0, f64::max);
        let weighed = |index: usize| Some((index, largest(points(&first.run.trajectory, index)?)));
        let weighed = (0..self.scene.supports.len()).filter_map(weighed).filter(|(_, weight)| *weight > 0.0);
        let Chosen { shown, left } = Chosen::heaviest(weighed, MOST, |support| support.1);
        shown.first()?;
        let left_out = (!left.is_empty()).then(|| format!("{} of {} supports", shown.len(), shown.len() + left.len()));
        let title = (self.title)(left_out.into_iter().collect());
        let mut figure = self.window.over_time(Figure::new(title, "Time (s)"));
        let places = Places::of(self.scene);
        for support in shown.iter().filter_map(|(index, _)| Some((*index, self.scene.supports.get(*index)?))) {
            let remark = if support.1.friction(&self.scene.walls).sliding == 0.0 { frictionless } else { "" };
            let mut panel = Panel::new(label).heading(format!("{}{remark}", support.1.name));
            for labelled in self.runs {
                let Some(points) = points(&labelled.run.trajectory, support.0) else { continue };
                let shown = points.into_iter().filter(|point| self.window.whole.holds(point.0));
                // Of one run each support has its colour, of several each run its look.
                let curve = match self.runs {
                    [_] => Curve::new(support.1.name.as_str(), shown).look(0).colour(places.colour(&support.1.name)),
                    _ => Curve::new(labelled.label, shown).look(labelled.look),
                };
                panel = panel.curve(if labelled.reference { curve.backdrop() } else { curve });
            }
            figure = figure.panel(panel);
        }
        Some(figure.to_svg())
    }
}
