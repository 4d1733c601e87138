//! Reading: the flagship as a case, and the syntax of TOML and JSON.

use kempe::analyses::dynamics::{self, Options, Scheme, Stabilization};
use kempe::analyses::options::Member;
use kempe::case::{self, Format};
use kempe::model::{build, Model, Value};

const FOUR_BAR: &str = include_str!("../../../examples/four_bar.toml");

fn text(words: &str) -> Value {
    Value::from(words)
}

#[test]
fn the_flagship_reads_as_it_is_written() {
    let (case, _) = case::read(FOUR_BAR, Format::Toml).expect("the example is right");
    let model = &case.definition;
    assert_eq!(model.title.as_deref(), Some("Four-bar linkage with a rotational spring-damper"));
    assert_eq!(model.gravity, Some(Value::List(vec![0.0.into(), (-9.81).into()])));
    let names = |entries: &[kempe::model::Entry]| {
        entries.iter().map(|e| e.name.clone()).collect::<Vec<_>>().join(" ")
    };
    assert_eq!(names(&model.bodies), "ground crank coupler rocker");
    assert_eq!(names(&model.joints), "A B C D");
    assert_eq!(names(&model.forces), "spring");
    assert_eq!(names(&case.analyses), "release");
    let parameters: Vec<&str> = model.parameters.iter().map(|(name, _)| name.as_str()).collect();
    assert_eq!(parameters, ["L1", "L2", "L3", "G", "k", "c"]);
    assert_eq!(model.bodies[1].get("ends"), Some(&Value::List(vec![text("A"), text("B")])));
    assert_eq!(case.start.set, [("crank.angle".to_string(), text("70*deg"))]);
    let guessed: Vec<&str> = case.start.guess.iter().map(|(key, _)| key.as_str()).collect();
    assert_eq!(guessed, ["coupler.angle", "rocker.angle"]);
    let method = Value::Table(vec![
        ("type".to_string(), text("rk45")),
        ("rtol".to_string(), 1e-6.into()),
        ("atol".to_string(), 1e-9.into()),
    ]);
    assert_eq!(case.analyses[0].get("method"), Some(&method));
}

#[test]
fn dotted_keys_headers_and_quoted_keys_mean_the_same_start() {
    let wanted = [("crank.angle".to_string(), Value::from(1.0))];
    for start in [
        "[start]\nset = { \"crank.angle\" = 1 }",
        "[start]\nset.crank.angle = 1",
        "[start.set]\ncrank.angle = 1",
        "[start.set.crank]\nangle = 1",
        "start.set.'crank.angle' = 1",
    ] {
        let (case, _) = case::read(&format!("kempe = 1\n{start}\n"), Format::Toml)
            .unwrap_or_else(|faults| panic!("{start}: {}", faults[0]));
        assert_eq!(case.start.set, wanted, "{start}");
    }
}

#[test]
fn order_is_that_of_the_file_even_where_a_table_comes_after_its_part() {
    let toml = "kempe = 1\n[bodies.b.points]\nP = [0, 1]\n[bodies.a]\nmass = 1\ninertia = 1\n\
                [bodies.b]\nmass = 2\ninertia = 1\n";
    let (case, _) = case::read(toml, Format::Toml).expect("headers may come in any order");
    let names: Vec<&str> = case.definition.bodies.iter().map(|b| b.name.as_str()).collect();
    assert_eq!(names, ["b", "a"]);
    assert_eq!(case.definition.bodies[0].get("mass"), Some(&Value::Number(2.0)));
}

#[test]
fn line_ends_of_windows_and_a_byte_order_mark_change_nothing() {
    let (plain, _) = case::read(FOUR_BAR, Format::Toml).expect("the example is right");
    let windows = format!("\u{feff}{}", FOUR_BAR.replace('\n', "\r\n"));
    let (read, _) = case::read(&windows, Format::Toml).expect("the same text");
    assert_eq!(read, plain);
}

#[test]
fn numbers_in_all_notations_of_toml() {
    let toml = "a = 0x10\nb = 1_000\nc = 0o17\nd = 0b101\ne = 6.5e-3\nf = -0\ng = 9007199254740992";
    let Ok(Value::Table(table)) = case::parse_tree(toml, Format::Toml) else { panic!("all right") };
    let numbers: Vec<Value> = table.into_iter().map(|(_, v)| v).collect();
    let wanted = [16.0, 1000.0, 15.0, 5.0, 6.5e-3, 0.0, 9_007_199_254_740_992.0];
    assert_eq!(numbers, wanted.map(Value::Number));
}

#[test]
fn escapes_of_json_are_decoded() {
    let json = r#"{ "a\u00e9": "\ud83d\ude00 \"\\\/\b\f\n\r\t", "b": [true, -1.5e2] }"#;
    let wanted = Value::Table(vec![
        ("aé".to_string(), text("😀 \"\\/\u{8}\u{c}\n\r\t")),
        ("b".to_string(), Value::List(vec![Value::Flag(true), (-150.0).into()])),
    ]);
    assert_eq!(case::parse_tree(json, Format::Json), Ok(wanted));
}

#[test]
fn the_start_of_a_state_of_an_element_is_left_to_the_model() {
    let text = |section: &str| {
        format!(
            "kempe = 1\n[start]\nset = {{ 'M.current' = 2 }}\nguess.M.current = 1\n[{section}.M]\n"
        )
    };
    let torque = "type = 'torque'\nj = 'a'\ntorque = 1\n";
    let (case, _) = case::read(&(text("forces") + torque), Format::Toml).expect("M is an element");
    assert_eq!(case.start.set, [("M.current".to_string(), Value::Number(2.0))]);
    assert_eq!(case.start.guess, [("M.current".to_string(), Value::Number(1.0))]);
    let body = text("bodies") + "mass = 1\ninertia = 1\n";
    let faults = case::read(&body, Format::Toml).expect_err("a body has no states");
    assert_eq!(faults.len(), 2);
    assert!(faults[0].message.contains("unknown coordinate 'current'"));
}

fn four_bar() -> Model {
    let (case, _) = case::read(FOUR_BAR, Format::Toml).expect("the example is right");
    build(&case.definition, &[]).expect("the model is right")
}

fn options(fields: &[(&str, Value)]) -> Options {
    let fields: Vec<(String, Value)> =
        fields.iter().map(|(key, value)| (key.to_string(), value.clone())).collect();
    dynamics::read(&four_bar(), &fields, &[]).expect("the options are right")
}

#[test]
fn defaults_of_a_file_are_those_of_the_constructors() {
    let (t_end, chosen) = (("t_end", Value::Number(1.0)), |kind: &str| {
        Value::Table(vec![("type".to_string(), Value::from(kind))])
    });
    assert_eq!(options(std::slice::from_ref(&t_end)), Options::new(1.0));
    for (key, family, default) in [
        ("method", Scheme::family(), "auto"),
        ("stabilization", Stabilization::family(), "projection"),
    ] {
        assert_eq!(family.name, key);
        assert_eq!(family.options[0].table.name, default);
        let read = options(&[t_end.clone(), (key, chosen(default))]);
        assert_eq!(read, Options::new(1.0), "{default}");
    }
    let classical = [t_end, ("method", chosen("rk45")), ("stabilization", chosen("baumgarte"))];
    assert_eq!(options(&classical), Options::classical(1.0));
}
