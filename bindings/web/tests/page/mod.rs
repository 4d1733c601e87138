//! The requests of a page, for the tests of the session.
#![allow(dead_code)] // each program uses some of it

use kempe_web::Session;
use serde_json::{json, Value};

pub fn example(name: &str) -> String {
    let path = format!("{}/../../examples/{name}.toml", env!("CARGO_MANIFEST_DIR"));
    std::fs::read_to_string(path).expect("an example")
}

pub struct Page(pub Session);

impl Page {
    pub fn of(text: &str) -> Self {
        let mut page = Self(Session::default());
        let loaded = page.ask(json!({ "do": "load", "text": text }));
        assert_eq!(loaded["problems"], json!([]), "{text}");
        page
    }

    pub fn reply(&mut self, request: &Value) -> Value {
        serde_json::from_str(&self.0.call(&request.to_string())).expect("JSON")
    }

    pub fn ask(&mut self, request: Value) -> Value {
        let reply = self.reply(&request);
        assert!(reply["error"].is_null(), "{request}: {reply}");
        reply["ok"].clone()
    }

    pub fn fault(&mut self, request: Value) -> String {
        let reply = self.reply(&request);
        reply["error"]["message"].as_str().expect("an error").to_string()
    }

    pub fn quantity(&mut self, name: &str) -> f64 {
        let found = self.ask(json!({ "do": "quantity", "name": name }));
        found["value"].as_f64().expect("a number")
    }
}

pub fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} must be a number"))
}

/// A pendulum of a point mass on a bar of 1 m, released from the horizontal.
pub const PENDULUM: &str = r#"kempe = 1
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
