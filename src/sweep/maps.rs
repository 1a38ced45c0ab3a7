//! Maps of a measure over two axes: its values, or the attractors to which starts lead.

use super::attractors::named;
use super::columns::{Source, SweepAxis};
use super::measure::Measure;
use super::picture::{Drawn, Picture};
use super::table::{TABLE, Table, label};
use crate::error::{Error, Result};
use crate::output::figure::{Class, HeatMap, Scale};

/// Most cells along one side of a map of numbers, and of one of attractors, whose equal neighbours
/// are drawn as one.
const MOST_CELLS: usize = 160;
const MOST_TONES: usize = 400;

/// Attractors with a tone of their own; the others share one.
const TONES: usize = 6;

/// The values of a column over two axes.
struct Grid {
    xs: Vec<f64>,
    ys: Vec<f64>,
    /// Row by row from the least y; NaN where there is no value.
    cells: Vec<f64>,
}

impl Picture {
    pub(super) fn heat(&self, source: &Source<'_>) -> Result<Option<Drawn>> {
        let sides = self.map_sides(source, "heat")?;
        let groups = self.measures(self.z.as_ref(), source)?;
        let Some(column) = groups.first().and_then(|(_, columns)| columns.first()) else { return Ok(None) };
        let grid = Grid::of(source, sides, column, MOST_CELLS)?;
        let map = grid.map(source.title, sides);
        let svg = map.numbers(label(column), Scale::Linear, grid.cells).to_svg();
        let others = groups.iter().flat_map(|(_, columns)| columns).filter(|other| *other != column);
        Ok(Some(Drawn { svg, left_out: others.cloned().collect() }))
    }

    pub(super) fn basin(&self, source: &Source<'_>) -> Result<Option<String>> {
        let sides = self.map_sides(source, "basin")?;
        let grid = Grid::of(source, sides, Measure::Attractor.name(), MOST_TONES)?;
        let known = named(source.folder)?;
        // The share first: a long name is cut off.
        let class = |number: usize, name: &str, share: f64, letter: char| {
            Class::new(format!("{number}: {:.0} %, {name}", 100.0 * share), letter)
        };
        let mut classes: Vec<Class> = known
            .iter()
            .zip('1'..)
            .take(TONES)
            .enumerate()
            .map(|(at, ((name, share), letter))| class(at + 1, name, *share, letter))
            .collect();
        if let Some(others) = known.get(TONES..).filter(|others| !others.is_empty()) {
            let share: f64 = others.iter().map(|(_, share)| share).sum();
            classes.push(Class::new(format!("{:.0} %, {} others", 100.0 * share, others.len()), '+'));
        }
        let tone = |number: &f64| if *number >= 1.0 { (*number as usize - 1).min(TONES) } else { usize::MAX };
        let tones = grid.cells.iter().map(tone).collect();
        Ok(Some(grid.map(source.title, sides).classes(classes, tones).to_svg()))
    }

    /// The two axes of a map.
    fn map_sides<'a>(&self, source: &'a Source<'_>, kind: &str) -> Result<[&'a SweepAxis; 2]> {
        let [x, y] = self.sides(source)?;
        if x.column == y.column {
            return Err(Error::invalid("[figure] y", &y.column, "another varied value than x"));
        }
        if !x.is_numeric(source) || !y.is_numeric(source) || source.random {
            return Err(Error::invalid("[figure] kind", kind, "two axes of numbers, without [random]"));
        }
        Ok([x, y])
    }
}

impl Grid {
    /// The values of `column`, at most `most` along each side.
    fn of(source: &Source<'_>, [x, y]: [&SweepAxis; 2], column: &str, most: usize) -> Result<Self> {
        let table = Table::open(&source.folder.join(TABLE))?;
        let (xi, yi, zi) = (table.column(&x.column)?, table.column(&y.column)?, table.column(column)?);
        let direction = table.column("direction").ok();
        let mut found: Vec<(f64, f64, f64)> = Vec::new();
        table.each(|row| {
            // Of a followed axis, the rows with rising values are shown.
            if direction.is_some_and(|index| row.text(index) == "down") {
                return;
            }
            if let (Some(x), Some(y)) = (row.number(xi), row.number(yi)) {
                found.push((x, y, row.number(zi).unwrap_or(f64::NAN)));
            }
        })?;
        let centres = |pick: fn(&(f64, f64, f64)) -> f64| {
            let mut all: Vec<f64> = found.iter().map(pick).collect();
            all.sort_by(f64::total_cmp);
            all.dedup();
            let every = all.len().div_ceil(most).max(1);
            all.into_iter().step_by(every).collect::<Vec<f64>>()
        };
        let (xs, ys) = (centres(|p| p.0), centres(|p| p.1));
        let mut cells = vec![f64::NAN; xs.len() * ys.len()];
        let place = |list: &[f64], value: f64| list.binary_search_by(|other| other.total_cmp(&value)).ok();
        for (px, py, value) in &found {
            if let (Some(i), Some(j)) = (place(&xs, *px), place(&ys, *py))
                && let Some(cell) = cells.get_mut(j * xs.len() + i)
            {
                *cell = *value;
            }
        }
        Ok(Self { xs, ys, cells })
    }

    fn map(&self, title: &str, [x, y]: [&SweepAxis; 2]) -> HeatMap {
        let (x_label, y_label) = (label(&x.column), label(&y.column));
        HeatMap::new(title, (&x_label, x.scale, &self.xs), (&y_label, y.scale, &self.ys))
    }
}
