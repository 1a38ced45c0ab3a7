//! Notes on values that are more likely meant in another unit: a run of them is correct and
//! useless.

use super::{Case, Model};
use crate::error::amount;
use crate::scene::{Beam, BeamSection};

/// Least and largest wear coefficient, 1/Pa, of the tables that go with code_aster.
const COEFFICIENTS: [f64; 2] = [1e-17, 1e-12];

/// A damping ratio beyond this is no usual one.
const MOST_RATIO: f64 = 0.5;

/// Young's moduli of solids, Pa: from rubber to beyond diamond.
const YOUNGS_MODULI: [f64; 2] = [1e6, 2e12];

/// Densities of solids, kg/m³: from light foams to beyond osmium. In g/cm³ those of structures are
/// less.
const DENSITIES: [f64; 2] = [25.0, 3e4];

/// A solid of more than this density (kg/m³) is a metal or a ceramic.
const DENSE: f64 = 4e3;

/// Young's moduli of metals, Pa: that of lead, the softest in use, is 1.6e10.
const LEAST_OF_METALS: f64 = 5e9;

/// Shortest service that wear is predicted for, s: of a test rig. Years and weeks are smaller
/// numbers.
const LEAST_SERVICE: f64 = 1e3;

/// Largest dimension of a section, m: that of large pipes and girders.
const MOST_SECTION: f64 = 5.0;

/// A gap beyond this many sections of the beam bounds no motion that a beam makes.
const MOST_GAP: f64 = 2.0;

impl Case {
    /// A note on each kind of value that lies outside of what is usual.
    pub(super) fn unusual_values(&self) -> Vec<String> {
        let own = [
            self.unusual_wear(),
            self.short_service(),
            self.unusual_ratio(),
            self.unusual_gap(),
            self.long_correlation(),
        ];
        self.beams().filter_map(unusual_beam).chain(own.into_iter().flatten()).collect()
    }

    /// The beams, of the system or of bodies.
    fn beams(&self) -> impl Iterator<Item = &Beam> {
        self.model.systems().filter_map(|model| match model {
            Model::Beam(beam) => Some(beam),
            _ => None,
        })
    }

    /// Wear coefficients beyond those of metals in water or air.
    fn unusual_wear(&self) -> Option<String> {
        let own = self.written.supports.iter().flat_map(|s| [s.wear.coefficient, s.wear.support_coefficient]);
        let mut all = own.chain([self.wear.coefficient, self.wear.support_coefficient]).flatten();
        let odd = all.find(|k| outside(*k, COEFFICIENTS))?;
        let [least, most] = COEFFICIENTS;
        Some(format!(
            "the wear coefficient {odd:e} 1/Pa lies outside of what is measured for metals, {least:e} to {most:e} \
             1/Pa: mind the unit (1/Pa = m²/N)"
        ))
    }

    /// A service that is more likely meant in years.
    fn short_service(&self) -> Option<String> {
        let service = self.wear.service.filter(|service| *service < LEAST_SERVICE)?;
        Some(format!("a service of {service:?} s is {} minutes: mind the unit, s", amount(service / 60.0, 2)))
    }

    /// A damping ratio that is more likely meant in per cent.
    fn unusual_ratio(&self) -> Option<String> {
        let ratio = self.written.damping_ratio.filter(|ratio| *ratio > MOST_RATIO)?;
        Some(format!(
            "a damping ratio of {ratio} is {} % of the critical damping: ratios are shares, 0.01 for 1 %",
            amount(100.0 * ratio, 3)
        ))
    }

    /// A gap that is wide beside the section of the thickest beam.
    fn unusual_gap(&self) -> Option<String> {
        let thick = self.beams().map(|beam| widest(beam.section)).reduce(f64::max)?;
        let walls = self.unreduced().walls.iter();
        let (gap, name) =
            walls.map(|wall| (wall.position().abs(), &wall.name)).find(|(gap, _)| *gap > MOST_GAP * thick)?;
        Some(format!(
            "the wall {name:?} stands {} m from the beam's rest, {} times its section of {} m: mind the unit, m",
            amount(gap, 3),
            amount(gap / thick, 2),
            amount(thick, 3)
        ))
    }

    /// A correlation length of turbulence beyond the stretch on which it acts.
    fn long_correlation(&self) -> Option<String> {
        let stretch = |[from, to]: [f64; 2]| to - from;
        let long = self.turbulence().iter().find(|field| field.correlation_length > stretch(field.along))?;
        Some(format!(
            "turbulence {}: its correlation length of {} m is longer than the {} m on which it acts, where measured \
             ones are a few diameters: mind the unit, m",
            long.number(),
            amount(long.correlation_length, 3),
            amount(stretch(long.along), 3)
        ))
    }
}

/// What of a beam lies outside of what solids and structures have.
fn unusual_beam(beam: &Beam) -> Option<String> {
    let section = widest(beam.section);
    let odd = if outside(beam.youngs_modulus, YOUNGS_MODULI) {
        format!("a Young's modulus of {:e} Pa is none of a solid: mind the unit, Pa", beam.youngs_modulus)
    } else if outside(beam.density, DENSITIES) {
        format!("a density of {:?} kg/m³ is none of a structure: mind the unit, kg/m³", beam.density)
    } else if beam.density > DENSE && beam.youngs_modulus < LEAST_OF_METALS {
        format!(
            "a Young's modulus of {:e} Pa is that of no metal, which a density of {:?} kg/m³ is: mind the units, Pa \
             and kg/m³",
            beam.youngs_modulus, beam.density
        )
    } else if section > MOST_SECTION {
        format!("a beam {section:?} m wide and {:?} m long: mind the unit, m", beam.length)
    } else if section > beam.length {
        format!("a beam {section:?} m wide and only {:?} m long: mind the units, m", beam.length)
    } else {
        return None;
    };
    Some(odd)
}

/// The outer diameter of a tube, or the longer side of a rectangle, m.
fn widest(section: BeamSection) -> f64 {
    match section {
        BeamSection::Tube { outer_diameter, .. } => outer_diameter,
        BeamSection::Rectangle { width, height } => width.max(height),
    }
}

fn outside(x: f64, [least, most]: [f64; 2]) -> bool {
    !(least..=most).contains(&x)
}
