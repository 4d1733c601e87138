//! Random and damaged cases on their whole way: read, write, read, build, assemble, run.
//!
//! Nothing panics, a success has finite numbers and closed joints, an error has a message, and what is written is read
//! back unchanged. The normal suite takes a few hundred inputs. `KEMPE_FUZZ=100000` sets another number, and
//! `KEMPE_FUZZ_ONLY=4711` takes one input and prints it.

mod damage;
mod drawn;
mod passage;
mod random;

use passage::{passage, Reached};
use random::Random;
use std::panic::{catch_unwind, AssertUnwindSafe};

/// Inputs of the normal suite.
const INPUTS: u64 = 600;

/// The input with a number: every second is drawn, the others are damaged examples or damaged drawn cases.
fn input(number: u64) -> String {
    let mut random = Random::new(number);
    let text = match number % 4 {
        0 | 2 => return drawn::case(&mut random),
        1 => damage::EXAMPLES[random.below(damage::EXAMPLES.len())].to_string(),
        _ => drawn::case(&mut random),
    };
    damage::damaged(&mut random, text)
}

/// The stage that an input reaches, or the message of the panic.
fn attempt(text: &str) -> Result<Reached, String> {
    catch_unwind(AssertUnwindSafe(|| passage(text))).map_err(|panic| {
        let text = panic.downcast_ref::<String>().cloned();
        text.or_else(|| panic.downcast_ref::<&str>().map(|s| s.to_string())).unwrap_or_default()
    })
}

fn variable(name: &str) -> Option<u64> {
    std::env::var(name).ok().and_then(|text| text.parse().ok())
}

#[test]
fn no_input_has_a_fault() {
    let only = variable("KEMPE_FUZZ_ONLY");
    let numbers = match only {
        Some(number) => number..number + 1,
        None => 0..variable("KEMPE_FUZZ").unwrap_or(INPUTS),
    };
    let (mut counts, mut faults) = ([0_u64; 6], Vec::new());
    for number in numbers.clone() {
        let text = input(number);
        if only.is_some() {
            println!("{text}");
        }
        match attempt(&text) {
            Ok(reached) => counts[reached as usize] += 1,
            Err(message) => faults.push(format!("input {number}: {message}")),
        }
    }
    let stages = ["refused text", "read", "built", "assembled", "stopped run", "whole run"];
    println!("{stages:?}: {counts:?}");
    let shown = &faults[..faults.len().min(20)];
    assert!(faults.is_empty(), "{} faults\n{}", faults.len(), shown.join("\n"));
    if only.is_none() {
        // every stage is reached, and many inputs run to their end
        assert!(counts.iter().all(|count| *count > 0), "{stages:?}: {counts:?}");
        assert!(counts[Reached::Run as usize] > numbers.end / 12, "{stages:?}: {counts:?}");
    }
}

#[test]
fn an_input_can_be_repeated() {
    assert_eq!(input(17), input(17));
    assert_ne!(input(16), input(20));
}
