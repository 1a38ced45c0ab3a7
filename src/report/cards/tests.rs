use super::{cards, short};
use serde_json::json;

#[test]
fn numbers_have_three_digits() {
    let shown = [0.0, 1.0, -0.012_345, 123_456.0, 1e-9, 0.1 + 0.2].map(short);
    assert_eq!(shown, ["0", "1", "−0.0123", "1.23e5", "1e−9", "0.3"]);
}

#[test]
fn a_finding_is_never_green() {
    let kinds = [
        ("energy", "Energy", "0.5 where 1e−9"),
        ("penetration", "Contact conditions", "0.5 where 1e−9"),
        ("tension", "Contact conditions", "tension"),
        ("complementarity", "Contact conditions", "complementarity"),
        ("wall_law", "Contact conditions", "wall law"),
        ("normal", "Contact conditions", "normal"),
        ("friction", "Contact conditions", "friction"),
        ("momentum_balance", "Momentum", "momentum balance"),
        ("impulses", "Momentum", "impulses"),
        ("kinematics", "Momentum", "kinematics"),
        ("not_finite", "Run", "At t = 1 s: why."),
        ("diverged", "Run", "At t = 1 s: why."),
        ("of_a_later_version", "Run", "At t = 1 s: why."),
    ];
    for (kind, title, text) in kinds {
        let finding = json!({ "refuted": kind, "residual": 0.5, "tolerance": 1e-9, "reason": "why", "time_s": 1.0 });
        let cards = cards(&json!({ "findings": [finding], "residuals": {} }));
        let bad: Vec<_> = cards.iter().filter(|card| card["state"] == "bad").collect();
        assert_eq!((bad.len(), &bad[0]["title"]), (1, &json!(title)), "{kind}");
        assert!(bad[0]["text"].as_str().unwrap().contains(text), "{:?}", bad[0]);
    }
}
