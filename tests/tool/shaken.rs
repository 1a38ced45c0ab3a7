//! Cases under random forces that several tests run.

/// 1 kg in two planes in a square of bars, shaken in both. `bars` are further keys of the support,
/// `rest` the other tables of the case, `[time]` among them.
pub fn square_of_bars(bars: &str, rest: &str) -> String {
    format!(
        r#"
[system]
planes = 2

[system.oscillator]
mass = 1.0
damping = 2.0
stiffness = 400.0

[[support]]
name = "bars"
shape = "flats"
sides = 4
gap = 2e-3
restitution = 0.5
{bars}
[[load]]
direction = "both"
random = {{ rms = 3.0, from = 1.0, to = 20.0, seed = 7 }}

{rest}"#
    )
}

/// 1 kg before a rigid stop at this position (m), for two seconds.
pub fn before_a_stop(position: f64) -> String {
    format!(
        r#"
[system.oscillator]
mass = 1.0
damping = 2.0
stiffness = 400.0

[[wall]]
name = "stop"
side = "upper"
position = {position:?}
restitution = 0.5

[[load]]
random = {{ rms = 3.0, from = 1.0, to = 20.0, seed = 7 }}

[time]
end = 2.0
step = 1e-3
"#
    )
}
