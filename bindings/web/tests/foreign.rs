//! Files of other tools as texts of cases.

mod page;

use page::{number, Page, PENDULUM};
use serde_json::{json, Value};

const PENDULUM_OF_ADAMS: &str = include_str!("../../../exchange/tests/samples/pendulum.adm");

fn request(content: &str, name: &str) -> Value {
    json!({ "do": "read", "text": content, "name": name })
}

fn read(content: &str, name: &str) -> (String, f64) {
    let mut page = Page(Default::default());
    let reply = page.ask(request(content, name));
    (reply["text"].as_str().expect("a text").to_string(), number(&reply["lost"]))
}

#[test]
fn a_model_becomes_a_text_that_loads() {
    for name in ["pendulum.adm", "PENDULUM.ADM", "pendulum.txt"] {
        let (text, lost) = read(PENDULUM_OF_ADAMS, name);
        assert_eq!(lost, 0.0, "{text}");
        let mut page = Page::of(&text);
        // 0.1 N/mm over 500 mm, upwards at the mass centre, and the weight of 2 kg with 2.6 kg·m²
        let expected = (50.0 - 2.0 * 9.80665) / 2.6;
        assert!((page.quantity("rod.alpha") / expected - 1.0).abs() < 1e-12, "{text}");
    }
}

#[test]
fn what_a_case_lacks_is_listed_in_its_text() {
    let beams: String = (0..300).map(|k| format!("BEAM/{k}, I = 0101\n")).collect();
    let model = PENDULUM_OF_ADAMS.replace("END\n", &format!("{beams}END\n"));
    let (text, lost) = read(&model, "a\nb.adm");
    assert_eq!(lost, 300.0);
    let first = 1 + PENDULUM_OF_ADAMS.lines().position(|line| line == "END").expect("an end");
    assert!(text.starts_with("# Not read from a b.adm:\n"), "{text}");
    assert!(text.contains(&format!("\n#   line {first}: BEAM/0")), "{text}");
    assert!(text.contains("\n#   and 103 more; kempe convert lists all\n"), "{text}");
    Page::of(&text);
}

#[test]
fn json_of_kempe_becomes_its_text() {
    let mut page = Page::of(PENDULUM);
    let saved = page.ask(json!({ "do": "save", "format": "json" }));
    let toml = page.ask(json!({ "do": "save", "format": "toml" }));
    let (text, _) = read(saved["text"].as_str().expect("a text"), "pendulum.json");
    assert_eq!(json!(text), toml["text"]);
}

#[test]
fn other_texts_stay_and_faults_name_the_file() {
    assert_eq!(read(PENDULUM, "pendulum.txt"), (PENDULUM.to_string(), 0.0));
    let mut page = Page(Default::default());
    let fault = page.fault(request("<mujoco/>", "cart.xml"));
    assert!(fault.contains("cart.xml is a file of MuJoCo"), "{fault}");
    let fault = page.fault(request("0\nSECTION\n", "plate.dxf"));
    assert!(fault.starts_with("cannot read plate.dxf: "), "{fault}");
    let fault = page.fault(request("{\"kempe\": 1, \"bodies\": 3}", "case.json"));
    assert!(fault.contains("bodies"), "{fault}");
}
