//! What the pages of the report draw, in a real browser: texts, lines and colours.
use crate::browser::{opened, results};
use crate::chromium::{Browser, Tab};
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::fs;
use std::process::Command;

/// From here on texts and lines are recorded as `drawn`: [kind, style, x, y, text or line width].
const RECORD: &str = "(() => { const pen = CanvasRenderingContext2D.prototype; globalThis.drawn = []; \
    const record = (name, style) => { const own = pen[name]; pen[name] = function (...args) { \
    const [text, x, y] = name === 'fillText' ? args : [this.lineWidth, ...args]; \
    const width = name === 'fillText' ? this.measureText(text).width : 0; \
    drawn.push([name, String(this[style]), x, y, text, args, this.textAlign, width]); \
    return own.apply(this, args); }; }; \
    record('fillText', 'fillStyle'); record('lineTo', 'strokeStyle'); record('rect', 'strokeStyle'); })()";

/// Draws everything anew in the other theme, and gives the texts.
fn texts(tab: &mut Tab<'_>) -> Vec<String> {
    // What an earlier press has drawn anew is not recorded beside it.
    tab.frame();
    tab.frame();
    tab.evaluate(RECORD);
    tab.press_button("◐");
    tab.frame();
    tab.frame();
    let texts = tab.evaluate("drawn.filter(([kind]) => kind === 'fillText').map((one) => one[4])");
    texts.as_array().unwrap().iter().map(|text| text.as_str().unwrap().to_owned()).collect()
}

/// The colours of a key by its names.
fn key(tab: &mut Tab<'_>, place: &str) -> BTreeMap<String, String> {
    let list = format!(
        "[...document.querySelectorAll('{place} .key')].filter((key) => key.querySelector('.swatch')).map((key) => \
         [key.textContent, key.querySelector('.swatch').style.background])"
    );
    serde_json::from_value::<Vec<(String, String)>>(tab.evaluate(&list)).unwrap().into_iter().collect()
}

/// `#0072b2` as `rgb(0, 114, 178)`.
fn rgb(hex: &str) -> String {
    let part = |at: usize| u8::from_str_radix(&hex[at..at + 2], 16).unwrap();
    format!("rgb({}, {}, {})", part(1), part(3), part(5))
}

const SOFT: [&str; 2] = ["--set", "wall.*.restitution=0.8"];

/// Walls without restitution make the exponent −∞ in one row; the panel shows the others, and that
/// row at its edge.
#[test]
fn a_row_of_minus_infinity_leaves_the_others_drawn() {
    let Some(mut browser) = Browser::start() else { return };
    let dir = tempfile::tempdir().unwrap();
    let vary = ["--vary", "wall.*.restitution=0:0.8:5", "--scheme", "event", "--settle", "40", "--keep", "100"];
    let page = results(dir.path(), &[&["sweep", "rigid-walls-sine"], &vary[..], &["--measure", "lyapunov"]].concat());
    let table = fs::read_to_string(page.with_file_name("sweep.csv")).unwrap();
    assert_eq!(table.matches("-inf").count(), 1, "{table}");
    let mut tab = opened(&mut browser, &page);
    let texts = texts(&mut tab);
    assert!(texts.iter().any(|text| text == "−∞"), "{texts:?}");
    // The numbers of the axis: the finite exponents are −16.2 to −2.3 1/s.
    assert!(texts.iter().any(|text| text == "−10"), "{texts:?}");
    let cells = "[...document.querySelectorAll('#rows tbody tr:not(.space)')].map((tr) => tr.lastChild.textContent)";
    assert_eq!(tab.evaluate(cells)[0], "−∞");
    tab.close();
}

/// The measures that were asked for come before the instants; up and down have the colours of the
/// SVG figures in both.
#[test]
fn a_sweep_opens_on_its_measures_and_has_the_colours_of_its_figure() {
    let Some(mut browser) = Browser::start() else { return };
    let dir = tempfile::tempdir().unwrap();
    let sweep = ["sweep", "rigid-walls-sine", "--scheme", "event", "--settle", "20", "--keep", "5"];
    let vary = ["--vary", "load.1.harmonic.frequency=4:5:5", "--follow", "both", "--measure", "approach_speed_max"];
    let measured = [&sweep[..], &vary[..], &SOFT[..]].concat();
    let page = results(dir.path(), &[&measured[..], &["--samples", "periods"]].concat());
    let mut tab = opened(&mut browser, &page);
    let plots = "[...document.querySelectorAll('#sweep .plot canvas[role=img]')].map((plot) => plot.ariaLabel)";
    assert_eq!(tab.evaluate(plots), json!(["m/s over Frequency (Hz)", "Instants of every row"]));
    let (up, down) = (rgb("#0072b2"), rgb("#d55e00"));
    let keys = key(&mut tab, "#sweep");
    // Where instants of both meet they have a third, that of the text.
    let (both, own): (BTreeMap<_, _>, _) = keys.into_iter().partition(|(name, _)| name == "up and down");
    assert_eq!(own, BTreeMap::from([("up".to_owned(), up.clone()), ("down".to_owned(), down.clone())]));
    assert!(both.len() == 1 && both.values().all(|colour| *colour != up && *colour != down), "{both:?}");
    tab.close();
    // The instants in the figure: up first, then down, then where both are.
    let strokes = |svg: &str| -> Vec<String> {
        let dots = svg.split("<path").filter(|path| path.contains(r#"stroke-width="1.5""#));
        dots.filter_map(|path| Some(path.split_once(r#"stroke=""#)?.1.get(..7)?.to_owned())).collect()
    };
    let svg = fs::read_to_string(page.with_file_name("sweep.svg")).unwrap();
    assert_eq!(strokes(&svg)[..2], ["#0072b2", "#d55e00"]);
    // The measures in the figure: no curve has any other colour.
    let page = results(dir.path(), &measured);
    let svg = fs::read_to_string(page.with_file_name("sweep.svg")).unwrap();
    let curves: std::collections::BTreeSet<&str> =
        svg.split(r#"stroke-width="1.2""#).filter_map(|part| part.rsplit_once(r##"stroke="#"##)?.1.get(..6)).collect();
    assert!(curves.contains("0072b2") && curves.contains("d55e00"), "{curves:?}");
    assert!(svg.contains(">upper: up<") && svg.contains(">lower: down<"));
}

/// A tube in four supports, three of them round.
const FOUR: &str = r#"
[system]
planes = 2
modes = 8
[system.beam]
length = 3.0
youngs_modulus = 200e9
density = 7850.0
outer_diameter = 19.05e-3
inner_diameter = 15.75e-3
elements = 40
left = "pinned"
right = "pinned"
[system.damping]
ratio = 0.01
[[support]]
name = "baffle-1"
at = { position = 0.6 }
shape = "round"
gap = 0.2e-3
restitution = 0.5
friction = 0.2
[[support]]
name = "baffle-2"
at = { position = 1.2 }
shape = "round"
gap = 0.25e-3
restitution = 0.5
friction = 0.2
[[support]]
name = "antivibration-bars"
at = { position = 1.8 }
shape = "flats"
sides = 4
gap = 0.3e-3
restitution = 0.5
friction = 0.2
[[support]]
name = "top-plate"
at = { position = 2.4 }
shape = "round"
gap = 0.35e-3
restitution = 0.5
friction = 0.2
[[load]]
at = { position = 0.3 }
direction = "both"
random = { rms = 20.0, from = 1.0, to = 100.0, seed = 1 }
[[load]]
at = { position = 2.7 }
direction = "both"
random = { rms = 20.0, from = 1.0, to = 100.0, seed = 3 }
[time]
end = 0.3
step = 5e-5
sample = 5e-4
"#;

/// All supports are named, each with one colour on the whole page and in the figures, in the order
/// of the case, and the tube stays within the view along its axis.
#[test]
fn every_support_is_shown_in_its_colour_and_the_tube_within_its_frame() {
    let Some(mut browser) = Browser::start() else { return };
    let dir = tempfile::tempdir().unwrap();
    fs::write(dir.path().join("four.toml"), FOUR).unwrap();
    let page = results(dir.path(), &["run", "four.toml", "--no-verdict"]);
    let mut tab = opened(&mut browser, &page);
    let names = ["baffle-1", "baffle-2", "antivibration-bars", "top-plate"];
    let colours = ["#0072b2", "#d55e00", "#56b4e9", "#e69f00"];
    let expected: BTreeMap<String, String> = names.map(str::to_owned).into_iter().zip(colours.map(rgb)).collect();
    for place in [".stage", "#motion", "#contacts"] {
        assert_eq!(key(&mut tab, place), expected, "{place}");
    }
    for figure in ["orbit.svg", "wear-work.svg"] {
        let svg = fs::read_to_string(page.with_file_name(figure)).unwrap();
        for colour in colours {
            assert!(svg.contains(colour), "{figure} has no {colour}");
        }
    }
    let texts = texts(&mut tab);
    assert!(texts.iter().any(|text| text.contains("gaps 200 µm to 350 µm")), "{texts:?}");
    // The tube in the view along the axis is the line of width 2 in its colour, within the square.
    let outside = "(() => { const style = getComputedStyle(document.documentElement).getPropertyValue('--body'); \
        let box, count = 0, out = 0; for (const [kind, colour, x, y, width, args] of drawn) { \
        if (kind === 'rect' && args[2] === args[3]) box = args; \
        if (kind !== 'lineTo' || colour !== style.trim() || width !== 2) continue; count++; \
        if (x < box[0] || x > box[0] + box[2] || y < box[1] || y > box[1] + box[3]) out++; } \
        return [count > 0, out]; })()";
    for _ in 0..20 {
        assert_eq!(tab.evaluate(outside), json!([true, 0]));
        tab.evaluate("drawn.length = 0");
        tab.key("ArrowRight");
        tab.frame();
    }
    tab.close();
}

/// Two walls: forces and impulses of one run have the colours of their walls, in the figure and on
/// the page.
#[test]
fn walls_have_the_same_colours_on_the_page_and_in_the_figures() {
    let Some(mut browser) = Browser::start() else { return };
    let dir = tempfile::tempdir().unwrap();
    let page = results(dir.path(), &["run", "elastic-wall", "--end", "1", "--no-verdict"]);
    let svg = fs::read_to_string(page.with_file_name("contact-force.svg")).unwrap();
    let (upper, lower) = ("#0072b2", "#d55e00");
    assert!(svg.contains(upper) && svg.contains(lower) && svg.contains(">upper<") && svg.contains(">lower<"));
    let mut tab = opened(&mut browser, &page);
    let expected = BTreeMap::from([("upper".to_owned(), rgb(upper)), ("lower".to_owned(), rgb(lower))]);
    for place in ["#motion", "#contacts"] {
        assert_eq!(key(&mut tab, place), expected, "{place}");
    }
    tab.close();
}

/// Special points are markers, which the key below names: no text stands over the branches.
#[test]
fn no_label_hides_the_branches() {
    let Some(mut browser) = Browser::start() else { return };
    let dir = tempfile::tempdir().unwrap();
    let key = ["--key", "load.1.harmonic.frequency", "--range", "4:5"];
    let page = results(dir.path(), &[&["continue", "rigid-walls-sine"], &SOFT[..], &key[..]].concat());
    let mut tab = opened(&mut browser, &page);
    let texts = texts(&mut tab);
    assert!(!texts.iter().any(|text| text.contains("symmetry-breaking")), "{texts:?}");
    let keys = tab.evaluate("document.querySelector('#branches').textContent.includes('symmetry-breaking')");
    assert_eq!(keys, true);
    tab.close();
}

/// What the plot of a chart tells of the points that the pointer meets.
const TIPS: &str = "(() => { const plot = document.querySelector('#work .plot'), tip = plot.querySelector('.tip'); \
    const surface = plot.querySelector('canvas + canvas'), box = surface.getBoundingClientRect(), found = new Set(); \
    for (let x = 0; x < box.width; x += 8) for (let y = 0; y < box.height; y += 8) { \
    surface.dispatchEvent(new PointerEvent('pointermove', { clientX: box.left + x, clientY: box.top + y })); \
    if (!tip.hidden) found.add(tip.textContent); } return [...found]; })()";

/// The page of a chart says its conclusion before its picture, whose curves carry their names.
#[test]
fn a_chart_has_its_conclusion_above_its_named_curves() {
    let Some(mut browser) = Browser::start() else { return };
    let dir = tempfile::tempdir().unwrap();
    let peers = dir.path().join("peers.csv");
    fs::write(&peers, "program,method,error_over_gap,seconds\nOther,RK,1e-3,2e-3\nOther,RK,2e-4,5e-3\n").unwrap();
    let schemes = ["--schemes", "event,moreau-jean,generalized-alpha,penalty:epsilon=1e-9"];
    let few = ["--end", "1", "--levels", "6", "--repeats", "1", "--longest", "100", "--with", "peers.csv"];
    let page = results(dir.path(), &[&["chart", "rigid-walls-sine"], &schemes[..], &few[..]].concat());
    let mut tab = opened(&mut browser, &page);
    let conclusion = tab.evaluate("document.querySelector('#work .conclusion').textContent");
    assert!(conclusion.as_str().unwrap().starts_with("For 1\u{a0}% of the gap: event "), "{conclusion}");
    let order = "[...document.querySelectorAll('#work .conclusion, #work table, #work .plot')].map((one) => \
        one.className || one.tagName)";
    assert_eq!(tab.evaluate(order), json!(["conclusion", "plain cheapest", "plot"]));
    assert_eq!(tab.evaluate("document.querySelectorAll('#work .chip').length"), 0);
    // A row for each error and a column for each kind of method.
    let cells = "[...document.querySelectorAll('#work th, #work td:first-child')].map((cell) => cell.textContent)";
    let tolerances = ["10 %", "1 %", "0.1 %", "10⁻⁴", "10⁻⁵", "10⁻⁶", "10⁻⁷", "10⁻⁸"];
    let kinds = ["error within", "exact", "QP", "penalty", "other program"];
    assert_eq!(tab.evaluate(cells), json!([&kinds[..], &tolerances[..]].concat()));
    let texts = texts(&mut tab);
    for name in ["event", "moreau-jean", "generalized-alpha", "ε = 1e-9: floor ", "Other RK"] {
        assert!(texts.iter().any(|text| text.contains(name)), "{name}: {texts:?}");
    }
    let reasons = tab.evaluate("document.querySelector('#work .floors').textContent");
    assert!(reasons.as_str().unwrap().contains("its walls give way and"), "{reasons}");
    // The exact scheme's error of some 1e-14 is named at the edge; the axis is that of the others.
    assert!(texts.iter().any(|text| text.starts_with("◂ event (")), "{texts:?}");
    for beyond in ["10⁻¹²", "10⁻¹⁴", "10"] {
        assert!(!texts.iter().any(|text| text == beyond), "{beyond}: {texts:?}");
    }
    // A point tells its step, and the order from the coarser step to its own.
    let tips = tab.evaluate(TIPS);
    let tips: Vec<&str> = tips.as_array().unwrap().iter().filter_map(Value::as_str).collect();
    let table = fs::read_to_string(page.with_file_name("work-precision.csv")).unwrap();
    let points: Vec<[f64; 2]> = table
        .lines()
        .filter(|row| row.starts_with("moreau-jean,"))
        // On a busy machine the finest runs may be left out.
        .filter_map(|row| {
            let number = |at| row.split(',').nth(at)?.parse().ok();
            Some([number(1)?, number(4)?])
        })
        .collect();
    assert!(points.len() >= 3, "{table}");
    let orders: Vec<String> = points
        .windows(2)
        .map(|two| (two[1][1] / two[0][1]).ln() / (two[1][0] / two[0][0]).ln())
        .map(|order| format!("order {order:.2} from").replace('-', "−"))
        .collect();
    let told = |tip: &&&str| orders.iter().any(|order| tip.contains(order));
    assert!(tips.iter().filter(told).count() >= 2, "{orders:?}: {tips:?}");
    assert!(tips.iter().any(|tip| tip.starts_with("moreau-jean\nstep ") && tip.contains("took ")), "{tips:?}");
    assert!(tips.iter().any(|tip| tip.starts_with("Other RK\ntook 5 ms")), "{tips:?}");
    // The table follows the error that is drawn; other programs tell that of the displacement.
    tab.press_button("Impulse");
    assert_eq!(tab.evaluate("document.querySelectorAll('#work th').length"), 4);
    assert_eq!(tab.evaluate("document.documentElement.dataset.errors"), Value::from("0"));
    assert!(tab.pdf() > 20_000);
    tab.close();
}

/// The page of a stability study begins with the largest stable step of each scheme and the reason,
/// and schemes that agree in one impact share one curve with all their names.
#[test]
fn a_stability_page_begins_with_the_stable_steps() {
    let Some(mut browser) = Browser::start() else { return };
    let dir = tempfile::tempdir().unwrap();
    let short = ["--set", "time.end=0.2", "--set", "penalty.epsilon=[1e-9]"];
    let page = results(dir.path(), &[&["stability", "rigid-walls-sine"], &short[..]].concat());
    let manifest = fs::read_to_string(page.with_file_name("request.json")).unwrap();
    let manifest: Value = serde_json::from_str(&manifest).unwrap();
    let stable = manifest["stable_steps"].as_array().unwrap();
    let mut tab = opened(&mut browser, &page);
    let sections = "[...document.querySelectorAll('section')].slice(0, 3).map(({ id }) => id)";
    assert_eq!(tab.evaluate(sections), json!(["steps", "maps", "impact"]));
    let said = tab.evaluate("document.querySelector('#steps .conclusion').textContent");
    let conclusion = manifest["conclusion"].as_str().unwrap();
    assert_eq!(said.as_str().unwrap().replace('\u{a0}', " ").to_lowercase(), format!("{conclusion}.").to_lowercase());
    // The largest first, each with what happens beyond it and why; those without any last.
    let steps: Vec<f64> = stable.iter().map(|row| row["largest_stable_step_s"].as_f64().unwrap_or(0.0)).collect();
    assert!(steps.is_sorted_by(|a, b| a >= b) && steps[0] > 0.0 && steps.contains(&0.0), "{steps:?}");
    let rows = "[...document.querySelectorAll('#steps tbody tr')].map((tr) => [...tr.children].map((td) => \
        td.textContent))";
    let rows: Vec<Vec<String>> = serde_json::from_value(tab.evaluate(rows)).unwrap();
    assert_eq!(rows.len(), stable.len());
    for (cells, row) in rows.iter().zip(stable) {
        assert_eq!(cells[0], row["label"].as_str().unwrap());
        assert_eq!(cells[1] == "none", row["largest_stable_step_s"].is_null(), "{cells:?}");
        let beyond = &row["beyond"];
        assert_eq!(cells[4], beyond["class"].as_str().unwrap_or("stable on the whole grid"), "{cells:?}");
        assert!(cells[5].starts_with(beyond["reason"].as_str().unwrap_or("–")), "{cells:?}");
    }
    // The names of the maps stand above them: no text is over their cells.
    let names = "[...document.querySelectorAll('#maps h3')].map((name) => name.textContent)";
    let names: Vec<String> = serde_json::from_value(tab.evaluate(names)).unwrap();
    assert_eq!(names.len() as f64, tab.evaluate("document.querySelectorAll('#maps .plot').length").as_f64().unwrap());
    assert!(names.iter().any(|name| name == "penalty, trapezoidal"), "{names:?}");
    let drawn = texts(&mut tab);
    assert!(!drawn.iter().any(|text| names.contains(text)), "{drawn:?}");
    let curves = "[...document.querySelectorAll('#impact .curves')].map((list) => [...list.children].map((one) => \
        one.textContent))";
    let curves: Vec<Vec<String>> = serde_json::from_value(tab.evaluate(curves)).unwrap();
    assert_eq!(curves.len(), 5, "walls as constraints, and four stiffnesses: {curves:?}");
    let shared = &curves[0][0];
    assert!(shared.contains("event, located") && shared.contains("moreau-jean (θ = 0.5, 0.75, 1)"), "{shared}");
    assert!(shared.ends_with(": 1.0000"), "{shared}");
    assert!(curves[0].iter().any(|one| one.starts_with("newmark: 0.3")), "{curves:?}");
    assert_eq!(tab.evaluate("document.querySelectorAll('#impact .plot').length"), 5);
    tab.close();
}

/// The first view of a sweep is where its curves bend; another sweep is drawn pale beneath them.
#[test]
fn a_sweep_opens_where_its_curves_bend_and_shows_another_beneath() {
    let Some(mut browser) = Browser::start() else { return };
    let dir = tempfile::tempdir().unwrap();
    let sweep = ["sweep", "rigid-walls-sine", "--vary", "load.1.harmonic.frequency=3:9:31", "--scheme", "event"];
    let more = ["--settle", "60", "--keep", "20", "--measure", "approach_speed_max", "--samples", "impacts", "--set"];
    let [soft, hard] = ["wall.*.restitution=0.7", "wall.*.restitution=0.8"]
        .map(|set| results(dir.path(), &[&sweep[..], &more[..], &[set]].concat()));
    let both = dir.path().join("both.html");
    let tool = Command::new(env!("CARGO_BIN_EXE_signorini"))
        .arg("report")
        .args([soft.parent().unwrap(), "--over".as_ref(), hard.parent().unwrap(), "--out".as_ref(), &both])
        .status();
    assert!(tool.unwrap().success());
    let mut tab = opened(&mut browser, &both);
    let keys = tab.evaluate("document.querySelector('#sweep').textContent.match(/pale: /g).length");
    assert_eq!(keys, 2, "one for the curves, one for the instants");
    // Above 5 Hz both sweeps have one impact a wall and period, of a speed that rises steadily.
    let numbers = |tab: &mut Tab<'_>| -> Vec<f64> {
        let texts = texts(tab);
        let end = texts.iter().position(|text| text.starts_with("Frequency")).unwrap();
        // The numbers below the axis stand before its label, those beside it before them.
        texts[..end].iter().rev().map_while(|text| text.parse().ok()).collect()
    };
    assert!(numbers(&mut tab)[0] < 7.0);
    tab.press_button("Whole range");
    assert_eq!(numbers(&mut tab)[0], 9.0);
    assert_eq!(tab.evaluate("document.documentElement.dataset.errors"), "0");
    tab.close();
}

/// A probe elsewhere than at the stop of a structure given by its modes: the page has the stop, and
/// the motion there, all the same.
#[test]
fn walls_of_modes_are_drawn_where_no_probe_watches() {
    let dir = tempfile::tempdir().unwrap();
    let case = "[system.modal]\nfrequencies = [2.239861, 6.275951]\ndamping_ratios = 0.01\n[system.modal.shapes]\n\
        tip = [0.737, 0.591]\nroot = [0.328, -0.737]\n\
        [[wall]]\nname = \"stop\"\nat = { point = \"tip\" }\nside = \"both\"\ngap = 2e-3\nrestitution = 0.5\n\
        [[load]]\nat = { point = \"root\" }\nharmonic = { amplitude = 20.0, frequency = 3.0 }\n\
        [[probe]]\nname = \"watched\"\nat = { point = \"root\" }\n[time]\nend = 1.0\nstep = 1e-3\n";
    fs::write(dir.path().join("modes.toml"), case).unwrap();
    let page = results(dir.path(), &["run", "modes.toml", "--no-verdict"]);
    let shape = fs::read_to_string(page.with_file_name("shape.csv")).unwrap();
    let mut lines = shape.lines();
    assert_eq!(lines.next().unwrap(), "time_s,displacement_of_wall_0_stop_upper_m");
    let moved: Vec<f64> = lines.map(|line| line.split(',').nth(1).unwrap().parse().unwrap()).collect();
    let most = moved.iter().fold(0.0_f64, |most, u| most.max(u.abs()));
    // It meets the stop between two rows, and six digits are written.
    assert!(most > 1.8e-3 && most < 2e-3 * (1.0 + 1e-4), "{most}");
    let Some(mut browser) = Browser::start() else { return };
    let mut tab = opened(&mut browser, &page);
    let texts = texts(&mut tab);
    for name in ["watched", "stop"] {
        assert!(texts.iter().any(|text| text == name), "{name}: {texts:?}");
    }
    assert!(!texts.iter().any(|text| text.contains("not drawn")), "{texts:?}");
    tab.close();
}

/// The first view of branches: about their special points, or most of them where some lie far off,
/// and from 0 on only where the speeds come near it.
#[test]
fn branches_begin_where_their_special_points_are() {
    let Some(mut browser) = Browser::start() else { return };
    let dir = tempfile::tempdir().unwrap();
    let follow = ["continue", "rigid-walls-sine", "--key", "load.1.harmonic.frequency", "--range"];
    let mut ticks = |range| {
        let page = results(dir.path(), &[&follow[..], &[range], &SOFT[..]].concat());
        let mut tab = opened(&mut browser, &page);
        let first = texts(&mut tab);
        tab.press_button("Whole range");
        let whole = texts(&mut tab);
        tab.close();
        (first, whole)
    };
    // Speeds of 0.165 to 0.168 m/s about the symmetry breaking at 4.5708 Hz.
    let (first, _) = ticks("4.5:5.5");
    assert!(first.iter().any(|text| text.starts_with("0.167")), "{first:?}");
    // Nine of twelve special points lie between 3.36 and 4.57 Hz, one at 14.6 Hz.
    let (first, whole) = ticks("1:16");
    let has = |texts: &[String], tick: &str| texts.iter().any(|text| text == tick);
    assert!(has(&first, "4.6") && !has(&first, "14"), "{first:?}");
    assert!(has(&whole, "14"), "{whole:?}");
}

/// What print leaves out, the controls, has no key; the squares of keys print with their colours,
/// and a map says what it shows.
#[test]
fn keys_are_on_paper_too() {
    let Some(mut browser) = Browser::start() else { return };
    let dir = tempfile::tempdir().unwrap();
    let sweep = ["sweep", "rigid-walls-sine", "--scheme", "event", "--settle", "20", "--keep", "5"];
    let vary = ["--vary", "load.1.harmonic.frequency=4:5:3"];
    let (instants, other) = (["--follow", "both", "--samples", "periods"], ["--vary", "system.oscillator.mass=1:2:2"]);
    let pages = [[&instants[..], &SOFT[..]].concat(), [&other[..], &["--measure", "contacts"]].concat()];
    let [instants, map] = pages.map(|more| results(dir.path(), &[&sweep[..], &vary[..], &more[..]].concat()));
    let mut tab = opened(&mut browser, &instants);
    let keys = "[document.querySelectorAll('#sweep .swatch').length, document.querySelectorAll('.controls \
        .swatch').length, getComputedStyle(document.querySelector('.swatch')).printColorAdjust]";
    assert_eq!(tab.evaluate(keys), json!([3, 0, "exact"]));
    tab.close();
    let mut tab = opened(&mut browser, &map);
    let texts = texts(&mut tab);
    assert!(texts.iter().any(|text| text == "Contacts upper"), "{texts:?}");
    // Every cell has its number.
    assert_eq!(tab.evaluate("document.querySelector('#sweep .swatch').closest('.bar').hidden"), true);
    tab.close();
}

/// The first view has curves alone; readings come with an instant that the reader chooses, and lie
/// within the plot on a phone.
#[test]
fn readings_wait_for_an_instant_to_be_chosen() {
    let Some(mut browser) = Browser::start() else { return };
    let dir = tempfile::tempdir().unwrap();
    let page = results(dir.path(), &["compare", "rigid-walls-sine", "--end", "1", "--no-verdict"]);
    let mut tab = opened(&mut browser, &page);
    tab.width(390);
    tab.frame();
    let reading = |text: &String| text.starts_with("located  ");
    let first = texts(&mut tab);
    assert!(!first.iter().any(reading), "{first:?}");
    let plot = "#motion .plot canvas + canvas";
    tab.evaluate(&format!("document.querySelector('{plot}').scrollIntoView({{ block: 'center' }})"));
    let [x, y, w, h] = tab.place(plot);
    tab.click(x + 0.5 * w, y + 0.5 * h);
    tab.frame();
    let left = "Math.min(...drawn.filter((one) => String(one[4]).startsWith('located  ')).map((one) => one[2]))";
    // The axis of a narrow plot is at 52 pixels or more.
    let left = tab.evaluate(left).as_f64();
    assert!(left.is_some_and(|left| left > 52.0), "{left:?}");
    tab.close();
}

/// The text drawn last that is `text`: [left, right, height] in pixels of its drawing.
fn box_of(tab: &mut Tab<'_>, text: &str) -> [f64; 3] {
    let one = format!(
        "(() => {{ const [kind, , x, y, text, , align, width] = drawn.filter((one) => one[0] === 'fillText' && \
         one[4] === '{text}').at(-1); const left = align === 'right' ? x - width : align === 'center' ? x - width / 2 \
         : x; return [left, left + width, y]; }})()"
    );
    serde_json::from_value(tab.evaluate(&one)).unwrap()
}

/// Names of walls and of the horizon, and the numbers and the name of an axis, on a phone.
#[test]
fn labels_do_not_lie_on_one_another() {
    let Some(mut browser) = Browser::start() else { return };
    let dir = tempfile::tempdir().unwrap();
    let compare = ["compare", "rigid-walls-sine", "--end", "4"];
    let page = results(dir.path(), &[&compare[..], &["--schemes", "located,penalty:epsilon=1e-12"]].concat());
    let mut tab = opened(&mut browser, &page);
    tab.width(390);
    tab.frame();
    texts(&mut tab);
    let [horizon, wall] = ["horizon of prediction", "lower"].map(|text| box_of(&mut tab, text));
    let apart = (horizon[2] - wall[2]).abs() >= 14.0 || horizon[1] < wall[0] || wall[1] < horizon[0];
    assert!(apart, "{horizon:?} {wall:?}");
    // Names of axes stand at 8 pixels, upright, and are 12 pixels high.
    let number = box_of(&mut tab, "−2000");
    assert!(number[0] > 15.0, "{number:?}");
    tab.close();
}

/// Between their own springs all integrators are drawn, and each name of a curve has its own place.
#[test]
fn the_curves_of_own_springs_have_names_apart() {
    let Some(mut browser) = Browser::start() else { return };
    let dir = tempfile::tempdir().unwrap();
    let few = ["--end", "0.3", "--levels", "3", "--longest", "100"];
    let page = results(dir.path(), &[&["chart", "rigid-walls-sine"], &few[..]].concat());
    let mut tab = opened(&mut browser, &page);
    let note = "document.querySelector('#work p.lead').textContent";
    assert!(tab.evaluate(note).as_str().unwrap().contains("the first is drawn"));
    tab.press_button("Own springs");
    let names: Vec<String> = texts(&mut tab).into_iter().filter(|text| text.contains("ε = ")).collect();
    assert!(tab.evaluate(note).as_str().unwrap().contains("Every integrator of every penalty is drawn"));
    assert!(names.len() > 6, "{names:?}");
    let boxes: Vec<_> = names.iter().map(|name| box_of(&mut tab, name)).collect();
    for (i, a) in boxes.iter().enumerate() {
        let on = |b: &[f64; 3]| (a[2] - b[2]).abs() < 14.0 && a[0] < b[1] && b[0] < a[1];
        assert!(!boxes[..i].iter().any(on), "{names:?} {boxes:?}");
    }
    tab.close();
}

/// The page of a sweep says what was varied, and what was found.
#[test]
fn a_sweep_is_headed_by_what_it_found() {
    let Some(mut browser) = Browser::start() else { return };
    let dir = tempfile::tempdir().unwrap();
    let sweep = ["sweep", "rigid-walls-sine", "--scheme", "event", "--settle", "200", "--keep", "20"];
    let vary = ["--vary", "load.1.harmonic.frequency=4.3:5.2:4"];
    let measured = results(dir.path(), &[&sweep[..], &vary, &["--measure", "contacts"], &SOFT].concat());
    let both = ["--follow", "both", "--samples", "impacts"];
    let instants = results(dir.path(), &[&sweep[..], &vary, &both, &SOFT].concat());
    let heading = "document.querySelector('#sweep p.conclusion').textContent";
    let mut tab = opened(&mut browser, &measured);
    let said = tab.evaluate(heading).to_string();
    assert!(said.contains("Frequency from 4.3 to 5.2 Hz, 4 values: contacts upper "), "{said}");
    // One axis for both walls, named by what their measures have in common.
    let drawn = texts(&mut tab);
    assert!(drawn.iter().any(|text| text == "Contacts"), "{drawn:?}");
    tab.close();
    // Below the symmetry breaking at 4.5708 Hz each direction stays with one of two mirrored
    // motions.
    let mut tab = opened(&mut browser, &instants);
    let said = tab.evaluate(heading).to_string();
    assert!(said.contains("4 values: up and down lead to "), "{said}");
    tab.close();
}
