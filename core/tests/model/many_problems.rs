//! Messages of many problems: a hundred of them, and how many more.

use crate::mechanisms::clock;
use kempe::case::{read, Format, MOST_REPORTED};
use kempe::model::{build, Problems};
use std::fmt::Write as _;
use std::time::Instant;

/// Pins between bodies that do not exist.
fn unknown_bodies(joints: usize) -> String {
    let mut text = String::from("kempe = 1\n[bodies.ground]\npoints = { A = [0, 0] }\n");
    for k in 0..100 {
        _ = writeln!(text, "[bodies.body{k}]\nmass = 1\ninertia = 1\npoints = {{ A = [0, 0] }}");
    }
    for k in 0..joints {
        _ = writeln!(
            text,
            "[joints.J{k}]\ntype = \"revolute\"\ni = \"ground.A\"\nj = \"bodi{k}.A\""
        );
    }
    text
}

fn built(joints: usize) -> Problems {
    let (case, _) = read(&unknown_bodies(joints), Format::Toml).expect("the structure is right");
    Problems(build(&case.definition, &[]).expect_err("unknown bodies"))
}

#[test]
fn a_message_of_a_model_has_a_hundred_problems_and_the_number_of_others() {
    for (joints, last) in [
        (100, "joints.J99.j: unknown body 'bodi99'; did you mean 'body99'?"),
        (101, "… and 1 more problem"),
        (350, "… and 250 more problems"),
    ] {
        let message = built(joints).to_string();
        assert_eq!(message.lines().last(), Some(last));
        assert_eq!(message.lines().count(), MOST_REPORTED + usize::from(joints > 100));
    }
}

/// Suggestions are sought for the problems that are shown only.
#[test]
fn twenty_thousand_unknown_bodies_are_refused_in_linear_time() {
    let time = |joints: usize| {
        let origin = Instant::now();
        let begin = clock(origin);
        assert_eq!(built(joints).0.len(), joints);
        clock(origin) - begin
    };
    let few = (0..3).map(|_| time(2_000)).fold(f64::INFINITY, f64::min);
    let many = time(20_000);
    assert!(many < 60.0 * few, "{few} s and then {many} s"); // quadratic: 100 times
}

#[test]
fn a_message_of_structure_has_a_hundred_faults_and_the_number_of_others() {
    let faults = |n: usize| {
        let mut text = String::from("kempe = 1\n[bodies.ball]\nmass = 1\ninertia = 1\n");
        (0..n).for_each(|k| _ = writeln!(text, "colour{k} = 1"));
        read(&text, Format::Toml).expect_err("unknown keys")
    };
    assert_eq!(faults(100).len(), 100);
    let found = faults(123);
    assert_eq!(found.len(), MOST_REPORTED + 1);
    assert_eq!(found[MOST_REPORTED].to_string(), "… and 23 more problems");
    assert!(found[..MOST_REPORTED].iter().all(|fault| fault.line > 0));
}

#[test]
fn a_message_of_syntax_has_the_number_of_others() {
    let found = read(&"=\n".repeat(500), Format::Toml).expect_err("no TOML");
    let last = found.last().map(ToString::to_string).unwrap_or_default();
    assert!(last.starts_with("… and ") && last.ends_with(" more problems"), "{last}");
}
