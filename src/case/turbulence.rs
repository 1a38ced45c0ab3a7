//! Reads the tables `[[turbulence]]`.

use super::Case;
use super::builder::Builder;
use super::model::{Model, Place};
use super::value::{Section, Value};
use crate::error::{Error, Result};
use crate::scene::{Row, Turbulence, TurbulenceSpectrum};
use std::ops::Range;
use toml::Spanned;

/// Cells in an element of the tube.
const CELLS_AN_ELEMENT: f64 = 4.0;

/// Most cells of a stretch.
const MOST_CELLS: f64 = 2048.0;

/// Shares of a band that are worth a note.
const WORTH_SAYING: f64 = 1e-6;

impl Builder<'_> {
    /// The fields of table `index` in a run until `end` (s): one, or one along y and one along z.
    /// `modes` tells whether the system is reduced to modes.
    pub fn turbulence(&mut self, index: usize, table: &Section<'_>, end: f64, modes: bool) -> Result<Vec<Turbulence>> {
        let owner = format!("turbulence {}", index + 1);
        let (body, model) = self.tube_in_flow(&owner, table)?;
        if !modes {
            let help = "expected modes = k in [system], the modes of each plane";
            let title = format!("{owner} acts through modes, and the system is not reduced to modes");
            return Err(self.source.error(table.span.clone(), &title, help));
        }
        let line = self.line(&owner, (&model, body.as_deref()), table)?;
        let (reach, elements) = match (&model, &line) {
            (Model::Beam(beam), _) => ([0.0, beam.length], beam.elements),
            (_, Some(line)) => (line.ends(), line.stretches()),
            _ => ([0.0; 2], 0),
        };
        let along = self.stretch(&owner, table, reach)?;
        let count = (CELLS_AN_ELEMENT * elements as f64 * (along[1] - along[0]) / (reach[1] - reach[0])).ceil();
        let count = count.clamp(1.0, MOST_CELLS) as usize;
        let edge = |i: usize| along[0] + (along[1] - along[0]) * (i as f64 / count as f64);
        let ends: Vec<[f64; 2]> = (0..count).map(|cell| [edge(cell), edge(cell + 1)]).collect();
        let spectrum = self.spectrum((&owner, &model), table, &ends)?;
        let [from, to, correlation_length] = ["from", "to", "correlation_length"].map(|key| table.required(key));
        let seed = table.number("seed").map_or(Ok(0), |seed| self.seed(&owner, &seed))?;
        let mut fields = Vec::new();
        for (plane, degrees) in self.headings(&owner, table)?.into_iter().enumerate() {
            let row = |&[from, to]: &[f64; 2]| -> Result<Row> {
                let place = match &line {
                    Some(line) => line.mean(from, to),
                    None => Place::Spread { from, to },
                }
                .on(body.as_deref());
                let place = match degrees {
                    None => place,
                    Some(degrees) => Place::Towards { place: Box::new(place), degrees },
                };
                self.planes.row(&self.model, &place)
            };
            let field = Turbulence {
                cells: ends.iter().map(row).collect::<Result<_>>()?,
                along,
                spectrum: spectrum.clone(),
                correlation_length: *correlation_length.get_ref(),
                band: [*from.get_ref(), *to.get_ref()],
                seed,
                stream: Turbulence::stream(index, plane),
            };
            field.check(end).map_err(|error| self.at_turbulence(&owner, table, error))?;
            fields.push(field);
        }
        self.positions.push((("turbulence", "band").into(), to.span()));
        Ok(fields)
    }

    /// The system on which a field acts, and the name of its body, where there are several.
    fn tube_in_flow(&self, owner: &str, table: &Section<'_>) -> Result<(Option<String>, Model)> {
        let (body, model, of) = match (&self.model, table.word("body")) {
            (Model::Bodies(_), Some(name)) => {
                let body = self.body_named(&format!("{owner}: body"), name.get_ref(), name.span())?;
                (Some(body.name), body.model, "body")
            }
            (Model::Bodies(_), None) => {
                let help = format!("expected body = {}", self.names_of_bodies());
                return Err(self.source.error(table.span.clone(), &format!("`body` is missing in {owner}"), &help));
            }
            (_, Some(name)) => {
                let title = format!("{owner}: body beside one system");
                return Err(self.source.error(name.span(), &title, "expected no body, or several [[body]]"));
            }
            (model, None) => (None, model.clone(), "system"),
        };
        if !matches!(model, Model::Beam(_) | Model::Modal(_)) {
            let help = format!("expected [{of}.beam], or [{of}.modal] and a line: turbulence acts along a tube");
            return Err(self.source.error(table.span.clone(), &format!("{owner} acts on no tube"), &help));
        }
        Ok((body, model))
    }

    /// The stretch of the tube on which there are forces, m.
    fn stretch(&self, owner: &str, table: &Section<'_>, [first, last]: [f64; 2]) -> Result<[f64; 2]> {
        let Some(along) = table.numbers("along") else { return Ok([first, last]) };
        let ends: Vec<f64> = along.get_ref().iter().map(|x| *x.get_ref()).collect();
        match ends[..] {
            [from, to] if (first..to).contains(&from) && to <= last => Ok([from, to]),
            _ => {
                let expected = format!("[from, to], from {first} to {last:?} m, from below to");
                Err(self.refuse(along.span(), &format!("{owner}: along"), &expected))
            }
        }
    }

    /// The directions of the fields, degrees; `None` in one plane.
    fn headings(&self, owner: &str, table: &Section<'_>) -> Result<Vec<Option<f64>>> {
        let direction = table.get("direction");
        let Some(value) = direction else {
            if !self.planes.is_two() {
                return Ok(vec![None]);
            }
            let title = format!("`direction` is missing in {owner}");
            let help = "expected direction = \"both\", or a number, in deg, from +y (0) towards +z (90)";
            return Err(self.source.error(table.span.clone(), &title, help));
        };
        match value.get_ref() {
            _ if !self.planes.is_two() => Err(self.undirected(owner, value.span())),
            Value::Word(word) if word == "both" => Ok(vec![Some(0.0), Some(90.0)]),
            Value::Number(degrees) if degrees.is_finite() => Ok(vec![Some(*degrees)]),
            _ => Err(self.refuse(value.span(), &format!("{owner}: direction"), "a number, in deg, or \"both\"")),
        }
    }

    /// The spectrum in each of the cells between `ends` (m).
    fn spectrum(
        &self,
        (owner, model): (&str, &Model),
        table: &Section<'_>,
        ends: &[[f64; 2]],
    ) -> Result<TurbulenceSpectrum> {
        let one = "expected density (kg/m^3), velocity (m/s) and reduced = [[fD/V, density], ..], or \
                   spectrum = [[Hz, (N/m)^2/Hz], ..]";
        let [density, velocity, reduced] = ["density", "velocity", "reduced"].map(|key| table.get(key));
        match (table.get("spectrum"), density.and(table.number("density")), velocity, reduced) {
            (Some(spectrum), None, None, None) => {
                if let Some(span) = table.span_of("diameter") {
                    let title = format!("{owner}: diameter beside spectrum");
                    let help = "expected it beside density, velocity and reduced: a spectrum is that of the force";
                    return Err(self.source.error(span, &title, help));
                }
                let wanted = "pairs of a frequency, in Hz, and a density, in (N/m)^2/Hz";
                Ok(TurbulenceSpectrum::Even(self.number_pairs(&format!("{owner}: spectrum"), spectrum, wanted)?))
            }
            (None, Some(density), Some(velocity), Some(reduced)) => {
                let diameter = self.diameter((owner, model), table, density.span())?;
                let wanted = "pairs of a reduced frequency fD/V and a reduced density";
                Ok(TurbulenceSpectrum::Flow {
                    density: *density.get_ref(),
                    diameter,
                    velocity: self.velocity(owner, velocity, ends)?,
                    reduced: self.number_pairs(&format!("{owner}: reduced"), reduced, wanted)?,
                })
            }
            (Some(spectrum), ..) => Err(self.source.error(spectrum.span(), &format!("{owner} has two spectra"), one)),
            _ => {
                let missing = ["density", "velocity", "reduced"].into_iter().find(|key| table.get(key).is_none());
                let title = match missing.filter(|_| density.or(velocity).or(reduced).is_some()) {
                    Some(key) => format!("`{key}` is missing in {owner}"),
                    None => format!("{owner} has no spectrum"),
                };
                Err(self.source.error(table.span.clone(), &title, one))
            }
        }
    }

    /// The diameter of the tube in a flow, m: that of the beam, or beside modes that which `table`
    /// states. `flow` is where the flow stands in the file.
    fn diameter(&self, (owner, model): (&str, &Model), table: &Section<'_>, flow: Range<usize>) -> Result<f64> {
        let stated = table.number("diameter");
        let Model::Beam(beam) = model else {
            let Some(stated) = stated else {
                let title = format!("`diameter` is missing in {owner}, which acts on modes");
                return Err(self.source.error(flow, &title, "expected diameter = that of the tube, in m"));
            };
            let diameter = *stated.get_ref();
            return if diameter.is_finite() && diameter > 0.0 {
                Ok(diameter)
            } else {
                Err(self.refuse(stated.span(), &format!("{owner}: diameter"), "a number above 0, in m"))
            };
        };
        if let Some(stated) = stated {
            let title = format!("{owner}: diameter beside a beam, which has its outer_diameter");
            return Err(self.source.error(stated.span(), &title, "expected it beside [system.modal] only"));
        }
        beam.section.outer_diameter().ok_or_else(|| {
            let title = format!("{owner} is that of a flow across a tube, and the beam is rectangular");
            let help = "expected spectrum = [[Hz, (N/m)^2/Hz], ..] in place of density, velocity and reduced, which \
                        need the outer_diameter of a tube";
            self.source.error(flow, &title, help)
        })
    }

    /// The velocity at the middle of each cell, m/s.
    fn velocity(&self, owner: &str, value: &Spanned<Value<'_>>, ends: &[[f64; 2]]) -> Result<Vec<f64>> {
        let key = format!("{owner}: velocity");
        let wanted = "a number, 0 or more, in m/s, or pairs of a position, in m, and a velocity, in m/s";
        if let Value::Number(_) = value.get_ref() {
            let velocity = self.finite(&key, value, wanted)?;
            return if velocity >= 0.0 {
                Ok(vec![velocity; ends.len()])
            } else {
                Err(self.refuse(value.span(), &key, wanted))
            };
        }
        let points = self.number_pairs(&key, value, wanted)?;
        let falls = points.windows(2).any(|pair| pair[1][0] <= pair[0][0]);
        if points.len() < 2 || falls || points.iter().any(|point| point[1] < 0.0) {
            let expected = "two pairs or more with increasing positions (m) and velocities of 0 or more (m/s)";
            return Err(self.refuse(value.span(), &key, expected));
        }
        let (from, to) = (ends.first().map_or(0.0, |cell| cell[0]), ends.last().map_or(0.0, |cell| cell[1]));
        let (first, last) = (points[0][0], points[points.len() - 1][0]);
        if first > from || last < to {
            let title =
                format!("{key} is known from {first:?} to {last:?} m, and the stretch goes from {from:?} to {to:?} m");
            let help = "expected pairs that reach over the stretch; `along` makes it shorter";
            return Err(self.source.error(value.span(), &title, help));
        }
        let at = |x: f64| {
            let after = points.partition_point(|point| point[0] <= x).clamp(1, points.len() - 1);
            let [[x0, v0], [x1, v1]] = [points[after - 1], points[after]];
            v0 + (v1 - v0) * (x - x0) / (x1 - x0)
        };
        Ok(ends.iter().map(|[from, to]| at(0.5 * (from + to))).collect())
    }

    /// An error of a field, at the key that it is about.
    fn at_turbulence(&self, owner: &str, table: &Section<'_>, error: Error) -> Error {
        let key = |name: &str| table.span_of(if name == "band" { "to" } else { name });
        self.at_own_key(["turbulence", owner], table, error, key)
    }
}

impl Case {
    /// Its fields of turbulence.
    #[must_use]
    pub fn turbulence(&self) -> &[Turbulence] {
        self.truncated.as_ref().map_or(&[], |truncated| &truncated.whole.turbulence)
    }

    /// Refuses turbulence, where a motion that repeats itself is asked for.
    ///
    /// # Errors
    /// [`Error::Invalid`] for a case with turbulence.
    pub fn check_repeats(&self) -> Result<()> {
        match self.turbulence().first() {
            None => Ok(()),
            Some(field) => {
                let found = format!("none: turbulence {} does not repeat itself", field.number());
                Err(Error::invalid("forcing period", found, "only constant and harmonic loads"))
            }
        }
    }

    /// Where a spectrum ends within the band that was asked for, in sentences.
    pub(super) fn turbulence_notes(&self) -> Vec<String> {
        let note = |field: &Turbulence| {
            let [from, to] = field.band;
            let place = |cell: usize| {
                let [start, end] = field.along;
                start + (end - start) * (cell as f64 + 0.5) / field.cells.len() as f64
            };
            let flowing = (0..field.cells.len()).map(|cell| (cell, field.spectrum.band(cell)));
            let (cell, [_, ends]) = flowing.clone().min_by(|a, b| a.1[1].total_cmp(&b.1[1]))?;
            let (slow, [begins, _]) = flowing.max_by(|a, b| a.1[0].total_cmp(&b.1[0]))?;
            let mut said = Vec::new();
            if ends < to * (1.0 - WORTH_SAYING) {
                said.push(format!("at {:.3} m its spectrum ends at {ends:.3} Hz", place(cell)));
            }
            if begins > from * (1.0 + WORTH_SAYING) {
                said.push(format!("at {:.3} m it begins at {begins:.3} Hz", place(slow)));
            }
            let [all, none] = [said.join(", and "), "beyond that there is no force".to_owned()];
            (!said.is_empty()).then(|| format!("turbulence {}: {all}: {none}", field.number()))
        };
        let mut notes: Vec<String> = self.turbulence().iter().filter_map(note).collect();
        notes.dedup();
        notes
    }
}
