//! The derivative of a motion with respect to its start, along an exact run.
//!
//! A change δx = (δq, δq̇) of the start is propagated by the flow between events, δẋ = A δx, and at
//! an event by a saltation matrix S ([`saltation`]), since a changed motion meets the wall at
//! another instant. The derivative of the state at the end with respect to that at the start is the
//! product of them all (Leine & Nijmeijer 2004, doi:10.1007/978-3-540-44398-8, ch. 7). It is exact:
//! no finite differences are taken, and the only errors are those of the run.
//!
//! | type | what it holds |
//! |---|---|
//! | [`OscillatorVariation`] | the 2 × 2 matrix of each step of one degree of freedom |
//! | [`Variation`] | carries any number of columns δx over the steps, for any number of degrees of freedom |
//! | [`Product`] | the matrix of a whole run: over a period, its eigenvalues are the Floquet multipliers |
//! | [`Exponents`] | Lyapunov exponents over a window, with their standard error |
//!
//! All of them watch the [`Step`](crate::Step)s of the scheme `event`. Where the derivative does
//! not exist, or is not known, they say so by [`NoDerivative`], and give no number.
//!
//! ```
//! use signorini::variation::Product;
//! use signorini::{Load, Scene, Scheme, Stepper, Wall};
//!
//! let scene = Scene::oscillator(1.0, 0.2, 100.0)
//!     .with_wall(Wall::upper("upper", 5e-3).with_restitution(0.8))
//!     .with_load(Load::harmonic(3.0, 5.0, 0.0));
//! let mut stepper = Stepper::new(&scene, &Scheme::Event, 1.0)?;
//! let (mut product, mut impacts) = (Product::new(&scene)?, 0);
//! while stepper.time() < 1.0 {
//!     let step = stepper.step()?;
//!     impacts += i32::from(step.jump[0] != 0.0);
//!     product.observe(&step)?;
//! }
//! // Flows shrink areas by exp(−c t/m), impacts by e².
//! let area = product.matrix().determinant();
//! let expected = (-0.2_f64).exp() * 0.64_f64.powi(impacts);
//! assert!((area / expected - 1.0).abs() < 1e-9);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Files
//!
//! The derivative of a motion with respect to its start, from the steps of the exact scheme:
//! `saltation.rs` states what each event makes of a small change, `oscillator.rs` and
//! `structure.rs` (with `jump.rs`, `instant.rs`, `push.rs`, `bounce.rs` and `blows.rs`) read it
//! from the steps, or say why there is none (`no_derivative.rs`), `product.rs` multiplies along a
//! run, `exponents.rs` holds Lyapunov exponents. With respect to keys: `tangent/` is the derivative
//! of the scene, `key_variation.rs` that of a run, with `keys.rs`, `key_terms.rs` and
//! `contact_changes.rs`, `ends.rs` and `means.rs`; `arc_changes.rs` (with `touch_change.rs`) is
//! that of closed-form motion; `stretch.rs` is the motion of a step of either kind. Knows no
//! scheme.

mod arc_changes;
mod blows;
mod bounce;
mod contact_changes;
mod ends;
mod exponents;
mod instant;
mod jump;
mod key_terms;
mod key_variation;
mod keys;
mod means;
mod no_derivative;
mod oscillator;
mod product;
mod push;
pub mod saltation;
mod stretch;
mod structure;
mod tangent;
mod touch_change;

pub use contact_changes::{ContactDerivative, ContactDerivatives};
pub use exponents::{Exponent, Exponents};
pub(crate) use key_variation::KeyVariation;
pub use keys::MotionDerivative;
pub use means::MeanDerivative;
pub use no_derivative::NoDerivative;
pub use oscillator::OscillatorVariation;
pub use product::{Product, Variation};
pub(crate) use structure::StructureVariation;
pub use tangent::SceneTangent;
pub(crate) use tangent::WallTangent;
