//! A parameter that is written with a unit has a dimension; wherever it is used, the dimension must fit.

use crate::mechanisms::FOUR_BAR;
use kempe::case::{read, Format};
use kempe::model::{build, Problem, Value};

/// A case with parameters that are declared, and some that a formula may use.
fn problems(text: &str, overrides: &[(&str, &str)]) -> Vec<Problem> {
    let (case, _) = read(text, Format::Toml).unwrap_or_else(|faults| panic!("{}", faults[0]));
    let text = |s: &str| Value::Text(s.to_string());
    let given: Vec<(String, Value)> =
        overrides.iter().map(|(name, value)| (name.to_string(), text(value))).collect();
    build(&case.definition, &given).err().unwrap_or_default()
}

fn parameters() -> String {
    "[parameters]\nL = \"800 mm\"\nH = \"0.6 m\"\nM = \"2 kg\"\nF = \"1 kN\"\na = \"30 deg\"\nx = 3\n\
     k = \"2 N*m/rad\"\ng = \"9.81 m/s^2\"\nrho = \"7850 kg/m^3\"\nV = \"12 V\"\n"
        .to_string()
}

/// The problems of one formula in one field of a pendulum.
fn of(field: &str, formula: &str) -> Vec<Problem> {
    let mut text = format!("kempe = 1\n{}", parameters());
    for (key, other) in [("mass", "1"), ("inertia", "1"), ("center", "[0, 0]"), ("points", "")] {
        let value = match (key == field, key) {
            (true, "points") => format!("points = {{ P = [0, \"{formula}\"] }}\n"),
            (true, "center") => format!("center = [\"{formula}\", 0]\n"),
            (true, _) => format!("{key} = \"{formula}\"\n"),
            (false, "points") => String::new(),
            (false, _) => format!("{key} = {other}\n"),
        };
        text += &if key == "mass" { format!("[bodies.bob]\n{value}") } else { value };
    }
    let own = |name: &str| if name == field { format!("\"{formula}\"") } else { "1".to_string() };
    text += &format!(
        "[drivers.lift]\ntype = \"coordinate_driver\"\ncoordinate = \"bob.y\"\nvalue = {}\n",
        own("lift")
    );
    text += &format!(
        "[drivers.turn]\ntype = \"coordinate_driver\"\ncoordinate = \"bob.angle\"\nvalue = {}\n",
        own("turn")
    );
    text += &format!(
        "[forces.s]\ntype = \"torsion_spring\"\ni = \"ground\"\nj = \"bob\"\nstiffness = {}\n",
        own("stiffness")
    );
    text += &format!("[forces.m]\ntype = \"torque\"\nj = \"bob\"\ntorque = {}\n", own("torque"));
    problems(&text, &[])
}

#[test]
fn a_length_is_not_a_mass() {
    let found = of("mass", "L");
    assert_eq!(found.len(), 1, "{found:?}");
    assert_eq!(found[0].path, ["bodies", "bob", "mass"]);
    assert_eq!(found[0].message, "'L' is in m; must be in kg");
}

#[test]
fn formulas_whose_dimension_does_not_fit() {
    for (field, formula, has, must) in [
        ("mass", "2*L", "m", "kg"),
        ("mass", "L^2", "m^2", "kg"),
        ("mass", "M*L/H*L", "kg*m", "kg"),
        ("mass", "a", "rad", "kg"),
        ("mass", "sqrt(L*H)", "m", "kg"),
        ("mass", "max(L, H)", "m", "kg"),
        ("mass", "-abs(L)", "m", "kg"),
        ("mass", "if(L > H, L, H)", "m", "kg"),
        ("mass", "1/L", "m^-1", "kg"),
        ("mass", "7850*L^3", "m^3", "kg"),
        ("inertia", "M*L", "kg*m", "kg*m^2"),
        ("center", "M", "kg", "m"),
        ("points", "a", "rad", "m"),
        ("lift", "a", "rad", "m"),
        ("lift", "30 deg", "rad", "m"),
        ("turn", "L", "m", "rad"),
        ("turn", "800 mm", "m", "rad"),
        ("stiffness", "F", "N (kg*m*s^-2)", "N*m/rad (kg*m^2*s^-2)"),
        ("torque", "M*g", "N (kg*m*s^-2)", "N*m (kg*m^2*s^-2)"),
        ("torque", "V", "V (kg*m^2*s^-3*A^-1)", "N*m (kg*m^2*s^-2)"),
    ] {
        let found = of(field, formula);
        let wanted = format!("'{formula}' is in {has}; must be in {must}");
        assert_eq!(found.first().map(|p| p.message.as_str()), Some(wanted.as_str()), "{formula}");
        assert_eq!(found.len(), 1, "{found:?}");
    }
}

#[test]
fn formulas_that_cannot_be_computed() {
    for (formula, message) in [
        ("L + M", "'L' is in m, but 'M' is in kg"),
        ("M*(L - a)", "'L' is in m, but 'a' is in rad"),
        ("if(L > M, 1, 2)", "'L' is in m, but 'M' is in kg"),
        ("hypot(F, L)", "'F' is in N (kg*m*s^-2), but 'L' is in m"),
        ("sin(L)", "'L' is in m; the argument of a function must be a number or an angle"),
        ("2^M", "'M' is in kg; an exponent must be a number or an angle"),
    ] {
        let found = of("mass", formula);
        assert_eq!(found.first().map(|p| p.message.as_str()), Some(message), "{formula}");
        assert!(found[0].within.is_some() && found[0].hint.is_some());
    }
}

#[test]
fn formulas_that_fit() {
    for (field, formula) in [
        ("mass", "M"),
        ("mass", "x"),   // a plain number is in the SI unit of its place
        ("mass", "x*L"), // so x may be in kg/m
        ("mass", "2*3"),
        ("mass", "2*L/H"), // a ratio is a number
        ("mass", "rho*pi*L^2/4*H"),
        ("mass", "M + 1"),
        ("mass", "M*(1 + 0.1*sin(a))"),
        ("inertia", "M*L^2/12"),
        ("inertia", "M*hypot(L, H)^2"),
        ("center", "L*cos(a)"),
        ("center", "sqrt(L*H) - x"),
        ("points", "L - 0.1"),
        ("lift", "L*sin(a + 3*t)"),
        ("lift", "0.1*sin(t)"),
        ("turn", "a + 2*t"),
        ("turn", "atan2(H, L)"),
        ("stiffness", "k"),
        ("stiffness", "M*g*L"),
        ("torque", "-k*bob.angle - 3*bob.omega"),
        ("torque", "F*L*step(t - 1)"),
    ] {
        assert_eq!(of(field, formula), [], "{formula} in {field}");
    }
}

#[test]
fn parameters_inherit_dimensions_from_parameters() {
    let case = |own: &str| {
        let own = format!("[parameters]\nD = \"2*R\"\nR = \"40 mm\"\n{own}");
        format!("kempe = 1\n{own}[bodies.b]\nmass = \"m\"\ninertia = 1\n")
    };
    let found = problems(&case("m = \"3*D\"\n"), &[]);
    assert_eq!(found[0].message, "'m' is in m; must be in kg");
    let found = problems(&case("m = \"D + W\"\nW = \"1 kg\"\n"), &[]);
    assert_eq!(found[0].path, ["parameters", "m"]);
    assert_eq!(found[0].message, "'D' is in m, but 'W' is in kg");
    assert_eq!(problems(&case("m = \"rho*D^3\"\nrho = \"2700 kg/m^3\"\n"), &[]), []);
}

#[test]
fn another_value_has_its_own_unit() {
    let found = problems(FOUR_BAR, &[("k", "1 kN")]);
    assert_eq!(found.len(), 1, "{found:?}");
    assert_eq!(found[0].path, ["forces", "spring", "stiffness"]);
    let message = "'k' is in N (kg*m*s^-2); must be in N*m/rad (kg*m^2*s^-2)";
    assert_eq!(found[0].message, message);
    for right in ["1 kN*m/rad", "1 kN*mm", "1000", "2*500"] {
        assert_eq!(problems(FOUR_BAR, &[("k", right)]), [], "{right}");
    }
    let found = problems(FOUR_BAR, &[("G", "20 s"), ("L1", "3 kg")]);
    let all: Vec<String> = found.iter().map(|p| p.path.join(".")).collect();
    assert_eq!(all, ["bodies.ground.points.D.0", "bodies.crank.length"]);
}
