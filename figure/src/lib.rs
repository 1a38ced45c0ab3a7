//! Figures for a paper: data in, SVG text out. This crate does not depend on scenes or schemes.
//!
//! | type | what it draws |
//! |---|---|
//! | [`Figure`] | panels under one another sharing the horizontal axis: responses, phase plots, work–precision charts |
//! | [`Panel`] | one frame: [`Curve`]s, stems (impulses) and [`Mark`]s (walls, floors) |
//! | [`HeatMap`] | classes or numbers over two axes |
//! | [`Tornado`] | how far each of several inputs moves a number, as bars |
//! | [`Animation`] | lines that move, in [`View`]s beside and under one another |
//! | [`Scatter`] | any number of points over two axes, with [`Line`]s and [`Sign`]s over them |
//!
//! All figures have the same look: 160 mm wide, any sans-serif font, legend below the frame, curves
//! distinguished by dash pattern and lightness as well as by colour. The same data give the same
//! bytes. Values that cannot be drawn (NaN, infinite, not positive on a logarithmic axis) break a
//! line and do not affect the axes; long curves are thinned to what the width can show, with their
//! extremes kept.
//!
//! The SVG is written directly. kuva 0.6 was tried: it interprets `$` in titles as mathematics,
//! numbers its clip paths by a process-wide counter (two runs differ), has no legend entry with
//! line and marker together, shows dashes too short to distinguish, puts wall labels over the
//! curves, has no logarithmic heat map, and doubles the build time. plotters draws each dash as an
//! element of its own and leaves legends, panels and hatching to the caller. What is written by
//! hand instead is small: axes and SVG elements.
//!
//! ```
//! use signorini_figure::{Curve, Figure, Mark, Panel};
//!
//! let points = (0..=1000).map(|i| f64::from(i) * 1e-2).map(|t| (t, 4.0 * t.sin()));
//! let svg = Figure::new("Free motion", "Time (s)")
//!     .panel(
//!         Panel::new("Displacement (mm)")
//!             .curve(Curve::new("event", points))
//!             .mark(Mark::wall(5.0, "upper wall"))
//!             .mark(Mark::wall(-5.0, "lower wall")),
//!     )
//!     .to_svg();
//! assert!(svg.starts_with("<svg"));
//! ```

#![forbid(unsafe_code)]

mod animation;
mod axis;
mod class;
mod curve;
mod envelope;
mod heat;
mod labels;
mod layout;
mod legend;
mod look;
mod overlay;
mod panel;
mod plot_area;
mod regions;
mod scatter;
mod sheet;
mod svg;
mod text;
mod thin;
mod tone;
mod tornado;

pub use animation::{Animation, View};
pub use axis::Scale;
pub use class::Class;
pub use curve::{Curve, Mark};
pub use heat::HeatMap;
pub use overlay::{Line, Sign};
pub use panel::Panel;
pub use scatter::Scatter;
pub use sheet::Figure;
pub use tornado::{Bar, Bars, Tornado};
