//! The remedies that messages name: each is applied, and the fault is gone.

use crate::mechanisms::{faults, model, start, tolerances, PENDULUM};
use kempe::analyses::dynamics::{dynamics, Options, Reason};
use kempe::analyses::State;
use kempe::expression::Expression;
use kempe::integrate::Flow;
use kempe::model::Model;

/// The only fault of a text, as the reader or the model reports it.
#[track_caller]
fn only(text: &str) -> String {
    let found = faults(text);
    assert_eq!(found.lines().count(), 1, "{found}");
    found
}

/// The advice of a refused formula.
fn advice(text: &str) -> String {
    let error = Expression::parse(text).map(|e| e.compile(&[""; 0]).err());
    let error = error.unwrap_or_else(Some).unwrap_or_else(|| panic!("{text} is accepted"));
    error.hint.unwrap_or_else(|| panic!("{text}: {}", error.message))
}

/// The words of a hint between the first pair of quotes.
fn quoted(hint: &str) -> &str {
    hint.split('\'').nth(1).unwrap_or_else(|| panic!("nothing is quoted in: {hint}"))
}

#[test]
fn a_unit_that_is_spelt_otherwise() {
    for (text, unit) in [
        ("200 gram", "g"),
        ("200 grams", "g"),
        ("3 kilograms", "kg"),
        ("3 meters", "m"),
        ("4 inches", "in"),
        ("4 feet", "ft"),
        ("5 sec", "s"),
        ("30 degrees", "deg"),
        ("3 kNm", "kN*m"),
        ("5 Nm", "N*m"),
        ("5 Nmm", "N*mm"),
        ("5 Nms", "N*m*s"),
        ("5 Nms/rad", "N*m*s"),
        ("2 kgm2", "kg*m^2"),
        ("2 mm2", "mm^2"),
        ("2 kg m^2", "kg*m^2"),
        ("3 N m", "N*m"),
        ("3 N m s/rad", "N*m*s/rad"),
        ("10 rad/sec", "s"),
        ("3 kgs", "kg"),
        ("3 kn", "kN"),
        ("2 Kg", "kg"),
    ] {
        let hint = advice(text);
        assert_eq!(quoted(&hint), unit, "{text}");
        let number = text.split(' ').next().unwrap();
        assert!(Expression::parse(&format!("{number} {unit}")).is_ok());
    }
}

#[test]
fn a_word_after_a_number_that_is_no_unit() {
    let hint = advice("2 L0");
    assert!(hint.contains("not a unit") && hint.ends_with("write 2*L0"), "{hint}");
    assert!(Expression::parse("2*L0").is_ok());
    assert_eq!(advice("2 pi"), "write '*' to multiply");
}

#[test]
fn a_bar_without_its_ends_is_one_fault() {
    let pin = "[joints.p]\ntype = \"revolute\"\ni = \"ground.O\"\nj = \"rod.C\"\n";
    let case = |bar: &str| {
        let rod = format!("[bodies.rod]\ntype = \"bar\"\nmass = 1\n{bar}\n");
        format!("[bodies.ground]\npoints = {{ O = [0, 0] }}\n{rod}{pin}")
    };
    for bar in [
        "length = 1",
        "length = 1\npoints = { P = [0.1, 0] }",
        "length = 1\nends = [\"A\"]",
        "through = { A = [0, 0] }",
        "length = 1\nends = [\"A\", \"B\"]",
    ] {
        let found = only(&case(bar));
        assert!(!found.contains("NaN"), "{found}");
    }
    assert_eq!(faults(&case("length = 1\nends = [\"A\", \"C\"]")), "");
    let found = only(&case("length = 1\nends = [\"A\", \"C\"]\npoints = { D = [\"K\", 0] }"));
    assert!(found.contains("unknown name 'K'"), "{found}");
    let of_ground =
        case("length = 1\nends = [\"A\", \"C\"]").replace("O = [0, 0]", "O = [\"K\", 0]");
    assert!(only(&of_ground).starts_with("bodies.ground.points.O"));
}

#[test]
fn a_point_where_a_body_must_be() {
    let driver = |coordinate: &str| {
        format!(
            "{PENDULUM}[drivers.d]\ntype = \"coordinate_driver\"\ncoordinate = \"{coordinate}\"\nvalue = \"t\"\n"
        )
    };
    assert_eq!(faults(&driver("rod.P.x")), "", "a point has position quantities");
    let torque = |body: &str| {
        format!("{PENDULUM}[forces.push]\ntype = \"torque\"\nj = \"{body}\"\ntorque = 1\n")
    };
    let found = only(&torque("rod.P"));
    assert_eq!(quoted(found.rsplit("; ").next().unwrap()), "rod");
    assert_eq!(faults(&torque("rod")), "");
    let m = model(PENDULUM);
    let value = kempe::model::Value::from(1.0);
    let given = [("rod.P.x".to_string(), value.clone())];
    assert!(
        kempe::analyses::assemble::targets(&m, "set", &given).is_ok(),
        "a point has them in set too"
    );
    let given = [("rod.x".to_string(), value)];
    assert!(kempe::analyses::assemble::targets(&m, "set", &given).is_ok());
}

fn reason(m: &Model, state: &State, options: &Options) -> Option<Reason> {
    dynamics(m, state, options, |_| Flow::Continue).err().map(|failure| failure.reason)
}

fn cart(mass: &str, inertia: &str) -> Option<String> {
    let m = model(&format!(
        r#"
gravity = [0, -9.81]
[bodies.ground]
points = {{ O = [0, 0] }}
[bodies.cart]
mass = {mass}
inertia = 1
points = {{ P = [0, 0] }}
[bodies.bob]
mass = 1
inertia = {inertia}
points = {{ P = [0, 1] }}
[joints.slide]
type = "translational"
i = "ground.O"
j = "cart.P"
[joints.pin]
type = "revolute"
i = "cart.P"
j = "bob.P"
"#
    ));
    let (state, _) = start(&m, &[("bob.angle", "0.5")], &[]);
    reason(&m, &state, &Options::new(1.0)).map(|reason| reason.to_string())
}

#[test]
fn a_bob_without_inertia_on_a_cart_without_mass() {
    let text = cart("0", "0").expect("no inertia resists the cart when the bob is below it");
    assert!(text.contains("no inertia resists cart.x"), "{text}");
    assert!(text.contains("its joints (slide, pin) leave it a freedom"), "{text}");
    assert!(text.contains("set its mass, or hold it"), "{text}");
    assert!(!text.contains("no joint"), "{text}");
    assert_eq!(cart("1e-2", "0"), None, "with mass");
    assert_eq!(cart("0", "0.01"), None, "with inertia");
    assert_eq!(cart("1e-8", "0"), None, "with hardly any mass");
}

#[test]
fn a_law_that_ends_is_named_with_its_time() {
    let drive = |law: &str| {
        model(&format!(
            "{PENDULUM}[forces.drive]\ntype = \"torque\"\nj = \"rod\"\ntorque = \"{law}\"\n"
        ))
    };
    let options = |t_end| tolerances(t_end, 1e-8, 1e-10);
    let angle = [("rod.angle", "0.5"), ("rod.omega", "1")];
    let fails = |law: &str, t_end: f64| {
        let m = drive(law);
        let (state, _) = start(&m, &angle, &[]);
        reason(&m, &state, &options(t_end)).map(|reason| match reason {
            Reason::Integration { message, hint, .. } => format!("{message}; {hint}"),
            other => other.to_string(),
        })
    };
    let text = fails("sqrt(1-t)", 3.0).unwrap();
    assert!(text.contains("t = 1.000000 s: the law torque of drive has no finite value"), "{text}");
    assert!(text.ends_with("or end the run before"), "{text}");
    assert_eq!(fails("sqrt(1-t)", 0.99), None, "the run ends before");
    assert_eq!(fails("sqrt(max(1-t, 0))", 3.0), None, "the formula has a value");
    let text = fails("ln(rod.angle - 0.4)", 3.0).unwrap();
    assert!(text.contains("the law torque of drive"), "{text}");
    let text = fails("sqrt(2 - rod.omega)*0 + 5", 3.0).unwrap();
    assert!(text.contains("the law torque of drive"), "{text}");
}

#[test]
fn the_field_of_the_law_is_named() {
    let spring = |stiffness: &str, damping: &str| {
        let text = format!(
            "{PENDULUM}[forces.s]\ntype = \"torsion_spring\"\ni = \"ground\"\nj = \"rod\"\nstiffness = \"{stiffness}\"\n\
             damping = \"{damping}\"\nfree_angle = \"t\"\n"
        );
        let m = model(&text);
        let (state, _) = start(&m, &[("rod.angle", "0.1")], &[]);
        reason(&m, &state, &tolerances(1.0, 1e-6, 1e-9)).unwrap().to_string()
    };
    let text = spring("sqrt(0.5-t)", "1");
    assert!(text.contains("t = 0.500000 s") && text.contains("law stiffness of s"), "{text}");
    let text = spring("1", "sqrt(0.5-t)");
    assert!(text.contains("t = 0.500000 s") && text.contains("law damping of s"), "{text}");
    let driver = "[drivers.motor]\ntype = \"coordinate_driver\"\ncoordinate = \"rod.angle\"\nvalue = \"sqrt(0.5 - t)\"\n";
    let m = model(&format!("{PENDULUM}{driver}"));
    let (state, _) = start(&m, &[], &[]);
    let text = reason(&m, &state, &tolerances(1.0, 1e-6, 1e-9)).unwrap().to_string();
    assert!(text.contains("law value of motor"), "{text}");
}

#[test]
fn a_limit_differs_in_print_from_what_exceeds_it() {
    let m = kempe_flagship(1e30);
    let options = Options::classical(15.0);
    let (state, _) = start(&m, &[("crank.angle", "70*deg")], &[]);
    let text = reason(&m, &state, &options).unwrap().to_string();
    let part = text.split("is open by ").nth(1).unwrap_or_else(|| panic!("{text}"));
    let (gap, most) = part.split_once(" m, more than ").unwrap();
    assert_ne!(gap, most.trim_end_matches(" m"), "{text}");
    let m = kempe_flagship(1e6);
    assert_eq!(reason(&m, &state, &Options { t_end: 0.5, ..options }), None, "smaller forces");
}

fn kempe_flagship(stiffness: f64) -> Model {
    crate::mechanisms::with(crate::mechanisms::FOUR_BAR, &[("k", stiffness)])
}
