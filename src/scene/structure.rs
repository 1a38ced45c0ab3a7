//! A structure given by its matrices.

use crate::error::{Error, Result, Subject};
use crate::linear::{Factor, NotDefinite, Symmetric};
use serde::{Deserialize, Serialize};

/// M q̈ + C q̇ + K q = f by matrices, all n × n: M symmetric positive definite (kg), C (N s/m) and
/// K (N/m) symmetric positive semidefinite. In modal coordinates all three may be diagonal. In
/// uncoupled coordinates C may have negative entries, if the damping ratio stays above −1: such a
/// mode is unstable. For coordinates that are rotations, the units are those of the conjugate
/// quantities.
///
/// ```
/// use signorini::linear::Symmetric;
/// use signorini::{Damping, Load, Options, Row, Scene, Scheme, Structure, Wall, run};
///
/// // Two masses of 2 kg, ground – 3e4 N/m – mass – 1e4 N/m – mass; entries of a lower or an upper
/// // triangle.
/// let structure = Structure {
///     mass: Symmetric::diagonal(&[2.0, 2.0]),
///     damping: Symmetric::zeros(2),
///     stiffness: Symmetric::from_entries(2, [(0, 0, 4e4), (1, 0, -1e4), (1, 1, 1e4)]),
/// }
/// .with_damping(&Damping::Rayleigh { mass: 0.0, stiffness: 1e-4 })?;
/// let scene = Scene::structure(structure)
///     .with_wall(Wall::upper("stop", 1e-3).with_restitution(0.5).at(Row::dof(1)))
///     .with_load(Load { at: Row::dof(0), ..Load::harmonic(50.0, 8.0, 0.0) })
///     .with_probe("tip", Row::dof(1));
///
/// let run = run(&scene, &Scheme::MoreauJean { theta: 0.5 }, &Options::with_step(1e-4))?;
/// let (displacement, _) = run.trajectory.probe("tip")?;
/// assert!(displacement.iter().any(|&q| q > 0.99e-3)); // it has met its stop
/// # Ok::<(), signorini::Error>(())
/// ```
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Structure {
    /// M.
    pub mass: Symmetric,
    /// C.
    pub damping: Symmetric,
    /// K.
    pub stiffness: Symmetric,
}

impl Structure {
    /// M + sC + s²K, the matrix of an implicit step.
    pub(crate) fn theta_matrix(&self, s: f64) -> Symmetric {
        Symmetric::sum(&[(1.0, &self.mass), (s, &self.damping), (s * s, &self.stiffness)])
    }
}

/// Refuses invalid matrices; `mass` factors M. Each matrix is factored once, which for a band costs
/// n · width² and so is cheap compared with a run.
pub(super) fn validate(
    structure: &Structure,
    mass: impl FnOnce() -> std::result::Result<(), NotDefinite>,
) -> Result<()> {
    if structure.mass.size() == 0 {
        return Err(Error::invalid("system", "without degrees of freedom", "one or more"));
    }
    for (name, matrix) in
        [("mass", &structure.mass), ("damping", &structure.damping), ("stiffness", &structure.stiffness)]
    {
        of_size(name, matrix, structure.mass.size())?;
        finite_matrix(name, matrix)?;
    }
    definite(&structure.mass, mass)?;
    damped(structure)?;
    semidefinite("stiffness", &structure.stiffness)
}

/// Refuses a matrix without a row for each of the `n` of the mass; it is named as in [`matrix_of`].
pub(crate) fn of_size(name: &str, matrix: &Symmetric, n: usize) -> Result<()> {
    if matrix.size() == n {
        return Ok(());
    }
    let size = format!("{0} × {0}", matrix.size());
    Err(Error::invalid(matrix_of(name), size, format!("{n} × {n}, as the mass")))
}

/// M, C or K by its name.
pub(in crate::scene) fn matrix_of(name: &str) -> Subject {
    Subject::of("system").part(format!("{name} matrix"))
}

/// Refuses entries that are not finite; the matrix is named as in [`matrix_of`].
pub(super) fn finite_matrix(name: &str, matrix: &Symmetric) -> Result<()> {
    let Some((i, j, value)) = matrix.not_finite() else { return Ok(()) };
    Err(Error::invalid(matrix_of(name).entry(i, j), format_args!("{value:?}"), "a finite number"))
}

/// Rounding of an assembled matrix, relative to its diagonal: a semidefinite matrix shifted by this
/// much is definite.
const SHIFT: f64 = 1e-9;

fn definite(mass: &Symmetric, factor: impl FnOnce() -> std::result::Result<(), NotDefinite>) -> Result<()> {
    const EXPECTED: &str = "a positive definite matrix: every motion has kinetic energy";
    let entry = |i: usize, j: usize| matrix_of("mass").entry(i, j);
    let diagonal = mass.diagonal_entries();
    if let Some(i) = diagonal.iter().position(|m| *m <= 0.0) {
        let massless = if diagonal[i] == 0.0 { "; Scene::condensed takes out what has no mass" } else { "" };
        return Err(Error::invalid(
            entry(i, i),
            format_args!("{:?}", diagonal[i]),
            format!("more than 0, of {EXPECTED}{massless}"),
        ));
    }
    if let Some((i, j, value)) =
        mass.entries().find(|&(i, j, x)| i != j && x.abs() >= (diagonal[i] * diagonal[j]).sqrt())
    {
        let most = (diagonal[i] * diagonal[j]).sqrt();
        let expected = format!("less than {most:?} in size, as the diagonal bounds it, of {EXPECTED}");
        return Err(Error::invalid(entry(i, j), format_args!("{value:?}"), expected));
    }
    factor().map_err(|fault| {
        let i = fault.row;
        Error::invalid(entry(i, i), format_args!("{:?}, without a positive pivot", mass.get(i, i)), EXPECTED)
    })
}

/// Refuses an invalid C. In uncoupled coordinates an entry may be negative, if the damping ratio
/// stays above −1.
fn damped(structure: &Structure) -> Result<()> {
    let matrices = [&structure.mass, &structure.damping, &structure.stiffness];
    if matrices.iter().any(|matrix| matrix.half_bandwidth() > 0) {
        return semidefinite("damping", &structure.damping);
    }
    let [m, c, k] = matrices.map(Symmetric::diagonal_entries);
    let least = |i: usize| -2.0 * (m[i] * k[i].max(0.0)).sqrt();
    match (0..c.len()).find(|&i| c[i] < 0.0 && c[i] <= least(i)) {
        None => Ok(()),
        Some(i) => {
            let expected = format!("more than {:?}, a share of critical damping of -1", least(i));
            Err(Error::invalid(matrix_of("damping").entry(i, i), format_args!("{:?}", c[i]), expected))
        }
    }
}

fn semidefinite(name: &str, matrix: &Symmetric) -> Result<()> {
    if matrix.entries().all(|entry| entry.2 == 0.0) {
        return Ok(());
    }
    const EXPECTED: &str = "a positive semidefinite matrix";
    let entry = |i: usize, j: usize| matrix_of(name).entry(i, j);
    let diagonal = matrix.diagonal_entries();
    if let Some(i) = diagonal.iter().position(|x| *x < 0.0) {
        return Err(Error::invalid(
            entry(i, i),
            format_args!("{:?}", diagonal[i]),
            format!("0 or more, of {EXPECTED}"),
        ));
    }
    let most = |i: usize, j: usize| (diagonal[i] * diagonal[j]).sqrt();
    let mut coupled = matrix.entries().filter(|entry| entry.0 != entry.1);
    if let Some((i, j, value)) = coupled.find(|&(i, j, x)| x.abs() > (1.0 + SHIFT) * most(i, j)) {
        let expected = format!("at most {:?} in size, as the diagonal bounds it, of {EXPECTED}", most(i, j));
        return Err(Error::invalid(entry(i, j), format_args!("{value:?}"), expected));
    }
    // Rows with a zero diagonal have no other entries at this point: any shift works.
    let shift: Vec<f64> = diagonal.iter().map(|d| if *d > 0.0 { SHIFT * d } else { 1.0 }).collect();
    let shifted = Symmetric::sum(&[(1.0, matrix), (1.0, &Symmetric::diagonal(&shift))]);
    Factor::new(&shifted).map(|_| ()).map_err(|fault| {
        let i = fault.row;
        Error::invalid(entry(i, i), format_args!("{:?}, with a negative pivot", matrix.get(i, i)), EXPECTED)
    })
}
