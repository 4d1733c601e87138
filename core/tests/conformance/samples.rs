//! One or more samples of each element, and random motions to look at them.

use crate::mechanisms::Random;
use kempe::elements::drivers::CoordinateDriver;
use kempe::elements::forces::TorsionSpring;
use kempe::elements::joints::{Revolute, Translational};
use kempe::elements::{
    catalogue, BodyId, Constraint, Coordinate, CoordinateOf, ForceElement, Group, PointOn,
};
use kempe::math::{Local, Motion, Pose, Real, Twist, Vec2};

fn on(body: usize, x: f64, y: f64) -> PointOn {
    PointOn { body: BodyId(body), s: Local::new(x, y) }
}

/// Joints and drivers; drivers act from ground.
pub fn constraints() -> Vec<Constraint> {
    let driven = |coordinate| CoordinateOf { body: BodyId(2), coordinate };
    let mut all = vec![
        Constraint::Revolute(Revolute {
            i: on(1, 0.3, -0.7),
            j: on(2, -1.1, 0.4),
            axes: [0.2, -0.5],
        }),
        Constraint::Translational(Translational {
            i: on(1, -0.4, 0.2),
            j: on(2, 0.5, 0.9),
            axes: [0.7, -0.3],
        }),
    ];
    for (coordinate, value) in
        [(Coordinate::X, 0.4), (Coordinate::Y, -1.3), (Coordinate::Angle, 2.1)]
    {
        let driver = CoordinateDriver { coordinate: driven(coordinate), value };
        all.push(Constraint::CoordinateDriver(driver));
    }
    all
}

/// Forces.
pub fn forces() -> Vec<ForceElement> {
    vec![ForceElement::TorsionSpring(TorsionSpring {
        i: BodyId(1),
        j: BodyId(2),
        stiffness: 3.5,
        damping: 0.8,
        free_angle: 0.6,
    })]
}

/// A motion over any scalar.
pub fn motion<S: Real>([x, y, angle, vx, vy, omega]: [S; 6]) -> Motion<S> {
    Motion { pose: Pose::new(x, y, angle), twist: Twist { velocity: Vec2::new(vx, vy), omega } }
}

/// Random coordinates and rates of one body, each within 2.
pub fn random(random: &mut Random) -> [f64; 6] {
    std::array::from_fn(|_| 2.0 * random.next())
}

/// Those of body i of a constraint: at rest in the origin if that is ground.
pub fn of_end(body: BodyId, random_state: [f64; 6]) -> [f64; 6] {
    if body.is_ground() {
        [0.0; 6]
    } else {
        random_state
    }
}

/// The state after `h` along the motion with constant rates.
pub fn later(s: [f64; 6], h: f64) -> [f64; 6] {
    std::array::from_fn(|k| if k < 3 { s[k] + h * s[k + 3] } else { s[k] })
}

#[test]
fn every_element_of_the_catalogue_has_a_sample() {
    for (group, table) in catalogue() {
        let sampled = match group {
            Group::Forces => forces().iter().any(|f| f.kind() == table.name),
            _ => constraints().iter().any(|c| c.kind() == table.name),
        };
        assert!(sampled, "{} has no sample", table.name);
    }
}
