//! How many random cases a test draws, and from which seed: the same ones in every run, unless the
//! environment says otherwise.

use std::str::FromStr;

/// `SIGNORINI_CASES`, or else the usual number of cases.
pub fn cases<T: FromStr>(usual: T) -> T {
    read("SIGNORINI_CASES", usual)
}

/// `SIGNORINI_SEED`, or else the usual seed.
pub fn seed(usual: u64) -> u64 {
    read("SIGNORINI_SEED", usual)
}

fn read<T: FromStr>(name: &str, usual: T) -> T {
    std::env::var(name).ok().and_then(|text| text.parse().ok()).unwrap_or(usual)
}
