//! Times of the floor and of kempe, measured in alternation, as JSON.
//!
//! ```text
//! cargo run --release            evaluations, windows, runs and sweeps, 21 of each
//! cargo run --release -- 5       5 of each
//! cargo run --release -- 5 runs  one part: evaluation, windows, runs or sweep
//! ```
//!
//! The times are medians of CPU times of the thread. "chain" is the floor program, written by hand for
//! speed. "straight" is a plain block elimination. "kempe" is the general program, called from Rust.
//! "other" is kempe on another linkage of the same size, which was not used for tuning.

mod evaluations;
mod runs;
mod sweeps;
mod turns;

use mimalloc::MiMalloc;
use serde_json::{json, Value};

#[global_allocator]
static ALLOCATOR: MiMalloc = MiMalloc;

/// One part of the measurements, given the number of repetitions.
type Measure = fn(usize) -> Value;

/// Default number of repetitions.
const REPEAT: usize = 21;

fn main() {
    let mut words = std::env::args().skip(1);
    let repeat = match words.next().as_deref().map(str::parse) {
        None => REPEAT,
        Some(Ok(repeat)) if repeat > 0 => repeat,
        Some(_) => refuse("repetitions: must be a whole number above 0"),
    };
    let parts: [(&str, Measure); 4] = [
        ("evaluation", evaluations::measure),
        ("windows", evaluations::windows),
        ("runs", runs::measure),
        ("sweep", sweeps::measure),
    ];
    let part = words.next();
    if part.as_ref().is_some_and(|part| parts.iter().all(|(name, _)| name != part)) {
        refuse("part: must be evaluation, windows, runs or sweep");
    }
    let mut found = json!({ "repeat": repeat });
    for (name, measure) in parts {
        if part.as_ref().is_none_or(|part| part == name) {
            found[name] = measure(repeat);
        }
    }
    println!("{found:#}");
}

fn refuse(why: &str) -> ! {
    eprintln!("kempe-floor: {why}");
    std::process::exit(2);
}
