use super::{value, Model, SCOPE};
use kempe::expression::{is_identifier, is_reserved, Expression, Symbol, FUNCTIONS};
use std::f64::consts::PI;

#[test]
fn numbers() {
    for (text, expected) in [
        ("10", 10.0),
        ("1e-3", 1e-3),
        (".5", 0.5),
        ("2.", 2.0),
        ("1E+2", 100.0),
        ("0.1", 0.1),
        ("1.7976931348623157e308", f64::MAX),
        ("0e-999", 0.0),
    ] {
        assert_eq!(value(text), expected, "{text}");
    }
}

#[test]
fn precedence_and_association() {
    for (text, expected) in [
        ("-2^2", -4.0),
        ("(-2)^2", 4.0),
        ("2^-1", 0.5),
        ("2^3^2", 512.0),
        ("2^-2^2", 0.0625),
        ("8/4/2", 1.0),
        ("8-4-2", 2.0),
        ("2+3*4", 14.0),
        ("(2+3)*4", 20.0),
        ("-2*-3", 6.0),
        ("2--3", 5.0),
        ("+2-+3", -1.0),
        ("--2", 2.0),
        ("12/2*3", 18.0),
        ("-a^2", -4.0),
        ("a^-b", 0.125),
        (" a\n\t+ b ", 5.0),
    ] {
        assert_eq!(value(text), expected, "{text}");
    }
}

#[test]
fn names_and_constants() {
    for (text, expected) in [
        ("pi", PI),
        ("30*deg", 30.0 * (PI / 180.0)),
        ("t", 0.75),
        ("crank.omega - crank.x", 20.0),
        ("`my body`.vx", 40.0),
        ("`crank`.`angle`", 20.0),
        ("`a`+d", 2.25),
    ] {
        assert_eq!(value(text), expected, "{text}");
    }
}

#[test]
fn functions_have_their_usual_values() {
    for (text, expected) in [
        ("sin(pi/2)", 1.0),
        ("cos(0)", 1.0),
        ("tan(0)", 0.0),
        ("asin(1)", PI / 2.0),
        ("acos(-1)", PI),
        ("atan(0)", 0.0),
        ("atan2(1, 0)", PI / 2.0),
        ("atan2(0, -1)", PI),
        ("sinh(0)", 0.0),
        ("cosh(0)", 1.0),
        ("tanh(0)", 0.0),
        ("exp(0)", 1.0),
        ("ln(1)", 0.0),
        ("log10(100)", 2.0),
        ("sqrt(9)", 3.0),
        ("abs(-3)", 3.0),
        ("abs(0)", 0.0),
        ("min(2, -3)", -3.0),
        ("max(2, -3)", 2.0),
        ("max(3, 3)", 3.0),
        ("sign(-7)", -1.0),
        ("sign(0)", 0.0),
        ("sign(7)", 1.0),
        ("step(-1e-300)", 0.0),
        ("step(0)", 1.0),
        ("step(2)", 1.0),
        ("floor(-1.5)", -2.0),
        ("hypot(3, 4)", 5.0),
    ] {
        assert_eq!(value(text), expected, "{text}");
    }
}

#[test]
fn conditions() {
    for (relation, below, equal, above) in
        [("<", 1.0, 2.0, 2.0), ("<=", 1.0, 1.0, 2.0), (">", 2.0, 2.0, 1.0), (">=", 2.0, 1.0, 1.0)]
    {
        for (left, expected) in [("a-1", below), ("a", equal), ("a+1", above)] {
            let text = format!("if({left} {relation} 2, 1, 2)");
            assert_eq!(value(&text), expected, "{text}");
        }
    }
    assert_eq!(value("if((a < b), if(b < a, 1, 2), 3)"), 2.0);
    assert_eq!(value("2 + if(if(a > 0, 1, -1) > 0, 10, 20)*2"), 22.0);
    // the branch that is not taken may be undefined
    assert_eq!(value("if(c < 0, 0, sqrt(c))"), 0.0);
}

#[test]
fn an_undefined_value_is_never_hidden() {
    for text in [
        "sqrt(c)",
        "ln(c)",
        "asin(a)",
        "c^d",
        "max(sqrt(c), 1)",
        "max(1, sqrt(c))",
        "min(sqrt(c), 1)",
        "min(1, sqrt(c))",
        "abs(sqrt(c))",
        "sign(sqrt(c))",
        "step(sqrt(c))",
        "floor(sqrt(c))",
        "if(sqrt(c) < 1, 1, 2)",
        "if(sqrt(c) >= 1, 1, 2)",
    ] {
        assert!(value(text).is_nan(), "{text} = {}", value(text));
    }
}

#[test]
fn a_constant_exponent_serves_negative_bases() {
    assert_eq!(value("c^2"), 2.25);
    assert_eq!(value("c^(1+2)"), -3.375);
    assert_eq!(value("(-8)^3"), -512.0);
}

#[test]
fn constants_are_folded() {
    let tape = |text: &str| Expression::parse(text).unwrap().compile(&Model).unwrap();
    assert_eq!(tape("2*sin(30*deg)^2 + if(1 < 2, 3, 4)").constant(), Some(3.5 - f64::EPSILON));
    assert_eq!(tape("2*a").constant(), None);
    assert_eq!(tape("if(2 > 1, 7, 8)").constant(), Some(7.0));
}

#[test]
fn a_tape_knows_what_it_depends_on() {
    let tape = Expression::parse("b*t + crank.omega - b + a*`my body`.vx").unwrap();
    let tape = tape.compile(&Model).unwrap();
    let (parameter, variable) = (Symbol::Parameter, Symbol::Variable);
    let expected = [parameter(1), Symbol::Time, variable(2), parameter(0), variable(3)];
    assert_eq!(tape.symbols(), expected);
    assert_eq!(tape.parameters().collect::<Vec<_>>(), [1, 0]);
    assert!(tape.uses_time() && tape.uses_state());
    let tape = Expression::parse("a + 1").unwrap().compile(&Model).unwrap();
    assert!(!tape.uses_time() && !tape.uses_state());
    assert_eq!(tape.evaluate(&SCOPE), 3.0);
}

#[test]
fn numbers_become_expressions() {
    for x in [0.0, -0.0, 0.1, -2.5e-7, 1e300, f64::MAX, f64::MIN_POSITIVE, 5e-324] {
        let expression = Expression::number(x).unwrap();
        let again = Expression::parse(expression.text()).unwrap();
        assert_eq!(expression, again);
        let value = again.compile(&Model).unwrap().constant().unwrap();
        assert_eq!(value.to_bits(), x.to_bits());
    }
    assert!(Expression::number(f64::NAN).is_err());
    assert!(Expression::number(f64::INFINITY).is_err());
}

#[test]
fn the_text_is_kept_and_display_is_the_shortest() {
    for (text, short) in [
        (" ( a + b ) * +c ", "(a+b)*c"),
        ("a + (b * c)", "a+b*c"),
        ("a - (b - c)", "a-(b-c)"),
        ("(a^b)^c", "(a^b)^c"),
        ("a^(b^c)", "a^b^c"),
        ("(-a)^2", "(-a)^2"),
        ("-(a^2)", "-a^2"),
        ("-(a*b)", "-(a*b)"),
        ("a^(-b)", "a^-b"),
        ("if ( (a < (b)) , 1.50 , atan2(t, 2) )", "if(a<b,1.50,atan2(t,2))"),
        ("`my body`.vx", "`my body`.vx"),
        (" -5  kN ", "-5  kN"),
    ] {
        let expression = Expression::parse(text).unwrap();
        assert_eq!(expression.text(), text);
        assert_eq!(expression.to_string(), short);
        assert_eq!(Expression::parse(short).unwrap(), expression);
    }
}

#[test]
fn reserved_words_and_identifiers() {
    for word in ["t", "pi", "deg", "ground", "if"] {
        assert!(is_reserved(word), "{word}");
    }
    assert!(FUNCTIONS.iter().all(|function| is_reserved(function.name)));
    assert!(!is_reserved("crank") && !is_reserved("T") && !is_reserved(""));
    for word in ["a", "L1", "_x", "crank_2"] {
        assert!(is_identifier(word), "{word}");
    }
    for word in ["", "1a", "my body", "a.b", "é", "a-b", " a"] {
        assert!(!is_identifier(word), "{word}");
    }
}
