//! Case files with random changes: rejected with a place, or accepted and valid; never a panic.
use crate::draws;
use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use signorini::Error;
use signorini::case::{Case, Embedded};
use std::fs;
use std::path::Path;
use std::sync::LazyLock;

/// One change to a text: at a place (a fraction of its length), something cut, doubled or replaced.
#[derive(Debug, Clone)]
enum Change {
    Cut(f64, usize),
    Double(f64, usize),
    Byte(f64, u8),
    Number(f64, usize),
    Token(f64, f64),
}

const NUMBERS: &[&str] = &[
    "nan",
    "-nan",
    "inf",
    "-inf",
    "-1",
    "0",
    "-0.0",
    "1e308",
    "-1e308",
    "5e-324",
    "1e400",
    "9223372036854775808",
    "[]",
];

fn changes() -> impl Strategy<Value = Vec<Change>> {
    let at = || 0.0..1.0;
    let one = prop_oneof![
        (at(), 1..20_usize).prop_map(|(a, n)| Change::Cut(a, n)),
        (at(), 1..40_usize).prop_map(|(a, n)| Change::Double(a, n)),
        (at(), any::<u8>()).prop_map(|(a, b)| Change::Byte(a, b)),
        (at(), 0..NUMBERS.len()).prop_map(|(a, n)| Change::Number(a, n)),
        (at(), 0..NUMBERS.len()).prop_map(|(a, n)| Change::Number(a, n)),
        (at(), at()).prop_map(|(a, b)| Change::Token(a, b)),
    ];
    prop::collection::vec(one, 1..4)
}

/// Where the words of a text start and end.
fn words(text: &[u8], is: impl Fn(u8) -> bool) -> Vec<std::ops::Range<usize>> {
    let mut found = Vec::new();
    let mut start = 0;
    for end in 0..=text.len() {
        if text.get(end).is_none_or(|b| !is(*b)) {
            if end > start {
                found.push(start..end);
            }
            start = end + 1;
        }
    }
    found
}

fn pick(from: usize, fraction: f64) -> usize {
    ((from as f64 * fraction) as usize).min(from.saturating_sub(1))
}

fn apply(text: &mut Vec<u8>, change: &Change) {
    if text.is_empty() {
        return;
    }
    let word = |b: u8| b.is_ascii_alphanumeric() || b"+-._[]".contains(&b);
    match *change {
        Change::Cut(at, n) => {
            let at = pick(text.len(), at);
            text.drain(at..(at + n).min(text.len()));
        }
        Change::Double(at, n) => {
            let at = pick(text.len(), at);
            let end = (at + n).min(text.len());
            let copy = text[at..end].to_vec();
            text.splice(at..at, copy);
        }
        Change::Byte(at, byte) => {
            let at = pick(text.len(), at);
            text[at] = byte;
        }
        Change::Number(at, n) => {
            let mut numbers = words(text, |b| b.is_ascii_digit() || b"+-.e".contains(&b));
            numbers.retain(|r| text[r.clone()].iter().any(u8::is_ascii_digit));
            if !numbers.is_empty() {
                let place = numbers[pick(numbers.len(), at)].clone();
                text.splice(place, NUMBERS[n].bytes());
            }
        }
        Change::Token(at, from) => {
            let tokens = words(text, word);
            if !tokens.is_empty() {
                let copy = text[tokens[pick(tokens.len(), from)].clone()].to_vec();
                text.splice(tokens[pick(tokens.len(), at)].clone(), copy);
            }
        }
    }
}

/// Lines without their remarks, so that changes fall on what counts.
fn bare(text: &str) -> String {
    text.lines().map(|line| line.split('#').next().unwrap_or_default().trim_end().to_owned() + "\n").collect()
}

/// Features that the crate's own cases do not use.
const MORE: [&str; 7] = [
    "[system]\nmodes = 4\nstatic_correction = true\n[system.bar]\nlength = 2.0\n\
     youngs_modulus = 1e9\ndensity = 1e3\narea = 1e-4\n\
     elements = 8\nmass_matrix = \"lumped\"\nleft = { stiffness = 1e5 }\nright = \"free\"\n\
     [system.damping]\nratios = [0.01, 0.02]\n\
     [[wall]]\nname = \"stop\"\nat = { position = 2.0 }\nside = \"both\"\nposition = 1e-3\ngap = 1e-2\n\
     [[load]]\nat = { spread = [0.5, 1.0] }\nimpulse = { impulse = 1.0, time = 0.1 }\n[initial]\n\
     displacement = { profile = [[0.0, 0.0], [2.0, 1e-3]] }\nvelocity = { dofs = [[1, 1e-3]] }\n\
     [time]\nend = 1.0\nstep = 1e-3\n",
    "[system.beam]\nlength = 1.0\nyoungs_modulus = 2e11\ndensity = 7850\nouter_diameter = 0.02\n\
     elements = 3\nleft = \"clamped\"\n\
     right = { stiffness = 1e6, rotational = 10.0 }\n[[wall]]\nname = \"s\"\n\
     at = { position = 0.4 }\nside = \"lower\"\nposition = -1e-3\n\
     stiffness = 1e5\ndamping = 1.0\n[[probe]]\nname = \"p\"\nat = \"each\"\n[initial]\n\
     velocity = { profile = [[0.0, 0.0], [0.5, 0.1], [1.0, 0.0]] }\n[time]\nend = 1.0\nstep = 1e-3\n",
    "[system.chain]\nmasses = [1.0, 2.0, 3.0]\nsprings = [4.0, 5.0]\nright = \"free\"\n[[wall]]\nname = \"s\"\n\
     at = { row = [[0, 1.0], [2, -0.5]] }\nside = \"upper\"\nposition = 1.0\nrestitution = 0.2\n\
     [initial]\ndisplacement = [0.0, 0.1, 0.2]\n\
     [time]\nend = 1.0\nstep = 1e-3\n",
    "[system.matrices]\nmass = \"M.csv\"\nstiffness = \"K.mtx\"\n[system.damping]\n\
     matrix = \"M.csv\"\n[[wall]]\nname = \"s\"\n\
     at = { dof = 1 }\nside = \"upper\"\nposition = 1.0\n[time]\nend = 1.0\nstep = 1e-3\n",
    "[system.matrices]\nmass = \"L.csv\"\nstiffness = \"S.csv\"\n[system.damping]\n\
     rayleigh = { mass = 0.1, stiffness = 1e-3 }\n\
     [[wall]]\nname = \"s\"\nat = { dof = 1 }\nside = \"both\"\ngap = 1e-3\n[[wall]]\nname = \"t\"\nat = { dof = 2 }\n\
     side = \"upper\"\nposition = 1e-3\nrestitution = 0.5\n[[load]]\n\
     at = { row = [[0, 1.0], [2, -1.0]] }\nconstant = { force = 1.0 }\n\
     [initial]\nvelocity = { dofs = [[2, 0.1]] }\n[time]\nend = 1.0\nstep = 1e-3\n",
    "[system.modal]\nfrequencies = [5.0, 20.0]\nmasses = [1.0, 0.5]\ndamping_ratios = 0.01\n\
     shapes = { tip = [1.0, -1.0], base = [0.5, 0.5] }\n[[wall]]\nname = \"s\"\n\
     at = { point = \"tip\" }\nside = \"both\"\ngap = 1e-3\n\
     [[load]]\nat = { points = [[\"tip\", 1.0], [\"base\", -1.0]] }\nconstant = { force = 1.0 }\n\
     [[load]]\nat = { point = \"base\" }\n\
     table = { file = \"F.csv\", time = \"t\", force = \"F\", delimiter = \";\", decimal = \",\", \
     scale = 2.0 }\n\
     [time]\nend = 1.0\nstep = 1e-3\n",
    "[system]\nmodes = 1\n[system.modal]\nomega = [5.0, 20.0]\nshapes = \"P.csv\"\n[[wall]]\n\
     name = \"s\"\nat = \"each\"\nside = \"upper\"\n\
     position = 1e-3\n[time]\nend = 1.0\nstep = 1e-3\n",
];

/// Where the files of the last of them lie.
static FOLDER: LazyLock<tempfile::TempDir> = LazyLock::new(|| {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("M.csv"), "1.0,0.0\n0.0,2.0\n").unwrap();
    let matrix = "%%MatrixMarket matrix coordinate real symmetric\n2 2 3\n1 1 2.0\n2 1 -1.0\n2 2 2.0\n";
    fs::write(folder.path().join("K.mtx"), matrix).unwrap();
    fs::write(folder.path().join("L.csv"), "1,0,0\n0,0,0\n0,0,2\n").unwrap();
    fs::write(folder.path().join("S.csv"), "150,-100,0\n-100,400,-300\n0,-300,300\n").unwrap();
    fs::write(folder.path().join("F.csv"), "t;F\n0,0;1,5\n0,5;2\n").unwrap();
    fs::write(folder.path().join("P.csv"), "tip,1.0,-1.0\nbase,0.5,0.5\n").unwrap();
    folder
});

#[test]
fn the_cases_that_are_mutated_are_right() {
    for text in MORE {
        assert!(
            Case::parse(text, "right.toml", FOLDER.path()).is_ok(),
            "{:?}",
            Case::parse(text, "right.toml", FOLDER.path())
        );
    }
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: draws::cases(4000),
        rng_seed: RngSeed::Fixed(draws::seed(1)),
        failure_persistence: None,
        ..ProptestConfig::default()
    })]

    #[test]
    fn mutated_case_files_never_panic_and_what_is_accepted_makes_sense(
        which in 0..Embedded::all().len() + 3 * MORE.len(),
        stripped in any::<bool>(),
        changes in changes(),
    ) {
        let (right, folder) = match Embedded::all().get(which) {
            Some(embedded) => (embedded.text, Path::new("cases")),
            None => (MORE[which % MORE.len()], FOLDER.path()),
        };
        let mut text = if stripped { bare(right) } else { right.to_owned() }.into_bytes();
        for change in &changes {
            apply(&mut text, change);
        }
        let text = String::from_utf8_lossy(&text);
        match Case::parse(&text, "mutated.toml", folder) {
            Ok(case) => {
                prop_assert!(case.scene.validate().is_ok());
                prop_assert_eq!(case.document.case().unwrap(), case);
            }
            Err(error) => {
                prop_assert!(matches!(error, Error::Case { .. }), "{error:?}");
                let said = error.to_string();
                prop_assert!(said.starts_with("error: "), "{}", said);
                let files = [
                    "tabulated-pulse.csv:", "base-pulse.csv:", "M.csv:", "K.mtx:", "L.csv:", "S.csv:",
                    "F.csv:", "P.csv:",
                ];
                let placed = said.contains("--> mutated.toml:") || files.iter().any(|file| said.contains(file));
                prop_assert!(placed, "{}", said);
                prop_assert!(said.contains("help: expected "), "{}", said);
            }
        }
    }

    #[test]
    fn any_text_at_all_is_read_or_refused(text in ".{0,200}") {
        prop_assert!(Case::parse(&text, "any.toml", "").is_err());
    }
}
