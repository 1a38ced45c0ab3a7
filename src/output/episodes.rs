//! `episodes.csv` and `exceedances.csv`: contacts joined into episodes, and how they are
//! distributed.

use super::csv::{self, digits};
use super::places::Chosen;
use super::results::Results;
use super::table::Table;
use crate::case::Case;
use crate::error::Result;
use crate::run::Run;
use crate::scene::Scene;
use crate::statistics::{Distribution, EpisodeStatistics};
use serde::Serialize;

/// Most rows of the table in the terminal.
const MOST_ROWS: usize = 24;

/// The episodes of a run.
#[derive(Debug, Clone, Serialize)]
pub struct Episodes {
    /// Contacts are joined where less than this lies between them, s.
    pub rest_s: f64,
    /// The episodes of every wall, then of every support.
    pub places: Vec<EpisodeStatistics>,
}

/// A quantity of an episode: its name, its unit in headers, and its distribution.
type Quantity<'a> = (&'static str, &'static str, Option<&'a Distribution>);

fn quantities(one: &EpisodeStatistics) -> [Quantity<'_>; 3] {
    [
        ("impulse", "N_s", one.impulse_n_s.as_ref()),
        ("approach_speed", "m_per_s", one.approach_speed_m_per_s.as_ref()),
        ("peak_force", "N", one.peak_force_n.as_ref()),
    ]
}

impl Episodes {
    /// The episodes of `run` on `case`, joined over rests shorter than `rest` (s).
    #[must_use]
    pub fn of(case: &Case, run: &Run, rest: f64) -> Self {
        let contacts = run.trajectory.contacts();
        Self { rest_s: rest, places: EpisodeStatistics::of(&case.scene, &run.statistics, contacts, rest) }
    }

    /// Writes `episodes.csv`, a row for each place and quantity, and `exceedances.csv`, a row for
    /// each threshold, into the folder of `results`, under the names that `named` gives.
    pub fn write(&self, results: &mut Results, named: impl Fn(&str) -> String) -> Result<()> {
        type Record<'a> = (&'a EpisodeStatistics, Quantity<'a>);
        let number = |record: &Record<'_>, of: fn(&Distribution) -> f64| digits(record.1.2.map(of));
        let columns: [csv::Column<'_, Record<'_>>; 10] = [
            ("place", &|(one, _)| one.place.name.clone()),
            ("kind", &|(one, _)| one.place.kind.word().to_owned()),
            ("quantity", &|(_, (name, ..))| (*name).to_owned()),
            ("unit", &|(_, (_, unit, _))| (*unit).to_owned()),
            ("episodes", &|(one, (.., known))| known.map_or(0, |_| one.episodes).to_string()),
            ("mean", &|record| number(record, |d| d.mean)),
            ("median", &|record| number(record, |d| d.quantiles[0])),
            ("q90", &|record| number(record, |d| d.quantiles[1])),
            ("q99", &|record| number(record, |d| d.quantiles[2])),
            ("max", &|record| number(record, |d| d.max)),
        ];
        csv::records(&results.place(&named("episodes.csv"))?, &columns, self.rows())?;
        type Class<'a> = (Record<'a>, f64, usize);
        let columns: [csv::Column<'_, Class<'_>>; 6] = [
            ("place", &|((one, _), ..)| one.place.name.clone()),
            ("kind", &|((one, _), ..)| one.place.kind.word().to_owned()),
            ("quantity", &|((_, (name, ..)), ..)| (*name).to_owned()),
            ("unit", &|((_, (_, unit, _)), ..)| (*unit).to_owned()),
            ("threshold", &|(_, threshold, _)| digits(Some(*threshold))),
            ("episodes", &|(.., count)| count.to_string()),
        ];
        let rows = self.rows().flat_map(|record| {
            let classes = record.1.2.into_iter().flat_map(|d| d.thresholds.iter().zip(&d.exceedances));
            classes.map(move |(threshold, count)| (record, *threshold, *count))
        });
        csv::records(&results.place(&named("exceedances.csv"))?, &columns, rows)
    }

    /// Every quantity of every place; the peak force only where there is one.
    fn rows(&self) -> impl Iterator<Item = (&EpisodeStatistics, Quantity<'_>)> {
        let known = |quantity: &Quantity<'_>| quantity.0 != "peak_force" || quantity.2.is_some();
        self.places.iter().flat_map(move |one| quantities(one).into_iter().filter(known).map(move |q| (one, q)))
    }

    /// The table for the terminal: supports, and walls that are no flats of one; where there are
    /// many, those of the largest mean impulses. `None` without walls.
    #[must_use]
    pub fn table(&self, scene: &Scene) -> Option<Table> {
        let own = self.places.iter().filter(|one| one.place.stands_alone(scene));
        let impulse = |one: &&EpisodeStatistics| one.impulse_n_s.as_ref().map_or(0.0, |d| d.mean * one.episodes as f64);
        let shown = Chosen::heaviest(own, MOST_ROWS, impulse).shown;
        let header = [
            "place",
            "episodes",
            "impulse: mean (N s)",
            "median",
            "90 %",
            "99 %",
            "max",
            "approach: mean (m/s)",
            "median",
            "90 %",
            "99 %",
            "max",
        ];
        let row = |one: &EpisodeStatistics| {
            let mut row = vec![one.place.name.clone(), one.episodes.to_string()];
            for distribution in [&one.impulse_n_s, &one.approach_speed_m_per_s] {
                let numbers =
                    distribution.as_ref().map(|d| [d.mean, d.quantiles[0], d.quantiles[1], d.quantiles[2], d.max]);
                let text = |i: usize| numbers.map_or_else(|| "-".to_owned(), |all| format!("{:.3e}", all[i]));
                row.extend((0..5).map(text));
            }
            row
        };
        let rows: Vec<Vec<String>> = shown.into_iter().map(row).collect();
        (!rows.is_empty()).then(|| Table::new(&header, rows))
    }

    /// The remark below the table.
    #[must_use]
    pub fn remark(&self) -> String {
        match self.rest_s {
            0.0 => "episodes are single contacts, whose number grows with each further mode and each smaller step; \
                    [statistics] rest joins those that follow one another"
                .to_owned(),
            rest => {
                format!("contacts less than {rest:e} s apart are one episode; its approach speed is the largest in it")
            }
        }
    }
}
