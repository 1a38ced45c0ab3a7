//! The source scene against its solution in 50-digit arithmetic (exact flow between events,
//! independent of this crate).

use signorini::Contact;
use signorini::scheme::event::Event;
use signorini::{Load, Options, Scene, Scheme, Wall};

/// State at a given time: (time s, displacement m, velocity m/s).
type Reference = (f64, f64, f64);

fn source() -> Scene {
    Scene::oscillator(1.0, 0.2, 100.0).with_duration(10.0)
}

fn sine() -> Load {
    Load::harmonic(3.0, 5.0, 0.0)
}

fn rigid(e: f64) -> Scene {
    source()
        .with_wall(Wall::upper("upper", 5e-3).with_restitution(e))
        .with_wall(Wall::lower("lower", -5e-3).with_restitution(e))
        .with_load(sine())
}

/// The state at each whole second, the contacts, and the impulse magnitude of each wall.
fn run(scene: &Scene) -> (Vec<Reference>, Vec<Contact>, Vec<f64>) {
    let mut event = Event::new(scene, 1.0).unwrap();
    let (mut states, mut contacts, mut impulse) = (Vec::new(), Vec::new(), vec![0.0; scene.walls.len()]);
    while !event.is_done() {
        event.advance(0.0).unwrap();
        if event.end().fract() == 0.0 {
            states.push((event.end(), event.q()[0], event.v()[0]));
        }
        contacts.extend_from_slice(event.step().closed);
        for (sum, p) in impulse.iter_mut().zip(event.step().impulse) {
            *sum += p.abs();
        }
    }
    contacts.extend(event.open_contacts());
    (states, contacts, impulse)
}

fn assert_state(states: &[Reference], expected: Reference, tolerance: f64) {
    let &(_, q, v) = states.iter().find(|s| s.0 == expected.0).unwrap();
    assert!((q - expected.1).abs() <= tolerance, "q({}) = {q:e}, off by {:e}", expected.0, q - expected.1);
    // A velocity is about ω times a displacement here, ω = 30 rad/s at most.
    assert!((v - expected.2).abs() <= 100.0 * tolerance, "v({}) off by {:e}", expected.0, v - expected.2);
}

/// First impacts at e = 1: (wall, time s, approach speed m/s).
const IMPACTS_E1: [(usize, f64, f64); 20] = [
    (0, 0.07610205438919712, 0.15367225483767086),
    (1, 0.14173476818769404, 0.19873624681626442),
    (0, 0.22850806649922592, 0.10582386114214289),
    (1, 0.4004532773097938, 0.17444428007364385),
    (0, 0.4478967870809431, 0.26336273928163784),
    (1, 0.49720074238060347, 0.15769717453919924),
    (0, 0.6875017533336656, 0.12525381665661728),
    (1, 0.7521294147732893, 0.22149183611969553),
    (0, 0.8145059024074776, 0.13719526611936675),
    (1, 0.995388496256587, 0.15723378237552563),
    (0, 1.0479712077576853, 0.2457944548786227),
    (1, 1.1031201677456683, 0.13984003791902563),
    (0, 1.299301953384292, 0.14171714188199672),
    (1, 1.3533651030646159, 0.24799928560786963),
    (0, 1.4053680144319283, 0.15985200599370025),
    (1, 1.5853839958722475, 0.13620575822817166),
    (0, 1.6486050429846726, 0.2185867035634647),
    (1, 1.7151805134919118, 0.12376875511126663),
    (0, 1.9029239345310458, 0.15816933912160527),
    (1, 1.9524380921578055, 0.26076184086131826),
];

/// The same at e = 0.8.
const IMPACTS_E08: [(usize, f64, f64); 20] = [
    (0, 0.07610205438919712, 0.15367225483767086),
    (1, 0.15167781503477387, 0.19988422455449117),
    (0, 0.2457766249181053, 0.14942994572356103),
    (1, 0.37301055551946266, 0.17955917839165297),
    (0, 0.4448249184474019, 0.19165012631079906),
    (1, 0.5554311592298223, 0.1519948593398152),
    (0, 0.662230610714212, 0.17845221255028468),
    (1, 0.747793819706041, 0.17202495371314366),
    (0, 0.8612425383724663, 0.16608866065247532),
    (1, 0.9526779872703799, 0.1754481722259321),
    (0, 1.0552450861296572, 0.16473720843676387),
    (1, 1.1574077510816605, 0.1718099374568666),
    (0, 1.2530214230918157, 0.16948114273175338),
    (1, 1.3573886928564642, 0.1683572516996708),
    (0, 1.4543534342185644, 0.17115152597659022),
    (1, 1.5555929750578792, 0.1679296761589418),
    (0, 1.6558745783516737, 0.1702828455328082),
    (1, 1.7547342450304335, 0.1692031330926523),
    (0, 1.8560596823195903, 0.16917913642990404),
    (1, 1.9550234704571725, 0.1698864972857428),
];

/// The same after an impulse, without a load.
const IMPACTS_IMPULSE: [(usize, f64, f64); 20] = [
    (0, 0.052664734988059625, 0.08549693775018831),
    (1, 0.1596475422640191, 0.08327723140374838),
    (0, 0.268989591773153, 0.08104618655332539),
    (1, 0.3807993278669088, 0.07880284993533673),
    (0, 0.49519311773525404, 0.07654615215389521),
    (1, 0.612296086633611, 0.07427488848669242),
    (0, 0.7322430747707465, 0.07198769556963168),
    (1, 0.8551797396964164, 0.06968302284574832),
    (0, 0.9812638341477863, 0.06735909729305528),
    (1, 1.1106666974336799, 0.06501387942575504),
    (0, 1.243575009364596, 0.06264500782202444),
    (1, 1.3801928706795794, 0.060249728356808946),
    (0, 1.5207442947118472, 0.057824802729316185),
    (1, 1.6654762245264858, 0.05536638847542052),
    (0, 1.8146622325089856, 0.052869878943087624),
    (1, 1.968607122860196, 0.050329685808310536),
    (0, 2.127652754341513, 0.0477389370360049),
    (1, 2.292185553220761, 0.045089046761913186),
    (0, 2.4626464356360445, 0.04236908450053928),
    (1, 2.6395442834846907, 0.03956481709646856),
];

fn assert_impacts(contacts: &[Contact], expected: &[(usize, f64, f64)]) {
    for (contact, &(wall, time, speed)) in contacts.iter().zip(expected) {
        assert_eq!(contact.wall, wall);
        assert!((contact.start - time).abs() <= 1e-11, "{time}: off by {:e} s", contact.start - time);
        assert!((contact.approach_speed - speed).abs() <= 1e-10, "{time}");
        assert_eq!(contact.end, Some(contact.start));
        assert_eq!(contact.peak_force, None);
    }
}

#[test]
fn elastic_rebounds_match_50_digits_until_chaos() {
    let (states, contacts, _) = run(&rigid(1.0));
    assert_state(&states, (1.0, -0.004273265748152696, 0.15822641285911646), 1e-12);
    assert_state(&states, (2.0, 0.004819844401208915, 0.1692433119647148), 1e-12);
    assert_impacts(&contacts, &IMPACTS_E1);
    assert_eq!(contacts.len(), 104);
}

#[test]
fn dissipative_rebounds_match_50_digits_for_ever() {
    let (states, contacts, impulse) = run(&rigid(0.8));
    assert_state(&states, (1.0, -0.0006696469579914885, 0.06394415891272848), 1e-12);
    assert_state(&states, (10.0, -0.0009191235826783057, 0.06743213543003805), 1e-12);
    assert_impacts(&contacts, &IMPACTS_E08);
    assert_eq!(contacts.len(), 100);
    let expected = [15.228269671815156, 15.304799995988605];
    for (p, e) in impulse.iter().zip(expected) {
        assert!((p / e - 1.0).abs() <= 1e-10, "{p} {e}");
    }
}

#[test]
fn an_elastic_wall_matches_50_digits() {
    let scene = source()
        .with_wall(Wall::upper("upper", 5e-3).with_elasticity(100.0, 0.0))
        .with_wall(Wall::lower("lower", -5e-3))
        .with_load(sine());
    let (states, contacts, impulse) = run(&scene);
    assert_state(&states, (1.0, 0.008889837391506387, -0.2346978410388732), 1e-11);
    assert_eq!(contacts.iter().filter(|c| c.wall == 1).count(), 31);
    let first = contacts[0];
    assert!((first.start - 0.076_102_054_389_197_13).abs() < 1e-11);
    assert!((first.end.unwrap() - 0.205_407_802_393_471_8).abs() < 1e-11);
    assert!((first.departure_speed.unwrap() - 0.203_339_477_616_865_5).abs() < 1e-10);
    // The elastic scene is chaotic too: of 10 s a few digits are left.
    assert!((impulse[0] / 4.600765048576299 - 1.0).abs() < 1e-3);
}

#[test]
fn a_blow_matches_50_digits_for_ever() {
    let scene = source()
        .with_wall(Wall::upper("upper", 5e-3))
        .with_wall(Wall::lower("lower", -5e-3))
        .with_load(Load::impulse(0.1, 0.0));
    let (states, contacts, impulse) = run(&scene);
    assert_state(&states, (1.0, 0.0036602721982939403, -0.0752271966271829), 1e-11);
    assert_state(&states, (5.0, -0.00453015037806821, -0.013213654331731555), 1e-11);
    assert_state(&states, (10.0, -0.0024301032590958492, -0.015025484938159972), 1e-11);
    assert_impacts(&contacts, &IMPACTS_IMPULSE);
    assert_eq!(contacts.len(), 28);
    assert!((impulse[0] / 1.4997225267110177 - 1.0).abs() < 1e-10);
}

#[test]
fn the_second_wall_is_met_when_each_restitution_says() {
    for (e, time) in [(0.0, 0.19375475), (0.5, 0.16833566), (0.8, 0.15167782), (1.0, 0.14173477)] {
        let (_, contacts, _) = run(&rigid(e));
        let second = contacts.iter().find(|c| c.wall == 1).unwrap();
        assert!((second.start - time).abs() < 1e-8, "e = {e}: {}", second.start);
    }
}

#[test]
fn the_settled_orbit_hits_at_one_speed() {
    let (_, contacts, _) = run(&rigid(0.8).with_duration(200.0));
    for contact in &contacts[contacts.len() - 10..] {
        assert!((contact.approach_speed - 0.169410591).abs() < 1e-9, "{}", contact.approach_speed);
    }
}

#[test]
fn one_second_strides_and_none_give_one_motion() {
    let scene = rigid(0.8);
    let mut ends = Vec::new();
    for stride in [1e-3, 0.0137, 10.0] {
        let mut event = Event::new(&scene, stride).unwrap();
        while !event.is_done() {
            event.advance(0.0).unwrap();
        }
        ends.push(event.q()[0]);
    }
    assert!(ends.iter().all(|q| (q - ends[0]).abs() < 1e-15), "{ends:?}");
}

#[test]
fn a_wall_that_is_out_of_reach_changes_nothing_however_far_it_is() {
    let scene = Scene::oscillator(1.0, 0.2, 100.0)
        .with_wall(Wall::lower("lower", -1e-3).with_restitution(0.5))
        .with_load(Load::harmonic(3.0, 5.0, 0.0))
        .with_duration(1.0);
    let made = |scene: &Scene| {
        let run = signorini::run(scene, &Scheme::Event, &Options::with_step(1e-3)).unwrap();
        assert_eq!(run.findings, []);
        let contacts = run.trajectory.contacts().iter().map(|c| (c.start, c.impulse)).collect::<Vec<_>>();
        (run.trajectory.displacement().to_vec(), contacts)
    };
    let (motion, contacts) = made(&scene);
    assert!(contacts.len() > 1);
    for position in [1.0, 1e4, 1e8, 1e10, 1e12, 1e18] {
        let (beside, others) = made(&scene.clone().with_wall(Wall::upper("far", position).with_restitution(0.5)));
        assert_eq!(others.len(), contacts.len(), "{position:e} m");
        // Rounding of 1e-3 m, which the impacts make grow.
        let off = motion.iter().zip(&beside).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(off < 1e-14, "{position:e} m: {off:e}");
    }
}
