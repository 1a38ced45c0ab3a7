//! Walls.

use crate::error::{raise, wrong};
use crate::pickle::{Reduced, State, pickled, unpickled};
use crate::place::Place;
use pyo3::prelude::*;
use serde::{Deserialize, Serialize};
use signorini as sg;

/// A wall, which bounds the displacement of one place on one side: see `Wall.upper` and
/// `Wall.lower`. Walls are equal by value, and can be pickled.
#[pyclass(frozen, eq, module = "signorini", from_py_object)]
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Wall {
    /// Its row is that of the place once it stands in a scene.
    pub wall: sg::Wall,
    pub place: Place,
}

/// The contact law of a wall: rigid unless a stiffness is given.
struct Law {
    restitution: Option<f64>,
    stiffness: Option<f64>,
    damping: Option<f64>,
    exponent: Option<f64>,
    dissipation: Option<f64>,
}

fn wall(wall: sg::Wall, law: Law, at: Place) -> PyResult<Wall> {
    let wall = match (law.restitution, law.stiffness, law.damping) {
        (None, Some(k), None) if law.exponent.is_some() || law.dissipation.is_some() => {
            wall.with_hunt_crossley(k, law.exponent.unwrap_or(1.0), law.dissipation.unwrap_or(0.0))
        }
        _ if law.exponent.or(law.dissipation).is_some() => {
            let what = if law.exponent.is_some() { "exponent" } else { "dissipation" };
            return Err(wrong(
                what,
                "without a stiffness, or beside restitution or damping",
                "a stiffness alone beside it",
            ));
        }
        (Some(e), Some(_), _) => {
            return Err(wrong(
                "restitution",
                format!("{e:?} beside a stiffness"),
                "one of the two: a wall is rigid or elastic",
            ));
        }
        (_, None, Some(c)) => {
            return Err(wrong("damping", format!("{c:?} without a stiffness"), "both, of an elastic wall"));
        }
        (None, Some(k), c) => wall.with_elasticity(k, c.unwrap_or(0.0)),
        (e, None, None) => wall.with_restitution(e.unwrap_or(1.0)),
    };
    // The body starts at the wall, so that the check passes wherever the wall stands.
    let start = if wall.position().is_finite() { wall.position() } else { 0.0 };
    let one = sg::Scene::oscillator(1.0, 0.0, 0.0).with_initial(&[start], &[0.0]).with_wall(wall.clone());
    one.validate().map_err(raise)?;
    Ok(Wall { wall, place: at })
}

#[pymethods]
impl Wall {
    /// A wall above: the displacement may not exceed ``position``.
    ///
    /// Parameters
    /// ----------
    /// name : str
    ///     Letters, digits, ``-`` and ``_``; results are looked up by it.
    /// position : float
    ///     m.
    /// restitution : float, optional
    ///     Of a rigid wall, 0 to 1; the default is 1.
    /// stiffness, damping : float, optional
    ///     N/m and N s/m of an elastic wall.
    /// exponent, dissipation : float, optional
    ///     n from 1 to 10, and α in s/m, of the law of Hunt and Crossley beside a stiffness k in
    ///     N/mⁿ: k sⁿ (1 + α ṡ) at the depth s. The defaults are 1 and 0. The scheme is a penalty.
    /// at : place, optional
    ///     The place: a degree of freedom (from 0), on a bar or beam a position in m, on modal
    ///     data the name of a point, or pairs (degree of freedom or point, weight) for a relative
    ///     motion.
    ///
    /// Returns
    /// -------
    /// Wall
    ///
    /// Raises
    /// ------
    /// ValueError
    ///     For values that make no sense.
    ///
    /// Examples
    /// --------
    /// >>> import signorini as sg
    /// >>> sg.Wall.upper("stop", 5e-3, restitution=0.8)
    /// Wall.upper("stop", 0.005, restitution=0.8)
    #[staticmethod]
    #[pyo3(signature = (name, position, *, restitution=None, stiffness=None, damping=None, exponent=None,
                        dissipation=None, at=Place::Only),
           text_signature = "(name, position, *, restitution=None, stiffness=None, damping=None, exponent=None, \
                             dissipation=None, at=None)")]
    #[expect(clippy::too_many_arguments, reason = "the keywords of Python")]
    fn upper(
        name: &str,
        position: f64,
        restitution: Option<f64>,
        stiffness: Option<f64>,
        damping: Option<f64>,
        exponent: Option<f64>,
        dissipation: Option<f64>,
        at: Place,
    ) -> PyResult<Self> {
        wall(sg::Wall::upper(name, position), Law { restitution, stiffness, damping, exponent, dissipation }, at)
    }

    /// A wall below: the displacement may not fall below ``position``.
    ///
    /// Parameters
    /// ----------
    /// name, position, restitution, stiffness, damping, exponent, dissipation, at
    ///     As in `Wall.upper`.
    ///
    /// Returns
    /// -------
    /// Wall
    ///
    /// Raises
    /// ------
    /// ValueError
    ///     For values that make no sense.
    ///
    /// Examples
    /// --------
    /// >>> import signorini as sg
    /// >>> sg.Wall.lower("pad", -5e-3, stiffness=1e4, damping=20.0)
    /// Wall.lower("pad", -0.005, stiffness=10000.0, damping=20.0)
    #[staticmethod]
    #[pyo3(signature = (name, position, *, restitution=None, stiffness=None, damping=None, exponent=None,
                        dissipation=None, at=Place::Only),
           text_signature = "(name, position, *, restitution=None, stiffness=None, damping=None, exponent=None, \
                             dissipation=None, at=None)")]
    #[expect(clippy::too_many_arguments, reason = "the keywords of Python")]
    fn lower(
        name: &str,
        position: f64,
        restitution: Option<f64>,
        stiffness: Option<f64>,
        damping: Option<f64>,
        exponent: Option<f64>,
        dissipation: Option<f64>,
        at: Place,
    ) -> PyResult<Self> {
        wall(sg::Wall::lower(name, position), Law { restitution, stiffness, damping, exponent, dissipation }, at)
    }

    /// Its name.
    #[getter]
    fn name(&self) -> &str {
        &self.wall.name
    }

    /// Its position, m.
    #[getter]
    fn position(&self) -> f64 {
        self.wall.position()
    }

    /// ``"upper"`` or ``"lower"``.
    #[getter]
    fn side(&self) -> &'static str {
        if self.wall.side() == sg::Side::Upper { "upper" } else { "lower" }
    }

    /// The restitution of a rigid wall; None for an elastic one.
    #[getter]
    fn restitution(&self) -> Option<f64> {
        self.wall.law.restitution()
    }

    /// The stiffness of an elastic wall, N/m, or N/mⁿ with an exponent; None for a rigid one.
    #[getter]
    fn stiffness(&self) -> Option<f64> {
        match self.wall.law {
            sg::WallLaw::Elastic { stiffness, .. } | sg::WallLaw::HuntCrossley { stiffness, .. } => Some(stiffness),
            _ => None,
        }
    }

    /// The exponent of the law of Hunt and Crossley; None for other laws.
    #[getter]
    fn exponent(&self) -> Option<f64> {
        if let sg::WallLaw::HuntCrossley { exponent, .. } = self.wall.law { Some(exponent) } else { None }
    }

    /// The dissipation of the law of Hunt and Crossley, s/m; None for other laws.
    #[getter]
    fn dissipation(&self) -> Option<f64> {
        if let sg::WallLaw::HuntCrossley { dissipation, .. } = self.wall.law { Some(dissipation) } else { None }
    }

    /// The damping of an elastic wall, N s/m; None for a rigid one.
    #[getter]
    fn damping(&self) -> Option<f64> {
        if let sg::WallLaw::Elastic { damping, .. } = self.wall.law { Some(damping) } else { None }
    }

    fn __repr__(&self) -> String {
        let law = match self.wall.law {
            sg::WallLaw::Rigid { restitution } => format!("restitution={restitution:?}"),
            sg::WallLaw::Elastic { stiffness, damping } => format!("stiffness={stiffness:?}, damping={damping:?}"),
            sg::WallLaw::HuntCrossley { stiffness, exponent, dissipation } => {
                format!("stiffness={stiffness:?}, exponent={exponent:?}, dissipation={dissipation:?}")
            }
            other => format!("law={other:?}"),
        };
        let Self { wall, place } = self;
        format!("Wall.{}({:?}, {:?}, {law}{})", self.side(), wall.name, wall.position(), place.argument())
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<Reduced<'py, State<'py>>> {
        Ok((slf.get_type().getattr("_restore")?, pickled(slf.py(), slf.get())?))
    }

    #[staticmethod]
    fn _restore(version: &str, bytes: &[u8]) -> PyResult<Self> {
        unpickled(version, bytes)
    }
}
