//! Reads the table `[flow]`: the margins of tubes in a cross flow by Connors' criterion.

use super::Case;
use super::builder::Builder;
use super::model::{Body, Model, Place};
use super::value::Section;
use super::written::Line;
use crate::error::{Error, Result};
use crate::scene::{
    Connors, Damping, FlowMargin, FlowTube, FluidElastic, Modes, Row, System, Turbulence, TurbulenceSpectrum,
};
use crate::study::truncation::Unreduced;
use toml::Spanned;

impl Builder<'_> {
    /// The margins that the table `flow` of `file` asks for, of the tubes of `whole` with the modes
    /// `own`, those of modal data along `lines`; `None` without that table.
    pub fn flow(
        &mut self,
        file: &Section<'_>,
        (whole, own): (&Unreduced, &Modes),
        lines: &[Line],
    ) -> Result<Option<FluidElastic>> {
        let Some(flow) = file.section("flow") else { return Ok(None) };
        let constant = self.required(("flow", "connors"), &flow, "connors");
        let tables = file.sections("turbulence");
        let body_of = |field: &&Turbulence| {
            let table = tables.get((field.number() - 1) as usize);
            table.and_then(|table| table.word("body")).map(|name| *name.get_ref())
        };
        let bodies: Vec<Option<Body>> = match &self.model {
            Model::Bodies(bodies) => bodies.iter().cloned().map(Some).collect(),
            _ => vec![None],
        };
        let mut tubes = Vec::new();
        for body in &bodies {
            let name = body.as_ref().map(|body| body.name.as_str());
            let fields: Vec<&Turbulence> = whole.turbulence.iter().filter(|field| body_of(field) == name).collect();
            let line = lines.iter().find(|line| line.body.as_deref() == name);
            tubes.extend(self.tube(&flow, whole, (body.as_ref(), line), &fields)?);
        }
        if tubes.is_empty() {
            return Err(self.without_flow(&flow));
        }
        self.check_mass(&flow, &bodies)?;
        // The ratios of modal data are ratios of its modes like others.
        let of_data = || match (&self.model, &whole.scene.system) {
            (Model::Modal(_), System::Structure(structure)) => Some(Damping::Modal(own.ratios(&structure.damping))),
            _ => None,
        };
        let damping = whole.damping.clone().or_else(of_data);
        let margins = Connors { constant, tubes }.margins(&whole.scene, damping.as_ref(), own);
        margins.map(Some).map_err(|error| self.locate(error, &whole.scene))
    }

    /// Refuses a mass per metre where every tube is a beam, which has its own.
    fn check_mass(&mut self, flow: &Section<'_>, bodies: &[Option<Body>]) -> Result<()> {
        let Some(mass) = flow.number("mass_per_metre") else { return Ok(()) };
        self.number(("flow", "mass"), &mass);
        let mut models = bodies.iter().map(|body| body.as_ref().map_or(&self.model, |body| &body.model));
        if models.all(|model| matches!(model, Model::Beam(_))) {
            let help = "expected it beside modal data only: a beam has the mass of its section, and added_mass";
            return Err(self.source.error(mass.span(), "`flow.mass_per_metre` beside a beam", help));
        }
        Ok(())
    }

    /// The tube `body`, or the whole system, in the flow of `fields`; `None` without one.
    fn tube(
        &self,
        flow: &Section<'_>,
        whole: &Unreduced,
        (body, line): (Option<&Body>, Option<&Line>),
        fields: &[&Turbulence],
    ) -> Result<Option<FlowTube>> {
        let (model, name) = (body.map_or(&self.model, |body| &body.model), body.map(|body| body.name.as_str()));
        let of = name.map_or(String::new(), |name| format!(" of the body {name:?}"));
        let table = if body.is_some() { "body" } else { "system" };
        // A beam has positions of its own; modes have those of the line of the turbulence.
        let line = line.filter(|_| matches!(model, Model::Modal(_)));
        let row = |x: f64| -> Result<Vec<Row>> {
            let place = line.map_or(Place::Position(x), |line| line.at(x));
            let rows = self.planes.rows(&self.model, &place.on(name))?;
            Ok(if self.planes.is_two() { vec![rows.y, rows.z] } else { vec![rows.y] })
        };
        let refused = |title: &str, help: &str| {
            let span = flow.span_of("connors").unwrap_or(flow.span.clone());
            Err(self.source.error(span, &format!("`flow.connors` {title}{of}"), help))
        };
        let mass = match model {
            Model::Beam(beam) => Some(beam.mass_per_metre()),
            _ => flow.number("mass_per_metre").map(Spanned::into_inner),
        };
        let in_flow = FlowTube::in_flow(name.map(str::to_owned), mass.unwrap_or_default(), fields, row)?;
        let Some(tube) = in_flow else { return Ok(None) };
        if mass.is_none() {
            let help = "expected mass_per_metre beside it: kg/m of the tube whose modes are given, with the fluid in \
                        it and around it; velocities are told by it, and margins do not depend on it";
            return refused("without the mass per metre", help);
        }
        let undamped = match (&whole.damping, &whole.scene.system) {
            (Some(Damping::Modal(_)), _) => false,
            (_, System::Structure(structure)) => {
                let own = |i: usize| body.is_none_or(|body| body.dofs.contains(&i));
                structure.damping.entries().all(|(i, _, value)| value == 0.0 || !own(i))
            }
            _ => true,
        };
        if undamped {
            let key = if matches!(model, Model::Modal(_)) {
                format!("[{table}.modal] with damping_ratios = those")
            } else {
                format!("[{table}.damping] with ratio = that")
            };
            let help = format!("expected {key} of the tube in the flow: without damping any flow makes it unstable");
            return refused("without damping", &help);
        }
        Ok(Some(tube))
    }

    /// The error of a table `flow` beside no flow.
    pub fn without_flow(&self, flow: &Section<'_>) -> Error {
        let help = "expected [[turbulence]] with density, velocity and reduced along a tube, a beam or modal data: \
                    connors takes the flow from it";
        self.source.error(flow.span.clone(), "`flow` without the flow of a turbulence", help)
    }
}

/// With these words a case beyond the fluid-elastic limit says so.
pub(crate) const BEYOND_LIMIT: &str = "beyond the fluid-elastic limit";

/// With these it begins to say so where it is with all supports active.
pub(crate) const UNSTABLE: &str = "unstable: work rates mean nothing";

impl Case {
    /// Why work rates of the case mean nothing: the flow is beyond the fluid-elastic limit with all
    /// supports active. `None` where it is not, or the case has no table `flow`.
    #[must_use]
    pub fn instability(&self) -> Option<String> {
        let found = self.fluid_elastic.as_ref()?;
        let one = unstable(&found.active)?;
        Some(format!(
            "{UNSTABLE}. The flow is {BEYOND_LIMIT} with all supports active{}: {}; the force of this instability is \
             not in the motion",
            if self.sliders.is_empty() { "" } else { " and all sliders sliding" },
            in_words(found.connors, one)
        ))
    }

    /// The sliders that margins in the flow leave out: what slides under a known force holds
    /// nothing.
    pub(super) fn sliders_in_flow(&self) -> Option<String> {
        let names: Vec<String> = self.sliders.iter().map(|slider| format!("{:?}", slider.name)).collect();
        (self.fluid_elastic.is_some() && !names.is_empty()).then(|| {
            format!(
                "fluid-elastic margins count no slider ({}): while it slides it holds nothing, and its friction is \
                 damping that ζ leaves out; while it sticks it is a pin, which no margin here has",
                names.join(", ")
            )
        })
    }

    /// That nothing keeps the flow within the fluid-elastic limit: its supports do not, or there
    /// are none.
    #[cfg(feature = "cli")]
    pub(crate) fn unstable_in_flow(&self) -> Option<String> {
        let bare = self.fluid_elastic.as_ref().is_some_and(|found| found.active.is_empty());
        if bare { self.flow_note() } else { self.instability() }
    }

    /// What the margins in the flow mean, where one is below 1, or that nothing is known of them.
    pub(super) fn flow_note(&self) -> Option<String> {
        let Some(found) = &self.fluid_elastic else {
            let flows = |field: &Turbulence| matches!(field.spectrum, TurbulenceSpectrum::Flow { .. });
            return self.turbulence().iter().any(flows).then(|| UNKNOWN.to_owned());
        };
        self.instability().or_else(|| {
            let one = unstable(&found.inactive)?;
            let held = if found.active.is_empty() { "" } else { "; with all of them active it is stable" };
            let words = in_words(found.connors, one);
            let tube = if one.bodies.is_empty() { "the tube" } else { "a tube" };
            Some(format!("with no support active the flow is {BEYOND_LIMIT} of {tube}: {words}{held}"))
        })
    }
}

/// That margins in a flow were not asked for.
const UNKNOWN: &str = "whether this flow is within the fluid-elastic limit, beyond which work rates mean nothing, is \
                       not known: [flow] with connors = 3.0, say, tells the margins";

/// The mode of the least margin, if that is below 1.
fn unstable(margins: &[FlowMargin]) -> Option<&FlowMargin> {
    FluidElastic::least(margins).filter(|one| one.margin < Some(1.0))
}

/// A margin with three decimals, or as many more as tell it from 1.
pub(crate) fn margin_in_words(margin: f64) -> String {
    let texts = (3..=9).map(|decimals| format!("{margin:.decimals$}"));
    let tells = |text: &String| text.parse::<f64>().is_ok_and(|shown| (shown < 1.0) == (margin < 1.0));
    texts.into_iter().find(tells).unwrap_or_else(|| margin.to_string())
}

fn in_words(connors: f64, one: &FlowMargin) -> String {
    format!(
        "V_e {:.4} m/s, critical {:.4} m/s, margin {} by Connors with K = {connors}, in the mode of {:.4} Hz{}",
        one.effective_velocity_m_per_s,
        one.critical_velocity_m_per_s,
        margin_in_words(one.margin.unwrap_or(f64::INFINITY)),
        one.frequency_hz,
        one.of_bodies()
    )
}
