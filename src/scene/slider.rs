//! Sliders: Coulomb friction under a known normal force, in one plane.

use super::friction::FrictionCoefficients;
use super::system::positive;
use super::{
    Face, Load, LoadKind, Modes, Oscillator, PlaneRows, Row, Scene, Side, State, Structure, Support, System, Wall,
    WallLaw,
};
use crate::error::{Error, Result, Subject};
use crate::linear::Symmetric;
use serde::{Deserialize, Serialize};

/// A place that rubs under a known normal force N: a dry-friction damper, a clamped joint, a seal.
///
/// Its friction r obeys Coulomb's law with a constant limit (Tresca's): |r| ≤ μ_s N while the place
/// sticks, r = −μ_k N sign(ẇ) while it slides at the velocity ẇ = g · q̇.
///
/// ```
/// use signorini::{Options, Row, Scene, Scheme, Slider, run};
///
/// // 1 kg on a spring of 1e4 N/m, pressed by 10 N on a flat with μ = 0.1 and released at 0.85 mm.
/// let slider = Slider { name: "pad".to_owned(), at: Row::dof(0), normal_force: 10.0, friction: 0.1.into() };
/// let scene = Scene::oscillator(1.0, 0.0, 1e4).with_initial(&[0.85e-3], &[0.0]).with_duration(0.15);
/// let scene = scene.with_slider(&slider)?;
/// let run = run(&scene, &Scheme::MoreauJean { theta: 0.5 }, &Options::with_step(1e-5))?;
///
/// // Each half swing loses 2 μN/k = 0.2 mm, and it stays where the spring pulls less than μN.
/// let (w, _) = run.trajectory.probe("")?;
/// assert!((w.iter().copied().fold(f64::INFINITY, f64::min) + 0.65e-3).abs() < 1e-8);
/// assert!((w.last().unwrap() - 0.05e-3).abs() < 1e-7);
/// # Ok::<(), signorini::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Slider {
    /// Name: letters, digits, `-` and `_`; results name it among walls and among supports.
    pub name: String,
    /// The row g of the place that slides.
    pub at: Row,
    /// The normal force N, N; above 0.
    pub normal_force: f64,
    /// The coefficients of Coulomb friction.
    pub friction: FrictionCoefficients,
}

impl Slider {
    /// The same slider on a structure in the coordinates of its `modes`.
    #[must_use]
    pub fn on(&self, modes: &Modes) -> Self {
        let at = Row::new(modes.seen(&self.at).into_iter().enumerate().collect());
        Self { at, ..self.clone() }
    }

    /// Refuses a normal force that is not above 0, and coefficients that no wall may have.
    fn validate(&self) -> Result<()> {
        let owner = Subject::slider(&self.name);
        positive(owner.clone().part("normal_force"), self.normal_force)?;
        self.friction.validate(&owner)
    }
}

impl Scene {
    /// The scene with one more slider.
    ///
    /// It is a support of one flat. The structure gets one more degree of freedom, the last one,
    /// which nothing couples to the others: a constant load, the last one, presses it with N on a
    /// rigid flat with e = 0 at which it begins, so that it never moves. The row of that degree of
    /// freedom is the normal of the flat (z of the support), the place of the slider its tangent
    /// (y). So schemes, judge and statistics need no other law of friction. Its mass is that of the
    /// place, m = 1/(g M⁻¹ gᵀ), its damping and stiffness m gCgᵀ/gMgᵀ and m gKgᵀ/gMgᵀ, so that no
    /// scale of the structure changes, in whatever coordinates and units it is.
    ///
    /// # Errors
    /// [`Error::Invalid`] under the slider for a normal force that is not above 0, coefficients
    /// that no wall may have, and a place that nothing moves or that the structure does not have.
    pub fn with_slider(mut self, slider: &Slider) -> Result<Self> {
        slider.validate()?;
        let n = self.system.degrees_of_freedom();
        self.check_row(|| Subject::slider(&slider.name), &slider.at)?;
        let mut along = vec![0.0; n];
        slider.at.add_transposed(1.0, &mut along);
        let structure = self.system.structure();
        let mass = self.masses_along([&slider.at].into_iter()).pop().unwrap_or(f64::INFINITY);
        // Infinite where M is not positive definite, which is refused with the scene.
        let unit = if mass.is_finite() { mass / structure.mass.form(&along, &along) } else { 1.0 };
        let longer = |matrix: &Symmetric| {
            let own = (n, n, unit * matrix.form(&along, &along));
            Symmetric::from_entries(n + 1, matrix.entries().chain([own]))
        };
        let longer = Structure {
            mass: longer(&structure.mass),
            damping: longer(&structure.damping),
            stiffness: longer(&structure.stiffness),
        };
        if slider.at.is_blind() || longer.mass.get(n, n) <= 0.0 {
            let at = Subject::slider(&slider.name).part("at");
            return Err(Error::invalid(at, "a place that nothing moves", "a place that can move"));
        }
        self.system = System::from(longer);
        let State { q, v } = &mut self.initial;
        q.push(0.0);
        v.push(0.0);
        let normal = Row::dof(n);
        let face = Face::Flat { side: Side::Upper, position: 0.0, at: normal.clone(), direction: Some(90.0) };
        let first = self.walls.len();
        self.walls.push(Wall {
            name: slider.name.clone(),
            face,
            law: WallLaw::Rigid { restitution: 0.0 },
            friction: slider.friction,
        });
        self.loads.push(Load { kind: LoadKind::Constant { force: slider.normal_force }, at: normal.clone() });
        self.supports.push(Support {
            name: slider.name.clone(),
            at: PlaneRows { y: slider.at.clone(), z: normal },
            centre: [0.0; 2],
            walls: first..first + 1,
        });
        Ok(self)
    }

    /// True if wall `index` is that of a slider, which alone has the name of its flat support.
    pub(crate) fn is_slider(&self, index: usize) -> bool {
        self.walls.get(index).is_some_and(|wall| {
            !wall.is_round() && self.support_of(index).is_some_and(|support| support.name == wall.name)
        })
    }

    /// The scene without its last `count` sliders, after which nothing but loads was added.
    #[must_use]
    pub fn without_sliders(&self, count: usize) -> Self {
        let n = self.system.degrees_of_freedom().saturating_sub(count);
        let structure = self.system.structure();
        let shorter =
            |matrix: &Symmetric| Symmetric::from_entries(n, matrix.entries().filter(|&(i, j, _)| i < n && j < n));
        let [mass, damping, stiffness] = [&structure.mass, &structure.damping, &structure.stiffness].map(shorter);
        let system = match n {
            1 => {
                let [mass, damping, stiffness] = [&mass, &damping, &stiffness].map(|matrix| matrix.get(0, 0));
                System::Oscillator(Oscillator { mass, damping, stiffness })
            }
            _ => System::from(Structure { mass, damping, stiffness }),
        };
        let mut scene = Self { system, ..self.clone() };
        scene.walls.truncate(self.walls.len().saturating_sub(count));
        scene.supports.truncate(self.supports.len().saturating_sub(count));
        scene.loads.retain(|load| load.at.entries().iter().all(|entry| entry.0 < n));
        scene.initial.q.truncate(n);
        scene.initial.v.truncate(n);
        scene
    }
}
