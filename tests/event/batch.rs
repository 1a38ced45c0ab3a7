//! The batch engine against the exact scheme, against itself in other places, and against closed
//! forms.

use crate::draws;
use signorini::batch::{By, Lane, LaneWall, Outcome, Plan, Sine, Width};
use signorini::{Oscillator, Path, Scheme, Stepper, WallLaw};

/// Numbers from 0 to 1 that are the same in every run.
struct Draw(u64);

impl Draw {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.next()
    }

    fn one_of<T: Copy>(&mut self, values: &[T]) -> T {
        values[(self.next() * values.len() as f64) as usize]
    }
}

/// The source oscillator, with restitution `e` under a sine of `amplitude` (N).
fn source(amplitude: f64, e: f64) -> Lane {
    let stop = |position| Some(LaneWall { position, law: WallLaw::Rigid { restitution: e } });
    Lane {
        body: Oscillator { mass: 1.0, damping: 0.2, stiffness: 100.0 },
        lower: stop(-5e-3),
        upper: stop(5e-3),
        constant: 0.0,
        period: 0.2,
        sines: vec![Sine { amplitude, multiple: 1, phase: 0.0 }],
        displacement: 0.0,
        velocity: 0.0,
    }
}

/// An oscillator of any kind that the lanes hold.
fn random(draw: &mut Draw) -> Lane {
    let stiffness = draw.one_of(&[0.0, 1.0, 100.0, 1e4]);
    // From no damping to far beyond critical damping.
    let damping = draw.one_of(&[0.0, 0.02, 0.3, 2.0, 60.0]);
    let gap = draw.between(1e-3, 2e-2);
    let stop = |draw: &mut Draw, position: f64| LaneWall {
        position,
        law: WallLaw::Rigid { restitution: draw.between(-0.1, 1.05).clamp(0.0, 1.0) },
    };
    let below = -gap * draw.between(0.2, 1.5);
    let (lower, upper) = (stop(draw, below), stop(draw, gap));
    let one_sided = draw.next();
    let sines = (0..draw.one_of(&[0, 1, 1, 1, 2, 4]))
        .map(|n| Sine { amplitude: draw.between(-6.0, 6.0), multiple: n + 1, phase: draw.between(-9.0, 9.0) })
        .collect();
    Lane {
        body: Oscillator { mass: draw.between(0.3, 3.0), damping, stiffness },
        displacement: lower.position + (upper.position - lower.position) * draw.between(0.01, 0.99),
        velocity: draw.one_of(&[0.0, 0.2, 0.2, 0.2]) * draw.between(-2.5, 2.5),
        lower: (one_sided > 0.15).then_some(lower),
        upper: (one_sided < 0.85).then_some(upper),
        constant: draw.one_of(&[0.0, 0.0, 1.0, -2.0]),
        period: draw.between(0.1, 1.0),
        sines,
    }
}

/// The instruction sets of this machine, once each.
fn widths() -> Vec<Width> {
    let mut widths = Width::available();
    widths.retain(|width| *width != Width::Widest || !cfg!(target_arch = "x86_64"));
    widths
}

/// The same oscillators, every one by the scheme `event`: with more sines than lanes hold, all but
/// one of no amplitude.
fn by_event(lanes: &[Lane]) -> Vec<Lane> {
    let nothing = Sine { amplitude: 0.0, multiple: 1, phase: 0.0 };
    let more = |lane: &Lane| Lane { sines: [&lane.sines[..], &[nothing; 5]].concat(), ..lane.clone() };
    lanes.iter().map(more).collect()
}

/// The root of the variance that noise of one unit, entering the state at every event, has reached
/// at the end of each of `periods` periods, carried by the exact derivative of the motion, up to
/// the first period in which it reaches `most`. Displacement counts in `size` (m), velocity in
/// `size` · `rate` (1/s).
fn amplified(lane: &Lane, periods: u32, (size, rate): (f64, f64), most: f64) -> Vec<f64> {
    let scene = lane.scene(f64::from(periods) * lane.period);
    let mut stepper = Stepper::new(&scene, &Scheme::Event, lane.period).unwrap();
    let product = |a: [[f64; 2]; 2], b: [[f64; 2]; 2]| {
        [0, 1].map(|i| [0, 1].map(|j: usize| a[i][0] * b[0][j] + a[i][1] * b[1][j]))
    };
    let transposed = |[[a, b], [c, d]]: [[f64; 2]; 2]| [[a, c], [b, d]];
    let unit = [[size * size, 0.0], [0.0, (size * rate).powi(2)]];
    let (mut noise, mut roots) = (unit, Vec::new());
    while roots.len() < periods as usize {
        let step = stepper.step().unwrap();
        let Path::Exact(arc) = step.path else { unreachable!() };
        let mut flow = if step.end > step.start { arc.propagator() } else { [[1.0, 0.0], [0.0, 1.0]] };
        let (before, after) = (arc.state(step.end).1, step.v[0]);
        if step.jump.iter().any(|&p| p != 0.0) && before != 0.0 {
            let (e, a) = (-after / before, arc.acceleration(step.end));
            let gain = (1.0 + e) * (a + arc.damping() / arc.mass() * before) / before;
            flow = product([[-e, 0.0], [gain, -e]], flow);
        }
        noise = product(product(flow, noise), transposed(flow));
        (noise[0][0], noise[1][1]) = (noise[0][0] + unit[0][0], noise[1][1] + unit[1][1]);
        if step.end >= (roots.len() + 1) as f64 * lane.period * (1.0 - 1e-14) {
            let root = (noise[0][0] / unit[0][0] + noise[1][1] / unit[1][1]).sqrt();
            roots.push(root);
            if root.is_nan() || root >= most {
                break;
            }
        }
    }
    roots
}

/// Size of the steady motion without walls, m.
fn steady(lane: &Lane) -> f64 {
    let Oscillator { mass, damping, stiffness } = lane.body;
    let sine = |s: &Sine| {
        let omega = std::f64::consts::TAU * f64::from(s.multiple) / lane.period;
        s.amplitude.abs() / (stiffness - mass * omega * omega).hypot(damping * omega)
    };
    let constant = if stiffness > 0.0 { lane.constant.abs() / stiffness } else { 0.0 };
    lane.sines.iter().map(sine).sum::<f64>() + constant
}

/// A size of the motion, m, and for how many of 100 periods rounding stays small enough to compare
/// it.
fn comparable(lane: &Lane, known: &Outcome) -> (f64, usize) {
    // Where there is one wall only, a motion can be far larger than its distance from the start.
    let gap = known.extent.map(f64::abs).into_iter().fold(lane.scene(1.0).gap_scale(), f64::max);
    let fastest = lane.sines.iter().map(|s| s.multiple).max().unwrap_or(1);
    let own = (lane.body.stiffness / lane.body.mass).sqrt();
    let rate = own.max(std::f64::consts::TAU * f64::from(fastest) / lane.period);
    // The noise is some units of rounding, 1e-15, of the motion in the lanes, of its steady part in
    // the exact scheme, which takes the motion for the sum of that and a free one. Grown by 1e4 it
    // is a tenth of the tolerance. Beyond, the motion is chaotic, or grazes, and no two ways of
    // computing it agree.
    let most = 1e4 / (steady(lane) / gap).max(1.0);
    let noise = amplified(lane, 100, (gap, rate), most);
    let last = noise.iter().position(|&n| n.is_nan() || n >= most).unwrap_or(100);
    (gap, last)
}

#[test]
fn random_oscillators_agree_with_the_exact_scheme_for_as_long_as_rounding_stays_small() {
    let mut draw = Draw(draws::seed(7));
    let cases = draws::cases(40);
    let lanes: Vec<Lane> = (0..cases).map(|_| random(&mut draw)).collect();
    let plan = Plan { threads: 1, ..Plan::new(0, 100) };
    let exact = Plan { threads: 2, ..plan }.run(&by_event(&lanes)).unwrap();
    let measure = |(lane, known): (&Lane, &signorini::Result<Outcome>)| match known {
        Ok(known) => comparable(lane, known),
        Err(_) => (1.0, 0),
    };
    // The longest part of the test, on two threads.
    let pairs: Vec<_> = lanes.iter().zip(exact.outcomes()).collect();
    let (even, odd): (Vec<_>, Vec<_>) = std::thread::scope(|scope| {
        let every_second = |from: usize| pairs.iter().skip(from).step_by(2).copied().map(measure).collect();
        let odd = scope.spawn(move || every_second(1));
        (every_second(0), odd.join().unwrap())
    });
    let measured: Vec<_> = (0..lanes.len()).map(|i| if i % 2 == 0 { even[i / 2] } else { odd[i / 2] }).collect();
    for width in widths() {
        let (mut compared, mut regular, mut worst) = (0, 0, 0.0f64);
        let batch = Plan { width, ..plan }.run(&lanes).unwrap();
        for (index, lane) in lanes.iter().enumerate() {
            let (Ok(found), Ok(known)) = (&batch.outcomes()[index], &exact.outcomes()[index]) else { continue };
            assert_eq!(known.by, By::Event);
            if found.by == By::Event {
                continue;
            }
            compared += 1;
            let (gap, last) = measured[index];
            let whole = last == 100;
            for (period, (a, b)) in batch.strobes(index).iter().zip(exact.strobes(index)).enumerate().take(last) {
                let off = (a[0] - b[0]).abs() / gap;
                worst = worst.max(off);
                assert!(
                    off < 1e-10,
                    "{width:?} lane {index} period {period}: {off:e} of the gap\n{lane:?}\n{a:?} {b:?}"
                );
            }
            if !whole {
                continue;
            }
            regular += 1;
            for (a, b, stop) in [(found.lower, known.lower, lane.lower), (found.upper, known.upper, lane.upper)] {
                let restitution = stop.and_then(|s| s.law.restitution()).unwrap_or(0.0);
                let size = known.lower.impulse.abs() + known.upper.impulse.abs();
                // How many impacts of an accumulation are followed before it counts as rest means
                // nothing: those from a height of 1e-12 of the gap down to its rounding, 1e-15, at
                // most, once or twice a period.
                let rests = a.peak_force.is_some() || b.peak_force.is_some();
                let tail = 2.0 - 1e3f64.ln() / (2.0 * restitution.ln());
                let allowed = if rests { 200.0 * tail } else { 0.0 };
                assert!(a.impacts.abs_diff(b.impacts) as f64 <= allowed, "{index}: {a:?} {b:?} {lane:?}");
                assert_eq!(a.peak_force.is_some(), b.peak_force.is_some(), "{index}: {a:?} {b:?} {lane:?}");
                let (pa, pb) = (a.peak_force.unwrap_or(0.0), b.peak_force.unwrap_or(0.0));
                // A rest begins at the impact that closes the accumulation; the pressing changes by
                // 1e-6 until the next. Where strong drag ends the impacts the exact scheme closes
                // them as soon as the pressing cannot lose half of itself on the way.
                let near = if lane.body.damping > 10.0 { 0.5 } else { 1e-5 };
                assert!((pa - pb).abs() <= near * pb, "{index}: {a:?} {b:?} {lane:?}");
                assert!((a.impulse - b.impulse).abs() <= 1e-9 * size, "{index}: {a:?} {b:?} {lane:?}");
                assert!((a.largest_impulse - b.largest_impulse).abs() <= 1e-9 * size, "{index}: {a:?} {b:?}");
            }
            // Both infinite, or a growth that agrees up to rounding. Without a sine of its own the
            // lane that was handed over has another fastest rate, in which changes are measured.
            let (a, b) = (found.exponent, known.exponent);
            let apart = (a - b).abs() * 100.0 * lane.period;
            assert!(a == b || apart < 1e-6 || lane.sines.is_empty(), "{index}: exponents {a} and {b} /s, {lane:?}");
            for i in 0..2 {
                let off = (found.extent[i] - known.extent[i]).abs();
                assert!(off < 1e-9 * gap, "{index}: {:?} {:?} {lane:?}", found.extent, known.extent);
            }
        }
        eprintln!(
            "{width:?}: {compared} compared, {regular} of them over all 100 periods, worst \
             {worst:.1e} of the gap, {} handed",
            batch.handed()
        );
        // Guards the test itself: it would also pass if it compared nothing.
        assert!(3 * compared > cases && 5 * regular > cases, "{compared} compared, {regular} to the end");
    }
}

#[test]
fn a_lane_has_the_same_bits_in_any_company_and_on_any_number_of_threads() {
    let mut draw = Draw(3);
    let lanes: Vec<Lane> = (0..300).map(|_| random(&mut draw)).collect();
    for width in widths() {
        let plan = Plan { threads: 1, width, ..Plan::new(3, 20) };
        let whole = plan.run(&lanes).unwrap();
        let threaded = Plan { threads: 3, ..plan }.run(&lanes).unwrap();
        let reversed: Vec<Lane> = lanes.iter().rev().cloned().collect();
        let reversed = plan.run(&reversed).unwrap();
        for index in 0..lanes.len() {
            let bits = |x: &[[f64; 2]]| x.iter().flatten().map(|x| x.to_bits()).collect::<Vec<_>>();
            let same = |other: &signorini::batch::Batch, at: usize| {
                assert_eq!(bits(whole.strobes(index)), bits(other.strobes(at)), "{width:?} {index}");
                assert_eq!(whole.outcomes()[index], other.outcomes()[at], "{width:?} {index}");
            };
            same(&threaded, index);
            same(&reversed, lanes.len() - 1 - index);
            if index % 50 == 0 {
                same(&plan.run(&lanes[index..=index]).unwrap(), 0);
            }
        }
    }
}

#[test]
fn widths_with_fused_products_have_the_same_bits() {
    let available = widths();
    if !(available.contains(&Width::Avx2) && available.contains(&Width::Avx512)) {
        return;
    }
    let mut draw = Draw(5);
    let lanes: Vec<Lane> = (0..300).map(|_| random(&mut draw)).collect();
    let run = |width| Plan { width, ..Plan::new(5, 30) }.run(&lanes).unwrap();
    let (four, eight) = (run(Width::Avx2), run(Width::Avx512));
    for index in 0..lanes.len() {
        assert_eq!(four.outcomes()[index], eight.outcomes()[index]);
        assert!(four.strobes(index) == eight.strobes(index) || four.outcomes()[index].is_err());
    }
}

#[test]
fn a_free_body_under_a_sine_keeps_to_the_closed_form_and_to_its_walls() {
    // Undamped, without a spring, started so that it does not drift: q = −A/(mω²) sin ωt.
    let (amplitude, period) = (2.0, 0.5);
    let omega = std::f64::consts::TAU / period;
    let reach = amplitude / (omega * omega);
    let lane = |wall: f64| Lane {
        body: Oscillator { mass: 1.0, damping: 0.0, stiffness: 0.0 },
        lower: None,
        upper: Some(LaneWall { position: wall, law: WallLaw::Rigid { restitution: 0.5 } }),
        velocity: -amplitude / omega,
        period,
        ..source(amplitude, 0.5)
    };
    let batch = Plan::new(0, 50).run(&[lane(1.001 * reach), lane(1.0), lane(0.999 * reach)]).unwrap();
    for index in 0..2 {
        let outcome = batch.outcomes()[index].clone().unwrap();
        assert_eq!((outcome.by, outcome.upper.impacts), (By::Lanes, 0));
        // The drift of a body that nothing holds: rounding of the speed over 25 s.
        assert!((outcome.extent[1] - reach).abs() < 1e-12 && (outcome.extent[0] + reach).abs() < 1e-12, "{outcome:?}");
        assert!(batch.strobes(index).iter().all(|s| s[0].abs() < 1e-12));
    }
    assert!(batch.outcomes()[2].clone().unwrap().upper.impacts > 0);
}

#[test]
fn the_exponent_of_a_stable_orbit_is_that_of_its_multipliers() {
    // λ₁ + λ₂ = −c/m + 2Σν ln e. On the stable symmetric orbit of the source oscillator at e = 0.8
    // the multipliers of half a period are a complex pair of product 0.627327150916: both exponents
    // are its logarithm, −2.331435513142098 /s.
    let lanes: Vec<Lane> = (0..40).map(|i| Lane { velocity: 0.01 * f64::from(i), ..source(3.0, 0.8) }).collect();
    let batch = Plan::new(300, 2000).run(&lanes).unwrap();
    let mut seen = 0;
    for outcome in batch.outcomes().iter().flatten() {
        if (outcome.upper.impacts, outcome.lower.impacts) == (2000, 2000) {
            seen += 1;
            // A complex pair turns the change of the start: its size oscillates by a factor, over
            // 400 s.
            assert!((outcome.exponent + 2.331435513142098).abs() < 0.02, "{}", outcome.exponent);
        }
    }
    assert!(seen > 0);
}

#[test]
fn what_cannot_be_held_is_refused_by_name_or_handed_over_and_counted() {
    let good = source(3.0, 0.8);
    let mut bad = good.clone();
    bad.body.mass = -1.0;
    let error = Plan::new(0, 1).run(&[good.clone(), bad]).unwrap_err().to_string();
    assert!(error.starts_with("oscillator 2: oscillator: mass is -1"), "{error}");
    assert!(Plan::new(0, 0).run(std::slice::from_ref(&good)).unwrap_err().to_string().starts_with("keep"));
    // Elastic walls go to the exact scheme.
    let soft = Some(LaneWall { position: 4e-3, law: WallLaw::Elastic { stiffness: 1e4, damping: 1.0 } });
    let batch = Plan::new(5, 5).run(&[good.clone(), Lane { upper: soft, ..good }]).unwrap();
    assert_eq!((batch.handed(), batch.failed()), (1, 0));
    let outcome = batch.outcomes()[1].clone().unwrap();
    assert_eq!(outcome.by, By::Event);
    assert!(outcome.upper.peak_force.is_some_and(|force| force > 0.0) && outcome.upper.impulse < 0.0);
    assert!(outcome.extent[1] > 4e-3);
    assert!(Plan::new(0, 1).run(&[]).unwrap().outcomes().is_empty());
}

#[test]
fn a_graze_is_never_passed_and_never_made_up() {
    // The steady motion of the source oscillator without walls, from every phase, with walls at a
    // share of its size that is a little less or more than 1: far below the length of a step.
    let quiet = source(3.0, 0.5);
    let Oscillator { mass, damping, stiffness } = quiet.body;
    let omega = std::f64::consts::TAU / quiet.period;
    let (re, im) = (stiffness - mass * omega * omega, damping * omega);
    let (size, lag) = (3.0 / re.hypot(im), im.atan2(re));
    let mut lanes = Vec::new();
    let shares = [1.0 - 1e-3, 1.0 - 1e-6, 1.0 - 1e-9, 1.0 + 1e-9, 1.0 + 1e-6, 1.0 + 1e-3, 1.02];
    for share in shares {
        for i in 0..97 {
            // Not on a wall at the start.
            let phase = 0.013 + std::f64::consts::TAU * f64::from(i) / 97.0;
            let angle = phase - lag;
            let law = WallLaw::Rigid { restitution: 0.5 };
            let at = |sign: f64| Some(LaneWall { position: sign * size * share, law });
            let lane = Lane {
                lower: at(-1.0),
                upper: at(1.0),
                sines: vec![Sine { amplitude: 3.0, multiple: 1, phase }],
                displacement: size * angle.sin(),
                velocity: size * omega * angle.cos(),
                ..quiet.clone()
            };
            // A start behind a wall is invalid, and skipped.
            if lane.validate().is_ok() {
                lanes.push((share, lane));
            }
        }
    }
    let oscillators: Vec<Lane> = lanes.iter().map(|(_, lane)| lane.clone()).collect();
    for width in widths() {
        let batch = Plan { width, ..Plan::new(0, 3) }.run(&oscillators).unwrap();
        for ((share, lane), outcome) in lanes.iter().zip(batch.outcomes()) {
            let outcome = outcome.clone().unwrap();
            let impacts = outcome.lower.impacts + outcome.upper.impacts;
            assert_eq!(impacts > 0, *share < 1.0, "{width:?} {share} {outcome:?} {lane:?}");
            if *share > 1.0 {
                // Six turns, each of the size of the motion, to rounding of its terms.
                let [low, high] = outcome.extent;
                assert!((high - size).abs() < 1e-14 && (low + size).abs() < 1e-14, "{outcome:?} {size:e}");
            }
        }
        // Grazes closer than 1e-12 of the speed would be handed over; these are not.
        assert_eq!(batch.handed(), 0, "{width:?}");
    }
}
