//! Names of the columns of the tables.

use super::axis::Axis;
use super::request::Sweep;
use super::table::{REALISATION, SEEDS};
use crate::case::Case;
use crate::error::{Error, Result};
use crate::scene::Scene;
use std::collections::HashSet;

impl Sweep {
    /// The columns that tell rows apart: the number, the direction, the values that vary.
    fn row_columns(&self, axis_columns: &[Vec<String>]) -> Vec<String> {
        let direction = self.followed().map(|_| "direction".to_owned());
        std::iter::once("row".to_owned()).chain(direction).chain(axis_columns.iter().flatten().cloned()).collect()
    }

    /// The columns of the measures in `sweep.csv`: after the mean over realisations, the half width
    /// of its interval.
    fn measure_columns(&self, scene: &Scene) -> Vec<String> {
        let mut columns = Vec::new();
        for measure in &self.measures {
            let half_widths = measure.half_width_columns(scene);
            for (column, half_width) in measure.columns(scene).into_iter().zip(half_widths) {
                columns.push(column);
                columns.extend(self.realisations.map(|_| half_width));
            }
        }
        columns
    }

    /// The columns of `realisations.csv`; `None` unless rows have several realisations.
    pub(super) fn run_header(&self, base: &Case, axis_columns: &[Vec<String>]) -> Option<Vec<String>> {
        self.realisations?;
        let mut header = self.row_columns(axis_columns);
        header.insert(1, REALISATION.to_owned());
        header.extend(["status", "error"].map(str::to_owned));
        header.extend(self.measures.iter().flat_map(|measure| measure.columns(&base.scene)));
        header.extend(self.measures.iter().flat_map(|measure| measure.depths_columns(&base.scene)));
        Some(header)
    }

    /// Names of the columns of `sweep.csv`.
    pub(super) fn header(&self, base: &Case, axis_columns: &[Vec<String>]) -> Result<Vec<String>> {
        let mut header = self.row_columns(axis_columns);
        header.extend(self.realisations.map(|_| SEEDS.to_owned()));
        header.extend(["status", "error"].map(str::to_owned));
        header.extend(self.measure_columns(&base.scene));
        // Those of realisations.csv are among them.
        let depths: Vec<String> =
            self.measures.iter().flat_map(|measure| measure.depths_columns(&base.scene)).collect();
        let own = std::iter::once(REALISATION).chain(depths.iter().map(String::as_str));
        let mut seen: HashSet<&str> = own.filter(|_| self.realisations.is_some()).collect();
        if let Some(twice) = header.iter().find(|name| !seen.insert(name.as_str())) {
            return Err(Error::invalid("[[vary]] name", twice, "a name that no other column has"));
        }
        Ok(header)
    }

    /// Names of the axes' columns: the last word of each key if these differ, else the whole keys.
    pub(super) fn axis_columns(&self) -> Vec<Vec<String>> {
        let short: Vec<Vec<String>> = self.axes.iter().map(|axis| axis.columns(false)).collect();
        let twice = |name: &String| short.iter().flatten().filter(|other| *other == name).count() > 1;
        let whole = |(axis, columns): (&Axis, &Vec<String>)| {
            if columns.iter().any(twice) { axis.columns(true) } else { columns.clone() }
        };
        self.axes.iter().zip(&short).map(whole).collect()
    }
}
