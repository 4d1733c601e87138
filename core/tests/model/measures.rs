//! Measures: names, units, values and faults.

use crate::mechanisms::{faults, four_bar, FOUR_BAR};
use kempe::analyses::measures::{check, Measure};
use kempe::case::{read, Format};
use kempe::{ModelBuilder, Problems};

#[test]
fn a_measure_lists_its_quantities_and_has_a_unit() {
    let (m, _) = four_bar();
    for (text, quantities, unit) in [
        ("C.force", &["C.force"][..], "N"),
        ("abs(rocker.omega)", &["rocker.omega"], "rad/s"),
        (
            "C.fx*coupler.C.vx + C.fy*coupler.C.vy",
            &["C.fx", "coupler.C.vx", "C.fy", "coupler.C.vy"],
            "W",
        ),
        ("rocker.angle - rocker.angle/2", &["rocker.angle"], "rad"),
        ("spring.energy + spring.dissipated", &["spring.energy", "spring.dissipated"], "J"),
        ("spring.torque", &["spring.torque"], "N*m"),
        ("energy.balance + drift.balance", &["energy.balance", "drift.balance"], "1"),
        ("drift.position", &["drift.position"], "SI"),
        ("k*rocker.angle", &["rocker.angle"], "SI"),
        ("ground.A.x", &["ground.A.x"], "m"),
        ("ground.omega", &["ground.omega"], "rad/s"),
        ("t^2", &[], "s^2"),
    ] {
        let found = Measure::read(&m, text).unwrap_or_else(|problem| panic!("{text}: {problem}"));
        assert_eq!(
            (&found.quantities[..], found.unit.as_str()),
            (&quantities.iter().map(ToString::to_string).collect::<Vec<_>>()[..], unit),
            "{text}"
        );
    }
}

#[test]
fn a_measure_evaluates_its_expression() {
    let (m, _) = four_bar();
    let found = Measure::read(&m, "max(C.fx, C.fy)*t + L1").expect("a measure");
    assert_eq!(found.value(&m, 2.0, &[3.0, 5.0]), 20.0);
    assert_eq!(found.value(&m, 2.0, &[7.0, 5.0]), 24.0);
}

#[test]
fn faults_have_their_place() {
    let text = FOUR_BAR.replacen(
        "[start]",
        "[measures]\npin = 'C.force'\nbad = 'pin + C.forse'\n[start]",
        1,
    );
    let (case, document) = read(&text, Format::Toml).expect("the structure is right");
    let m = kempe::build(&case.definition, &[]).expect("the mechanism is right");
    let found = check(&m, &case.definition.measures);
    assert_eq!(found.len(), 1);
    let shown = document.diagnose(&found[0]);
    let line = text.lines().position(|line| line.starts_with("bad")).expect("a line") + 1;
    assert_eq!((shown.line, found[0].path.join(".").as_str()), (line, "measures.bad"));
    assert_eq!(case.faults(&m).len(), 1);
    assert!(
        found[0].hint.as_deref().is_some_and(|hint| hint.contains("cannot use another one")),
        "{:?}",
        found[0]
    );
}

#[test]
fn structure_is_checked() {
    let of = |measure: &str| {
        faults(&format!("[bodies.rod]\nmass = 1\ninertia = 1\n[measures]\n{measure}\n"))
    };
    assert!(of("rod = 'rod.x'").contains("already the name of a body"));
    assert!(of("pin = 3").contains("an expression of quantities"));
    assert!(of("deg = 'rod.x'").contains("reserved"));
    assert!(faults("measures = 3\n").contains("a table of names and expressions"));
    assert!(faults("[measure]\na = 't'\n").contains("unknown key 'measure'"));
}

#[test]
fn a_builder_refuses_a_wrong_measure() {
    let mut m = ModelBuilder::new("block");
    m.body("block").mass(1.0).inertia(1.0);
    m.measure("speed", "hypot(block.vx, block.vy)");
    assert!(m.build().is_ok());
    m.measure("slip", "block.slip");
    let Problems(found) = m.build().expect_err("no such quantity");
    assert_eq!(found[0].path, ["measures", "slip"]);
}
