//! Dragging a point of a mechanism: it follows on its branch, and stops at dead points.

use crate::mechanisms::{four_bar_of, model, pinned, start};
use kempe::analyses::dragging::{drag, Dragged, Grip};
use kempe::math::Local;
use kempe::{mobility, Model, State, Vec2};
use std::f64::consts::PI;

/// A four-bar linkage with bars of these lengths between pins on ground at (0, 0) and (ground, 0).
fn four_bar([crank, coupler, rocker, ground]: [f64; 4], angle: f64) -> (Model, State) {
    let model = four_bar_of([ground, crank, coupler, rocker], "");
    let set = [("crank.angle", &*angle.to_string())];
    let (state, _) = start(&model, &set, &[("rocker.angle", "1.5")]);
    (model, state)
}

fn pull(model: &Model, q: &[f64], body: &str, at: [f64; 2], to: [f64; 2]) -> Dragged {
    let grip = Grip {
        body: model.body(body).expect("a body"),
        point: Local::new(at[0], at[1]),
        degrees_of_freedom: mobility(model, 0.0, q).degrees_of_freedom,
    };
    drag(model, 0.0, q, grip, Vec2::new(to[0], to[1])).expect("a motion")
}

/// The end of the first bar that is drawn from its mass centre.
fn end(length: f64) -> [f64; 2] {
    [0.5 * length, 0.0]
}

/// Angles of coupler and rocker by the law of cosines, the coupler's pin C to the left of the line from B to D.
fn closed_form([crank, coupler, rocker, ground]: [f64; 4], angle: f64) -> [f64; 2] {
    let b = [crank * angle.cos(), crank * angle.sin()];
    let d = [ground - b[0], -b[1]];
    let line = d[0].hypot(d[1]);
    let inner =
        ((coupler * coupler + line * line - rocker * rocker) / (2.0 * coupler * line)).acos();
    let first = d[1].atan2(d[0]) + inner;
    let c = [b[0] + coupler * first.cos(), b[1] + coupler * first.sin()];
    [first, c[1].atan2(c[0] - ground)]
}

fn apart(a: f64, b: f64) -> f64 {
    ((a - b) / (2.0 * PI) - ((a - b) / (2.0 * PI)).round()).abs() * 2.0 * PI
}

#[test]
fn a_crank_follows_through_whole_turns_on_its_branch() {
    let lengths = [1.0, 3.0, 2.5, 2.8];
    let (model, state) = four_bar(lengths, 0.3);
    let mut q = state.q;
    for k in 0..720 {
        let angle = 0.3 + 4.0 * PI * f64::from(k) / 720.0;
        // the hand is not on the circle of the pin
        let far = 1.0 + 0.8 * (7.0 * angle).sin();
        let found = pull(&model, &q, "crank", end(1.0), [far * angle.cos(), far * angle.sin()]);
        q = found.q;
        assert_eq!(found.dead_point, None, "at {angle}");
        assert!(apart(q[2], angle) < 1e-5, "{} rad at {angle}", q[2]);
        let [coupler, rocker] = closed_form(lengths, q[2]);
        assert!(apart(q[5], coupler) < 1e-8, "coupler at {angle}: {} {coupler}", q[5]);
        assert!(apart(q[8], rocker) < 1e-8, "rocker at {angle}: {} {rocker}", q[8]);
        assert!((found.distance - (far - 1.0).abs()).abs() < 1e-6);
    }
}

#[test]
fn a_crank_that_cannot_turn_stops_at_its_dead_point_and_comes_back_on_its_branch() {
    // the crank stops where coupler and rocker are in line
    let lengths = [2.0, 1.5, 2.0, 3.0];
    let (model, state) = four_bar(lengths, 0.4);
    let limit = ((4.0 + 9.0 - 3.5 * 3.5) / (2.0 * 2.0 * 3.0_f64)).acos();
    let to = |angle: f64| [2.0 * angle.cos(), 2.0 * angle.sin()];
    let mut q = state.q;
    let mut stopped = None;
    for k in 0..200 {
        let found = pull(&model, &q, "crank", end(2.0), to(0.4 + 0.01 * f64::from(k)));
        q = found.q;
        stopped = stopped.or(found.dead_point);
    }
    assert!((q[2] - limit).abs() < 1e-5, "{} {limit}", q[2]);
    let mut in_line = stopped.expect("a dead point").in_line.expect("two bodies in line");
    in_line.sort();
    assert_eq!(in_line, ["coupler", "rocker"]);
    for k in (0..=200).rev() {
        let angle = 0.4 + (limit - 0.4) * f64::from(k) / 201.0;
        q = pull(&model, &q, "crank", end(2.0), to(angle)).q;
        let [coupler, rocker] = closed_form(lengths, q[2]);
        assert!(apart(q[5], coupler) < 1e-6 && apart(q[8], rocker) < 1e-6, "at {angle}");
    }
}

#[test]
fn a_far_target_is_reached_in_one_call() {
    let lengths = [1.0, 3.0, 2.5, 2.8];
    let (model, state) = four_bar(lengths, 0.3);
    let found = pull(&model, &state.q, "crank", end(1.0), [-0.7, 0.7]);
    assert!(apart(found.q[2], 0.75 * PI) < 1e-5, "{}", found.q[2]);
    let [coupler, rocker] = closed_form(lengths, found.q[2]);
    assert!(apart(found.q[5], coupler) < 1e-8 && apart(found.q[8], rocker) < 1e-8);
}

#[test]
fn an_arm_with_two_freedoms_reaches_every_place_within_its_length() {
    let model = model(
        &(pinned("upper", "type = 'bar'\nmass = 1\nlength = 1\nends = ['O', 'B']")
            + "[bodies.lower]\ntype = 'bar'\nmass = 1\nlength = 0.8\nends = ['B', 'P']\n\
               [joints.B]\ntype = 'revolute'\ni = 'upper.B'\nj = 'lower.B'\n"),
    );
    let (state, _) = start(&model, &[("upper.angle", "0.2"), ("lower.angle", "1.0")], &[]);
    let mut q = state.q;
    for k in 0..100 {
        let (angle, far) = (0.1 * f64::from(k), 1.0 + 0.6 * (0.37 * f64::from(k)).sin());
        let to = [far * angle.cos(), far * angle.sin()];
        let found = pull(&model, &q, "lower", end(0.8), to);
        q = found.q;
        assert!(found.distance < 1e-8, "{} m from the target {to:?}", found.distance);
    }
    // around the places that it cannot reach, step by step as in a picture
    let mut distance = f64::INFINITY;
    for _ in 0..8 {
        let found = pull(&model, &q, "lower", end(0.8), [3.0, 0.0]);
        assert!(found.distance <= distance, "{} after {distance}", found.distance);
        (q, distance) = (found.q, found.distance);
    }
    assert!((distance - 1.2).abs() < 1e-4, "{distance}");
}
