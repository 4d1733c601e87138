//! Runs of a session, and kinematics over a quantity.

mod page;

use page::{example, number, Page, PENDULUM};
use serde_json::{json, Value};
use std::f64::consts::PI;

#[test]
fn the_reaction_of_the_four_bar_at_the_start_is_that_of_its_reference() {
    let text = example("four_bar");
    let reference = include_str!("../../../tests/reference/four_bar.json");
    let reference: Value = serde_json::from_str(reference).expect("JSON");
    let mut page = Page::of(&text);
    let expected = reference["start"]["q"].as_array().expect("coordinates");
    let pose = page.ask(json!({ "do": "pose" }));
    for (found, expected) in pose["q"].as_array().expect("q").iter().zip(expected) {
        assert!((number(found) - number(expected)).abs() < 1e-9, "{found} {expected}");
    }
    let force = page.quantity("C.force");
    assert!((force - 24_932.0).abs() < 1.0, "{force}");
    let torque = page.quantity("spring.torque");
    let angle = page.quantity("rocker.angle");
    assert!((torque - 1e6 * (1.5 * PI - angle)).abs() < 1e-6, "{torque}");
}

#[test]
fn a_run_gives_frames_and_values() {
    let mut page = Page::of(PENDULUM);
    let ran = page.ask(json!({ "do": "run", "analysis": "swing" }));
    assert_eq!((number(&ran["count"]), &ran["status"]), (101.0, &json!("reached")));
    let frames = page.ask(json!({ "do": "frames" }));
    assert_eq!(number(&frames["numbers"]), 101.0 * 4.0);
    let frames = page.0.numbers().to_vec();
    let names = json!(["bar.angle", "bar.omega", "A.force", "energy.total", "bar.B.y"]);
    let found = page.ask(json!({ "do": "values", "names": names }));
    assert_eq!(found["units"], json!(["rad", "rad/s", "N", "J", "m"]));
    let values = page.0.numbers().to_vec();
    let row = |k: usize| &values[101 * k..101 * (k + 1)];
    let first = row(3)[0];
    for k in 0..101 {
        let (angle, omega) = (row(0)[k], row(1)[k]);
        assert_eq!([frames[4 * k], frames[4 * k + 3]], [0.01 * k as f64, angle].map(|x| x));
        // conservation of energy: ω² = 3 g (-sin angle) / L
        let expected = 3.0 * 9.81 * -angle.sin();
        assert!((omega * omega - expected).abs() < 1e-5, "{omega} {expected}");
        assert!((row(3)[k] - first).abs() < 1e-6);
        assert!((row(4)[k] - angle.sin()).abs() < 1e-12);
        // along the bar m (g sin + ω² L/2), across it m g cos / 4
        let along = 2.0 * (9.81 * angle.sin() - 0.5 * omega * omega);
        let across = 2.0 * 9.81 * angle.cos() / 4.0;
        assert!((row(2)[k] - along.hypot(across)).abs() < 1e-5, "{} at {k}", row(2)[k]);
    }
    let message = page.fault(json!({ "do": "values", "names": ["bar.angel"] }));
    assert!(message.contains("bar.angel"), "{message}");
}

#[test]
fn a_run_names_the_joints_without_a_unique_reaction() {
    let ends = "F = { type = 'revolute', i = 'ground.F', j = 'bar.F' }\n";
    let text = |more: &str, joint: &str| {
        format!(
            "kempe = 1\n{more}gravity = [0, -9.81]\n[bodies]\n\
             ground = {{ points = {{ A = [0, 0], F = [1, 0] }} }}\n\
             bar = {{ mass = 1, inertia = 1, points = {{ A = [0, 0], F = [1, 0] }} }}\n\
             [joints]\nA = {{ type = 'revolute', i = 'ground.A', j = 'bar.A' }}\n{joint}\
             [start]\nset = {{ 'bar.angle' = 0 }}\n"
        )
    };
    let mut page = Page::of(&text("redundancy = 'allow'\n", ends));
    let ran = page.ask(json!({ "do": "run", "t_end": 1.0 }));
    assert_eq!(ran["not_unique"], json!(["A", "F"]));
    let mut page = Page::of(&text("redundancy = 'allow'\n", ""));
    let ran = page.ask(json!({ "do": "run", "t_end": 1.0 }));
    assert_eq!(ran["not_unique"], json!([]));
}

/// The slider-crank with kinematics over a value, and perhaps a driver of the crank.
fn slider_crank_over(over: &str, range: &str, driver: &str) -> Page {
    let more = format!(
        "{driver}\n[analyses.cycle]\ntype = \"kinematics\"\nfrom = \"start\"\nover = \"{over}\"\nrange = {range}\nn = 91\n"
    );
    let text = example("slider_crank").replace(", \"crank.omega\" = 30", "");
    Page::of(&(text + &more))
}

/// Values of a run, a list for each quantity.
fn values(page: &mut Page, names: &[&str]) -> Vec<Vec<f64>> {
    page.ask(json!({ "do": "values", "names": names }));
    let numbers = page.0.numbers();
    numbers.chunks(numbers.len() / names.len()).map(<[f64]>::to_vec).collect()
}

/// A quantity in the place of a driver: the run has no quantities of this driver.
#[test]
fn the_quantities_of_a_run_can_be_read() {
    let law = "[drivers.turn]\ntype = \"coordinate_driver\"\ncoordinate = \"crank.angle\"\nvalue = \"60*deg + 5*t\"";
    let mut page = slider_crank_over("slider.x", "[0.25, 0.35]", law);
    page.ask(json!({ "do": "run", "analysis": "cycle" }));
    let mut names = |request: Value| -> Vec<String> {
        let found = page.ask(request);
        let all = found.as_array().expect("quantities");
        all.iter().map(|one| one["name"].as_str().expect("a name").to_string()).collect()
    };
    let all = names(json!({ "do": "quantities" }));
    let found = names(json!({ "do": "quantities", "of_run": true }));
    assert!(all.iter().any(|name| name.starts_with("turn.")), "{all:?}");
    assert!(!found.iter().any(|name| name.starts_with("turn.")), "{found:?}");
    assert!(found.contains(&"slider.x".to_string()));
    page.ask(json!({ "do": "values", "names": found }));
}

#[test]
fn kinematics_over_the_crank_angle_is_that_of_the_closed_form() {
    let law = "[drivers.turn]\ntype = \"coordinate_driver\"\ncoordinate = \"crank.angle\"\nvalue = \"60*deg + 5*t\"";
    for (over, driver) in [("crank.angle", ""), ("crank.angle", law), ("turn", law)] {
        let mut page = slider_crank_over(over, "[0, \"360*deg\"]", driver);
        let ran = page.ask(json!({ "do": "run", "analysis": "cycle" }));
        assert_eq!((number(&ran["count"]), &ran["status"]), (91.0, &json!("reached")), "{ran}");
        let condition = "with inertia and damping at 1 rad/s";
        let over = json!({ "name": "crank.angle", "unit": "rad", "condition": condition });
        assert_eq!(ran["over"], over);
        let names = ["crank.angle", "slider.x", "slider.vx", "slider.ax"];
        let units = &page.ask(json!({ "do": "values", "names": names }))["units"];
        assert_eq!(units, &json!(["rad", "m", "m/rad", "m/rad^2"]));
        let all = page.ask(json!({ "do": "quantities", "of_run": true }));
        assert!(all
            .as_array()
            .expect("a list")
            .contains(&json!({ "name": "crank.omega", "unit": "rad/rad" })));
        let found = values(&mut page, &names);
        page.ask(json!({ "do": "frames" }));
        let frames = page.0.numbers().to_vec();
        for k in 0..91 {
            let angle = (4.0 * k as f64).to_radians();
            let ((s, c), r) = (angle.sin_cos(), 0.1);
            let root = (0.09 - r * r * s * s).sqrt();
            // x, and its first and second derivative by the angle
            let rate = -r * s - r * r * s * c / root;
            let second =
                -r * c - r * r * ((c * c - s * s) / root + (r * s * c).powi(2) / root.powi(3));
            let expected = [angle, r * c + root, rate, second];
            assert!((frames[k * frames.len() / 91] - angle).abs() < 1e-12);
            for (row, expected) in found.iter().zip(expected) {
                assert!((row[k] - expected).abs() < 1e-9, "{over}: {} {expected} at {k}", row[k]);
            }
        }
    }
}

#[test]
fn another_quantity_replaces_the_only_driver() {
    let law = "[drivers.turn]\ntype = \"coordinate_driver\"\ncoordinate = \"crank.angle\"\nvalue = \"60*deg + 5*t\"";
    let mut page = slider_crank_over("slider.x", "[0.3, 0.25]", law);
    page.ask(json!({ "do": "run", "analysis": "cycle" }));
    let found = values(&mut page, &["slider.x", "crank.angle"]);
    for (x, angle) in found[0].iter().zip(&found[1]) {
        // law of cosines
        let expected = ((x * x + 0.01 - 0.09) / (2.0 * x * 0.1)).acos();
        assert!((angle - expected).abs() < 1e-9, "{angle} {expected}");
    }
    assert!((found[0][90] - 0.25).abs() < 1e-12);
    let beyond = page.ask(json!({ "do": "load", "text": example("slider_crank") + "\n[analyses.far]\ntype = \"kinematics\"\nfrom = \"start\"\nover = \"slider.x\"\nrange = [0.3, 0.5]\n" }));
    assert_eq!(beyond["problems"], json!([]));
    let ran = page.ask(json!({ "do": "run", "analysis": "far" }));
    assert_eq!(ran["status"], "failed");
    let message = ran["error"]["message"].as_str().expect("a text");
    assert!(message.contains("0.4 m: dead point, crank and rod in line"), "{message}");
}

#[test]
fn other_drivers_stay_where_they_are() {
    let second = PENDULUM
        .replace("[start]\nset = { \"bar.angle\" = 0 }\n", "")
        .replace("[analyses.swing]\ntype = \"dynamics\"\nt_end = 1\noutput_step = 0.01\n", "")
        .replace("[joints.A]", "[bodies.other]\ntype = \"bar\"\nmass = 1\nlength = 1\nends = [\"A\", \"B\"]\n[joints.O]\ntype = \"revolute\"\ni = \"ground.A\"\nj = \"other.A\"\n[joints.A]");
    let more = r#"
[drivers.first]
type = "coordinate_driver"
coordinate = "bar.angle"
value = "t"
[drivers.second]
type = "coordinate_driver"
coordinate = "other.angle"
value = "0.2 + 3*t + cos(2*t)"
[analyses.before]
type = "kinematics"
t_end = 4
[analyses.cycle]
type = "kinematics"
over = "first"
range = [1, 2]
n = 3
"#;
    let mut page = Page::of(&(second + more));
    page.ask(json!({ "do": "run", "analysis": "cycle" }));
    let found = values(&mut page, &["bar.angle", "other.angle", "other.omega"]);
    for (k, angle) in [1.0, 1.5, 2.0].into_iter().enumerate() {
        assert!((found[0][k] - angle).abs() < 1e-12);
        assert!(
            (found[1][k] - 12.2 - 8_f64.cos()).abs() < 1e-12 && found[2][k] == 0.0,
            "{found:?}"
        );
    }
    let both = "over = \"bar.B.x\"";
    let text = page.ask(json!({ "do": "save", "format": "toml" }))["text"].clone();
    let text = text.as_str().expect("a text").replace("over = \"first\"", both);
    let mut page = Page::of(&text);
    let message = page.fault(json!({ "do": "run", "analysis": "cycle" }));
    assert!(
        message.contains("the drivers first, second determine the motion already"),
        "{message}"
    );
}

#[test]
fn a_run_over_a_quantity_needs_no_analysis_of_the_case() {
    let mut page = Page::of(&example("slider_crank"));
    let request = |range: Value| json!({ "do": "run", "over": "crank.angle", "range": range });
    let ran = page.ask(request(json!(["90*deg", "(-30)*deg"])));
    assert_eq!((number(&ran["count"]), &ran["status"]), (361.0, &json!("reached")), "{ran}");
    assert!((number(&ran["t_end"]) + PI / 6.0).abs() < 1e-12, "{ran}");
    let names = ["transmission angle at B", "slider.x", "2*slider.x + abs(rod.B.y - 0.1)"];
    let found = page.ask(json!({ "do": "values", "names": names }));
    assert_eq!(found["units"][0], "rad");
    let found = values(&mut page, &names);
    for k in 0..361 {
        let angle = (90.0 - k as f64 / 3.0).to_radians();
        let x = 0.1 * angle.cos() + (0.09 - (0.1 * angle.sin()).powi(2)).sqrt();
        // between the rod and the normal of the slide
        let expected = [(angle.sin() / 3.0).acos(), x, 2.0 * x + 0.1];
        for (row, expected) in found.iter().zip(expected) {
            assert!((row[k] - expected).abs() < 1e-9, "{} {expected} at {k}", row[k]);
        }
    }
    let message = page.fault(request(json!(["0"])));
    assert!(message.contains("range"), "{message}");
}

/// A beam of 2 kg on feet with abscissas, m, and its centre at 0.
fn beam_on_feet(feet: &[f64]) -> String {
    let names = || (0..feet.len()).map(|k| format!("P{k}"));
    let points: Vec<String> =
        names().zip(feet).map(|(name, x)| format!("{name} = [{x}, 0]")).collect();
    let contacts: String = names()
        .map(|name| {
            format!(
                "[forces.foot_{name}]\ntype = \"contact\"\ni = \"beam.{name}\"\ncurve = \"ground.floor\"\nrestitution = 0\n"
            )
        })
        .collect();
    format!(
        "kempe = 1\ngravity = [0, -9.81]\n[bodies.ground]\ncurves.floor.line = [[9, 0], [-9, 0]]\n\
         [bodies.beam]\nmass = 2\ninertia = 1\npoints = {{ {} }}\n{contacts}\
         [analyses.rest]\ntype = \"dynamics\"\nt_end = 0.1\n",
        points.join(", ")
    )
}

#[test]
fn loads_that_feet_share_in_more_than_one_way_are_named() {
    for (feet, expected) in [
        (&[-1.0, 1.0][..], json!([])),
        (&[-1.0, 0.5, 1.0], json!(["foot_P0", "foot_P1", "foot_P2"])),
    ] {
        let mut page = Page::of(&beam_on_feet(feet));
        let ran = page.ask(json!({ "do": "run", "analysis": "rest" }));
        assert_eq!((&ran["error"], &ran["shared"]), (&Value::Null, &expected), "{ran}");
        assert_eq!(ran["not_unique"], json!([]));
    }
}
