//! Contacts with Coulomb friction in the plane, each with one tangent, all of a step together.
//!
//! Contact i gives the impulse p along −n and f along t. Together they change the rates u along
//! these directions, u = W x + u₀ with x = (p₁, f₁, p₂, …) and W symmetric and at least
//! semidefinite (the response of the structure, with the compliance of elastic contacts), or with
//! rows u_n in units of their own:
//!
//! 0 ≤ u_n ⟂ p ≥ 0,    |f| ≤ μp,    f = −μp sign(u_t) where u_t ≠ 0.
//!
//! With f = f⁺ − f⁻ and λ = |u_t| where it slides this is the linear complementarity problem of
//! Stewart & Trinkle 1996, doi:10.1002/(SICI)1097-0207(19960815)39:15<2673::AID-NME972>3.0.CO;2-I,
//! in the unknowns p, f⁺, f⁻, λ ≥ 0 of each contact (p alone where μ = 0):
//!
//! 0 ≤ u_n ⟂ p,    0 ≤ λ + u_t ⟂ f⁺,    0 ≤ λ − u_t ⟂ f⁻,    0 ≤ μp − f⁺ − f⁻ ⟂ λ.
//!
//! [`lemke`] solves it; then one linear system for the states that it finds (open, stick, slip
//! either way) makes the result exact to rounding. Its matrix is copositive. Where it ends in a ray
//! there may yet be a solution: other weights of the artificial unknown are tried, then all
//! combinations of states, of which one is a solution wherever one exists, since the vertices of
//! the solutions of any combination are those of another one whose system has full rank.
//!
//! A contact may demand a rebound: u_n = −n·v⁺ − r with r > 0. Along a ray the impulses balance one
//! another, and the rates that they act on sum up to −Σ pᵢ rᵢ. So if no contact with p̃ > 0 along
//! any ray has a rebound, a solution exists (Anitescu & Potra 1997, doi:10.1023/A:1008292328909).
//! Where there is none, the contacts of the ray are wedged: their rebound is given up, and the
//! problem is solved again.

mod unknowns;

use super::dependent::solve_dependent;
use super::lemke::{Lemke, lemke};

/// Largest residual of an answer in a row, relative to the terms of the row: answers are exact to
/// some roundings, wrong states miss by far more.
const MET: f64 = 1e-11;

/// Impulses that press against each other may cause velocities that are larger than those of the
/// problem by this factor; beyond, any velocity would count as rounding.
const PRESSED: f64 = 1e3;

/// Weights of the artificial unknown that are tried.
const TRIES: usize = 9;

/// The differences below which ratios of rows count as equal, one after the other. Where impulses
/// that press against each other are far larger than the momenta, rows that block at once differ by
/// more than in an ordinary problem, and a path that takes the wrong one of them ends in a ray that
/// is rounding, or goes round.
const EQUAL: [f64; 3] = [1e-12, 1e-10, 1e-8];

/// Most combinations of states that are tried: six contacts that rub.
const MOST_COMBINATIONS: usize = 4096;

/// Contacts along a ray whose share is below this of the largest are rounding.
const IN_RAY: f64 = 1e-6;

/// A contact of the problem.
#[derive(Debug, Clone, Copy)]
pub(crate) struct CoulombContact {
    /// u_n and u_t without impulses, m/s.
    pub free: [f64; 2],
    /// μ.
    pub friction: f64,
    /// r ≥ 0: what of −u_n is the rebound that the contact demands, m/s.
    pub rebound: f64,
}

/// The problem of all contacts of a step.
#[derive(Debug)]
pub(crate) struct Coulomb {
    contacts: Vec<CoulombContact>,
    /// W, row by row, two rows a contact.
    response: Vec<f64>,
    /// 1/√W_kk, 0 where W_kk is.
    scale: Vec<f64>,
    /// Rounding of the rates without impulses, m/s.
    rounding: f64,
}

/// What a contact does.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Mode {
    Open,
    Stick,
    /// Slip, or without friction: f is this times μp.
    Slip(f64),
}

/// An unknown of the complementarity problem, each of one contact.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Unknown {
    Press(usize),
    /// f⁺ or f⁻, by its sign.
    Rub(usize, f64),
    Slip(usize),
}

impl Coulomb {
    /// The problem of these contacts with the responses W, 2 × 2 numbers for each pair of contacts,
    /// row by row. Rows of the tangents of contacts without friction are not used. The rates of the
    /// contacts without impulses are known to `rounding` (m/s).
    pub fn new(contacts: Vec<CoulombContact>, response: Vec<f64>, rounding: f64) -> Self {
        let n = 2 * contacts.len();
        let own = |k: usize| response[k * n + k];
        let scale = (0..n).map(|k| if own(k) > 0.0 { 1.0 / own(k).sqrt() } else { 0.0 }).collect();
        Self { contacts, response, scale, rounding }
    }

    /// Solves for p and f of each contact, and lists the contacts that gave up their rebound.
    /// `None` where rounding leaves no answer.
    pub fn solve(mut self) -> Option<(Vec<[f64; 2]>, Vec<usize>)> {
        let mut wedged = Vec::new();
        if !self.contacts.iter().all(|contact| contact.free.iter().all(|u| u.is_finite())) {
            return None;
        }
        loop {
            let mut ray = match self.answer() {
                Ok(impulses) => return Some((impulses, wedged)),
                Err(ray) => ray,
            };
            ray.retain(|&contact| self.contacts[contact].rebound > self.rounding);
            if ray.is_empty() {
                return None;
            }
            for &index in &ray {
                let contact = &mut self.contacts[index];
                contact.free[0] += std::mem::take(&mut contact.rebound);
            }
            wedged.append(&mut ray);
        }
    }

    /// p and f of each contact, or the contacts along the rays that contradict them.
    fn answer(&self) -> Result<Vec<[f64; 2]>, Vec<usize>> {
        let unknowns = self.unknowns();
        let (matrix, free, largest) = self.complementarity(&unknowns);
        let mut wedged: Vec<usize> = Vec::new();
        for attempt in 0..TRIES {
            // Any positive weights will do.
            let weight = |k: usize| 1.0 + 0.7 * ((attempt * (7 * k + 13)) as f64).sin();
            let weights: Vec<f64> = (0..unknowns.len()).map(weight).collect();
            match lemke(&matrix, &free, &weights, EQUAL[attempt % EQUAL.len()]) {
                Lemke::Solution(z) => {
                    let mut impulses = self.impulses(&unknowns, &z, largest);
                    let raw = (self.residual(&impulses), impulses.clone());
                    self.settle(&self.modes(&unknowns, &z), &mut impulses);
                    let exact = (self.residual(&impulses), impulses);
                    let (residual, impulses) = if exact.0 <= raw.0 { exact } else { raw };
                    if residual <= MET {
                        return Ok(impulses);
                    }
                }
                Lemke::Ray(z) => {
                    let most = z.iter().fold(0.0_f64, |most, z| most.max(*z));
                    for (unknown, z) in unknowns.iter().zip(&z) {
                        if let Unknown::Press(contact) = *unknown
                            && *z > IN_RAY * most
                            && !wedged.contains(&contact)
                        {
                            wedged.push(contact);
                        }
                    }
                }
                Lemke::Lost => {}
            }
        }
        self.any_combination().ok_or(wedged)
    }

    /// Tries all combinations of states, if these are not too many.
    fn any_combination(&self) -> Option<Vec<[f64; 2]>> {
        const RUBS: [Mode; 4] = [Mode::Open, Mode::Stick, Mode::Slip(-1.0), Mode::Slip(1.0)];
        const SMOOTH: [Mode; 2] = [Mode::Open, Mode::Slip(0.0)];
        let choices = self.contacts.iter().map(|contact| if contact.friction > 0.0 { &RUBS[..] } else { &SMOOTH[..] });
        let choices: Vec<&[Mode]> = choices.collect();
        let count = choices.iter().try_fold(1_usize, |count, modes| count.checked_mul(modes.len()))?;
        if count > MOST_COMBINATIONS {
            return None;
        }
        (0..count).find_map(|mut number| {
            let next = |modes: &&[Mode]| {
                let mode = modes[number % modes.len()];
                number /= modes.len();
                mode
            };
            let modes: Vec<Mode> = choices.iter().map(next).collect();
            let mut impulses = vec![[0.0; 2]; modes.len()];
            self.settle(&modes, &mut impulses);
            (self.residual(&impulses) <= MET).then_some(impulses)
        })
    }

    /// u_n or u_t of row `k` of W.
    fn rate(&self, k: usize, impulses: &[[f64; 2]]) -> f64 {
        let n = self.scale.len();
        let moved = self.response[k * n..(k + 1) * n].iter().zip(impulses.as_flattened()).map(|(w, x)| w * x);
        self.contacts[k / 2].free[k % 2] + moved.sum::<f64>()
    }

    /// Solves for the impulses of contacts in these states. Where their rows depend on one another,
    /// impulses that are not determined stay as they are.
    fn settle(&self, modes: &[Mode], impulses: &mut [[f64; 2]]) {
        let comply = |impulses: &mut [[f64; 2]]| {
            for ((impulse, mode), contact) in impulses.iter_mut().zip(modes).zip(&self.contacts) {
                match mode {
                    Mode::Open => *impulse = [0.0; 2],
                    Mode::Stick => {}
                    Mode::Slip(sign) => impulse[1] = sign * contact.friction * impulse[0],
                }
            }
        };
        comply(impulses);
        let n = self.scale.len();
        let mut rows = Vec::with_capacity(n);
        for (index, mode) in modes.iter().enumerate().filter(|(_, mode)| **mode != Mode::Open) {
            rows.push(2 * index);
            if *mode == Mode::Stick {
                rows.push(2 * index + 1);
            }
        }
        let mut matrix = Vec::with_capacity(rows.len() * (rows.len() + 1));
        for &k in &rows {
            let w = &self.response[k * n..(k + 1) * n];
            for &l in &rows {
                let rubs = match modes[l / 2] {
                    Mode::Slip(sign) => sign * self.contacts[l / 2].friction * w[l + 1],
                    _ => 0.0,
                };
                matrix.push((w[l] + rubs) * self.scale[k] * self.scale[l]);
            }
            matrix.push(-self.scale[k] * self.rate(k, impulses));
        }
        solve_dependent(&mut matrix, &mut Vec::new());
        for (row, &k) in matrix.chunks_exact(rows.len() + 1).zip(&rows) {
            impulses[k / 2][k % 2] += row[rows.len()] * self.scale[k];
        }
        for impulse in impulses.iter_mut().filter(|impulse| impulse[0] < 0.0) {
            // A push of −1e-20 N s is none; of a wrong state the residual tells.
            *impulse = [0.0; 2];
        }
        comply(impulses);
    }

    /// By how much impulses miss the law, each rate relative to the terms of its row: impulses that
    /// change velocities by 1e-9 of those with which other contacts slide obey it as well. Rates
    /// that are 0 but for the rounding of those without impulses are 0.
    fn residual(&self, impulses: &[[f64; 2]]) -> f64 {
        let n = self.scale.len();
        let free = self.contacts.iter().flat_map(|contact| contact.free);
        let most_moved = PRESSED * free.fold(0.0_f64, |most, u| most.max(u.abs()));
        let moved = |k: usize| {
            let terms = self.response[k * n..(k + 1) * n].iter().zip(impulses.as_flattened());
            terms.map(|(w, x)| (w * x).abs()).sum::<f64>().min(most_moved)
        };
        // What misses nothing is exact, also in a row without terms.
        let share = |missed: f64, terms: f64| if missed <= 0.0 { 0.0 } else { missed / terms };
        let of = |(index, (contact, &[p, f])): (usize, (&CoulombContact, &[f64; 2]))| {
            let [k, l] = [2 * index, 2 * index + 1];
            let pressing = self.rate(k, impulses).min(self.response[k * n + k] * p).abs();
            let missed = share(pressing - self.rounding, contact.free[0].abs() + moved(k));
            if contact.friction == 0.0 {
                return missed;
            }
            let (along, most, c) = (self.rate(l, impulses), contact.friction * p, self.response[l * n + l]);
            let beyond = share(c * (f.abs() - most), moved(l));
            let sticks = share(along.abs() - self.rounding, contact.free[1].abs() + moved(l));
            let slips = share(c * (f + most * along.signum()).abs(), moved(l));
            missed.max(beyond).max(sticks.min(slips))
        };
        // Not a number is the largest.
        let larger = |most, missed| if missed <= most { most } else { missed };
        self.contacts.iter().zip(impulses).enumerate().map(of).fold(0.0, larger)
    }
}

#[cfg(test)]
mod tests;
