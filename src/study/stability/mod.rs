//! Where schemes fail: one impact at every phase of a step, and the whole scene at every step.
//!
//! | module | what it holds |
//! |---|---|
//! | [`impact`] | the restitution that a scheme realises in one free impact, by phase |
//! | [`theory`] | the same restitution in closed form |
//! | [`scale`] | the frequency by which steps are measured |
//! | [`family`] | the schemes of the maps and their second parameter |
//! | [`recorded_run`] | measurements of one run |
//! | `ledger` | the energy that a scheme itself produces |
//! | [`lasting`] | the effect of schemes on energy and on the force of a lasting contact |
//! | [`fine_reference`] | the reference: fine runs from neighbouring starts |
//! | [`class`] | classification of the measurements |
//! | [`row`] | one scheme on one scene over all steps |
//! | [`plan`] | the maps of a case, computed in parallel |

pub mod class;
pub mod family;
pub mod fine_reference;
pub mod impact;
pub mod lasting;
mod ledger;
pub mod plan;
pub mod recorded_run;
pub mod row;
pub mod scale;
pub mod theory;
