use kempe::expression::parameters::{ParameterError, Parameters};
use kempe::expression::Expression;
use kempe::math::{Dual, Lanes};

fn definitions(list: &[(&str, &str)]) -> Vec<(String, Expression)> {
    list.iter().map(|(name, text)| (name.to_string(), Expression::parse(text).unwrap())).collect()
}

fn failure(list: &[(&str, &str)]) -> ParameterError {
    Parameters::compile(&definitions(list), &[]).unwrap_err()
}

#[test]
fn definitions_are_evaluated_after_what_they_need() {
    let list = definitions(&[("area", "w*h"), ("w", "2"), ("h", "w + 1"), ("z", "90 deg")]);
    let values: Vec<f64> = Parameters::compile(&list, &[]).unwrap().evaluate(|_| None);
    assert_eq!(values, [6.0, 2.0, 3.0, 90.0 * (std::f64::consts::PI / 180.0)]);
    let none: [(String, Expression); 0] = [];
    assert!(Parameters::compile(&none, &[]).unwrap().evaluate::<f64>(|_| None).is_empty());
}

#[test]
fn what_depends_on_a_given_value_follows_it() {
    let parameters =
        Parameters::compile(&definitions(&[("area", "w*h"), ("w", "2"), ("h", "w + 1")]), &[])
            .unwrap();
    let sweep = parameters.evaluate(|k| (k == 1).then_some(Lanes::new([2.0, 3.0, -1.0, 0.0])));
    assert_eq!(sweep[0], Lanes::new([6.0, 12.0, 0.0, 0.0]));
    let slope = parameters.evaluate(|k| (k == 1).then_some(Dual::<3>::variable(2.0, 0)));
    assert_eq!(slope[0].slope, [5.0, 0.0, 0.0]);
    assert!(parameters.evaluate(|k| (k == 2).then_some(-1.0))[0].is_finite());
}

#[test]
fn circles_are_named() {
    let error = failure(&[("x", "a + 1"), ("a", "2*b"), ("b", "a + c"), ("c", "1")]);
    let message = "parameters refer to each other in a circle: a → b → a";
    assert_eq!((error.parameter, error.name.as_str()), (1, "a"));
    assert_eq!(error.error.message, message);
    assert_eq!(error.error.span, 0..3);
    let error = failure(&[("a", "a")]);
    assert_eq!(error.to_string(), "parameter 'a': the parameter refers to itself: a → a");
}

#[test]
fn names_must_be_fit_for_use() {
    let message = |list| failure(list).error.message;
    assert_eq!(message(&[("t", "1")]), "this name is reserved");
    let function = "this name is reserved: it is a function of formulas; rename the parameter";
    assert_eq!(message(&[("sin", "1")]), function);
    assert_eq!(message(&[("harmonic", "1")]), function);
    assert_eq!(message(&[("a", "1"), ("a", "2")]), "this parameter is defined twice");
    assert!(message(&[("my length", "1")]).contains("letters, digits and '_'"));
}

#[test]
fn definitions_know_parameters_only() {
    let error = failure(&[("length", "1"), ("area", "lenght^2")]);
    assert_eq!(error.parameter, 1);
    assert_eq!(
        error.to_string(),
        "parameter 'area': unknown name 'lenght'; did you mean 'length'?"
    );
    assert_eq!(failure(&[("a", "2*t")]).error.message, "the time t has no meaning here");
    assert_eq!(failure(&[("a", "crank.x")]).error.message, "unknown name 'crank.x'");
}

#[test]
fn a_long_chain_does_not_overflow() {
    let count = 100_000;
    let list: Vec<_> = (0..count)
        .map(|k| {
            let text = if k + 1 < count { format!("p{} + 1", k + 1) } else { "1".to_string() };
            (format!("p{k}"), Expression::parse(&text).unwrap())
        })
        .collect();
    let values: Vec<f64> = Parameters::compile(&list, &[]).unwrap().evaluate(|_| None);
    assert_eq!(values[0], count as f64);
}
