//! Reads loads in proportion to the mass: base motion, in which the ground to which a structure and
//! its walls are fixed accelerates, and gravity.
//!
//! Where the walls stay fixed in space while the base moves by b(t), the coordinates are those in
//! space, x = u + ι b, with u relative to the base. M ü + C u̇ + K u = f − M ι b̈ is then
//!
//! M ẍ + C ẋ + K x = f + K ι b + C ι ḃ,
//!
//! so that the walls bound x, and the base pulls at the springs and dashpots that are tied to it.
//! Held ends of a bar or beam are no coordinates: rigidly moved, the rest feels K ι b all the same,
//! and the inertia of these ends besides.

use super::builder::Builder;
use super::direction::DIRECTION;
use super::model::{Model, Place};
use super::planes::Planes;
use super::random::{ACCELERATION, NewRandom};
use super::rigid_motion::{Influence, carried, rigid_motion};
use super::schema::accepted;
use super::table::{self, TableColumns};
use super::value::{Section, Value};
use super::written::{NewLoad, Origin, WallsOverBase};
use crate::error::Result;
use crate::scene::{BarEnd, BeamEnd, Load, LoadKind, PlaneRows, Row, System};
use std::f64::consts::{FRAC_PI_2, TAU};
use std::ops::Range;
use toml::Spanned;

impl Builder<'_> {
    /// The load of `kind`, "base" or "gravity". In coordinates relative to the base it is −M ι
    /// a(t), with ι = 1 on every displacement in the direction of the motion: the mass m that moves
    /// along times −a, as a force, through the row M ι/m. Gravity of g along the direction is a =
    /// −g. The keys `at` and `direction` stand beside it.
    pub fn massive(
        &mut self,
        (index, owner, kind): (usize, &str, &str),
        section: &Section<'_>,
        beside: (Option<Range<usize>>, Option<&Spanned<f64>>),
        (system, end): (&System, f64),
    ) -> Result<Vec<NewLoad>> {
        let (place, direction) = beside;
        if let Some(at) = place {
            let help = format!("expected no at: {kind} moves all of the structure");
            return Err(self.source.error(at, &format!("{owner} has a place and a {kind}"), &help));
        }
        let influence = self.influence_of((owner, kind), section)?;
        let (at, mass) = self.moved((owner, kind), section, (influence.as_deref(), direction), system)?;
        if let ("base", WallsOverBase::Fixed) = (kind, self.walls_over_base(owner, section)?) {
            return self.base_under_fixed_walls(owner, section, (influence.as_deref(), direction), system);
        }
        // A mass that is not finite is refused at its own key, once all has been read.
        let mass = if mass.is_finite() { mass } else { 1.0 };
        let (kind, origin) = match kind {
            "gravity" => {
                let acceleration = self.measured(owner, section, "acceleration")?;
                (LoadKind::Constant { force: mass * acceleration }, Origin::Gravity(acceleration))
            }
            _ => self.base((index, owner), section, mass, end)?,
        };
        Ok(vec![NewLoad { load: Load { kind, at }, place: Place::Row(Vec::new()), origin }])
    }

    /// `walls` of a base.
    fn walls_over_base(&self, owner: &str, base: &Section<'_>) -> Result<WallsOverBase> {
        match base.word("walls") {
            None => Ok(WallsOverBase::Moving),
            Some(word) if *word.get_ref() == "moving" => Ok(WallsOverBase::Moving),
            Some(word) if *word.get_ref() == "fixed" => Ok(WallsOverBase::Fixed),
            Some(word) => Err(self.refuse(word.span(), &format!("{owner}: base: walls"), "\"moving\" or \"fixed\"")),
        }
    }

    /// The forces of the springs and of the dashpots by which a base moves a structure whose
    /// coordinates are those in space: K ι b and C ι ḃ, with b = −a/ω² of a sine, whose mean is 0.
    fn base_under_fixed_walls(
        &self,
        owner: &str,
        base: &Section<'_>,
        (influence, direction): (Option<&Influence>, Option<&Spanned<f64>>),
        system: &System,
    ) -> Result<Vec<NewLoad>> {
        let refuse = |title: &str, help: &str| {
            let at = base.span_of("walls").unwrap_or(base.span.clone());
            Err(self.source.error(at, &format!("{owner}: walls are fixed, and {title}"), help))
        };
        if base.span_of("file").is_some() || random_key(base).is_some() {
            let help = "expected amplitude, frequency and phase: where a base is whose acceleration alone is known \
                        over time depends on how it began";
            return refuse("the motion of the base is random or read from a file", help);
        }
        if self.is_changed_later {
            let help = "expected no modes, and so no [[turbulence]], which acts through them, and damping other than \
                        by ratios where degrees of freedom have no mass: the forces at the base need the whole \
                        stiffness and damping";
            return refuse("the system is reduced to modes, or damped by ratios once it is condensed", help);
        }
        let [amplitude, frequency, phase] = self.sine(owner, base)?;
        if frequency == 0.0 {
            return refuse("the base leaves without end", "expected a frequency above 0");
        }
        let (n, omega) = (system.degrees_of_freedom(), TAU * frequency);
        let moved = rigid_motion((&self.model, self.n), n, influence);
        let (mut springs, mut dashpots) = (vec![0.0; n], vec![0.0; n]);
        if !self.model.systems().all(is_free) {
            system.add_stiffness(1.0, &moved, &mut springs);
            system.add_damping(1.0, &moved, &mut dashpots);
            self.add_held_inertia(system, &moved, omega, &mut springs)?;
        }
        let way = -amplitude / (omega * omega);
        let mut loads = Vec::new();
        for (forces, size, phase) in [(springs, way, phase), (dashpots, omega * way, phase + FRAC_PI_2)] {
            let largest = forces.iter().fold(0.0, |largest: f64, force| largest.max(force.abs()));
            if largest == 0.0 {
                continue;
            }
            let row = Row::new(forces.iter().map(|force| force / largest).enumerate().filter(|e| e.1 != 0.0).collect());
            let at = self.heading(owner, base, direction, row)?;
            let kind = LoadKind::Harmonic { amplitude: largest * size, frequency, phase };
            let origin = match loads.is_empty() {
                true => Origin::Base { motion: sine_in_words(amplitude, frequency), walls: WallsOverBase::Fixed },
                false => Origin::Dashpots,
            };
            loads.push(NewLoad { load: Load { kind, at }, place: Place::Row(Vec::new()), origin });
        }
        if loads.is_empty() {
            return refuse("nothing ties the structure to the base", "expected springs or dashpots to the ground");
        }
        Ok(loads)
    }

    /// Adds to the forces at b = 1 m those of the inertia of held ends, which reaches the
    /// neighbours on a bar or beam: M ι over all nodes, less that over the nodes that move, times
    /// −b̈ = ω² b.
    fn add_held_inertia(&self, system: &System, moved: &[f64], omega: f64, forces: &mut [f64]) -> Result<()> {
        if self.model.systems().all(|model| model.length().is_none()) {
            return Ok(());
        }
        let (row, mass) = carried((&self.model, 0), system, None)?;
        system.add_mass(-omega * omega, moved, forces);
        row.entries().iter().for_each(|&(i, share)| forces[i] += omega * omega * mass * share);
        Ok(())
    }

    /// Amplitude (m/s²), frequency (Hz) and phase (rad) of a base that moves by a sine.
    fn sine(&self, owner: &str, base: &Section<'_>) -> Result<[f64; 3]> {
        let amplitude = self.measured(owner, base, "amplitude")?;
        let frequency = self.measured(owner, base, "frequency")?;
        let phase = base.number("phase").map_or(Ok(0.0), |_| self.measured(owner, base, "phase"))?;
        if frequency < 0.0 {
            let span = base.span_of("frequency").unwrap_or(base.span.clone());
            return Err(self.refuse(span, &format!("{owner}: frequency"), "a number, 0 or more, in Hz"));
        }
        Ok([amplitude, frequency, phase])
    }

    /// The motion of a base that moves the mass `mass` (kg) until `end` (s): from a file, a sine,
    /// or random.
    fn base(
        &mut self,
        (index, owner): (usize, &str),
        base: &Section<'_>,
        mass: f64,
        end: f64,
    ) -> Result<(LoadKind, Origin)> {
        let sine = ["amplitude", "frequency", "phase"].into_iter().find_map(|key| base.span_of(key));
        let one = "expected file = \"motion.csv\", or amplitude (m/s^2) and frequency (Hz), or rms (m/s^2), from and \
                   to (Hz), or psd = [[Hz, (m/s^2)^2/Hz], ..]";
        let of_file = ["time", "acceleration", "delimiter", "decimal", "scale", "time_scale"].into_iter();
        if let (None, Some(at)) = (base.word("file"), of_file.filter_map(|key| base.span_of(key)).next()) {
            return Err(self.source.error(at, &format!("{owner}: base has no file that this key reads"), one));
        }
        match (sine, base.word("file"), random_key(base)) {
            (Some(at), Some(_), _) | (Some(_), _, Some(at)) | (_, Some(_), Some(at)) => {
                Err(self.source.error(at, &format!("{owner}: base has two motions"), one))
            }
            (None, None, None) => {
                Err(self.source.error(base.span.clone(), &format!("{owner}: base has no motion"), one))
            }
            (None, None, Some(_)) => {
                let NewRandom { force, table, .. } = self.random((index, ACCELERATION), base, mass, end)?;
                Ok((LoadKind::Table(table), Origin::RandomBase { force, mass }))
            }
            (Some(_), None, None) => {
                let [amplitude, frequency, phase] = self.sine(owner, base)?;
                let origin = Origin::Base { motion: sine_in_words(amplitude, frequency), walls: WallsOverBase::Moving };
                Ok((LoadKind::Harmonic { amplitude: -mass * amplitude, frequency, phase }, origin))
            }
            (None, Some(file), None) => {
                let plain = TableColumns { force: "acceleration_m_per_s2".to_owned(), ..TableColumns::default() };
                let owner = format!("{owner}: base");
                let columns = self.columns(&owner, ("acceleration", "m/s^2"), plain, base)?;
                let (path, text) = self.table_file(&owner, &file, &columns)?;
                let felt = TableColumns { scale: -mass * columns.scale, ..columns };
                let motion = format!("as {} says", file.get_ref());
                let origin = Origin::Base { motion, walls: WallsOverBase::Moving };
                Ok((LoadKind::Table(table::read(&path, &text, &felt)?), origin))
            }
        }
    }

    /// The finite number at `key`.
    fn measured(&self, owner: &str, section: &Section<'_>, key: &str) -> Result<f64> {
        match section.number(key).map(Spanned::into_inner) {
            Some(x) if x.is_finite() => Ok(x),
            found => {
                let span = section.span_of(key).unwrap_or(section.span.clone());
                let table = if key == "acceleration" { "gravity" } else { "base" };
                let accepted = accepted(&format!("load.{table}.{key}")).unwrap_or_default();
                let what = if found.is_some() { "is not finite" } else { "is missing" };
                Err(self.source.error(span, &format!("{owner}: {key} {what}"), &format!("expected {accepted}")))
            }
        }
    }

    /// The influence that a load of `kind` states; required of matrices and modal data, and refused
    /// beside other systems.
    fn influence_of(&self, (owner, kind): (&str, &str), base: &Section<'_>) -> Result<Option<Vec<(usize, f64)>>> {
        let influence = base.get("influence").map(|value| self.influence((owner, kind), value)).transpose()?;
        let whole = matches!(self.model, Model::Matrices(_) | Model::Modal(_));
        if let (Model::Bodies(_), Some(unknown)) =
            (&self.model, self.model.systems().find(|model| matches!(model, Model::Matrices(_) | Model::Modal(_))))
        {
            let title = format!("{owner}: {kind} beside a body given by {}", unknown.kind());
            let help = "expected bodies whose displacements are known: oscillators, chains, bars, beams";
            return Err(self.source.error(base.span.clone(), &title, help));
        }
        match (whole, base.span_of("influence")) {
            (true, None) => {
                let title = format!("`influence` is missing in {owner}: {kind}");
                let help = "expected influence = { row = [[0, 1.0], ..] }: how far each degree of freedom moves when \
                            the base moves by 1 m and the structure is rigid";
                Err(self.source.error(base.span.clone(), &title, help))
            }
            (false, Some(at)) => {
                let title = format!("{owner}: {kind}: influence beside a {}", self.model.kind());
                let help = "expected no influence: it is 1 on every displacement; it is for matrices and modal data";
                Err(self.source.error(at, &title, help))
            }
            _ => Ok(influence),
        }
    }

    /// The row M ι/m through which a load of `kind` acts, and the mass m, kg.
    fn moved(
        &self,
        (owner, kind): (&str, &str),
        base: &Section<'_>,
        (influence, direction): (Option<&Influence>, Option<&Spanned<f64>>),
        system: &System,
    ) -> Result<(Row, f64)> {
        let (row, mass) = carried((&self.model, 0), system, influence)?;
        let row = self.heading(owner, base, direction, row)?;
        if mass <= 0.0 {
            let span = base.span_of("influence").unwrap_or(base.span.clone());
            let title = format!("{owner}: {kind}: influence moves no mass");
            return Err(self.source.error(span, &title, "expected the displacements of degrees of freedom with mass"));
        }
        Ok((row, mass))
    }

    /// The `row` of one plane in the direction of a motion of the base.
    fn heading(&self, owner: &str, base: &Section<'_>, direction: Option<&Spanned<f64>>, row: Row) -> Result<Row> {
        Ok(match (self.planes, direction) {
            (Planes::Two(n), Some(direction)) if direction.get_ref().is_finite() => {
                PlaneRows::doubled(&row, n).along(*direction.get_ref())
            }
            (Planes::Two(_), Some(direction)) => {
                return Err(self.refuse(direction.span(), &format!("{owner}: direction"), "a finite number, in deg"));
            }
            (Planes::Two(_), None) => {
                let title = format!("`direction` is missing in {owner}");
                return Err(self.source.error(base.span.clone(), &title, DIRECTION));
            }
            (Planes::One, Some(direction)) => return Err(self.undirected(owner, direction.span())),
            (Planes::Named, Some(direction)) => {
                let help = "expected no direction beside influence, which holds the degrees of freedom of both planes";
                let title = format!("{owner} has an influence and a direction");
                return Err(self.source.error(direction.span(), &title, help));
            }
            (Planes::One | Planes::Named, None) => row,
        })
    }

    /// `{ row = [[0, 1.0], ..] }`.
    fn influence(&self, (owner, kind): (&str, &str), value: &Spanned<Value<'_>>) -> Result<Vec<(usize, f64)>> {
        let key = format!("{owner}: {kind}: influence");
        match value.get_ref() {
            Value::Table(entries) => match entries.as_slice() {
                [(name, row)] if name.get_ref() == "row" => self.row(&format!("{key}: row"), row),
                _ => Err(self.refuse(value.span(), &key, "{ row = [[0, 1.0], ..] }")),
            },
            _ => Err(self.refuse(value.span(), &key, "{ row = [[0, 1.0], ..] }")),
        }
    }
}

/// Where the first key of a random motion of `base` stands.
fn random_key(base: &Section<'_>) -> Option<Range<usize>> {
    ["rms", "from", "to", "psd", "seed"].into_iter().find_map(|key| base.span_of(key))
}

/// True of a bar or beam that nothing ties to the ground.
fn is_free(model: &Model) -> bool {
    match model {
        Model::Bar(bar) => [bar.left, bar.right].iter().all(|end| matches!(end, BarEnd::Free)),
        Model::Beam(beam) => [beam.left, beam.right].iter().all(|end| matches!(end, BeamEnd::Free)),
        _ => false,
    }
}

/// A motion that is a sine, after "the base moves".
fn sine_in_words(amplitude: f64, frequency: f64) -> String {
    format!("by {amplitude} m/s² at {frequency} Hz")
}
