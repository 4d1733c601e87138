//! Followers of cams are placed without a guess. The cam is a disc of radius R with the eccentricity E, so that the
//! places are those of triangles.

use crate::mechanisms::{close, largest, model, residual, start};
use std::f64::consts::PI;

const R: f64 = 0.03;
const E: f64 = 0.01;
const ROLLER: f64 = 0.008;

fn cam(angle: f64) -> String {
    format!(
        "[bodies.ground]\npoints = {{ O = [0, 0], S = [0.005, SLIDE], Q = [0.1, 0] }}\n\
         [bodies.cam]\nmass = 1\ninertia = 1e-3\npoints = {{ O = [0, 0] }}\ncurves = {{ rim = {{ circle = [{E}, 0, {R}] }} }}\n\
         [joints.shaft]\ntype = \"revolute\"\ni = \"ground.O\"\nj = \"cam.O\"\n\
         [drivers.motor]\ntype = \"coordinate_driver\"\ncoordinate = \"cam.angle\"\nvalue = {angle:?}\n"
    )
}

fn contact(kind: &str) -> String {
    let more = match kind {
        "roller_on_curve" => format!("radius = {ROLLER}\n"),
        _ => String::new(),
    };
    format!("[joints.contact]\ntype = \"{kind}\"\ni = \"follower.P\"\ncurve = \"cam.rim\"\n{more}")
}

/// The follower slides along y at x = 5 mm; its guide is at `slide`.
fn translating(kind: &str, angle: f64, slide: f64, axis: f64) -> String {
    let follower = format!(
        "[bodies.follower]\nmass = 1\ninertia = 1e-3\npoints = {{ P = [0, 0], T = [0, 0.05] }}\n\
         [joints.guide]\ntype = \"translational\"\ni = \"ground.S\"\nj = \"follower.T\"\naxes = [{axis:?}, {axis:?}]\n"
    );
    cam(angle).replace("SLIDE", &format!("{slide:?}")) + &follower + &contact(kind)
}

/// The follower is an arm of 0.1 m on the pin Q, with the frame at the pin.
fn oscillating(kind: &str, angle: f64) -> String {
    let follower =
        "[bodies.follower]\nmass = 1\ninertia = 1e-3\npoints = { Q = [0, 0], P = [0.1, 0] }\n\
         [joints.pin]\ntype = \"revolute\"\ni = \"ground.Q\"\nj = \"follower.Q\"\n";
    let contact = contact(kind)
        .replace("follower.P", if kind == "flat_on_curve" { "follower.Q" } else { "follower.P" });
    cam(angle).replace("SLIDE", "0.0") + follower + &contact
}

fn angles() -> impl Iterator<Item = f64> {
    (0..5).map(|k| 0.3 + f64::from(k) * 2.0 * PI / 5.0)
}

#[test]
fn translating_followers() {
    for (kind, radius) in
        [("roller_on_curve", ROLLER), ("point_on_curve", 0.0), ("flat_on_curve", 0.0)]
    {
        for angle in angles() {
            let (x, y) = (E * angle.cos(), E * angle.sin());
            let half = ((R + radius).powi(2) - (x - 0.005).powi(2)).sqrt();
            let up = if kind == "flat_on_curve" { R } else { half };
            // the guide decides the side: above, below, and on the shaft with the axis upwards
            for (slide, axis, height) in [
                (0.12, PI / 2.0, y + up),
                (0.12, -PI / 2.0, y + up),
                (-0.12, PI / 2.0, y - up),
                (0.0, PI / 2.0, y + up),
            ] {
                let m = model(&translating(kind, angle, slide, axis));
                let (state, report) = start(&m, &[], &[]);
                assert!(largest(&residual(&m, &state)) < 1e-12);
                close(&format!("{kind} at {angle} from {slide}"), state.q[4], height, 1e-10);
                assert_eq!(report.degrees_of_freedom, 0);
            }
            let below = if kind == "flat_on_curve" { y - R } else { y - half };
            let m = model(&translating(kind, angle, 0.12, PI / 2.0));
            let guess = format!("{:?}", below + 0.004);
            let (state, _) = start(&m, &[], &[("follower.y", &guess)]);
            close("a guess decides", state.q[4], below, 1e-10);
        }
    }
}

#[test]
fn oscillating_followers() {
    for (kind, radius) in
        [("roller_on_curve", ROLLER), ("point_on_curve", 0.0), ("flat_on_curve", 0.0)]
    {
        for angle in angles() {
            let (x, y) = (E * angle.cos() - 0.1, E * angle.sin());
            let (far, towards) = (x.hypot(y), y.atan2(x));
            let beside = match kind {
                "flat_on_curve" => (R / far).asin(),
                _ => ((far * far + 0.01 - (R + radius).powi(2)) / (0.2 * far)).acos(),
            };
            for (guess, sign) in [("170*deg", -1.0), ("190*deg", 1.0)] {
                let m = model(&oscillating(kind, angle));
                let (state, _) = start(&m, &[], &[]);
                let miss = |sign: f64| {
                    let off = state.q[5] - towards - sign * beside;
                    (off - PI * (off / PI).round()).abs()
                };
                assert!(miss(1.0).min(miss(-1.0)) < 1e-9, "{kind} at {angle}: {}", state.q[5]);
                if kind == "flat_on_curve" {
                    continue;
                }
                let (state, _) = start(&m, &[], &[("follower.angle", guess)]);
                let expected = (towards + sign * beside).rem_euclid(2.0 * PI);
                close("a guess decides", state.q[5].rem_euclid(2.0 * PI), expected, 1e-9);
            }
        }
    }
}

/// A cam that the follower turns: the follower is placed first.
#[test]
fn a_cam_below_a_follower() {
    let text = translating("roller_on_curve", 0.0, 0.12, PI / 2.0);
    let text = text.replace("cam.angle", "follower.y").replace("value = 0.0", "value = 0.042");
    let (state, _) = start(&model(&text), &[], &[]);
    let (x, y) = (E * state.q[2].cos(), E * state.q[2].sin());
    close("height", y + ((R + ROLLER).powi(2) - (x - 0.005).powi(2)).sqrt(), 0.042, 1e-10);
}
