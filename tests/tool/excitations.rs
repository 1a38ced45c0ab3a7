//! What messages call the loads of a case: those of its file, beside turbulence and what one load
//! makes of itself.
use crate::command::said;
use crate::shaken::IN_A_FLOW;
use std::fs;

#[test]
fn turbulence_is_not_called_a_load() {
    let dir = tempfile::tempdir().unwrap();
    fs::write(dir.path().join("flow.toml"), IN_A_FLOW).unwrap();
    let (out, _) = said(dir.path(), &["explain", "flow.toml"], 0);
    assert!(out.contains("no loads; one turbulence") && !out.contains("added up"), "{out}");
    let (out, _) = said(dir.path(), &["explain", "two-tubes"], 0);
    assert!(out.contains("no loads; 2 turbulences"), "{out}");
    for request in [
        &["orbit", "flow.toml"][..],
        &["continue", "flow.toml", "--key", "wall.w.gap", "--range", "1e-3:2e-3"],
        &[
            "sweep",
            "flow.toml",
            "--vary",
            "wall.w.gap=1e-3,2e-3",
            "--settle",
            "9",
            "--keep",
            "9",
            "--measure",
            "contacts",
        ],
    ] {
        let (_, err) = said(dir.path(), request, 2);
        assert!(err.contains("turbulence 1 does not repeat itself"), "{request:?}: {err}");
    }
}

#[test]
fn a_base_under_fixed_walls_is_one_load() {
    let dir = tempfile::tempdir().unwrap();
    let case = "[system.oscillator]\nmass = 1.0\ndamping = 2000.0\nstiffness = 1e8\n\
        [[load]]\nbase = { amplitude = 2.0, frequency = 3.0, walls = \"fixed\" }\n\
        [[load]]\nconstant = { force = 1.0 }\n[time]\nend = 0.5\nstep = 1e-4\n";
    fs::write(dir.path().join("base.toml"), case).unwrap();
    let (out, _) = said(dir.path(), &["explain", "base.toml"], 0);
    assert!(out.contains("2 loads, added up"), "{out}");
}
