//! The symbols of a drawing follow from the numbers of the model.

use crate::mechanisms::{close, model, with};
use kempe::elements::{Mark, SceneSymbol};
use kempe::model::Model;

const ALL: &str = r#"
[parameters]
k = 2
c = 3
[bodies.ground]
points = { O = [1, 2], Q = [5, 0] }
[bodies.bar]
type = "bar"
mass = 1
length = 2
ends = ["A", "B"]
[bodies.block]
mass = 1
inertia = 1
points = { P = [0, 0.5] }
[joints.pin]
type = "revolute"
i = "ground.O"
j = "bar.A"
[joints.slide]
type = "translational"
i = "ground.Q"
j = "block.P"
axes = [0.3, 0.1]
[joints.rod]
type = "distance"
i = "bar.B"
j = "block.P"
length = 3
[drivers.turn]
type = "coordinate_driver"
coordinate = "bar.angle"
value = "t"
[drivers.shift]
type = "coordinate_driver"
coordinate = "block.y"
value = "t"
[forces.line]
type = "spring_damper"
i = "ground.Q"
j = "bar.B"
stiffness = "k"
damping = "c"
[forces.spiral]
type = "torsion_spring"
i = "ground"
j = "bar"
stiffness = "k"
damping = "c"
[forces.still]
type = "torque"
j = "bar"
torque = 0
[forces.varying]
type = "torque"
j = "bar"
torque = "max(0, t)"
"#;

fn of(model: &Model, name: &str) -> Vec<SceneSymbol> {
    model.symbols().into_iter().find(|(element, _)| *element == name).expect("it is there").1
}

fn marks(model: &Model, name: &str) -> Vec<Mark> {
    of(model, name).iter().map(|symbol| symbol.mark).collect()
}

#[test]
fn every_element_has_the_symbol_of_its_physics() {
    let m = model(ALL);
    assert_eq!(marks(&m, "pin"), [Mark::Pin]);
    assert_eq!(marks(&m, "slide"), [Mark::Slide]);
    assert_eq!(marks(&m, "rod"), [Mark::Rod]);
    assert_eq!(marks(&m, "turn"), [Mark::DriveTurn]);
    assert_eq!(marks(&m, "shift"), [Mark::DriveShift]);
    assert_eq!(marks(&m, "line"), [Mark::Spring, Mark::Dashpot]);
    assert_eq!(marks(&m, "spiral"), [Mark::SpiralSpring, Mark::RotaryDashpot]);
    assert_eq!(marks(&m, "still"), []);
    assert_eq!(marks(&m, "varying"), [Mark::TorqueArrow]);
}

#[test]
fn a_coefficient_of_zero_has_no_symbol() {
    let (spring, damper) = (with(ALL, &[("c", 0.0)]), with(ALL, &[("k", 0.0)]));
    assert_eq!(marks(&spring, "line"), [Mark::Spring]);
    assert_eq!(marks(&spring, "spiral"), [Mark::SpiralSpring]);
    assert_eq!(marks(&damper, "line"), [Mark::Dashpot]);
    assert_eq!(marks(&damper, "spiral"), [Mark::RotaryDashpot]);
}

#[test]
fn ends_are_the_points_and_axes_of_the_element() {
    let m = model(ALL);
    let [slide] = &of(&m, "slide")[..] else { panic!("one symbol") };
    let (on_ground, on_block) = (slide.i.point.unwrap(), slide.j.point.unwrap());
    assert_eq!([slide.i.body.0, slide.j.body.0], [0, 2]);
    assert_eq!([on_ground.x, on_ground.y, on_block.x, on_block.y], [5.0, 0.0, 0.0, 0.5]);
    close("axis of i", slide.i.axis, 0.3, 0.0);
    close("axis of j", slide.j.axis, 0.1, 0.0);
    let [shift] = &of(&m, "shift")[..] else { panic!("one symbol") };
    close("y", shift.i.axis, std::f64::consts::FRAC_PI_2, 0.0);
    let [turn] = &of(&m, "turn")[..] else { panic!("one symbol") };
    assert_eq!((turn.j.body.0, turn.j.point), (1, None));
}
