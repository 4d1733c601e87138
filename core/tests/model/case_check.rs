//! The check of a case finds what is known without a run, each with its place in the text.

use kempe::case::{read, Format};
use kempe::model::build;

const FOUR_BAR: &str = include_str!("../../../examples/four_bar.toml");

/// Line, path and message of every fault of start and analyses.
fn faults(text: &str) -> Vec<(usize, String, String)> {
    let (case, document) = read(text, Format::Toml).unwrap_or_else(|found| panic!("{}", found[0]));
    let model = build(&case.definition, &[]).unwrap_or_else(|found| panic!("{}", found[0]));
    let found = case.faults(&model);
    let places = found.iter().map(|problem| document.diagnose(problem));
    places.map(|d| (d.line, d.path.join("."), d.message)).collect()
}

/// The flagship with other analyses.
fn with(analyses: &str) -> String {
    let model = FOUR_BAR.split("[analyses.release]").next().unwrap();
    format!("{model}{analyses}")
}

fn analysis(fields: &str) -> String {
    with(&format!("[analyses.a]\ntype = \"dynamics\"\nt_end = 2\n{fields}\n"))
}

#[test]
fn nothing_of_sound_cases() {
    assert_eq!(faults(FOUR_BAR), []);
    for fields in [
        "",
        "method = { type = \"radau\" }",
        "method = { type = \"radau\" }\nstabilization = { type = \"none\" }",
        "stabilization = { type = \"baumgarte\" }\nmethod = { type = \"rk45\" }",
        "method = { type = \"rk4\", step = 0.001 }",
        "method = { type = \"rk45\", first_step = 2 }",
        "output_step = 2e-6",
        "output_step = 1000",
    ] {
        assert_eq!(faults(&analysis(fields)), [], "{fields}");
    }
}

#[test]
fn options_that_no_run_can_have() {
    let line = with("").lines().count() + 4;
    for (fields, path, message) in [
        (
            "stabilization = { type = \"baumgarte\" }",
            "stabilization",
            "Baumgarte's changes the right side of explicit methods",
        ),
        (
            "stabilization = { type = \"baumgarte\" }\nmethod = { type = \"radau\" }",
            "stabilization",
            "Baumgarte's changes the right side of explicit methods",
        ),
        (
            "stabilization = { type = \"baumgarte\", gains = \"step\" }\nmethod = { type = \"hht\" }",
            "stabilization",
            "Baumgarte's changes the right side of explicit methods",
        ),
        ("output_step = 1e-7", "output_step", "must be at least 1e-6 of the time"),
        ("method = { type = \"rk45\", first_step = 3 }", "method.first_step", "at most |t_end - t0|"),
        ("method = { type = \"rk4\", step = 1e-12 }", "method.step", "more than max_steps = 333333"),
        ("method = { type = \"dop853\", step = 1e-9 }", "method.step", "more than max_steps"),
        ("method = { type = \"radau\", max_step = 1e-9 }", "method.max_step", "more than max_steps"),
        ("method = { type = \"rk4\", step = 0.1 }\nmax_steps = 10", "method.step", "20 steps of 1e-1 s"),
    ] {
        let found = faults(&analysis(fields));
        assert_eq!(found.len(), 1, "{fields}: {found:?}");
        assert_eq!(found[0].0, line, "{fields}: {found:?}");
        assert_eq!(found[0].1, format!("analyses.a.{path}"));
        assert!(found[0].2.contains(message), "{found:?}");
        assert!(!found[0].2.starts_with("stabilization:"), "the path is not repeated");
    }
}

#[test]
fn the_times_of_analyses_follow_each_other() {
    let second = |fields: &str| {
        with(&format!(
            "[analyses.a]\ntype = \"dynamics\"\nt_end = 2\n[analyses.b]\ntype = \"dynamics\"\nt_end = 3\n{fields}\n"
        ))
    };
    let method = "method = { type = \"rk45\", first_step = 1.5 }";
    let found = faults(&second(method));
    assert_eq!(found.len(), 1, "from 2 s to 3 s: {found:?}");
    assert_eq!(found[0].1, "analyses.b.method.first_step");
    assert_eq!(faults(&second(&format!("{method}\nfrom = \"start\""))), [], "from 0 s to 3 s");
    assert_eq!(faults(&second(&format!("{method}\nt_start = 1"))), [], "from 1 s to 3 s");
    let found = faults(&second(&format!("{method}\nfrom = \"a\"")));
    assert_eq!(found.len(), 1, "from 2 s to 3 s: {found:?}");
}

#[test]
fn all_faults_of_start_and_analyses_come_at_once() {
    let text = with(
        "[analyses.a]\ntype = \"dynamics\"\nt_end = \"2 m\"\n[analyses.b]\ntype = \"dynamics\"\nt_end = 3\n\
         stabilization = { type = \"baumgarte\" }\nmethod = { type = \"radau\" }\n",
    );
    let text =
        text.replace("\"crank.angle\" = \"70*deg\"", "\"crank.angle\" = \"L1\", \"crnk.x\" = 1");
    let text = text.replace("L1 = 10", "L1 = \"10 m\"");
    let paths: Vec<String> = faults(&text).into_iter().map(|(_, path, _)| path).collect();
    let wanted = [
        "start.set.crank.angle",
        "start.set.crnk.x",
        "analyses.a.t_end",
        "analyses.b.stabilization",
    ];
    assert_eq!(paths, wanted);
}
