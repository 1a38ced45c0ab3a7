//! The outline that bounds the motion at a support, and its work of wear by sectors as a ring
//! around it.

use super::labelled::Labelled;
use crate::scene::{Probe, Scene, Support};
use crate::statistics::WearStatistics;

/// Corners of a circle.
const CORNERS: usize = 180;
/// Radius of the inside of the ring over the support's own, and its largest height.
const INSIDE: f64 = 1.06;
const HEIGHT: f64 = 0.3;
/// A corner of a lattice of four bars is √2 of its gap away.
const CORNER: f64 = 1.45;

/// How far from its centre the outline of a support is drawn, m: to the circle of a round one, and
/// to the corners between flats, the farthest of which is `gap` away.
pub(crate) fn reach(gap: f64, round: bool) -> f64 {
    if round { gap } else { CORNER * gap }
}

/// A support around a place that is drawn.
#[derive(Debug, Clone)]
pub(super) struct Ring {
    /// Index of the support.
    index: usize,
    centre: [f64; 2],
    /// The gap of a round hole, m.
    hole: Option<f64>,
    /// Radius of the inside of the ring, m.
    inside: f64,
}

impl Ring {
    /// The supports around the place of two probes.
    pub fn around(scene: &Scene, [y, z]: [&Probe; 2]) -> Vec<Self> {
        let there = scene.supports.iter().enumerate().filter(|(_, s)| s.at.y == y.at && s.at.z == z.at);
        let ring = |(index, support): (usize, &Support)| {
            let hole = support.hole(&scene.walls).map(|hole| hole.gap);
            let gap = support.gaps(&scene.walls).into_iter().fold(0.0, f64::max);
            Self { index, centre: support.centre, hole, inside: INSIDE * reach(gap, hole.is_some()) }
        };
        there.map(ring).filter(|ring| ring.inside > 0.0).collect()
    }

    /// The name of the support.
    pub fn name<'a>(&self, scene: &'a Scene) -> &'a str {
        scene.supports.get(self.index).map_or("", |support| support.name.as_str())
    }

    fn point(&self, degrees: f64, radius: f64) -> [f64; 2] {
        let (sin, cos) = degrees.to_radians().sin_cos();
        [self.centre[0] + radius * cos, self.centre[1] + radius * sin]
    }

    /// The circle of a hole.
    pub fn circle(&self) -> Option<Vec<[f64; 2]>> {
        let gap = self.hole?;
        Some((0..=CORNERS).map(|k| self.point(360.0 * k as f64 / CORNERS as f64, gap)).collect())
    }

    /// The statistics of the support in the run whose ring is drawn: the first of several.
    fn statistics<'a>(&self, runs: &[Labelled<'a>]) -> Option<&'a WearStatistics> {
        runs.first()?.run.statistics.wear.get(self.index)
    }

    /// The largest work rate of a sector, W, and whether it is an upper figure; `None` without
    /// work.
    pub fn largest(&self, runs: &[Labelled<'_>]) -> Option<(f64, bool)> {
        let support = self.statistics(runs)?;
        let most = support.sectors.iter().map(|sector| sector.work_rate_w).fold(0.0, f64::max);
        (most > 0.0).then_some((most, support.upper_figure))
    }

    /// One area for each sector with work, whose height is in proportion to it.
    pub fn areas(&self, runs: &[Labelled<'_>]) -> Vec<Vec<[f64; 2]>> {
        let (Some((most, _)), Some(support)) = (self.largest(runs), self.statistics(runs)) else { return Vec::new() };
        let worked = support.sectors.iter().filter(|sector| sector.work_rate_w > 0.0);
        let area = |sector: &crate::statistics::SectorStatistics| {
            let outside = self.inside * (1.0 + HEIGHT * sector.work_rate_w / most);
            let parts = (CORNERS / support.sectors.len().max(1)).max(2);
            let angle = |k: usize| sector.from_deg + (sector.to_deg - sector.from_deg) * k as f64 / parts as f64;
            let there = (0..=parts).map(|k| self.point(angle(k), self.inside));
            there.chain((0..=parts).rev().map(|k| self.point(angle(k), outside))).collect()
        };
        worked.map(area).collect()
    }

    /// The corners of a square that holds the ring, or the hole.
    pub fn reach(&self, runs: &[Labelled<'_>]) -> Option<[[f64; 2]; 2]> {
        let radius = match (self.largest(runs), self.hole) {
            (Some(_), _) => self.inside * (1.0 + HEIGHT),
            (None, Some(gap)) => gap,
            (None, None) => return None,
        };
        Some([-radius, radius].map(|by| self.centre.map(|x| x + by)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::output::labelled::Labelled;
    use crate::run::{Options, run};
    use crate::scene::{PlaneRows, Row, Structure, Wall};
    use crate::scheme::Scheme;

    /// A free mass of 1 kg in a hole of 1 mm about (0.2, 0) mm.
    fn scene() -> Scene {
        let structure = Structure {
            mass: crate::linear::Symmetric::from_entries(2, [(0, 0, 1.0), (1, 1, 1.0)]),
            damping: crate::linear::Symmetric::from_entries(2, []),
            stiffness: crate::linear::Symmetric::from_entries(2, []),
        };
        let mut scene = Scene::structure(structure).with_initial(&[0.5e-3, -0.3e-3], &[0.1, 0.07]).with_duration(0.2);
        let at = PlaneRows { y: Row::dof(0), z: Row::dof(1) };
        scene.probes = ["s-y", "s-z"]
            .into_iter()
            .zip([0, 1])
            .map(|(name, i)| Probe { name: name.to_owned(), at: Row::dof(i) })
            .collect();
        let wall = Wall::round("s", at.clone(), 1e-3).with_centre([0.2e-3, 0.0]).with_restitution(0.9);
        scene.with_support("s", at, [0.2e-3, 0.0], vec![wall])
    }

    #[test]
    fn the_height_of_the_ring_is_the_work_of_its_sector() {
        let scene = scene();
        let run = run(&scene, &Scheme::MoreauJean { theta: 0.5 }, &Options::with_step(1e-4)).unwrap();
        let runs = [Labelled { label: "", run: &run, reference: false, look: 0 }];
        let [ring] = <[Ring; 1]>::try_from(Ring::around(&scene, [&scene.probes[0], &scene.probes[1]])).unwrap();
        let from_centre = |[y, z]: [f64; 2]| (y - 0.2e-3).hypot(z);
        assert!(ring.circle().unwrap().into_iter().all(|point| (from_centre(point) / 1e-3 - 1.0).abs() < 1e-12));
        let (most, upper) = ring.largest(&runs).unwrap();
        let worked: Vec<f64> =
            run.statistics.wear[0].sectors.iter().map(|s| s.work_rate_w).filter(|work| *work > 0.0).collect();
        assert!(upper && worked.len() > 2);
        let areas = ring.areas(&runs);
        assert_eq!(areas.len(), worked.len());
        for (area, work) in areas.into_iter().zip(worked) {
            let (least, largest) = area.into_iter().map(from_centre).fold((1.0, 0.0), |(a, b), r| (r.min(a), r.max(b)));
            assert!((least / (INSIDE * 1e-3) - 1.0).abs() < 1e-12);
            assert!(((largest / least - 1.0) / (HEIGHT * work / most) - 1.0).abs() < 1e-9);
        }
    }
}
