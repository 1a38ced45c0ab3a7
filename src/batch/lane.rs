//! One oscillator of a batch.

use crate::error::{Error, Result};
use crate::scene::{Load, LoadKind, Oscillator, Row, Scene, Side, System, Wall, WallLaw, positive};
use crate::scheme::check_exact;
use std::f64::consts::TAU;

/// Relative tolerance within which a frequency times a period counts as an integer: rounding of
/// both.
const WHOLE: f64 = 1e-9;

/// A wall of an oscillator.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LaneWall {
    /// g, m.
    pub position: f64,
    /// Rigid or elastic.
    pub law: WallLaw,
}

/// One sine of the load: amplitude · sin(2π multiple t/T + phase), with T the lane's period.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sine {
    /// N.
    pub amplitude: f64,
    /// Number of periods of the sine in one period T, 1 or more.
    pub multiple: u32,
    /// rad.
    pub phase: f64,
}

/// One oscillator between two walls or at one, under a load of period T:
///
/// m q̈ + c q̇ + k q = f₀ + Σ A sin(2π n t/T + φ) + r,  g_l ≤ q ≤ g_u.
///
/// ```
/// use signorini::batch::Lane;
/// use signorini::{Load, Scene, Wall};
///
/// let scene = Scene::oscillator(1.0, 0.2, 100.0)
///     .with_wall(Wall::upper("upper", 5e-3).with_restitution(0.8))
///     .with_load(Load::harmonic(3.0, 5.0, 0.0));
/// let lane = Lane::of(&scene, 0.2)?;
/// assert_eq!(lane.sines[0].multiple, 1);
///
/// // What a lane cannot represent is refused with its name.
/// let refused = Lane::of(&scene.with_load(Load::impulse(0.1, 0.5)), 0.2).unwrap_err();
/// assert!(refused.to_string().starts_with("load 2"));
/// # Ok::<(), signorini::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Lane {
    /// m, c, k.
    pub body: Oscillator,
    /// The wall below, if there is one.
    pub lower: Option<LaneWall>,
    /// The wall above.
    pub upper: Option<LaneWall>,
    /// f₀, N.
    pub constant: f64,
    /// T, s: the state is recorded once per period.
    pub period: f64,
    /// The sines of the load.
    pub sines: Vec<Sine>,
    /// Initial displacement, m.
    pub displacement: f64,
    /// Initial velocity, m/s.
    pub velocity: f64,
}

impl Lane {
    /// The oscillator of `scene`, whose state is recorded every `period` (s); the duration of the
    /// scene is ignored.
    ///
    /// # Errors
    /// [`Error::Invalid`] for an invalid scene, or one that a lane cannot represent: a structure, a
    /// second wall on one side, a law that is not linear, an impulse, a table, a function of time,
    /// a sine that does not have an integer number of periods in `period`.
    pub fn of(scene: &Scene, period: f64) -> Result<Self> {
        scene.validate()?;
        positive("period", period)?;
        check_exact(scene, "a lane of a batch")?;
        let System::Oscillator(body) = scene.system else {
            let found = format!("{} degrees of freedom", scene.system.degrees_of_freedom());
            return Err(Error::invalid("system", found, "an oscillator: a lane of a batch has one degree of freedom"));
        };
        let first = |x: &[f64]| x.first().copied().unwrap_or(0.0);
        let mut lane = Self {
            body,
            lower: None,
            upper: None,
            constant: 0.0,
            period,
            sines: Vec::new(),
            displacement: first(&scene.initial.q),
            velocity: first(&scene.initial.v),
        };
        for wall in &scene.walls {
            if *wall.row() != Row::dof(0) {
                let key = format!("wall {:?}: at", wall.name);
                return Err(Error::invalid(
                    key,
                    "a weight",
                    "the displacement itself: a lane of a batch has no levers",
                ));
            }
            let slot = if wall.side() == Side::Upper { &mut lane.upper } else { &mut lane.lower };
            if slot.replace(LaneWall { position: wall.position(), law: wall.law }).is_some() {
                let key = format!("wall {:?}", wall.name);
                return Err(Error::invalid(key, "a second wall on its side", "one wall a side for a lane of a batch"));
            }
        }
        for (index, load) in scene.loads.iter().enumerate() {
            let weight: f64 = load.at.entries().iter().map(|&(_, weight)| weight).sum();
            let refuse = |what: &str| {
                let expected = "a constant or a sine for a lane of a batch; the scheme event takes the others";
                Err(Error::invalid(format!("load {}", index + 1), what, expected))
            };
            match &load.kind {
                LoadKind::Constant { force } => lane.constant += weight * force,
                LoadKind::Harmonic { amplitude, frequency, phase } if *frequency == 0.0 => {
                    lane.constant += weight * amplitude * phase.sin();
                }
                LoadKind::Harmonic { amplitude, frequency, phase } => {
                    let multiple = whole(index, *frequency, period)?;
                    lane.sines.push(Sine { amplitude: weight * amplitude, multiple, phase: *phase });
                }
                LoadKind::Impulse { .. } => return refuse("a blow"),
                LoadKind::Table(_) => return refuse("a table"),
                LoadKind::Function(_) => return refuse("a function of time"),
            }
        }
        lane.validate()?;
        Ok(lane)
    }

    /// Checks all values.
    ///
    /// # Errors
    /// [`Error::Invalid`] for the first invalid value.
    pub fn validate(&self) -> Result<()> {
        positive("period", self.period)?;
        if let Some((index, _)) = self.sines.iter().enumerate().find(|(_, sine)| sine.multiple == 0) {
            return Err(Error::invalid(format!("sine {}: multiple", index + 1), 0, "1 or more"));
        }
        for stop in [self.lower, self.upper].into_iter().flatten() {
            if !stop.law.is_linear() {
                return Err(Error::invalid("wall: law", stop.law.kind(), "a rigid or an elastic wall"));
            }
        }
        self.scene(self.period).validate()
    }

    /// A typical displacement, m: [`Scene::gap_scale`] of its scene.
    pub(super) fn length(&self) -> f64 {
        let positive = |x: &f64| *x > 0.0;
        let both = self.lower.zip(self.upper).map(|(l, u)| 0.5 * (u.position - l.position));
        let walls = || [self.lower, self.upper].into_iter().flatten().map(|stop| stop.position);
        let start = self.displacement;
        both.filter(positive)
            .or_else(|| walls().map(|w| (start - w).abs()).filter(positive).reduce(f64::max))
            .or_else(|| walls().map(f64::abs).filter(positive).reduce(f64::max))
            .or(Some(start.abs()).filter(positive))
            .unwrap_or(1.0)
    }

    /// The scene of this oscillator over `duration` (s): walls `lower` and `upper`.
    #[must_use]
    pub fn scene(&self, duration: f64) -> Scene {
        let Oscillator { mass, damping, stiffness } = self.body;
        let mut scene = Scene::oscillator(mass, damping, stiffness)
            .with_initial(&[self.displacement], &[self.velocity])
            .with_duration(duration);
        if let Some(stop) = self.lower {
            scene = scene.with_wall(Wall { law: stop.law, ..Wall::lower("lower", stop.position) });
        }
        if let Some(stop) = self.upper {
            scene = scene.with_wall(Wall { law: stop.law, ..Wall::upper("upper", stop.position) });
        }
        if self.constant != 0.0 {
            scene = scene.with_load(Load::constant(self.constant));
        }
        let sine = |s: &Sine| Load::harmonic(s.amplitude, f64::from(s.multiple) / self.period, s.phase);
        self.sines.iter().map(sine).fold(scene, Scene::with_load)
    }

    /// The fastest rate of the motion, 1/s: of the body or of a sine.
    pub(super) fn fastest(&self) -> f64 {
        let Oscillator { mass, damping, stiffness } = self.body;
        let (sigma, natural) = (0.5 * damping / mass, stiffness / mass);
        let excess = sigma * sigma - natural;
        let own = if excess > 0.0 { sigma + excess.sqrt() } else { natural.sqrt() };
        self.sines.iter().map(|sine| self.omega(sine)).fold(own, f64::max)
    }

    /// ω of a sine, rad/s.
    pub(super) fn omega(&self, sine: &Sine) -> f64 {
        TAU * f64::from(sine.multiple) / self.period
    }
}

/// The number of periods of load `index`, of `frequency` (Hz), in `period` (s).
fn whole(index: usize, frequency: f64, period: f64) -> Result<u32> {
    let count = frequency * period;
    let near = count.round();
    if near >= 1.0 && near <= f64::from(u32::MAX) && (count - near).abs() <= WHOLE * near {
        Ok(near as u32)
    } else {
        let key = format!("load {}: frequency", index + 1);
        let expected = format!("a multiple of 1/{period:?} Hz: strobes are taken once a period of the whole load");
        Err(Error::invalid(key, format_args!("{frequency:?}"), expected))
    }
}
