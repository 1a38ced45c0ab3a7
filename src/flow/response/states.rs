//! Displacement and velocity at several times at once.

use super::{Response, Roots};
use crate::elementary::{TOGETHER, exps, sines};
use nalgebra::Complex;

impl Response {
    /// Displacements and velocities at the times in `q`, which they replace: as
    /// [`Response::state`], to the last bit, but with the sines of all times in one loop.
    pub fn states(&self, q: &mut [f64], v: &mut [f64]) {
        let Roots::Pair { omega, powers } = &self.equation.roots else {
            return self.one_by_one(q, v);
        };
        if self.resonant || self.ramped || q.len() > TOGETHER {
            return self.one_by_one(q, v);
        }
        let n = q.len().min(v.len());
        let [mut tau, mut decay, mut sin, mut cos] = [[0.0; TOGETHER]; 4];
        let (tau, decay, sin, cos) = (&mut tau[..n], &mut decay[..n], &mut sin[..n], &mut cos[..n]);
        tau.copy_from_slice(&q[..n]);
        exps(-self.equation.sigma, tau, decay);
        sines((*omega, 0.0), tau, sin, cos);
        let power = powers[0];
        for i in 0..n {
            let z = self.free * Complex::new(decay[i] * cos[i], decay[i] * sin[i]);
            q[i] = z.re + (self.line[0] + self.line[1] * tau[i]);
            v[i] = (power.re * z.re - power.im * z.im) + self.line[1];
        }
        for part in &self.parts {
            let (g, w) = (part.gain, part.omega);
            sines((w, 0.0), tau, sin, cos);
            for i in 0..n {
                q[i] += g.re * sin[i] + g.im * cos[i];
                v[i] += w * (g.re * cos[i] - g.im * sin[i]);
            }
        }
    }

    fn one_by_one(&self, q: &mut [f64], v: &mut [f64]) {
        for (q, v) in q.iter_mut().zip(v) {
            [*q, *v] = self.state(*q);
        }
    }
}
