//! A curve through points: a spline over the accumulated chord length.
//!
//! The spline is solved over the [base](crate::math::OverBase) of the scalar, once for all scalars with this base.

use crate::math::{indexed, Interpolation, Listed, Local, Real, Spline};
use std::any::Any;
use std::sync::{Arc, OnceLock};

/// A spline through points.
#[derive(Clone, Debug)]
pub struct CurvePoints<S = f64> {
    /// The points, m.
    pub points: Vec<Local<S>>,
    /// The interpolation between the points.
    pub kind: Interpolation,
    /// Whether the last point is joined to the first.
    pub periodic: bool,
    /// x and y over the base of the scalar.
    solved: OnceLock<Splines>,
    /// The solution of the curve from which this one was converted; it may have another base.
    before: Option<Splines>,
}

/// `Both` over some base.
type Splines = Arc<dyn Any + Send + Sync>;
/// The splines of x and y.
type Both<S> = [Spline<S>; 2];

impl<S> CurvePoints<S> {
    /// A spline that is solved at its first use.
    pub fn new(points: Vec<Local<S>>, kind: Interpolation, periodic: bool) -> Self {
        Self { points, kind, periodic, solved: OnceLock::new(), before: None }
    }

    /// The same over another scalar. `f` keeps the values, unless it changes the base of the scalar.
    pub(super) fn map<T>(&self, f: &mut dyn FnMut(&S) -> T) -> CurvePoints<T> {
        let points = self.points.iter().map(|s| Local { x: f(&s.x), y: f(&s.y) }).list();
        let before = self.solved.get().or(self.before.as_ref()).cloned();
        CurvePoints { before, ..CurvePoints::new(points, self.kind, self.periodic) }
    }
}

impl<S: Real> CurvePoints<S> {
    /// x and y over the chord length.
    fn splines(&self) -> &Both<S::Base> {
        let known = self.before.as_ref().and_then(|before| before.downcast_ref());
        known.unwrap_or_else(|| {
            let solved = self.solved.get_or_init(|| {
                let base = |s: &Local<S>| Local::new(s.x.base(), s.y.base());
                let points = self.points.iter().map(base).list();
                Arc::new(through::<S::Base>(points, self.kind, self.periodic))
            });
            solved.downcast_ref().expect("splines over the base")
        })
    }

    /// x and y over the chord length as numbers, if they are known and the points have no derivatives. They need not
    /// be solved for a scalar with derivatives that concern other quantities.
    fn numbers(&self) -> Option<&Both<f64>> {
        let known = self.before.as_ref()?.downcast_ref()?;
        self.points.iter().all(|s| s.x.is_constant() && s.y.is_constant()).then_some(known)
    }

    /// The ends of u.
    pub(super) fn range(&self) -> [S; 2] {
        if let Some([x, _]) = self.numbers() {
            return ends(x.knots(), S::constant);
        }
        ends(self.splines()[0].knots(), S::of_base)
    }

    /// The values of u at the points.
    pub(super) fn knots(&self) -> Vec<f64> {
        match self.numbers() {
            Some([x, _]) => x.knots().to_vec(),
            None => self.splines()[0].knots().iter().map(|u| u.in_lanes()[0]).list(),
        }
    }

    /// C, C′, C″ and C‴ at u.
    pub(super) fn derivatives(&self, u: S) -> [Local<S>; 4] {
        if let Some([x, y]) = self.numbers() {
            return together(x.derivatives(u, S::constant), y.derivatives(u, S::constant));
        }
        let [x, y] = self.splines();
        together(x.derivatives(u, S::of_base), y.derivatives(u, S::of_base))
    }
}

fn ends<B: Copy, S>(knots: &[B], lift: fn(B) -> S) -> [S; 2] {
    [lift(knots[0]), lift(knots[knots.len() - 1])]
}

fn together<S: Real>(x: [S; 4], y: [S; 4]) -> [Local<S>; 4] {
    indexed(|n| Local::new(x[n], y[n]))
}

/// The splines of x and y through points.
fn through<B: Real>(mut points: Vec<Local<B>>, kind: Interpolation, periodic: bool) -> Both<B> {
    if periodic {
        points.extend(points.first().copied());
    }
    let mut chord = vec![B::zero()];
    for pair in points.windows(2) {
        let step = Local::new(pair[1].x - pair[0].x, pair[1].y - pair[0].y).norm();
        chord.push(chord[chord.len() - 1] + step);
    }
    let (mut x, mut y) = (Vec::new(), Vec::new());
    for point in &points {
        x.push(point.x);
        y.push(point.y);
    }
    [Spline::new(kind, periodic, &chord, &x), Spline::new(kind, periodic, &chord, &y)]
}
