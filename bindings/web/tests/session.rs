//! The session as a page uses it, with the examples of the repository.

mod page;

use kempe_web::Session;
use page::{example, number, Page, PENDULUM};
use serde_json::{json, Value};

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
fn a_beam_is_no_list_of_pieces() {
    let mut page = Page(Session::default());
    let found = page.ask(json!({ "do": "load", "text": example("cross_spring_pivot") }));
    let names = |group: &str| -> Vec<String> {
        let items = found["mechanism"][group].as_array().expect("a list").iter();
        items.map(|item| item["name"].as_str().expect("a name").to_string()).collect()
    };
    assert_eq!(names("forces"), ["torque"]);
    assert_eq!(names("joints"), ["A", "C", "B", "D"]);
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

#[test]
fn the_drawing_covers_the_last_run() {
    let mut page = Page::of(&example("scotch_yoke"));
    let reach = |page: &mut Page| -> [f64; 2] {
        let scene = page.ask(json!({ "do": "scene" }))["scene"].clone();
        let symbols = scene["symbols"].as_array().expect("symbols").clone();
        let slot = symbols.iter().find(|symbol| symbol["element"] == "slot").expect("a slot");
        [0, 1].map(|k| number(&slot["reach"][k]))
    };
    let short = |[low, high]: [f64; 2]| low.abs() < 1e-12 && high.abs() < 1e-12;
    assert!(short(reach(&mut page)));
    page.ask(json!({ "do": "run", "analysis": "turns" }));
    let [low, high] = reach(&mut page);
    assert!((low + 0.08).abs() < 1e-4 && (high - 0.08).abs() < 1e-4, "{low} {high}");
    let size = json!({ "do": "display", "width": 600, "height": 400 });
    assert!(!page.ask(size)["items"].as_array().expect("items").is_empty());
    page.ask(json!({ "do": "load", "text": example("scotch_yoke") }));
    assert!(short(reach(&mut page)));
}
