//! Random scenes against differences of an independent integrator with 40 digits: see generate.py,
//! which wrote scenes.csv.

use signorini::linear::Symmetric;
use signorini::study::derivatives::Derivatives;
use signorini::variation::SceneTangent;
use signorini::{Load, Probe, Row, Scene, Structure, Wall};

/// The numbers of splitmix64, as in generate.py.
struct Draw(u64);

impl Draw {
    fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^= z >> 31;
        (z >> 11) as f64 * 2.0_f64.powi(-53)
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }
}

/// A wall: its row, true for a lower one, its position, and its law.
#[derive(Clone)]
struct Place {
    row: Vec<(usize, f64)>,
    lower: bool,
    position: f64,
    rigid: bool,
    restitution: f64,
    stiffness: f64,
    damping: f64,
}

impl Place {
    fn draw(draw: &mut Draw, row: Vec<(usize, f64)>, lower: bool, most: f64) -> Self {
        let position = draw.between(0.02, most) * if lower { -1.0 } else { 1.0 };
        let mut place = Self { row, lower, position, rigid: true, restitution: 0.0, stiffness: 0.0, damping: 0.0 };
        if draw.unit() < 0.55 {
            place.restitution = draw.between(0.3, 0.95);
            if draw.unit() < 0.15 {
                place.restitution = 0.0;
            }
        } else {
            place.rigid = false;
            place.stiffness = draw.between(300.0, 3000.0);
            place.damping = draw.between(0.0, 6.0);
        }
        place
    }
}

/// The numbers of a scene.
#[derive(Clone)]
struct Numbers {
    mass: Vec<f64>,
    spring: Vec<f64>,
    dash: Vec<f64>,
    walls: Vec<Place>,
    /// Amplitude, frequency, phase and the constant force.
    load: [f64; 4],
    /// Impulse and time.
    blow: Option<[f64; 2]>,
    q: Vec<f64>,
    v: Vec<f64>,
    duration: f64,
}

/// A number of a scene.
type Key = Box<dyn Fn(&mut Numbers) -> &mut f64>;

impl Numbers {
    /// The scene of this number, as generate.py draws it, and its key.
    fn draw(number: u64) -> (Self, Key) {
        let draw = &mut Draw(number);
        let mut n = if draw.unit() < 0.6 { 1 } else { 2 + (3.0 * draw.unit()) as usize };
        if number >= 10_000 {
            n = 5 + (number % 2) as usize;
        }
        let (mut mass, mut spring, mut dash) = (Vec::new(), Vec::new(), Vec::new());
        for _ in 0..n {
            mass.push(draw.between(0.5, 2.0));
            spring.push(draw.between(20.0, 100.0));
            dash.push(draw.between(0.0, 0.6));
        }
        if n == 1 && draw.unit() < 0.25 {
            spring[0] = 0.0;
        }
        let mut walls = vec![Place::draw(draw, vec![(n - 1, 1.0)], false, 0.08)];
        if draw.unit() < 0.6 {
            walls.push(Place::draw(draw, vec![(0, 1.0)], true, 0.08));
        }
        if n > 1 && draw.unit() < 0.3 {
            walls.push(Place::draw(draw, vec![(1, 1.0), (0, -1.0)], true, 0.06));
        }
        let mut load = [draw.between(1.0, 6.0), draw.between(0.6, 3.0), draw.between(0.0, 6.0), 0.0];
        if draw.unit() < 0.5 {
            load[3] = draw.between(-1.5, 1.5);
        }
        let blow = (draw.unit() < 0.2).then(|| [draw.between(-0.3, 0.3), draw.between(0.3, 1.0)]);
        let q = (0..n).map(|_| draw.between(-0.01, 0.01)).collect();
        let v = (0..n).map(|_| draw.between(-0.3, 0.3)).collect();
        let duration = draw.between(1.2, 2.0);
        let numbers = Self { mass, spring, dash, walls, load, blow, q, v, duration };
        let mut keys = numbers.keys();
        let key = keys.swap_remove((draw.unit() * keys.len() as f64) as usize);
        (numbers, key)
    }

    fn keys(&self) -> Vec<Key> {
        let n = self.mass.len();
        let mut keys: Vec<Key> = Vec::new();
        (0..n).for_each(|i| keys.push(Box::new(move |x| &mut x.mass[i])));
        (0..n).filter(|&i| self.spring[i] > 0.0).for_each(|i| keys.push(Box::new(move |x| &mut x.spring[i])));
        (0..n).for_each(|i| keys.push(Box::new(move |x| &mut x.dash[i])));
        for (w, wall) in self.walls.iter().enumerate() {
            keys.push(Box::new(move |x| &mut x.walls[w].position));
            if wall.rigid && wall.restitution > 0.0 {
                keys.push(Box::new(move |x| &mut x.walls[w].restitution));
            }
            if !wall.rigid {
                keys.push(Box::new(move |x| &mut x.walls[w].stiffness));
                keys.push(Box::new(move |x| &mut x.walls[w].damping));
            }
        }
        (0..3).for_each(|i| keys.push(Box::new(move |x| &mut x.load[i])));
        if self.load[3] != 0.0 {
            keys.push(Box::new(|x| &mut x.load[3]));
        }
        if self.blow.is_some() {
            keys.push(Box::new(|x| &mut x.blow.as_mut().expect("a blow")[0]));
        }
        (0..n).for_each(|i| keys.push(Box::new(move |x| &mut x.q[i])));
        (0..n).for_each(|i| keys.push(Box::new(move |x| &mut x.v[i])));
        keys
    }

    fn scene(&self) -> Scene {
        let n = self.mass.len();
        let mut scene = if n == 1 {
            Scene::oscillator(self.mass[0], self.dash[0], self.spring[0])
        } else {
            let chain = |links: &[f64]| {
                let own = links.iter().enumerate().map(|(i, &k)| (i, i, k));
                let next = links.iter().enumerate().skip(1).flat_map(|(i, &k)| [(i - 1, i - 1, k), (i, i - 1, -k)]);
                Symmetric::from_entries(n, own.chain(next).collect::<Vec<_>>())
            };
            Scene::structure(Structure {
                mass: Symmetric::diagonal(&self.mass),
                damping: chain(&self.dash),
                stiffness: chain(&self.spring),
            })
        };
        for (w, place) in self.walls.iter().enumerate() {
            let name = format!("wall-{w}");
            let wall =
                if place.lower { Wall::lower(&name, place.position) } else { Wall::upper(&name, place.position) };
            let wall = wall.at(Row::new(place.row.clone()));
            scene = scene.with_wall(if place.rigid {
                wall.with_restitution(place.restitution)
            } else {
                wall.with_elasticity(place.stiffness, place.damping)
            });
        }
        let [amplitude, frequency, phase, constant] = self.load;
        scene = scene.with_load(Load::harmonic(amplitude, frequency, phase));
        scene = scene.with_load(Load { at: Row::dof(n - 1), ..Load::constant(constant) });
        if let Some([impulse, time]) = self.blow {
            scene = scene.with_load(Load::impulse(impulse, time));
        }
        scene.probes = vec![Probe { name: "first".to_owned(), at: Row::dof(0) }];
        scene.with_initial(&self.q, &self.v).with_duration(self.duration)
    }
}

/// What the integrator gives for a scene: at the end, and of the first contacts.
struct Expected {
    number: u64,
    end: [f64; 2],
    contacts: Vec<[f64; 3]>,
}

fn expected() -> Vec<Expected> {
    let read = |line: &str| {
        let mut cells = line.split(',');
        let number = cells.next().and_then(|cell| cell.parse().ok()).expect("a number");
        let values: Vec<f64> = cells.map(|cell| cell.parse().expect("a value")).collect();
        let (end, contacts) = values.split_at(2);
        Expected {
            number,
            end: [end[0], end[1]],
            contacts: contacts.chunks_exact(3).map(|c| [c[0], c[1], c[2]]).collect(),
        }
    };
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/derivative/scenes.csv");
    std::fs::read_to_string(path).expect("the data").lines().map(read).collect()
}

/// The largest error of a scene as a share; `None` where the derivative is said to mean nothing.
fn error(expected: &Expected) -> Option<f64> {
    let (numbers, key) = Numbers::draw(expected.number);
    let value = *key(&mut numbers.clone());
    let tangent = SceneTangent::new("key", value, |x| {
        let mut numbers = numbers.clone();
        *key(&mut numbers) = x;
        Ok(numbers.scene())
    })
    .expect("a tangent");
    let scene = numbers.scene();
    let found = Derivatives::new(&scene, &[tangent], &[scene.duration]).expect("a run");
    if let Some(reason) = &found.ended {
        println!("scene {}: {reason}", expected.number);
        return None;
    }
    // Numbers of one kind are compared as a share of the largest of them, since a small one may be
    // the difference of two large ones.
    let mut kinds: [Vec<[f64; 2]>; 5] = Default::default();
    kinds[0].push([found.motion.displacement_by[0], expected.end[0]]);
    kinds[1].push([found.motion.velocity_by[0], expected.end[1]]);
    assert!(found.contacts.len() >= expected.contacts.len(), "scene {}: too few contacts", expected.number);
    for (contact, of) in found.contacts.iter().zip(&expected.contacts) {
        let own = [contact.start_by[0], contact.approach_speed_by[0], contact.impulse_by[0]];
        (0..3).for_each(|kind| kinds[2 + kind].push([own[kind], of[kind]]));
    }
    let worst = |pairs: &Vec<[f64; 2]>| {
        let size = pairs.iter().fold(1e-6 / value.abs(), |most: f64, pair| most.max(pair[1].abs()));
        pairs.iter().map(|[a, b]| if a.is_nan() { f64::INFINITY } else { (a - b).abs() / size }).fold(0.0, f64::max)
    };
    Some(kinds.iter().map(worst).fold(0.0, f64::max))
}

/// The data have eleven digits. The derivative is exact to 1e-15 times its growth, and given up
/// where a change has grown by 1e6: 1e-8 leaves ten for what the sizes of terms cost.
#[test]
fn derivatives_are_those_of_an_independent_integrator() {
    let all = expected();
    let (mut silent, mut wrong, mut worst) = (0, Vec::new(), 0.0_f64);
    for expected in &all {
        match error(expected) {
            Some(error) if error <= 1e-8 => worst = worst.max(error),
            Some(error) => wrong.push((expected.number, error)),
            None => silent += 1,
        }
    }
    println!(
        "{} scenes, {silent} without a derivative, {} wrong, worst of the others {worst:e}",
        all.len(),
        wrong.len()
    );
    assert!(wrong.is_empty(), "{wrong:?}");
    assert!(all.len() >= 1000 && silent * 20 <= all.len(), "{silent} of {}", all.len());
}
