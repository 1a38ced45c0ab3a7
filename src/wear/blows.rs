//! Changes of the velocity at supports by the impulses of loads; within a step these come before
//! the contacts.

use crate::scene::{Load, LoadKind, Scene, Support};

/// A load's impulse, as a change of the velocity at a support.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Blow {
    /// Time, s.
    time: f64,
    /// P M⁻¹ gᵀ J along y and z, m/s.
    change: [f64; 2],
}

impl Blow {
    /// The blows of the loads of `scene`, for each of its supports; empty in scenes without
    /// supports.
    pub fn all(scene: &Scene) -> Vec<Vec<Self>> {
        let blow = |load: &Load| match load.kind {
            LoadKind::Impulse { impulse, time } => Some((load.at.clone(), impulse, time)),
            _ => None,
        };
        let blows: Vec<_> = scene.loads.iter().filter_map(blow).collect();
        let mut all = vec![Vec::new(); scene.supports.len()];
        if blows.is_empty() || all.is_empty() {
            return all;
        }
        let structure = scene.system.structure();
        // A scheme refuses a mass matrix that has no factor.
        let Ok(mut mass) = structure.mass_factor() else { return all };
        for (at, impulse, time) in blows {
            let mut x = vec![0.0; structure.mass.size()];
            for &(i, weight) in at.entries() {
                if let Some(x) = x.get_mut(i) {
                    *x += weight * impulse;
                }
            }
            mass.solve(&mut x);
            let at_support = |support: &Support| Self { time, change: support.at.dot(&x) };
            all.iter_mut().zip(&scene.supports).for_each(|(of, support)| of.push(at_support(support)));
        }
        all
    }

    /// The change along t of the normal `normal` by the blows after `from` and up to `to`, m/s.
    pub fn along(blows: &[Self], [y, z]: [f64; 2], [from, to]: [f64; 2]) -> f64 {
        let here = blows.iter().filter(|blow| blow.time > from && blow.time <= to);
        here.map(|blow| y * blow.change[1] - z * blow.change[0]).sum()
    }
}
