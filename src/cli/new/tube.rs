//! The case file of a tube in round supports, from what the command line says of it.

use crate::case::CaseFile;
use crate::error::{Error, Result};
use std::f64::consts::TAU;

/// Most supports.
const MOST_SUPPORTS: u32 = 100;

/// What is known of the tube.
#[derive(Debug, Clone, Default, clap::Args)]
pub struct Tube {
    /// `new tube`: its length between two pinned ends, m [default: 3]
    #[arg(long, value_name = "M", allow_negative_numbers = true)]
    length: Option<f64>,
    /// `new tube`: number of round supports, evenly spaced [default: 2]
    #[arg(long, value_name = "N")]
    supports: Option<u32>,
    /// `new tube`: outer diameter, m [default: 19.05e-3]
    #[arg(long, value_name = "M", allow_negative_numbers = true)]
    outer_diameter: Option<f64>,
    /// `new tube`: thickness of the wall, m [default: 1.65e-3]
    #[arg(long, value_name = "M", allow_negative_numbers = true)]
    wall: Option<f64>,
    /// `new tube`: radial gap of the supports, m [default: 0.2e-3]
    #[arg(long, value_name = "M", allow_negative_numbers = true)]
    gap: Option<f64>,
}

impl Tube {
    /// The first value that was given, by its name.
    pub fn given(&self) -> Option<&'static str> {
        let given = [
            ("--length", self.length.is_some()),
            ("--supports", self.supports.is_some()),
            ("--outer-diameter", self.outer_diameter.is_some()),
            ("--wall", self.wall.is_some()),
            ("--gap", self.gap.is_some()),
        ];
        given.into_iter().find(|(_, given)| *given).map(|(name, _)| name)
    }

    /// The text of the case file `name`.
    ///
    /// # Errors
    /// [`Error::Invalid`] for a value that makes no tube.
    pub fn text(&self, name: &str) -> Result<String> {
        let positive = |option: &'static str, value: Option<f64>, default: f64| match value.unwrap_or(default) {
            x if x.is_finite() && x > 0.0 => Ok(x),
            x => Err(Error::invalid(option, format_args!("{x:?}"), "a number above 0, in m")),
        };
        let length = positive("--length", self.length, 3.0)?;
        let outer = positive("--outer-diameter", self.outer_diameter, 19.05e-3)?;
        let wall = positive("--wall", self.wall, 1.65e-3)?;
        let gap = positive("--gap", self.gap, 0.2e-3)?;
        if wall > 0.5 * outer {
            return Err(Error::invalid(
                "--wall",
                wall,
                format!("at most half the outer diameter, {:?} m", 0.5 * outer),
            ));
        }
        let supports = match self.supports.unwrap_or(2) {
            count @ 1..=MOST_SUPPORTS => count,
            count => return Err(Error::invalid("--supports", count, format!("from 1 to {MOST_SUPPORTS}"))),
        };
        let spans = supports + 1;
        let span = length / f64::from(spans);
        // Inner diameters of 17 digits would not read well.
        let inner = (1e9 * (outer - 2.0 * wall)).round() / 1e9;
        let support =
            |number: u32| SUPPORT.replace("%NUMBER%", &number.to_string()).replace("%GAP%", &format!("{gap:?}"));
        let values = [
            ("%LENGTH%", format!("{length:?}")),
            ("%SPANS%", vec![format!("{span:?}"); spans as usize].join(", ")),
            ("%ELEMENTS%", (20 * spans).to_string()),
            ("%MODES%", (8 * spans).max(16).to_string()),
            ("%OUTER%", format!("{outer:?}")),
            ("%INNER%", format!("{inner:?}")),
            ("%COHERENT%", format!("{:?}", (1e6 * 3.0 * outer).round() / 1e6)),
            ("%SUPPORTS%", (1..=supports).map(support).collect::<Vec<_>>().join("\n")),
        ];
        let text = values.iter().fold(TEXT.to_owned(), |text, (mark, value)| text.replace(mark, value));
        let with_step = |step: &str| text.replace("%STEP%", step);
        let case = CaseFile::from_text(&with_step("5e-5"), name, "").case()?;
        let [_, fastest] = case.scene.system.frequencies();
        Ok(with_step(&step_for(fastest)))
    }
}

/// The largest step of one digit, s, that is at most 50 µs and a tenth of the period of the fastest
/// mode, whose circular frequency is `fastest` (rad/s).
fn step_for(fastest: f64) -> String {
    let most = (TAU / (10.0 * fastest)).min(5e-5);
    let exponent = most.log10().floor();
    // A quotient just below a whole number is that number.
    let digit = (most / 10f64.powf(exponent) * (1.0 + 1e-9)).floor();
    format!("{digit}e{exponent}")
}

/// The file, with marks for values.
const TEXT: &str = r#"# A tube in round supports, shaken by the turbulence of a cross flow.
# Values marked "assumed" stand for what you know better; all values are in SI units. `signorini
# explain` says what would be done with them, and every key can be varied: `signorini sweep FILE
# --vary KEY=A,B,C`.

title = "A tube of %LENGTH% m in round supports"

[system]
planes = 2                  # y and z, across the tube
modes = %MODES%                  # of each plane

[system.beam]
spans = [%SPANS%]     # m, from end to end; each span ends in a joint
youngs_modulus = 200e9      # Pa, steel
density = 7850.0            # kg/m^3, steel
outer_diameter = %OUTER%   # m
inner_diameter = %INNER%   # m
added_mass = 0.0            # kg/m: the fluid inside, and what the tube moves outside
elements = %ELEMENTS%               # of the whole tube
left = "pinned"             # or "clamped", "free", { stiffness = .. }
right = "pinned"

[system.damping]
ratio = 0.01                # of every mode, in the fluid; assumed

%SUPPORTS%
[[turbulence]]
direction = "both"          # independent fields along y and z
density = 1000.0            # kg/m^3, of the fluid; assumed
velocity = 2.0              # m/s in the gaps, or pairs [[m, m/s], ..] along the tube; assumed
reduced = [[0.01, 0.05], [0.2, 0.0112], [3.0, 8.6e-7]]  # fD/V and its density; assumed
from = 5.0                  # Hz
to = 150.0
correlation_length = %COHERENT%   # m, three diameters; assumed
seed = 1

[wear]
coefficient = 1e-14         # 1/Pa, of the tube; assumed
support_coefficient = 1e-14 # 1/Pa, of the supports; assumed
service = 3.15576e8         # s, ten years
limit = 0.4                 # of the tube's wall

[time]
end = 5.0                   # s
step = %STEP%                 # s: ten or more in a period of the fastest mode
sample = 5e-4               # s
statistics_from = 1.0       # s, after the initial transient
"#;

/// A support, with marks for values.
const SUPPORT: &str = r#"[[support]]
name = "support-%NUMBER%"
at = { joint = %NUMBER% }
shape = "round"             # or "flats"
gap = %GAP%                # m, radial
restitution = 0.5           # assumed
friction = 0.2              # assumed
width = 25e-3               # m, along the tube; assumed
"#;
