//! A scene before its reduction to modes, and its reductions.

use crate::error::{Error, Result, Subject};
use crate::scene::{Damping, Load, MOST_DENSE, MOST_MODES, Modes, Reduction, Scatter, Scene, Slider, Turbulence};
use crate::scheme::equilibrium;

/// A wall that feels a mass smaller by more than this share, with more modes, is moved by them.
const LIGHTER: f64 = 0.01;

/// A scene before it is reduced to modes, and how it is reduced.
#[derive(Debug, Clone, PartialEq)]
pub struct Unreduced {
    /// The scene in its own degrees of freedom.
    pub scene: Scene,
    /// Damping that is given to the modes, in place of the scene's own; `None` where the scene's
    /// own is kept.
    pub damping: Option<Damping>,
    /// True if walls get the compliance of the modes left out.
    pub static_correction: bool,
    /// Planes that have each mode, 1 or 2: numbers of modes are multiples of it.
    pub planes: usize,
    /// Where the reduced scene starts.
    pub start: Start,
    /// Fields of force on the modes; their loads come after all others.
    pub turbulence: Vec<Turbulence>,
    /// Sliders, which join the reduced scene: none of them is part of a mode.
    pub sliders: Vec<Slider>,
    /// Deviates of the velocities at the start of the reduced scene; `None` for none.
    pub scatter: Option<Scatter>,
}

/// Where a scene starts.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Start {
    /// From its initial state.
    #[default]
    Given,
    /// At rest in static equilibrium under its constant loads; with fewer modes it is another one.
    Equilibrium,
}

impl Unreduced {
    /// The scene reduced to its `modes` slowest modes.
    ///
    /// # Errors
    /// As [`Scene::reduced`] and [`Scene::with_slider`].
    pub fn cut(&self, modes: usize) -> Result<Reduction> {
        self.check_many(modes)?;
        let reduction = match self.start {
            Start::Given => self.scene.reduced(modes, self.static_correction),
            Start::Equilibrium => self.scene.reduced_without_start(modes, self.static_correction),
        };
        let mut reduction = reduction.map_err(|error| self.of_one_plane(error, modes))?;
        if self.start == Start::Equilibrium {
            reduction.scene.initial.q = equilibrium(&reduction.scene)?;
        }
        if let Some(damping) = &self.damping {
            reduction = reduction.with_damping(damping)?;
        }
        if let Some(scatter) = self.scatter {
            scatter.add_to(&mut reduction.scene.initial.v);
        }
        for slider in &self.sliders {
            reduction.scene = reduction.scene.with_slider(&slider.on(&reduction.modes))?;
        }
        reduction.scene.loads.extend(self.turbulent_loads(&reduction.modes, self.scene.duration)?);
        Ok(reduction)
    }

    /// The reduction with which `reduction` is checked: twice its modes, or four times, eight times
    /// and so on where these do not move every wall; all modes at most. `None` where it has all.
    ///
    /// # Errors
    /// As [`Unreduced::cut`].
    pub(super) fn check_of(
        &self,
        reduction: &Reduction,
        cut: impl Fn(usize) -> Result<Reduction>,
    ) -> Result<Option<Reduction>> {
        let (mut modes, all) = (reduction.modes.count(), reduction.degrees_of_freedom);
        if modes >= all {
            return Ok(None);
        }
        let most = if all <= MOST_DENSE { all } else { (MOST_MODES - 1) / self.planes * self.planes };
        loop {
            modes = (2 * modes).min(all);
            let more = cut(modes)?;
            if 2 * modes > most || reaches_all_walls(reduction, &more) {
                return Ok(Some(more));
            }
        }
    }

    /// The number of modes of the reduction with which `reduction` is checked, see
    /// [`Truncation::of`](super::Truncation::of); `None` where it has all.
    ///
    /// # Errors
    /// As [`Unreduced::cut`].
    pub fn more_modes(&self, reduction: &Reduction) -> Result<Option<usize>> {
        let cut = |modes| self.scene.reduced_without_start(modes, self.static_correction);
        Ok(self.check_of(reduction, cut)?.map(|more| more.modes.count()))
    }

    /// Refuses more `modes` in all planes, with the number of one plane, than are computed of a
    /// large structure: one more than are kept.
    fn check_many(&self, modes: usize) -> Result<()> {
        let (n, most) = (self.scene.system.degrees_of_freedom(), (MOST_MODES - 1) / self.planes);
        if n <= MOST_DENSE || modes <= most * self.planes {
            return Ok(());
        }
        let each = if self.planes > 1 { " in each plane" } else { "" };
        let expected = format!("at most {most}{each}, of a structure with more than {MOST_DENSE} degrees of freedom");
        Err(Error::invalid("modes", modes / self.planes, expected))
    }

    /// The error that `modes` in all planes are too few or too many, with the number of one plane,
    /// which is the one that was asked for.
    fn of_one_plane(&self, error: Error, modes: usize) -> Error {
        match error {
            Error::Invalid { subject, value, expected } if subject == Subject::of("modes") => {
                let value = match value.strip_prefix(&modes.to_string()) {
                    Some(rest) => format!("{}{rest}", modes / self.planes),
                    None => value,
                };
                Error::Invalid { subject, value, expected }
            }
            other => other,
        }
    }

    /// The loads of all fields of turbulence on `modes`, from 0 to `end` (s).
    ///
    /// # Errors
    /// As [`Turbulence::forces`], under the number of the field.
    pub fn turbulent_loads(&self, modes: &Modes, end: f64) -> Result<Vec<Load>> {
        let of = self.turbulence.iter().map(|field| field.forces(modes, end));
        Ok(of.collect::<Result<Vec<_>>>()?.concat())
    }
}

/// True if `more` modes than those of `cut` can show what leaving them out changes at every wall
/// and round support: each of them feels a smaller mass with them, or feels nearly that of the
/// whole structure already. Modes with a node there, or of another body, change nothing and tell
/// nothing.
pub(super) fn reaches_all_walls(cut: &Reduction, more: &Reduction) -> bool {
    cut.walls.iter().zip(&more.walls).all(|(own, more)| {
        own.mass_kept > (1.0 + LIGHTER) * more.mass_kept || own.mass_kept <= (1.0 + LIGHTER) * own.mass
    })
}
