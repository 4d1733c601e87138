//! A curve through points: a spline over the accumulated chord length.
//!
//! In WebAssembly, where the size of the program matters, the spline is computed over numbers for every scalar,
//! because no analysis there computes derivatives with respect to parameters. Elsewhere, it is a spline over the
//! scalar.

use crate::math::{Interpolation, Local, Real, Spline};
use std::sync::OnceLock;

/// The scalar of the spline of a curve over `S`.
#[cfg(not(target_arch = "wasm32"))]
type Kept<S> = S;
#[cfg(target_arch = "wasm32")]
type Kept<S> = <f64 as InPlaceOf<S>>::Number;

/// A number that replaces any scalar.
#[cfg(target_arch = "wasm32")]
trait InPlaceOf<S> {
    type Number;
}
#[cfg(target_arch = "wasm32")]
impl<S> InPlaceOf<S> for f64 {
    type Number = Self;
}

/// A spline through points.
#[derive(Clone, Debug)]
pub struct CurvePoints<S = f64> {
    /// The points, m.
    pub points: Vec<Local<S>>,
    /// The interpolation between the points.
    pub kind: Interpolation,
    /// Whether the last point is joined to the first.
    pub periodic: bool,
    solved: OnceLock<Box<[Spline<Kept<S>>; 2]>>,
}

impl<S> CurvePoints<S> {
    /// A spline that is solved at its first use.
    pub fn new(points: Vec<Local<S>>, kind: Interpolation, periodic: bool) -> Self {
        Self { points, kind, periodic, solved: OnceLock::new() }
    }

    /// The same over another scalar.
    pub(super) fn map<T>(&self, f: &mut dyn FnMut(&S) -> T) -> CurvePoints<T> {
        let points = self.points.iter().map(|s| Local { x: f(&s.x), y: f(&s.y) }).collect();
        let mut mapped = CurvePoints::new(points, self.kind, self.periodic);
        if let Some([x, y]) = self.solved.get().map(|solved| &**solved) {
            mapped.solved = Box::new([taken(x, f), taken(y, f)]).into();
        }
        mapped
    }
}

#[cfg(not(target_arch = "wasm32"))]
fn taken<S, T>(spline: &Spline<S>, f: &mut dyn FnMut(&S) -> T) -> Spline<T> {
    spline.map(f)
}
#[cfg(target_arch = "wasm32")]
fn taken<S, T>(spline: &Spline, _: &mut dyn FnMut(&S) -> T) -> Spline {
    spline.clone()
}

#[cfg(not(target_arch = "wasm32"))]
fn number<S: Real>(x: S) -> S {
    x
}
#[cfg(target_arch = "wasm32")]
fn number<S: Real>(x: S) -> f64 {
    x.in_lanes()[0]
}

#[cfg(not(target_arch = "wasm32"))]
fn lifted<S: Real>(x: S) -> S {
    x
}
#[cfg(target_arch = "wasm32")]
fn lifted<S: Real>(x: f64) -> S {
    S::constant(x)
}

impl<S: Real> CurvePoints<S> {
    /// x and y over the chord length.
    fn splines(&self) -> &[Spline<Kept<S>>; 2] {
        self.solved.get_or_init(|| {
            let closing = self.points.first().filter(|_| self.periodic);
            let all = self.points.iter().chain(closing);
            let all: Vec<Local<Kept<S>>> =
                all.map(|s| Local::new(number(s.x), number(s.y))).collect();
            let mut chord = vec![<Kept<S> as Real>::zero()];
            for pair in all.windows(2) {
                let step = Local::new(pair[1].x - pair[0].x, pair[1].y - pair[0].y).norm();
                chord.push(chord[chord.len() - 1] + step);
            }
            let along = |component: fn(&Local<Kept<S>>) -> Kept<S>| {
                let values: Vec<Kept<S>> = all.iter().map(component).collect();
                Spline::new(self.kind, self.periodic, &chord, &values)
            };
            Box::new([along(|s| s.x), along(|s| s.y)])
        })
    }

    /// The ends of u.
    pub(super) fn range(&self) -> [S; 2] {
        let knots = self.splines()[0].knots();
        [lifted(knots[0]), lifted(knots[knots.len() - 1])]
    }

    /// The values of u at the points.
    pub(super) fn knots(&self) -> Vec<f64> {
        self.splines()[0].knots().iter().map(|u| u.in_lanes()[0]).collect()
    }

    /// C, C′, C″ and C‴ at u.
    pub(super) fn derivatives(&self, u: S) -> [Local<S>; 4] {
        let [x, y] = self.splines().each_ref().map(|s| s.derivatives::<S, 4>(u, lifted));
        std::array::from_fn(|n| Local::new(x[n], y[n]))
    }
}
