//! How many realisations a study has.

use super::stein::NeededRealisations;
use super::time_limit::TimeLimit;
use crate::error::{Error, Result, amount};
use std::fmt;

/// Realisations from which the number that an interval needs is estimated.
pub const PILOTS: u64 = 6;

/// Most realisations that an interval may need, unless another limit is given.
pub const MOST_REALISATIONS: u64 = 200;

/// How many realisations a study has.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum RealisationCount {
    /// So many.
    Exactly(u64),
    /// As many as bring the 95 % intervals of the judged means within the share `share` of these
    /// ([`NeededRealisations`]), but at most `most`.
    Within {
        /// Half width over mean.
        share: f64,
        /// Most realisations.
        most: u64,
        /// The time into which they have to fit, where there is one; the pilots are run in any
        /// case.
        most_time: Option<TimeLimit>,
    },
}

impl RealisationCount {
    /// `seeds` realisations, or as many as `until_interval` takes, at most `most`
    /// ([`MOST_REALISATIONS`] where it is left out) and within `most_time`; `None` where neither is
    /// given.
    ///
    /// # Errors
    /// [`Error::Invalid`] under `seeds`, `until_interval`, `most_seeds` or `most_time` for 0
    /// realisations, a share that is not between 0 and 1, fewer than [`PILOTS`] allowed, and both
    /// or a limit alone.
    pub fn new(
        seeds: Option<u64>,
        until_interval: Option<f64>,
        most: Option<u64>,
        most_time: Option<TimeLimit>,
    ) -> Result<Option<Self>> {
        match (seeds, until_interval, most) {
            (Some(0), ..) => Err(Error::invalid("seeds", 0, "1 or more realisations")),
            (Some(_), Some(share), _) => {
                let expected = "no interval beside a number of realisations: one of them follows from the other";
                Err(Error::invalid("until_interval", share, expected))
            }
            (_, None, Some(most)) => {
                Err(Error::invalid("most_seeds", most, "until_interval beside it: it is the limit of that number"))
            }
            (seeds, None, None) => match most_time {
                None => Ok(seeds.map(Self::Exactly)),
                Some(limit) => {
                    let expected = "until_interval beside it: it limits the number of its realisations";
                    Err(Error::invalid("most_time", format!("{:?}", limit.seconds()), expected))
                }
            },
            (None, Some(share), _) if !(share > 0.0 && share < 1.0) => {
                Err(Error::invalid("until_interval", share, "a share above 0 and below 1, such as 0.05"))
            }
            (None, Some(_), Some(most)) if most < PILOTS => {
                Err(Error::invalid("most_seeds", most, format!("{PILOTS} or more: so many are run first")))
            }
            (None, Some(share), most) => {
                let most = most.unwrap_or(MOST_REALISATIONS);
                Ok(Some(Self::Within { share, most, most_time }))
            }
        }
    }

    /// The same where every realisation costs so many runs in all, as where it is the first of the
    /// windows of a history of wear.
    #[must_use]
    pub fn with_runs_each(self, runs_each: f64) -> Self {
        match self {
            Self::Within { share, most, most_time } => {
                Self::Within { share, most, most_time: most_time.map(|limit| limit.with_runs_each(runs_each)) }
            }
            Self::Exactly(_) => self,
        }
    }

    /// The most realisations that the study may have.
    #[must_use]
    pub fn most(self) -> u64 {
        match self {
            Self::Exactly(count) => count,
            Self::Within { most, .. } => most,
        }
    }
}

/// What the first [`PILOTS`] realisations of a study say about the number of all.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Pilots {
    /// How many are needed; `None` where nothing scatters.
    pub needed: Option<NeededRealisations>,
    /// The half width asked for, as a share of the mean.
    pub share: f64,
    /// How many are run.
    pub count: u64,
    /// The time (s) into which no more fit, where that limits their number.
    pub most_time_s: Option<f64>,
}

impl fmt::Display for Pilots {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Some(needed) = &self.needed else {
            return write!(f, "pilots: {PILOTS} realisations scatter in no work rate and no force; no more are run");
        };
        write!(
            f,
            "pilots: after {PILOTS} realisations the {} of {} {:?} is known to ± {:.1} %; ± {:.1} % needs {}",
            needed.measure.words(),
            needed.place.kind.word(),
            needed.place.name,
            100.0 * needed.pilot_share,
            100.0 * self.share,
            needed.count
        )?;
        match self.most_time_s {
            _ if needed.count <= self.count => Ok(()),
            None => write!(f, "; {} are run", self.count),
            Some(seconds) => {
                write!(
                    f,
                    "; {} are run: no more fit into {} s, by the time of the pilots",
                    self.count,
                    amount(seconds, 3)
                )
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_number_or_an_interval_is_asked_for_and_not_both() {
        let new = |seeds, share, most| RealisationCount::new(seeds, share, most, None);
        assert_eq!(new(None, None, None), Ok(None));
        assert_eq!(new(Some(4), None, None), Ok(Some(RealisationCount::Exactly(4))));
        let within = |most| Ok(Some(RealisationCount::Within { share: 0.05, most, most_time: None }));
        assert_eq!(new(None, Some(0.05), None), within(200));
        assert_eq!(new(None, Some(0.05), Some(6)), within(6));
        for (seeds, share, most, words) in [
            (Some(0), None, None, "seeds is 0; expected 1 or more"),
            (Some(4), Some(0.05), None, "until_interval is 0.05; expected no interval beside"),
            (None, None, Some(9), "most_seeds is 9; expected until_interval"),
            (None, Some(0.0), None, "until_interval is 0; expected a share"),
            (None, Some(1.0), None, "until_interval is 1; expected a share"),
            (None, Some(f64::NAN), None, "until_interval is NaN; expected a share"),
            (None, Some(0.05), Some(5), "most_seeds is 5; expected 6 or more"),
        ] {
            let error = new(seeds, share, most).unwrap_err();
            assert!(error.is_request() && error.to_string().starts_with(words), "{error}");
        }
        let timed = |seeds, share| RealisationCount::new(seeds, share, None, TimeLimit::from_now(60.0).ok());
        assert_eq!(timed(None, Some(0.05)).unwrap().unwrap().most(), 200);
        for seeds in [None, Some(4)] {
            let error = timed(seeds, None).unwrap_err().to_string();
            assert!(error.starts_with("most_time is 60.0; expected until_interval beside"), "{error}");
        }
    }
}
