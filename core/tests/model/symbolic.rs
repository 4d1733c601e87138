//! The symbolic scalar: text of expressions, their derivatives, and records.

use kempe::expression::{Expression, FormulaValues};
use kempe::math::{Dual, Jet, Real};
use kempe::symbolic::{record, Form, Name, NameKind, Record, Symbolic};

/// The text of a function of a, b and c.
fn text(f: impl Fn([Symbolic; 3]) -> Symbolic) -> String {
    record(|record| record.write(f(names(record)), Form::Expression))
}

fn names(record: &Record) -> [Symbolic; 3] {
    ["a", "b", "c"].map(|name| record.symbol(Name::field(name)))
}

fn number(x: f64) -> Symbolic {
    Symbolic::constant(x)
}

#[test]
fn neutral_elements_and_double_signs_vanish() {
    assert_eq!(text(|[a, _, _]| a * number(1.0) + number(0.0)), "a");
    assert_eq!(text(|[a, b, _]| -(-a) - (-b)), "a + b");
    assert_eq!(text(|[a, b, _]| b - b + a * number(0.0)), "0");
    assert_eq!(text(|[a, b, _]| -(a - b)), "b - a");
    assert_eq!(text(|[a, _, _]| a / a), "1");
}

#[test]
fn like_terms_and_factors_are_merged() {
    assert_eq!(text(|[a, b, _]| a + b + a), "2*a + b");
    assert_eq!(text(|[a, b, _]| a * b * a / b / b), "a^2/b");
    assert_eq!(text(|[a, _, _]| a * a.sqrt() * a.sqrt()), "a^2");
    assert_eq!(text(|[a, b, _]| (a - b) * (b - a)), "-(a - b)^2");
    assert_eq!(text(|[a, _, _]| a / number(2.0)), "a/2");
    assert_eq!(text(|[a, _, _]| a * number(std::f64::consts::PI / 180.0)), "pi*a/180");
    assert_eq!(text(|[a, _, _]| a * number(0.3)), "0.3*a");
}

#[test]
fn products_of_sines_and_cosines_become_angle_sums() {
    let turn = |[a, b, _]: [Symbolic; 3]| (a.sin_cos(), b.sin_cos());
    assert_eq!(text(|x| turn(x).0 .1 * turn(x).1 .1 - turn(x).0 .0 * turn(x).1 .0), "cos(a + b)");
    assert_eq!(text(|x| turn(x).0 .0 * turn(x).1 .1 - turn(x).0 .1 * turn(x).1 .0), "sin(a - b)");
    assert_eq!(text(|[a, _, c]| c * a.sin() * a.sin() + c * a.cos() * a.cos()), "c");
    assert_eq!(text(|[a, _, _]| number(1.0) - a.sin() * a.sin()), "cos(a)^2");
    assert_eq!(text(|[a, _, _]| (-a).sin() + (-a).cos()), "cos(a) - sin(a)");
    assert_eq!(text(|_| number(std::f64::consts::FRAC_PI_2).cos()), "0");
}

#[test]
fn choices_are_written_as_such() {
    assert_eq!(text(|[a, b, c]| Symbolic::select(a - b, b, c)), "if(a > b, b, c)");
    assert_eq!(text(|[a, b, c]| Symbolic::select(a, b, c) * a), "a*if(a > 0, b, c)");
    assert_eq!(text(|[a, b, _]| Symbolic::select(number(1.0), a, b)), "a");
    assert_eq!(text(|[a, _, _]| a.floor()), "floor(a)");
}

#[test]
fn magnitudes_of_expressions_are_one() {
    record(|record| {
        let [a, _, _] = names(record);
        assert_eq!((a.least_magnitude(), a.largest_magnitude()), (1.0, 1.0));
        assert_eq!(number(-3.0).largest_magnitude(), 3.0);
        assert!(a.is_finite() && !number(f64::NAN).is_finite());
    });
}

#[test]
fn a_record_sees_only_its_own_expressions() {
    let outside = number(2.0) + number(3.0); // no record is under way
    let kept = record(|record| {
        let [a, b, _] = names(record);
        assert_eq!(record.write(a + outside, Form::Expression), "nan");
        let inner = text(|[c, _, _]| c + a);
        assert_eq!(inner, "nan");
        assert_eq!(record.write(a + b, Form::Expression), "a + b");
        a
    });
    assert_eq!(text(|[a, _, _]| a * kept), "nan");
    let broken = std::panic::catch_unwind(|| record(|_| panic!("inside")));
    assert!(broken.is_err());
    assert_eq!(text(|[a, _, _]| a), "a");
}

const LAWS: &[&str] = &[
    "a*b*c - b^3/c + sqrt(a)",
    "sin(a*b + c)*cos(a) + tan(b)",
    "asin(a/9) + acos(b/9) - atan(c*a) + atan2(a, b + c)",
    "sinh(a) - cosh(b)*tanh(c)",
    "exp(a*b)*ln(c) + log10(a)",
    "a^b + b^(-2) + (a + c)^1.5",
    "abs(a - b)*sign(b - c) + step(a - 2)*a + floor(b)*c",
    "min(a, b)*max(b, c) + hypot(a, c)",
    "if(a < b, a^2, b*c) + if(a >= c, b, c^2) - if(c <= a, 1, a)",
];

/// Every function of the language: value, derivatives and second derivative in time.
#[test]
fn derivatives_are_those_of_dual_numbers_and_jets() {
    for law in LAWS {
        let tape = Expression::parse(law).unwrap().compile(&["a", "b", "c"]).unwrap();
        let printed = record(|record| {
            let moving = |name: &str| {
                let symbol = |text: &str, rate| {
                    record.changing(Name::new(text, text, text, NameKind::Coordinate), rate)
                };
                symbol(name, symbol(&format!("{name}_t"), Symbolic::zero()))
            };
            let unknowns = ["a", "b", "c"].map(moving);
            let scope =
                FormulaValues { parameters: &unknowns, time: Symbolic::zero(), variables: &[] };
            let found = record.differentiate(&[tape.evaluate(&scope)], &unknowns);
            let mut all = vec![found.residual[0], found.gamma[0]];
            all.extend(&found.jacobian[0]);
            let parts = record.definitions(&all, Form::Expression);
            let texts = all.into_iter().map(|x| record.write(x, Form::Expression));
            (parts, texts.collect::<Vec<_>>())
        });
        let (parts, printed) = printed;
        for at in [[1.3, 2.7, 0.6], [2.2, 0.9, 1.1], [0.4, 0.5, 2.9]] {
            let speed = [0.7, -1.2, 0.3];
            let mut names = ["a", "b", "c", "a_t", "b_t", "c_t"].map(str::to_string).to_vec();
            let mut values = [at, speed].concat();
            let value = |names: &[String], values: &[f64], text: &str| {
                let tape = Expression::parse(text).unwrap().compile(names).unwrap();
                tape.evaluate(&FormulaValues { parameters: values, time: 0.0, variables: &[] })
            };
            for (name, text) in &parts {
                values.push(value(&names, &values, text));
                names.push(name.clone());
            }
            let found: Vec<f64> = printed.iter().map(|text| value(&names, &values, text)).collect();
            let dual: [Dual<3>; 3] = std::array::from_fn(|k| Dual::variable(at[k], k));
            let jet: [Jet; 3] = std::array::from_fn(|k| Jet::new(at[k], speed[k], 0.0));
            let scope = FormulaValues { parameters: &dual, time: Dual::zero(), variables: &[] };
            let first = tape.evaluate(&scope);
            let scope = FormulaValues { parameters: &jet, time: Jet::zero(), variables: &[] };
            let second = tape.evaluate(&scope).second;
            let expected = [first.value, -second, first.slope[0], first.slope[1], first.slope[2]];
            for (k, (found, expected)) in found.iter().zip(expected).enumerate() {
                let gap = (found - expected).abs();
                assert!(
                    gap <= 1e-12 * (1.0 + expected.abs()),
                    "{law}, {k}: {found} {expected}\n{}",
                    printed[k]
                );
            }
        }
    }
}
