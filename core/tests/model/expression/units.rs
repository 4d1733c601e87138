use super::value;
use kempe::expression::unit::{Dimension, Unit, UNITS};
use kempe::expression::Expression;
use std::f64::consts::PI;

#[test]
fn quantities_are_read_in_si() {
    for (text, si, (m, kg, s)) in [
        ("30 deg", 30.0 * (PI / 180.0), (0, 0, 0)),
        ("30°", 30.0 * (PI / 180.0), (0, 0, 0)),
        ("2 rev", 4.0 * PI, (0, 0, 0)),
        ("250 mm", 0.25, (1, 0, 0)),
        ("0.3 mm", 3e-4, (1, 0, 0)),
        ("12.5mm", 0.0125, (1, 0, 0)),
        ("5 µm", 5e-6, (1, 0, 0)),
        ("1 in", 0.0254, (1, 0, 0)),
        ("1 ft", 0.3048, (1, 0, 0)),
        ("-5 kN", -5000.0, (1, 1, -2)),
        ("+ 5 kN", 5000.0, (1, 1, -2)),
        ("1 lb", 0.45359237, (0, 1, 0)),
        ("1 lbf", 4.4482216152605, (1, 1, -2)),
        ("3 rpm", 3.0 * 2.0 * PI / 60.0, (0, 0, -1)),
        ("60 deg/s", 60.0 * (PI / 180.0), (0, 0, -1)),
        ("1e6 N*m/rad", 1e6, (2, 1, -2)),
        ("1e4 N*m*s/rad", 1e4, (2, 1, -1)),
        ("3 N·mm", 3e-3, (2, 1, -2)),
        ("7 N/mm", 7000.0, (0, 1, -2)),
        ("2 N*s/m", 2.0, (0, 1, -1)),
        ("90 km/h", 25.0, (1, 0, -1)),
        ("9.81 m/s^2", 9.81, (1, 0, -2)),
        ("4 m*s^-2", 4.0, (1, 0, -2)),
        ("9 g*mm^2", 9e-9, (2, 1, 0)),
        ("2.5 kg * m ^ 2", 2.5, (2, 1, 0)),
        ("2 h", 7200.0, (0, 0, 1)),
        ("5 min", 300.0, (0, 0, 1)),
        ("3 kW", 3000.0, (2, 1, -3)),
        ("0 mm", 0.0, (1, 0, 0)),
    ] {
        let expression = Expression::parse(text).unwrap_or_else(|error| panic!("{text}: {error}"));
        assert_eq!(expression.dimension(), Some(Dimension::new(m, kg, s)), "{text}");
        assert_eq!(value(text), si, "{text}");
    }
    assert_eq!(Expression::parse("250").unwrap().dimension(), None);
    assert_eq!(Expression::parse("30*deg").unwrap().dimension(), None);
    assert_eq!(value("30 deg"), value("30*deg"));
}

#[test]
fn powers_of_units_agree_with_each_other() {
    let newton = Unit::parse("kg*m/s^2").unwrap();
    assert_eq!(newton, Unit::parse("N").unwrap());
    assert_eq!(Unit::parse("J").unwrap().dimension, Unit::parse("N*m").unwrap().dimension);
    assert_eq!(Unit::parse("W").unwrap().dimension, Unit::parse("N*m*rad/s").unwrap().dimension);
    assert_eq!(Unit::parse("1/s").unwrap(), Unit::parse("s^-1").unwrap());
    for (electric, same) in [
        ("V*A", "W"),
        ("V", "Ohm*A"),
        ("H", "Ohm*s"),
        ("V/rad*s", "N*m/A"),
        ("mH*kV", "H*V"),
        ("mOhm*kOhm", "Ω^2"),
        ("mV*kV*mA", "V*mA*V"),
    ] {
        let [electric, same] = [electric, same].map(|text| Unit::parse(text).unwrap());
        assert_eq!(electric.dimension, same.dimension);
        assert_eq!(electric.scale(1.0), same.scale(1.0));
    }
    let current = Unit::parse("mA").unwrap();
    assert_eq!((current.scale(5.0), current.dimension.to_string().as_str()), (Some(0.005), "A"));
    assert_eq!(Unit::parse("N/mm").unwrap().scale(1.0), Unit::parse("kN/m").unwrap().scale(1.0));
}

#[test]
fn unit_names_are_unique_and_readable() {
    for (k, (name, unit)) in UNITS.iter().enumerate() {
        assert!(UNITS[..k].iter().all(|(other, _)| other != name), "{name}");
        assert_eq!(Unit::parse(name).as_ref(), Ok(unit));
    }
}

#[test]
fn wrong_units_are_refused() {
    for (text, message, hint) in [
        ("30 degs", "unknown unit 'degs'", "did you mean 'deg'?"),
        ("5 kn", "unknown unit 'kn'", "did you mean 'kN'?"),
        ("2 t", "unknown unit 't'", "t is the time; a tonne is 'tonne'"),
        ("50 Hz", "unknown unit 'Hz'", "write rpm, rev/s or rad/s: Hz does not say which"),
        ("3 m*foo", "unknown unit 'foo'", ""),
        ("3 m/", "a unit is missing here", ""),
        ("3 m^x", "the exponent 'x' of a unit is not a small integer", ""),
        ("3 m^99", "the exponent '99' of a unit is not a small integer", ""),
        ("1e308 km", "the quantity is too large or too small for a number in SI units", ""),
        ("5e-324 mm", "the quantity is too large or too small for a number in SI units", ""),
    ] {
        let error = super::error(text);
        assert_eq!(error.message, message, "{text}");
        assert_eq!(error.hint.as_deref().unwrap_or(""), hint, "{text}");
    }
    let error = super::error(&format!("1 {}m", "m^9*".repeat(20)));
    assert_eq!(error.message, "the exponents of the unit are too large");
    assert!(Unit::parse("").is_err() && Unit::parse("1").is_err() && Unit::parse("*m").is_err());
}

#[test]
fn dimensions_are_written_in_base_units() {
    let written = |unit: &str| Unit::parse(unit).unwrap().dimension.to_string();
    assert_eq!(written("N*m/rad"), "kg*m^2*s^-2");
    assert_eq!(written("deg"), "1");
    assert_eq!(Unit::parse(&written("kN/m")).unwrap().dimension, Dimension::new(0, 1, -2));
}
