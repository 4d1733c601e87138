//! The session as a page uses it, with the examples of the repository.

use kempe_web::Session;
use serde_json::{json, Value};
use std::f64::consts::PI;

fn example(name: &str) -> String {
    let path = format!("{}/../../examples/{name}.toml", env!("CARGO_MANIFEST_DIR"));
    std::fs::read_to_string(path).expect("an example")
}

struct Page(Session);

impl Page {
    fn of(text: &str) -> Self {
        let mut page = Self(Session::default());
        let loaded = page.ask(json!({ "do": "load", "text": text }));
        assert_eq!(loaded["problems"], json!([]), "{text}");
        page
    }

    fn reply(&mut self, request: &Value) -> Value {
        serde_json::from_str(&self.0.call(&request.to_string())).expect("JSON")
    }

    fn ask(&mut self, request: Value) -> Value {
        let reply = self.reply(&request);
        assert!(reply["error"].is_null(), "{request}: {reply}");
        reply["ok"].clone()
    }

    fn fault(&mut self, request: Value) -> String {
        let reply = self.reply(&request);
        reply["error"]["message"].as_str().expect("an error").to_string()
    }

    fn quantity(&mut self, name: &str) -> f64 {
        let found = self.ask(json!({ "do": "quantity", "name": name }));
        found["value"].as_f64().expect("a number")
    }
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} must be a number"))
}

/// A pendulum of a point mass on a bar of 1 m, released from the horizontal.
const PENDULUM: &str = r#"kempe = 1
gravity = [0, -9.81]
[parameters]
m = 2 # kg
[bodies.ground]
points = { A = [0, 0] }
[bodies.bar]
type = "bar"
mass = "m"
length = 1
ends = ["A", "B"]
[joints.A]
type = "revolute"
i = "ground.A"
j = "bar.A"
[start]
set = { "bar.angle" = 0 }
[analyses.swing]
type = "dynamics"
t_end = 1
output_step = 0.01
"#;

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

#[test]
fn kinematics_over_the_crank_angle_is_that_of_the_closed_form() {
    let law = "[drivers.turn]\ntype = \"coordinate_driver\"\ncoordinate = \"crank.angle\"\nvalue = \"60*deg + 5*t\"";
    for (over, driver) in [("crank.angle", ""), ("crank.angle", law), ("turn", law)] {
        let mut page = slider_crank_over(over, "[0, \"360*deg\"]", driver);
        let ran = page.ask(json!({ "do": "run", "analysis": "cycle" }));
        assert_eq!((number(&ran["count"]), &ran["status"]), (91.0, &json!("reached")), "{ran}");
        assert_eq!(ran["over"], json!({ "name": "crank.angle", "unit": "rad" }));
        let found = values(&mut page, &["crank.angle", "slider.x", "slider.vx", "slider.ax"]);
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

#[test]
fn live_dynamics_is_that_of_a_run() {
    let mut page = Page::of(PENDULUM);
    page.ask(json!({ "do": "run", "t_end": 1.0, "output_step": 0.01 }));
    page.ask(json!({ "do": "values", "names": ["bar.angle"] }));
    let angles = page.0.numbers().to_vec();
    page.ask(json!({ "do": "live" }));
    let mut t = 0.0;
    while t < 1.0 {
        let found = page.ask(json!({ "do": "advance", "by": 1.0 / 60.0 }));
        let next = number(&found["t"]);
        assert!(next > t && found["ended"].is_null(), "{found}");
        t = next;
        if t <= 1.0 {
            let k = (t / 0.01).floor();
            let (a, b) = (angles[k as usize], angles[(k as usize + 1).min(100)]);
            let inside = a + (t / 0.01 - k) * (b - a);
            assert!((number(&found["q"][2]) - inside).abs() < 2e-3, "at {t}");
        }
        assert!(number(&found["energy"]["balance"]).abs() < 1e-6, "{found}");
        assert!(number(&found["drift"]) < 1e-9);
    }
}

#[test]
fn a_pull_moves_the_equilibrium_and_ends() {
    let text = PENDULUM.replace("\"bar.angle\" = 0", "\"bar.angle\" = \"-90*deg\"");
    let mut page = Page::of(&text);
    page.ask(json!({ "do": "live" }));
    let pull = json!({ "do": "pull", "body": "bar", "point": [0.5, 0], "to": [1, -1], "stiffness": 500, "damping": 200 });
    page.ask(pull);
    let mut last = json!(null);
    for _ in 0..400 {
        last = page.ask(json!({ "do": "advance", "by": 0.05 }));
        assert!(last["ended"].is_null(), "{last}");
    }
    // balance of moments about the pin: m g cos / 2 = k (1·(-1) pull across the bar)
    let angle = number(&last["q"][2]);
    let (c, s) = (angle.cos(), angle.sin());
    let moment = -2.0 * 9.81 * 0.5 * c + 500.0 * (c * (-1.0 - s) - s * (1.0 - c));
    assert!(moment.abs() < 1e-3, "{moment} N·m at {angle}");
    page.ask(json!({ "do": "pull", "body": null }));
    let found = page.ask(json!({ "do": "advance", "by": 0.1 }));
    assert!(number(&found["q"][2]) < angle, "it falls back");
}

/// A pull of 100 N upwards at the end of the pendulum, which is horizontal.
fn pull_up(page: &mut Page) {
    page.ask(json!({ "do": "live" }));
    page.ask(
        json!({ "do": "pull", "body": "bar", "point": [0.5, 0], "to": [1, 1], "stiffness": 100 }),
    );
}

#[test]
fn accelerations_and_reactions_contain_the_pull() {
    let mut page = Page::of(PENDULUM);
    pull_up(&mut page);
    // moments about the pin: m L²/3 α = F L - m g L/2; then forces along y
    let alpha = (100.0 - 9.81) / (2.0 / 3.0);
    assert!((page.quantity("bar.alpha") / alpha - 1.0).abs() < 1e-12);
    let reaction = 2.0 * 0.5 * alpha + 2.0 * 9.81 - 100.0;
    assert!((page.quantity("A.force") / reaction - 1.0).abs() < 1e-12);
    page.ask(json!({ "do": "pull", "body": null }));
    assert!((page.quantity("bar.alpha") / (-1.5 * 9.81) - 1.0).abs() < 1e-12);
}

#[test]
fn a_pull_goes_on_when_a_parameter_changes() {
    let mut page = Page::of(PENDULUM);
    pull_up(&mut page);
    page.ask(json!({ "do": "parameters", "values": { "m": 4 } }));
    let alpha = (100.0 - 4.0 * 9.81 / 2.0) / (4.0 / 3.0);
    assert!((page.quantity("bar.alpha") / alpha - 1.0).abs() < 1e-12);
    let found = page.ask(json!({ "do": "advance", "by": 0.02 }));
    let (t, angle) = (number(&found["t"]), number(&found["q"][2]));
    // the force turns by less than a hundredth meanwhile
    assert!((angle / (0.5 * alpha * t * t) - 1.0).abs() < 0.01, "{angle} after {t}");
}

#[test]
fn parameters_change_the_motion_but_not_the_text() {
    let mut page = Page::of(PENDULUM);
    let before = page.quantity("A.force");
    page.ask(json!({ "do": "parameters", "values": { "m": 4 } }));
    assert!((page.quantity("A.force") / before - 2.0).abs() < 1e-12);
    let text = page.ask(json!({ "do": "save", "format": "toml" }));
    assert!(text["text"].as_str().expect("a text").contains("m = 2"));
}

#[test]
fn a_dragged_crank_follows_and_a_locked_one_does_not() {
    let mut page = Page::of(&example("four_bar"));
    let to = [10.0 * 1.4_f64.cos(), 10.0 * 1.4_f64.sin()];
    let crank = json!({ "do": "drag", "body": "crank", "point": [5, 0], "to": to });
    let found = page.ask(crank.clone());
    assert!((number(&found["pose"]["q"][2]) - 1.4).abs() < 1e-5, "{found}");
    assert!(number(&found["pose"]["residual"]) < 1e-9);
    let mut locked = crank;
    locked["locked"] = json!(["rocker.angle"]);
    locked["to"] = json!([0, 10]);
    let found = page.ask(locked);
    assert!((number(&found["pose"]["q"][2]) - 1.4).abs() < 1e-5, "{found}");
}

#[test]
fn configurations_of_a_four_bar_are_two() {
    let mut page = Page::of(&example("four_bar"));
    let found = page.ask(json!({ "do": "configurations" }));
    assert_eq!(
        (found["poses"].as_array().map(Vec::len), &found["complete"]),
        (Some(2), &json!(true))
    );
    let now = page.ask(json!({ "do": "pose" }));
    let other = found["poses"]
        .as_array()
        .expect("poses")
        .iter()
        .find(|pose| (number(&pose["q"][5]) - number(&now["q"][5])).abs() > 0.1);
    let q = &other.expect("another one")["q"];
    let chosen = page.ask(json!({ "do": "pose", "q": q }));
    assert!((number(&chosen["q"][5]) - number(&q[5])).abs() < 1e-9);
}

#[test]
fn faults_have_their_places() {
    let mut page = Page(Session::default());
    let text = PENDULUM.replace("mass = \"m\"", "mass = -1");
    let found = page.ask(json!({ "do": "load", "text": text }));
    let problem = &found["problems"][0];
    let line = text.lines().position(|line| line == "mass = -1").expect("the line") + 1;
    assert_eq!((number(&problem["line"]), number(&problem["column"])), (line as f64, 8.0));
    assert_eq!(problem["path"], "bodies.bar.mass");
    assert!(found["mechanism"].is_null() && !found["case"].is_null());
    assert!(page.fault(json!({ "do": "pose" })).contains("no mechanism"));
    assert!(page.fault(json!({ "do": "fly" })).contains("fly"));
    assert!(page.fault(json!({ "do": "load" })).contains("text"));
}

#[test]
fn a_mechanism_that_does_not_close_is_placed_open() {
    let text = example("four_bar").replace("L2 = 26", "L2 = 1");
    let mut page = Page(Session::default());
    let found = page.ask(json!({ "do": "load", "text": text }));
    assert!(
        found["unassembled"]["message"].as_str().is_some_and(|m| m.contains("short")),
        "{found}"
    );
    assert!(!found["pose"].is_null());
    assert!(page.fault(json!({ "do": "live" })).contains("close"));
}

#[test]
fn edits_keep_comments_and_order() {
    let mut page = Page::of(PENDULUM);
    let changes = json!([
        { "path": ["parameters", "m"], "value": 2.5 },
        { "path": ["bodies", "bar", "length"], "value": "1200 mm" },
        { "path": ["bodies", "bob"], "value": { "type": "point_mass", "mass": 1 } },
        { "path": ["joints", "B"], "value": { "type": "revolute", "i": "bar.B", "j": "bob.P" } },
        { "path": ["start", "set", "bar.angle"], "value": 0.5 },
        { "path": ["analyses", "swing"], "remove": true },
    ]);
    let text = page.ask(json!({ "do": "edit", "changes": changes }))["text"].clone();
    let text = text.as_str().expect("a text");
    assert!(text.contains("m = 2.5 # kg"), "{text}");
    assert!(text.contains("length = \"1200 mm\"") && !text.contains("swing"), "{text}");
    assert!(text.contains("[bodies.bob]\ntype = \"point_mass\"\nmass = 1\n"), "{text}");
    assert!(text.starts_with("kempe = 1\ngravity = [0, -9.81]\n"));
    let mut page = Page::of(text);
    assert!((page.quantity("bob.x") - 0.5_f64.cos() * 1.2).abs() < 1e-12);
}

#[test]
fn a_new_name_is_used_everywhere() {
    let mut page = Page::of(PENDULUM);
    let changes = json!([
        { "path": ["bodies", "bar"], "rename": "rod" },
        { "path": ["parameters", "m"], "rename": "mass_of_rod" },
    ]);
    let text = page.ask(json!({ "do": "edit", "changes": changes }))["text"].clone();
    let text = text.as_str().expect("a text");
    assert!(
        text.contains("[bodies.rod]\ntype = \"bar\"") && text.contains("j = \"rod.A\""),
        "{text}"
    );
    assert!(
        text.contains("\"rod.angle\" = 0") && text.contains("mass = \"mass_of_rod\""),
        "{text}"
    );
    assert!(text.contains("mass_of_rod = 2 # kg"), "{text}");
    Page::of(text);
}

#[test]
fn the_catalogue_says_which_joints_are_pins() {
    let mut page = Page(Session::default());
    let found = page.ask(json!({ "do": "catalogue" }));
    let joints = found["elements"]["joints"].as_array().expect("joints");
    let pins: Vec<&Value> = joints
        .iter()
        .filter(|joint| joint["joins_points"] == true)
        .map(|joint| &joint["name"])
        .collect();
    assert_eq!(pins, ["revolute"]);
    assert!(found["schema"]["properties"]["bodies"].is_object());
}

#[test]
fn every_example_loads_and_its_first_pose_is_closed() {
    let folder = format!("{}/../../examples", env!("CARGO_MANIFEST_DIR"));
    let mut count = 0;
    for entry in std::fs::read_dir(folder).expect("the examples") {
        let path = entry.expect("an entry").path();
        if path.extension().is_none_or(|extension| extension != "toml") {
            continue;
        }
        let text = std::fs::read_to_string(&path).expect("a text");
        let mut page = Page(Session::default());
        let found = page.ask(json!({ "do": "load", "text": text }));
        if text.contains("file = ") {
            continue; // its table lies in another file
        }
        assert_eq!(found["problems"], json!([]), "{}", path.display());
        assert!(found["unassembled"].is_null(), "{}: {}", path.display(), found["unassembled"]);
        assert!(number(&found["pose"]["residual"]) < 1e-9, "{}", path.display());
        let same = page.ask(json!({ "do": "edit", "changes": [] }));
        assert_eq!(same["text"], json!(text), "{}", path.display());
        count += 1;
    }
    assert!(count >= 40, "{count} examples");
}

#[test]
fn every_example_is_drawn() {
    let mut page = Page::of(&example("four_bar"));
    let scene = page.ask(json!({ "do": "scene" }))["scene"].clone();
    let names: Vec<&Value> =
        scene["bodies"].as_array().expect("bodies").iter().map(|b| &b["name"]).collect();
    assert_eq!(names, ["ground", "crank", "coupler", "rocker"]);
    let size = json!({ "do": "display", "width": 600, "height": 400 });
    let items = page.ask(size)["items"].clone();
    let texts: Vec<&Value> = items
        .as_array()
        .expect("items")
        .iter()
        .filter(|item| item["kind"] == "text")
        .map(|item| &item["text"])
        .collect();
    for name in ["A", "B", "C", "D", "spring", "1", "2", "3"] {
        assert!(texts.iter().any(|text| *text == name), "{name} in {texts:?}");
    }
    let bare =
        json!({ "do": "display", "width": 600, "height": 400, "names": false, "numbers": false });
    let items = page.ask(bare)["items"].clone();
    assert!(items.as_array().expect("items").iter().all(|item| item["kind"] != "text"));
}
