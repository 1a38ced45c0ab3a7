//! Diagrams of the instants of rows: bifurcation diagrams, Poincaré sections.

use super::columns::{Source, of};
use super::picture::{Kind, Picture};
use super::table::{SAMPLES, TABLE, Table, label};
use crate::error::{Error, Result};
use crate::output::extent;
use crate::output::figure::{Scale, Scatter};
use std::collections::BTreeMap;

impl Picture {
    pub(super) fn bifurcation(&self, source: &Source<'_>) -> Result<Option<String>> {
        let x = Self::axis(self.x.as_ref(), source)?;
        let y = self.sampled(self.y.as_ref(), 0, source)?;
        if !x.is_numeric(source) {
            return Ok(None);
        }
        let table = Table::open(&source.folder.join(TABLE))?;
        let (row, own) = (table.column("row")?, table.column(&x.column)?);
        let direction = table.column("direction").ok();
        let mut of_row: BTreeMap<u64, (f64, usize)> = BTreeMap::new();
        let mut both = [false; 2];
        table.each(|line| {
            if let (Some(number), Some(at)) = (line.number(row), line.number(own)) {
                let down = usize::from(direction.is_some_and(|index| line.text(index) == "down"));
                both[down] = true;
                of_row.insert(number as u64, (at, down));
            }
        })?;
        let groups: &[&str] = if both == [true, true] { &["up", "down"] } else { &[""] };
        let group = |down: usize| if groups.len() == 2 { down } else { 0 };
        let x_range = extent(of_row.values().map(|(x, _)| *x).filter(|x| x.is_finite()));
        let mut y_range = (f64::INFINITY, f64::NEG_INFINITY);
        self.samples(source, &[&y], |_, values| y_range = (y_range.0.min(values[0]), y_range.1.max(values[0])))?;
        if y_range.0 > y_range.1 {
            return Ok(None);
        }
        let title = self.titled(source);
        let (x_label, y_label) = (label(&x.column), label(&y));
        let mut scatter = Scatter::new(title, (&x_label, x.scale, x_range), (&y_label, Scale::Linear, y_range), groups);
        self.samples(source, &[&y], |number, values| {
            if let Some((at, down)) = of_row.get(&number) {
                scatter.add(group(*down), *at, values[0]);
            }
        })?;
        Ok(Some(scatter.to_svg()))
    }

    pub(super) fn section(&self, source: &Source<'_>) -> Result<Option<String>> {
        let (x, y) = (self.sampled(self.x.as_ref(), 0, source)?, self.sampled(self.y.as_ref(), 1, source)?);
        let mut ranges = [(f64::INFINITY, f64::NEG_INFINITY); 2];
        self.samples(source, &[&x, &y], |_, values| {
            for (range, value) in ranges.iter_mut().zip(values) {
                *range = (range.0.min(*value), range.1.max(*value));
            }
        })?;
        if ranges[0].0 > ranges[0].1 {
            return Ok(None);
        }
        let (x_label, y_label) = (label(&x), label(&y));
        let mut scatter = Scatter::new(
            self.titled(source),
            (&x_label, Scale::Linear, ranges[0]),
            (&y_label, Scale::Linear, ranges[1]),
            &[""],
        );
        self.samples(source, &[&x, &y], |_, values| scatter.add(0, values[0], values[1]))?;
        Ok(Some(scatter.to_svg()))
    }

    fn titled(&self, source: &Source<'_>) -> String {
        match &self.wall {
            Some(wall) => format!("{}, wall {wall}", source.title),
            None => source.title.to_owned(),
        }
    }

    /// The column of instants named `asked`, or number `index` of the default ones.
    pub(super) fn sampled(&self, asked: Option<&String>, index: usize, source: &Source<'_>) -> Result<String> {
        let columns = &source.sample_columns;
        let telling = |column: &&String| {
            ["displacement", "velocity", "phase_cycles", "approach_speed"].iter().any(|name| of(column, name))
        };
        let found = match asked {
            Some(name) => {
                columns.iter().find(|column| *column == name).or_else(|| columns.iter().find(|column| of(column, name)))
            }
            None if index == 0 && columns.iter().any(|column| column == "wall") && self.kind != Some(Kind::Section) => {
                columns.iter().find(|column| of(column, "approach_speed"))
            }
            None => columns.iter().filter(telling).nth(index),
        };
        found.cloned().ok_or_else(|| Error::Unknown {
            kind: "column of samples",
            name: asked.cloned().unwrap_or_default(),
            known: columns.iter().skip(1).cloned().collect(),
        })
    }

    /// Calls `take` with the number of the row and the values of `columns`, for every instant that
    /// is drawn.
    fn samples(&self, source: &Source<'_>, columns: &[&String], mut take: impl FnMut(u64, &[f64])) -> Result<()> {
        let table = Table::open(&source.folder.join(SAMPLES))?;
        let row = table.column("row")?;
        let indices = columns.iter().map(|column| table.column(column)).collect::<Result<Vec<_>>>()?;
        let wall = table.column("wall").ok().filter(|_| self.wall.is_some());
        let mut values = Vec::new();
        table.each(|line| {
            if wall.is_some_and(|index| Some(line.text(index)) != self.wall.as_deref()) {
                return;
            }
            values.clear();
            values.extend(indices.iter().filter_map(|&index| line.number(index)));
            if let (Some(number), true) = (line.number(row), values.len() == indices.len()) {
                take(number as u64, &values);
            }
        })
    }
}
