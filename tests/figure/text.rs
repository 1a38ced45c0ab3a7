//! What the SVG text must hold whatever the data: a document, of bounded size, the same each time.
use crate::draws;
use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use signorini::output::figure::{Class, Curve, Figure, HeatMap, Mark, Panel, Scale};

/// All numbers of the path data in the document.
fn path_numbers(svg: &str) -> Vec<f64> {
    let document = roxmltree::Document::parse(svg).unwrap();
    let paths: Vec<&str> = document.descendants().filter_map(|node| node.attribute("d")).collect();
    let numbers = paths.iter().flat_map(|d| d.split(|c: char| !(c.is_ascii_digit() || c == '.' || c == '-')));
    numbers.filter(|s| !s.is_empty()).map(|s| s.parse().unwrap()).collect()
}

fn texts(svg: &str) -> Vec<String> {
    let document = roxmltree::Document::parse(svg).unwrap();
    let texts = document.descendants().filter(|node| node.has_tag_name("text"));
    texts.map(|node| node.descendants().filter(|n| n.is_text()).filter_map(|n| n.text()).collect()).collect()
}

fn line(points: Vec<(f64, f64)>) -> Figure {
    Figure::new("Title", "Time (s)").panel(Panel::new("Value (m)").curve(Curve::new("one", points)))
}

#[test]
fn hostile_labels_are_escaped_everywhere() {
    let nasty = "<&\">' $x$ \u{0}\u{1b}\u{ffff}\n]]> é 日本";
    let figure = Figure::new(nasty, nasty).panel(
        Panel::new(nasty)
            .heading(nasty)
            .curve(Curve::new(nasty, [(0.0, 0.0), (1.0, 1.0)]))
            .mark(Mark::wall(0.5, nasty))
            .mark(Mark::floor(0.5, nasty).upright()),
    );
    let svg = figure.to_svg();
    assert!(texts(&svg).iter().any(|text| text.contains("<&\">' $x$")), "{svg}");
    let map = HeatMap::new(nasty, (nasty, Scale::Log, &[1.0, 2.0]), (nasty, Scale::Linear, &[0.0, 1.0]));
    roxmltree::Document::parse(&map.clone().classes(vec![Class::new(nasty, '<')], vec![0; 4]).to_svg()).unwrap();
    roxmltree::Document::parse(&map.numbers(nasty, Scale::Linear, vec![1.0; 4]).to_svg()).unwrap();
}

#[test]
fn nothing_a_point_and_a_constant_are_drawn() {
    for points in [vec![], vec![(1.0, 1.0)], vec![(0.0, 0.0); 3], vec![(0.0, 2.0), (1.0, 2.0)], vec![(0.0, -1e-300)]] {
        for log in [false, true] {
            let panel = Panel::new("y").curve(Curve::new("a", points.clone()).marked());
            let panel = panel.stems(Curve::new("b", points.clone())).mark(Mark::wall(0.0, "wall"));
            let figure = Figure::new("", "").panel(if log { panel.log() } else { panel });
            path_numbers(&if log { figure.log() } else { figure }.to_svg());
        }
    }
    roxmltree::Document::parse(&Figure::new("no panel", "").to_svg()).unwrap();
    let empty = HeatMap::new("", ("", Scale::Log, &[]), ("", Scale::Log, &[]));
    roxmltree::Document::parse(&empty.clone().to_svg()).unwrap();
    roxmltree::Document::parse(&empty.numbers("", Scale::Linear, vec![f64::NAN]).to_svg()).unwrap();
}

#[test]
fn what_is_not_finite_breaks_the_line_and_leaves_the_axes_alone() {
    let clean = line(vec![(0.0, 0.0), (1.0, 1.0), (2.0, -1.0), (3.0, 1.0), (4.0, 0.0)]).to_svg();
    let broken = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1e305]
        .map(|bad| line(vec![(0.0, 0.0), (1.0, 1.0), (2.0, -1.0), (2.5, bad), (3.0, 1.0), (4.0, 0.0)]).to_svg());
    for svg in &broken {
        assert_eq!(texts(svg), texts(&clean));
        assert_eq!(svg, &broken[0]);
    }
    let moves = |svg: &str| svg.matches('M').count();
    assert_eq!(moves(&broken[0]), moves(&clean) + 1);
}

#[test]
fn a_million_points_stay_small_and_keep_their_extremes() {
    let mut points: Vec<(f64, f64)> =
        (0..1_000_000).map(|i| f64::from(i) * 1e-5).map(|t| (t, (900.0 * t).sin())).collect();
    points[345_678].1 = 7.0;
    points[765_432].1 = -9.0;
    let svg = line(points.clone()).to_svg();
    assert!(svg.len() < 300_000, "{} bytes", svg.len());
    // The frame holds [-9, 7] with 6 % of 16 above and below: the extremes stand at 0.96/17.92 of
    // its 260 units.
    let document = roxmltree::Document::parse(&svg).unwrap();
    let window = document.descendants().filter(|node| node.has_tag_name("svg")).nth(1).unwrap();
    let top: f64 = window.attribute("y").unwrap().parse().unwrap();
    let ys: Vec<f64> = path_numbers(&svg);
    for share in [0.96 / 17.92, 1.0 - 0.96 / 17.92] {
        let expected = top + 260.0 * share;
        assert!(ys.iter().any(|y| (y - expected).abs() <= 0.051), "no point at {expected}");
    }
    points.retain(|(t, _)| *t < 2.0);
    let many = (0..12).fold(Panel::new("y"), |panel, k| panel.curve(Curve::new(format!("curve {k}"), points.clone())));
    let svg = Figure::new("", "").panel(many.stems(Curve::new("stems", points.clone()))).to_svg();
    assert!(svg.len() < 300_000, "{} bytes", svg.len());
    let orbit = points.iter().map(|(t, v)| ((1.0 + 0.1 * t) * (800.0 * t).cos(), v * (1.0 + 0.1 * t)));
    let svg = line(orbit.collect()).to_svg();
    assert!(svg.len() < 300_000, "{} bytes", svg.len());
}

#[test]
fn a_far_wall_does_not_flatten_the_curve() {
    let near = |wall: f64| {
        let panel = Panel::new("y").curve(Curve::new("", [(0.0, -1.0), (1.0, 1.0)])).mark(Mark::wall(wall, "wall"));
        texts(&Figure::new("", "").panel(panel).to_svg())
    };
    assert!(near(5.0).contains(&"wall".to_owned()));
    assert!(near(5e3).contains(&"↑ wall".to_owned()));
    assert!(near(-5e3).contains(&"↓ wall".to_owned()));
}

#[test]
fn ticks_are_round_numbers_and_powers_of_ten() {
    let labels = texts(&line(vec![(0.0, -3e-6), (10.0, 3e-6)]).to_svg());
    for expected in ["0", "2", "10", "−2", "×10−6"] {
        assert!(labels.iter().any(|label| label == expected), "{expected} is not among {labels:?}");
    }
    let chart = Panel::new("Time (s)").log().curve(Curve::new("", [(1e-9, 1e-6), (1e-1, 1e1)]));
    let labels = texts(&Figure::new("", "Error").log().panel(chart).to_svg());
    for expected in ["10−8", "10−4", "100"] {
        assert!(labels.iter().any(|label| label == expected), "{expected} is not among {labels:?}");
    }
}

#[test]
fn one_label_has_one_legend_entry_and_the_same_data_the_same_bytes() {
    let curve = |label: &str, height: f64| Curve::new(label, [(0.0, 1.0), (1.0, height)]);
    let panel = || Panel::new("y").curve(curve("event", 2.0)).curve(curve("moreau-jean", 3.0));
    let figure = Figure::new("", "").panel(panel()).panel(panel());
    for label in ["event", "moreau-jean"] {
        assert_eq!(texts(&figure.to_svg()).iter().filter(|text| *text == label).count(), 1);
    }
    // What is alone needs no legend.
    let alone = Figure::new("", "").panel(Panel::new("y").curve(curve("event", 2.0)));
    assert!(!texts(&alone.to_svg()).contains(&"event".to_owned()));
    assert_eq!(figure.to_svg(), figure.clone().to_svg());
}

fn any_number() -> impl Strategy<Value = f64> {
    prop_oneof![any::<f64>(), -10.0..10.0, Just(0.0), Just(f64::MAX), Just(f64::MIN_POSITIVE), Just(-f64::MAX)]
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: draws::cases(200),
        rng_seed: RngSeed::Fixed(draws::seed(1)),
        ..ProptestConfig::default()
    })]
    #[test]
    fn any_data_give_a_document(
        points in prop::collection::vec((any_number(), any_number()), 0..40),
        marks in prop::collection::vec(any_number(), 0..4),
        range in prop::option::of((any_number(), any_number())),
        label in any::<String>(),
        (log_x, log_y) in any::<(bool, bool)>(),
    ) {
        let mut panel = Panel::new(label.clone())
            .heading(label.clone())
            .curve(Curve::new(label.clone(), points.clone()).marked())
            .curve(Curve::new("front", points.clone()).front())
            .stems(Curve::new("stems", points.clone()));
        for mark in &marks {
            panel = panel.mark(Mark::wall(*mark, label.clone())).mark(Mark::floor(*mark, label.clone()).upright());
        }
        if let Some((low, high)) = range {
            panel = panel.range(low, high);
        }
        let figure = Figure::new(label.clone(), label.clone()).panel(if log_y { panel.log() } else { panel });
        let svg = if log_x { figure.log() } else { figure }.to_svg();
        prop_assert!(path_numbers(&svg).iter().all(|number| number.is_finite()));
        prop_assert!(!svg.contains("NaN") && !svg.contains("inf"), "{}", svg);
        let (x, y): (Vec<f64>, Vec<f64>) = points.iter().copied().unzip();
        let scale = |log| if log { Scale::Log } else { Scale::Linear };
        let map = HeatMap::new(label.clone(), (&label, scale(log_x), &x), (&label, scale(log_y), &y));
        let svg = map.clone().numbers(label.clone(), scale(log_y), y.repeat(3)).to_svg();
        path_numbers(&svg);
        let svg = map.classes(vec![Class::new(label, 'A'); 3], (0..50).map(|i| i % 5).collect()).to_svg();
        path_numbers(&svg);
    }
}
