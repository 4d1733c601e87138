//! Bodies that are placed by an equation: gears, belts, racks, rolling wheels, pins in slots, rods and welds. No guess
//! is needed, and the placement closes without a step of Newton's method.

use crate::mechanisms::{column, largest, model, refused, residual, start};
use kempe::analyses::assemble::{Fault, Report};
use kempe::analyses::State;

/// A body with points; wheels have one in their centre.
fn body(name: &str, points: &str) -> String {
    format!("[bodies.{name}]\nmass = 1\ninertia = 0.1\npoints = {{ {points} }}\n")
}

fn joint(name: &str, kind: &str, i: &str, j: &str, more: &str) -> String {
    format!("[joints.{name}]\ntype = \"{kind}\"\ni = \"{i}\"\nj = \"{j}\"\n{more}\n")
}

fn pin(name: &str, i: &str, j: &str) -> String {
    joint(name, "revolute", i, j, "")
}

fn ground(points: &str) -> String {
    format!("[bodies.ground]\npoints = {{ {points} }}\n")
}

/// Assembles and checks that the first placement was closed already.
#[track_caller]
fn placed(text: &str, set: &[(&str, &str)]) -> (kempe::Model, State, Report) {
    let m = model(text);
    let (state, report) = start(&m, set, &[]);
    assert!(largest(&residual(&m, &state)) < 1e-11);
    let first = report.iterations[0].residual_norm;
    assert!(first < 1e-8, "the placement is open by {first:e}");
    (m, state, report)
}

#[track_caller]
fn is(m: &kempe::Model, state: &State, body: &str, coordinate: usize, expected: f64) {
    let found = state.q[column(m, body, coordinate)];
    assert!((found - expected).abs() < 1e-9, "{body}: {found} is not {expected}");
}

/// Wheels in a chain on ground, driven at either end.
#[test]
fn wheels_follow_one_another() {
    let chain = [
        ground("A = [0, 0], B = [3, 0], C = [3, 4], D = [0, 4]"),
        body("a", "P = [0, 0]"),
        body("b", "P = [0, 0]"),
        body("c", "P = [0, 0]"),
        body("rack", "S = [0, 0]"),
        pin("A", "ground.A", "a.P"),
        pin("B", "ground.B", "b.P"),
        pin("C", "ground.C", "c.P"),
        joint("mesh", "gear", "a.P", "b.P", "radii = [1, 2]"),
        joint("belt", "belt", "b.P", "c.P", "radii = [2, 1]"),
        joint("slide", "translational", "ground.D", "rack.S", ""),
        joint("r", "rack", "rack.S", "c.P", "radius = -1\naxis = \"90*deg\"\noffset = 3.0"),
    ];
    // the rack stands upright: its guide and its pitch line do so
    let chain = chain
        .concat()
        .replace("j = \"rack.S\"\n", "j = \"rack.S\"\naxes = [\"90*deg\", \"90*deg\"]\n");
    let chain = chain.replace("D = [0, 4]", "D = [2, 0]");
    for set in [("a.angle", "0.6"), ("c.angle", "-0.9"), ("rack.y", "1.5")] {
        let (m, state, _) = placed(&chain, &[set]);
        let [a, b, c] = ["a", "b", "c"].map(|body| state.q[column(&m, body, 2)]);
        let turns = (a + 2.0 * b) / (6.0 * std::f64::consts::PI);
        assert!((turns - turns.round()).abs() < 1e-9, "{a} {b}");
        let up = std::f64::consts::FRAC_PI_2;
        let turns = (2.0 * (b - up) - (c - up)) / (2.0 * std::f64::consts::PI);
        assert!((turns - turns.round()).abs() < 1e-9, "{b} {c}");
    }
}

fn planetary() -> String {
    [
        ground("O = [0, 0]"),
        body("sun", "O = [0, 0]"),
        body("carrier", "O = [0, 0], P = [3, 0]"),
        body("planet", "P = [0, 0]"),
        pin("S", "ground.O", "sun.O"),
        pin("C", "ground.O", "carrier.O"),
        pin("P", "carrier.P", "planet.P"),
        joint("inner", "gear", "sun.O", "planet.P", "radii = [2, 1]"),
        joint("outer", "gear", "ground.O", "planet.P", "radii = [4, 1]\ninternal = true"),
    ]
    .concat()
}

#[test]
fn a_planetary_set_by_its_carrier() {
    let (m, state, _) = placed(&planetary(), &[("carrier.angle", "0.5")]);
    let planet = state.q[column(&m, "planet", 2)];
    let sun = state.q[column(&m, "sun", 2)];
    let outer = (4.0 * -0.5 - (planet - 0.5)) / (6.0 * std::f64::consts::PI);
    let inner = (2.0 * (sun - 0.5) + (planet - 0.5)) / (6.0 * std::f64::consts::PI);
    assert!((outer - outer.round()).abs() < 1e-9 && (inner - inner.round()).abs() < 1e-9);
}

#[test]
fn a_planetary_set_by_its_sun() {
    let m = model(&planetary());
    for angle in ["0", "0.4", "-2", "11"] {
        let (state, report) = start(&m, &[("sun.angle", angle)], &[]);
        assert!(largest(&residual(&m, &state)) < 1e-11);
        assert_eq!(report.degrees_of_freedom, 1);
    }
}

/// A crank whose pin moves a yoke on a slide, from either side.
#[test]
fn a_scotch_yoke_from_crank_and_from_yoke() {
    let yoke = [
        ground("O = [0, 0]"),
        body("crank", "O = [0, 0], P = [2, 0]"),
        body("yoke", "S = [0, 0]"),
        pin("O", "ground.O", "crank.O"),
        joint("guide", "translational", "ground.O", "yoke.S", ""),
        joint("slot", "pin_in_slot", "yoke.S", "crank.P", "axis = \"90*deg\""),
    ]
    .concat();
    let (m, state, _) = placed(&yoke, &[("crank.angle", "60*deg")]);
    is(&m, &state, "yoke", 0, 1.0);
    let (m, state, _) = placed(&yoke, &[("yoke.x", "1")]);
    is(&m, &state, "crank", 2, 60_f64.to_radians());
}

/// A slotted lever, a massless rod and a ram: the quick-return of a shaper.
#[test]
fn a_quick_return_with_slot_and_rod() {
    let shaper = [
        ground("O = [0, 3], Q = [0, 0], R = [0, 6]"),
        body("crank", "O = [0, 0], P = [1, 0]"),
        body("lever", "Q = [0, 0], T = [5.5, 0]"),
        body("ram", "S = [0, 0]"),
        pin("O", "ground.O", "crank.O"),
        pin("Q", "ground.Q", "lever.Q"),
        joint("slot", "pin_in_slot", "lever.Q", "crank.P", ""),
        joint("guide", "translational", "ground.R", "ram.S", ""),
        joint("rod", "distance", "lever.T", "ram.S", "length = 2"),
    ]
    .concat();
    let (m, state, _) = placed(&shaper, &[("crank.angle", "0")]);
    is(&m, &state, "lever", 2, 3.0_f64.atan2(1.0));
    let tip = 5.5 * 3.0_f64.atan2(1.0).cos();
    let up = 6.0 - 5.5 * 3.0_f64.atan2(1.0).sin();
    let reach = (4.0 - up * up).sqrt();
    let ram = state.q[column(&m, "ram", 0)];
    assert!((ram - tip - reach).abs() < 1e-9 || (ram - tip + reach).abs() < 1e-9, "{ram}");
}

/// A disc on a line, a cart on two wheels, and a lever on a rod.
#[test]
fn discs_carts_and_rods() {
    let disc = [
        ground("O = [1, 2]"),
        body("disc", "P = [0, 0]"),
        joint("floor", "rolling", "ground.O", "disc.P", "radius = 0.5\naxis = -0.3"),
    ]
    .concat();
    for set in [&[][..], &[("disc.x", "4")], &[("disc.angle", "7")]] {
        placed(&disc, set);
    }
    let cart = [
        ground("O = [0, 0]"),
        body("cart", "A = [0, 0], B = [3, 0]"),
        body("front", "P = [0, 0]"),
        body("rear", "P = [0, 0]"),
        pin("A", "cart.A", "rear.P"),
        pin("B", "cart.B", "front.P"),
        joint("F", "rolling", "ground.O", "front.P", "radius = 0.5"),
        joint("R", "rolling", "ground.O", "rear.P", "radius = 0.5"),
    ]
    .concat();
    let (state, report) = start(&model(&cart), &[("cart.x", "2")], &[]);
    assert_eq!(report.degrees_of_freedom, 1);
    assert!((state.q[1] - 0.5).abs() < 1e-9 && state.q[2].abs() < 1e-9);
    let rocker = [
        ground("A = [0, 0], D = [4, 0]"),
        body("crank", "A = [0, 0], B = [1, 0]"),
        body("rocker", "D = [0, 0], C = [2, 0], E = [3, 1]"),
        body("plate", "E = [0, 0]"),
        pin("A", "ground.A", "crank.A"),
        pin("D", "ground.D", "rocker.D"),
        joint("rod", "distance", "crank.B", "rocker.C", "length = 3.5"),
        joint("W", "weld", "rocker.E", "plate.E", "angle = 0.2"),
    ]
    .concat();
    placed(&rocker, &[("crank.angle", "1.1")]);
}

/// Two wheels whose centres the mechanism holds at a distance, or on a carrier of their own each.
fn wheels(apart: &str, kind: &str, more: &str) -> String {
    let points = format!("A = [0, 0], B = [{apart}, 0]");
    [
        ground(&points),
        body("a", "P = [0, 0]"),
        body("b", "P = [0, 0]"),
        pin("A", "ground.A", "a.P"),
        pin("B", "ground.B", "b.P"),
        joint("G", kind, "a.P", "b.P", more),
    ]
    .concat()
}

#[test]
fn centres_at_another_distance_are_refused_with_the_distance() {
    for (apart, kind, more, told) in [
        (
            "0.31",
            "gear",
            "radii = [0.1, 0.2]",
            "joint G: the distance of the centres is 0.310000 m; must be 0.300000 m",
        ),
        ("0.3", "gear", "radii = [0.1, 0.2]\ninternal = true", "must be 0.100000 m"),
        (
            "0",
            "belt",
            "radii = [0.1, 0.2]",
            "joint G: the distance of the centres is 0.000000 m; must be > 0",
        ),
    ] {
        let failure = refused(&model(&wheels(apart, kind, more)), &[]);
        assert_eq!((failure.fault, failure.name.as_str()), (Fault::Open, "G"));
        assert!(failure.message.contains(told), "{failure}");
    }
    model(&wheels("0.3", "gear", "radii = [0.1, 0.2]"));
    start(&model(&wheels("0.31", "belt", "radii = [0.1, 0.2]")), &[], &[]);
}

#[test]
fn centres_that_nothing_holds_are_refused() {
    let slides = wheels("0.3", "belt", "radii = [0.1, 0.2]")
        .replace("[joints.B]\ntype = \"revolute\"", "[joints.B]\ntype = \"pin_in_slot\"");
    let failure = refused(&model(&slides), &[("b.x", "0.4")]);
    // held by what is set only
    assert!(
        failure.message.contains("joint G: the mechanism does not hold the distance"),
        "{failure}"
    );
}

#[test]
fn a_rack_beside_its_pinion_is_refused() {
    let rack = |radius: &str| {
        [
            ground("O = [0, 0], P = [0, 0.2]"),
            body("rack", "S = [0, 0]"),
            body("pinion", "P = [0, 0]"),
            joint("slide", "translational", "ground.O", "rack.S", ""),
            pin("P", "ground.P", "pinion.P"),
            joint("T", "rack", "rack.S", "pinion.P", &format!("radius = {radius}")),
        ]
        .concat()
    };
    placed(&rack("0.2"), &[("rack.x", "0.7")]);
    let failure = refused(&model(&rack("-0.2")), &[]);
    assert!(
        failure.message.contains("to its left, is 0.200000 m; must be -0.200000 m"),
        "{failure}"
    );
    assert!(failure.hint.contains("radius < 0"), "{failure}");
}

#[test]
fn fields_that_contradict_each_other_are_refused() {
    for (more, told) in [
        ("", "joints.G.radii: missing; give radii, or teeth and module"),
        ("radii = [1, 2]\nteeth = [10, 20]", "joints.G.teeth: not together with radii"),
        ("radii = [1, 2]\nmodule = 2", "joints.G.module: not together with radii"),
        ("teeth = [10, 20]", "joints.G.module: missing"),
        ("module = 0.1", "joints.G.teeth: missing"),
        ("teeth = [10.5, 20]\nmodule = 0.1", "joints.G.teeth: 10.5; must be whole numbers"),
        ("radii = [1, -2]", "joints.G.radii: -2 m; must be > 0"),
        ("radii = [2, 2]\ninternal = true", "joints.G.radii: internal wheels of equal radii"),
    ] {
        let faults = crate::mechanisms::faults(&wheels("3", "gear", more));
        assert!(faults.contains(told), "{more}: {faults}");
    }
}
