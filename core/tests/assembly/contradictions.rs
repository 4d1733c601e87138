//! Drivers, driven joints and values of `set` that contradict each other are named.

use crate::mechanisms::{close, model, refused, FOUR_BAR, PENDULUM};
use kempe::analyses::assemble::{assemble, Fault, Request};

fn driver(name: &str, coordinate: &str, value: &str) -> String {
    format!("[drivers.{name}]\ntype = \"coordinate_driver\"\ncoordinate = \"{coordinate}\"\nvalue = \"{value}\"\n")
}

/// A rod of 1 m on a pin, with a rope of a spring from (2, 0) to its end.
fn rod(more: &[String]) -> String {
    let spring = "[forces.rope]\ntype = \"spring_damper\"\ni = \"ground.E\"\nj = \"rod.P\"\nstiffness = 1\nfree_length = 1\n";
    PENDULUM.replace("O = [0, 0] }\n", "O = [0, 0], E = [2, 0] }\n") + &more.concat() + spring
}

fn places(all: &[&[&str]]) -> Vec<Vec<String>> {
    all.iter().map(|path| path.iter().map(ToString::to_string).collect()).collect()
}

#[test]
fn two_laws_for_one_angle() {
    let m = model(&rod(&[driver("one", "rod.angle", "1"), driver("two", "pin.angle", "1.15")]));
    let failure = refused(&m, &[]);
    assert_eq!(failure.fault, Fault::Open);
    assert_eq!(
        failure.message,
        "driver one and driver two contradict each other: where driver one holds, driver two would have to change by 0.15 rad"
    );
    assert_eq!(failure.hint, "remove one of them");
    assert_eq!(failure.places, places(&[&["drivers", "one"], &["drivers", "two"]]));
    // the remedy
    let m = model(&rod(&[driver("two", "pin.angle", "1.15")]));
    let (state, _) = assemble(&m, &Request::default()).unwrap();
    close("angle", state.q[2], 1.15, 1e-12);
}

/// |P - E|² = 1 + 4 - 4 cos(angle).
#[test]
fn a_length_and_an_angle_of_one_freedom() {
    let length = (5.0 - 4.0 * 1.0_f64.cos()).sqrt();
    let laws = |length: f64| {
        [driver("turn", "pin.angle", "1"), driver("pull", "rope.length", &format!("{length:?}"))]
    };
    let failure = refused(&model(&rod(&laws(length + 0.2))), &[]);
    assert_eq!(
        failure.message,
        "driver turn and driver pull contradict each other: where driver turn holds, driver pull would have to change by 0.2 m"
    );
    close("gap", failure.gap, 0.2, 1e-12);
    // consistent drivers repeat each other
    let failure = refused(&model(&rod(&laws(length))), &[]);
    assert_eq!(failure.fault, Fault::Redundant, "{failure}");
    assert!(failure.message.contains("turn") && failure.message.contains("pull"), "{failure}");
}

#[test]
fn a_joint_with_a_law_of_time_and_a_driver() {
    let link = "[joints.link]\ntype = \"distance\"\ni = \"ground.E\"\nj = \"rod.P\"\nlength = \"1.5 + 0.1*t\"\n".to_string();
    let failure = refused(&model(&rod(&[link, driver("turn", "rod.angle", "1")])), &[]);
    let angle = (2.75_f64 / 4.0).acos();
    let missed = format!("driver turn would have to change by {:.3} rad", 1.0 - angle);
    assert!(failure.message.starts_with("joint link and driver turn contradict each other"));
    assert!(failure.message.ends_with(&missed), "{failure} {missed}");
}

#[test]
fn equal_positions_and_rates_with_other_accelerations() {
    let drivers = [driver("one", "rod.angle", "1 + t^2"), driver("two", "pin.angle", "1 + 2*t^2")];
    let failure = refused(&model(&rod(&drivers)), &[]);
    assert_eq!(failure.fault, Fault::Rates);
    assert_eq!(
        failure.message,
        "driver one and driver two contradict each other: where driver one holds, the acceleration of driver two would have to change by 2 rad/s²"
    );
    // the same motion, once as an angle and once as a length
    let laws = |more: &str| {
        let length = format!("sqrt(5 - 4*cos(1 + t)){more}");
        [driver("turn", "pin.angle", "1 + t"), driver("pull", "rope.length", &length)]
    };
    let failure = refused(&model(&rod(&laws(" + 0.3*t^2"))), &[]);
    assert!(
        failure
            .message
            .ends_with("the acceleration of driver pull would have to change by 0.6 m/s²"),
        "{failure}"
    );
    let failure = refused(&model(&rod(&laws(""))), &[]);
    assert_eq!(failure.fault, Fault::Redundant, "{failure}");
}

#[test]
fn equal_positions_with_other_rates() {
    let drivers = [driver("one", "rod.angle", "1 + t"), driver("two", "pin.angle", "1 + 3*t")];
    let failure = refused(&model(&rod(&drivers)), &[]);
    assert_eq!(failure.fault, Fault::Rates);
    assert_eq!(
        failure.message,
        "driver one and driver two contradict each other: where driver one holds, the rate of driver two would have to change by 2 rad/s"
    );
    let accepted = model(&rod(&drivers)).allowing_redundancy();
    let failure = assemble(&accepted, &Request::default()).unwrap_err();
    assert_eq!(failure.fault, Fault::Rates, "{failure}");
}

#[test]
fn a_driver_and_a_value_that_is_set() {
    let m = model(&rod(&[driver("turn", "rod.angle", "1 + 2*t")]));
    let failure = refused(&m, &[("pin.angle", "1.2")]);
    assert!(
        failure.message.ends_with("set pin.angle = 68.75494° would have to change by 0.2 rad"),
        "{failure}"
    );
    assert_eq!(failure.places, places(&[&["drivers", "turn"], &["start", "set", "pin.angle"]]));
    let failure = refused(&m, &[("pin.omega", "1.5")]);
    assert!(
        failure
            .message
            .ends_with("the rate of set pin.omega = 1.5 rad/s would have to change by 0.5 rad/s"),
        "{failure}"
    );
    assert!(failure.message.starts_with("driver turn and set pin.omega = 1.5 rad/s contradict"));
}

#[test]
fn a_driver_of_a_quantity_that_the_joints_hold() {
    let text = r#"
[bodies.slider]
mass = 1
inertia = 1
points = { S = [0, 0] }
[bodies.ground]
points = { S = [0, 0.5] }
[joints.slide]
type = "translational"
i = "ground.S"
j = "slider.S"
"#;
    let failure = refused(&model(&(text.to_string() + &driver("lift", "slider.y", "0.7"))), &[]);
    assert_eq!(
        failure.message,
        "joint slide and driver lift contradict each other: where joint slide holds, driver lift would have to change by 0.2 m"
    );
    assert_eq!(failure.hint, "remove driver lift: the joints leave it no freedom");
}

#[test]
fn an_angle_out_of_reach_is_no_contradiction() {
    // the rocker cannot reach 0.2 rad
    let failure = refused(&model(FOUR_BAR), &[("rocker.angle", "0.2")]);
    assert!(!failure.message.contains("contradict"), "{failure}");
    assert!(failure.message.contains("cannot close"), "{failure}");
}

#[test]
fn of_many_drivers_only_those_that_contradict_are_named() {
    let drivers = [
        driver("one", "free.x", "1"),
        driver("two", "rod.angle", "1"),
        driver("three", "free.y", "2"),
    ];
    let free = "[bodies.free]\nmass = 1\ninertia = 1\n".to_string();
    let last = driver("four", "pin.angle", "2");
    let failure = refused(&model(&rod(&[free, drivers.concat(), last])), &[]);
    assert!(
        failure.message.starts_with("driver two and driver four contradict each other"),
        "{failure}"
    );
}

/// The unit is that of the equation that is missed, not of the first equation of its joint.
#[test]
fn the_second_equation_of_a_joint_is_missed() {
    let joint = |name: &str, length: &str, angle: &str| {
        format!(
            "[joints.{name}]\ntype = 'constraint'\nresidual = ['{length}', 'a.angle - {angle} - t']\n\
             units = ['m', 'rad']\n"
        )
    };
    let body = "[bodies.a]\nmass = 1\ninertia = 1\n".to_string();
    let m = model(&(body + &joint("one", "a.x", "1") + &joint("two", "a.y", "1.15")));
    let failure = refused(&m, &[]);
    assert!(failure.message.ends_with("joint two would have to change by 0.15 rad"), "{failure}");
    assert_eq!(failure.gap, 0.0);
}
