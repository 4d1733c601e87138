//! Results that are not motions: facts with units, positions and remarks.

mod page;

use page::{example, number, Page, PENDULUM};
use serde_json::{json, Value};
use std::f64::consts::{PI, TAU};

/// The reply for an analysis that is added to a case.
fn found(case: &str, analysis: &str) -> Value {
    let mut page = Page::of(&format!("{case}\n[analyses.last]\nfrom = \"start\"\n{analysis}\n"));
    let reply = page.ask(json!({ "do": "run", "analysis": "last" }));
    assert_eq!((&reply["status"], &reply["error"]), (&json!("found"), &Value::Null));
    let fault = page.fault(json!({ "do": "frames" }));
    assert!(fault.contains("not a motion"), "{fault}");
    reply
}

/// The value and the unit of a fact.
fn fact<'a>(reply: &'a Value, name: &str) -> (&'a Value, &'a str) {
    let all = reply["facts"].as_array().expect("facts");
    let one = all.iter().find(|one| one["name"] == name).unwrap_or_else(|| panic!("{reply}"));
    (&one["value"], one["unit"].as_str().expect("a unit"))
}

#[test]
fn a_pendulum_hangs_at_rest() {
    let reply = found(PENDULUM, "type = \"equilibrium\"");
    assert_eq!(fact(&reply, "stability"), (&json!("stable"), ""));
    // m g L / 2
    let (stiffness, unit) = fact(&reply, "stiffness along bar.angle");
    assert!((number(stiffness) - 9.81).abs() < 1e-9 && unit == "N*m/rad", "{stiffness} {unit}");
    let rest = &reply["positions"][0];
    assert_eq!(rest["name"], "rest position");
    assert!((number(&rest["pose"]["poses"][0][2]) + 0.5 * PI).abs() < 1e-9, "{rest}");
}

#[test]
fn a_hanging_pendulum_has_the_frequency_of_its_formula() {
    let text = PENDULUM.to_string() + "[analyses.rest]\ntype = \"equilibrium\"\nfrom = \"start\"\n";
    let mut page = Page::of(&format!("{text}[analyses.last]\ntype = \"modes\"\n"));
    let reply = page.ask(json!({ "do": "run", "analysis": "last" }));
    let (frequency, unit) = fact(&reply, "mode 1: frequency");
    let expected = (1.5 * 9.81_f64).sqrt() / TAU;
    assert!((number(frequency) / expected - 1.0).abs() < 1e-12 && unit == "Hz", "{frequency}");
    assert_eq!(number(fact(&reply, "mode 1: damping ratio").0), 0.0);
    assert!((number(&reply["positions"][0]["pose"]["poses"][0][2]) + 0.5 * PI).abs() < 1e-9);
}

#[test]
fn limits_have_positions_and_reasons() {
    let reply = found(&example("four_bar"), "type = \"limits\"\nover = \"rocker.angle\"");
    let positions = reply["positions"].as_array().expect("positions");
    assert_eq!(positions.len(), 2, "{reply}");
    for (name, position) in ["lower", "upper"].iter().zip(positions) {
        let (value, unit) = fact(&reply, &format!("{name} limit of rocker.angle"));
        assert_eq!(unit, "rad");
        assert_eq!(position["name"], format!("{name} limit"));
        let drawn = number(&position["pose"]["poses"][2][2]);
        assert!((drawn - number(value)).abs() < 1e-9, "{drawn} {value}");
    }
    let (reason, _) = fact(&reply, "its reason");
    assert!(reason.as_str().expect("a text").contains("dead point"), "{reason}");
}

#[test]
fn a_four_bar_has_two_configurations_and_one_freedom() {
    let reply = found(&example("four_bar"), "type = \"configurations\"");
    assert_eq!(fact(&reply, "configurations").0, &json!(2));
    assert_eq!(reply["positions"].as_array().map(Vec::len), Some(2));
    let reply = found(&example("four_bar"), "type = \"mobility\"");
    for (name, count) in
        [("degrees of freedom", 1), ("Grübler's formula", 1), ("rank of the equations", 8)]
    {
        assert_eq!(fact(&reply, name).0, &json!(count), "{name}");
    }
    assert_eq!(fact(&reply, "redundant equations").0, &json!(0));
}

/// A path over a length has positions of other mechanisms than the drawn one.
#[test]
fn positions_with_other_lengths_are_not_drawn() {
    let text =
        PENDULUM.replace("length = 1", "length = \"L\"").replace("m = 2 # kg", "L = 1\nm = 2");
    let path = |over: &str| {
        found(&text, &format!("type = \"equilibrium\"\nover = \"{over}\"\nrange = [1, 2]"))
    };
    let reply = path("L");
    assert_eq!(fact(&reply, "end").0, "the path reached the end of the range");
    assert!(reply["remarks"].to_string().contains("lengths differ"), "{reply}");
    let reply = path("m");
    assert_eq!(reply["remarks"], json!([]));
    let (count, positions) = (fact(&reply, "positions").0, reply["positions"].as_array());
    assert_eq!(count.as_u64(), positions.map(|all| all.len() as u64));
}
