//! Live dynamics of a session.

mod page;

use page::{number, Page, PENDULUM};
use serde_json::json;

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

/// The time between two frames of a screen may be anything down to rounding.
#[test]
fn advances_however_short_do_not_end_the_motion() {
    let mut page = Page::of(PENDULUM);
    let pull = |k: i32| json!({ "do": "pull", "body": "bar", "point": [0.5, 0], "to": [1, 0.1 * f64::from(k)], "stiffness": 40, "damping": 6 });
    let mut due = 0.0;
    page.ask(json!({ "do": "live" }));
    for k in 0..100 {
        if k % 7 == 0 {
            page.ask(pull(k % 3));
        }
        for by in [1.0 / 60.0, 0.1 * 0.1_f64.powi(k % 20)] {
            let found = page.ask(json!({ "do": "advance", "by": by }));
            assert!(found["ended"].is_null(), "{by}: {found}");
            due += by;
            let late = due - number(&found["t"]);
            assert!(late > -1e-7 && late < 0.01, "late by {late}");
        }
    }
}
