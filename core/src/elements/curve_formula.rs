//! A curve whose components are formulas in u and the parameters.
//!
//! The formulas are evaluated over series in u whose coefficients are the [base](crate::math::OverBase) of the scalar.
//! The derivatives that the scalar adds follow from the higher derivatives by u.

use super::quantity_kind::QuantityKind;
use crate::expression::{switch_places, Knots, Symbol, Tape, Values};
use crate::math::{compose, indexed, Lift, Listed, Local, Real, TaylorSeries};
use std::sync::{Arc, Mutex, PoisonError};

/// x(u) and y(u).
#[derive(Clone, Debug)]
pub struct Formula<S = f64> {
    written: Arc<FormulaPair>,
    /// Values of the parameters that the formulas use.
    values: Vec<S>,
    /// The ends of u.
    pub range: [S; 2],
    /// Whether the curve repeats periodically beyond these ends.
    pub periodic: bool,
    /// What u measures.
    pub kind: QuantityKind,
}

/// The numbers for which the breaks of a curve were searched, and the breaks.
type Found = (Vec<f64>, Option<Arc<Knots>>);

/// The formulas, and the indices of the parameters that they use.
#[derive(Debug)]
struct FormulaPair {
    x: Tape,
    y: Tape,
    parameters: Vec<usize>,
    /// The latest breaks, for the range and the parameters.
    breaks: Mutex<Option<Found>>,
}

impl Formula<Tape> {
    /// A curve from formulas in the parameters of a model and in u, the only variable, which has no unit.
    pub fn new(x: Tape, y: Tape, range: [Tape; 2], periodic: bool) -> Self {
        let mut parameters: Vec<usize> = x.parameters().chain(y.parameters()).list();
        parameters.sort_unstable();
        parameters.dedup();
        let values = parameters.iter().map(|k| Tape::of(Symbol::Parameter(*k))).list();
        Self {
            written: Arc::new(FormulaPair { x, y, parameters, breaks: Mutex::default() }),
            values,
            range,
            periodic,
            kind: QuantityKind::Pure,
        }
    }

    /// A curve from a formula of the radius, with u as the polar angle.
    pub fn polar(self) -> Self {
        Self { kind: QuantityKind::Angle, ..self }
    }
}

impl<S> Formula<S> {
    /// The same curve over another scalar.
    pub(super) fn map<T>(&self, f: &mut dyn FnMut(&S) -> T) -> Formula<T> {
        Formula {
            written: Arc::clone(&self.written),
            values: self.values.iter().map(&mut *f).list(),
            range: [f(&self.range[0]), f(&self.range[1])],
            periodic: self.periodic,
            kind: self.kind,
        }
    }
}

/// The values of the names in the formulas.
struct FormulaNames<'a, T> {
    parameters: &'a [usize],
    values: Vec<T>,
    u: T,
}

impl<T: Real> Values<T> for FormulaNames<'_, T> {
    fn parameter(&self, k: usize) -> T {
        self.values[self.parameters.binary_search(&k).expect("a parameter of the formula")]
    }
    fn time(&self) -> T {
        T::constant(f64::NAN)
    }
    fn variable(&self, _: usize) -> T {
        self.u
    }
}

impl<S: Real> Formula<S> {
    /// u, reduced to the range if the curve is periodic.
    fn within(&self, u: S) -> S {
        let [a, b] = self.range;
        match self.periodic {
            true => u - ((u - a) / (b - a)).floor() * (b - a),
            false => u,
        }
    }

    /// C at u.
    pub(super) fn point(&self, u: S) -> Local<S> {
        self.derivatives(u)[0]
    }

    /// C and C′ at u.
    pub(super) fn tangent(&self, u: S) -> [Local<S>; 2] {
        let [point, first, ..] = self.derivatives(u);
        [point, first]
    }

    /// C, C′, C″ and C‴ at u.
    pub(super) fn derivatives(&self, u: S) -> [Local<S>; 4] {
        let u = self.within(u);
        // a constant condition leaves the other case out of the program
        if const { S::ORDER == <S::Base as Real>::ORDER } {
            near(self.orders::<4>(u.base()), u)
        } else {
            near(self.orders::<8>(u.base()), u) // enough for scalars that add four orders
        }
    }

    /// The derivatives of x and y of order 0 to N - 1.
    fn orders<const N: usize>(&self, u: S::Base) -> [[S::Base; N]; 2] {
        let lift = |x: &S| TaylorSeries::lift(x.base());
        let values = self.values.iter().map(lift).list();
        let parameters = &self.written.parameters;
        let names = FormulaNames { parameters, values, u: TaylorSeries::variable(u) };
        let derivatives =
            |tape: &Tape| tape.evaluate::<TaylorSeries<N, S::Base>>(&names).derivatives();
        [derivatives(&self.written.x), derivatives(&self.written.y)]
    }
}

/// C, C′, C″ and C‴ at u from the derivatives of x and y at the base of u. Only these four must be finite, because few
/// scalars use higher derivatives.
fn near<S: Real, const N: usize>([x, y]: [[S::Base; N]; 2], u: S) -> [Local<S>; 4] {
    indexed(|n| Local::new(compose(&x[n..], u, 4 - n), compose(&y[n..], u, 4 - n)))
}

impl<S: Real> Formula<S> {
    /// The values of u at which a condition of a formula changes or a motion law begins or ends, for the first lane
    /// of the scalar. If there are any, the seam of a periodic curve is included.
    pub(super) fn breaks(&self) -> Option<Arc<Knots>> {
        let written = &self.written;
        if written.x.switches().is_empty() && written.y.switches().is_empty() {
            return None;
        }
        let numbers = self.range.iter().chain(&self.values).map(|x| x.in_lanes()[0]);
        let numbers: Vec<f64> = numbers.list();
        let mut known = written.breaks.lock().unwrap_or_else(PoisonError::into_inner);
        if known.as_ref().is_none_or(|(of, _)| *of != numbers) {
            *known = Some((numbers.clone(), self.search(&numbers)));
        }
        known.as_ref().and_then(|(_, knots)| knots.clone())
    }

    fn search(&self, numbers: &[f64]) -> Option<Arc<Knots>> {
        let (range, values) = numbers.split_at(2);
        let [a, b] = [range[0], range[1]];
        let count = self.written.parameters.last().map_or(0, |last| last + 1);
        let mut parameters = vec![f64::NAN; count];
        let places = self.written.parameters.iter().zip(values);
        places.for_each(|(place, value)| parameters[*place] = *value);
        let mut all = Vec::new();
        for tape in [&self.written.x, &self.written.y] {
            switch_places(tape, &parameters, [a, b], &mut all).ok()?;
        }
        all.extend((self.periodic && !all.is_empty()).then_some(a));
        all.sort_by(f64::total_cmp);
        let together = 1e-12 * (b - a);
        all.dedup_by(|later, earlier| *later - *earlier <= together);
        let period = self.periodic.then_some(b - a);
        (!all.is_empty()).then(|| Arc::new(Knots::new(all, period)))
    }
}
