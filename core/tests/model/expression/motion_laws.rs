//! Motion laws against their accelerations, which are integrated here, and against the peaks of the literature.

use kempe::expression::{Expression, FormulaValues, MotionLaw};
use kempe::math::{Jet, Real};
use std::f64::consts::PI;

const LAWS: [(&str, MotionLaw); 6] = [
    ("cycloidal", MotionLaw::Cycloidal),
    ("harmonic", MotionLaw::Harmonic),
    ("poly345", MotionLaw::Poly345),
    ("poly4567", MotionLaw::Poly4567),
    ("modified_sine", MotionLaw::ModifiedSine),
    ("modified_trapezoid", MotionLaw::ModifiedTrapezoid),
];

/// Value, first and second derivative of a formula in `s`.
fn jet(text: &str, s: f64) -> [f64; 3] {
    let tape = Expression::parse(text).unwrap().compile(&["s"]).unwrap();
    let s = [Jet::new(s, 1.0, 0.0)];
    let found: Jet =
        tape.evaluate(&FormulaValues { parameters: &s, time: Jet::zero(), variables: &[] });
    [found.value, found.rate, found.second]
}

fn close(found: f64, expected: f64, tolerance: f64, what: &str) {
    assert!((found - expected).abs() <= tolerance, "{what}: {found}, expected {expected}");
}

/// The accelerations as the handbook states them, with the peak as the amplitude.
fn acceleration(law: MotionLaw, s: f64) -> f64 {
    let peak_sine = 4.0 * PI * PI / (4.0 + PI);
    let peak_trapezoid = 8.0 * PI / (2.0 + PI);
    match law {
        MotionLaw::Cycloidal => 2.0 * PI * (2.0 * PI * s).sin(),
        MotionLaw::Harmonic => PI * PI / 2.0 * (PI * s).cos(),
        MotionLaw::Poly345 => 60.0 * s - 180.0 * s.powi(2) + 120.0 * s.powi(3),
        MotionLaw::Poly4567 => {
            420.0 * s.powi(2) - 1680.0 * s.powi(3) + 2100.0 * s.powi(4) - 840.0 * s.powi(5)
        }
        MotionLaw::ModifiedSine => match s {
            _ if s < 0.125 => peak_sine * (4.0 * PI * s).sin(),
            _ if s < 0.875 => peak_sine * (4.0 * PI / 3.0 * (s - 0.125)).cos(),
            _ => peak_sine * (4.0 * PI * s).sin(),
        },
        MotionLaw::ModifiedTrapezoid => match s {
            _ if s < 0.125 => peak_trapezoid * (4.0 * PI * s).sin(),
            _ if s < 0.375 => peak_trapezoid,
            _ if s < 0.625 => peak_trapezoid * (4.0 * PI * (s - 0.375)).cos(),
            _ if s < 0.875 => -peak_trapezoid,
            _ => -peak_trapezoid * (4.0 * PI * (s - 0.875)).cos(),
        },
    }
}

/// ∫ f over [a, b] by Gauss's rule of three points on `n` parts.
fn integral(f: impl Fn(f64) -> f64, a: f64, b: f64, n: usize) -> f64 {
    let h = (b - a) / n as f64;
    let part = |k: usize| {
        let middle = a + (k as f64 + 0.5) * h;
        let at = |x: f64, w: f64| w * (f(middle + 0.5 * h * x) + f(middle - 0.5 * h * x));
        0.5 * h * (at(0.6_f64.sqrt(), 5.0 / 9.0) + 8.0 / 9.0 * f(middle))
    };
    (0..n).map(part).sum()
}

#[test]
fn derivatives_are_the_integrals_of_the_acceleration() {
    for (name, law) in LAWS {
        let call = format!("{name}(s)");
        for k in 0..=40 {
            let s = f64::from(k) / 40.0;
            let [value, first, second] = jet(&call, s);
            close(second, acceleration(law, s), 1e-12, &format!("{call}'' at {s}"));
            // the inner joints are at multiples of 1/8
            let parts = (s * 8.0).ceil() as usize;
            let piece = |k: usize| (k as f64 / 8.0, s.min((k + 1) as f64 / 8.0));
            let over = |f: &dyn Fn(f64) -> f64| -> f64 {
                (0..parts).map(|k| integral(f, piece(k).0, piece(k).1, 20)).sum()
            };
            close(first, over(&|x| acceleration(law, x)), 1e-11, &format!("{call}' at {s}"));
            let moment = over(&|x| (s - x) * acceleration(law, x));
            close(value, moment, 1e-11, &format!("{call} at {s}"));
        }
    }
}

/// Peak velocity and acceleration to the digits of the handbook's table.
#[test]
#[allow(clippy::approx_constant)] // digits of a table, two of which are those of π/2 and 2π
fn the_peaks_are_those_of_the_literature() {
    for (name, velocity, acceleration) in [
        ("cycloidal", 2.0, 6.2832),
        ("harmonic", 1.5708, 4.9348),
        ("poly345", 1.875, 5.7735),
        ("poly4567", 2.1875, 7.5132),
        ("modified_sine", 1.7596, 5.5280),
        ("modified_trapezoid", 2.0, 4.8881),
    ] {
        let all: Vec<[f64; 3]> =
            (0..=20_000).map(|k| jet(&format!("{name}(s)"), f64::from(k) / 20_000.0)).collect();
        let peak = |n: usize| all.iter().fold(0.0, |most: f64, jet| most.max(jet[n].abs()));
        close(peak(1), velocity, 5e-5, &format!("velocity of {name}"));
        close(peak(2), acceleration, 5e-5, &format!("acceleration of {name}"));
    }
}

#[test]
fn ends_belong_to_the_rise_and_the_law_is_constant_beyond() {
    for (name, law) in LAWS {
        let call = format!("{name}(s)");
        let end = acceleration(law, 0.0);
        for (s, expected) in [
            (-7.0, [0.0, 0.0, 0.0]),
            (-1e-300, [0.0, 0.0, 0.0]),
            (0.0, [0.0, 0.0, end]),
            (1.0, [1.0, 0.0, -end]),
            (1.0 + 1e-15, [1.0, 0.0, 0.0]),
            (f64::INFINITY, [1.0, 0.0, 0.0]),
        ] {
            let found = jet(&call, s);
            (0..3).for_each(|n| close(found[n], expected[n], 2e-14, &format!("{call} at {s}")));
        }
        assert!(jet(&call, f64::NAN)[0].is_nan());
        // values at the ends have no rounding
        assert_eq!([jet(&call, 0.0)[0], jet(&call, 1.0)[0]], [0.0, 1.0], "{name}");
        close(jet(&call, 0.5)[0], 0.5, 1e-16, name);
    }
}

#[test]
fn pieces_join_with_value_velocity_and_acceleration() {
    for (name, _) in LAWS {
        for s in [0.125, 0.375, 0.625, 0.875] {
            let [before, at, after] =
                [s - 1e-13, s, s + 1e-13].map(|s| jet(&format!("{name}(s)"), s));
            for n in 0..3 {
                close(before[n], at[n], 1e-10, &format!("derivative {n} of {name} at {s}"));
                close(after[n], at[n], 1e-10, &format!("derivative {n} of {name} at {s}"));
            }
        }
    }
}

#[test]
fn step5_rises_between_two_points() {
    let formula = "step5(s, 2, -1, 4, 5)";
    assert_eq!(jet(formula, 1.9)[0], -1.0);
    assert_eq!(jet(formula, 4.1), [5.0, 0.0, 0.0]);
    for s in [2.0, 2.3, 3.0, 3.9, 4.0] {
        let [y, dy, ddy] = jet("poly345(s)", (s - 2.0) / 2.0);
        let expected = [-1.0 + 6.0 * y, 3.0 * dy, 1.5 * ddy];
        let found = jet(formula, s);
        (0..3).for_each(|n| close(found[n], expected[n], 1e-13, &format!("derivative {n} at {s}")));
    }
    // from right to left
    assert_eq!(jet("step5(s, 4, 5, 2, -1)", 2.5)[0], jet(formula, 2.5)[0]);
}

#[test]
fn calls_are_read_printed_and_checked() {
    let text = "2*step5(s,0,0,1,modified_sine(s))";
    assert_eq!(Expression::parse(text).unwrap().to_string(), text);
    let fault = Expression::parse("step5(s, 0, 1)").unwrap_err();
    assert_eq!(fault.to_string(), "step5 takes 5 arguments, got 3; write step5(t, t0, y0, t1, y1)");
    let fault = Expression::parse("cycloidal(s, 1)").unwrap_err();
    assert_eq!(fault.to_string(), "cycloidal takes 1 argument, got 2; write cycloidal(s)");
}
