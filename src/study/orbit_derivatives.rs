//! The derivatives of a periodic orbit with respect to keys of its scene.

use crate::error::Result;
use crate::orbit::{Event, Orbit, Problem, Shot};
use crate::scene::Scene;
use crate::variation::{ContactDerivative, SceneTangent};

/// The derivatives of a periodic orbit with respect to several keys, of one degree of freedom by
/// its events ([`Problem::derivative`]) or of a structure by its contacts ([`Shot::derivative`]).
///
/// ```
/// use signorini::orbit::Problem;
/// use signorini::study::orbit_derivatives::OrbitDerivatives;
/// use signorini::variation::SceneTangent;
/// use signorini::{Load, Scene, Wall};
///
/// let scene = |amplitude: f64| {
///     Ok(Scene::oscillator(1.0, 0.2, 100.0)
///         .with_wall(Wall::upper("stop", 5e-3).with_restitution(0.6))
///         .with_load(Load::harmonic(amplitude, 2.5, 0.0)))
/// };
/// let problem = Problem::new(scene(3.0)?)?;
/// let orbit = problem.settled(200)?;
/// let by = OrbitDerivatives::of_events(&problem, &orbit, &[SceneTangent::new("amplitude", 3.0, scene)?])?;
/// let [phase, speed] = &by.events[0].numbers[..] else { unreachable!("an impact has both") };
/// assert_eq!((phase.name, speed.name), ("phase", "speed"));
/// assert!(speed.by[0] > 0.0);
/// # Ok::<(), signorini::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct OrbitDerivatives {
    /// Of the forcing period, s per unit of each key.
    pub forcing_period: Vec<f64>,
    /// The events of the whole orbit, or its contacts, in their order.
    pub events: Vec<EventDerivative>,
    /// The Floquet multipliers, the largest first. `None` for a structure, which would need second
    /// derivatives of its run, and where two multipliers coincide: they part like a square root.
    pub multipliers: Option<Vec<MultiplierDerivative>>,
}

/// A Floquet multiplier with its derivatives.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct MultiplierDerivative {
    /// Real and imaginary part.
    pub value: [f64; 2],
    /// Of both, per unit of each key.
    pub by: Vec<[f64; 2]>,
}

/// An event of an orbit with the derivatives of its numbers.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct EventDerivative {
    /// The wall, by its index in the scene.
    pub wall: usize,
    /// Its kind, in a word: `impact`, `rest`; of a structure `impact` or `contact`.
    pub kind: &'static str,
    /// Its phase and speed; of a structure its phase, approach speed and impulse.
    pub numbers: Vec<Differentiated>,
}

/// A number with its derivatives.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Differentiated {
    /// As in a column's name: `phase`, `speed`, `approach_speed`, `impulse`.
    pub name: &'static str,
    /// As in a column's name: `cycles`, `m_per_s`, `N_s`.
    pub unit: &'static str,
    /// The number.
    pub value: f64,
    /// Per unit of each key.
    pub by: Vec<f64>,
}

impl Differentiated {
    fn new([name, unit]: [&'static str; 2], value: f64, by: &[f64]) -> Self {
        Self { name, unit, value, by: by.to_vec() }
    }
}

const PHASE: [&str; 2] = ["phase", "cycles"];

impl OrbitDerivatives {
    /// Those of an orbit of one degree of freedom.
    ///
    /// # Errors
    /// As [`Problem::derivative`].
    pub fn of_events(problem: &Problem, orbit: &Orbit, tangents: &[SceneTangent]) -> Result<Self> {
        let by = problem.derivative(orbit, tangents)?;
        let orbit = problem.whole(orbit);
        let multipliers = problem.floquet(&orbit)?.multipliers;
        let multiplier = |(value, by)| MultiplierDerivative { value, by };
        let phases = orbit.phases.iter().zip(&by.phases);
        let speeds = orbit.speeds.iter().zip(&by.speeds);
        let numbers = phases.map(|(x, by)| Differentiated::new(PHASE, *x, by));
        let numbers = numbers.zip(speeds.map(|(x, by)| Differentiated::new(["speed", "m_per_s"], *x, by)));
        let event = |(event, (phase, speed)): (&Event, (Differentiated, Differentiated))| EventDerivative {
            wall: event.wall,
            kind: event.kind.name(),
            numbers: vec![phase, speed],
        };
        let events = orbit.signature.events.iter().zip(numbers).map(event).collect();
        let multipliers = by.multipliers.map(|by| multipliers.into_iter().zip(by).map(multiplier).collect());
        Ok(Self { forcing_period: by.forcing_period, events, multipliers })
    }

    /// Those of an orbit of `scene` that is known by its state.
    ///
    /// # Errors
    /// As [`Shot::derivative`].
    pub fn of_state(scene: &Scene, shot: &Shot, tangents: &[SceneTangent]) -> Result<Self> {
        let by = shot.derivative(scene, tangents)?;
        let event = |(one, phase): (ContactDerivative<'_>, &Vec<f64>)| EventDerivative {
            wall: one.contact.wall,
            kind: if one.contact.end == Some(one.contact.start) { "impact" } else { "contact" },
            numbers: vec![
                Differentiated::new(PHASE, one.contact.start / shot.forcing_period, phase),
                Differentiated::new(["approach_speed", "m_per_s"], one.contact.approach_speed, one.approach_speed_by),
                Differentiated::new(["impulse", "N_s"], one.contact.impulse, one.impulse_by),
            ],
        };
        let events = by.contacts.iter().zip(&by.phase).map(event).collect();
        Ok(Self { forcing_period: by.forcing_period, events, multipliers: None })
    }
}
