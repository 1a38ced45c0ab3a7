//! A share of a batch: the oscillators that the lanes compute, and those left to the scheme
//! `event`.

use super::engine::Engine;
use super::fallback::follow;
use super::lane::{Lane, LaneWall};
use super::outcome::Outcome;
use super::series::LaneConstants;
use super::slots::{LaneJob, Results};
use super::width::Width;
use crate::error::Result;
use crate::scene::Side;

/// Maximum number of sines of a lane's load; the scheme `event` accepts more.
const MOST_SINES: usize = 4;

/// The oscillators that one thread computes.
pub(super) struct Work<'a> {
    pub lanes: &'a [Lane],
    pub outcomes: &'a mut [Option<Result<Outcome>>],
    /// `keep` for each oscillator.
    pub strobes: &'a mut [[f64; 2]],
    pub settle: u32,
    pub keep: u32,
}

impl Work<'_> {
    pub fn run(self, width: Width) {
        let Self { lanes, outcomes, strobes, settle, keep } = self;
        let seated = |(index, lane)| Some(LaneJob { index, lane, series: seated(lane)? });
        let guests: Vec<LaneJob> = lanes.iter().enumerate().filter_map(seated).collect();
        let mut found: Vec<Option<Outcome>> = vec![None; lanes.len()];
        let sines = guests.iter().map(|guest| guest.lane.sines.len()).max().unwrap_or(0);
        let results = Results { outcomes: &mut found, strobes: &mut *strobes, settle, keep };
        // A sine of amplitude 0 changes no bit, so the number of sines for the whole share does not
        // matter.
        if sines <= 1 {
            width.dispatch(Engine::<1> { guests: &guests, results });
        } else {
            width.dispatch(Engine::<MOST_SINES> { guests: &guests, results });
        }
        let places = outcomes.iter_mut().zip(strobes.chunks_mut(keep as usize));
        for ((lane, found), (outcome, strobes)) in lanes.iter().zip(found).zip(places) {
            *outcome = Some(match found {
                Some(found) => Ok(found),
                None => follow(lane, settle, strobes),
            });
        }
    }
}

/// The constants of an oscillator that the lanes support: rigid walls, no start on one except on
/// the way off, few sines, and steps not too short compared with the period.
fn seated(lane: &Lane) -> Option<LaneConstants> {
    let starts_free = |stop: Option<LaneWall>, side: Side| {
        stop.is_none_or(|stop| {
            stop.law.is_rigid() && (lane.displacement != stop.position || side.sign() * lane.velocity >= 0.0)
        })
    };
    let holds = starts_free(lane.lower, Side::Lower) && starts_free(lane.upper, Side::Upper);
    if holds && lane.sines.len() <= MOST_SINES { LaneConstants::of(lane) } else { None }
}
