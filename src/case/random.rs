//! Reads random loads, and computes them again for another end of the run.

use super::builder::Builder;
use super::table::{self, TableColumns};
use super::value::Section;
use super::written::{Origin, ScatteredStart};
use super::{Case, Truncated};
use crate::error::{Error, Result};
use crate::scene::{Density, Load, LoadKind, RandomForce, Table};
use std::ops::Range;
use toml::Spanned;

/// The largest seed: whole numbers up to it are exact in a file.
const MOST_SEED: f64 = 9_007_199_254_740_992.0;

/// A random force of more rows than this is worth a word: 17 MB, and a second of computing.
const MANY_ROWS: usize = 1 << 20;

/// What of a load is random: the key of its table, and the units of its values and densities.
#[derive(Debug, Clone, Copy)]
pub(super) struct RandomKind {
    key: &'static str,
    unit: &'static str,
    density_unit: &'static str,
}

/// The force of a load.
pub(super) const FORCE: RandomKind = RandomKind { key: "random", unit: "N", density_unit: "N^2/Hz" };

/// The acceleration of the base.
pub(super) const ACCELERATION: RandomKind = RandomKind { key: "base", unit: "m/s^2", density_unit: "(m/s^2)^2/Hz" };

/// A random force of the file, its table, and the file of its density.
pub(super) struct NewRandom {
    pub force: RandomForce,
    pub table: Table,
    pub file: Option<String>,
}

/// The density of `factor` times what has this one.
fn scaled(density: Density, factor: f64) -> Density {
    match density {
        Density::Flat { rms, from, to } => Density::Flat { rms: factor * rms, from, to },
        Density::Points(points) => Density::Points(points.into_iter().map(|[f, s]| [f, factor * factor * s]).collect()),
    }
}

impl Builder<'_> {
    /// The random force of load `index`, over a run until `end`: `factor` (kg) times an
    /// acceleration of the base, or 1 times a force.
    pub fn random(
        &mut self,
        (index, kind): (usize, RandomKind),
        section: &Section<'_>,
        factor: f64,
        end: f64,
    ) -> Result<NewRandom> {
        let RandomKind { key, unit, density_unit } = kind;
        let owner = format!("load {}: {key}", index + 1);
        let [rms, from, to] = ["rms", "from", "to"].map(|key| section.number(key).map(Spanned::into_inner));
        let or_file = if key == FORCE.key { ", or file = \"psd.csv\"" } else { "" };
        let one = &format!("expected rms ({unit}), from and to (Hz), or psd = [[Hz, {density_unit}], ..]{or_file}");
        // The file of a base is its motion.
        let file = section.word("file").filter(|_| key == FORCE.key);
        let given: Vec<Range<usize>> = [
            ["rms", "from", "to"].iter().find_map(|key| section.span_of(key)),
            section.span_of("psd"),
            file.as_ref().map(Spanned::span),
        ]
        .into_iter()
        .flatten()
        .collect();
        let last = given.iter().max_by_key(|span| span.start).cloned().unwrap_or(section.span.clone());
        let psd = section.get("psd");
        let density = match (rms, from, to, psd, &file) {
            _ if given.len() != 1 => {
                let has = if given.is_empty() { "no density" } else { "two densities" };
                return Err(self.source.error(last, &format!("{owner} has {has}"), one));
            }
            (Some(rms), Some(from), Some(to), ..) => Density::Flat { rms, from, to },
            (_, _, _, Some(psd), _) => {
                let wanted = format!("pairs of a frequency, in Hz, and a density, in {density_unit}");
                Density::Points(self.number_pairs(&format!("{owner}: psd"), psd, &wanted)?)
            }
            (_, _, _, _, Some(file)) => Density::Points(self.density(&owner, file)?),
            _ => {
                let missing = ["rms", "from"].into_iter().find(|key| section.get(key).is_none()).unwrap_or("to");
                let title = format!("`{missing}` is missing in {owner}");
                return Err(self.source.error(section.span.clone(), &title, one));
            }
        };
        let seed = section.number("seed").map_or(Ok(0), |seed| self.seed(&owner, &seed))?;
        density.validate().map_err(|error| self.at_random(&owner, section, error))?;
        let force = RandomForce { density: scaled(density, factor), seed, stream: 2 * index as u64 };
        let table = force.table(end).map_err(|error| self.at_random(&owner, section, error))?;
        Ok(NewRandom { force, table, file: file.map(|file| (*file.get_ref()).to_owned()) })
    }

    pub fn seed(&self, owner: &str, seed: &Spanned<f64>) -> Result<u64> {
        let x = *seed.get_ref();
        if x.fract() == 0.0 && (0.0..=MOST_SEED).contains(&x) {
            Ok(x as u64)
        } else {
            Err(self.refuse(seed.span(), &format!("{owner}: seed"), "a whole number from 0 to 2^53"))
        }
    }

    /// The density in a file.
    fn density(&mut self, owner: &str, file: &Spanned<&str>) -> Result<Vec<[f64; 2]>> {
        let columns = TableColumns {
            time: "frequency_Hz".to_owned(),
            force: "density_N2_per_Hz".to_owned(),
            ..TableColumns::default()
        };
        let owner = format!("{owner}: file");
        let (path, text) = self.open(&owner, file.get_ref(), file.span(), &columns.expected())?;
        let read = table::read(&path, &text, &columns)?;
        Ok(read.time().iter().zip(read.force()).map(|(&f, &s)| [f, s]).collect())
    }

    /// An error of a random force, at the key that it is about.
    fn at_random(&self, owner: &str, section: &Section<'_>, error: Error) -> Error {
        let density = || section.span_of("psd").or(section.span_of("file"));
        self.at_own_key(["random load", owner], section, error, |name| match name {
            "rms" | "from" => section.span_of(name),
            "to" | "band" => section.span_of("to").or_else(density),
            "psd" => density(),
            // An invalid end of the run is refused at its own key.
            _ => None,
        })
    }
}

impl Case {
    /// True if the case has a random load, turbulence, or a start that scatters.
    #[must_use]
    pub fn is_random(&self) -> bool {
        !self.turbulence().is_empty()
            || self.written.scattered.is_some()
            || self.written.origins.iter().any(|origin| origin.random().is_some())
    }

    /// The size of each random force that has more than 2^20 rows, in words: a user who waits for
    /// the case should know what takes the time and the memory.
    pub fn large_random_forces(&self) -> impl Iterator<Item = String> {
        let made = self.written.origins.iter().zip(&self.unreduced().loads).enumerate();
        let single = made.filter_map(|(index, (origin, load))| match (origin.random(), &load.kind) {
            (Some(force), LoadKind::Table(table)) => {
                let rows = table.time().len();
                let [_, to] = force.density.band();
                (rows > MANY_ROWS).then(|| {
                    format!(
                        "load {}: {}: a table of {rows} rows, {:.0} MB: 16 rows and more in a period of {to:e} Hz, \
                         up to {} s",
                        index + 1,
                        origin.seed_key().unwrap_or("random"),
                        16e-6 * rows as f64,
                        self.scene.duration
                    )
                })
            }
            _ => None,
        });
        // The loads of turbulence come after those of the file.
        let turbulent = self.scene.loads.get(self.unreduced().loads.len()..).unwrap_or_default();
        let rows = |load: &Load| if let LoadKind::Table(table) = &load.kind { table.time().len() } else { 0 };
        let values: usize = turbulent.iter().map(rows).sum();
        let fields = (values > MANY_ROWS).then(|| {
            format!(
                "turbulence: tables of {values} values, {:.0} MB, up to {} s",
                8e-6 * values as f64,
                self.scene.duration
            )
        });
        single.chain(fields)
    }

    /// The keys of the seeds of the case, each with its seed: of its random loads, its turbulence
    /// and a start that scatters. Realisation k has each of them greater by k − 1.
    #[must_use]
    pub fn seeds(&self) -> Vec<(String, u64)> {
        // A load of the file has its number in the scene.
        let of = |(index, origin): (usize, &Origin)| {
            Some((format!("load.{}.{}.seed", index + 1, origin.seed_key()?), origin.random()?.seed))
        };
        let loads = self.written.origins.iter().enumerate().filter_map(of);
        let fields = self.truncated.iter().flat_map(|truncated| &truncated.whole.turbulence);
        let fields = fields.map(|field| (format!("turbulence.{}.seed", field.number()), field.seed));
        let start = self.written.scattered.iter().map(|start| ("initial.scatter.seed".to_owned(), start.scatter.seed));
        let mut seeds: Vec<(String, u64)> = loads.chain(fields).chain(start).collect();
        seeds.dedup();
        seeds
    }

    /// Realisation `number` of the case, from 1: the same case, where the seed of every random
    /// load, of turbulence and of a start that scatters is greater by `number` − 1. So realisation
    /// 1 is the case itself, and a run with `seed` set to that value repeats any of the others.
    ///
    /// # Errors
    /// [`Error::Invalid`] under `realisation` for 0, and where a seed would exceed 2^53.
    pub fn realisation(&self, number: u64) -> Result<Self> {
        let Some(more) = number.checked_sub(1) else {
            return Err(Error::invalid("realisation", 0, "1 or more: the first is the case itself"));
        };
        let mut case = self.clone();
        let raised = |seed: &mut u64| -> Result<()> {
            if *seed > MOST_SEED as u64 - more.min(MOST_SEED as u64) {
                let expected =
                    format!("at most {} beside the seed {seed}: seeds go up to 2^53", MOST_SEED as u64 - *seed + 1);
                return Err(Error::invalid("realisation", number, expected));
            }
            *seed += more;
            Ok(())
        };
        for (index, origin) in case.written.origins.iter_mut().enumerate() {
            let key = origin.seed_key();
            let (Origin::Random { force, .. } | Origin::Second(force) | Origin::RandomBase { force, .. }) = origin
            else {
                continue;
            };
            raised(&mut force.seed)?;
            if let Some(key) = key {
                // A load of the file has its number in the scene.
                let key = format!("load.{}.{key}.seed", index + 1).parse()?;
                case.document.set(&key, &(force.seed as i64).into())?;
            }
        }
        for field in case.truncated.iter_mut().flat_map(|truncated| &mut truncated.whole.turbulence) {
            raised(&mut field.seed)?;
            let key = format!("turbulence.{}.seed", field.number()).parse()?;
            case.document.set(&key, &(field.seed as i64).into())?;
        }
        if let Some(start) = &mut case.written.scattered {
            raised(&mut start.scatter.seed)?;
            case.document.set(&"initial.scatter.seed".parse()?, &(start.scatter.seed as i64).into())?;
        }
        case.scatter();
        case.make_random(case.scene.duration)?;
        Ok(case)
    }

    /// Makes the velocities of the start scatter about what they are, if the case asks for it.
    pub(super) fn scatter_start(&mut self) {
        let Some(start) = &mut self.written.scattered else { return };
        start.mean.clone_from(&self.scene.initial.v);
        self.scatter();
    }

    /// Draws the velocities of a start that scatters, in all scenes of the case. The degrees of
    /// freedom of sliders, which come last, do not move.
    fn scatter(&mut self) {
        let Some(ScatteredStart { scatter, mean }) = &self.written.scattered else { return };
        let mut v = mean.clone();
        let structure = v.len().saturating_sub(self.sliders.len());
        scatter.add_to(v.get_mut(..structure).unwrap_or_default());
        if let Some(Truncated { whole, reduction }) = &mut self.truncated {
            whole.scatter = Some(*scatter);
            reduction.scene.initial.v.clone_from(&v);
        }
        self.scene.initial.v = v;
    }

    /// Computes the random forces and those of turbulence again, for a run that ends at `end` (s):
    /// only their tables change.
    ///
    /// # Errors
    /// [`Error::Invalid`] where a random force has no line at this end or too many rows.
    pub(crate) fn make_random(&mut self, end: f64) -> Result<()> {
        let mut tables = Vec::new();
        for (index, origin) in self.written.origins.iter().enumerate() {
            if let Some(force) = origin.random() {
                tables.push((index, force.table(end)?));
            }
        }
        if let Some(Truncated { whole, reduction }) = &mut self.truncated
            && !whole.turbulence.is_empty()
        {
            let loads = whole.turbulent_loads(&reduction.modes, end)?;
            for scene in [&mut reduction.scene, &mut self.scene] {
                scene.loads.truncate(scene.loads.len() - loads.len().min(scene.loads.len()));
                scene.loads.extend_from_slice(&loads);
            }
        }
        let reduced = self.truncated.as_mut();
        let others = reduced.map(|truncated| [&mut truncated.whole.scene, &mut truncated.reduction.scene]);
        for scene in others.into_iter().flatten().chain([&mut self.scene]) {
            for (index, table) in &tables {
                if let Some(load) = scene.loads.get_mut(*index) {
                    load.kind = LoadKind::Table(table.clone());
                }
            }
        }
        Ok(())
    }
}
