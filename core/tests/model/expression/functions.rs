//! Every function on every scalar: derivatives against central differences, lanes against scalars.

use super::Model;
use kempe::expression::{Expression, FormulaValues, Tape, FUNCTIONS};
use kempe::math::{Dual, Jet, Lanes, Real};

/// Texts in `a` and `b`, each with points (a, b) inside its smooth domain.
const CASES: &[(&str, &[(f64, f64)])] = &[
    ("a + b - a*b/3", &[(0.3, 0.7), (-2.0, 5.0)]),
    ("-a/b", &[(0.3, 0.7), (-2.0, 5.0)]),
    ("a^3 - b^-2", &[(0.3, 0.7), (-2.0, -1.5)]),
    ("a^0.5 + b^1", &[(0.3, 0.7), (2.0, -1.5)]),
    ("a^b", &[(0.3, 0.7), (2.0, -1.5)]),
    ("sin(a*b)", &[(0.3, 0.7), (-2.0, 1.5)]),
    ("cos(a + b)", &[(0.3, 0.7), (-2.0, 1.5)]),
    ("tan(a*b)", &[(0.3, 0.7), (-0.5, 1.5)]),
    ("asin(a*b)", &[(0.3, 0.7), (-0.5, 1.5)]),
    ("acos(a*b)", &[(0.3, 0.7), (-0.5, 1.5)]),
    ("atan(a*b)", &[(0.3, 0.7), (-2.0, 1.5)]),
    ("atan2(a, b)", &[(0.3, 0.7), (-2.0, -1.5), (2.0, -1.5)]),
    ("sinh(a*b)", &[(0.3, 0.7), (-2.0, 0.5)]),
    ("cosh(a*b)", &[(0.3, 0.7), (-2.0, 0.5)]),
    ("tanh(a*b)", &[(0.3, 0.7), (-2.0, 0.5)]),
    ("exp(a*b)", &[(0.3, 0.7), (-2.0, 0.5)]),
    ("ln(a*b)", &[(0.3, 0.7), (2.0, 0.5)]),
    ("log10(a + b)", &[(0.3, 0.7), (200.0, 0.5)]),
    ("sqrt(a + b)", &[(0.3, 0.7), (200.0, 0.5)]),
    ("abs(a*b)", &[(0.3, 0.7), (-2.0, 0.5)]),
    ("min(a^2, b)", &[(0.3, 0.7), (-2.0, 0.5)]),
    ("max(a^2, b)", &[(0.3, 0.7), (-2.0, 0.5)]),
    ("a*sign(b)", &[(0.3, 0.7), (-2.0, -0.5)]),
    ("b^2*step(a)", &[(0.3, 0.7), (-2.0, -0.5)]),
    ("b^2 + floor(a)", &[(0.3, 0.7), (-2.4, -0.5)]),
    ("hypot(a, b)", &[(0.3, 0.7), (-2.4, -0.5)]),
    ("if(a < b, a^2, b^2)", &[(0.3, 0.7), (2.4, -0.5)]),
    ("cycloidal(a*b)", &[(0.3, 0.7), (-2.0, 0.5), (2.0, 3.0)]),
    ("b*harmonic(a)", &[(0.3, 0.7), (-2.0, 0.5), (2.0, 3.0)]),
    ("b*poly345(a)", &[(0.3, 0.7), (-2.0, 0.5), (2.0, 3.0)]),
    ("b*poly4567(a)", &[(0.3, 0.7), (-2.0, 0.5), (2.0, 3.0)]),
    ("b*modified_sine(a)", &[(0.1, 0.7), (0.3, 0.7), (0.9, 0.5), (-2.0, 0.5), (2.0, 3.0)]),
    (
        "b*modified_trapezoid(a)",
        &[(0.1, 0.7), (0.3, 0.7), (0.4, 0.7), (0.7, 0.7), (0.9, 0.5), (-2.0, 0.5), (2.0, 3.0)],
    ),
    ("step5(a, 0.1, b, 0.6, 3*b)", &[(0.3, 0.7), (-2.0, 0.5), (2.0, 3.0)]),
    ("step5(0.4, a, b^2, b, 3*a)", &[(0.3, 0.7), (0.6, 0.1)]),
    ("if(a >= b, a*b, b^3)", &[(0.3, 0.7), (2.4, -0.5)]),
];

fn tape(text: &str) -> Tape {
    Expression::parse(text).unwrap().compile(&Model).unwrap()
}

fn at<S: Real>(tape: &Tape, a: S, b: S) -> S {
    tape.evaluate(&FormulaValues { parameters: &[a, b], time: S::zero(), variables: &[] })
}

fn assert_close(text: &str, what: &str, found: f64, expected: f64, tolerance: f64) {
    let error = (found - expected).abs() / expected.abs().max(1.0);
    assert!(error <= tolerance, "{text}: {what} is {found}, expected {expected}");
}

#[test]
fn every_function_has_a_case() {
    for function in FUNCTIONS {
        let call = format!("{}(", function.name);
        assert!(CASES.iter().any(|(text, _)| text.contains(&call)), "{}", function.name);
    }
}

#[test]
fn duals_match_central_differences() {
    let h = 1e-5;
    for (text, points) in CASES {
        let tape = tape(text);
        for &(a, b) in *points {
            let by_a = at(&tape, Dual::<3>::variable(a, 0), Dual::constant(b));
            let by_b = at(&tape, Dual::<3>::constant(a), Dual::variable(b, 0));
            let slope_a = (at(&tape, a + h, b) - at(&tape, a - h, b)) / (2.0 * h);
            let slope_b = (at(&tape, a, b + h) - at(&tape, a, b - h)) / (2.0 * h);
            assert_close(text, "value", by_a.value, at(&tape, a, b), 1e-14);
            assert_close(text, "slope by a", by_a.slope[0], slope_a, 1e-8);
            assert_close(text, "slope by b", by_b.slope[0], slope_b, 1e-8);
        }
    }
}

#[test]
fn jets_match_central_differences() {
    // along the path a(τ) = a + 0.7 τ + 0.3 τ², b(τ) = b - 0.4 τ + 0.2 τ²
    let h = 1e-4;
    for (text, points) in CASES {
        let tape = tape(text);
        for &(a, b) in *points {
            let jet = at(&tape, Jet::new(a, 0.7, 0.6), Jet::new(b, -0.4, 0.4));
            let path = |s: f64| at(&tape, a + 0.7 * s + 0.3 * s * s, b - 0.4 * s + 0.2 * s * s);
            let (before, here, after) = (path(-h), path(0.0), path(h));
            assert_close(text, "value", jet.value, here, 1e-14);
            assert_close(text, "rate", jet.rate, (after - before) / (2.0 * h), 1e-6);
            let second = (after - here - here + before) / (h * h);
            assert_close(text, "second derivative", jet.second, second, 1e-6);
        }
    }
}

#[test]
fn lanes_match_scalars() {
    for (text, points) in CASES {
        let tape = tape(text);
        let point = |k: usize| points[k % points.len()];
        let a = Lanes::new(std::array::from_fn(|k| point(k).0));
        let b = Lanes::new(std::array::from_fn(|k| point(k).1));
        let lanes = at(&tape, a, b).to_array();
        for (k, lane) in lanes.into_iter().enumerate() {
            assert_eq!(lane.to_bits(), at(&tape, point(k).0, point(k).1).to_bits(), "{text}");
        }
    }
}

#[test]
fn scalars_nest() {
    let tape = tape("if(a < b, a^2*b, sin(a))");
    let a = Lanes::new([0.5, 2.0, -1.0, 3.0]);
    let b = Lanes::new([1.0, 1.0, 1.0, 4.0]);
    let nested = at(
        &tape,
        Dual::<3, _>::variable(a, 0),
        Dual::constant(1.0) + Dual { value: b - Lanes::one(), slope: [Lanes::zero(); 3] },
    );
    let ([a, b], [value, slope]) =
        ([a, b].map(Lanes::to_array), [nested.value, nested.slope[0]].map(Lanes::to_array));
    for k in 0..4 {
        let plain = at(&tape, Dual::<3>::variable(a[k], 0), Dual::constant(b[k]));
        assert_eq!((value[k], slope[k]), (plain.value, plain.slope[0]));
    }
}

#[test]
fn kinks_have_symmetric_derivatives() {
    let slope = |text, a, b| at(&tape(text), Dual::<3>::variable(a, 0), Dual::constant(b)).slope[0];
    assert_eq!(slope("abs(a)", 0.0, 0.0), 0.0);
    assert_eq!(slope("max(a, b)", 1.0, 1.0), 0.5);
    assert_eq!(slope("min(a, b)", 1.0, 1.0), 0.5);
    assert_eq!(slope("sign(a)", 0.0, 0.0), 0.0);
    assert_eq!(slope("step(a)", 0.0, 0.0), 0.0);
}

#[test]
fn a_tie_of_infinities_is_that_infinity() {
    let infinity = f64::INFINITY;
    assert_eq!(at(&tape("max(a, b)"), infinity, infinity), infinity);
    assert_eq!(at(&tape("min(a, b)"), infinity, 1.0), 1.0);
    assert_eq!(at(&tape("abs(a)"), -infinity, 0.0), infinity);
}
