//! The rows of a sweep: their values and their columns. A row is determined by its number.

use super::axis::Axis;
use super::forcing;
use super::layout::Layout;
use super::picture::Pictures;
use super::request::{Kernel, Sweep, Window};
use super::table::REALISATION;
use super::target::Target;
use super::until_interval::UntilInterval;
use crate::case::{Case, Key, KeyValue, Template};
use crate::error::{Error, Result};
use crate::output::results::Results;
use crate::scene::{Scene, State};
use crate::scheme::{Method, Scheme};
use crate::study::choice::choose;

/// Maximum number of rows: their places in the journal are kept in memory, 16 bytes each.
pub(super) const MOST_ROWS: u64 = 100_000_000;

/// Maximum number of rows of one chain: they run one after another.
const MOST_CHAIN: u64 = 10_000_000;

/// A sweep that has been checked.
#[derive(Debug, Clone)]
pub struct Plan {
    pub(super) sweep: Sweep,
    /// The case of all rows, without the values that vary.
    pub(super) base: Case,
    /// The method of the rows, unless it varies.
    pub(super) method: Method,
    /// The rows of a chain: number of the value of the followed axis, and direction.
    pub(super) order: Vec<(u64, Option<&'static str>)>,
    pub(super) chains: u64,
    /// The case with placeholders for the values that vary, in the order of the axes.
    template: Template,
    header: Vec<String>,
    /// Names of the columns of `realisations.csv`, where rows have several realisations.
    pub(super) run_header: Option<Vec<String>>,
    /// How many realisations rows have whose own intervals decide.
    pub(super) until: Option<UntilInterval>,
    sample_header: Vec<String>,
    /// The values of the axes in the case itself, where axes are varied one at a time.
    centre: Vec<KeyValue>,
    /// Names of the columns of each axis.
    axis_columns: Vec<Vec<String>>,
}

/// The values of one row.
#[derive(Debug, Clone)]
pub(super) struct Point {
    pub row: u64,
    /// The realisation of its random loads, from 1, where rows have several.
    pub realisation: Option<u64>,
    pub direction: Option<&'static str>,
    /// One value per axis.
    pub values: Vec<KeyValue>,
}

impl Sweep {
    /// The rows of this sweep, after everything that can be checked before they run has been
    /// checked.
    ///
    /// # Errors
    /// [`Error::Invalid`], [`Error::Unknown`] or [`Error::Case`], with the invalid value and what
    /// would be accepted.
    pub fn plan(self) -> Result<Plan> {
        self.check_axes()?;
        let base = self.case.case()?;
        self.check_exact(&base.scene)?;
        let method = match &self.scheme {
            Some(name) => base.method(name)?,
            None if self.kernel == Kernel::Batch => Method::new(Scheme::Event),
            None => choose(&base.scene).method,
        };
        let order = self.order()?;
        let chains = self.chains(order.len() as u64)?;
        self.times(&base)?;
        let axis_columns = self.axis_columns();
        let header = self.header(&base, &axis_columns)?;
        let run_header = self.run_header(&base, &axis_columns);
        let until = run_header.as_ref().and_then(|header| UntilInterval::of(&self, &base.scene, header));
        let mut sample_header = vec!["row".to_owned()];
        sample_header.extend(self.realisations.map(|_| REALISATION.to_owned()));
        sample_header.extend(self.samples.iter().flat_map(|samples| samples.columns(&base.scene)));
        let case_key =
            |(target, _): &(Target, f64)| if let Target::Case(key) = target { Some(key.clone()) } else { None };
        let keys: Vec<Key> = self.axes.iter().flat_map(|axis| &axis.targets).filter_map(case_key).collect();
        let template = Template::new(&self.case, &keys)?;
        let centre = self.centre()?;
        let plan = Plan {
            template,
            sweep: self,
            base,
            method,
            order,
            chains,
            header,
            run_header,
            until,
            sample_header,
            centre,
            axis_columns,
        };
        plan.check_seeds()?;
        plan.check_places()?;
        if plan.sweep.kernel == Kernel::Batch {
            plan.check_batch()?;
        } else {
            plan.check_event()?;
        }
        plan.check_attractor()?;
        plan.try_values()?;
        plan.sweep.picture.check(&plan.request())?;
        Ok(plan)
    }

    /// The rows of a chain: number of the value of the followed axis, and direction.
    fn order(&self) -> Result<Vec<(u64, Option<&'static str>)>> {
        match self.followed().and_then(|index| self.axes.get(index)) {
            Some(axis) if axis.values.count() > MOST_CHAIN => {
                let expected = format!("at most {MOST_CHAIN} along a followed axis");
                Err(Error::invalid("points", axis.values.count(), expected))
            }
            Some(axis) => Ok(axis.order()),
            None => Ok(vec![(0, None)]),
        }
    }

    /// Number of chains of `length` rows each.
    fn chains(&self, length: u64) -> Result<u64> {
        let free = self.axes.iter().enumerate().filter(|(index, _)| Some(*index) != self.followed());
        let grid = free.fold(1u64, |count, (_, axis)| count.saturating_mul(axis.values.count()));
        let chains = self.layout.points(self.axes.len(), grid);
        let rows = chains.saturating_mul(length);
        if rows > MOST_ROWS {
            return Err(Error::invalid("rows", rows, format!("at most {MOST_ROWS}")));
        }
        Ok(chains)
    }
}

impl Plan {
    /// Number of rows.
    #[must_use]
    pub fn count(&self) -> u64 {
        self.chains * self.order.len() as u64
    }

    /// Number of rows of a chain, each of which starts from the end of the last; 1 if no axis is
    /// followed.
    #[must_use]
    pub fn chain_rows(&self) -> u64 {
        self.order.len() as u64
    }

    /// Draws its picture from the tables of `results`, as `sweep.svg`, `sweep.pdf` or `sweep.png`,
    /// and names what it leaves out.
    pub(crate) fn draw(&self, results: &mut Results) -> Result<Pictures> {
        self.sweep.picture.draw(results, &self.request(), &self.sweep.title)
    }

    /// The case without the values that vary.
    #[must_use]
    pub fn case(&self) -> &Case {
        &self.base
    }

    /// The method of the rows, unless it varies.
    #[must_use]
    pub fn method(&self) -> Method {
        self.method
    }

    /// Names of the columns of `sweep.csv`.
    #[must_use]
    pub fn header(&self) -> &[String] {
        &self.header
    }

    /// Names of the columns of `samples.csv`.
    #[must_use]
    pub fn sample_header(&self) -> &[String] {
        &self.sample_header
    }

    /// The axes with the name of the first column of each.
    pub(super) fn axis_columns(&self) -> impl Iterator<Item = (&Axis, &str)> {
        self.sweep.axes.iter().zip(self.axis_columns.iter().map(|columns| columns.first().map_or("", String::as_str)))
    }

    /// Row number `place` of chain number `chain`.
    pub(super) fn point(&self, chain: u64, place: u64) -> Point {
        let (along, direction) = self.order.get(place as usize).copied().unwrap_or((0, None));
        let followed = self.sweep.followed();
        let mut rest = chain;
        let mut values = Vec::with_capacity(self.sweep.axes.len());
        for (index, axis) in self.sweep.axes.iter().enumerate().rev() {
            values.push(match self.sweep.layout {
                Layout::Random(random) => axis.values.at(0, random.share(chain, index)),
                Layout::OneAtATime => match Layout::varied(chain) {
                    Some((varied, share)) if varied == index => axis.values.at(0, share),
                    _ => self.centre.get(index).cloned().unwrap_or_else(|| f64::NAN.into()),
                },
                Layout::Grid if Some(index) == followed => axis.values.at(along, 0.0),
                Layout::Grid => {
                    let number = rest % axis.values.count();
                    rest /= axis.values.count();
                    axis.values.at(number, 0.0)
                }
            });
        }
        values.reverse();
        Point { row: chain * self.chain_rows() + place, realisation: None, direction, values }
    }

    /// True for a row that is judged.
    pub(super) fn is_judged(&self, row: u64) -> bool {
        let judged = self.sweep.rows_judged().min(self.count());
        // The rows ⌈k n/j⌉, k from 0 to j − 1: evenly spread, the first among them.
        judged > 0 && {
            let k = u128::from(row) * u128::from(judged) / u128::from(self.count());
            (k * u128::from(self.count())).div_ceil(u128::from(judged)) == u128::from(row)
        }
    }

    /// The case of `point`, from the state `start` if it follows another row, and its method.
    pub(super) fn build(&self, point: &Point, start: Option<&State>) -> Result<(Case, Method)> {
        let mut values = Vec::new();
        let mut scheme = None;
        for (axis, value) in self.sweep.axes.iter().zip(&point.values) {
            for (target, value) in axis.settings(value) {
                match target {
                    Target::Case(_) => values.push(value),
                    Target::Scheme => scheme = Some(value.to_string()),
                }
            }
        }
        let file = self.template.filled(&values);
        let mut case = match start {
            Some(start) => file.case_from(start)?,
            None => file.case()?,
        };
        if let Some(start) = start.filter(|start| start.q.len() != case.scene.system.degrees_of_freedom()) {
            let found = format!(
                "a key that takes {} degrees of freedom to {}",
                start.q.len(),
                case.scene.system.degrees_of_freedom()
            );
            return Err(Error::invalid("follow", found, "a key that leaves them as they are"));
        }
        let method = match (&scheme, &self.sweep.scheme) {
            (Some(name), _) | (None, Some(name)) => case.method(name)?,
            (None, None) => self.method,
        };
        same_names(&case.scene, &self.base.scene)?;
        let window = match self.sweep.window {
            Window::Case => None,
            Window::Periods { settle, keep } => {
                let period = forcing::period(&case.scene)?;
                Some([f64::from(settle) * period, f64::from(settle + keep) * period])
            }
            Window::Seconds { settle, keep } => Some([settle, settle + keep]),
        };
        if let Some([from, end]) = window {
            case.scene.duration = end;
            case.time.statistics_from = from;
            case.time.sample = case.time.sample.filter(|sample| *sample <= end);
        }
        match point.realisation {
            Some(number @ 2..) => case = case.realisation(number)?,
            // The lines of a random force are multiples of 1/end.
            _ if window.is_some() => case.make_random(case.scene.duration)?,
            _ => {}
        }
        Ok((case, method))
    }
}

/// Rows of one table have the same columns.
fn same_names(scene: &Scene, base: &Scene) -> Result<()> {
    let walls = |scene: &Scene| scene.walls.iter().map(|wall| wall.name.clone()).collect::<Vec<_>>();
    let probes = |scene: &Scene| scene.probes.iter().map(|probe| probe.name.clone()).collect::<Vec<_>>();
    for (what, found, expected) in [("walls", walls(scene), walls(base)), ("probes", probes(scene), probes(base))] {
        if found != expected {
            let expected =
                format!("{}, as in the case itself: rows of one table have one set of columns", expected.join(", "));
            return Err(Error::invalid(what, found.join(", "), expected));
        }
    }
    Ok(())
}
