//! The section `[optimize]`, run by run.

mod page;

use page::{number, Page};
use serde_json::{json, Value};

/// The lamp of docs/optimization.md, whose best spring Python finds.
const LAMP: &str = r#"kempe = 1
gravity = [0, -9.81]
[parameters]
k = "300 N/m"
h = "200 mm"
[bodies.ground]
points = { O = [0, 0], H = [0, "h"] }
[bodies.arm]
mass = 1.2
inertia = 0.01
center = [0.5, 0]
points = { O = [0, 0], S = [0.15, 0] }
[joints.hinge]
type = "revolute"
i = "ground.O"
j = "arm.O"
[forces.spring]
type = "spring_damper"
i = "ground.H"
j = "arm.S"
stiffness = "k"
free_length = "20 mm"
[start]
set = { "arm.angle" = "-60 deg" }
[analyses.hold]
type = "inverse_dynamics"
static = true
over = "arm.angle"
range = ["-60*deg", "60*deg"]
n = 41
[optimize]
variables = { k = [50, 2000, "log"], h = [0.05, 0.3] }
minimize = "over.effort.rms"
subject_to = ["h <= 250 mm", "spring.force.peak <= 60"]
"#;

fn ended(page: &mut Page) -> Value {
    let mut found = page.ask(json!({ "do": "optimize" }));
    while found["ending"].is_null() {
        found = page.ask(json!({ "do": "improve" }));
    }
    found
}

#[test]
fn a_lamp_gets_the_spring_that_python_finds() {
    let mut page = Page::of(LAMP);
    let found = ended(&mut page);
    assert_eq!(found["ending"], "best", "{found}");
    // Python prints the best run that exceeds limits by a millionth at most
    assert!((number(&found["now"]) / 0.207_168 - 1.0).abs() < 2e-5, "{found}");
    assert!((number(&found["values"]["k"]) / 163.383 - 1.0).abs() < 4e-6, "{found}");
    assert!((number(&found["values"]["h"]) - 0.25).abs() < 1e-10, "{found}");
    assert!(number(&found["before"]) > 1.0 && number(&found["runs"]) < 40.0, "{found}");
    let room = found["room"].as_array().expect("rooms");
    assert!(room.iter().all(|one| number(one).abs() < 1e-8), "{found}");
}

#[test]
fn what_the_page_leaves_to_the_command_is_refused() {
    for (old, new, says) in [
        ("minimize", "loads = [{ k = 1 }]\nminimize", "load cases"),
        ("\"over.effort.rms\"", "[\"over.effort.rms\", \"k\"]", "several objectives"),
        ("h = [0.05", "\"arm.angle\" = [0.05", "'arm.angle'"),
        ("\"h <=", "\"hold:spring.force.max <=", "several analyses"),
        ("<= 60", "<= h", "spring.force.peak <= h"),
        ("[50, 2000", "[2000, 50", "bounds of k"),
    ] {
        let text = LAMP.replace(old, new);
        assert_ne!(text, LAMP);
        let mut page = Page::of(&text);
        let fault = page.fault(json!({ "do": "optimize" }));
        assert!(fault.contains(says), "{fault}");
        assert!(page.fault(json!({ "do": "improve" })).contains("no search"));
    }
}
