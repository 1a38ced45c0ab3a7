//! The schemes, as a stepper or a run makes their steps.

#[path = "../support/common/mod.rs"]
mod common;
#[path = "../support/counting.rs"]
mod counting;
#[path = "../support/draws.rs"]
mod draws;
#[path = "../support/random_structures.rs"]
mod random_structures;
#[path = "../support/recorded_momentum.rs"]
mod recorded_momentum;

mod bar_impact;
mod blows;
mod chain;
mod convergence;
mod energy;
mod extremes;
mod forces;
mod function_load;
mod generalized_alpha;
mod hunt_crossley;
mod impact_map;
mod located;
mod many;
mod many_convergence;
mod many_random;
mod momentum;
mod neighbours;
mod options;
mod output_times;
mod paoli_schatzman;
mod past_the_end;
mod quiet_steps;
mod rest;
mod rows;
mod set_state;
mod simultaneous;
mod single_steps;
mod stepper;
mod walls;
