//! The case file of a tube in round supports, from what the command line says of it.

use crate::case::CaseFile;
use crate::error::{Error, Result};
use crate::scene::MOST_MODES;
use std::f64::consts::FRAC_PI_4;

/// Modes of each plane for a span, and the least number of all.
const MODES_OF_A_SPAN: u32 = 8;
const LEAST_MODES: u32 = 16;

/// Most supports: the modes of both planes, and the one beyond them, are modes that can be found.
const MOST_SUPPORTS: u32 = (MOST_MODES as u32 - 1) / (2 * MODES_OF_A_SPAN) - 1;

/// What is known of the tube.
#[derive(Debug, Clone, Default, clap::Args)]
pub struct Tube {
    /// `new tube`: its length between two pinned ends, m [default: 3]
    #[arg(long, value_name = "M", allow_negative_numbers = true)]
    length: Option<f64>,
    /// `new tube`: number of round supports, evenly spaced, 1 to 30 [default: 2]
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
        let modes = (MODES_OF_A_SPAN * spans).max(LEAST_MODES);
        let span = length / f64::from(spans);
        // Inner diameters of 17 digits would not read well.
        let inner = (1e9 * (outer - 2.0 * wall)).round() / 1e9;
        let support =
            |number: u32| SUPPORT.replace("%NUMBER%", &number.to_string()).replace("%GAP%", &format!("{gap:?}"));
        let coherent = ((1e6 * 3.0 * outer).round() / 1e6).max(1e-6);
        let flow = FLOW.replace("%COHERENT%", &format!("{coherent:?}"));
        let values = [
            ("%LENGTH%", format!("{length:?}")),
            ("%SPANS%", vec![format!("{span:?}"); spans as usize].join(", ")),
            ("%OUTER%", format!("{outer:?}")),
            ("%INNER%", format!("{inner:?}")),
            ("%ADDED%", format!("{:.3}", added_mass(outer, inner))),
            ("%SUPPORTS%", (1..=supports).map(support).collect::<Vec<_>>().join("\n")),
        ];
        let text = values.iter().fold(TEXT.to_owned(), |text, (mark, value)| text.replace(mark, value));
        let filled = |modes: u32, flow: &str| text.replace("%MODES%", &modes.to_string()).replace("%FLOW%", flow);
        // The slowest mode alone, without the flow, whose coherence over all pairs of nodes takes a
        // minute where supports are many.
        CaseFile::from_text(&filled(1, ""), name, "").case()?;
        Ok(filled(modes, &flow))
    }
}

/// kg/m of water inside a tube of these diameters (m), and outside of 1.3 times what it displaces,
/// as beside other tubes.
fn added_mass(outer: f64, inner: f64) -> f64 {
    1000.0 * FRAC_PI_4 * (inner * inner + 1.3 * outer * outer)
}

/// The file, with marks for values.
const TEXT: &str = r#"# A tube in round supports, shaken by the turbulence of a cross flow.
# Values marked "assumed" stand for what you know better; all values are in SI units. `signorini
# explain` says what would be done with them, and every key can be varied: `signorini sweep FILE
# --vary KEY=A,B,C`.

title = "A tube of %LENGTH% m in round supports"

[system]
planes = 2                  # y and z, across the tube
modes = %MODES%                  # of each plane: eight for every span, 16 at least

[system.beam]
spans = [%SPANS%]     # m, from end to end; each span ends in a joint
youngs_modulus = 200e9      # Pa, steel
density = 7850.0            # kg/m^3, steel
outer_diameter = %OUTER%   # m
inner_diameter = %INNER%   # m
added_mass = %ADDED%          # kg/m: water inside, and 1.3 times what the tube displaces; assumed
left = "pinned"             # or "clamped", "free", { stiffness = .. }
right = "pinned"

[system.damping]
ratio = 0.01                # of every mode, in the fluid; assumed

%SUPPORTS%
%FLOW%[time]
end = 5.0                   # s
# step: from the modes unless given, ten or more in the period of the fastest
sample = 5e-4               # s
statistics_from = 1.0       # s, after the initial transient
"#;

/// The flow and the wear by it, with a mark.
const FLOW: &str = r#"[[turbulence]]
direction = "both"          # independent fields along y and z
density = 1000.0            # kg/m^3, of the fluid; assumed
velocity = 2.0              # m/s in the gaps, or pairs [[m, m/s], ..] along the tube; assumed
reduced = [[0.01, 0.05], [0.2, 0.0112], [3.0, 8.6e-7]]  # fD/V and its density; assumed
from = 5.0                  # Hz
to = 150.0
correlation_length = %COHERENT%   # m, three diameters; assumed
seed = 1

# Beyond the limit of fluid-elastic instability work rates mean nothing. With these lines `explain`
# and `run` tell how far this flow is from it:
# [flow]
# connors = 3.0             # Connors' constant of the bundle

[wear]
coefficient = 1e-14         # 1/Pa, of the tube; assumed
support_coefficient = 1e-14 # 1/Pa, of the supports; assumed
service = 3.15576e8         # s, ten years
limit = 0.4                 # of the tube's wall

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
