use super::{error, Model};
use kempe::expression::suggest::closest;
use kempe::expression::Expression;

/// The message, the text under the span, and the hint.
#[track_caller]
fn fails(text: &str, message: &str, at: &str, hint: &str) {
    let error = error(text);
    assert_eq!(error.message, message, "{text}");
    assert_eq!(&text[error.span.clone()], at, "{text}: {error:?}");
    assert_eq!(error.hint.as_deref().unwrap_or(""), hint, "{text}");
}

#[test]
fn syntax() {
    fails("", "the expression is empty", "", "");
    fails("  ", "the expression is empty", "", "");
    fails("a)", "unexpected ')'", ")", "");
    fails("(a", "this '(' is never closed", "(", "");
    fails("a + ", "the expression ends too early", "", "");
    fails("a * / b", "unexpected '/'", "/", "");
    fails("a ** b", "unexpected '*'", "*", "a power is written '^'");
    fails("1,5", "unexpected ','", ",", "the decimal mark is a point");
    fails("2 pi", "an operator is missing before 'pi'", "pi", "write '*' to multiply");
    fails("2(a)", "an operator is missing before '('", "(", "write '*' to multiply");
    fails("(a)(b)", "an operator is missing before '('", "(", "write '*' to multiply");
    fails("a b", "an operator is missing before 'b'", "b", "write '*' to multiply");
    fails(".", "unexpected '.'", ".", "");
    fails("1..2", "an operator is missing before '.2'", ".2", "write '*' to multiply");
}

#[test]
fn numbers() {
    let largest = "the largest is about 1.8e308";
    fails("a + 1e999", "1e999 is too large for a number", "1e999", largest);
    let smallest = "the smallest is about 5e-324; write 0 for none";
    fails("-1e-999", "1e-999 is too small for a number", "1e-999", smallest);
    fails("1e", "the exponent of 1e has no digits", "1e", "");
    fails("2*1e+", "the exponent of 1e+ has no digits", "1e+", "");
    fails("-inf", "unknown name 'inf'", "inf", "a number must be finite");
    fails("NaN", "unknown name 'NaN'", "NaN", "a number must be finite");
}

#[test]
fn characters() {
    fails("a − b", "unexpected '−'", "−", "write the minus sign '-'");
    fails("a·b", "unexpected '·'", "·", "write '*' to multiply");
    fails("a²", "unexpected '²'", "²", "write '^2'");
    fails(
        "φ + 1",
        "unexpected 'φ'",
        "φ",
        "names with other characters are written between backticks",
    );
    fails("a\u{7}", "unexpected character U+0007", "\u{7}", "");
    fails("a\u{a0}+ b", "unexpected character U+00A0", "\u{a0}", "");
    fails("a\u{202e}", "unexpected character U+202E", "\u{202e}", "");
    fails("a == b", "unexpected '='", "=", "conditions are <, <=, > and >=");
    fails(
        "`my body.x",
        "the name after this backtick does not end",
        "`",
        "close it with another backtick",
    );
    fails("``.x", "a name cannot be empty", "``", "");
    fails(
        "crank. x",
        "a coordinate must follow 'crank.'",
        "crank.",
        "such as x, y, angle, vx, vy or omega",
    );
}

#[test]
fn names() {
    fails(
        "2*cranck.omega",
        "unknown name 'cranck.omega'",
        "cranck.omega",
        "did you mean 'crank.omega'?",
    );
    fails("A", "unknown name 'A'", "A", "did you mean 'a'?");
    fails("L9", "unknown name 'L9'", "L9", "declare it in the parameters");
    let known = "known are crank.x, crank.angle, crank.omega";
    fails("crank", "unknown name 'crank'", "crank", known);
    fails("crank.velocity", "unknown name 'crank.velocity'", "crank.velocity", known);
    fails("time", "unknown name 'time'", "time", "the time is 't'");
    fails("Pi", "unknown name 'Pi'", "Pi", "did you mean 'pi'?");
    let no_time = Expression::parse("a*t").unwrap().compile(&["a"]).unwrap_err();
    assert_eq!((no_time.message.as_str(), no_time.span), ("the time t has no meaning here", 2..3));
}

#[test]
fn functions() {
    fails("sin(1, 2)", "sin takes 1 argument, got 2", "sin(1, 2)", "write sin(x)");
    fails("a + atan2(1)", "atan2 takes 2 arguments, got 1", "atan2(1)", "write atan2(y, x)");
    fails("sin()", "sin takes 1 argument, got 0", "sin()", "write sin(x)");
    fails("min(1, 2, )", "unexpected ')'", ")", "");
    fails("sin + 1", "sin is a function; its arguments must follow", "sin", "write sin(x)");
    fails("sine(1)", "unknown function 'sine'", "sine", "did you mean 'sin'?");
    fails("arctan2(1, 2)", "unknown function 'arctan2'", "arctan2", "write atan2");
    let log = "write ln for the natural logarithm, log10 for the decimal";
    fails("log(2)", "unknown function 'log'", "log", log);
    fails("L1(2)", "unknown function 'L1'", "L1", "to multiply, write L1*(...)");
}

#[test]
fn conditions() {
    let only = "a comparison is allowed only as the first argument of if";
    let write = "write if(a < b, 1, 0) for its value as a number";
    for text in [
        "a < b",
        "(a < b)*3",
        "3*(a < b)",
        "-(a < b)",
        "2^(a < b)",
        "(a < b)^2",
        "sin(a < b)",
        "if(a < b, a < b, 1)",
        "if((a < b) < 1, 1, 2)",
        "if(1 < (a < b), 1, 2)",
        "if((a < b) + 1, 1, 2)",
    ] {
        let error = error(text);
        assert_eq!((error.message.as_str(), error.hint.as_deref()), (only, Some(write)), "{text}");
    }
    let such = "such as x > 0; conditions are <, <=, > and >=";
    fails("if(a, 1, 2)", "the first argument of if must be a condition", "a", such);
    let chained = "only two numbers can be compared at a time";
    fails("if(a < b < c, 1, 2)", chained, "<", "nest one if inside another");
    fails(
        "if(a < b, 1)",
        "if takes 3 arguments, got 2",
        "if(a < b, 1)",
        "write if(condition, a, b)",
    );
}

#[test]
fn constant_parts_must_be_finite() {
    fails("a + 1/0", "1/0 is not finite", "1/0", "");
    fails("a*sqrt(-4)", "sqrt(-4) is not a real number", "sqrt(-4)", "");
    fails("exp(1000)*a", "exp(1000) is not finite", "exp(1000)", "");
    fails("0^-1", "0^-1 is not finite", "0^-1", "");
}

#[test]
fn units_in_expressions() {
    let alone = "a unit may follow only a number that stands alone";
    fails("30 deg + 1", alone, "deg", "write 30*deg + 1");
    fails("a + 30 deg", alone, "deg", "write a + 30*deg");
    fails("a + 250 mm", alone, "mm", "write a + 250*0.001");
    fails("250 mm + a", alone, "mm", "write 250*0.001 + a");
    fails("(30 deg)", alone, "deg", "write (30*deg)");
    fails("1/2 m", alone, "m", "write 1/2");
    let or = "write '*' to multiply, or (1/2)*0.0254 for the unit";
    fails("(1/2) in", "an operator is missing before 'in'", "in", or);
}

#[test]
fn the_remedy_for_a_unit_in_an_expression_has_the_meant_value() {
    for (text, value) in [
        ("1/2 in", 0.0127),
        ("3/8 in", 0.009525),
        ("2*3 mm", 6e-3),
        ("2^3 mm", 8e-3),
        ("-1/4 kN", -250.0),
        ("1e3/2 um", 5e-4),
        ("3*(1/2 in)", 0.0381),
        ("2 + 1/2 m", 2.5),
        ("90/2 deg", 45f64.to_radians()),
        ("10 mm + 3", 3.01),
    ] {
        let hint = error(text).hint.unwrap();
        let remedy = hint.strip_prefix("write ").unwrap();
        let nothing: &[&str] = &[];
        let tape = Expression::parse(remedy).unwrap().compile(nothing).unwrap();
        let found = tape.constant().unwrap();
        assert!((found - value).abs() <= 1e-15 * value.abs(), "{text}: {remedy} = {found}");
    }
}

#[test]
fn suggestions_are_near_or_absent() {
    assert_eq!(closest("cuopler", ["crank", "coupler"]).as_deref(), Some("coupler"));
    assert_eq!(closest("ROCKER", ["rocker"]).as_deref(), Some("rocker"));
    assert_eq!(closest("x", ["y", "z"]), None);
    assert_eq!(closest("wheel", ["crank", "coupler"]), None);
    assert_eq!(closest("crank", Vec::<String>::new()), None);
}

#[test]
fn an_error_reads_as_a_sentence() {
    let error = Expression::parse("cranck.omega").unwrap().compile(&Model).unwrap_err();
    assert_eq!(error.to_string(), "unknown name 'cranck.omega'; did you mean 'crank.omega'?");
}
