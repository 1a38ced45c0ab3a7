//! A root of a function of one number, between two points.

/// Halvings and secant steps that locate a root.
const STEPS: usize = 80;

/// A root of `f` between `from` and `to`, where its signs differ, to the last digits: by secants
/// where they stay inside and converge, else by halving (the Illinois method).
pub(crate) fn bisect(mut f: impl FnMut(f64) -> f64, from: f64, to: f64) -> f64 {
    let (mut a, mut b) = (from, to);
    let (mut fa, mut fb) = (f(a), f(b));
    for _ in 0..STEPS {
        let mut c = b - fb * (b - a) / (fb - fa);
        let inside = c.is_finite() && (c - a) * (c - b) < 0.0;
        if !inside {
            c = 0.5 * (a + b);
        }
        if c == a || c == b {
            break;
        }
        let fc = f(c);
        if fc == 0.0 {
            return c;
        }
        if fc * fb < 0.0 {
            (a, fa) = (b, fb);
        } else {
            fa *= 0.5;
        }
        (b, fb) = (c, fc);
        if (b - a).abs() <= 2.0 * f64::EPSILON * b.abs() {
            break;
        }
    }
    b
}
