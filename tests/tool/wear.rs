//! `signorini wear`: gaps that grow by the closed form, histories that are those of their windows,
//! limits, and what is refused.
use crate::command::{command, said};
use crate::shaken::square_of_bars;
use crate::table::{number, rows};
use std::collections::HashMap;
use std::f64::consts::TAU;
use std::fs;
use std::process::Stdio;
use std::time::Duration;

/// The mass that whirls in a hole of 25 mm width, which alone wears; after 5 s it has settled in
/// the gap of the window.
const WHIRL: [&str; 13] = [
    "whirl-in-a-hole",
    "--set",
    "time.end=6",
    "--set",
    "time.statistics_from=5",
    "--set",
    "wear.service=3e6",
    "--set",
    "wear.support_coefficient=1e-12",
    "--set",
    "support.hole.width=25e-3",
    "--set",
    "support.hole.radius=9.525e-3",
];

/// The work rate of the steady whirl in a gap, W: N Ω γ, with N from the balance of forces in the
/// turning frame.
fn whirling(gap: f64) -> f64 {
    let (mass, damping, stiffness, force, friction, omega) = (1.0, 0.2, 100.0, 3.0, 0.2, TAU * 5.0);
    let outwards = (mass * omega * omega - stiffness) * gap;
    let mut normal = outwards;
    for _ in 0..100 {
        let along: f64 = damping * omega * gap + friction * normal;
        normal = outwards + (force * force - along * along).sqrt();
    }
    normal * omega * gap
}

#[test]
fn the_gap_of_a_steady_whirl_grows_by_its_closed_form() {
    assert!((whirling(5e-3) / 1.109_652_491_907 - 1.0).abs() < 1e-11);
    let dir = tempfile::tempdir().unwrap();
    // dγ/dt = k N(γ) Ω γ/(2πRw), by Runge and Kutta's method of order 4 with 1e5 steps; at the rate
    // of the first gap it would grow to 5.741655 and 7.224966 mm.
    for (service, wanted) in [(1e6, 5.838_430e-3), (3e6, 8.384_043e-3)] {
        let years = (service / 31_557_600.0).to_string();
        let (out, err) =
            said(dir.path(), &[&["wear"], &WHIRL[..], &["--years", &years, "--force", "--out", "w"]].concat(), 0);
        assert!(out.contains("support") && out.contains("gap") && out.contains("hole"), "{out}");
        assert!(err.contains("evenly all round") && err.contains("± is what the 95 % intervals"), "{err}");
        let history = rows(&dir.path().join("w/history.csv"));
        let last = history.last().unwrap();
        // Heun's steps whose corrections are up to 0.5 % of the gap leave 0.2 % of its growth.
        let grown = (number(last, "gap_m") - 5e-3) / (wanted - 5e-3);
        assert!((grown - 1.0).abs() < 4e-3, "{grown}");
        assert!((number(last, "year") * 31_557_600.0 / service - 1.0).abs() < 1e-12);
        for row in &history {
            // Each window has the work rate of its gap, to what 5 s leave of the impact at the
            // start, since the gap is larger than where the motion starts: 1.6e-5 was found.
            let (gap, rate) = (number(row, "gap_m"), number(row, "work_rate_W"));
            assert!((rate / whirling(gap) - 1.0).abs() < 5e-5, "{gap}: {rate}");
            let grown = 1e-12 * number(row, "work_J") / (TAU * 9.525e-3 * 25e-3);
            assert!((gap - 5e-3 - grown).abs() < 1e-15);
            // The mass has no coefficient.
            assert_eq!(number(row, "depth_all_round_m"), 0.0);
        }
        // A steady motion has an interval, of rounding: its periods agree. What is left is the
        // error of the steps over the years, which holds the truth and is a few times as large at
        // most.
        let years = rows(&dir.path().join("w/years.csv"));
        for row in &years {
            let share = number(row, "work_rate_half_width_95_W") / number(row, "work_rate_W");
            assert!((0.0..1e-12).contains(&share), "{share}");
        }
        let last = years.last().unwrap();
        let (error, half_width) = ((number(last, "gap_m") - wanted).abs(), number(last, "gap_half_width_95_m"));
        assert!(error <= half_width && half_width < 5.0 * error, "{error} m, ± {half_width} m");
        assert_eq!(number(&years[0], "gap_half_width_95_m"), 0.0);
    }
}

const TUBE: [&str; 7] = [
    "tube-in-cross-flow",
    "--set",
    "time.end=0.5",
    "--set",
    "time.statistics_from=0.1",
    "--set",
    "wear.coefficient=1e-13",
];

#[test]
fn histories_are_those_of_their_windows_and_years_their_means() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path();
    let (out, err) =
        said(path, &[&["wear"], &TUBE[..], &["--histories", "4", "--years", "20", "--out", "w"]].concat(), 0);
    assert!(out.contains("plate-1") && out.contains(" ± "), "{out}");
    assert!(err.contains("over 4 histories"), "{err}");
    let history = rows(&path.join("w/history.csv"));
    // The first windows are realisations 1 to 4 of the case.
    said(path, &[&["run"], &TUBE[..], &["--seeds", "4", "--no-verdict", "--out", "r"]].concat(), 0);
    let realisations = rows(&path.join("r/realisations.csv"));
    for row in history.iter().filter(|row| number(row, "year") == 0.0) {
        let same =
            |run: &&HashMap<String, String>| run["realisation"] == row["history"] && run["place"] == row["place"];
        let run = realisations.iter().filter(|run| run["kind"] == "support").find(same).unwrap();
        assert_eq!(run["work_rate_W"], row["work_rate_W"]);
        assert_eq!(number(row, "gap_m"), 0.2e-3);
    }
    let years = rows(&path.join("w/years.csv"));
    assert_eq!(4 * years.len(), history.len());
    for year in &years {
        let own: Vec<_> =
            history.iter().filter(|row| row["year"] == year["year"] && row["place"] == year["place"]).collect();
        assert_eq!(own.len(), 4);
        if number(year, "year") == 0.0 {
            assert_eq!((number(year, "gap_m"), number(year, "gap_half_width_95_m")), (0.2e-3, 0.0));
        }
        for column in ["gap_m", "depth_all_round_m", "depth_one_scar_m", "work_rate_W"] {
            let values: Vec<f64> = own.iter().map(|row| number(row, column)).collect();
            let mean = values.iter().sum::<f64>() / 4.0;
            let square = values.iter().map(|x| (x - mean) * (x - mean)).sum::<f64>() / 3.0;
            // Student's t of 3 degrees of freedom at 97.5 %.
            let half = 3.182_446_305 * (square / 4.0).sqrt();
            let (stem, unit) = column.rsplit_once('_').unwrap();
            let told = number(year, &format!("{stem}_half_width_95_{unit}"));
            if column == "depth_one_scar_m" {
                // By the mean work, and by the half width of that: the depth in a hole grows like
                // the work to the power of 2/3 where it is far less than the gap, and nearly like
                // the work where it is far more.
                let work: Vec<f64> = own.iter().map(|row| number(row, "work_J")).collect();
                let mean_work = work.iter().sum::<f64>() / 4.0;
                let power = values.iter().map(|depth| depth.powf(1.5)).sum::<f64>() / 4.0;
                let depth = number(year, column);
                let [least, most] = [mean * (1.0 - 1e-9), power.powf(2.0 / 3.0) * (1.0 + 1e-9)];
                assert!((least..=most).contains(&depth), "{least} {depth} {most}");
                let square = work.iter().map(|x| (x - mean_work) * (x - mean_work)).sum::<f64>() / 3.0;
                let half = 3.182_446_305 * (square / 4.0).sqrt() / mean_work.max(f64::MIN_POSITIVE);
                let told = if depth > 0.0 { told / (half * depth) } else { 1.0 };
                assert!((0.66..=1.0).contains(&told), "{told} {half}");
                continue;
            }
            assert!((number(year, column) - mean).abs() <= 1e-12 * mean.abs());
            assert!((told - half).abs() <= 1e-8 * half + 1e-18, "{column}: {told} for {half}");
        }
    }
    // Tube and plate wear by the same coefficients here: 1e-13 and 1e-14.
    for row in &history {
        let depth = number(row, "depth_all_round_m");
        assert!((number(row, "gap_m") - 0.2e-3 - 1.1 * depth).abs() < 1e-15);
        let [scar, deepest] = ["depth_one_scar_m", "depth_deepest_m"].map(|column| number(row, column));
        assert!(depth == 0.0 || (scar > depth && deepest > depth));
        assert!((depth - 1e-13 * number(row, "work_J") / (TAU * 9.525e-3 * 25e-3)).abs() < 1e-15);
    }
    // The sectors at the end: of even wear they are the depth all round in the mean, unless one
    // scar of all of it is less deep than a sector.
    let sectors = rows(&path.join("w/sector-means.csv"));
    assert_eq!(sectors.len(), 24);
    for row in &years[years.len() - 2..] {
        let own: Vec<f64> =
            sectors.iter().filter(|one| one["place"] == row["place"]).map(|one| number(one, "depth_m")).collect();
        let mean = own.iter().sum::<f64>() / own.len() as f64;
        assert!(mean <= number(row, "depth_all_round_m") * (1.0 + 1e-9), "{mean}");
        assert!(mean > 0.5 * number(row, "depth_all_round_m"));
        // The deepest is at most the largest of these means, and at least the mean of all.
        let [deepest, largest] = [number(row, "depth_deepest_m"), own.iter().copied().fold(0.0, f64::max)];
        assert!(mean < deepest && deepest <= largest * (1.0 + 1e-12), "{mean} {deepest} {largest}");
    }
    // The same request gives the same bytes.
    said(path, &[&["wear"], &TUBE[..], &["--histories", "4", "--years", "20", "--out", "again"]].concat(), 0);
    for file in ["history.csv", "years.csv", "sector-means.csv", "wear.svg"] {
        assert!(fs::read(path.join("w").join(file)).unwrap() == fs::read(path.join("again").join(file)).unwrap());
    }
}

#[test]
fn a_limit_is_reached_after_years_that_are_told() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path();
    let limit = ["--set", "wear.limit=0.1", "--histories", "2", "--years", "200", "--json", "--out", "w"];
    let (out, _) = said(path, &[&["wear"], &TUBE[..], &limit].concat(), 0);
    let document: serde_json::Value = serde_json::from_str(&out).unwrap();
    // A tenth of the wall of 1.65 mm.
    let found = &document["limits"][0];
    assert!((found["limit_m"].as_f64().unwrap() - 0.165e-3).abs() < 1e-12);
    let reached = found["limit_one_scar_years"].as_f64().unwrap();
    let years = rows(&path.join("w/years.csv"));
    let own: Vec<_> = years.iter().filter(|row| row["place"] == "plate-1").collect();
    let after = own.iter().position(|row| number(row, "depth_one_scar_m") >= 0.165e-3).unwrap();
    assert!(number(own[after - 1], "year") <= reached && reached <= number(own[after], "year"));
    assert!(found["limit_all_round_years"].as_f64().is_none_or(|years| years > reached));
    // The same of each history, of which the mean lies in between; and the means of years.csv.
    let each: Vec<f64> = found["limit_one_scar_years_of_histories"]
        .as_array()
        .unwrap()
        .iter()
        .map(|years| years.as_f64().unwrap_or(f64::INFINITY))
        .collect();
    let (first, last) = (each.iter().copied().fold(f64::INFINITY, f64::min), each.iter().copied().fold(0.0, f64::max));
    assert!(each.len() == 2 && first <= reached && reached <= last, "{each:?} {reached}");
    let told = document["years"].as_array().unwrap();
    assert_eq!(told.len(), years.len());
    for (told, row) in told.iter().zip(&years) {
        assert_eq!(told["place"], row["place"].as_str());
        for column in ["year", "gap_m", "depth_deepest_m", "depth_deepest_half_width_95_m"] {
            assert_eq!(told[column].as_f64(), Some(number(row, column)), "{column}");
        }
    }
    let remarks = document["remarks"].to_string();
    assert!(remarks.contains("the tube reaches the limit of 0.165 mm at support \\\"plate-1\\\" after"), "{remarks}");
    // Another limit changes no window: none is run again.
    let twice = ["--set", "wear.limit=0.2", "--histories", "2", "--years", "200", "--json", "--out", "w"];
    let (out, err) = said(path, &[&["wear"], &TUBE[..], &twice].concat(), 0);
    assert!(err.contains("all of them there already"), "{err}");
    let other: serde_json::Value = serde_json::from_str(&out).unwrap();
    assert!((other["limits"][0]["limit_m"].as_f64().unwrap() - 0.33e-3).abs() < 1e-12);
    assert_eq!(other["years"], document["years"]);
    // After two years the limit is far: the document has what the text says, at the last rates.
    let soon = ["--set", "wear.limit=0.9", "--histories", "2", "--years", "2", "--json", "--out", "w2"];
    let (out, _) = said(path, &[&["wear"], &TUBE[..], &soon].concat(), 0);
    let document: serde_json::Value = serde_json::from_str(&out).unwrap();
    let found = &document["limits"][0];
    assert!(found["limit_one_scar_years"].is_null() && found["limit_one_scar_half_width_95_years"].is_null());
    let later = found["limit_one_scar_years_at_last_rate"].as_f64().unwrap();
    let half = found["limit_one_scar_half_width_95_years_at_last_rate"].as_f64().unwrap();
    let remarks = document["remarks"].to_string();
    let (before, _) = remarks.split_once(" if all of its wear comes off one scar").unwrap();
    // The interval is wider than the time: the rate may be none.
    let told = before.rsplit_once("after ").unwrap().1.strip_suffix(" (or never)").unwrap();
    let (years, scatter) = told.split_once(" ± ").unwrap();
    // The text has two figures of the half width.
    let [years, scatter] = [years, scatter].map(|words| words.parse::<f64>().unwrap());
    assert!(later > 2.0 && (years - later).abs() < 0.06 * half && (scatter - half).abs() < 0.06 * half, "{remarks}");
    // A run tells of its scar by itself.
    let (_, err) = said(
        path,
        &[
            &["run"],
            &TUBE[..],
            &["--set", "wear.limit=0.1", "--set", "wear.coefficient=5e-15", "--no-verdict", "--out", "r"],
        ]
        .concat(),
        0,
    );
    assert!(err.contains("is deeper than the limit of 0.1650 mm"), "{err}");
}

#[test]
fn a_study_ends_where_the_deepest_depth_over_its_histories_is_the_wall() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path();
    let quick = ["--set", "wear.coefficient=1e-12", "--set", "time.step=2e-4", "--set", "system.modes=4"];
    let asked = [&["wear"], &TUBE[..5], &quick, &["--histories", "2"]].concat();
    let (out, err) = said(path, &[&asked[..], &["--years", "80", "--json", "--out", "w"]].concat(), 0);
    let document: serde_json::Value = serde_json::from_str(&out).unwrap();
    let found = &document["histories"]["worn_through"];
    let place = found["support"].as_str().unwrap();
    assert!((found["wall_m"].as_f64().unwrap() / 1.65e-3 - 1.0).abs() < 1e-14);
    let history = rows(&path.join("w/history.csv"));
    let end = number(history.last().unwrap(), "year");
    assert!(end < 80.0 && (found["time_s"].as_f64().unwrap() / 31_557_600.0 - end).abs() < 1e-12 * end);
    // In the last year its depth is the wall, and that of the other support is less deep; in no
    // year before is any.
    for row in rows(&path.join("w/years.csv")) {
        let last = row["place"] == place && number(&row, "year") == end;
        let depth = number(&row, "depth_deepest_m");
        assert!(if last { (depth / 1.65e-3 - 1.0).abs() < 1e-12 } else { depth < 1.65e-3 }, "{row:?}");
    }
    // By the depths of all sectors at the end: the largest mean of the two histories, of which each
    // alone is deeper elsewhere.
    let own = document["histories"]["supports"].as_array().unwrap().iter().position(|name| name == place).unwrap();
    let sectors = [0, 1].map(|history| -> Vec<f64> {
        let all = document["histories"]["depths_at_end_m"][history][own].as_array().unwrap();
        all.iter().map(|depth| depth.as_f64().unwrap()).collect()
    });
    let largest = |depths: &[f64]| depths.iter().copied().fold(0.0, f64::max);
    let sums: Vec<f64> = sectors[0].iter().zip(&sectors[1]).map(|(a, b)| a + b).collect();
    let each = 0.5 * (largest(&sectors[0]) + largest(&sectors[1]));
    let deepest = 0.5 * largest(&sums);
    assert!((deepest / 1.65e-3 - 1.0).abs() < 1e-12 && each > deepest, "{deepest} {each}");
    let told = document["remarks"].to_string();
    let words = format!("{place} is worn through after ");
    assert!(told.contains(&words) && told.contains(" years, by 1.65 mm where it is deepest over the 2 histories"));
    assert!(told.contains("there the study ends") && !told.contains("means nothing"), "{told} {err}");
    assert!(told.contains("the coefficients of wear are those of the case in every year"), "{told}");
    // More years change nothing, and no window is run for them.
    let (_, err) = said(path, &[&asked[..], &["--years", "90", "--out", "w"]].concat(), 0);
    assert!(err.contains("all of them there already"), "{err}");
    let again = rows(&path.join("w/history.csv"));
    assert_eq!(number(again.last().unwrap(), "year"), end);
}

#[test]
fn supports_that_the_tube_never_meets_are_said_to_wear_nowhere() {
    let dir = tempfile::tempdir().unwrap();
    let slow = ["--set", "turbulence.1.velocity=0.01", "--histories", "2", "--years", "20", "--out", "w"];
    let (_, err) = said(dir.path(), &[&["wear"], &TUBE[..], &slow].concat(), 0);
    assert!(err.contains("nothing wears at supports \"plate-1\", \"plate-2\": in no window"), "{err}");
}

#[test]
fn gaps_of_flats_stay_and_their_wear_is_counted() {
    let dir = tempfile::tempdir().unwrap();
    let wearing = ["--set", "wear.service=3.15576e8", "--set", "wear.coefficient=1e-14", "--histories", "2"];
    let bars = ["tube-lattice-bars", "--end", "0.4", "--set", "support.*.width=25e-3", "--out", "w"];
    let (_, err) = said(dir.path(), &[&["wear"], &bars[..], &wearing].concat(), 0);
    assert!(err.contains("stay as they are: flats wear"), "{err}");
    let history = rows(&dir.path().join("w/history.csv"));
    let (first, last) = (&history[0], history.last().unwrap());
    assert_eq!(number(last, "year"), 10.0);
    for row in &history {
        let own = history.iter().find(|other| other["place"] == row["place"]).unwrap();
        assert_eq!(row["gap_m"], own["gap_m"]);
        let depth = 1e-14 * number(row, "work_J") / (TAU * 9.525e-3 * 25e-3);
        assert!((number(row, "depth_all_round_m") - depth).abs() < 1e-15);
    }
    assert!(number(first, "work_J") == 0.0 && number(last, "work_J") > 0.0);
}

/// A mass of 1 kg that is pressed on a flat by 10 N and slides along it, steadily from the start.
const SLIDER: &str = r#"[system]
planes = 2

[system.oscillator]
mass = 1.0
damping = 2.0
stiffness = 0.0

[[support]]
name = "bar"
shape = "flats"
directions = [0]
gap = 5e-5
restitution = 0.0
width = 25e-3
radius = 9.525e-3
growth = "flats"

[[load]]
direction = 0
constant = { force = 10.0 }

[[load]]
direction = 90
harmonic = { amplitude = 20.0, frequency = 20.0 }

[initial]
velocity = [0.0, -0.1591146447]   # -F m W/(m^2 W^2 + c^2)

[wear]
coefficient = 4e-13
support_coefficient = 6e-13
service = 3e4

[time]
end = 0.6
step = 1e-4
statistics_from = 0.1
"#;

#[test]
fn a_flat_that_slides_steadily_recedes_as_its_volume_grows_evenly() {
    let dir = tempfile::tempdir().unwrap();
    fs::write(dir.path().join("slider.toml"), SLIDER).unwrap();
    let (_, err) = said(dir.path(), &["wear", "slider.toml", "--out", "w"], 0);
    assert!(
        err.contains("each flat recedes by its scar, of tube and flat or of both tubes together, and the gap is the"),
        "{err}"
    );
    // 10 N times the mean of |V sin|, 2V/π.
    let (mass, damping, omega) = (1.0_f64, 2.0_f64, TAU * 20.0);
    let rate = 10.0 * 4.0 / TAU * 20.0 / (mass * mass * omega * omega + damping * damping).sqrt();
    // The area of the segment that a chord at depth d cuts off the tube.
    let segment = |depth: f64| {
        let radius: f64 = 9.525e-3;
        let below = radius - depth;
        radius * radius * (below / radius).acos() - below * (radius * radius - below * below).sqrt()
    };
    let history = rows(&dir.path().join("w/history.csv"));
    assert!(history.len() >= 3);
    for row in &history {
        // Steps of 0.1 ms under |v|, whose corners they cut: h²W²/12, 1.3e-5.
        let found = number(row, "work_rate_W");
        assert!((found / rate - 1.0).abs() < 1e-4, "{found} for {rate}");
        let (work, time) = (number(row, "work_J"), 31_557_600.0 * number(row, "year"));
        assert!((work - rate * time).abs() <= 1e-4 * rate * time, "{work} J after {time} s");
        let (depth, deepest) = (number(row, "gap_m") - 5e-5, number(row, "depth_deepest_m"));
        // The cosine of a small angle loses digits of small areas.
        assert!((segment(depth) * 0.025 - 1e-12 * work).abs() < 1e-14 * 0.025 + 1e-9 * 1e-12 * work, "{depth}");
        assert!((segment(deepest) * 0.025 - 4e-13 * work).abs() < 1e-14 * 0.025 + 1e-9 * 1e-12 * work);
        assert_eq!((number(row, "shift_y_m"), number(row, "shift_z_m")), (0.0, 0.0));
    }
    let last = history.last().unwrap();
    // 3e-8 m³ times the ratio of rate and 1 W; with 1 W it is 0.350324 mm.
    assert!(((number(last, "gap_m") - 5e-5) / 0.350_324e-3 - rate.powf(2.0 / 3.0)).abs() < 1e-3, "{last:?}");
    // The deepest flat is the only one that is worn: its interval is that of the deepest wear.
    let years = rows(&dir.path().join("w/years.csv"));
    let flats = rows(&dir.path().join("w/sector-means.csv"));
    let of_flats = flats.iter().map(|row| number(row, "depth_half_width_95_m")).fold(0.0, f64::max);
    assert_eq!(of_flats, number(&years[years.len() - 1], "depth_deepest_half_width_95_m"));
}

#[test]
fn a_shifted_hole_is_the_hole_of_its_gap_and_centre() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path();
    // The whirl, pressed to one side, so that it works there more.
    said(path, &["new", "whirl-in-a-hole", "--out", "whirl.toml"], 0);
    let text = fs::read_to_string(path.join("whirl.toml")).unwrap();
    let own = "growth = \"shifted\"\nwidth = 25e-3\nradius = 9.525e-3\n\n\
               [[load]]\ndirection = 0\nconstant = { force = 2.0 }\n";
    let text = text.replacen("friction = 0.2\n", &format!("friction = 0.2\n{own}"), 1);
    fs::write(
        path.join("whirl.toml"),
        text + "statistics_from = 0.5\n\n[wear]\nsupport_coefficient = 1e-12\nservice = 1e6\n",
    )
    .unwrap();
    let (_, err) = said(path, &["wear", "whirl.toml", "--out", "w"], 0);
    assert!(err.contains("its centre moves to the deeper side"), "{err}");
    let history = rows(&path.join("w/history.csv"));
    assert!(history.len() >= 2);
    for row in &history {
        let grown = 1e-12 * number(row, "work_J") / (TAU * 9.525e-3 * 25e-3);
        assert!((number(row, "gap_m") - 5e-3 - grown).abs() < 1e-15);
        let moved = number(row, "shift_y_m").hypot(number(row, "shift_z_m"));
        assert!(moved <= grown * (1.0 + 1e-12) && (moved > 0.05 * grown || grown == 0.0), "{moved} of {grown}");
    }
    let last = history.last().unwrap();
    let gap = format!("support.hole.gap={}", last["gap_m"]);
    let centre = format!("support.hole.centre=[{}, {}]", last["shift_y_m"], last["shift_z_m"]);
    said(path, &["run", "whirl.toml", "--no-verdict", "--set", &gap, "--set", &centre, "--out", "r"], 0);
    let run = rows(&path.join("r/supports.csv"));
    assert_eq!(run[0]["work_rate_W"], last["work_rate_W"]);
}

#[test]
fn an_interval_takes_as_many_histories_as_run_takes_realisations() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path();
    let short = [&TUBE[..], &["--set", "system.modes=6"]].concat();
    let asked = ["--until-interval", "90%", "--years", "2"];
    let (out, err) = said(path, &[&["wear"], &short[..], &asked, &["--out", "w"]].concat(), 0);
    assert!(err.contains("pilots: after 6 realisations the work rate of support"), "{err}");
    // The study of the first windows is that of `run`: the same files, the same tables of errors.
    let (run, _) = said(path, &[&["run"], &short[..], &asked[..2], &["--out", "r"]].concat(), 0);
    for file in ["realisations.csv", "errors.csv"] {
        let read = |folder: &str| fs::read_to_string(path.join(folder).join(file)).unwrap();
        assert!(read("w") == read("r"), "{file}");
    }
    let errors = |text: &str| {
        let after = text.lines().skip_while(|line| !line.contains("mean of")).map(str::to_owned);
        after.collect::<Vec<_>>()
    };
    assert!(errors(&out).len() > 6 && errors(&out) == errors(&run), "{out}\n{run}");
    assert!(err.contains("plate-1: work rate ") && err.contains("step not seen, at most"), "{err}");
    // A history for each realisation, which begins with its work rate.
    let realisations = rows(&path.join("w/realisations.csv"));
    let history = rows(&path.join("w/history.csv"));
    let begins: Vec<_> = history.iter().filter(|row| number(row, "year") == 0.0).collect();
    let supports: Vec<_> = realisations.iter().filter(|row| row["kind"] == "support").collect();
    assert!(begins.len() >= 12 && begins.len() == supports.len());
    for (begin, realisation) in begins.iter().zip(&supports) {
        assert_eq!((&begin["history"], &begin["place"]), (&realisation["realisation"], &realisation["place"]));
        assert_eq!(begin["work_rate_W"], realisation["work_rate_W"]);
    }
    // So many histories without the study are the same.
    let count = begins.len() / 2;
    let plain = ["--histories", &count.to_string(), "--years", "2", "--out", "h"];
    said(path, &[&["wear"], &short[..], &plain].concat(), 0);
    for file in ["history.csv", "years.csv"] {
        assert!(fs::read(path.join("w").join(file)).unwrap() == fs::read(path.join("h").join(file)).unwrap(), "{file}");
    }
    assert!(!path.join("h/errors.csv").exists());
}

#[test]
fn histories_that_an_interval_needs_beyond_the_most_are_told() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path();
    let short = [&TUBE[..], &["--set", "system.modes=6", "--years", "5", "--no-verdict", "--out", "w"]].concat();
    let narrow = ["--until-interval", "0.01", "--most-seeds", "6"];
    let (out, err) = said(path, &[&["wear"], &short[..], &narrow].concat(), 1);
    assert!(err.contains("an interval of ± 1.0 % was not reached: 6 of"), "{err}");
    assert!(out.contains("plate-1") && path.join("w/years.csv").exists() && !path.join("w/errors.csv").exists());
    let refused = |args: &[&str], words: &[&str]| {
        let (_, err) = said(path, &[&["wear"], args].concat(), 2);
        assert!(words.iter().all(|word| err.contains(word)), "{args:?}: {err}");
    };
    for share in ["0", "1", "100%", "-5%", "nan", "five"] {
        refused(&[&TUBE[..], &["--until-interval", share]].concat(), &["--until-interval", "above 0 and below 1"]);
    }
    let five = ["--until-interval", "5%"];
    refused(&[&TUBE[..], &five, &["--histories", "4"]].concat(), &["cannot be used with", "--histories"]);
    refused(&[&TUBE[..], &five, &["--most-seeds", "5"]].concat(), &["--most-seeds", "6 or more"]);
    refused(&[&TUBE[..], &["--most-seeds", "50"]].concat(), &["--until-interval"]);
    refused(&[&WHIRL[..], &five].concat(), &["--until-interval", "random load"]);
}

#[test]
fn an_interrupted_study_goes_on_with_the_same_bytes() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path();
    let args = |out: &'static str| [&["wear"], &WHIRL[..], &["--out", out]].concat();
    let journal = path.join("killed/windows.journal");
    let blocks = |text: &[u8]| text.split(|byte| *byte == b'\n').filter(|line| line.starts_with(b"@")).count();
    let mut child = command(path, &args("killed")).stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
    while child.try_wait().unwrap().is_none() && blocks(&fs::read(&journal).unwrap_or_default()) < 2 {
        std::thread::sleep(Duration::from_millis(5));
    }
    child.kill().unwrap();
    child.wait().unwrap();
    let found = blocks(&fs::read(&journal).unwrap());
    assert!(found >= 2 && !path.join("killed/history.csv").exists());
    // What a kill leaves that comes amidst a window.
    let mut torn = fs::read(&journal).unwrap();
    torn.extend(b"@3 900 00000000\n{");
    fs::write(&journal, torn).unwrap();
    let (_, err) = said(path, &args("killed"), 0);
    assert!(err.contains(&format!(", {found} of them there already")), "{err}");
    let (_, err) = said(path, &args("whole"), 0);
    assert!(!err.contains("there already"), "{err}");
    for file in ["history.csv", "years.csv", "wear.svg"] {
        assert!(fs::read(path.join("killed").join(file)).unwrap() == fs::read(path.join("whole").join(file)).unwrap());
    }
    // It stays, so that more years go on from it.
    assert!(journal.exists());
}

/// A square of bars that recede.
fn shaken() -> String {
    let wear = "[wear]\ncoefficient = 1e-15\nsupport_coefficient = 1e-15\nservice = 3.15576e8\n";
    let time = "[time]\nend = 1.0\nstep = 1e-3\nstatistics_from = 0.2\n";
    square_of_bars("width = 25e-3\nradius = 9.525e-3\ngrowth = \"flats\"\n", &format!("{wear}\n{time}"))
}

#[test]
fn more_years_go_on_from_those_that_are_there_and_are_those_of_a_study_from_the_start() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path();
    fs::write(path.join("shaken.toml"), shaken()).unwrap();
    let short = ["wear", "shaken.toml"];
    let same = |a: &str, b: &str| {
        for file in ["history.csv", "years.csv", "wear.svg"] {
            assert!(fs::read(path.join(a).join(file)).unwrap() == fs::read(path.join(b).join(file)).unwrap(), "{file}");
        }
    };
    let runs = |err: &str| {
        let (_, after) = err.split_once("shaken by ").unwrap();
        let number = |text: &str| text.trim().parse::<u64>().unwrap();
        let all = number(after.split_once(": ").unwrap().1.split_once(" runs").unwrap().0);
        match after.split_once("s, ").and_then(|(_, rest)| rest.split_once(" of them there already")) {
            Some(("all", _)) => (all, all),
            Some((there, _)) => (all, number(there)),
            None => (all, 0),
        }
    };
    let ask = |out: &str, years: &str, more: &[&str]| {
        let (_, err) = said(path, &[&short[..], &["--years", years, "--out", out], more].concat(), 0);
        runs(&err)
    };
    for (name, more) in [("h", &["--histories", "2"][..]), ("i", &["--until-interval", "90%", "--no-verdict"])] {
        let grown = format!("{name}-grown");
        let (first, there) = ask(&grown, "50", more);
        assert_eq!(there, 0);
        assert_eq!(ask(&grown, "50", more), (first, first), "nothing is run again");
        let (_, there) = ask(&grown, "90", more);
        // All but the runs of the last step, which was cut to end in year 50, and of its end.
        let manifest = fs::read_to_string(path.join(&grown).join("request.json")).unwrap();
        let histories = serde_json::from_str::<serde_json::Value>(&manifest).unwrap()["histories"].as_u64().unwrap();
        assert!(there >= first - 2 * histories && there > histories, "{there} of {first}");
        assert_eq!(ask(name, "90", more).1, 0);
        same(name, &grown);
    }
    // An interruption while it goes on, which leaves what it has run and what is there.
    let journal = path.join("h-grown/windows.journal");
    let whole = fs::read(&journal).unwrap();
    let end = whole.windows(2).rposition(|two| two == b"\n@").unwrap();
    fs::write(&journal, &whole[..end]).unwrap();
    let (all, there) = ask("h-grown", "90", &["--histories", "2"]);
    assert!(there < all);
    same("h", "h-grown");
    let refused = |args: &[&str], words: &str| {
        let (_, err) = said(path, &[&short[..], &["--out", "h-grown"], args].concat(), 2);
        assert!(err.contains(words) && err.contains("--force"), "{args:?}: {err}");
    };
    refused(&["--histories", "2", "--years", "50"], "years: 90 there, 50 asked");
    refused(&["--histories", "3", "--years", "99"], "histories: 2 there, 3 asked");
    refused(&["--histories", "2", "--years", "99", "--set", "support.bars.gap=1e-3"], "0.001 asked");
    refused(&["--histories", "2", "--years", "99", "--set", "load.1.random.seed=8"], "8 asked");
    same("h", "h-grown");
}

#[test]
fn what_does_not_wear_by_gaps_is_refused_by_name() {
    let dir = tempfile::tempdir().unwrap();
    let refused = |args: &[&str], words: &[&str]| {
        let (_, err) = said(dir.path(), &[&["wear"], args].concat(), 2);
        assert!(words.iter().all(|word| err.contains(word)), "{args:?}: {err}");
    };
    refused(&["rigid-walls-sine"], &["the case \"rigid-walls-sine\" is one in which nothing wears", "with supports"]);
    let law = ["--set", "wear.service=1", "--set", "wear.coefficient=1e-14"];
    let sliders = ["only sliders wear", "expected a support", "sliders have no depth"];
    refused(&[&["dry-friction-damper"][..], &law].concat(), &sliders);
    refused(&["whirl-in-a-hole", "--set", "wear.service=1", "--set", "wear.coefficient=1e-14"], &["hole", "width"]);
    refused(&[&WHIRL[..], &["--histories", "2"]].concat(), &["--histories", "random load"]);
    refused(&[&TUBE[..], &["--histories", "0"]].concat(), &["--histories", "1 or more"]);
    for years in ["0", "-1", "nan", "inf"] {
        refused(&[&TUBE[..], &["--years", years]].concat(), &["--years", "above 0"]);
    }
    refused(&[&TUBE[..], &["--scheme", "event"]].concat(), &["event", "friction"]);
    refused(&[&TUBE[..], &["--set", "wear.limit=0"]].concat(), &["wear: limit", "share of the wall"]);
    refused(
        &[&WHIRL[..], &["--set", "wear.limit=0.4"]].concat(),
        &["without the wall", "[system.beam] with outer_diameter and"],
    );
    assert!(fs::read_dir(dir.path()).unwrap().next().is_none_or(|entry| {
        let folder = entry.unwrap().path();
        fs::read_dir(folder).unwrap().count() < 2
    }));
}

/// An oscillator in a round hole under a random force, the tube of which has no wall.
const HOLE: &str = r#"[system]
planes = 2

[system.oscillator]
mass = 1.0
damping = 6.0
stiffness = 1000.0

[[support]]
name = "hole"
shape = "round"
gap = 2e-4
restitution = 0.5
friction = 0.2
width = 25e-3
radius = 9.5e-3

[[load]]
direction = "both"
random = { rms = 3.0, from = 1.0, to = 40.0, seed = 1 }

[wear]
coefficient = 1e-10
service = 3e10

[time]
end = 0.5
step = 1e-3
statistics_from = 0.1
"#;

#[test]
fn a_tube_without_a_wall_ends_at_its_radius_and_one_with_a_wall_there() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path();
    fs::write(path.join("hole.toml"), HOLE).unwrap();
    let wear = |more: &[&str], out: &str| {
        let asked = ["wear", "hole.toml", "--histories", "2", "--years", "1000", "--no-report", "--out", out];
        let (_, err) = said(path, &[&asked[..], more].concat(), 0);
        let years = rows(&path.join(out).join("years.csv"));
        (err, number(years.last().unwrap(), "depth_deepest_m"))
    };
    let (err, depth) = wear(&[], "w");
    assert!((depth / 9.5e-3 - 1.0).abs() < 1e-9, "{depth}");
    assert!(err.contains("hole is worn to the radius of the tube, 9.5 mm, after "), "{err}");
    // A wall of 1.2 mm, of which 40 % are the limit.
    fs::write(path.join("hole.toml"), HOLE.replace("radius = 9.5e-3", "radius = 9.5e-3\nwall = 1.2e-3")).unwrap();
    let (err, depth) = wear(&["--set", "wear.limit=0.4"], "walled");
    assert!((depth / 1.2e-3 - 1.0).abs() < 1e-9, "{depth}");
    assert!(err.contains("hole is worn through after ") && err.contains("the limit of 0.48 mm"), "{err}");
}

#[test]
fn depths_beyond_the_radius_have_a_note_in_runs_means_and_sweeps() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path();
    // All of it off one scar, deeper than the radius and less than the whole tube.
    fs::write(path.join("hole.toml"), HOLE.replace("service = 3e10", "service = 1e7")).unwrap();
    let run = ["run", "hole.toml", "--seeds", "2", "--no-verdict", "--no-report", "--out", "r"];
    let (_, err) = said(path, &run, 0);
    let words = "the scar at support \"hole\" is deeper than the radius of the tube, 9.500 mm, whose wall is not known";
    assert!(err.contains(&format!("note: {words}")), "{err}");
    assert!(err.contains(&format!("note: in the mean over the realisations {words}")), "{err}");
    let sweep = ["sweep", "hole.toml", "--vary", "support.*.gap=2e-4,3e-4", "--measure", "depth_all_round"];
    let (_, err) = said(path, &[&sweep[..], &["--set", "time.step=1e-4", "--no-report", "--out", "s"]].concat(), 0);
    assert!(err.contains("2 of 2 runs have notes") && err.contains(words), "{err}");
}

#[test]
fn a_wall_without_a_radius_or_thicker_than_it_and_a_limit_without_a_wall_are_refused() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path();
    for (from, to, words) in [
        ("radius = 9.5e-3", "radius = 9.5e-3\nwall = 0.01", "at most radius"),
        ("width = 25e-3\nradius = 9.5e-3", "wall = 1e-3", "has a wall and no radius"),
        ("service = 3e10", "service = 3e10\nlimit = 0.4", "or wall beside radius of each [[support]]"),
    ] {
        fs::write(path.join("hole.toml"), HOLE.replace(from, to)).unwrap();
        let (_, err) = said(path, &["run", "hole.toml", "--out", "r"], 2);
        assert!(err.contains(words), "{words}: {err}");
    }
}

#[test]
fn years_take_the_place_of_a_service() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path();
    fs::write(path.join("with.toml"), HOLE.replace("service = 3e10", "service = 1e7")).unwrap();
    fs::write(path.join("without.toml"), HOLE.replace("service = 3e10\n", "")).unwrap();
    for name in ["with", "without"] {
        let file = format!("{name}.toml");
        said(path, &["wear", &file, "--years", "0.01", "--histories", "2", "--no-report", "--out", name], 0);
    }
    for file in ["history.csv", "years.csv", "sector-means.csv"] {
        let [with, without] = ["with", "without"].map(|folder| fs::read(path.join(folder).join(file)).unwrap());
        assert!(with == without, "{file}");
    }
    said(path, &["report", "without"], 0);
    said(path, &["wear", "without.toml", "--years", "0.02", "--histories", "2", "--out", "without"], 0);
    let (_, err) = said(path, &["wear", "without.toml", "--histories", "2"], 2);
    assert!(err.contains("--years is left out; expected a number above 0, or service = "), "{err}");
    // A run says what it has not, and so does explain.
    let words = "without service in [wear] there are no worn volumes and depths";
    let (_, err) = said(path, &["run", "without.toml", "--out", "r"], 0);
    assert!(err.contains(words) && err.contains("wear --years"), "{err}");
    let (out, _) = said(path, &["explain", "without.toml"], 0);
    assert!(out.contains(words), "{out}");
    // The support has a coefficient of its own, and there is no table [wear].
    let own = HOLE.replace("[wear]\ncoefficient = 1e-10\nservice = 3e10\n", "");
    fs::write(path.join("own.toml"), own.replace("radius = 9.5e-3", "radius = 9.5e-3\ncoefficient = 1e-10")).unwrap();
    said(path, &["wear", "own.toml", "--years", "0.01", "--histories", "2", "--no-report", "--out", "own"], 0);
    assert!(fs::read(path.join("own/years.csv")).unwrap() == fs::read(path.join("with/years.csv")).unwrap());
}

/// At steps of 20 ms the normal of the hole turns by radians in a step, so that forces are wrong.
#[test]
fn notes_that_limit_the_use_of_the_windows_are_told_with_their_number() {
    let dir = tempfile::tempdir().unwrap();
    let case = "[system]\nplanes = 2\n[system.oscillator]\nmass = 1.0\ndamping = 2.0\nstiffness = 1000.0\n\
                [[support]]\nname = \"hole\"\nshape = \"round\"\ngap = 0.2e-3\nrestitution = 0.5\nfriction = 0.2\n\
                width = 25e-3\nradius = 9.5e-3\n[[load]]\ndirection = \"both\"\n\
                random = { rms = 3.0, from = 1.0, to = 40.0, seed = 1 }\n[wear]\ncoefficient = 1e-13\nservice = 3e8\n\
                [time]\nend = 4.0\nstep = 2e-2\nstatistics_from = 1.0\n";
    fs::write(dir.path().join("coarse.toml"), case).unwrap();
    let wear = ["wear", "coarse.toml", "--years", "0.5", "--histories", "2", "--no-report"];
    let seeds = ["run", "coarse.toml", "--seeds", "3", "--no-verdict", "--no-report"];
    for (args, runs) in [(&wear[..], "runs have notes that limit the use"), (&seeds[..], "3 of 3 runs have notes")] {
        let (_, err) = said(dir.path(), args, 0);
        assert!(err.contains(runs) && err.contains("results; the first: in ") && err.contains("smaller step"), "{err}");
    }
    let fine = ["--set", "time.step=1e-4", "--force"];
    let (_, err) = said(dir.path(), &[&wear[..], &fine].concat(), 0);
    assert!(!err.contains("runs have notes"), "{err}");
}

/// The work rates of all windows come from the steps and the modes of the first: what half of the
/// step and more modes change there is what two runs of these differ by.
#[test]
fn the_first_window_tells_what_the_step_and_the_modes_left_out_change() {
    let dir = tempfile::tempdir().unwrap();
    let case = ["tube-round-supports", "--set", "time.end=0.4", "--set", "time.statistics_from=0.1", "--modes", "3"];
    let study = [&["wear"], &case[..], &["--years", "0.1", "--histories", "1", "--force", "--out", "w"]].concat();
    let (_, told) = said(dir.path(), &study, 0);
    for words in
        ["the first window with half the step: work rate of support", "the first window with 12 modes in place"]
    {
        assert!(told.contains(words), "{words}: {told}");
    }
    let (document, _) = said(dir.path(), &[&["--json"], &study[..]].concat(), 0);
    let document: serde_json::Value = serde_json::from_str(&document).unwrap();
    let rate = |modes: &str| {
        let own = ["--modes", modes, "--no-verdict", "--no-report", "--force", "--out", "r"];
        said(dir.path(), &[&["run"], &case[..5], &own].concat(), 0);
        number(&rows(&dir.path().join("r/supports.csv"))[0], "work_rate_W")
    };
    let both = &document["truncation"]["work_rates"][0]["work_rate_w"];
    for (found, modes) in [(&both[0], "3"), (&both[1], "6")] {
        // The same runs; only statistics are written with all digits.
        assert!((found.as_f64().unwrap() / rate(modes) - 1.0).abs() < 1e-12, "{both}");
    }
    let (_, told) = said(dir.path(), &[&study[..], &["--no-verdict"]].concat(), 0);
    assert!(!told.contains("the first window with"), "{told}");
    let page = fs::read_to_string(dir.path().join("w/report.html")).unwrap();
    assert!(!page.contains("the first window with"));
}
