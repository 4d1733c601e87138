//! Tables of a case: read, written, linked, and refused with their places.

use crate::mechanisms::{close, model, run, start, tolerances};
use kempe::analyses::dynamics::dynamics;
use kempe::case::{self, Format};
use kempe::integrate::Flow;
use kempe::model::build;

const DRIVEN: &str = r#"
[tables.lift]
x = [0, 90, 180, 270, 360]
y = [0, 10, 20, 10, 0]
x_unit = "deg"
y_unit = "mm"
periodic = true
[tables.torque]
x = [0, 0.4, 0.9, 1]
y = [0, 1, 3, 2]
interpolation = "linear"
outside = "hold"
[parameters]
h = "2*lift(90*deg)"
[bodies.ground]
points = { O = [0, 0] }
[bodies.slide]
mass = 2
inertia = 1
points = { P = ["h", 0] }
[joints.guide]
type = "translational"
i = "ground.O"
j = "slide.P"
[drivers.cam]
type = "coordinate_driver"
coordinate = "slide.x"
value = "lift(3*t) - h"
"#;

fn text(change: (&str, &str)) -> String {
    format!("kempe = 1\n{}", DRIVEN.replace(change.0, change.1))
}

/// All problems of a case, each with its line.
fn problems(text: &str) -> Vec<String> {
    let (case, document) = match case::read(text, Format::Toml) {
        Ok(read) => read,
        Err(found) => return found.iter().map(|d| format!("{}: {d}", d.line)).collect(),
    };
    let found = build(&case.definition, &[]).map(|_| ()).unwrap_err();
    found.iter().map(|p| document.diagnose(p)).map(|d| format!("{}: {d}", d.line)).collect()
}

#[track_caller]
fn refused(change: (&str, &str), line: usize, parts: &[&str]) {
    let found = problems(&text(change));
    assert_eq!(found.len(), 1, "{found:?}");
    assert!(found[0].starts_with(&format!("{line}: ")), "{}", found[0]);
    parts.iter().for_each(|part| assert!(found[0].contains(part), "{part} in {}", found[0]));
}

#[test]
fn laws_and_parameters_call_tables() {
    let m = model(DRIVEN);
    close("h", m.parameters[0], 0.02, 1e-15);
    // the periodic cubic spline of these points has the slope 0 at 0 and 180°: y = 0.02 at the top
    let (state, _) = start(&m, &[], &[]);
    close("x", state.q[0], -0.02, 1e-12);
    let run = run(&m, &state, &tolerances(1.0, 1e-9, 1e-12));
    let q = &run.trajectory.q[run.trajectory.q.len() - m.layout.n_q..];
    close("x at 3 rad", q[0], m.blueprint.tables[0].value(3.0) - 0.02, 1e-9);
}

#[test]
fn a_case_with_tables_is_written_as_it_was() {
    let (case, _) = case::read(&text(("", "")), Format::Toml).unwrap();
    for format in [Format::Toml, Format::Json] {
        let again = case::write(&case, format);
        assert_eq!(case::read(&again, format).unwrap().0, case, "{again}");
    }
}

#[test]
fn points_of_a_file_are_supplied_by_the_caller() {
    let in_file = ("x = [0, 90, 180, 270, 360]\ny = [0, 10, 20, 10, 0]\n", "file = \"lift.csv\"\n");
    refused(in_file, 4, &["the points of 'lift.csv' were not read", "write x and y in the case"]);
    let (mut case, _) = case::read(&text(in_file), Format::Toml).unwrap();
    assert!(!case.supply("gift", &[], &[]));
    assert!(case.supply("lift", &[0.0, 90.0, 80.0, 360.0], &[0.0, 1.0, 2.0, 0.0]));
    let found = build(&case.definition, &[]).map(|_| ()).unwrap_err();
    let message = "tables.lift.x.2: x[2] = 80 does not exceed x[1] = 90 (point 3 of lift.csv)";
    assert!(found[0].to_string().starts_with(message), "{}", found[0]);
    assert!(case.supply("lift", &[0.0, 90.0, 180.0, 360.0], &[0.0, 10.0, 20.0, 0.0]));
    assert!(build(&case.definition, &[]).is_ok());
}

#[test]
fn faults_have_their_places() {
    refused(
        ("180, 270", "270, 180"),
        4,
        &["tables.lift.x.3", "does not exceed", "sort the points"],
    );
    refused(
        ("20, 10, 0]", "20, 10]"),
        5,
        &["tables.lift.y: 4 numbers, but x has 5", "one y for each"],
    );
    refused(("20, 10, 0]", "20, 10, 1]"), 5, &["y[4] = 1 is not y[0] = 0", "repeat the first y"]);
    refused(("\"deg\"", "\"degree\""), 6, &["tables.lift.x_unit: unknown unit", "write 'deg'"]);
    refused(
        ("x = [0, 0.4, 0.9, 1]", "x = [0, \"1/2\", 0.9, 1]"),
        10,
        &["must be a number", "h*lift(x)"],
    );
    refused(
        ("x = [0, 90, 180, 270, 360]\n", ""),
        3,
        &["tables.lift.x: missing", "file = \"NAME.csv\""],
    );
    let found = problems(&text(("periodic = true", "file = \"a.csv\"")));
    for (k, field) in ["x", "y"].into_iter().enumerate() {
        let start = format!("{}: tables.lift.{field}: not together with file", 4 + k);
        assert!(found.len() == 2 && found[k].starts_with(&start), "{found:?}");
    }
    refused(
        ("periodic = true", "columns = [\"a\", \"b\"]"),
        8,
        &["there are columns only in a file"],
    );
    refused(
        ("periodic = true", "periodic = true\noutside = \"hold\""),
        9,
        &["a periodic table has no outside"],
    );
    refused(("\"linear\"", "\"lines\""), 12, &["unknown word 'lines'", "did you mean 'linear'"]);
    refused(
        ("outside = \"hold\"", "outsid = \"hold\""),
        13,
        &["unknown field 'outsid'", "'outside'"],
    );
    refused(("tables.torque", "tables.sin"), 9, &["'sin' is already a function", "another name"]);
    refused(("tables.torque", "tables.t"), 9, &["'t' is reserved"]);
    refused(("tables.torque", "tables.\"a b\""), 9, &["letters, digits and '_'"]);
    refused(("tables.torque", "tables.h"), 9, &["already the name of a parameter", "rename"]);
}

#[test]
fn wrong_uses_in_laws_are_refused() {
    let jump = [
        "drivers.cam.value",
        "table 'torque'",
        "velocity jump",
        "interpolation = \"cubic\" in tables.torque",
    ];
    refused(("lift(3*t) - h", "torque(t) - h"), 29, &jump);
    refused(("lift(3*t) - h", "lift(slide.y, t)"), 29, &["lift takes 1 argument, got 2"]);
    refused(("lift(3*t) - h", "lifts(3*t) - h"), 29, &["unknown function 'lifts'", "'lift'"]);
    // a constant of a broken line has no jump
    assert!(problems_of(("lift(3*t) - h", "torque(0.3)*lift(3*t) - h")).is_empty());
    // a force may have a kink
    let force = "[forces.push]\ntype = \"spring_damper\"\ni = \"ground.O\"\nj = \"slide.P\"\nstiffness = \"torque(t)\"\n";
    assert!(problems_of(("[drivers.cam]", &format!("{force}[drivers.cam]"))).is_empty());
    // the unit of the table is not that of the place
    let found = problems(&text(("y_unit = \"mm\"", "y_unit = \"N\"")));
    assert_eq!(found.len(), 2, "of the parameter and of the law: {found:?}");
    assert!(found[1].contains("'lift(3*t) - h' is in N (kg*m*s^-2); must be in m"), "{}", found[1]);
}

fn problems_of(change: (&str, &str)) -> Vec<String> {
    let (case, _) = case::read(&text(change), Format::Toml).unwrap();
    let found = build(&case.definition, &[]).map(|_| ()).err().unwrap_or_default();
    found.iter().map(ToString::to_string).collect()
}

/// The error names law, table, place and range, in a run and at its start.
#[test]
fn a_run_that_leaves_the_table_names_it() {
    let m = model(&DRIVEN.replace("periodic = true\n", ""));
    let (state, _) = start(&m, &[], &[]);
    let failure =
        dynamics(&m, &state, &tolerances(3.0, 1e-8, 1e-10), |_| Flow::Continue).unwrap_err();
    let message = failure.reason.to_string();
    for part in
        ["value of cam", "table 'lift' is read at x = 36", "outside its range from 0 to 360 deg"]
    {
        assert!(message.contains(part), "{part} in {message}");
    }
    let t =
        message.split("t = ").nth(1).unwrap().split(' ').next().unwrap().parse::<f64>().unwrap();
    close("time", t, 2.0 * std::f64::consts::PI / 3.0, 1e-3);
    // the times before are not lost
    assert!(failure.run.trajectory.t.len() > 1);
    let late = DRIVEN.replace("periodic = true\n", "").replace("3*t", "3*t + 7");
    let m = model(&late);
    let fault = kempe::assemble(&m, &kempe::Request::default()).unwrap_err();
    let text = "the law of driver cam has no value at t = 0 s: table 'lift' is read at x = 401.0704566 deg, outside";
    assert!(fault.message.starts_with(text), "{}", fault.message);
    assert!(fault.hint.contains("make it periodic"), "{}", fault.hint);
}
