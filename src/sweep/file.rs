//! Sweep files: the values that vary and the measures, as TOML.

use super::keys::SWEEP;
use super::measure::Measure;
use super::part::{MOST_WHOLE, Part};
use super::picture::{Kind, Picture};
use super::random::Random;
use super::request::{Kernel, MOST_SAMPLES, Sweep, Window};
use super::table::{MOST_SEEDS, SEEDS, UNTIL_INTERVAL};
use super::vary::axis;
use crate::case::{CaseFile, Embedded, Section, Source, read_text, read_values};
use crate::error::{Error, Result};
use crate::study::realisations::RealisationCount;
use std::path::Path;

/// Maximum size of a sweep file, bytes.
const MOST_BYTES: u64 = 1 << 22;

/// A stretch of time of `[run]`.
#[derive(Clone, Copy, Default)]
struct Length {
    periods: Option<u32>,
    seconds: Option<f64>,
}

impl Sweep {
    /// True if the text is that of a sweep file: TOML with a key `case`, which case files do not
    /// have.
    #[must_use]
    pub fn is_file(text: &str) -> bool {
        toml::from_str::<toml::Table>(text).is_ok_and(|table| table.contains_key("case"))
    }

    /// Reads the sweep file at `path`; its case is a file relative to it, or a built-in case.
    ///
    /// ```no_run
    /// use signorini::sweep::{Shard, Sweep, SweepOptions};
    ///
    /// let sweep = Sweep::read("bifurcation.toml".as_ref())?;
    /// let options = SweepOptions { threads: None, shard: Shard::WHOLE, force: false };
    /// sweep.plan()?.run_into("out/bifurcation".as_ref(), options, &|_| ())?;
    /// # Ok::<(), signorini::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Io`] if it cannot be read, [`Error::Case`] with line and column if it is not a
    /// valid sweep file, and the errors of the parts of a sweep.
    pub fn read(path: &Path) -> Result<Self> {
        let failed = |reason: String| Error::io(path.display(), reason, true);
        let text = read_text(path, MOST_BYTES).map_err(failed)?;
        Self::parse(&text, &path.display().to_string(), path.parent().unwrap_or(Path::new("")))
    }

    /// The same from its text, which is called `name` in messages; the case is looked for in
    /// `folder`.
    ///
    /// # Errors
    /// As [`Sweep::read`].
    pub fn parse(text: &str, name: &str, folder: &Path) -> Result<Self> {
        let source = Source { name, text };
        let values = read_values(&source, &SWEEP)?;
        let file = Section::root(&values);
        let mut case = case_file(file.required_word("case").get_ref(), folder)?;
        let part = |table| Part { source: &source, table };
        if let Some(set) = file.get("set") {
            let help = "expected a table: [set] with lines \"wall.*.restitution\" = 0.8";
            let table = Section::of(set).ok_or_else(|| source.error(set.span(), "`set` is no table", help))?;
            let set = part(table);
            for (key, value) in set.table.entries() {
                case.set(&key.get_ref().parse()?, &set.value(value)?)?;
            }
        }
        let mut sweep = Self::new(case);
        for vary in file.sections("vary") {
            sweep = sweep.vary(axis(&part(vary))?);
        }
        if let Some(random) = file.section("random") {
            let random = part(random);
            let (points, seed) = (random.whole_number("points", MOST_WHOLE)?, random.whole_number("seed", MOST_WHOLE)?);
            let design = random.word("kind").unwrap_or_default().parse()?;
            sweep = sweep.drawn(Random { design, points: points.unwrap_or(0), seed });
        }
        if let Some(run) = file.section("run") {
            sweep = sweep.run_as(&part(run))?;
        }
        if let Some(measure) = file.section("measure") {
            let measure = part(measure);
            let columns = measure.table.words("columns").unwrap_or_default();
            let measures = columns.iter().map(|name| name.parse::<Measure>()).collect::<Result<Vec<_>>>()?;
            sweep = sweep.measure(measures);
            let most = measure.whole_number("most_samples", MOST_WHOLE)?.map_or(MOST_SAMPLES, |most| most as usize);
            if let Some(word) = measure.word("samples").filter(|word| word != "no") {
                sweep = sweep.sample(word.parse()?, most);
            }
        }
        if let Some(figure) = file.section("figure") {
            let figure = part(figure);
            let kind = figure.word("kind").map(|word| word.parse::<Kind>()).transpose()?;
            let [x, y, z, wall] = ["x", "y", "z", "wall"].map(|key| figure.word(key));
            sweep.picture = Picture { kind, x, y, z, wall };
        }
        if let Some(stem) = Path::new(name).file_stem() {
            sweep.title = stem.to_string_lossy().into_owned();
        }
        Ok(sweep)
    }

    /// The same sweep with what `run`, the table `[run]`, says.
    fn run_as(self, run: &Part<'_>) -> Result<Self> {
        let mut sweep = self;
        let length = |key: &str| -> Result<Option<Length>> {
            let Some(length) = run.table.section(key).map(|table| Part { source: run.source, table }) else {
                return Ok(None);
            };
            let periods = length.whole_number("periods", f64::from(u32::MAX))?.map(|periods| periods as u32);
            Ok(Some(Length { periods, seconds: length.number("seconds") }))
        };
        sweep.window = window(length("settle")?, length("keep")?)?;
        sweep.scheme = run.word("scheme");
        if let Some(word) = run.word("design") {
            sweep = sweep.laid_out(&word)?;
        }
        sweep.kernel = run.word("kernel").map_or(Ok(Kernel::Scalar), |word| word.parse())?;
        sweep.judged = run.whole_number("judged", MOST_WHOLE)?;
        let seeds = run.whole_number(SEEDS, MOST_WHOLE)?;
        let (share, most) = (run.number(UNTIL_INTERVAL), run.whole_number(MOST_SEEDS, MOST_WHOLE)?);
        sweep.realisations = match (share, most) {
            (None, None) => seeds.map(RealisationCount::Exactly),
            _ => RealisationCount::new(seeds, share, most, None)?,
        };
        Ok(sweep)
    }
}

/// The case of that name in a sweep file.
fn case_file(name: &str, folder: &Path) -> Result<CaseFile> {
    match (CaseFile::found(folder, name), Embedded::named(name)) {
        (None, Ok(embedded)) => CaseFile::embedded(embedded.name),
        (found, _) => CaseFile::read(found.unwrap_or_else(|| folder.join(name))),
    }
}

fn window(settle: Option<Length>, keep: Option<Length>) -> Result<Window> {
    let refuse = |found: &str| {
        let expected = "settle and keep, both as { periods = N } or both as { seconds = T }";
        Err(Error::invalid("[run] settle and keep", found, expected))
    };
    let (first, Some(last)) = (settle.unwrap_or_default(), keep) else {
        return if settle.is_some() { refuse("settle without keep") } else { Ok(Window::Case) };
    };
    match (first.periods, first.seconds, last.periods, last.seconds) {
        (settle, None, Some(keep), None) => Ok(Window::Periods { settle: settle.unwrap_or(0), keep }),
        (None, settle, None, Some(keep)) => Ok(Window::Seconds { settle: settle.unwrap_or(0.0), keep }),
        _ => refuse("both units, or neither"),
    }
}

#[cfg(test)]
mod tests {
    use super::super::axis::Axis;
    use super::super::follow::Follow;
    use super::*;

    const FILE: &str = r#"
case = "rigid-walls-sine"
[set]
"wall.*.restitution" = 0.8
[[vary]]
key = "load.1.harmonic.frequency"
name = "frequency"
from = 4.0
to = 5.0
points = 11
follow = "both"
[[vary]]
keys = ["wall.upper.position", "wall.lower.position"]
factors = [1.0, -1.0]
values = [4e-3, 5e-3]
[run]
scheme = "event"
settle = { periods = 4 }
keep = { periods = 6 }
[measure]
columns = ["contacts", "displacement_max", "period"]
samples = "impacts"
most_samples = 12
[figure]
kind = "bifurcation"
x = "frequency"
y = "approach_speed"
wall = "upper"
"#;

    fn read(text: &str) -> Result<Sweep> {
        Sweep::parse(text, "sweep.toml", Path::new(""))
    }

    #[test]
    fn a_file_says_what_the_library_would() {
        let plan = read(FILE).unwrap().plan().unwrap();
        let built = Sweep::new(CaseFile::embedded("rigid-walls-sine").unwrap())
            .set("wall.*.restitution", 0.8)
            .unwrap()
            .vary(
                Axis::linear("load.1.harmonic.frequency", 4.0, 5.0, 11)
                    .unwrap()
                    .named("frequency")
                    .followed(Follow::Both),
            )
            .vary(
                Axis::list("wall.upper.position", &[4e-3.into(), 5e-3.into()])
                    .unwrap()
                    .tied("wall.lower.position", -1.0)
                    .unwrap(),
            )
            .by("event")
            .over(Window::Periods { settle: 4, keep: 6 })
            .measure([Measure::Contacts, Measure::DisplacementMax, Measure::Period])
            .sample(super::super::Samples::Impacts, 12);
        let built = built.plan().unwrap();
        assert_eq!(plan.request(), built.request());
        assert_eq!((plan.count(), plan.chain_rows()), (44, 22));
        assert_eq!(
            plan.header()[..5],
            ["row", "direction", "frequency_Hz", "wall_upper_position_m", "wall_lower_position_m"]
        );
    }

    #[test]
    fn what_is_wrong_is_named_with_what_would_do() {
        for (from, to, words) in [
            ("points = 11", "points = 1", "2 or more"),
            ("points = 11", "points = 10.5", "a whole number"),
            ("[set]\n", "set = 3\n[other]\n", "unknown key `other` in the sweep file"),
            ("to = 5.0", "to = 4.0", "the range is empty"),
            ("from = 4.0", "from = \"four\"", "--> sweep.toml:8:8"),
            ("points = 11", "pionts = 11", "unknown key `pionts` in `vary`; did you mean `points`?"),
            ("frequency\"\nname", "frequancy\"\nname", "did you mean load.1.harmonic.frequency?"),
            ("load.1.harm", "load.3.harm", "no load is named \"3\"; there is 1"),
            ("follow = \"both\"", "follow = \"back\"", "no direction to follow is named \"back\""),
            (
                "values = [4e-3, 5e-3]",
                "from = 4e-3\nto = 5e-3\npoints = 2\nfollow = \"up\"",
                "one followed [[vary]] at most",
            ),
            ("values = [4e-3, 5e-3]", "values = [\"a\", \"b\"]", "takes a number"),
            ("values = [4e-3, 5e-3]", "values = []", "one value or more"),
            ("values = [4e-3, 5e-3]", "values = [4e-3]\nfrom = 1.0", "several kinds"),
            ("values = [4e-3, 5e-3]", "from = 1e-3\nto = 2e-3", "a table [random] that draws them"),
            ("factors = [1.0, -1.0]", "factors = [1.0]", "one factor a key"),
            ("\"period\"]", "\"perod\"]", "did you mean period?"),
            ("samples = \"impacts\"", "samples = \"impact\"", "did you mean impacts?"),
            ("[run]\n", "[run]\nuntil_interval = 5\n", "until_interval is 5; expected a share above 0 and below 1"),
            ("[run]\n", "[run]\nuntil_interval = 0.05\nseeds = 6\n", "no interval beside a number"),
            ("[run]\n", "[run]\nmost_seeds = 50\n", "until_interval beside it"),
            ("keep = { periods = 6 }", "keep = { periods = 0 }", "one forcing period or more"),
            ("keep = { periods = 6 }", "keep = { periods = 3 }", "4 forcing periods or more for the measure period"),
            ("keep = { periods = 6 }", "keep = { periods = 4294967293 }", "less than 2^32 - 1 periods in all"),
            ("keep = { periods = 6 }", "keep = { seconds = 6 }", "both units"),
            ("keep = { periods = 6 }\n", "", "settle without keep"),
            ("scheme = \"event\"", "scheme = \"evnt\"", "did you mean event?"),
            ("case = \"rigid-walls-sine\"", "case = \"rigid-wals-sine\"", "did you mean rigid-walls-sine?"),
            ("kind = \"bifurcation\"", "kind = \"bifurcaton\"", "did you mean bifurcation?"),
            ("\"wall.*.restitution\" = 0.8", "\"wall.*.restitution\" = 1.8", "expected a number from 0 to 1"),
            ("\"wall.upper.position\", \"wall.low", "\"load.1.harmonic.frequency\", \"wall.low", "each key once"),
        ] {
            let text = FILE.replacen(from, to, 1);
            assert_ne!(text, FILE, "{from}");
            let error = read(&text).and_then(Sweep::plan).unwrap_err();
            assert!(error.is_request() && error.to_string().contains(words), "{to}: {error}");
        }
    }
}
