//! How many realisations the rows have whose own intervals decide: by Stein's procedure, as in
//! [`NeededRealisations`], from the first [`PILOTS`] of each row.
//!
//! The judged means of a row are those of [`NeededRealisations`] as far as they are measures of the
//! sweep: work rates at supports, and without work mean forces. They are read from the lines of the
//! runs, so that a row has the same number whether its pilots were run just now, by an earlier
//! process or on another machine.

use super::measure::Measure;
use super::request::Sweep;
use super::status::Status;
use crate::error::Error;
use crate::scene::Scene;
use crate::statistics::{ContactPlace, PlaceKind};
use crate::study::realisations::{
    Figure, Measure as Judged, NeededRealisations, PILOTS, Realisation, RealisationCount, shortfall,
};
use csv::StringRecord;

/// The measures whose intervals decide, and what they are called in studies of realisations.
const JUDGED: [(Measure, Judged); 2] = [(Measure::WorkRate, Judged::WorkRate), (Measure::ForceMean, Judged::ForceMean)];

/// How many realisations the rows have whose own intervals decide.
#[derive(Debug, Clone)]
pub(super) struct UntilInterval {
    share: f64,
    most: u64,
    /// The column of the status in `realisations.csv`.
    status: usize,
    /// The columns there of the judged measures, each with its place.
    judged: Vec<(usize, ContactPlace, Judged)>,
}

impl UntilInterval {
    /// For rows of `sweep` under `header`, with the walls and supports of `scene`; `None` where
    /// intervals do not decide.
    pub fn of(sweep: &Sweep, scene: &Scene, header: &[String]) -> Option<Self> {
        let Some(RealisationCount::Within { share, most, .. }) = sweep.realisations else { return None };
        let find = |name: &str| header.iter().position(|column| column == name);
        let mut judged = Vec::new();
        for (measure, figure) in JUDGED.into_iter().filter(|(measure, _)| sweep.measures.contains(measure)) {
            // Supports are before walls.
            let places = measure.scope().places(scene).into_iter().enumerate().map(|(index, name)| ContactPlace {
                name: name.to_owned(),
                kind: if index < scene.supports.len() { PlaceKind::Support } else { PlaceKind::Wall },
            });
            for (column, place) in measure.columns(scene).iter().zip(places) {
                judged.extend(find(column).map(|at| (at, place, figure)));
            }
        }
        Some(Self { share, most, status: find("status")?, judged })
    }

    /// True if a measure of the sweep is judged.
    pub fn judges(&self) -> bool {
        !self.judged.is_empty()
    }

    /// The names of the measures that are judged.
    pub fn names() -> String {
        JUDGED.map(|(measure, _)| measure.name()).join(", ")
    }

    /// The runs of a row that have valid measures, as far as these are judged.
    fn members(&self, runs: &[StringRecord]) -> Vec<Realisation> {
        let good = runs.iter().zip(1..).filter(|(run, _)| Status::is_good_word(run.get(self.status).unwrap_or("")));
        let of = |(run, number): (&StringRecord, u64)| {
            let figure = |(at, place, measure): &(usize, ContactPlace, Judged)| {
                let value = run.get(*at)?.parse().ok()?;
                let (place, measure) = (place.clone(), *measure);
                Some(Figure { place, measure, value, batch_half_width_95: None, halves: None })
            };
            let figures = self.judged.iter().filter_map(figure).collect();
            Realisation::of_figures(number, figures)
        };
        good.map(of).collect()
    }

    /// How many realisations the row needs whose first ones are `runs`.
    fn needed(&self, runs: &[StringRecord]) -> u64 {
        let pilots = self.members(runs.get(..PILOTS as usize).unwrap_or(runs));
        NeededRealisations::from_pilots(&pilots, self.share).map_or(PILOTS, |needed| needed.count.max(PILOTS))
    }

    /// How many realisations the row has whose first ones are `runs`.
    pub fn count(&self, runs: &[StringRecord]) -> u64 {
        self.needed(runs).min(self.most)
    }

    /// That the row with all these `runs` needs more than the most, and has an interval that is
    /// wider than was asked for.
    pub fn shortfall(&self, runs: &[StringRecord]) -> Option<Error> {
        let needed = self.needed(runs);
        if needed <= self.most {
            return None;
        }
        shortfall(&self.members(runs), self.share, needed)
    }
}
