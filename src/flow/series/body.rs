//! The structure, its loads and the rows of its walls, prepared for Taylor series.

use super::round::{Round, with_rounds};
use crate::linear::{Factor, Operator, Rows, Symmetric};
use crate::scene::{Forcing, Loads, Row, Scene, Structure, distinct};
use std::cell::{OnceCell, RefCell};

/// M, C and K as operators, the loads by row, and the response to a force on each wall's row.
#[derive(Debug)]
pub(crate) struct SeriesBody {
    /// n.
    pub n: usize,
    /// Behind a cell, since a column is computed when it is first needed.
    mass: RefCell<Factor>,
    pub(super) inertia: Operator,
    /// √Mᵢᵢ, n entries.
    root_mass: Vec<f64>,
    /// C; `None` where it is zero.
    pub(super) damping: Option<Operator>,
    /// K.
    pub(super) stiffness: Operator,
    /// |C| and |K|, entry by entry: they give the sizes of the terms of products.
    sizes: [Operator; 2],
    /// The rows of the loads, each with the loads that act on it.
    pub(super) loads: Vec<(Row, Forcing)>,
    /// The distinct rows of the walls, then one for each round hole, along its normal.
    pub rows: Rows,
    /// The index of the row of each wall, in the scene's order.
    pub row_of: Vec<usize>,
    /// Number of the rows of walls: the rows of holes, which turn, follow them.
    pub fixed: usize,
    /// The round holes, in the scene's order.
    pub rounds: Vec<Round>,
    /// yᵣ = M⁻¹ gᵣᵀ of each row, once it has been needed.
    columns: Vec<OnceCell<Column>>,
    /// Bounds on the free motion: ω² (1/s²), the rate of its damping (1/s) and the fastest load
    /// (rad/s).
    rates: [f64; 3],
}

/// The acceleration that a unit force on a row causes, without its negligible ends: entry `first`
/// and those after it.
#[derive(Debug)]
struct Column {
    first: usize,
    values: Vec<f64>,
    /// Wᵣᵣ, 1/kg.
    own: f64,
}

/// Up to this many entries in all (512 kB), the columns are computed in advance, so that steps do
/// not allocate.
const AT_ONCE: usize = 1 << 16;

/// Motion below this share of the motion that a force causes at its own row is dropped, in the
/// metric of the mass (as in the programmes of impacts).
const NOTHING: f64 = 1e-17;

/// The power method approaches the largest ratio from below; this factor covers its error. Each
/// series also checks its last terms.
const MARGIN: f64 = 1.05;

/// The size of a force counts as at least this share of the largest one: smaller rounding errors do
/// not matter.
const FLOOR: f64 = f64::EPSILON;

/// Iterations of the power method.
const ITERATIONS: usize = 40;

impl SeriesBody {
    /// Prepares `scene`; `None` if its mass matrix cannot be factored, an error that the scene
    /// itself reports.
    pub fn new(scene: &Scene) -> Option<Self> {
        let structure = scene.system.structure();
        let Structure { mass, damping, stiffness } = &*structure;
        let n = mass.size();
        let mut factor = structure.mass_factor().ok()?;
        let flats = || scene.walls.iter().filter(|wall| !wall.is_round());
        let places = distinct(flats().map(|wall| wall.row()));
        let fixed = places.rows.len();
        let mut rows = Rows::new(n, places.rows.iter().map(|row| row.entries()));
        let rounds: Vec<Round> = scene.holes().map(|hole| Round::new(&hole, n, &mut factor)).collect();
        let count = fixed + rounds.len();
        if !rounds.is_empty() {
            rows = with_rounds(n, &rows, &rounds);
        }
        let (mut of_flats, mut of_rounds) = (places.of.iter().copied(), fixed..count);
        let row_of =
            scene.walls.iter().filter_map(|wall| if wall.is_round() { of_rounds.next() } else { of_flats.next() });
        let row_of: Vec<usize> = row_of.collect();
        let loads = Loads::new(&scene.loads).parts().to_vec();
        let waves = loads.iter().flat_map(|(_, forcing)| &forcing.harmonics);
        let load = waves.map(|wave| wave.omega).fold(0.0, f64::max);
        let damped = damping.entries().any(|entry| entry.2 != 0.0);
        let [rub, omega] = structure.ratios(|| {
            let rub = if damped { largest_ratio(mass, &mut factor, damping) } else { 0.0 };
            [rub, largest_ratio(mass, &mut factor, stiffness)]
        });
        let omega = omega.max(scene.system.frequencies()[1].powi(2));
        let absolute = |m: &Symmetric| Symmetric::from_entries(n, m.entries().map(|(i, j, x)| (i, j, x.abs())));
        let mut body = Self {
            n,
            mass: RefCell::new(factor),
            inertia: Operator::new(mass),
            root_mass: mass.diagonal_entries().into_iter().map(f64::sqrt).collect(),
            sizes: [Operator::new(&absolute(damping)), Operator::new(&absolute(stiffness))],
            damping: damped.then(|| Operator::new(damping)),
            stiffness: Operator::new(stiffness),
            loads,
            rows,
            row_of,
            fixed,
            rounds,
            columns: (0..count).map(|_| OnceCell::new()).collect(),
            rates: [MARGIN * omega, MARGIN * rub, load],
        };
        if body.is_small() {
            (0..fixed).for_each(|row| _ = body.column(row));
        }
        for hole in 0..body.rounds.len() {
            body.turn(hole, [1.0, 0.0]);
        }
        Some(body)
    }

    /// Turns the row of a hole to the outward normal `normal`.
    pub fn turn(&mut self, hole: usize, normal: [f64; 2]) {
        let (row, Some(round)) = (self.fixed + hole, self.rounds.get_mut(hole)) else { return };
        round.normal = normal;
        self.rows.row_mut(row).iter_mut().zip(round.row()).for_each(|(entry, turned)| *entry = turned);
        let (first, values, own) = round.column();
        let Some(cell) = self.columns.get_mut(row) else { return };
        if let Some(column) = cell.get_mut() {
            column.own = own;
            column.values.iter_mut().zip(values).for_each(|(value, turned)| *value = turned);
        } else {
            *cell = OnceCell::from(Column { first, values: values.collect(), own });
        }
    }

    /// The hole whose row this is.
    #[inline]
    pub fn round(&self, row: usize) -> Option<&Round> {
        self.rounds.get(row.wrapping_sub(self.fixed))
    }

    /// True if all columns are computed in advance.
    pub fn is_small(&self) -> bool {
        self.n * self.rows.count() <= AT_ONCE
    }

    /// yᵣ = M⁻¹ gᵣᵀ.
    fn column(&self, row: usize) -> &Column {
        self.columns[row].get_or_init(|| {
            let mut y = vec![0.0; self.n];
            self.rows.add_transposed(row, 1.0, &mut y);
            self.mass.borrow_mut().solve(&mut y);
            let own = self.rows.dot(row, &y);
            let least = NOTHING * own.max(0.0).sqrt();
            let counts = |&i: &usize| y[i].abs() * self.root_mass[i] > least;
            let first = (0..self.n).find(counts).unwrap_or(0);
            let end = (first..self.n).rev().find(counts).map_or(first, |last| last + 1);
            Column { first, values: y[first..end].to_vec(), own }
        })
    }

    /// yᵣ · x: the acceleration that the forces x cause at row r.
    #[inline]
    pub fn answer(&self, row: usize, x: &[f64]) -> f64 {
        let Column { first, values, .. } = self.column(row);
        values.iter().zip(&x[*first..]).map(|(y, x)| y * x).sum()
    }

    /// Σ |yᵣ| |x|: the size of the terms of [`Self::answer`]; of a hole in any direction.
    #[inline]
    pub fn answer_size(&self, row: usize, x: &[f64]) -> f64 {
        if let Some(round) = self.round(row) {
            return round.answer_size(x);
        }
        let Column { first, values, .. } = self.column(row);
        values.iter().zip(&x[*first..]).map(|(y, x)| (y * x).abs()).sum()
    }

    /// Adds `force` · yᵣ to `out`.
    #[inline]
    pub fn add_column(&self, row: usize, force: f64, out: &mut [f64]) {
        let Column { first, values, .. } = self.column(row);
        for (out, y) in out[*first..].iter_mut().zip(values) {
            *out += force * y;
        }
    }

    /// Entry (i, j) of the Delassus operator W = G M⁻¹ Gᵀ, 1/kg.
    pub fn delassus(&self, i: usize, j: usize) -> f64 {
        let (row, column) = (i.max(j), self.column(i.min(j)));
        if i == j {
            return column.own;
        }
        let entry = |k: usize| k.checked_sub(column.first).and_then(|k| column.values.get(k)).copied().unwrap_or(0.0);
        self.rows.row(row).iter().map(|&(k, g)| g * entry(k)).sum()
    }

    /// Σ |gⱼ| |xⱼ|; of a hole in any direction.
    pub fn size(&self, row: usize, x: &[f64]) -> f64 {
        if let Some(round) = self.round(row) {
            return round.size(x);
        }
        self.rows.row(row).iter().map(|&(j, g)| (g * x[j]).abs()).sum()
    }

    /// M⁻¹ x in place.
    #[inline]
    pub fn solve(&mut self, x: &mut [f64]) {
        self.mass.get_mut().solve(x);
    }

    /// Adds M x to `out`.
    #[inline]
    pub fn add_inertia(&self, x: &[f64], out: &mut [f64]) {
        self.inertia.add_product(1.0, x, out);
    }

    /// A rate (1/s) that bounds the motion's own rates up to a small factor, with springs and
    /// dashpots (rows, N/m, N s/m) at the walls: for z̈ + 2δż + ω²z = 0 no eigenvalue exceeds δ +
    /// √(δ² + ω²).
    pub(super) fn rate(&self, walls: impl Iterator<Item = (usize, f64, f64)>) -> f64 {
        let [mut square, mut rub, load] = self.rates;
        for (row, stiffness, damping) in walls {
            square += stiffness * self.delassus(row, row);
            rub += damping * self.delassus(row, row);
        }
        let oscillation = square.sqrt();
        // An underdamped oscillation is no faster than the undamped one.
        let own = if rub < 2.0 * oscillation { oscillation } else { rub };
        own.max(load)
    }

    /// Adds |C| v + |K| q to `out`, N: given the sizes of displacement and velocity, the size of
    /// the terms that add up to the force.
    pub fn add_sizes(&self, q: &[f64], v: &[f64], out: &mut [f64]) {
        for (operator, x) in self.sizes.iter().zip([v, q]) {
            operator.add_product(1.0, x, out);
        }
    }

    /// Raises to a floor the sizes of forces that are negligible beside the largest in the metric
    /// of the mass: forces that reach a degree of freedom from others are no more accurate than
    /// those.
    pub fn level_sizes(&self, sizes: &mut [f64]) {
        let largest = sizes.iter().zip(&self.root_mass).fold(0.0, |most, (f, m)| f64::max(most, f / m));
        let floor = FLOOR * largest;
        sizes.iter_mut().zip(&self.root_mass).for_each(|(f, m)| *f = f.max(floor * m));
    }

    /// Adds −C v − K q to `out`, N.
    pub fn add_force(&self, q: &[f64], v: &[f64], out: &mut [f64]) {
        if let Some(damping) = &self.damping {
            damping.add_product(-1.0, v, out);
        }
        self.stiffness.add_product(-1.0, q, out);
    }

    /// Times of the blows (impulsive loads), s, increasing, each once.
    pub fn blow_times(&self) -> Vec<f64> {
        let blows = self.loads.iter().flat_map(|(_, forcing)| &forcing.impulses);
        let mut times: Vec<f64> = blows.map(|&(time, _)| time).collect();
        times.sort_by(f64::total_cmp);
        times.dedup();
        times
    }

    /// The next row of a table after `time`, s.
    pub fn next_corner(&self, time: f64) -> Option<f64> {
        let tables = self.loads.iter().flat_map(|(_, forcing)| &forcing.tables);
        let next =
            |table: &crate::scene::Table| table.time().get(table.time().partition_point(|&t| t <= time)).copied();
        tables.filter_map(next).reduce(f64::min)
    }

    /// Adds the `order`-th derivative of the loads at `t`, from the right, to `out` (N/sᵏ), and the
    /// size of its terms to `size`.
    pub fn add_load(&self, order: u32, t: f64, out: &mut [f64], size: &mut [f64]) {
        for (row, forcing) in &self.loads {
            let (mut value, mut large) =
                if order == 0 { (forcing.constant, forcing.constant.abs()) } else { (0.0, 0.0) };
            for table in &forcing.tables {
                let (at, slope) = table.piece(t);
                let term = [at, slope].get(order as usize).copied().unwrap_or(0.0);
                value += term;
                large += term.abs() + if order == 0 { slope.abs() * t } else { 0.0 };
            }
            for wave in &forcing.harmonics {
                let amplitude = wave.amplitude * wave.omega.powi(order as i32);
                let (sin, cos) = (wave.omega * t + wave.phase).sin_cos();
                value += amplitude * [sin, cos, -sin, -cos][order as usize % 4];
                // The instant itself is known only to an ulp of the time.
                large += amplitude.abs() * (1.0 + wave.omega * t);
            }
            for &(i, weight) in row.entries() {
                if let (Some(out), Some(size)) = (out.get_mut(i), size.get_mut(i)) {
                    *out += weight * value;
                    *size += weight.abs() * large;
                }
            }
        }
    }
}

/// The largest λ of B x = λ M x, by the power method (a lower bound that approaches it).
fn largest_ratio(mass: &Symmetric, factor: &mut Factor, b: &Symmetric) -> f64 {
    let n = mass.size();
    // Where both matrices are diagonal, so is the problem.
    if mass.half_bandwidth() == 0 && b.half_bandwidth() == 0 {
        let pairs = mass.diagonal_entries().into_iter().zip(b.diagonal_entries());
        return pairs.map(|(m, b)| (b / m).abs()).fold(0.0, f64::max);
    }
    let mut x: Vec<f64> = (0..n).map(|i| (1.0 + 0.754_877_666 * i as f64).fract() - 0.4).collect();
    let mut largest = 0.0_f64;
    for _ in 0..ITERATIONS {
        let norm = mass.form(&x, &x).sqrt();
        if norm.is_nan() || norm <= 0.0 {
            break;
        }
        x.iter_mut().for_each(|x| *x /= norm);
        largest = largest.max(b.form(&x, &x));
        let mut y = vec![0.0; n];
        b.add_product(1.0, &x, &mut y);
        factor.solve(&mut y);
        x = y;
    }
    largest
}
