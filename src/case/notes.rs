//! Notes that the reader of any run of a case must know.

use super::beam::elements_of_modes;
use super::{Case, Model, Origin, Place, SupportShape, Truncated, WallsOverBase};
use crate::scene::{LoadKind, WallTruncation};
use crate::study::truncation::Start;
use crate::wear::Bearing;

/// Shares below this are not reported.
const WORTH_SAYING: f64 = 1e-2;

impl Case {
    /// The notes of the case, in sentences: what condensation and the reduction to modes changed.
    #[must_use]
    pub fn notes(&self) -> Vec<String> {
        let mut notes = self.condensed();
        notes.extend(self.cut_notes());
        notes.extend(self.open_supports());
        notes.extend(self.unusual_values());
        notes.extend(self.wear_of_one());
        notes.extend(self.scars_on_flats());
        notes.extend(self.start_note());
        notes.extend(self.fixed_walls().map(str::to_owned));
        notes.extend(self.turbulence_notes());
        notes.extend(self.flow_note());
        notes.extend(self.sliders_in_flow());
        notes
    }

    /// Loads that the static equilibrium of the start leaves out.
    fn start_note(&self) -> Option<String> {
        let others = self.scene.loads.iter().any(|load| !matches!(load.kind, LoadKind::Constant { .. }));
        (self.written.start == Start::Equilibrium && others).then(|| {
            "the start is the static equilibrium under the constant loads alone: all other loads begin at t = 0"
                .to_owned()
        })
    }

    /// Coordinates in space, over a base that moves.
    fn fixed_walls(&self) -> Option<&'static str> {
        let fixed = |origin: &Origin| matches!(origin, Origin::Base { walls: WallsOverBase::Fixed, .. });
        self.written.origins.iter().any(fixed).then_some(
            "walls stay fixed in space while the base moves: displacements and velocities, also those of the start, \
             are those in space",
        )
    }

    /// Supports that the structure may leave, since their flats stand within a half turn; opposite
    /// flats bound it both ways along their line.
    fn open_supports(&self) -> impl Iterator<Item = String> {
        self.written.supports.iter().filter_map(|support| {
            let SupportShape::Flats(flats) = &support.shape else { return None };
            let ways: Vec<(f64, f64)> = flats.ways_out().collect();
            let opposite = ways.iter().all(|way| way.1 == 0.0);
            let towards: Vec<String> = ways.iter().map(|way| format!("{}°", way.0)).collect();
            let said = match (ways.is_empty(), opposite) {
                (true, _) => return None,
                (_, true) => format!("leave the motion towards {} free", towards.join(" and ")),
                _ => "stand within a half turn: it bounds the motion on their side only".to_owned(),
            };
            Some(format!("the flats of support {:?} {said}", flats.name))
        })
    }

    /// Supports of one flat between two bodies, of which the other may be round.
    fn scars_on_flats(&self) -> impl Iterator<Item = String> {
        self.written.supports.iter().enumerate().filter_map(|(index, support)| {
            let Place::Relative { to, .. } = &support.place else { return None };
            let Place::On { body, .. } = &**to else { return None };
            let one = matches!(&support.shape, SupportShape::Flats(flats) if flats.flats.len() == 1);
            let flat = self.archard_within(1.0, index)?.scar?.bearing == Bearing::Flat;
            (one && flat).then(|| {
                format!(
                    "the scar at support {:?} is that of a tube on a flat: the body {body:?} is no beam of a round \
                     section, by whose radius it would be that of two tubes",
                    support.name
                )
            })
        })
    }

    /// Supports between two bodies that both wear, of which one is told the depth.
    fn wear_of_one(&self) -> impl Iterator<Item = String> {
        self.written.supports.iter().filter_map(|support| {
            let Place::Relative { place, to } = &support.place else { return None };
            let (Place::On { body: tube, .. }, Place::On { body: other, .. }) = (&**place, &**to) else { return None };
            let wears = support.wear.support_coefficient.or(self.wear.support_coefficient).is_some_and(|k| k > 0.0);
            (tube != other && wears).then(|| {
                let its_depth = match support.shape {
                    SupportShape::Round => "",
                    _ => ": exchange the two, and their wear coefficients, for its depth",
                };
                format!(
                    "at support {:?} depths, limit and the end of the tube are those of the body {tube:?}, which its \
                     `at` names first; of {other:?}, the support there, the worn volume is told{its_depth}",
                    support.name
                )
            })
        })
    }

    /// The degrees of freedom that were condensed, and the walls that this affected.
    fn condensed(&self) -> Vec<String> {
        let Some(condensation) = &self.condensation else { return Vec::new() };
        let (left, kept) = (condensation.massless.len(), condensation.kept.len());
        let mut notes = vec![format!(
            "{left} of {} degrees of freedom have no mass: condensed statically, which is exact",
            left + kept
        )];
        let soft = self.unreduced().walls.iter().zip(&condensation.compliance).filter(|(_, s)| **s > 0.0);
        let names: Vec<String> = soft.clone().map(|(wall, _)| format!("{:?}", wall.name)).collect();
        if let Some(most) = soft.map(|(_, s)| *s).reduce(f64::max) {
            let (walls, push) = if names.len() == 1 { ("wall", "pushes") } else { ("walls", "push") };
            notes.push(format!(
                "the {walls} {} {push} degrees of freedom without mass, whose static compliance is up to {most:.3e} \
                 m/N: a rigid wall there is a spring of that compliance, without restitution, and displacements \
                 recorded there do not include its deflection",
                names.join(", ")
            ));
        }
        notes
    }

    /// That the elements of a beam are long for the fastest of `modes` modes.
    fn coarse_mesh(&self, modes: usize) -> Option<String> {
        let Model::Beam(beam) = &self.model else { return None };
        let needed = elements_of_modes(modes / self.planes.modes());
        (beam.elements < needed).then(|| {
            format!(
                "{} elements are fewer than two and a half in a half wave of the fastest modes, whose frequencies are \
                 too high by more than a few thousandths: elements = {needed}, or left out, resolves them",
                beam.elements
            )
        })
    }

    /// The errors of the reduction to modes.
    fn cut_notes(&self) -> Vec<String> {
        let Some(Truncated { whole, reduction }) = &self.truncated else { return Vec::new() };
        let mut notes = Vec::new();
        let (k, n) = (reduction.modes.count(), reduction.degrees_of_freedom);
        if k == n {
            return notes;
        }
        notes.extend(self.coarse_mesh(k));
        let rigid = whole.scene.walls.iter().zip(&reduction.walls).filter(|(wall, _)| wall.law.is_rigid());
        if whole.static_correction {
            if rigid.clone().count() > 0 {
                notes.push(
                    "static correction: rigid walls are springs with the compliance of the modes left out, \
                     without restitution"
                        .into(),
                );
            }
            if reduction.coupling_neglected > WORTH_SAYING {
                notes.push(format!(
                    "the residual compliance that couples walls at different places is neglected: up to {:.0} % \
                     of their own",
                    100.0 * reduction.coupling_neglected
                ));
            }
        } else if let Some((wall, left)) = rigid.max_by(|a, b| excess(a.1).total_cmp(&excess(b.1))) {
            notes.push(format!(
                "restitution holds with the mass that {k} of {n} modes have at a wall: {:.4} kg at {:?}, where \
                 all modes have {:.4} kg; this mass falls as modes are added, so that impacts become weaker and \
                 more frequent",
                left.mass_kept, wall.name, left.mass
            ));
        }
        if reduction.start_energy_lost > WORTH_SAYING {
            notes.push(format!(
                "the modes left out hold {:.1} % of the initial energy",
                100.0 * reduction.start_energy_lost
            ));
        }
        notes
    }
}

fn excess(left: &WallTruncation) -> f64 {
    left.mass_kept / left.mass
}
