//! Dragging: the position of a mechanism in which a point of a body is as close as possible to a target.
//!
//! Let K = [W Φ_qᵀ; Φ_q 0], and let J be the Jacobian of the point. If W were the mass matrix, Y = K⁻¹ [Jᵀ; 0] would
//! contain the motions under unit forces at the point, and G = J Y (2 × 2) the motions of the point. A step Y (G + μ
//! 1)⁻¹ r moves the point by the remaining vector r to the target, as far as the constraints allow. Newton's method
//! then closes the mechanism. Steps are short, so that the mechanism stays on its branch.
//!
//! The point of a mechanism with one degree of freedom moves on a path. At a dead point, its velocity along the path
//! changes sign. A step across a dead point is refused, because the way back would lead to the other branch.

use super::closing::Closing;
use super::kinematics::in_line;
use crate::elements::BodyId;
use crate::equations::kinematics::Motions;
use crate::math::{each, Listed, Local, Vec2};
use crate::model::Model;

/// Largest number of steps.
const MOST_STEPS: usize = 100;
/// Longest step: the root of the sum of squares over the coordinates, with lengths relative to the size of the
/// mechanism.
const LONGEST: f64 = 0.1;
/// Steps below this length count as zero.
const NO_STEP: f64 = 1e-9;
/// Largest correction by the closing, as a fraction of the step.
const CORRECTION: f64 = 0.3;
/// Least cosine between the directions of the path before and after a step.
const TURN: f64 = 0.9;
/// Values of μ, relative to the larger eigenvalue of G. Later values are used where earlier values make no progress:
/// at the end of its reach, the point of an arm can only move across the arm.
const SOFT: [f64; 4] = [1e-7, 1e-4, 1e-2, 1.0];
/// Relative difference of distances that count as equal.
const SAME: f64 = 1e-10;
/// Smallest accepted fraction of the predicted progress.
const PROGRESS: f64 = 0.1;
/// Number of times that a step along a path is halved.
const HALVINGS: usize = 16;
/// Number of times that any other step is halved.
const FEW: usize = 3;

/// The point that is dragged.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grip {
    /// Its body.
    pub body: BodyId,
    /// The point in the frame of the body, m.
    pub point: Local,
    /// Degrees of freedom of the mechanism.
    pub degrees_of_freedom: usize,
}

/// The result of dragging.
#[derive(Clone, Debug, PartialEq)]
pub struct Dragged {
    /// The position, shape (n_q).
    pub q: Vec<f64>,
    /// Distance of the point from the target, m.
    pub distance: f64,
    /// The dead point that ends the motion, if there is one.
    pub dead_point: Option<DeadPoint>,
}

/// A dead point that the dragged point cannot pass.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DeadPoint {
    /// Two bodies that are in line there, if any.
    pub in_line: Option<[String; 2]>,
}

/// Moves the point towards `target` from the closed position `q`. The constraints are evaluated at time `t`.
///
/// None if `q` is singular and no motion can be computed there.
pub fn drag(model: &Model, t: f64, q: &[f64], grip: Grip, target: Vec2) -> Option<Dragged> {
    let mut hand = Hand { model, grip, closing: Closing::new(model, t, &|| false), target };
    let mut place = hand.place(q.to_vec())?;
    let (single, mut level, mut dead_point) = (grip.degrees_of_freedom == 1, 0, None);
    for _ in 0..MOST_STEPS {
        if hand.length(&place.step((!single).then_some(SOFT[0]))) <= NO_STEP {
            break;
        }
        // a path leaves no choice of direction, but needs short steps at its end
        let outcome = match single {
            true => hand.advance(&place, None, HALVINGS),
            false => hand.advance_softly(&place, &mut level),
        };
        match outcome {
            Ok(next) => place = next,
            Err(blocked) => {
                let path = place.path(&hand).filter(|_| blocked);
                let in_line = |path: FreeDirection| in_line(model, &place.q, &path.rates);
                dead_point = path.map(|path| DeadPoint { in_line: in_line(path) });
                break;
            }
        }
    }
    Some(Dragged { distance: place.way.norm(), q: place.q, dead_point })
}

/// The dragged point and its target.
struct Hand<'a> {
    model: &'a Model,
    grip: Grip,
    closing: Closing<'a>,
    target: Vec2,
}

impl Hand<'_> {
    /// Length of a step: the square root of xᵀ W x.
    fn length(&self, x: &[f64]) -> f64 {
        self.closing.product(x, x).sqrt()
    }

    fn place(&mut self, q: Vec<f64>) -> Option<DragState> {
        let layout = &self.model.layout;
        let motions = Motions::at_rest(layout, &q);
        let pose = motions[self.grip.body.0].pose;
        let lever = pose.global(self.grip.point).perp();
        let columns = layout.bodies[self.grip.body.0].range();
        let row = |own: [f64; 3]| {
            let mut row = vec![0.0; layout.n_q];
            row[columns.clone()].iter_mut().zip(own).for_each(|(x, own)| *x = own);
            row
        };
        let jacobian = [row([1.0, 0.0, lever.x]), row([0.0, 1.0, lever.y])];
        let motions = self.closing.motions_under(&q, &jacobian)?;
        let g = each([0, 1], |i| each([0, 1], |j| dot(&jacobian[i], &motions[j])));
        let g = [g[0][0], 0.5 * (g[0][1] + g[1][0]), g[1][1]];
        Some(DragState { way: self.target - pose.point(self.grip.point), q, jacobian, motions, g })
    }

    /// The next state of a point that can move in several directions, starting with the level of μ that worked last.
    fn advance_softly(&mut self, place: &DragState, level: &mut usize) -> Result<DragState, bool> {
        for (k, soft) in SOFT.iter().enumerate().skip(*level) {
            if let Ok(next) = self.advance(place, Some(*soft), FEW) {
                *level = k.saturating_sub(1);
                return Ok(next);
            }
        }
        Err(false)
    }

    /// The state after the largest fraction of a step that leads closer to the target on the same branch. Otherwise,
    /// whether a dead point is in the way.
    fn advance(
        &mut self,
        place: &DragState,
        soft: Option<f64>,
        halvings: usize,
    ) -> Result<DragState, bool> {
        let (step, path) = (place.step(soft), place.path(self));
        let whole = self.length(&step);
        let (mut part, mut blocked) = (1.0_f64.min(LONGEST / whole), false);
        for _ in 0..halvings {
            let predicted: Vec<f64> = place.q.iter().zip(&step).map(|(q, dq)| q + part * dq).list();
            if let Some(next) = self.closed(&predicted, CORRECTION * part * whole) {
                let course = match path.as_ref().zip(next.path(self)) {
                    Some((old, new)) => old.follows(&new, &self.closing),
                    None => PathRelation::Ahead,
                };
                blocked |= course == PathRelation::Back;
                if course == PathRelation::Ahead
                    && next.is_better(place, part * place.progress(&step))
                {
                    return Ok(next);
                }
            }
            part *= 0.5;
        }
        Err(blocked)
    }

    /// The closed position near a predicted position. None if it is farther away than `most`.
    fn closed(&mut self, predicted: &[f64], most: f64) -> Option<DragState> {
        let mut next = predicted.to_vec();
        let (_, closed) = self.closing.close(&mut next);
        let change: Vec<f64> = next.iter().zip(predicted).map(|(a, b)| a - b).list();
        if !closed || self.length(&change) > most {
            return None;
        }
        self.place(next)
    }
}

/// A position, with the motions that forces at the dragged point cause there.
struct DragState {
    q: Vec<f64>,
    /// The vector r from the point to the target, m.
    way: Vec2,
    /// J, one row for each axis.
    jacobian: [Vec<f64>; 2],
    /// Y, one motion for each axis.
    motions: [Vec<f64>; 2],
    /// G: xx, xy, yy.
    g: [f64; 3],
}

impl DragState {
    /// The larger eigenvalue of G, and its direction.
    fn principal(&self) -> (f64, Vec2) {
        let [xx, xy, yy] = self.g;
        let half = 0.5 * (xx - yy);
        let angle = 0.5 * xy.atan2(half);
        (0.5 * (xx + yy) + half.hypot(xy), Vec2::new(angle.cos(), angle.sin()))
    }

    /// rᵀ G r: zero where the distance has an extreme.
    fn drive(&self) -> f64 {
        let ([xx, xy, yy], Vec2 { x, y }) = (self.g, self.way);
        xx * x * x + 2.0 * xy * x * y + yy * y * y
    }

    /// The first-order approach to the target in a step, relative to the distance.
    fn progress(&self, step: &[f64]) -> f64 {
        let moved = Vec2::new(dot(&self.jacobian[0], step), dot(&self.jacobian[1], step));
        self.way.dot(moved) / self.way.dot(self.way)
    }

    /// Whether the state is closer to the target by a fair part of the prediction, or equally close but nearer to an
    /// extreme.
    fn is_better(&self, before: &Self, predicted: f64) -> bool {
        let [now, then] = [self.way.norm(), before.way.norm()];
        let nearer = now < (1.0 - SAME.max(PROGRESS * predicted)) * then;
        nearer || ((now - then).abs() <= SAME * then && self.drive() < before.drive())
    }

    /// Y (G + μ 1)⁻¹ r, with μ relative to the larger eigenvalue of G. Without μ, only the direction of this
    /// eigenvalue is used, because G has rank one.
    fn step(&self, soft: Option<f64>) -> Vec<f64> {
        let Some(soft) = soft else {
            let (larger, direction) = self.principal();
            return self.along(direction.scale(direction.dot(self.way) / larger));
        };
        let soft = soft * self.principal().0.max(f64::MIN_POSITIVE);
        let ([xx, xy, yy], r) = ([self.g[0] + soft, self.g[1], self.g[2] + soft], self.way);
        let det = xx * yy - xy * xy;
        let force = Vec2::new((yy * r.x - xy * r.y) / det, (xx * r.y - xy * r.x) / det);
        self.along(force)
    }

    fn along(&self, force: Vec2) -> Vec<f64> {
        let pairs = self.motions[0].iter().zip(&self.motions[1]);
        pairs.map(|(x, y)| force.x * x + force.y * y).list()
    }

    /// The path of a mechanism with one degree of freedom.
    fn path(&self, hand: &Hand<'_>) -> Option<FreeDirection> {
        if hand.grip.degrees_of_freedom != 1 {
            return None;
        }
        let mut rates = self.along(self.principal().1);
        let length = hand.length(&rates);
        rates.iter_mut().for_each(|x| *x /= length);
        let velocity = Vec2::new(dot(&self.jacobian[0], &rates), dot(&self.jacobian[1], &rates));
        (length > 0.0).then_some(FreeDirection { rates, velocity })
    }
}

/// The direction in which a mechanism with one degree of freedom moves.
struct FreeDirection {
    /// Rates of all coordinates along the path, of unit length.
    rates: Vec<f64>,
    /// Velocity of the dragged point.
    velocity: Vec2,
}

/// How a path continues another path.
#[derive(Clone, Copy, PartialEq)]
enum PathRelation {
    Ahead,
    /// The point moves back along its own path.
    Back,
    /// The path is a different path.
    Aside,
}

impl FreeDirection {
    fn follows(&self, next: &Self, closing: &Closing<'_>) -> PathRelation {
        let cosine = closing.product(&self.rates, &next.rates);
        if cosine.abs() < TURN {
            return PathRelation::Aside;
        }
        match cosine.signum() * self.velocity.dot(next.velocity) < 0.0 {
            true => PathRelation::Back,
            false => PathRelation::Ahead,
        }
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
