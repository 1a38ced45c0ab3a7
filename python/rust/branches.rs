//! Branches of periodic orbits over a key of a case, and the page of a folder of results.

use crate::case::Case;
use crate::error::raise;
use crate::work::compute_beside;
use pyo3::prelude::*;
use serde_json::json;
use signorini::orbit::{Kind, branch};
use signorini::output::atomic::write_whole;
use signorini::output::branch_folder::{self, BranchRequest, BranchSettings};
use signorini::output::first_orbit::FirstOrbit;
use signorini::output::format::{Format, Formats};
use signorini::output::request::{extended, request};
use signorini::output::results::Results;
use signorini::output::scene_family::SceneFamily;
use signorini::output::varied::KeyRange;
use signorini::report;
use std::path::PathBuf;

/// Where branches begin and how far they are followed: the file of an orbit, or the forcing periods
/// that are run first; switch, depth and points.
type Asked = (Option<PathBuf>, u32, String, u32, u32);

/// The case beside its branches, for the command on their page that finds an orbit again.
const CASE: &str = "case.toml";

/// Follows the branches of `case` over `key` within `range`, and writes their files into `folder`,
/// for a `page` with the motion of the orbits. Returns the kinds of events at which a body arrives.
#[pyfunction]
pub fn _branches(
    py: Python<'_>,
    case: &Case,
    key: &str,
    range: [f64; 2],
    asked: Asked,
    folder: PathBuf,
    page: bool,
) -> PyResult<Vec<&'static str>> {
    let (start, settle, switch, depth, points) = asked;
    let follow = BranchRequest { switch: switch.parse().map_err(raise)?, depth, points };
    let settings = json!(BranchSettings {
        key,
        range: &format!("{}:{}", range[0], range[1]),
        from: start.as_deref(),
        settle,
        switch: &switch,
        depth,
        points,
        over: None,
        second: None,
        second_range: None,
        locus: &[],
    });
    let asked = KeyRange { names: ["key", "range"], key, range };
    let text = case.file.text().map_err(raise)?;
    let work = || {
        let family = SceneFamily::new(case.file.clone(), &asked, None)?;
        let (case, problem) = (&family.case, family.problem.as_ref());
        // What cannot be read or written is refused before anything runs.
        let read = start.as_deref().map(|path| FirstOrbit::read(path, case, problem)).transpose()?;
        let formats = Formats { pictures: vec![Format::Svg], workbook: false };
        let mut results = Results::open(&folder, extended(request("continue", case, &[]), settings), false, formats)?;
        results.add_to_manifest("title", json!(case.title));
        let settled = || FirstOrbit::settled(&case.scene, problem, settle, &|_| {});
        let found: branch::Graph = follow.follow(&family, &read.map_or_else(settled, Ok)?, &mut |_| {})?;
        if page {
            write_whole(&results.place(CASE)?, text.as_bytes())?;
            results.add_to_manifest("orbit_command", json!(format!("signorini orbit {CASE}")));
        }
        branch_folder::write(&mut results, &branch_folder::drawn(&found, &family), &family, None, page)?;
        results.finish()
    };
    compute_beside(py, work, &mut |_| Ok(()))?;
    Ok(Kind::ALL.into_iter().filter(|kind| kind.is_approach()).map(Kind::name).collect())
}

/// Writes the page of the results in `folder`. Returns its path, and what is to be said of it.
#[pyfunction]
pub fn _report(
    py: Python<'_>,
    folder: PathBuf,
    over: Option<PathBuf>,
    out: Option<PathBuf>,
) -> PyResult<(PathBuf, Option<&'static str>)> {
    let work = || report::write(&folder, over.as_deref(), out.as_deref());
    let report::Written { path, verified }: report::Written = compute_beside(py, work, &mut |_| Ok(()))?;
    Ok((path, (!verified).then_some(report::UNVERIFIED)))
}
