//! The scene in which periodic orbits are looked for: a body of one degree of freedom, its walls
//! and loads.

use super::boundary::{Boundary, BoundaryLaw};
use super::signature::{Kind, Signature};
use super::strobe::Scales;
use super::symmetry::mirror;
use crate::error::{Error, Result, Subject};
use crate::flow::{Arc, Start, Support, Touch};
use crate::scene::{Forcing, Oscillator, Scene, System, WallSpring, forcing_period};
use crate::scheme::check_exact;

/// A scene of one degree of freedom whose loads repeat themselves, in which periodic orbits are
/// looked for.
///
/// ```
/// use signorini::orbit::Problem;
/// use signorini::{Load, Scene, Wall};
///
/// // 1 kg, 0.2 N s/m, 100 N/m between walls at ±5 mm under 3 sin(2π 5 t) N: the symmetric orbit of
/// // two impacts a period on which runs settle, and its Floquet multipliers.
/// let scene = Scene::oscillator(1.0, 0.2, 100.0)
///     .with_wall(Wall::upper("upper", 5e-3).with_restitution(0.8))
///     .with_wall(Wall::lower("lower", -5e-3).with_restitution(0.8))
///     .with_load(Load::harmonic(3.0, 5.0, 0.0));
/// let problem = Problem::new(scene)?;
/// let orbit = problem.settled(200)?;
/// assert!((orbit.speeds[0] - 0.169_410_591_358_373_5).abs() < 1e-12); // m/s
/// let multipliers = problem.floquet(&orbit)?.multipliers;
/// assert!(multipliers.iter().all(|m| m[0].hypot(m[1]) < 1.0)); // stable
/// # Ok::<(), signorini::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct Problem {
    scene: Scene,
    body: Oscillator,
    forcing: Forcing,
    boundaries: Vec<Boundary>,
    period: f64,
    length: f64,
    mirror: Option<Vec<usize>>,
}

impl Problem {
    /// Checks `scene`, and takes body, walls and loads from it.
    ///
    /// # Errors
    /// [`Error::Invalid`] for a scene that does not validate, has several degrees of freedom, no
    /// wall, a wall whose law is not linear or that stands behind a lever, or loads without a
    /// common period.
    pub fn new(scene: Scene) -> Result<Self> {
        scene.validate()?;
        check_exact(&scene, "an orbit")?;
        let System::Oscillator(body) = scene.system else {
            return Err(Error::invalid(
                "system",
                "a structure",
                "an oscillator, of one degree of freedom: the orbits of a structure are found by settling and \
                 shooting, or in closed form, and followed by their states, not by signature",
            ));
        };
        if !scene.is_line() {
            return Err(Error::invalid("wall", "behind a lever", "walls that stand on the body itself"));
        }
        if scene.walls.is_empty() {
            return Err(Error::invalid("wall", "none", "a wall: without one all motions settle on the same"));
        }
        let boundary = |wall: &crate::scene::Wall| {
            let law = match (wall.law.restitution(), wall.law.spring()) {
                (Some(restitution), _) => BoundaryLaw::Rigid(restitution),
                (_, Some(WallSpring { stiffness, damping })) => BoundaryLaw::Elastic { stiffness, damping },
                _ => {
                    let key = Subject::wall(&wall.name).part("law");
                    return Err(Error::invalid(key, wall.law.kind(), "a rigid or an elastic wall"));
                }
            };
            Ok(Boundary { position: wall.position(), toward: -wall.side().sign(), law })
        };
        let boundaries = scene.walls.iter().map(boundary).collect::<Result<Vec<_>>>()?;
        let period = forcing_period(&scene)?;
        let forcing = Forcing::on(0, &scene.loads);
        let (length, mirror) = (scene.orbit_length(), mirror(&scene, period));
        Ok(Self { scene, body, forcing, boundaries, period, length, mirror })
    }

    /// The scene.
    #[must_use]
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// The forcing period, s: the common period of all sines.
    #[must_use]
    pub fn forcing_period(&self) -> f64 {
        self.period
    }

    /// True if the scene looks the same in the mirror q → −q half a forcing period later.
    #[must_use]
    pub fn is_symmetric(&self) -> bool {
        self.mirror.is_some()
    }

    pub(super) fn body(&self) -> Oscillator {
        self.body
    }

    pub(super) fn boundary(&self, wall: usize) -> Option<&Boundary> {
        self.boundaries.get(wall)
    }

    pub(super) fn boundaries(&self) -> &[Boundary] {
        &self.boundaries
    }

    pub(super) fn mirror(&self) -> Option<&[usize]> {
        self.mirror.as_deref()
    }

    /// A typical displacement and its product with the forcing's Ω.
    pub(super) fn scales(&self) -> Scales {
        Scales::new(self.length, self.period)
    }

    /// An arc to be filled by [`Problem::fly`].
    pub(super) fn arc(&self) -> Arc {
        Arc::new(self.body, self.boundaries.len(), &self.forcing)
    }

    /// Fills the arc of the body's motion from `state` (m, m/s) at `start` (s) over `span` (s)
    /// against the elastic walls `touching`, or at rest on the wall `support`.
    pub(super) fn fly(
        &self,
        arc: &mut Arc,
        state: [f64; 2],
        [start, span]: [f64; 2],
        touching: &[usize],
        support: Option<usize>,
    ) {
        let from =
            Start { time: start, late: 0.0, state, forcing: &self.forcing, extra: 0.0, span, length: self.length };
        let support = support.and_then(|wall| Some(Support { wall, side: self.scene.walls.get(wall)?.side() }));
        arc.begin(&from, touching.iter().filter_map(|&wall| self.touch(wall)), support);
    }

    /// Wall number `wall` as one that touches; `None` for a rigid one.
    pub(super) fn touch(&self, wall: usize) -> Option<Touch> {
        let Boundary { position, law, .. } = *self.boundaries.get(wall)?;
        match law {
            BoundaryLaw::Elastic { stiffness, damping } => Some(Touch { wall, position, stiffness, damping }),
            BoundaryLaw::Rigid(_) => None,
        }
    }

    /// For each event, the elastic walls in contact after it.
    pub(super) fn touching(&self, signature: &Signature) -> Vec<Vec<usize>> {
        let mut now: Vec<usize> = Vec::new();
        let mut after = Vec::with_capacity(signature.events.len());
        // The first pass finds the walls in contact with which the second begins.
        for turn in 0..2 {
            for event in &signature.events {
                match event.kind {
                    Kind::Enter | Kind::Again if !now.contains(&event.wall) => now.push(event.wall),
                    Kind::Leave => now.retain(|&wall| wall != event.wall),
                    _ => {}
                }
                if turn == 1 {
                    after.push(now.clone());
                }
            }
            if let (true, Some(mirror)) = (signature.symmetric, &self.mirror) {
                now = now.iter().filter_map(|&wall| mirror.get(wall).copied()).collect();
            }
        }
        after
    }

    /// The motion (m, m/s) at t = 0 that no wall meets and that repeats itself: (1 − E) x₀ is the
    /// response from rest over one period, E = e^{AT}.
    ///
    /// # Errors
    /// [`Error::NoOrbit`] at the resonance of an undamped body, which has none.
    pub(super) fn quiet(&self) -> Result<[f64; 2]> {
        let mut arc = self.arc();
        self.fly(&mut arc, [0.0; 2], [0.0, self.period], &[], None);
        let (q, v) = arc.state(arc.end());
        let [[a, b], [c, d]] = arc.propagator();
        let (a, d) = (1.0 - a, 1.0 - d);
        let determinant = a * d - b * c;
        let state = [(d * q + b * v) / determinant, (c * q + a * v) / determinant];
        if state.iter().all(|x| x.is_finite()) && determinant.abs() > 1e-12 {
            Ok(state)
        } else {
            Err(Error::no_orbit(
                "the motion without walls does not repeat itself: the load is in resonance, or the body free",
            ))
        }
    }
}
