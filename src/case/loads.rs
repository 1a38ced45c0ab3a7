//! Reads the tables `[[load]]`.

use super::builder::Builder;
use super::place::{Located, Site};
use super::random::{FORCE, NewRandom};
use super::table::{self, TableColumns};
use super::value::{Section, Value};
use super::written::{NewLoad, Origin, WallsOverBase};
use crate::error::{Result, Subject};
use crate::scene::{Load, LoadKind, RandomForce, Scene, System};
use toml::Spanned;

impl Builder<'_> {
    /// Adds the loads of the file to `scene`. What a load adds beyond the first comes last, so that
    /// the loads of the file keep their numbers.
    pub fn loads(&mut self, tables: &[Section<'_>], scene: &mut Scene) -> Result<()> {
        let (mut loads, mut further) = (Vec::new(), Vec::new());
        for (index, table) in tables.iter().enumerate() {
            let mut made = self.load(index, table, scene.duration, &scene.system)?.into_iter();
            loads.extend(made.next());
            self.check_walls_over_base(&loads, table)?;
            further.extend(made);
        }
        for NewLoad { load, place, origin } in loads.into_iter().chain(further) {
            scene.loads.push(load);
            self.written.loads.push(place);
            self.written.origins.push(origin);
        }
        Ok(())
    }

    /// The load in table `index`, for a run until `end` of `system`; of a random load in both
    /// directions the signal along y, then the one along z.
    pub fn load(&mut self, index: usize, load: &Section<'_>, end: f64, system: &System) -> Result<Vec<NewLoad>> {
        let owner = format!("load {}", index + 1);
        self.positions.push((Subject::nth("load", index), load.span.clone()));
        let kinds = ["constant", "harmonic", "impulse", "table", "random", "base", "gravity"];
        let mut given = kinds.into_iter().filter_map(|kind| Some((kind, load.section(kind)?)));
        let (first, second) = (given.next(), given.next());
        if let (Some((first, _)), Some((second, section))) = (&first, second) {
            return Err(self.source.error(
                section.span,
                &format!("{owner} has two kinds, `{first}` and `{second}`"),
                "expected one kind in each [[load]]; loads add up, so write a second [[load]]",
            ));
        }
        let Some((kind, section)) = first else {
            let help = "expected one of constant = { force }, harmonic = { amplitude, frequency, phase }, \
                        impulse = { impulse, time }, table = { file }, random = { rms, from, to, seed }, \
                        base = { file }, { amplitude, frequency, phase } or { rms, from, to, seed }, \
                        gravity = { acceleration }";
            return Err(self.source.error(load.span.clone(), &format!("{owner} has no kind"), help));
        };
        let direction = load.get("direction");
        let both = direction.filter(|value| matches!(value.get_ref(), Value::Word(word) if word == "both"));
        if let Some(both) = both.filter(|_| kind != "random") {
            return Err(self.refuse(
                both.span(),
                &format!("{owner}: direction"),
                "a finite number, in deg; \"both\" is for random loads",
            ));
        }
        let angle = load.number("direction");
        if let Some(other) = direction.filter(|_| both.is_none() && angle.is_none()) {
            return Err(self.refuse(other.span(), &format!("{owner}: direction"), "a finite number, in deg"));
        }
        if let "base" | "gravity" = kind {
            let beside = (load.span_of("at"), angle.as_ref());
            return self.massive((index, &owner, kind), &section, beside, (system, end));
        }
        let mut sites = self.sites((&owner, Subject::nth("load", index)), load, Located::Load)?;
        let site = sites.pop().ok_or_else(|| self.refuse(load.span.clone(), &owner, "a place"))?;
        let sites = match both {
            Some(both) => self.sites_of_both(&owner, &site, both)?,
            None => vec![self.towards(site, angle.as_ref(), &owner, &load.span)?],
        };
        if kind == "random" {
            return self.random_loads(index, &section, end, sites);
        }
        let kind = self.kind(index, kind, &section)?;
        let new = |site: Site| NewLoad { load: Load { kind, at: site.row }, place: site.place, origin: Origin::Stated };
        Ok(sites.into_iter().next().map(new).into_iter().collect())
    }

    /// An error at the last of `loads`, that of `table`, where it is a base with other walls than
    /// an earlier one: displacements cannot be both relative to the base and in space.
    fn check_walls_over_base(&self, loads: &[NewLoad], table: &Section<'_>) -> Result<()> {
        let walls = |new: &NewLoad| new.origin.walls();
        let (Some(base), Some((last, earlier))) = (table.section("base"), loads.split_last()) else { return Ok(()) };
        let other = |new: &NewLoad| walls(new).is_some_and(|walls_there| Some(walls_there) != walls(last));
        let Some(first) = earlier.iter().position(other) else { return Ok(()) };
        let word = |new: &NewLoad| if walls(new) == Some(WallsOverBase::Fixed) { "fixed" } else { "moving" };
        let title = format!(
            "load {}: walls over the base are {:?}, and those of load {} are {:?}",
            loads.len(),
            word(last),
            first + 1,
            word(&earlier[first])
        );
        let help = "expected the same `walls` in every base, \"moving\" where it is left out: displacements are \
                    relative to the base, or those in space";
        Err(self.source.error(base.span_of("walls").unwrap_or(base.span.clone()), &title, help))
    }

    /// A load whose numbers or table stand in `section`.
    fn kind(&mut self, index: usize, kind: &str, section: &Section<'_>) -> Result<LoadKind> {
        let subject = |what: &'static str| Subject::nth("load", index).part(what);
        let mut number = |what| self.required(subject(what), section, what);
        Ok(match kind {
            "constant" => LoadKind::Constant { force: number("force") },
            "harmonic" => LoadKind::Harmonic {
                amplitude: number("amplitude"),
                frequency: number("frequency"),
                phase: self.optional(subject("phase"), section, "phase").unwrap_or(0.0),
            },
            "impulse" => LoadKind::Impulse {
                impulse: number("impulse"),
                time: self.optional(subject("time"), section, "time").unwrap_or(0.0),
            },
            _ => {
                let owner = format!("load {}: table", index + 1);
                let columns = self.columns(&owner, ("force", "N"), TableColumns::default(), section)?;
                let (path, text) = self.table_file(&owner, &section.required_word("file"), &columns)?;
                LoadKind::Table(table::read(&path, &text, &columns)?)
            }
        })
    }

    /// A random load at each of `sites`: one, or one along y and one along z.
    fn random_loads(
        &mut self,
        index: usize,
        section: &Section<'_>,
        end: f64,
        sites: Vec<Site>,
    ) -> Result<Vec<NewLoad>> {
        let NewRandom { force, table, file } = self.random((index, FORCE), section, 1.0, end)?;
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
    fn sites_of_both(&self, owner: &str, site: &Site, both: &Spanned<Value<'_>>) -> Result<Vec<Site>> {
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
}
