use super::*;
use crate::scene::{Load, Row, Slider, Wall};

#[test]
fn the_rest_is_extrapolated_from_what_is_done() {
    let estimate = DurationEstimate::new("reasons".to_owned(), Vec::new());
    let second = Duration::from_secs(1);
    assert_eq!(estimate.message(second, 0.01).as_deref(), Some("about 99 s more: reasons"));
    assert!(estimate.message(second, 0.9).is_none() && estimate.message(second, 1.0).is_none());
    // A second is a tenth of this work, after which as much as three times of it follows.
    let followed = estimate.followed_by(3.0);
    assert_eq!(followed.message(second, 0.1).as_deref(), Some("about 39 s more: reasons"));
    assert_eq!(followed.at_most().message(second, 0.1).as_deref(), Some("at most about 39 s more: reasons"));
}

/// One degree of freedom at 100 THz, with a wall that it does not reach: the whole run is a single
/// step of the exact scheme, which takes hours.
fn stiff() -> Scene {
    let scene = Scene::oscillator(1.0, 0.0, 4e29).with_wall(Wall::upper("stop", 1.0)).with_duration(10.0);
    scene.with_load(Load::harmonic(1.0, 25.0, 0.0))
}

#[test]
fn work_of_which_nothing_is_done_is_told_from_a_trial() {
    let second = Duration::from_secs(1);
    let event = Method::new(Scheme::Event);
    let moreau = Method::new(Scheme::MoreauJean { theta: 0.5 });
    let of = |estimate: DurationEstimate| estimate.message(second, 0.0).unwrap_or_default();
    let run = of(DurationEstimate::of_run(&stiff(), &event, 1e-4));
    assert!(run.starts_with("about ") && run.contains(" more: ") && run.contains("the fastest mode, 1.0"), "{run}");
    for each in [
        DurationEstimate::of_comparison(&stiff(), &[moreau], 1e-4),
        DurationEstimate::of_search(&stiff(), None, 1e-4, 1 << 24),
        DurationEstimate::of_chart(&stiff(), &[moreau, event], 8, 1.0),
    ] {
        let line = of(each);
        assert!(line.contains("for each run of the exact motion: ") && line.contains("the fastest mode"), "{line}");
        assert!(["h for", "days", "years"].iter().any(|unit| line.contains(unit)), "{line}");
    }
    // What the exact scheme refuses at once takes no time.
    let slider = Slider { name: "pad".to_owned(), at: Row::dof(0), normal_force: 1.0, friction: 0.2.into() };
    let rubs = stiff().with_slider(&slider).unwrap();
    for each in [
        DurationEstimate::of_comparison(&rubs, &[moreau], 1e-9),
        DurationEstimate::of_search(&rubs, None, 1e-9, 1 << 40),
        DurationEstimate::of_chart(&rubs, &[moreau, event], 8, 1.0),
    ] {
        assert!(each.cause.contains("steps") && !each.cause.contains("exact"), "{}", each.cause);
        assert!(each.runs.iter().all(|run| run.method.scheme != Scheme::Event), "{each:?}");
    }
    // A run of a moment gets no message.
    let soon = Scene::oscillator(1.0, 0.0, 100.0).with_wall(Wall::upper("stop", 1.0));
    assert_eq!(DurationEstimate::of_run(&soon, &event, 1e-4).message(second, 0.0), None);
    // Where the steps of the finest run decide.
    let many = of(DurationEstimate::of_search(&soon, Some(moreau), 1e-4, 10_000_000_000));
    assert!(many.starts_with("at most about ") && many.contains("1.0e10 of them at most"), "{many}");
    // Twice as many runs take about twice as long: both are measured, so only within a small
    // factor.
    let seconds = |count: f64| {
        let estimate = DurationEstimate::of_run(&stiff(), &moreau, 1e-9).times(count);
        estimate.runs[0].seconds().unwrap_or(0.0)
    };
    assert!(seconds(100.0) > 5.0 * seconds(1.0));
}

#[test]
fn the_duration_is_announced_once_and_only_while_the_work_lasts() {
    let estimate = DurationEstimate::of_maps(&Scene::oscillator(1.0, 0.0, 100.0), 1_000_000, 7);
    let whole = estimate.message(Duration::from_secs(3600), 0.5).unwrap();
    let (_, cause) = whole.split_once(": ").unwrap();
    let ending = format!(": {cause}");
    let (said, lines) = channel();
    let short = estimate.clone().announce(Duration::from_secs(3600), {
        let said = said.clone();
        move |line: &str| drop(said.send(line.to_owned()))
    });
    short.set_share(0.01);
    drop(short);
    let long = estimate.announce(Duration::from_millis(50), move |line: &str| drop(said.send(line.to_owned())));
    long.set_share(1e-6);
    let line = lines.recv_timeout(Duration::from_secs(60)).unwrap();
    assert!(line.ends_with(&ending), "{line}");
    // The thread has ended, and with it the channel.
    assert!(lines.recv().is_err());
}
