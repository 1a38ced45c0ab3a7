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

/// A summary whose check finds these impulses (N s) at one wall, and this share of the gap.
fn checked(impulses: [f64; 2], displacement: f64) -> serde_json::Value {
    json!({
        "scheme": "located",
        "scene": { "duration_s": 1.0 },
        "residuals": {},
        "refinement": {
            "check": { "half_step": { "step_s": 1e-3 } },
            "displacement": displacement,
            "is_gap": true,
            "length_m": 5e-3,
            "horizon_s": 1.0,
            "walls": [{ "wall": "stop", "impulse_n_s": impulses, "contacts": [3, 3] }],
        },
    })
}

#[test]
fn the_headline_of_a_refinement_has_the_number_that_decides() {
    let told = |summary: &serde_json::Value| {
        let card = cards(summary).into_iter().find(|card| card["title"] == "Refinement").unwrap();
        (card["state"].as_str().unwrap().to_owned(), card["verdict"].as_str().unwrap().to_owned())
    };
    let (state, verdict) = told(&checked([1.0, 1.001], 1e-4));
    assert_eq!(
        (state.as_str(), verdict.as_str()),
        ("good", "Half the step changes impulses by up to 0.1 % of the largest")
    );
    let (state, verdict) = told(&checked([1.0, 1.001], 0.025));
    assert_eq!(state, "mind");
    assert!(verdict.ends_with("changes the displacement by 2.5 % of the gap"), "{verdict}");
    // Eleven times the impulse is no change by 91 %.
    let (state, verdict) = told(&checked([-0.2595, -2.8587], 1e-4));
    assert_eq!(state, "mind");
    assert!(verdict.ends_with("the largest is 2.86 and was 0.26"), "{verdict}");
    let mut unresolved = checked([0.0, 0.0], 1e-12);
    unresolved["notes"] = json!([format!("{}1 (5 Hz) takes 0.2 steps", crate::run::notes::UNRESOLVED_LOAD)]);
    assert_eq!(told(&unresolved).0, "mind", "a step that sees nothing of the load is no result");
}

#[test]
fn springs_in_place_of_walls_tell_how_far_they_give_way() {
    let mut summary = checked([1.0, 1.0], 0.0);
    (summary["scheme"], summary["residuals"]) = (json!("penalty:epsilon=1e-6"), json!({ "penetration_m": 6.867e-3 }));
    let card = cards(&summary).into_iter().find(|card| card["title"] == "Contact conditions").unwrap();
    assert_eq!(card["state"], "mind");
    assert!(card["verdict"].as_str().unwrap().ends_with("give way by up to 6870 µm"), "{card}");
}
