//! Reads the table `[wear]`, and makes the law of wear of each support.

use super::builder::Builder;
use super::realisations::RANDOM;
use super::value::Section;
use super::{Case, SupportShape, TimeOptions};
use crate::error::{Error, Result};
use crate::scene::Scene;
use crate::statistics::WearStatistics;
use crate::study::wear_history::{HISTORIES, WearingSupport, YEAR};
#[cfg(feature = "cli")]
use crate::wear::WearWork;
use crate::wear::{Archard, Bearing, Growth, Opening, SCAR, Scar};
use toml::Spanned;

/// The table `[wear]`.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[non_exhaustive]
pub struct WearOptions {
    /// Wear coefficient of the structure at the supports, 1/Pa, where a support has no coefficient
    /// of its own.
    pub coefficient: Option<f64>,
    /// Wear coefficient of the supports, 1/Pa, where a support has no coefficient of its own.
    pub support_coefficient: Option<f64>,
    /// Time in service, s.
    pub service: Option<f64>,
    /// The depth up to which the tube may wear, m.
    pub limit: Option<f64>,
}

impl Builder<'_> {
    /// The table `[wear]` and its number of sectors; all supports have been read.
    pub fn wear(&mut self, wear: Option<&Section<'_>>) -> Result<(WearOptions, usize)> {
        let Some(wear) = wear else { return Ok((WearOptions::default(), TimeOptions::SECTORS)) };
        if self.written.supports.is_empty() {
            let help = "expected one [[support]] or [[slider]], or more, beside it: only at these something slides";
            return Err(self.source.error(wear.span.clone(), "`wear` without a support", help));
        }
        let options = WearOptions {
            coefficient: self.above_0("wear", "coefficient", "1/Pa", wear)?,
            support_coefficient: self.above_0("wear", "support_coefficient", "1/Pa", wear)?,
            service: self.above_0("wear", "service", "s", wear)?,
            limit: self.limit(wear)?,
        };
        let sectors = self.sectors(wear.number("sectors"))?;
        let own = self.written.supports.iter().any(|support| support.wear.has_coefficient());
        if !own && options.coefficient.or(options.support_coefficient).is_none() {
            for (key, title) in [
                ("service", "`wear` has a service and no coefficient"),
                ("limit", "`wear` has a limit and no coefficient"),
            ] {
                if let Some(at) = wear.span_of(key) {
                    let help = "expected coefficient beside it, in 1/Pa: volume = coefficient x work rate x service";
                    return Err(self.source.error(at, title, help));
                }
            }
        }
        Ok((options, sectors))
    }

    /// The depth up to which the tube may wear, m.
    fn limit(&self, wear: &Section<'_>) -> Result<Option<f64>> {
        let Some(limit) = wear.number("limit") else { return Ok(None) };
        let mut walls = Vec::new();
        for support in self.written.supports.iter().filter(|support| support.wear.scar.is_some()) {
            let of_beam = || self.model.beam(&support.place)?.section.wall_thickness();
            let Some(wall) = support.wear.wall.or_else(of_beam) else {
                let title = format!("`wear.limit` without the wall of the tube at support {:?}", support.name);
                let help = "expected [system.beam] with outer_diameter and inner_diameter, or wall beside radius of \
                            each [[support]]: the limit is a share of the wall thickness of a tube";
                return Err(self.source.error(limit.span(), &title, help));
            };
            let has = |own: Option<f64>, key: &str| own.is_some() || wear.span_of(key).is_some();
            let of_support = has(support.wear.support_coefficient, "support_coefficient");
            if of_support && !has(support.wear.coefficient, "coefficient") {
                let title = format!("`wear.limit` without a coefficient of the tube at support {:?}", support.name);
                let help = "expected coefficient, in 1/Pa: support_coefficient is that of the support alone";
                return Err(self.source.error(limit.span(), &title, help));
            }
            walls.push(wall);
        }
        if walls.windows(2).any(|pair| pair[0] != pair[1]) {
            let help = "expected tubes of one wall thickness: the limit is a share of it";
            return Err(self.source.error(limit.span(), "`wear.limit` beside tubes of different walls", help));
        }
        let Some(wall) = walls.first() else {
            let title = "`wear.limit` without a support that has a width";
            return Err(self.source.error(limit.span(), title, &format!("expected {SCAR}")));
        };
        match *limit.get_ref() {
            share if share > 0.0 && share <= 1.0 => Ok(Some(share * wall)),
            _ => Err(self.refuse(limit.span(), "wear: limit", "a number above 0 and at most 1, a share of the wall")),
        }
    }

    fn sectors(&mut self, sectors: Option<Spanned<f64>>) -> Result<usize> {
        let Some(value) = sectors else { return Ok(TimeOptions::SECTORS) };
        self.whole_number("sectors", &value, TimeOptions::MOST_SECTORS)
    }
}

/// What takes the place of years that are left out.
const SERVICE: &str = "a number above 0, or service = a number above 0, in s, in [wear]";

impl Case {
    /// The law of wear of support number `index` of the scene; `None` where the case has no
    /// coefficient for it, or no service.
    #[must_use]
    pub fn archard(&self, index: usize) -> Option<Archard> {
        self.archard_within(self.wear.service?, index)
    }

    /// The law of wear of support number `index` within `service` seconds; `None` where the case
    /// has no coefficient for it.
    pub(super) fn archard_within(&self, service: f64, index: usize) -> Option<Archard> {
        let wear = self.written.supports.get(index)?.wear;
        let coefficient = wear.coefficient.or(self.wear.coefficient);
        let support_coefficient = wear.support_coefficient.or(self.wear.support_coefficient);
        coefficient.or(support_coefficient)?;
        let support = self.scene.supports.get(index)?;
        let bearing = match (support.hole(&self.scene.walls), wear.other_tube) {
            (Some(hole), _) => Bearing::Hole { gap: hole.gap },
            // Several flats are bars that the other tube carries.
            (None, Some(radius)) if support.walls.len() == 1 => Bearing::Tube { radius },
            (None, _) => Bearing::Flat,
        };
        let scar = wear.scar.map(|(width, radius)| Scar { width, radius, bearing });
        Some(Archard { coefficient, support_coefficient, service, scar })
    }

    /// The depths worn off the tube within the service at support number `index`, m, at the work
    /// rates of `wear`, as [`Archard::depths`]; none without a law of its wear.
    #[must_use]
    pub fn depths(&self, index: usize, wear: &WearStatistics) -> Vec<f64> {
        let depths = || {
            let (law, growth) = (self.archard(index)?, self.written.supports.get(index)?.growth);
            Some(law.depths(growth, &law.work_in_service(&wear.rates())?))
        };
        depths().unwrap_or_default()
    }

    /// The same of several runs by their work `rates` (W), about the mean of these, as
    /// [`WearWork::about_mean`].
    #[cfg(feature = "cli")]
    pub(crate) fn depths_about_mean(&self, index: usize, rates: &[WearWork]) -> Vec<Vec<f64>> {
        let depths = || {
            let (law, growth) = (self.archard(index)?, self.written.supports.get(index)?.growth);
            let works: Option<Vec<_>> = rates.iter().map(|rates| law.work_in_service(rates)).collect();
            Some(WearWork::about_mean(&works?, |work| law.depths(growth, work)))
        };
        depths().unwrap_or_default()
    }

    /// Likewise of one scar, in lists of one; empty lists where there is no depth.
    #[cfg(feature = "cli")]
    pub(crate) fn scars_about_mean(&self, index: usize, rates: &[WearWork]) -> Vec<Vec<f64>> {
        let Some(law) = self.archard(index) else { return Vec::new() };
        WearWork::about_mean(rates, |rates| law.worn(rates.total).depth_one_scar_m.into_iter().collect())
    }

    /// The depth worn off the tube within the service at support number `index` where it is
    /// deepest, m, at the work rates of `wear`; `None` without a law of its wear, and where it
    /// would cut the tube in two.
    #[must_use]
    pub fn depth_deepest(&self, index: usize, wear: &WearStatistics) -> Option<f64> {
        self.archard(index)?.deepest_in_service(self.written.supports.get(index)?.growth, &wear.rates())
    }
}

impl Case {
    /// The supports of the case that wear.
    ///
    /// # Errors
    /// [`Error::Invalid`] for a support with a wear coefficient and without a width, and for a case
    /// in which nothing wears, or sliders alone.
    pub fn wearing_supports(&self) -> Result<Vec<WearingSupport>> {
        let mut wearing = Vec::new();
        let mut sliders = false;
        for (index, support) in self.scene.supports.iter().enumerate() {
            let written = self.written.supports.get(index);
            // A slider has no gap that could grow.
            let slides = written.is_some_and(|written| written.shape == SupportShape::Slider);
            // Work done takes the place of a rate times a service.
            let Some(law) = self.archard_within(1.0, index) else { continue };
            if slides {
                sliders = true;
                continue;
            }
            if law.scar.is_none() {
                let expected = "a support with a width: its depth is the worn volume over 2πRw";
                return Err(Error::invalid("support", format!("{:?}", support.name), expected));
            }
            let growth = written.map_or_else(Growth::default, |written| written.growth);
            let (name, gaps) = (support.name.clone(), support.gaps(&self.scene.walls));
            wearing.push(WearingSupport { name, gaps, growth, law, wall: self.wall_at(index) });
        }
        if wearing.is_empty() {
            let case = format!("the case {:?}", self.name);
            if sliders {
                return Err(Error::invalid(case, "one in which only sliders wear", SCAR));
            }
            let expected = "a case with supports, and a coefficient in [wear]: depths follow from these";
            return Err(Error::invalid(case, "one in which nothing wears", expected));
        }
        Ok(wearing)
    }

    /// Thickness of the wall of the tube at support number `index`, m; `None` where the case does
    /// not know it.
    pub(crate) fn wall_at(&self, index: usize) -> Option<f64> {
        let support = self.written.supports.get(index)?;
        let of_beam = || self.model.beam(&support.place)?.section.wall_thickness();
        support.wear.wall.or_else(of_beam)
    }

    /// The scene of realisation `number`, in which wear has opened each of `supports`.
    ///
    /// # Errors
    /// As [`Case::realisation`].
    pub fn worn(&self, number: u64, supports: &[WearingSupport], openings: &[Opening]) -> Result<Scene> {
        let mut scene = self.realisation(number)?.scene;
        supports.iter().zip(openings).for_each(|(support, opening)| support.open(&mut scene, opening));
        Ok(scene)
    }

    /// How many histories of wear are followed: `asked`, or [`HISTORIES`] of a random case and
    /// one otherwise.
    ///
    /// # Errors
    /// [`Error::Invalid`] under `histories` for 0, and for several of a case that is not random.
    pub fn histories(&self, asked: Option<usize>) -> Result<usize> {
        match asked {
            Some(0) => Err(Error::invalid("histories", 0, "1 or more")),
            Some(count) if count > 1 && !self.is_random() => Err(Error::invalid("histories", count, RANDOM)),
            Some(count) => Ok(count),
            None => Ok(if self.is_random() { HISTORIES } else { 1 }),
        }
    }

    /// True if a support has a wear coefficient and the case no service: no run tells a worn
    /// volume.
    #[cfg(feature = "cli")]
    pub(crate) fn lacks_service(&self) -> bool {
        let law = |index| self.archard_within(1.0, index).is_some();
        self.wear.service.is_none() && (0..self.scene.supports.len()).any(law)
    }

    /// The time in service, s: `years`, or that of the case.
    ///
    /// # Errors
    /// [`Error::Invalid`] under `years` where that is not above 0, and where neither is given.
    pub fn service(&self, years: Option<f64>) -> Result<f64> {
        match (years, self.wear.service) {
            (Some(years), _) if years.is_finite() && years > 0.0 => Ok(years * YEAR),
            (Some(years), _) => Err(Error::invalid("years", years, "a number above 0")),
            (None, service) => service.ok_or_else(|| Error::invalid("years", "left out", SERVICE)),
        }
    }
}
