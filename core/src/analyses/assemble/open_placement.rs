//! A first position with open loops: bodies have the angles of the guess and are placed by their joints.
//!
//! This is the usual first guess for Newton–Raphson by hand (Haug 4.2). In the order of the file, each body is placed
//! at its first joint to a placed body. The joint that would close the loop remains open.

use super::legs::legs;
use super::slider_placement::slides;
use super::targets::Targets;
use crate::equations::kinematics;
use crate::math::{each, Listed, Pose};
use crate::model::Model;

/// Coordinates of all bodies, shape (n_q). Angles without a request are zero, as are positions of bodies without a
/// joint to a placed body.
pub fn open_placement(model: &Model, targets: &Targets) -> Vec<f64> {
    let (legs, slides) = (legs(model), slides(model));
    let mut poses: Vec<Option<Pose>> = vec![None; model.bodies.len()];
    poses[0] = Some(Pose::identity());
    while let Some(first) = poses.iter().position(Option::is_none) {
        let hung = (first..poses.len()).filter(|b| poses[*b].is_none()).find_map(|b| {
            if let Some([x, y, angle]) = targets.pose(b) {
                return Some((b, Pose::new(x, y, angle)));
            }
            let placed = |k: usize| poses[k].as_ref();
            let rail = slides[b].iter().find_map(|slide| slide.rail(placed(slide.other)?));
            let angle = targets.value(b, 2).or(rail.as_ref().map(|r| r.pose.angle)).unwrap_or(0.0);
            let pin = legs[b].iter().find_map(|leg| Some((leg, placed(leg.other)?)));
            let Some((leg, other)) = pin else {
                return rail.map(|rail| (b, rail.towards(b, targets)));
            };
            let mut pose = Pose::new(0.0, 0.0, angle);
            pose.r = other.point(leg.at_other) - pose.global(leg.own);
            Some((b, pose))
        });
        let (b, pose) = hung.unwrap_or_else(|| {
            let [x, y, angle] = each([0, 1, 2], |c| targets.value(first, c).unwrap_or(0.0));
            (first, Pose::new(x, y, angle))
        });
        poses[b] = Some(pose);
    }
    let poses: Vec<Pose> = poses.into_iter().flatten().list();
    kinematics::coordinates(model, &poses)
}
