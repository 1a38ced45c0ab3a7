//! Wrong case files: each gives one error that names file, line, column, key and what would be
//! accepted.
use crate::refused::{Wrong, not_refused};
use signorini::Error;
use signorini::case::Case;
use std::fs;

/// A valid case file. Each wrong one differs from it in one place.
const RIGHT: &str = r#"title = "right"

[system.oscillator]
mass = 1.0
damping = 0.2
stiffness = 100.0

[[wall]]
name = "upper"
side = "upper"
position = 5e-3

[[wall]]
name = "lower"
side = "lower"
position = -5e-3

[[load]]
harmonic = { amplitude = 3.0, frequency = 5.0, phase = 0.0 }

[initial]
displacement = 0.0
velocity = 0.0

[time]
end = 10.0
step = 1e-4
sample = 1e-3

[penalty]
epsilon = [1e-12, 1e-9]
"#;

#[rustfmt::skip]
const WRONG: &[Wrong] = &[
    // Syntax.
    ("unclosed table", "[time]", "[time", "25:6", &["unclosed table"]),
    ("no value", "mass = 1.0", "mass =", "4:7", &["system.oscillator.mass", "kg"]),
    ("comma for a point", "mass = 1.0", "mass = 1,0", "4:9", &["system.oscillator.mass", "kg"]),
    ("unclosed string", "name = \"upper\"", "name = \"upper", "9:14", &["wall.name", "string", "in quotes"]),
    ("key twice", "damping = 0.2", "mass = 2.0", "5:1", &["duplicate key `mass`"]),
    ("table twice", "[initial]", "[time]\nend = 1.0\nstep = 0.1\n[initial]", "28:2", &["duplicate key `time`"]),
    ("bare word", "side = \"upper\"", "side = upper", "10:8", &["wall.side", "quoted"]),
    ("no TOML at all", "title = \"right\"", "<xml/>", "1:7", &[]),
    // Types.
    ("text for a number", "mass = 1.0", "mass = \"heavy\"", "4:8", &["system.oscillator.mass", "a number", "kg"]),
    ("truth for a number", "position = 5e-3", "position = true", "11:12", &["wall.position", "a number, in m"]),
    ("date for a number", "end = 10.0", "end = 2020-01-01", "26:7", &["time.end", "a number"]),
    ("list for a number", "step = 1e-4", "step = [1e-4]", "27:8", &["time.step", "a list"]),
    ("number for a name", "name = \"upper\"", "name = 3", "9:8", &["wall.name", "letters"]),
    ("number for a list", "epsilon = [1e-12, 1e-9]", "epsilon = 1e-9", "31:11", &["penalty.epsilon", "a list"]),
    ("text in a list", "1e-9]", "\"1e-9\"]", "31:19", &["penalty.epsilon", "a list of numbers"]),
    ("number too large", "mass = 1.0", "mass = 1e400", "4:8", &["overflow", "mass = a number above 0"]),
    ("a load by position", "{ amplitude = 3.0, frequency = 5.0, phase = 0.0 }", "[3.0, 5.0, 0.0]", "19:12", &["load.harmonic", "amplitude"]),
    ("one wall in single brackets", "[[wall]]\nname = \"lower\"\nside = \"lower\"\nposition = -5e-3\n", "[[wall.x]]\n", "13:8", &["unknown key `x`", "position"]),
    ("number for a table", "[system.oscillator]\nmass = 1.0\ndamping = 0.2\nstiffness = 100.0", "system = 3", "3:10", &["`system` takes a table", "[system.oscillator]"]),
    ("number for an inner table", "[system.oscillator]\nmass = 1.0\ndamping = 0.2\nstiffness = 100.0", "[system]\noscillator = 3", "4:14", &["`system.oscillator` takes a table", "mass (kg)"]),
    ("one table for a list of them", "[[load]]", "[load]", "18:1", &["`load` takes a list", "double brackets"]),
    ("system missing", "[system.oscillator]\nmass = 1.0\ndamping = 0.2\nstiffness = 100.0", "", "1:1", &["`system` is missing", "[system.oscillator]"]),
    ("times missing", "[time]\nend = 10.0\nstep = 1e-4\nsample = 1e-3\n", "", "1:1", &["`time` is missing", "end (s)"]),
    // Keys.
    ("unknown key", "mass = 1.0", "mass = 1.0\nmas = 2.0", "5:1", &["unknown key `mas`", "mass, damping, stiffness"]),
    ("unknown table", "[initial]", "[inital]", "21:2", &["unknown key `inital`", "initial"]),
    ("unknown kind of load", "harmonic =", "sine =", "19:1", &["unknown key `sine`", "harmonic"]),
    ("unknown key of a load", "phase = 0.0", "phi = 0.0", "19:48", &["unknown key `phi`", "phase"]),
    ("mass missing", "mass = 1.0\n", "", "3:1", &["`mass` is missing in `system.oscillator`", "kg"]),
    ("end missing", "end = 10.0\n", "", "25:1", &["`end` is missing in `time`", "in s"]),
    ("position missing", "position = -5e-3\n", "", "13:1", &["`position` is missing in `wall`", "in m"]),
    ("amplitude missing", "amplitude = 3.0, ", "", "19:12", &["`amplitude` is missing in `load.harmonic`", "in N"]),
    // Values.
    ("negative mass", "mass = 1.0", "mass = -1.0", "4:8", &["system.oscillator.mass", "-1.0", "above 0"]),
    ("no mass", "mass = 1.0", "mass = 0", "4:8", &["system.oscillator.mass", "above 0"]),
    ("mass not a number", "mass = 1.0", "mass = nan", "4:8", &["system.oscillator.mass", "NaN", "finite"]),
    ("negative damping", "damping = 0.2", "damping = -0.2", "5:11", &["system.oscillator.damping", "0 or more"]),
    ("infinite stiffness", "stiffness = 100.0", "stiffness = inf", "6:13", &["system.oscillator.stiffness", "finite"]),
    ("negative stiffness", "stiffness = 100.0", "stiffness = -1e308", "6:13", &["system.oscillator.stiffness", "-1e308"]),
    ("wall nowhere", "position = 5e-3", "position = nan", "11:12", &["wall \"upper\": position", "finite"]),
    ("wall infinitely far", "position = -5e-3", "position = -inf", "16:12", &["wall \"lower\": position", "finite"]),
    ("restitution above 1", "position = 5e-3", "position = 5e-3\nrestitution = 1.5", "12:15", &["wall \"upper\": restitution", "from 0 to 1"]),
    ("restitution below 0", "position = 5e-3", "position = 5e-3\nrestitution = -0.1", "12:15", &["restitution", "from 0 to 1"]),
    ("restitution of an elastic wall", "position = 5e-3", "position = 5e-3\nstiffness = 1e3\nrestitution = 1", "13:15", &["restitution and stiffness", "elastic"]),
    ("dashpot of a rigid wall", "position = 5e-3", "position = 5e-3\ndamping = 1.0", "12:11", &["damping without stiffness", "stiffness"]),
    ("an exponent without a stiffness", "position = 5e-3", "position = 5e-3\nexponent = 1.5", "12:12", &["has exponent without stiffness", "stiffness beside it"]),
    ("dissipation beside damping", "position = 5e-3", "position = 5e-3\nstiffness = 1e4\ndamping = 1.0\ndissipation = 0.1", "14:15", &["has dissipation with damping", "neither restitution nor damping"]),
    ("an exponent below 1", "position = 5e-3", "position = 5e-3\nstiffness = 1e4\nexponent = 0.5", "13:12", &["exponent is 0.5", "from 1 to 10"]),
    ("soft wall of no stiffness", "position = 5e-3", "position = 5e-3\nstiffness = 0", "12:13", &["wall \"upper\": stiffness", "above 0"]),
    ("elastic wall with negative damping", "position = 5e-3", "position = 5e-3\nstiffness = 1\ndamping = -1", "13:11", &["wall \"upper\": damping", "0 or more"]),
    ("bad side", "side = \"upper\"", "side = \"left\"", "10:8", &["wall \"upper\": side", "\"upper\" or \"lower\""]),
    ("bad name", "name = \"upper\"", "name = \"the upper\"", "9:8", &["wall 1: name", "letters, digits"]),
    ("empty name", "name = \"lower\"", "name = \"\"", "14:8", &["wall 2: name", "letters, digits"]),
    ("two walls of one name", "name = \"lower\"", "name = \"upper\"", "14:8", &["wall 2: name", "a name of its own"]),
    ("walls crossing", "position = -5e-3", "position = 6e-3", "11:12", &["wall \"upper\": position", "0.006", "\"lower\""]),
    ("start above a wall", "displacement = 0.0", "displacement = 6e-3", "22:16", &["initial.displacement", "at most 0.005"]),
    ("start below one of three walls", "position = -5e-3", "position = 1e-3\n[[wall]]\nname = \"a\"\nside = \"lower\"\nposition = 2e-3", "26:16", &["initial.displacement", "at least 0.001"]),
    ("start not finite", "velocity = 0.0", "velocity = inf", "23:12", &["initial.velocity", "finite"]),
    ("amplitude not a number", "amplitude = 3.0", "amplitude = nan", "19:26", &["load 1: amplitude", "finite"]),
    ("negative frequency", "frequency = 5.0", "frequency = -5.0", "19:43", &["load 1: frequency", "0 or more"]),
    ("frequency too large", "frequency = 5.0", "frequency = 1e308", "19:43", &["load 1: frequency", "finite"]),
    ("infinite phase", "phase = 0.0", "phase = inf", "19:56", &["load 1: phase", "finite"]),
    ("blow before the start", "harmonic = { amplitude = 3.0, frequency = 5.0, phase = 0.0 }", "impulse = { impulse = 1, time = -1 }", "19:33", &["load 1: time", "0 or more"]),
    ("infinite weight", "harmonic = { amplitude = 3.0, frequency = 5.0, phase = 0.0 }", "constant = { force = inf }", "19:22", &["load 1: force", "finite"]),
    ("two kinds", "[[load]]", "[[load]]\nconstant = { force = 1.0 }", "20:12", &["two kinds", "one kind in each"]),
    ("no kind", "harmonic = { amplitude = 3.0, frequency = 5.0, phase = 0.0 }", "", "18:1", &["load 1 has no kind", "constant"]),
    ("table that is not there", "harmonic = { amplitude = 3.0, frequency = 5.0, phase = 0.0 }", "table = { file = \"no.csv\" }", "19:18", &["no.csv", "no such file", "time_s,force_N"]),
    ("table that is a folder", "harmonic = { amplitude = 3.0, frequency = 5.0, phase = 0.0 }", "table = { file = \".\" }", "19:18", &["a folder", "time_s,force_N"]),
    // Keys of a table.
    ("a time without a name", "harmonic = { amplitude = 3.0, frequency = 5.0, phase = 0.0 }", "table = { file = \"no.csv\", time = \"\" }", "19:35", &["load 1: table: time", "header of a column"]),
    ("a force without a name", "harmonic = { amplitude = 3.0, frequency = 5.0, phase = 0.0 }", "table = { file = \"no.csv\", force = \" \" }", "19:36", &["load 1: table: force", "header of a column"]),
    ("time and force of one column", "harmonic = { amplitude = 3.0, frequency = 5.0, phase = 0.0 }", "table = { file = \"no.csv\", time = \"F\", force = \"F\" }", "19:48", &["load 1: table: force", "another column"]),
    ("a delimiter of two signs", "harmonic = { amplitude = 3.0, frequency = 5.0, phase = 0.0 }", "table = { file = \"no.csv\", delimiter = \"; \" }", "19:40", &["load 1: table: delimiter", "\";\""]),
    ("a letter for a delimiter", "harmonic = { amplitude = 3.0, frequency = 5.0, phase = 0.0 }", "table = { file = \"no.csv\", delimiter = \"x\" }", "19:40", &["load 1: table: delimiter", "\";\""]),
    ("a semicolon for a point", "harmonic = { amplitude = 3.0, frequency = 5.0, phase = 0.0 }", "table = { file = \"no.csv\", decimal = \";\" }", "19:38", &["load 1: table: decimal", "\",\""]),
    ("decimal commas between commas", "harmonic = { amplitude = 3.0, frequency = 5.0, phase = 0.0 }", "table = { file = \"no.csv\", decimal = \",\" }", "19:38", &["load 1: table: decimal", "delimiter = \";\" beside it"]),
    ("times of no length", "harmonic = { amplitude = 3.0, frequency = 5.0, phase = 0.0 }", "table = { file = \"no.csv\", time_scale = 0 }", "19:41", &["load 1: table: time_scale", "above 0"]),
    ("a scale that is no number", "harmonic = { amplitude = 3.0, frequency = 5.0, phase = 0.0 }", "table = { file = \"no.csv\", scale = nan }", "19:36", &["load 1: table: scale", "a finite number"]),
    ("a column by number", "harmonic = { amplitude = 3.0, frequency = 5.0, phase = 0.0 }", "table = { file = \"no.csv\", force = 2 }", "19:36", &["load.table.force", "header of the column of forces"]),
    ("an unknown key of a table", "harmonic = { amplitude = 3.0, frequency = 5.0, phase = 0.0 }", "table = { file = \"no.csv\", column = 2 }", "19:28", &["unknown key `column`", "delimiter"]),
    // Times.
    ("no time", "end = 10.0", "end = 0.0", "26:7", &["time.end", "above 0"]),
    ("endless", "end = 10.0", "end = inf", "26:7", &["time.end", "finite"]),
    ("step of nothing", "step = 1e-4", "step = 0", "27:8", &["time.step", "above 0"]),
    ("step backwards", "step = 1e-4", "step = -1e-4", "27:8", &["time.step", "above 0"]),
    ("step not a number", "step = 1e-4", "step = nan", "27:8", &["time.step", "finite"]),
    ("step as long as the run", "step = 1e-4", "step = 10.0", "27:8", &["time.step", "less than the duration, 10.0"]),
    ("too many steps", "step = 1e-4", "step = 1e-10", "27:8", &["time.step", "at most 1e10 steps"]),
    ("too many samples", "sample = 1e-3", "sample = 1e-7", "28:10", &["time.sample", "at most 1e7 rows"]),
    ("too many samples, unsaid", "step = 1e-4\nsample = 1e-3", "step = 1e-8", "27:8", &["time.step", "sample beside it"]),
    ("sample beyond the end", "sample = 1e-3", "sample = 11", "28:10", &["time.sample", "at most the duration"]),
    ("negative sample", "sample = 1e-3", "sample = -1e-3", "28:10", &["time.sample", "above 0"]),
    ("statistics after the end", "sample = 1e-3", "statistics_from = 10.0", "28:19", &["time.statistics_from", "less than the duration"]),
    ("statistics before the start", "sample = 1e-3", "statistics_from = -1", "28:19", &["time.statistics_from", "0 or more"]),
    ("averaging over nothing", "sample = 1e-3", "force_averaging = 0.0", "28:19", &["time.force_averaging", "above 0"]),
    ("an output time before the start", "sample = 1e-3", "output_times = [-0.1]", "28:17", &["time.output_times: value 1", "0 or more"]),
    ("output times backwards", "sample = 1e-3", "output_times = [0.2, 0.1]", "28:22", &["time.output_times: value 2", "more than the one before, 0.2"]),
    ("an output time that is no number", "sample = 1e-3", "output_times = [nan]", "28:17", &["time.output_times: value 1", "finite"]),
    ("one output time without a list", "sample = 1e-3", "output_times = 0.1", "28:16", &["time.output_times", "a list"]),
    // Statistics.
    ("negative rest", "[penalty]", "[statistics]\nrest = -1\n[penalty]", "31:8", &["statistics.rest", "0 or more"]),
    ("rest that is no number", "[penalty]", "[statistics]\nrest = nan\n[penalty]", "31:8", &["statistics.rest", "0 or more"]),
    ("rest as long as the window", "[penalty]", "[statistics]\nrest = 10\n[penalty]", "31:8", &["statistics.rest", "less than the window of the statistics, 10.0"]),
    ("rest in words", "[penalty]", "[statistics]\nrest = \"none\"\n[penalty]", "31:8", &["statistics.rest", "a number, 0 or more"]),
    ("spectra of few rows", "sample = 1e-3\n", "sample = 0.2\n\n[statistics]\nspectra = true\n", "31:11", &["statistics.spectra", "72 rows or more"]),
    ("spectra of few forces", "sample = 1e-3\n", "force_averaging = 0.5\nsample = 1e-3\n[statistics]\nspectra = true\n", "31:11", &["statistics.spectra", "72 averaged forces or more"]),
    ("spectra by number", "[penalty]", "[statistics]\nspectra = 1\n[penalty]", "31:11", &["statistics.spectra", "true or false"]),
    ("a window under another name", "[penalty]", "[statistics]\nforce_window = 1e-3\n[penalty]", "31:1", &["unknown key `force_window`", "`force_averaging` in [time]"]),
    ("a rest among the times", "sample = 1e-3\n", "rest = 1e-3\n", "28:1", &["unknown key `rest`", "`rest` in [statistics]"]),
    // Penalty.
    ("no epsilon", "[1e-12, 1e-9]", "[]", "31:11", &["penalty.epsilon", "one value or more"]),
    ("epsilon of nothing", "1e-9]", "0.0]", "31:19", &["penalty law 2: epsilon", "above 0"]),
    ("negative epsilon", "[1e-12,", "[-1e-12,", "31:12", &["penalty law 1: epsilon", "above 0"]),
    ("epsilon twice", "1e-9]", "1e-12]", "31:19", &["penalty law 2", "each law once"]),
    ("epsilon and stiffness", "1e-9]", "1e-9]\nstiffness = [1e8]", "32:13", &["both epsilon and stiffness", "linear"]),
    ("damping beside epsilon", "1e-9]", "1e-9]\ndamping = 1.0", "32:11", &["penalty.damping", "beside stiffness"]),
    ("negative penalty damping", "epsilon = [1e-12, 1e-9]", "stiffness = [1e8]\ndamping = -1", "32:11", &["penalty law 1: damping", "0 or more"]),
    ("penalty of no stiffness", "epsilon = [1e-12, 1e-9]", "stiffness = [1e8, 0]", "31:19", &["penalty law 2: stiffness", "above 0"]),
    ("unknown integrator", "1e-9]", "1e-9]\nintegrator = \"leapfrog\"", "32:14", &["penalty.integrator", "trapezoidal, implicit-euler, central-difference, discrete-gradient"]),
    ("epsilon with one wall", "[[wall]]\nname = \"lower\"\nside = \"lower\"\nposition = -5e-3\n", "", "27:12", &["penalty law 1: epsilon", "stiffness, in N/m"]),
    ("epsilon with walls that touch", "position = -5e-3", "position = 5e-3 # start: below", "22:16", &["initial.displacement", "at least 0.005"]),
];

#[test]
fn the_case_that_the_wrong_ones_start_from_is_right() {
    assert!(Case::parse(RIGHT, "right.toml", "").is_ok());
}

#[test]
fn every_wrong_case_file_is_refused_at_its_place() {
    assert!(WRONG.len() >= 40);
    let failures = not_refused(RIGHT, WRONG);
    assert!(failures.is_empty(), "{failures}");
}

#[test]
fn a_start_that_is_not_written_down_is_refused_at_the_wall() {
    let text = RIGHT.replace("displacement = 0.0\n", "").replace("position = 5e-3", "position = -1e-3");
    let said = Case::parse(&text, "wrong.toml", "").unwrap_err().to_string();
    assert!(said.contains("--> wrong.toml:11:12\n") && said.contains("initial.displacement is 0.0"), "{said}");
}

#[test]
fn an_error_reads_like_a_compilers() {
    let text = RIGHT.replace("mass = 1.0", "mass = -1.0   # kg");
    let said = Case::parse(&text, "wrong.toml", "").unwrap_err().to_string();
    let expected = "\
error: system.oscillator.mass is -1.0
 --> wrong.toml:4:8
  |
4 | mass = -1.0   # kg
  |        ^^^^
  |
  = help: expected a finite number above 0";
    assert_eq!(said, expected);
}

#[test]
fn an_elastic_wall_may_hold_the_start() {
    let text = RIGHT
        .replace("displacement = 0.0", "displacement = 6e-3")
        .replace("position = 5e-3", "position = 5e-3\nstiffness = 100.0");
    assert!(Case::parse(&text, "preload.toml", "").is_ok());
}

#[test]
fn a_malformed_table_is_refused_at_its_own_line() {
    let folder = tempfile::tempdir().unwrap();
    let case = folder.path().join("case.toml");
    let table = folder.path().join("force.csv");
    let text = RIGHT.replace("[initial]", "[[load]]\ntable = { file = \"force.csv\" }\n\n[initial]");
    fs::write(&case, text).unwrap();
    let wrong: &[(&[u8], &str, &str)] = &[
        (b"", "1:1", "0 rows"),
        (b"time,force\n0,0\n1,1\n", "1:1", "time_s,force_N"),
        (b"0,0\n1,1\n", "1:1", "time_s,force_N"),
        (b"time_s,force_N\n", "1:15", "two rows"),
        (b"time_s,force_N\n0,1\n", "2:4", "1 row"),
        (b"time_s,force_N\n0,1\n0,2\n", "3:1", "more than the row before"),
        (b"time_s,force_N\n0,1\n\n-1,2\n", "4:1", "more than the row before"),
        (b"time_s,force_N\n0,1\n1,two\n", "3:3", "force_N is \"two\""),
        (b"time_s,force_N\n0,1\nnan,2\n", "3:1", "time_s is \"nan\""),
        (b"time_s,force_N\r\n0,1\r\n1,inf\r\n", "3:3", "finite"),
        (b"time_s,force_N\n0,1\n1,2,3\n", "3:1", "3 values"),
        (b"time_s,force_N\n0,1\n1\n", "3:1", "1 value in"),
        (b"time_s,force_N\n0;1\n1;2\n", "2:1", "1 value in"),
        (b"time_s,force_N\n0,\"1\n1,2\n", "2:3", "finite"),
    ];
    for (bytes, place, words) in wrong {
        fs::write(&table, bytes).unwrap();
        let said = Case::read(&case).unwrap_err().to_string();
        let at = format!("--> {}:{place}\n", table.display());
        assert!(said.contains(&at) && said.contains("expected") && said.contains(words), "{bytes:?} {place}\n{said}");
    }
    fs::write(&table, b"time_s,force_N\n0,1\n1,\xff\n").unwrap();
    let said = Case::read(&case).unwrap_err().to_string();
    assert!(said.contains("line 3 is not UTF-8") && said.contains("case.toml:22:18"), "{said}");
    fs::write(&table, b"\xef\xbb\xbftime_s,force_N\r\n0, 1\r\n1, 2\r\n").unwrap();
    assert!(Case::read(&case).is_ok(), "{:?}", Case::read(&case));
}

#[test]
fn a_measured_table_is_refused_at_its_own_place_with_what_would_read_it() {
    let folder = tempfile::tempdir().unwrap();
    let case = folder.path().join("case.toml");
    let path = folder.path().join("force.csv");
    let wrong: &[(&str, &str, &str, &[&str])] = &[
        (", time = \"t\"", "t,F\n0,1\n1,2\n", "1:1", &["no column \"force_N\"", "\"t\", \"F\""]),
        (
            ", time = \"t\", force = \"F2\"",
            "t,F1,F3\n0,1,2\n1,2,3\n",
            "1:1",
            &["no column \"F2\"", "\"t\", \"F1\", \"F3\""],
        ),
        ("", "t;F\n0;1\n1;2\n", "1:1", &["its header is \"t;F\"", "delimiter = \";\" beside file"]),
        (", delimiter = \";\"", "time_s,force_N\n0,1\n", "1:1", &["delimiter = \",\" beside file"]),
        (
            ", delimiter = \";\"",
            "time_s;force_N\n0;1\n1;2,5\n",
            "3:3",
            &["force_N is \"2,5\"", "decimal = \",\" beside file"],
        ),
        (
            ", delimiter = \";\", decimal = \",\"",
            "time_s;force_N\n0;1\n1;2.5\n",
            "3:3",
            &["force_N is \"2.5\"", "decimal = \".\" beside file"],
        ),
        (
            ", delimiter = \";\", decimal = \",\"",
            "time_s;force_N\n0;1\n1;1.000,5\n",
            "3:3",
            &["\"1.000,5\"", "decimal comma"],
        ),
        (", force = \"F\"", "time_s,F,F\n0,1,2\n1,2,3\n", "1:10", &["two columns", "\"F\"", "once"]),
        (", time_scale = 1e300", "time_s,force_N\n0,1\n1e30,1\n", "3:1", &["times time_scale is inf"]),
        (", scale = 1e300", "time_s,force_N\n0,1\n1,1e30\n", "3:3", &["times scale is inf"]),
        (", force = \"F\"", "time_s,,F\n0,,1\n1,,x\n", "3:4", &["F is \"x\"", "decimal point"]),
        (", force = \"F\"", "time_s,a,F\n0,,1\n0,,2\n", "3:1", &["more than the row before"]),
    ];
    for (keys, csv, place, words) in wrong {
        let load = format!("[[load]]\ntable = {{ file = \"force.csv\"{keys} }}\n\n[initial]");
        fs::write(&case, RIGHT.replace("[initial]", &load)).unwrap();
        fs::write(&path, csv).unwrap();
        let said = Case::read(&case).map(|_| "ACCEPTED").unwrap_err().to_string();
        let at = format!("--> {}:{place}\n", path.display());
        let fits = said.contains(&at) && said.contains("expected") && words.iter().all(|word| said.contains(word));
        assert!(fits, "{keys} {csv:?} {place} {words:?}\n{said}");
    }
    // A value far to the right is marked where it stands.
    let load = "[[load]]\ntable = { file = \"force.csv\" }\n\n[initial]";
    fs::write(&case, RIGHT.replace("[initial]", load)).unwrap();
    let row = |t: &str, f: &str| format!("{t},{}{f}\n", "0.5,".repeat(40));
    let names = (0..40).map(|i| format!("c{i:02},")).collect::<String>();
    let wide = format!("time_s,{names}force_N\n") + &row("0", "1") + &row("1", "x");
    fs::write(&path, &wide).unwrap();
    let said = Case::read(&case).map(|_| "ACCEPTED").unwrap_err().to_string();
    assert!(said.contains(&format!("--> {}:3:163\n", path.display())) && said.contains("force_N is \"x\""), "{said}");
    // A header of 2000 columns is not shown whole.
    let wide: Vec<String> = (0..2000).map(|i| format!("channel_{i}")).collect();
    fs::write(&case, RIGHT.replace("[initial]", "[[load]]\ntable = { file = \"force.csv\" }\n\n[initial]")).unwrap();
    fs::write(&path, wide.join(",") + "\n").unwrap();
    let said = Case::read(&case).map(|_| "ACCEPTED").unwrap_err().to_string();
    assert!(said.contains("and 1976 more") && said.len() < 2000, "{} characters\n{said}", said.len());
}

#[test]
fn a_file_that_cannot_be_read_is_a_wrong_request() {
    let folder = tempfile::tempdir().unwrap();
    let binary = folder.path().join("binary.toml");
    fs::write(&binary, b"title = \"a\"\n\xff\xfe").unwrap();
    let large = folder.path().join("large.toml");
    fs::write(&large, vec![b'\n'; (1 << 20) + 1]).unwrap();
    let missing = folder.path().join("rigid-walls-sine.toml");
    let wrong = [
        (missing.as_path(), "signorini new rigid-walls-sine"),
        (folder.path(), "a folder, not a file"),
        (binary.as_path(), "line 2 is not UTF-8"),
        (large.as_path(), "more than 1048576 bytes"),
        (std::path::Path::new("/dev/null"), "not a regular file"),
    ];
    for (path, words) in wrong {
        let error = Case::read(path).unwrap_err();
        assert!(matches!(error, Error::Io { request: true, .. }), "{error:?}");
        let said = error.to_string();
        assert!(said.contains(&path.display().to_string()) && said.contains(words), "{said}");
    }
}

/// A valid tube. Each wrong one differs from it in one place.
const TUBE: &str = r#"title = "right"

[system]
modes = 6

[system.beam]
length = 3.0
youngs_modulus = 2e11
density = 7850.0
outer_diameter = 0.019
inner_diameter = 0.016
elements = 12
left = "pinned"
right = { stiffness = 1e6 }

[system.damping]
ratio = 0.01

[[wall]]
name = "support"
at = { position = 1.0 }
side = "both"
gap = 2e-4

[[load]]
at = { spread = [0.5, 1.5] }
constant = { force = 1.0 }

[initial]
velocity = { profile = [[0.0, 0.0], [1.5, 1e-3], [3.0, 0.0]] }

[[probe]]
name = "middle"
at = { position = 1.5 }

[time]
end = 1.0
step = 1e-4
"#;

/// A valid chain.
const CHAIN: &str = r#"title = "right"

[system.chain]
masses = 4
mass = 1.0
springs = 1e4
left = { stiffness = 1e4 }

[system.damping]
rayleigh = { stiffness = 1e-5 }

[[wall]]
name = "stop"
at = { row = [[0, 1.0], [1, -1.0]] }
side = "upper"
position = 1e-3

[[load]]
at = { dof = 0 }
constant = { force = 1.0 }

[initial]
displacement = [0.0, 0.0, 0.0, 0.0]

[[probe]]
name = "mass"
at = "each"

[time]
end = 1.0
step = 1e-3
"#;

#[rustfmt::skip]
const WRONG_TUBES: &[Wrong] = &[
    // The system.
    ("two systems", "[system.damping]", "[system.oscillator]\nmass = 1\ndamping = 0\nstiffness = 1\n[system.damping]", "16:1", &["two systems, `oscillator` and `beam`"]),
    ("no system", "[system.beam]\nlength = 3.0\nyoungs_modulus = 2e11\ndensity = 7850.0\nouter_diameter = 0.019\ninner_diameter = 0.016\nelements = 12\nleft = \"pinned\"\nright = { stiffness = 1e6 }\n", "", "3:1", &["does not say what vibrates", "[system.chain]"]),
    ("no length", "length = 3.0", "length = 0", "7:10", &["system.beam.length", "above 0"]),
    ("negative stiffness", "youngs_modulus = 2e11", "youngs_modulus = -2e11", "8:18", &["system.beam.youngs_modulus", "above 0"]),
    ("text for a density", "density = 7850.0", "density = \"steel\"", "9:11", &["system.beam.density", "kg/m^3"]),
    ("no outer diameter", "outer_diameter = 0.019\n", "", "6:1", &["`outer_diameter` is missing in `system.beam`", "in m"]),
    ("a tube inside out", "inner_diameter = 0.016", "inner_diameter = 0.02", "11:18", &["system.beam.inner_diameter", "less than the outer diameter"]),
    ("a rectangle without a height", "outer_diameter = 0.019\ninner_diameter = 0.016", "width = 0.05", "6:1", &["`height` is missing in `system.beam`", "in m"]),
    ("a rectangle without a width", "outer_diameter = 0.019\ninner_diameter = 0.016", "height = 0.02", "6:1", &["`width` is missing in `system.beam`", "in m"]),
    ("a tube with a height", "elements = 12", "elements = 12\nheight = 0.02", "10:18", &["a diameter and a side of a rectangle", "width and height"]),
    ("a rectangle with an inner diameter", "outer_diameter = 0.019", "width = 0.05\nheight = 0.02", "12:18", &["a diameter and a side of a rectangle", "outer_diameter and inner_diameter"]),
    ("a rectangle without thickness", "outer_diameter = 0.019\ninner_diameter = 0.016", "width = 0.05\nheight = 0.0", "11:10", &["system.beam.height", "above 0"]),
    ("a negative width", "outer_diameter = 0.019\ninner_diameter = 0.016", "width = -0.05\nheight = 0.02", "10:9", &["system.beam.width", "above 0"]),
    ("a height that is no number", "outer_diameter = 0.019\ninner_diameter = 0.016", "width = 0.05\nheight = nan", "11:10", &["system.beam.height", "above 0"]),
    ("an infinite width", "outer_diameter = 0.019\ninner_diameter = 0.016", "width = inf\nheight = 0.02", "10:9", &["system.beam.width", "above 0"]),
    ("text for a width", "outer_diameter = 0.019\ninner_diameter = 0.016", "width = \"wide\"\nheight = 0.02", "10:9", &["system.beam.width", "a number above 0, in m"]),
    ("half an element", "elements = 12", "elements = 1.5", "12:12", &["system.beam.elements", "whole number"]),
    ("too many elements", "elements = 12", "elements = 1e6", "12:12", &["system.beam.elements", "100000"]),
    ("unknown end", "left = \"pinned\"", "left = \"glued\"", "13:8", &["system.beam.left", "\"clamped\""]),
    ("an end by number", "left = \"pinned\"", "left = 3", "13:8", &["system.beam.left", "\"pinned\""]),
    ("a spring that pushes", "stiffness = 1e6 }", "stiffness = -1e6 }", "14:23", &["system.beam.right.stiffness", "0 or more"]),
    ("a spring without stiffness", "{ stiffness = 1e6 }", "{ rotational = 1e6 }", "14:9", &["system.beam.right", "stiffness"]),
    ("unknown key of an end", "{ stiffness = 1e6 }", "{ spring = 1e6 }", "14:11", &["unknown key `spring`", "stiffness"]),
    ("unknown key of a beam", "elements = 12", "elements = 12\narea = 1.0", "13:1", &["unknown key `area`", "outer_diameter"]),
    // Damping and modes.
    ("negative ratio", "ratio = 0.01", "ratio = -0.01", "17:9", &["system.damping.ratio", "0 or more"]),
    ("two kinds of damping", "ratio = 0.01", "ratio = 0.01\nrayleigh = { mass = 1.0 }", "17:9", &["two kinds, `rayleigh` and `ratio`"]),
    ("no kind of damping", "ratio = 0.01\n", "", "16:1", &["has no kind of damping", "rayleigh"]),
    ("no ratios", "ratio = 0.01", "ratios = []", "17:10", &["system.damping.ratios", "one ratio or more"]),
    ("more modes than there are", "modes = 6", "modes = 60", "4:9", &["modes is 60", "from 1 to 25"]),
    ("no modes", "modes = 6", "modes = 0", "4:9", &["modes", "from 1"]),
    ("half a mode", "modes = 6", "modes = 2.5", "4:9", &["modes", "whole number"]),
    ("a correction of nothing", "modes = 6", "static_correction = true", "4:21", &["`static_correction` without `modes`", "modes = k"]),
    ("a correction by word", "modes = 6", "modes = 6\nstatic_correction = \"yes\"", "5:21", &["system.static_correction", "true or false"]),
    // Places.
    ("no place", "at = { position = 1.0 }\n", "", "19:1", &["`at` is missing in wall \"support\"", "position = 0 to 3.0 m"]),
    ("a place beyond the end", "at = { position = 1.0 }", "at = { position = 3.5 }", "21:19", &["wall \"support\": at is 3.5", "from 0 to 3.0 m"]),
    ("a place before the start", "at = { position = 1.0 }", "at = { position = -0.1 }", "21:19", &["wall \"support\": at is -0.1"]),
    ("a place that is no number", "at = { position = 1.0 }", "at = { position = nan }", "21:19", &["wall \"support\": at: position", "a number"]),
    ("a wall where nothing moves", "at = { position = 1.0 }", "at = { position = 0.0 }", "21:6", &["nothing moves there"]),
    ("two places", "at = { position = 1.0 }", "at = { position = 1.0, dof = 2 }", "21:24", &["more than one place"]),
    ("an empty place", "at = { position = 1.0 }", "at = {}", "21:6", &["wall \"support\": at", "position"]),
    ("a place by number", "at = { position = 1.0 }", "at = 1.0", "21:6", &["wall \"support\": at", "position"]),
    ("a place by word", "at = { position = 1.0 }", "at = \"all\"", "21:6", &["wall \"support\": at", "\"each\""]),
    ("a spread wall", "at = { position = 1.0 }", "at = { spread = [0.5, 1.0] }", "21:8", &["unknown key `spread`"]),
    ("a degree of freedom too many", "at = { position = 1.0 }", "at = { dof = 25 }", "21:14", &["at: dof is 25", "from 0 to 24"]),
    ("half a degree of freedom", "at = { position = 1.0 }", "at = { dof = 0.5 }", "21:14", &["at: dof", "whole number"]),
    ("an unknown place", "at = { position = 1.0 }", "at = { node = 3 }", "21:8", &["unknown key `node`", "position"]),
    ("a gap and one side", "side = \"both\"", "side = \"upper\"", "23:7", &["a gap and one side", "position"]),
    ("both sides without a gap", "gap = 2e-4\n", "", "19:1", &["`gap` is missing"]),
    ("a gap that is none", "gap = 2e-4", "gap = -2e-4", "23:7", &["wall \"support\": gap", "0 or more"]),
    ("a spread of one place", "[0.5, 1.5] }", "[0.5] }", "26:17", &["load 1: at: spread", "[from, to]"]),
    ("a spread backwards", "[0.5, 1.5] }", "[1.5, 0.5] }", "26:17", &["load 1: at", "more than the start"]),
    ("a load on each", "at = { spread = [0.5, 1.5] }", "at = \"each\"", "26:6", &["load 1: at", "spread"]),
    ("a wall twice by expansion", "[[load]]", "[[wall]]\nname = \"support-upper\"\nat = { position = 2.0 }\nside = \"upper\"\nposition = 1.0\n[[load]]", "26:8", &["a name of its own"]),
    // Start and probes.
    ("a number for a field", "{ profile = [[0.0, 0.0], [1.5, 1e-3], [3.0, 0.0]] }", "1.0", "30:12", &["initial.velocity", "profile"]),
    ("a profile that ends early", "[3.0, 0.0]] }", "[2.0, 0.0]] }", "30:12", &["initial.velocity", "from 0 to 3.0 m"]),
    ("a profile of one point", "[[0.0, 0.0], [1.5, 1e-3], [3.0, 0.0]]", "[[0.0, 0.0]]", "30:12", &["initial.velocity", "two points or more"]),
    ("a profile of numbers", "[[0.0, 0.0], [1.5, 1e-3], [3.0, 0.0]]", "[0.0, 1.0]", "30:25", &["initial.velocity.profile", "profile"]),
    ("a profile that moves what is held", "[[0.0, 0.0]", "[[0.0, 1.0]", "30:12", &["initial.velocity", "held"]),
    ("a field of another length", "{ profile = [[0.0, 0.0], [1.5, 1e-3], [3.0, 0.0]] }", "[1.0, 2.0]", "30:12", &["2 values", "25 numbers"]),
    ("an unknown field", "profile =", "shape =", "30:14", &["unknown key `shape`", "profile"]),
    ("a start behind the wall", "velocity = {", "displacement = {", "30:16", &["initial.displacement", "at most 0.0002"]),
    ("a probe without a place", "at = { position = 1.5 }\n", "", "32:1", &["`at` is missing in probe \"middle\""]),
    ("a probe of bad name", "name = \"middle\"", "name = \"the middle\"", "33:8", &["probe 1: name", "letters"]),
    ("two probes of one name", "[time]", "[[probe]]\nname = \"middle\"\nat = { dof = 3 }\n[time]", "37:8", &["probe 2: name", "a name of its own"]),
    ("an unknown key of a probe", "at = { position = 1.5 }", "where = 1.5", "34:1", &["unknown key `where`", "name, at, direction"]),
];

#[rustfmt::skip]
const WRONG_CHAINS: &[Wrong] = &[
    ("no masses", "masses = 4", "masses = 0", "4:10", &["system.chain.masses", "from 1"]),
    ("masses without a mass", "mass = 1.0\n", "", "4:10", &["`mass` is missing in `system.chain`", "in kg"]),
    ("a mass beside a list", "masses = 4", "masses = [1.0, 1.0, 1.0, 1.0]", "5:8", &["beside a list"]),
    ("an empty list", "masses = 4\nmass = 1.0", "masses = []", "4:10", &["system.chain.masses", "one mass or more"]),
    ("a mass of nothing", "mass = 1.0", "mass = 0.0", "5:8", &["system.chain.masses: value 1", "above 0"]),
    ("a negative mass in a list", "masses = 4\nmass = 1.0", "masses = [1.0, 1.0, -1.0, 1.0]", "4:21", &["system.chain.masses: value 3", "above 0"]),
    ("masses by word", "masses = 4", "masses = \"four\"", "4:10", &["system.chain.masses", "how many"]),
    ("too few springs", "springs = 1e4", "springs = [1e4]", "6:11", &["system.chain.springs", "one between"]),
    ("a negative spring", "springs = 1e4", "springs = [1e4, -1.0, 1.0]", "6:17", &["system.chain.springs: value 2", "0 or more"]),
    ("a chain that is clamped", "left = { stiffness = 1e4 }", "left = \"clamped\"", "7:8", &["system.chain.left", "\"free\""]),
    ("a chain that turns", "left = { stiffness = 1e4 }", "left = { stiffness = 1e4, rotational = 1 }", "7:27", &["unknown key `rotational`"]),
    ("negative Rayleigh damping", "stiffness = 1e-5 }", "stiffness = -1e-5 }", "10:26", &["system.damping.rayleigh.stiffness", "0 or more"]),
    ("unknown Rayleigh coefficient", "{ stiffness = 1e-5 }", "{ alpha = 1e-5 }", "10:14", &["unknown key `alpha`", "mass"]),
    ("a position on a chain", "at = { dof = 0 }", "at = { position = 1.0 }", "19:8", &["a chain has no positions", "dof"]),
    ("a spread on a chain", "at = { dof = 0 }", "at = { spread = [0, 1] }", "19:8", &["a chain has no positions", "a row"]),
    ("an empty row", "[[0, 1.0], [1, -1.0]]", "[]", "14:14", &["wall \"stop\": at: row", "pairs"]),
    ("a row of numbers", "[[0, 1.0], [1, -1.0]]", "[0, 1.0]", "14:15", &["wall \"stop\": at: row", "pairs"]),
    ("a weight that is none", "[1, -1.0]", "[1, nan]", "14:29", &["at: row: weight", "finite"]),
    ("a row of nothing", "[[0, 1.0], [1, -1.0]]", "[[0, 0.0], [1, 0.0]]", "14:14", &["at: row", "not 0"]),
    ("a degree of freedom twice", "[1, -1.0]", "[0, -1.0]", "14:26", &["at: row: degree of freedom", "once"]),
    ("a row beyond the end", "[1, -1.0]", "[4, -1.0]", "14:26", &["at: row: degree of freedom is 4", "0 to 3"]),
    ("a list for a start, too short", "[0.0, 0.0, 0.0, 0.0]", "[0.0]", "23:16", &["initial.displacement has 1 values", "4 numbers"]),
    ("a start that is no number", "[0.0, 0.0, 0.0, 0.0]", "[0.0, inf, 0.0, 0.0]", "23:22", &["initial.displacement", "numbers"]),
    ("a profile of a chain", "[0.0, 0.0, 0.0, 0.0]", "{ profile = [[0.0, 0.0]] }", "23:18", &["a chain has no positions", "dofs"]),
    ("a start behind the stop", "[0.0, 0.0, 0.0, 0.0]", "{ dofs = [[0, 2e-3]] }", "23:16", &["initial.displacement is 0.002", "at most 0.001"]),
    ("modes of an oscillator", "[system.chain]\nmasses = 4\nmass = 1.0\nsprings = 1e4\nleft = { stiffness = 1e4 }\n", "[system]\nmodes = 1\n[system.oscillator]\nmass = 1.0\ndamping = 0.0\nstiffness = 0.0\n", "10:1", &["`system.damping` beside an oscillator"]),
];

/// Valid modal data.
const MODES: &str = r#"title = "right"

[system.modal]
frequencies = [5.0, 20.0]
masses = [1.0, 0.5]
damping_ratios = [0.01, 0.02]
shapes = { tip = [1.0, -1.0], base = [0.5, 0.5] }

[[wall]]
name = "stop"
at = { point = "tip" }
side = "upper"
position = 1e-3

[[load]]
at = { points = [["tip", 1.0], ["base", -1.0]] }
constant = { force = 1.0 }

[time]
end = 1.0
step = 1e-3
"#;

#[rustfmt::skip]
const WRONG_MODES: &[Wrong] = &[
    ("no frequencies", "frequencies = [5.0, 20.0]\n", "", "3:1", &["`frequencies` is missing", "omega"]),
    ("frequencies twice", "masses = [1.0, 0.5]", "omega = [1.0, 2.0]", "5:9", &["both frequencies and omega"]),
    ("an empty list of modes", "[5.0, 20.0]", "[]", "4:15", &["system.modal.frequencies", "one for each mode"]),
    ("a negative frequency of a mode", "20.0]", "-20.0]", "4:21", &["frequencies: value 2", "0 or more"]),
    ("a frequency that overflows", "20.0]", "1e200]", "4:21", &["system.modal.omega: value 2", "finite"]),
    ("one frequency by number", "[5.0, 20.0]", "5.0", "4:15", &["system.modal.frequencies", "a list"]),
    ("a mass too few", "[1.0, 0.5]", "[1.0]", "5:10", &["system.modal.masses has 1 value", "expected 2"]),
    ("a mode without mass", "0.5]\nd", "0.0]\nd", "5:16", &["system.modal.masses: value 2", "above 0"]),
    ("masses by word", "[1.0, 0.5]", "\"one\"", "5:10", &["system.modal.masses", "one for each mode"]),
    ("a negative ratio of a mode", "0.02]", "-1.0]", "6:25", &["system.modal.damping_ratios: value 2", "above -1"]),
    ("ratios too many", "0.02]", "0.02, 0.03]", "6:18", &["damping_ratios has 3 values", "expected 2"]),
    ("a shape too short", "[1.0, -1.0]", "[1.0]", "7:18", &["system.modal.shapes.tip has 1 value", "expected 2"]),
    ("a shape by number", "[1.0, -1.0]", "1.0", "7:18", &["system.modal.shapes.tip", "a list of 2 numbers"]),
    ("a shape that is no number", "[1.0, -1.0]", "[1.0, nan]", "7:24", &["system.modal.shapes.tip", "finite"]),
    ("a point of bad name", "tip = [", "\"the tip\" = [", "7:12", &["system.modal.shapes.the tip", "letters"]),
    ("shapes by number", "{ tip = [1.0, -1.0], base = [0.5, 0.5] }", "3", "7:10", &["system.modal.shapes", "CSV"]),
    ("shapes of no file", "{ tip = [1.0, -1.0], base = [0.5, 0.5] }", "\"no.csv\"", "7:10", &["no.csv", "no such file", "a row for each point"]),
    ("an unknown key of modes", "masses =", "mass =", "5:1", &["unknown key `mass`", "masses"]),
    ("damping twice", "[[wall]]", "[system.damping]\nratio = 0.1\n[[wall]]", "9:1", &["twice"]),
    ("a point that is not there", "{ point = \"tip\" }", "{ point = \"top\" }", "11:16", &["at: point", "tip, base"]),
    ("a point by number", "{ point = \"tip\" }", "{ point = 3 }", "11:16", &["at: point", "tip, base"]),
    ("a position on modes", "{ point = \"tip\" }", "{ position = 1.0 }", "11:8", &["has no positions", "point = \"tip\""]),
    ("no place on modes", "at = { point = \"tip\" }\n", "", "9:1", &["`at` is missing", "of tip, base"]),
    ("a point twice", "[\"base\", -1.0]", "[\"tip\", -1.0]", "16:33", &["each point once"]),
    ("a weight of a point", "[\"base\", -1.0]", "[\"base\", inf]", "16:41", &["weight", "finite"]),
    ("points by number", "[[\"tip\", 1.0], [\"base\", -1.0]]", "[1.0]", "16:18", &["at: points", "pairs of a point"]),
    ("a point where nothing moves", "tip = [1.0, -1.0]", "tip = [0.0, 0.0]", "11:6", &["nothing moves there"]),
];

#[test]
fn the_structures_that_the_wrong_ones_start_from_are_right() {
    for text in [TUBE, CHAIN, MODES] {
        assert!(Case::parse(text, "right.toml", "").is_ok(), "{:?}", Case::parse(text, "right.toml", ""));
    }
}

#[test]
fn every_wrong_structure_is_refused_at_its_place() {
    let failures =
        not_refused(TUBE, WRONG_TUBES) + &not_refused(CHAIN, WRONG_CHAINS) + &not_refused(MODES, WRONG_MODES);
    assert!(failures.is_empty(), "{failures}");
}

#[test]
fn a_wall_of_the_compliance_left_out_takes_no_restitution() {
    let text = TUBE
        .replace("modes = 6", "modes = 6\nstatic_correction = true")
        .replace("gap = 2e-4", "gap = 2e-4\nrestitution = 0.5");
    let said = Case::parse(&text, "wrong.toml", "").unwrap_err().to_string();
    assert!(said.contains("--> wrong.toml:25:15") && said.contains("cannot rebound"), "{said}");
    let text = text.replace("restitution = 0.5", "stiffness = 1e5");
    assert!(Case::parse(&text, "right.toml", "").is_ok());
    let text = text + "[penalty]\nstiffness = [1e7]\n";
    let said = Case::parse(&text, "wrong.toml", "").unwrap_err().to_string();
    assert!(said.contains("--> wrong.toml:41:1") && said.contains("`penalty` beside static_correction"), "{said}");
}

#[test]
fn walls_and_probes_without_number_are_refused() {
    let case = |masses: usize, wall: &str, probe: &str| {
        format!(
            "[system.chain]\nmasses = {masses}\nmass = 1.0\nsprings = 1.0\n[[wall]]\nname = \"stop\"\n{wall}\n\
             side = \"upper\"\nposition = 1.0\n[[probe]]\nname = \"p\"\n{probe}\n[time]\nend = 1.0\nstep = 1e-3\n"
        )
    };
    let (each, one) = ("at = \"each\"", "at = { dof = 0 }");
    // A million places are refused before anything is made of them.
    for masses in [5000, 1_000_000] {
        let said = |text: &str| Case::parse(text, "wrong.toml", "").unwrap_err().to_string();
        let wall = said(&case(masses, each, one));
        assert!(wall.contains("--> wrong.toml:7:6\n") && wall.contains(&format!("makes {masses} walls")), "{wall}");
        let probe = said(&case(masses, one, each));
        assert!(
            probe.contains("--> wrong.toml:12:6\n") && probe.contains(&format!("makes {masses} probes")),
            "{probe}"
        );
        assert!(wall.contains("at most 4096 in all") && probe.contains("at most 4096 in all"), "{probe}");
    }
    let twice = case(3000, one, each).replace("[time]", "[[probe]]\nname = \"q\"\nat = \"each\"\n[time]");
    let said = Case::parse(&twice, "wrong.toml", "").unwrap_err().to_string();
    assert!(said.contains("6000 probes with those of probe \"q\"") && said.contains("at most 4096 in all"), "{said}");
    assert_eq!(Case::parse(&case(4096, each, each), "most.toml", "").unwrap().scene.probes.len(), 4096);
}

#[test]
fn a_malformed_file_of_shapes_is_refused_at_its_own_line() {
    let folder = tempfile::tempdir().unwrap();
    let (case, shapes) = (folder.path().join("case.toml"), folder.path().join("shapes.csv"));
    fs::write(&case, MODES.replace("{ tip = [1.0, -1.0], base = [0.5, 0.5] }", "\"shapes.csv\"")).unwrap();
    for (text, place, words) in [
        ("", "1:1", "no points"),
        ("tip,1\n", "1:1", "1 value at the point \"tip\""),
        ("point,a,b\ntip,1,x\n", "2:1", "\"x\" is no finite number"),
        ("tip,1,2\nbase,1,2\ntip,3,4\n", "3:1", "a second time"),
        ("tip,1,2\nthe base,1,2\n", "2:1", "letters, digits"),
    ] {
        fs::write(&shapes, text).unwrap();
        let said = match Case::read(&case) {
            Ok(_) => "ACCEPTED".to_owned(),
            Err(error) => error.to_string(),
        };
        let at = format!("{}:{place}\n", shapes.display());
        let fits = said.contains(&at) && said.contains("expected") && said.contains(words);
        assert!(fits, "{text:?}: {place} {words}\n{said}");
    }
    fs::write(&shapes, "node,mode 1,mode 2\r\ntip,1,-1\r\nbase,0.5,0.5\r\n").unwrap();
    assert!(Case::read(&case).is_ok(), "{:?}", Case::read(&case));
}

#[test]
fn a_malformed_matrix_is_refused_at_its_own_line() {
    let folder = tempfile::tempdir().unwrap();
    let case = folder.path().join("case.toml");
    let text = "[system.matrices]\nmass = \"M.csv\"\nstiffness = \"K.mtx\"\n[time]\nend = 1.0\nstep = 1e-3\n";
    fs::write(&case, text).unwrap();
    let header = "%%MatrixMarket matrix coordinate real symmetric\n";
    let k = format!("{header}2 2 3\n1 1 2.0\n2 1 -1.0\n2 2 2.0\n");
    let m = "1.0,0.0\n0.0,1.0\n";
    let read = |m: &str, k: &str| {
        fs::write(folder.path().join("M.csv"), m).unwrap();
        fs::write(folder.path().join("K.mtx"), k).unwrap();
        Case::read(&case)
    };
    let right = read(m, &k).unwrap();
    assert_eq!(right.scene.system.degrees_of_freedom(), 2);
    // Fortran writes D for the exponent of a double; products are symmetric to their rounding.
    let fortran = read("1.0,1e-9\n-1e-9,1.0\n", &k.replace("-1.0", "-0.1D+01")).unwrap().scene.system.structure();
    assert_eq!((fortran.stiffness.get(1, 0), fortran.mass.get(1, 0)), (-1.0, 0.0));
    let wrong = [
        (m, k.replace("2 2 3", "2 2 4"), "K.mtx:5", "3 entries of 4"),
        (m, k.replace("-1.0", "one"), "K.mtx:4", "no finite number"),
        (m, k.replace("2 1 -1.0", "3 1 -1.0"), "K.mtx:4", "no row or column"),
        (m, "1.0".to_owned(), "K.mtx:1", "MatrixMarket"),
        ("1.0,0.5\n0.0,1.0\n", k.clone(), "M.csv:", "symmetric to 1e-8 of the entry or of √|a_ii a_jj|"),
        ("1.0,0.0\n", k.clone(), "M.csv:1", "2"),
        ("1.0,nan\n0.0,1.0\n", k.clone(), "M.csv:1", "finite"),
        ("1.0,0.0\n0.0,-1.0\n", k.clone(), "case.toml:2:8", "positive definite"),
        ("1.0\n", k.clone(), "case.toml:3:13", "1"),
        (m, k.replace("1 1 2.0", "1 1 -2.0"), "case.toml:3:13", "semidefinite"),
    ];
    for (m, k, place, words) in wrong {
        let said = read(m, &k).map(|_| "ACCEPTED").unwrap_err().to_string();
        assert!(said.contains(place) && said.contains(words) && said.contains("expected"), "{place} {words}\n{said}");
    }
    read(m, &k).unwrap();
    for (old, new, words) in [
        ("K.mtx", "none.mtx", "no such file"),
        ("K.mtx", "K.txt", "neither .mtx nor .csv"),
        ("[time]", "[system.damping]\nmatrix = \"none.csv\"\n[time]", "no such file"),
        ("[time]", "damping = \"M.csv\"\n[system.damping]\nratio = 0.1\n[time]", "twice"),
    ] {
        fs::write(&case, text.replace(old, new)).unwrap();
        let said = Case::read(&case).map(|_| "ACCEPTED").unwrap_err().to_string();
        assert!(said.contains("--> ") && said.contains(words) && said.contains("expected"), "{said}");
    }
}
