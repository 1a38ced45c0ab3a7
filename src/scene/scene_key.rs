//! Keys: the path of a number of a scene.

use super::{Face, LoadKind, Scene, System, WallLaw};
use crate::error::{Error, Result};
use std::fmt;
use std::str::FromStr;

/// The path of a number of a scene, with the words of case files: `wall.NAME.position`,
/// `.restitution`, `.stiffness` and `.damping` of flat walls, `load.N.constant.force`,
/// `load.N.harmonic.amplitude`, `.frequency` and `.phase`, `load.N.impulse.impulse` and `.time`
/// with N counting loads from 1, `initial.displacement.I` and `initial.velocity.I` with I counting
/// degrees of freedom from 0, and `system.oscillator.mass`, `.damping` and `.stiffness`.
///
/// ```
/// use signorini::{Scene, SceneKey, Wall};
///
/// let scene = Scene::oscillator(1.0, 0.2, 100.0).with_wall(Wall::upper("stop", 5e-3));
/// let key: SceneKey = "wall.stop.position".parse()?;
/// assert_eq!(key.value(&scene)?, 5e-3);
/// assert_eq!(key.with(&scene, 6e-3)?.walls[0].position(), 6e-3);
/// let error = "wall.stop.stiffness".parse::<SceneKey>()?.value(&scene).unwrap_err();
/// assert!(error.to_string().contains("wall.stop.restitution"));
/// # Ok::<(), signorini::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct SceneKey(String);

impl SceneKey {
    /// The number of `scene`.
    ///
    /// # Errors
    /// [`Error::Unknown`] for a scene without such a number, with those that it has.
    pub fn value(&self, scene: &Scene) -> Result<f64> {
        let mut own = scene.clone();
        let known: Vec<(String, f64)> = numbers(&mut own).into_iter().map(|(key, number)| (key, *number)).collect();
        match known.iter().find(|(key, _)| *key == self.0) {
            Some((_, number)) => Ok(*number),
            None => {
                let known = known.into_iter().map(|(key, _)| key).collect();
                Err(Error::Unknown { kind: "number of the scene", name: self.0.clone(), known })
            }
        }
    }

    /// `scene` with another number there.
    ///
    /// # Errors
    /// As [`SceneKey::value`].
    pub fn with(&self, scene: &Scene, value: f64) -> Result<Scene> {
        self.value(scene)?;
        let mut changed = scene.clone();
        if let Some((_, number)) = numbers(&mut changed).into_iter().find(|(key, _)| *key == self.0) {
            *number = value;
        }
        Ok(changed)
    }
}

impl fmt::Display for SceneKey {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl FromStr for SceneKey {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self> {
        let text = text.trim();
        if text.split('.').any(str::is_empty) {
            let expected = "the path of a number of a scene, such as wall.stop.restitution";
            return Err(Error::invalid("key", format_args!("{text:?}"), expected));
        }
        Ok(Self(text.to_owned()))
    }
}

/// The numbers of a scene that have keys.
fn numbers(scene: &mut Scene) -> Vec<(String, &mut f64)> {
    let mut all = Vec::new();
    if let System::Oscillator(o) = &mut scene.system {
        let parts = [("mass", &mut o.mass), ("damping", &mut o.damping), ("stiffness", &mut o.stiffness)];
        all.extend(parts.map(|(part, number)| (format!("system.oscillator.{part}"), number)));
    }
    for wall in &mut scene.walls {
        let name = &wall.name;
        let Face::Flat { position, .. } = &mut wall.face else { continue };
        all.push((format!("wall.{name}.position"), position));
        match &mut wall.law {
            WallLaw::Rigid { restitution } => all.push((format!("wall.{name}.restitution"), restitution)),
            WallLaw::Elastic { stiffness, damping } => {
                all.push((format!("wall.{name}.stiffness"), stiffness));
                all.push((format!("wall.{name}.damping"), damping));
            }
            WallLaw::HuntCrossley { stiffness, exponent, dissipation } => {
                all.push((format!("wall.{name}.stiffness"), stiffness));
                all.push((format!("wall.{name}.exponent"), exponent));
                all.push((format!("wall.{name}.dissipation"), dissipation));
            }
            WallLaw::Quartic { .. } => {}
        }
    }
    for (index, load) in scene.loads.iter_mut().enumerate() {
        let key = |part: &str| format!("load.{}.{part}", index + 1);
        match &mut load.kind {
            LoadKind::Constant { force } => all.push((key("constant.force"), force)),
            LoadKind::Harmonic { amplitude, frequency, phase } => {
                all.push((key("harmonic.amplitude"), amplitude));
                all.push((key("harmonic.frequency"), frequency));
                all.push((key("harmonic.phase"), phase));
            }
            LoadKind::Impulse { impulse, time } => {
                all.push((key("impulse.impulse"), impulse));
                all.push((key("impulse.time"), time));
            }
            LoadKind::Table(_) | LoadKind::Function(_) => {}
        }
    }
    for (word, list) in [("displacement", &mut scene.initial.q), ("velocity", &mut scene.initial.v)] {
        all.extend(list.iter_mut().enumerate().map(|(i, number)| (format!("initial.{word}.{i}"), number)));
    }
    all
}
