//! The loads of a series, order by order.

use super::body::SeriesBody;

/// A sine of the loads, with its amplitude at the current order.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Wave {
    /// A (ω unit)ᵏ/k!, N.
    amplitude: f64,
    /// ω unit.
    radians: f64,
    /// sin θ, cos θ, −sin θ, −cos θ at the start: the derivatives in turn.
    phases: [f64; 4],
}

impl Wave {
    /// The sines of the loads at `start` (s), for a series whose unit is `unit` (s).
    pub(super) fn wind(waves: &mut Vec<Self>, body: &SeriesBody, start: f64, unit: f64) {
        waves.clear();
        for wave in body.loads.iter().flat_map(|(_, forcing)| &forcing.harmonics) {
            let (sin, cos) = (wave.omega * start + wave.phase).sin_cos();
            let phases = [sin, cos, -sin, -cos];
            waves.push(Self { amplitude: wave.amplitude, radians: wave.omega * unit, phases });
        }
    }

    /// Adds the Taylor coefficients in x of the loads, order `k`, to `force`; k goes up by one each
    /// time.
    pub(super) fn push(waves: &mut [Self], body: &SeriesBody, (start, unit): (f64, f64), k: usize, force: &mut [f64]) {
        let mut waves = waves.iter_mut();
        for (row, forcing) in &body.loads {
            let mut value = if k == 0 { forcing.constant } else { 0.0 };
            if k < 2 {
                for table in &forcing.tables {
                    let (at, slope) = table.piece(start);
                    value += if k == 0 { at } else { slope * unit };
                }
            }
            for wave in waves.by_ref().take(forcing.harmonics.len()) {
                if k > 0 {
                    wave.amplitude *= wave.radians / k as f64;
                }
                value += wave.amplitude * wave.phases[k % 4];
            }
            if value != 0.0 {
                row.add_transposed(value, force);
            }
        }
    }
}
