//! A first position with open loops: bodies at the angles of the guess, hung by their joints.
//!
//! What one writes down for Newton–Raphson by hand (Haug 4.2): each body hangs at its first joint to
//! a body that stands, in the order of the file, and the joint that would close the loop stays open.

use super::placement::legs;
use super::slides::slides;
use super::wishes::Wishes;
use crate::math::Pose;
use crate::model::Model;

/// Coordinates of all bodies, shape (n_q); angles that nobody asked for are zero, and so are places
/// of bodies that hang at nothing.
pub fn hang(model: &Model, wishes: &Wishes) -> Vec<f64> {
    let (legs, slides) = (legs(model), slides(model));
    let mut poses: Vec<Option<Pose>> = vec![None; model.bodies.len()];
    poses[0] = Some(Pose::identity());
    while let Some(first) = poses.iter().position(Option::is_none) {
        let hung = (first..poses.len()).filter(|b| poses[*b].is_none()).find_map(|b| {
            if let Some([x, y, angle]) = wishes.pose(b) {
                return Some((b, Pose::new(x, y, angle)));
            }
            let placed = |k: usize| poses[k].as_ref();
            let rail = slides[b].iter().find_map(|slide| slide.rail(placed(slide.other)?));
            let angle = wishes.value(b, 2).or(rail.as_ref().map(|r| r.pose.angle)).unwrap_or(0.0);
            let pin = legs[b].iter().find_map(|leg| Some((leg, placed(leg.other)?)));
            let Some((leg, other)) = pin else {
                return rail.map(|rail| (b, rail.towards(b, wishes)));
            };
            let mut pose = Pose::new(0.0, 0.0, angle);
            pose.r = other.point(leg.at_other) - pose.global(leg.own);
            Some((b, pose))
        });
        let (b, pose) = hung.unwrap_or_else(|| {
            let [x, y, angle] = [0, 1, 2].map(|c| wishes.value(first, c).unwrap_or(0.0));
            (first, Pose::new(x, y, angle))
        });
        poses[b] = Some(pose);
    }
    poses.iter().skip(1).flatten().flat_map(|p| [p.r.x, p.r.y, p.angle]).collect()
}
