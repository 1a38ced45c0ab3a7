//! Histories of wear: the steps over the years.

use signorini::case::{Case, CaseFile};
use signorini::study::wear_history::{WearHistories, WearPlan, WearQuantity, WearingSupport};
use signorini::wear::{Archard, Growth};
use signorini::{Error, Method, Options, Result, Scene, Scheme};

const MOREAU: Scheme = Scheme::MoreauJean { theta: 0.5 };

/// A mass that slides round a hole by its own speed, with the law of wear of the hole.
fn sliding() -> Case {
    let mut file = CaseFile::embedded("whirl-in-a-hole").unwrap();
    let values: [(&str, f64); 7] = [
        ("support.hole.friction", 0.0),
        ("support.hole.width", 25e-3),
        ("support.hole.radius", 9.525e-3),
        ("wear.support_coefficient", 1e-12),
        ("wear.service", 1.0),
        ("time.end", 0.02),
        ("system.oscillator.stiffness", 0.0),
    ];
    for (key, value) in values {
        file.set(&key.parse().unwrap(), &value.into()).unwrap();
    }
    file.case().unwrap()
}

/// Histories in which each window begins at the hole, with a speed of its gap to the power `power`
/// times 20/s, and without loads.
fn follow(power: i32, service: f64) -> Result<WearHistories> {
    follow_supports(power, service, sliding().wearing_supports().unwrap())
}

fn follow_supports(power: i32, service: f64, supports: Vec<WearingSupport>) -> Result<WearHistories> {
    let case = sliding();
    let scene = |number: u64, openings: &[_]| {
        let scene = case.worn(number, &supports, openings)?;
        let gap = scene.holes().next().map_or(0.0, |hole| hole.gap);
        let mut scene = Scene { loads: Vec::new(), ..scene };
        (scene.initial.q, scene.initial.v) = (vec![gap, 0.0], vec![0.0, 20.0 * 5e-3 * (gap / 5e-3).powi(power)]);
        Ok(scene)
    };
    let (method, options) = (Method::from(MOREAU), Options::with_step(1e-3));
    let plan =
        WearPlan { supports: &supports, scene: &scene, method: &method, options: &options, histories: 1, service };
    plan.follow(&[], &mut |_| Ok(()), &mut |_| {})
}

/// N = m v²/γ and W = N v fall with the gap where the speed does not grow with it: the gap
/// grows less than in proportion to the time, in steps that lengthen with it. Over years that are
/// 1e4 times as long as the gap takes to grow by half, none of them is longer.
#[test]
fn no_step_makes_a_gap_more_than_half_as_large_again_however_long_the_service() {
    let first = follow(0, 1.0).unwrap().points[0].histories[0][0].work_rate_w;
    // dγ/dt = k W/(2π R w).
    let half = 0.5 * 5e-3 / (1e-12 * first / (std::f64::consts::TAU * 9.525e-3 * 25e-3));
    let gaps: Vec<f64> =
        follow(0, 1e4 * half).unwrap().points.iter().map(|point| point.histories[0][0].gap_m).collect();
    assert!(gaps.len() > 8 && *gaps.last().unwrap() > 0.05, "{gaps:?}");
    // The second rate of a step is the smaller one.
    assert!(gaps.windows(2).all(|pair| pair[0] < pair[1] && pair[1] <= 1.5 * pair[0]), "{gaps:?}");
}

/// Where the gap stays, so that the work rate is constant, a scar of the depth d in the hole has
/// the volume k W t. Its cross-section is that of the tube outside the hole, here by quadrature in
/// polar coordinates about the centre of the tube. The year at which it is d deep does not depend
/// on the years of the study, which has one step.
#[test]
fn the_year_of_a_limit_follows_from_the_geometry_of_the_scar_whatever_the_years() {
    let mut supports = sliding().wearing_supports().unwrap();
    let (k, depth) = (1e-13, 0.4e-3);
    supports[0].growth = Growth::Kept;
    supports[0].law = Archard { coefficient: Some(k), ..supports[0].law };
    let rate = follow(0, 1.0).unwrap().points[0].histories[0][0].work_rate_w;
    let (radius, gap, width) = (9.525e-3, 5e-3, 25e-3);
    let (hole, centre, parts) = (radius + gap, gap + depth, 400_000);
    let outside = |angle: f64| {
        let reach = (hole * hole - (centre * angle.sin()).powi(2)).sqrt() - centre * angle.cos();
        0.5 * (radius * radius - reach * reach).max(0.0)
    };
    let step = std::f64::consts::PI / f64::from(parts);
    let area: f64 = (0..parts).map(|part| 2.0 * step * outside((f64::from(part) + 0.5) * step)).sum();
    let wanted = area * width / (k * rate);
    for share in [0.3, 1.7, 5.0] {
        let found = follow_supports(0, share * wanted, supports.clone()).unwrap();
        assert_eq!(found.windows, 3, "two of a step and that of the end");
        let scar = WearQuantity::DepthOneScar;
        let [within, later] = [found.reaches(0, depth, scar), found.reaches_at_last_rate(0, depth, scar)];
        assert_eq!([within, later].map(|time| time.is_some()), [share > 1.0, share < 1.0]);
        let time = within.or(later).unwrap();
        // The error of the quadrature.
        assert!((time.time_s / wanted - 1.0).abs() < 1e-7, "{share}: {time:?}, {wanted}");
        // Points between the windows let straight lines follow the depth.
        let depths = |point: &signorini::study::wear_history::WearPoint| point.histories[0][0].depth_one_scar_m;
        let last = depths(found.points.last().unwrap());
        for pair in found.points.windows(2) {
            let middle = 0.5 * (pair[0].time_s + pair[1].time_s);
            let straight = 0.5 * (depths(&pair[0]) + depths(&pair[1]));
            let then = found.reaches(0, straight, scar).unwrap().time_s;
            assert!((middle - then).abs() * (last / found.points.last().unwrap().time_s) < 0.05 * last);
        }
    }
}

/// Without friction the speed stays, so that W = m v³/γ and dγ/dt = κ/γ: γ² = γ₀² + 2κt. Within a
/// step the gap follows that as closely as at its end, of the order of the steps, and the estimated
/// error of these holds it.
#[test]
fn a_limit_within_a_step_is_reached_when_the_differential_equation_reaches_it() {
    let (k, radius, width, gap) = (1e-12, 9.525e-3, 25e-3, 5e-3);
    let mut supports = sliding().wearing_supports().unwrap();
    supports[0].law = Archard { coefficient: Some(k), support_coefficient: None, ..supports[0].law };
    let first = follow_supports(0, 1.0, supports.clone()).unwrap().points[0].histories[0][0].work_rate_w;
    let growth = k * first / (std::f64::consts::TAU * radius * width);
    let until = |grown: f64| ((gap + grown).powi(2) - gap * gap) / (2.0 * growth * gap);
    let found = follow_supports(0, until(0.5 * gap), supports).unwrap();
    for share in [0.01, 0.03, 0.07, 0.1, 0.2, 0.3] {
        let (wanted, depth) = (until(share * gap), share * gap);
        let reached = found.reaches(0, depth, WearQuantity::DepthAllRound).unwrap();
        let error = reached.time_s / wanted - 1.0;
        // A step grows the gap by at most a tenth, where Heun's and Euler's differ by 0.5 %.
        assert!(error.abs() < 1e-3, "{share}: {error:e}");
        assert!(error.abs() < reached.half_width_95_s.unwrap() / wanted, "{share}: {error:e}, {reached:?}");
    }
}

/// W grows like γ² where the speed grows like the gap: it is infinite after a time, which no
/// service passes.
#[test]
fn gaps_without_bound_are_an_error_that_says_how_far_they_can_be_followed() {
    let Err(Error::Invalid { subject, expected, .. }) = follow(1, 1e15) else { panic!("an error") };
    assert_eq!(subject.to_string(), "service");
    assert!(expected.starts_with("at most ") && expected.contains("half as large again"), "{expected}");
}
