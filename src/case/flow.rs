//! Reads the table `[flow]`: the margins of a tube in a cross flow by Connors' criterion.

use super::Case;
use super::builder::Builder;
use super::model::{Model, Place};
use super::value::Section;
use crate::error::{Error, Result};
use crate::scene::{Connors, Damping, FlowMargin, FluidElastic, Modes, Row, System};
use crate::study::truncation::Unreduced;

impl Builder<'_> {
    /// The margins that the table `flow` asks for, of the tube `whole` with the modes `own`.
    pub fn flow(&mut self, flow: &Section<'_>, whole: &Unreduced, own: &Modes) -> Result<FluidElastic> {
        let constant = self.required(("flow", "connors"), flow, "connors");
        let span = || flow.span_of("connors").unwrap_or(flow.span.clone());
        let Model::Beam(beam) = self.model.clone() else { return Err(self.without_flow(flow)) };
        let Some(diameter) = beam.section.outer_diameter() else {
            let help = "expected outer_diameter in [system.beam]: Connors' criterion is that of tubes";
            return Err(self.source.error(span(), "`flow.connors` beside a rectangular beam", help));
        };
        let undamped = match (&whole.damping, &whole.scene.system) {
            (Some(Damping::Modal(_)), _) => false,
            (_, System::Structure(structure)) => structure.damping.entries().all(|entry| entry.2 == 0.0),
            _ => true,
        };
        if undamped {
            let help = "expected [system.damping] with ratio = that of the tube in the flow: without damping any flow \
                        makes it unstable";
            return Err(self.source.error(span(), "`flow.connors` without damping", help));
        }
        let rows = |x: f64| -> Result<Vec<Row>> {
            let rows = self.planes.rows(&self.model, &Place::Position(x))?;
            Ok(if self.planes.is_two() { vec![rows.y, rows.z] } else { vec![rows.y] })
        };
        let connors = Connors::in_flow(constant, diameter, beam.mass_per_metre(), &whole.turbulence, rows)?;
        let connors = connors.ok_or_else(|| self.without_flow(flow))?;
        connors.margins(&whole.scene, whole.damping.as_ref(), own).map_err(|error| self.locate(error, &whole.scene))
    }

    /// The error of a table `flow` beside no flow.
    pub fn without_flow(&self, flow: &Section<'_>) -> Error {
        let help = "expected [[turbulence]] with density, velocity and reduced along a tube, [system.beam]: connors \
                    takes the flow from it";
        self.source.error(flow.span.clone(), "`flow` without the flow of a turbulence", help)
    }
}

impl Case {
    /// Why work rates of the case mean nothing: the flow is beyond the fluid-elastic limit with all
    /// supports active. `None` where it is not, or the case has no table `flow`.
    #[must_use]
    pub fn instability(&self) -> Option<String> {
        let found = self.fluid_elastic.as_ref()?;
        let one = unstable(&found.active)?;
        Some(format!(
            "unstable: work rates mean nothing. The flow is beyond the fluid-elastic limit with all supports active: \
             {}; the force of this instability is not in the motion",
            in_words(found.connors, one)
        ))
    }

    /// What the margins in the flow mean, where one is below 1.
    pub(super) fn flow_note(&self) -> Option<String> {
        let found = self.fluid_elastic.as_ref()?;
        self.instability().or_else(|| {
            let one = unstable(&found.inactive)?;
            let held = if found.active.is_empty() { "" } else { "; with all of them active it is stable" };
            let words = in_words(found.connors, one);
            Some(format!("with no support active the tube is fluid-elastically unstable: {words}{held}"))
        })
    }
}

/// The mode of the least margin, if that is below 1.
fn unstable(margins: &[FlowMargin]) -> Option<&FlowMargin> {
    FluidElastic::least(margins).filter(|one| one.margin < Some(1.0))
}

fn in_words(connors: f64, one: &FlowMargin) -> String {
    format!(
        "V_e {:.4} m/s, critical {:.4} m/s, margin {:.3} by Connors with K = {connors}, in the mode of {:.4} Hz",
        one.effective_velocity_m_per_s,
        one.critical_velocity_m_per_s,
        one.margin.unwrap_or(f64::INFINITY),
        one.frequency_hz
    )
}
