//! Reads the tables `[[load]]`.

use super::base::Beside;
use super::builder::Builder;
use super::columns::Given;
use super::file;
use super::place::Site;
use super::random::NewRandom;
use super::table::{self, TableColumns};
use super::value::{Number, Section, Value};
use super::written::{NewLoad, Origin};
use crate::error::{Result, Subject};
use crate::scene::{Load, LoadKind, RandomForce, System};
use toml::Spanned;

impl Builder<'_> {
    /// The load in table `index`, for a run until `end` of `system`; of a random load in both
    /// directions the signal along y, then the one along z.
    pub fn load(&mut self, index: usize, load: Section<file::Load>, end: f64, system: &System) -> Result<Vec<NewLoad>> {
        let key = |what: &'static str| Subject::nth("load", index).part(what);
        let file::Load { at, direction, constant, harmonic, impulse, table, random, base } = load.value;
        self.places.push((Subject::nth("load", index), load.span.clone()));
        let given: Vec<_> = [
            ("constant", constant.as_ref().map(|s| s.span.clone())),
            ("harmonic", harmonic.as_ref().map(|s| s.span.clone())),
            ("impulse", impulse.as_ref().map(|s| s.span.clone())),
            ("table", table.as_ref().map(|s| s.span.clone())),
            ("random", random.as_ref().map(|s| s.span.clone())),
            ("base", base.as_ref().map(|s| s.span.clone())),
        ]
        .into_iter()
        .filter_map(|(kind, span)| Some((kind, span?)))
        .collect();
        if let [(first, _), (second, span), ..] = given.as_slice() {
            return Err(self.source.error(
                span.clone(),
                &format!("load {} has two kinds, `{first}` and `{second}`", index + 1),
                "expected one kind in each [[load]]; loads add up, so write a second [[load]]",
            ));
        }
        let owner = format!("load {}", index + 1);
        let both = direction.as_ref().filter(|value| matches!(value.get_ref(), Value::Word(word) if word == "both"));
        if let (Some(both), None) = (both, &random) {
            return Err(self.refuse(
                both.span(),
                &format!("{owner}: direction"),
                "a finite number, in deg; \"both\" is for random loads",
            ));
        }
        let angle = match (both, &direction) {
            (None, Some(value)) => Some(self.angle(&owner, value)?),
            _ => None,
        };
        if let Some(section) = base {
            let beside = Beside { at: at.as_ref(), direction: angle.as_ref() };
            return Ok(vec![self.base(index, &section, &beside, system)?]);
        }
        let mut sites = self.sites((&owner, Subject::nth("load", index)), at.as_ref(), load.span.clone(), true)?;
        let site = sites.pop().ok_or_else(|| self.refuse(load.span.clone(), &owner, "a place"))?;
        let sites = match both {
            Some(both) => self.sites_of_both(&owner, &site, both)?,
            None => vec![self.towards(site, angle.as_ref(), &owner, &load.span)?],
        };
        let stated = |kind: LoadKind| (kind, Origin::Stated);
        let (kind, origin) = match (constant, harmonic, impulse, table, random) {
            (Some(Section { value, .. }), ..) => {
                stated(LoadKind::Constant { force: self.number(key("force"), &value.force) })
            }
            (_, Some(Section { value: sine, .. }), ..) => stated(LoadKind::Harmonic {
                amplitude: self.number(key("amplitude"), &sine.amplitude),
                frequency: self.number(key("frequency"), &sine.frequency),
                phase: self.optional(key("phase"), sine.phase.as_ref()).unwrap_or(0.0),
            }),
            (_, _, Some(Section { value: blow, .. }), ..) => stated(LoadKind::Impulse {
                impulse: self.number(key("impulse"), &blow.impulse),
                time: self.optional(key("time"), blow.time.as_ref()).unwrap_or(0.0),
            }),
            (_, _, _, Some(Section { value: table, .. }), _) => self.table(&owner, &table)?,
            (_, _, _, _, Some(section)) => return self.random_loads(index, &section, end, sites),
            _ => {
                let help = "expected one of constant = { force }, harmonic = { amplitude, frequency, phase }, \
                            impulse = { impulse, time }, table = { file }, random = { rms, from, to, seed }, \
                            base = { file }";
                return Err(self.source.error(load.span, &format!("load {} has no kind", index + 1), help));
            }
        };
        let new = |site: Site| NewLoad { load: Load { kind, at: site.row }, place: site.place, origin };
        Ok(sites.into_iter().next().map(new).into_iter().collect())
    }

    /// A random load at each of `sites`: one, or one along y and one along z.
    fn random_loads(
        &mut self,
        index: usize,
        section: &Section<file::Random>,
        end: f64,
        sites: Vec<Site>,
    ) -> Result<Vec<NewLoad>> {
        let NewRandom { force, table, file } = self.random(index, section, end)?;
        let both = sites.len() > 1;
        let mut loads = Vec::with_capacity(sites.len());
        for (number, site) in sites.into_iter().enumerate() {
            let (table, origin) = match number {
                0 => (table.clone(), Origin::Random { force: force.clone(), file: file.clone(), both }),
                _ => {
                    let force = RandomForce { stream: force.stream + 1, ..force.clone() };
                    (force.table(end)?, Origin::Second(force))
                }
            };
            loads.push(NewLoad {
                load: Load { kind: LoadKind::Table(table), at: site.row },
                place: site.place,
                origin,
            });
        }
        Ok(loads)
    }

    /// The location along y and along z.
    fn sites_of_both(&self, owner: &str, site: &Site, both: &Spanned<Value>) -> Result<Vec<Site>> {
        if !self.planes.is_two() {
            return Err(self.undirected(owner, both.span()));
        }
        let ways = self.both_ways(site)?;
        match ways.len() {
            2 => Ok(ways.into_iter().map(|(_, site)| site).collect()),
            _ => {
                let help = "expected a place that moves along y and along z, which a row does not name";
                Err(self.source.error(both.span(), &format!("{owner} has no place in both planes"), help))
            }
        }
    }

    fn table(&mut self, owner: &str, table: &file::Table) -> Result<(LoadKind, Origin)> {
        let given = Given {
            time: &table.time,
            value: &table.force,
            delimiter: &table.delimiter,
            decimal: &table.decimal,
            scale: &table.scale,
        };
        let owner = format!("{owner}: table");
        let columns = self.columns(&owner, ("force", "N"), TableColumns::default(), &given)?;
        let (path, text) = self.table_file(&owner, &table.file, &columns)?;
        let read = table::read(&path, &text, &columns)?;
        Ok((LoadKind::Table(read), Origin::Table { file: table.file.get_ref().clone(), columns }))
    }

    /// The direction of a load.
    fn angle(&self, owner: &str, direction: &Spanned<Value>) -> Result<Spanned<Number>> {
        match direction.get_ref() {
            Value::Number(x) => Ok(Spanned::new(direction.span(), Number(*x))),
            _ => Err(self.refuse(direction.span(), &format!("{owner}: direction"), "a finite number, in deg")),
        }
    }
}
