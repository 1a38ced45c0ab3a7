//! A sweep from Rust: the impact oscillator at rising and at falling frequency, each run starting
//! from the state in which the last one ended. Where the two directions differ there is hysteresis.
//!
//! `cargo run --release --example hysteresis`

use signorini::case::CaseFile;
use signorini::sweep::{Axis, Follow, Measure, Samples, Sweep, Window};

fn main() -> signorini::Result<()> {
    let frequency = Axis::linear("load.1.harmonic.frequency", 4.0, 5.5, 31)?.named("frequency");
    let plan = Sweep::new(CaseFile::embedded("rigid-walls-sine")?)
        .set("wall.*.restitution", 0.8)?
        .vary(frequency.followed(Follow::Both))
        .by("event")
        .over(Window::Periods { settle: 200, keep: 40 })
        .measure([Measure::ImpactsPerPeriod, Measure::Period, Measure::DisplacementMax])
        .sample(Samples::Impacts, 40)
        .plan()?;
    println!("{} rows: {}", plan.count(), plan.header().join(", "));

    // On all cores; the numbers do not depend on their count. `plan.run_into` writes tables
    // instead, and continues after an interruption.
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    let rows = plan.rows(threads)?;
    let (up, down) = rows.split_at(rows.len() / 2);
    println!("{:>10} {:>16} {:>16}", "Hz", "impacts up", "impacts down");
    for (up, down) in up.iter().zip(down.iter().rev()) {
        let frequency = up.values.first().and_then(signorini::case::KeyValue::number).unwrap_or(f64::NAN);
        let [a, b] = [up, down].map(|row| row.measures.first().copied().flatten().unwrap_or(f64::NAN));
        let differs = if (a - b).abs() > 0.1 { "  two motions" } else { "" };
        println!("{frequency:>10.2} {a:>16.2} {b:>16.2}{differs}");
    }
    let worst = rows.iter().find(|row| !row.status.is_good());
    worst.map_or(Ok(()), |row| {
        println!("row {} failed: {}", row.number, row.error);
        Ok(())
    })
}
