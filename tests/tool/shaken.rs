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

/// A tube by two of its modes, between two walls in a cross flow.
pub const IN_A_FLOW: &str = r#"
[system.modal]
frequencies = [10.0, 12.0]
masses = [2.0, 3.0]
damping_ratios = 0.05
shapes = { left = [0.0, 0.0], middle = [1.0, 0.2], right = [0.0, 0.0] }
[[turbulence]]
line = { left = 0.0, middle = 0.5, right = 1.5 }
spectrum = [[0.5, 4.0], [50.0, 4.0]]
from = 1.0
to = 20.0
correlation_length = 0.1
seed = 3
[[wall]]
name = "w"
at = { point = "middle" }
side = "both"
gap = 2e-3
restitution = 0.5
[time]
end = 0.4
step = 1e-3
"#;
