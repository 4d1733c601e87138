//! Stops and contacts with restitution that a driven motion must not pass, and the ends of curves.
//!
//! Between two points, the motion is their [polynomial](Quintic). The bounds of the gaps show where all of them stay
//! open, so that no obstacle is passed, however thin it is.

use super::quintic::Quintic;
use super::solution::Point;
use crate::analyses::curves::Ranges;
use crate::analyses::rigid::RigidContacts;
use crate::analyses::step_part::{self, StepPart};
use crate::integrate::{scan, Bounds, Direction, Interpolant, Step, StepPath, Watch};
use crate::math::{Listed, Real};
use crate::model::Model;

/// All barriers of a model.
#[derive(Clone, Debug)]
pub(super) struct Barriers {
    contacts: RigidContacts,
    curves: Ranges,
}

impl Barriers {
    pub fn of(model: &Model) -> Self {
        Self { contacts: RigidContacts::of(model), curves: Ranges::of(model) }
    }

    /// The first stop or contact beyond which a position is: its name and its gap.
    pub fn contact_beyond(&self, model: &Model, t: f64, q: &[f64]) -> Option<(String, f64)> {
        self.contacts.beyond(model, t, q)
    }

    /// A description of the first barrier beyond which a position is.
    pub fn beyond(&self, model: &Model, t: f64, q: &[f64]) -> Option<String> {
        let touched =
            self.contact_beyond(model, t, q).map(|(name, _)| format!("{name} is reached"));
        let left = || self.curves.beyond(model, q);
        touched.or_else(|| left().map(|(name, _)| format!("{name} is at the end of its curve")))
    }

    /// Whether a position is within all barriers.
    pub fn allow(&self, model: &Model, t: f64, q: &[f64]) -> bool {
        self.contacts.allow(model, t, q) && self.curves.beyond(model, q).is_none()
    }

    /// The time at which the polynomial between two points first passes a barrier, or the end of the step if that is
    /// not decided. None if it passes none.
    pub fn passed(&self, model: &Model, from: &Point, to: &Point) -> Option<f64> {
        let count = self.contacts.forces().len() + self.curves.count();
        if count == 0 {
            return None;
        }
        let stages = Quintic::new(from, to).stages();
        let step = Step {
            t_old: from.t,
            t: to.t,
            y_old: &from.q,
            y: &to.q,
            dy_old: &from.v,
            dy: &to.v,
            interpolant: Interpolant::quintic(&stages, from.q.len()),
        };
        let mut margins = BarrierMargins { barriers: self, model };
        let parts = step_part::parts(model, &step);
        let path = StepPath::new(&step);
        let found = scan(&path, (count, parts), &mut margins, Direction::Falling, &|_| None);
        let Ok(found) = found else { return Some(to.t) };
        let first = found.first.first().map(|crossing| crossing.t);
        first.or((!found.negative.is_empty()).then_some(to.t))
    }
}

/// How far a position is within each barrier: first the contacts, then the curves.
struct BarrierMargins<'b> {
    barriers: &'b Barriers,
    model: &'b Model,
}

impl Watch for BarrierMargins<'_> {
    fn values(&mut self, t: f64, y: &[f64], some: &[usize], out: &mut [f64]) {
        let Barriers { contacts, curves } = self.barriers;
        let n = contacts.forces().len();
        let closed = some.iter().copied().filter(|index| *index < n).list();
        let margins = contacts.margins(self.model, (t, y), &closed);
        closed.iter().zip(margins).for_each(|(index, margin)| out[*index] = margin);
        for index in some.iter().filter(|index| **index >= n) {
            out[*index] = curves.margin(index - n, |column| y[column]);
        }
    }

    fn bounds(&mut self, index: usize, path: &StepPath<'_>, span: [f64; 2]) -> Option<Bounds> {
        let Barriers { contacts, curves } = self.barriers;
        let part = StepPart::new(self.model, path, span, &[]);
        match index.checked_sub(contacts.forces().len()) {
            None => {
                let slack = Bounds::constant(contacts.slack(index));
                Some(part.apart(contacts.forces()[index], None)? + slack)
            }
            Some(k) => Some(curves.margin(k, |column| part.column(column, false))),
        }
    }

    fn converges(&self, index: usize) -> bool {
        index < self.barriers.contacts.forces().len()
    }
}
