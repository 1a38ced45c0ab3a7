//! Which attractor a start leads to.
//!
//! Decided from the run itself, as early as it is certain:
//!
//! - *quiet*: the flight since the last impact stays between the walls for ever, since the sizes of
//!   its decaying part and of its steady part add up to less than the gaps;
//! - *periodic*: the states once a period of the load come within 1e-3 of those N ≤ 32 periods
//!   before; Newton's method on the map over N periods, with the derivative of
//!   [`variation`](crate::variation), lands on an orbit near by; its multipliers are within the
//!   unit circle; and the run approaches it twice as the derivative says;
//! - else, at the end of the run, periodic if the states have repeated themselves three times to
//!   1e-3 and Newton's method lands on a stable orbit near by; *chaotic* if the largest Lyapunov
//!   exponent over the window is more than three standard errors above 0; or not decided.

mod motion;
mod orbit;
mod search;

pub use motion::{Attractor, Lasts, Touch};
#[cfg(feature = "cli")]
pub(crate) use search::{exponent, follow};

/// Most degrees of freedom: the search for an orbit uses the full derivative, a dense matrix.
#[cfg(feature = "cli")]
pub(crate) const MOST_FREEDOM: usize = 20;
