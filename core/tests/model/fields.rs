//! Fields of every kind: their values, defaults and faults, from files and from Rust.

use crate::mechanisms::model;
use kempe::case::{self, Format};
use kempe::elements::test_elements::Blower;
use kempe::elements::{BodyId, ForceElement, Side};
use kempe::{Model, ModelBuilder};

const FILE: &str = r#"
kempe = 1
[bodies.b]
mass = 1
inertia = 1
[forces.wind]
type = "blower"
j = "b"
force = ["2*t", 3]
gusts = [1, "t", 4]
"#;

fn blower(model: &Model) -> &Blower {
    match &model.forces[0].element {
        ForceElement::Blower(blower) => blower,
        other => panic!("{}", other.kind()),
    }
}

#[test]
fn fields_that_are_left_out_have_their_defaults() {
    let model = model(FILE);
    let e = blower(&model);
    assert_eq!((e.force, &e.gusts), ([0.0, 3.0], &vec![1.0, 0.0, 4.0]));
    assert_eq!((e.factor, e.more, e.less), (None, None, None));
    assert_eq!((e.side, e.off, e.i), (Side::Right, false, BodyId::GROUND));
    assert!(model.forces[0].law.is_some());
}

#[test]
fn fields_that_are_given() {
    let more = "factor = \"t + 2\"\nside = \"left\"\noff = true\nmore = [5, 6]\nless = 7\n";
    let model = model(&format!("{FILE}{more}"));
    let e = blower(&model);
    assert_eq!((e.factor, e.more, e.less), (Some(2.0), Some([5.0, 6.0]), Some(7.0)));
    assert_eq!((e.side, e.off), (Side::Left, true));
}

#[test]
fn the_same_from_rust() {
    let mut m = ModelBuilder::new("wind");
    m.body("b").mass(1).inertia(1);
    let wind = Blower::written().j("b").force(["2*t", "3"]).gusts(["1", "t", "4"]);
    m.add("wind", wind.side("left").off(true).more((5, 6)).less(7).factor("t + 2"));
    let model = m.build().unwrap();
    let e = blower(&model);
    assert_eq!((e.force, &e.gusts), ([0.0, 3.0], &vec![1.0, 0.0, 4.0]));
    assert_eq!((e.factor, e.more, e.less), (Some(2.0), Some([5.0, 6.0]), Some(7.0)));
    assert_eq!((e.side, e.off), (Side::Left, true));
}

/// The faults of a file with further lines, or with a line in place of another.
fn faults(find: &str, line: &str) -> String {
    let text = match find {
        "" => format!("{FILE}{line}\n"),
        _ => FILE.replace(find, line),
    };
    let words = |problems: &[String]| problems.join("\n");
    match case::read(&text, Format::Toml) {
        Ok((case, _)) => {
            let problems = kempe::model::build(&case.definition, &[]).err().unwrap();
            words(&problems.iter().map(ToString::to_string).collect::<Vec<_>>())
        }
        Err(faults) => words(&faults.iter().map(ToString::to_string).collect::<Vec<_>>()),
    }
}

#[test]
fn faults_name_the_field_and_the_values_that_it_may_have() {
    for (find, line, words) in [
        ("", "side = \"rihgt\"", ["side", "unknown word 'rihgt'", "did you mean 'right'"]),
        ("", "side = 3", ["side", "a number", "right or left"]),
        ("", "off = 1", ["off", "a number", "true or false"]),
        ("", "more = [1, 2, 3]", ["more", "a list of 3", "two numbers"]),
        ("", "less = [1]", ["less", "a list", "a number or a formula"]),
        ("gusts = [1, \"t\", 4]", "gusts = []", ["gusts", "empty", "a list of formulas"]),
        ("gusts = [1, \"t\", 4]", "gusts = \"t\"", ["gusts", "a text", "a list of formulas"]),
        ("gusts = [1, \"t\", 4]", "gusts = [1, \"u\"]", ["gusts", "'u'", "unknown"]),
        ("gusts = [1, \"t\", 4]", "", ["gusts", "missing", "blower"]),
    ] {
        let text = faults(find, line);
        assert!(words.iter().all(|word| text.contains(word)), "{line}: {text}");
    }
}
