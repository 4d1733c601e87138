//! What prevents an analysis, with its place.

mod page;

use kempe_web::Session;
use page::{example, Page, PENDULUM};
use serde_json::json;

/// What prevents an analysis, with its place.
fn obstacle(page: &mut Page, analysis: &str) -> Option<[String; 2]> {
    let all = page.ask(json!({ "do": "readiness" }));
    let found = all.as_array().expect("a list").iter().find(|one| one["analysis"] == analysis);
    let problem = &found.unwrap_or_else(|| panic!("{analysis} in {all}"))["problem"];
    let text = |key: &str| problem[key].as_str().expect("a text").to_string();
    (!problem.is_null()).then(|| [text("message"), text("path")])
}

#[test]
fn a_mechanism_is_ready_for_what_it_has() {
    let mut page = Page::of(PENDULUM);
    for analysis in ["assembly", "dynamics"] {
        assert_eq!(obstacle(&mut page, analysis), None);
    }
    let [message, path] = obstacle(&mut page, "kinematics").expect("a freedom");
    assert!(message.contains("freedom") && path == "drivers", "{message} {path}");
    let driver = "\n[drivers.turn]\ntype = \"coordinate_driver\"\ncoordinate = \"bar.angle\"\nvalue = \"2*t\"\n";
    let mut page = Page::of(&(PENDULUM.to_string() + driver));
    for analysis in ["dynamics", "kinematics", "inverse_dynamics"] {
        assert_eq!(obstacle(&mut page, analysis), None);
    }
}

#[test]
fn what_is_missing_has_its_place() {
    let mut page = Page(Session::default());
    let open = example("four_bar").replace("L2 = 26", "L2 = 1");
    page.ask(json!({ "do": "load", "text": open }));
    let [message, path] = obstacle(&mut page, "assembly").expect("too short");
    assert!(message.contains("short") && path.starts_with("joints."), "{message} {path}");
    // a bar without mass at the end of another: nothing determines how it turns
    let text = r#"kempe = 1
[bodies.ground]
points = { A = [0, 0] }
[bodies.bar]
type = "bar"
mass = 1
length = 1
ends = ["A", "B"]
[bodies.light]
type = "bar"
mass = 0
length = 1
ends = ["B", "C"]
[joints.A]
type = "revolute"
i = "ground.A"
j = "bar.A"
[joints.B]
type = "revolute"
i = "bar.B"
j = "light.B"
"#;
    let mut page = Page::of(text);
    let [message, path] = obstacle(&mut page, "dynamics").expect("no mass");
    assert!(message.contains("mass") && path == "bodies.light", "{message} {path}");
}
