//! The flow along a tube that the spectra of its turbulence state.

use super::{FlowPiece, FlowTube};
use crate::error::Result;
use crate::scene::{Row, Turbulence, TurbulenceSpectrum};

/// Edges within this share of the length of each other are one.
const ON_EDGE: f64 = 1e-9;

/// Points and weights of Gauss' rule on [−1, 1], exact up to degree 5.
const GAUSS: [(f64, f64); 3] =
    [(-0.774_596_669_241_483_4, 5.0 / 9.0), (0.0, 8.0 / 9.0), (0.774_596_669_241_483_4, 5.0 / 9.0)];

impl FlowTube {
    /// The tube `body` with the mass per metre `mass_per_metre` (kg/m) in the flows of `fields`,
    /// whose spectra state one; `row` makes the rows of a position (m). Where several flows reach,
    /// that with the largest ρV² counts: fields of lift and drag are those of one flow. `None`
    /// where no field states a flow.
    pub(crate) fn in_flow(
        body: Option<String>,
        mass_per_metre: f64,
        fields: &[&Turbulence],
        row: impl Fn(f64) -> Result<Vec<Row>>,
    ) -> Result<Option<Self>> {
        let flows: Vec<Flow<'_>> = fields.iter().filter_map(|field| Flow::of(field)).collect();
        let Some(first) = flows.first() else { return Ok(None) };
        let mut edges: Vec<f64> = flows.iter().flat_map(Flow::edges).collect();
        edges.sort_by(f64::total_cmp);
        let near = ON_EDGE * (edges.last().unwrap_or(&0.0) - edges.first().unwrap_or(&0.0));
        edges.dedup_by(|b, a| *b - *a <= near);
        let mut pieces = Vec::new();
        for (from, to) in edges.iter().zip(edges.iter().skip(1)) {
            let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
            let pressure = flows.iter().map(|flow| flow.pressure(middle)).fold(0.0, f64::max);
            for (point, weight) in GAUSS {
                pieces.push(FlowPiece { at: row(middle + half * point)?, pressure: pressure * half * weight });
            }
        }
        let Flow { diameter, density, .. } = *first;
        Ok(Some(Self { body, diameter, mass_per_metre, density, pieces }))
    }
}

/// The flow of a field.
struct Flow<'a> {
    along: [f64; 2],
    density: f64,
    diameter: f64,
    velocity: &'a [f64],
}

impl<'a> Flow<'a> {
    /// The flow that the spectrum of `field` states.
    fn of(field: &'a Turbulence) -> Option<Self> {
        match &field.spectrum {
            TurbulenceSpectrum::Flow { density, diameter, velocity, .. } if !velocity.is_empty() => {
                Some(Self { along: field.along, density: *density, diameter: *diameter, velocity })
            }
            _ => None,
        }
    }

    /// Where its cells end, m.
    fn edges(&self) -> impl Iterator<Item = f64> {
        let ([from, to], count) = (self.along, self.velocity.len());
        (0..=count).map(move |cell| from + (to - from) * (cell as f64 / count as f64))
    }

    /// ρV² at `x` (m), Pa.
    fn pressure(&self, x: f64) -> f64 {
        let [from, to] = self.along;
        let cell = (x - from) / (to - from) * self.velocity.len() as f64;
        let velocity = if cell >= 0.0 { self.velocity.get(cell as usize) } else { None };
        velocity.map_or(0.0, |v| self.density * v * v)
    }
}
