//! The command-line tool as a user meets it.
#![cfg(feature = "cli")]

#[path = "../support/command.rs"]
mod command;

mod accuracy_of_means;
mod commands;
mod compare_seeds;
mod default_methods;
mod derivatives;
mod documents;
mod error_parts;
mod excitations;
mod folders;
mod formats;
mod hazards;
mod lines;
mod margins;
mod new_tube;
mod notes;
mod one_at_a_time;
mod output_times;
mod pictures;
mod rerun;
mod scattered_start;
mod seeds;
mod set_values;
mod shaken;
mod statistics;
mod sweep;
mod sweep_end;
mod sweep_seeds;
mod sweep_shares;
mod sweep_until_interval;
mod table;
mod terminal;
mod verdicts;
mod verify;
mod wear;
mod workbooks;
