//! d
use signorini::*;
fn main() {
    let sc = Scene::oscillator(1.0, 0.2, 100.0)
        .with_wall(Wall::upper("upper", 5e-3))
        .with_wall(Wall::lower("lower", -5e-3))
        .with_load(Load::harmonic(3.0, 5.0, 0.0));
    let h = 1e-3;
    let mut s = Stepper::new(&sc, &"penalty:epsilon=1e-12,integrator=trapezoidal".parse().unwrap(), h).unwrap();
    let (mut q0, mut v0) = (0.0, 0.0);
    for n in 0..90 {
        let st = s.step().unwrap();
        if st.impulse[0] != 0.0 {
            let f = |t: f64, q: f64, v: f64| 3.0 * (31.41592653589793 * t).sin() - 0.2 * v - 100.0 * q;
            let w = &sc.penalised(PenaltyLaw::Quartic { epsilon: 1e-12 }).unwrap().walls[0];
            println!(
                "{n} q0 {q0} q1 {} p {} law {} {} mom {}",
                st.q[0],
                st.impulse[0],
                w.law_force(q0, 0.),
                w.law_force(st.q[0], 0.),
                st.v[0] - v0 - 0.5 * h * (f(st.start, q0, v0) + f(st.end, st.q[0], st.v[0])) - st.impulse[0]
            );
        }
        q0 = st.q[0];
        v0 = st.v[0];
    }
}
