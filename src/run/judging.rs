//! Whether a run is judged.

use crate::residual::{Finding, Judge, Residuals, penetration};
use crate::scene::{Scene, State};
use crate::scheme::Stepper;
use crate::step::{QuietSteps, Step};
use crate::trajectory::Trajectory;
use std::fmt::Debug;

mod sealed {
    pub trait Sealed {}
    impl Sealed for super::Judged {}
    impl Sealed for super::Unjudged {}
}

/// Whether a run is judged: [`Judged`] or [`Unjudged`], no others.
pub trait Judging: sealed::Sealed + Debug + Copy {
    /// The result of the judge: [`Residuals`], or nothing.
    type Verdict: Debug + Clone;
    /// The list of [`Finding`]s, or nothing.
    type Findings: Debug + Clone;
    #[doc(hidden)]
    type Judge;
    #[doc(hidden)]
    fn begin(stepper: &Stepper, step: f64, start: &State) -> Self::Judge;
    #[doc(hidden)]
    fn observe(judge: &mut Self::Judge, step: &Step<'_>);
    /// Whether processing many steps at once is faster; `None` if it does not look at steps.
    #[doc(hidden)]
    fn batches_quiet_steps(judge: &Self::Judge) -> Option<bool>;
    #[doc(hidden)]
    fn observe_quiet(judge: &mut Self::Judge, quiet: &QuietSteps);
    #[doc(hidden)]
    fn verdict(judge: Self::Judge, recorded: Option<&Trajectory>, scene: &Scene) -> (Self::Verdict, Self::Findings);
    #[doc(hidden)]
    fn residuals(verdict: &Self::Verdict) -> Option<&Residuals>;
    #[doc(hidden)]
    fn findings(findings: &Self::Findings) -> &[Finding];
    /// Puts a finding about the run as a whole first.
    #[doc(hidden)]
    fn find(findings: &mut Self::Findings, finding: Finding);
    #[doc(hidden)]
    const JUDGED: bool;
}

/// The run is judged step by step.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Judged;

/// The run is not judged.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Unjudged;

impl Judging for Judged {
    type Verdict = Residuals;
    type Findings = Vec<Finding>;
    type Judge = Judge;

    fn begin(stepper: &Stepper, step: f64, start: &State) -> Judge {
        let scene = stepper.checked();
        Judge::over(scene.shared(), scene.wall_masses(), stepper.contract(), step, (&start.q, &start.v))
    }

    fn observe(judge: &mut Judge, step: &Step<'_>) {
        judge.observe(step);
    }

    fn batches_quiet_steps(judge: &Judge) -> Option<bool> {
        Some(judge.batches_quiet_steps())
    }

    fn observe_quiet(judge: &mut Judge, quiet: &QuietSteps) {
        judge.observe_quiet(quiet);
    }

    fn verdict(mut judge: Judge, recorded: Option<&Trajectory>, scene: &Scene) -> (Residuals, Vec<Finding>) {
        if let Some(trajectory) = recorded {
            let sums: Vec<f64> = trajectory.contact_impulses().iter().map(|column| column.iter().sum()).collect();
            judge.hear(&sums);
            let sum = |column: &Vec<f64>| column.iter().sum();
            let holes: Vec<[f64; 2]> = trajectory.hole_impulses().iter().map(|[y, z]| [sum(y), sum(z)]).collect();
            judge.hear_holes(&holes);
        }
        let mut residuals = judge.residuals();
        residuals.penetration_m = penetration(scene, &residuals.depth_m);
        (residuals, judge.findings())
    }

    fn residuals(verdict: &Residuals) -> Option<&Residuals> {
        Some(verdict)
    }

    fn findings(findings: &Vec<Finding>) -> &[Finding] {
        findings
    }

    fn find(findings: &mut Vec<Finding>, finding: Finding) {
        findings.insert(0, finding);
    }

    const JUDGED: bool = true;
}

impl Judging for Unjudged {
    type Verdict = ();
    type Findings = ();
    type Judge = ();

    fn begin(_: &Stepper, _: f64, _: &State) {}

    fn observe((): &mut (), _: &Step<'_>) {}

    fn batches_quiet_steps((): &()) -> Option<bool> {
        None
    }

    fn observe_quiet((): &mut (), _: &QuietSteps) {}

    fn verdict((): (), _: Option<&Trajectory>, _: &Scene) -> ((), ()) {
        ((), ())
    }

    fn residuals((): &()) -> Option<&Residuals> {
        None
    }

    fn findings((): &()) -> &[Finding] {
        &[]
    }

    fn find((): &mut (), _: Finding) {}

    const JUDGED: bool = false;
}
