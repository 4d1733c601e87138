//! A curve whose components are formulas in u and the parameters.

#[cfg(target_arch = "wasm32")]
use super::curve_series::{self, Orders, SeventhOrder, TaylorSeries, ThirdOrder};
use crate::expression::{switch_places, Knots, Symbol, Tape, Values};
#[cfg(not(target_arch = "wasm32"))]
use crate::math::{Dual, Jet, Lift};
use crate::math::{Local, Real};
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
    /// SI unit of u.
    pub unit: &'static str,
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
        let mut parameters: Vec<usize> = x.parameters().chain(y.parameters()).collect();
        parameters.sort_unstable();
        parameters.dedup();
        let values = parameters.iter().map(|k| Tape::of(Symbol::Parameter(*k))).collect();
        Self {
            written: Arc::new(FormulaPair { x, y, parameters, breaks: Mutex::default() }),
            values,
            range,
            periodic,
            unit: "1",
        }
    }

    /// A curve from a formula of the radius, with u as the polar angle.
    pub fn polar(self) -> Self {
        Self { unit: "rad", ..self }
    }
}

impl<S> Formula<S> {
    /// The same curve over another scalar.
    pub(super) fn map<T>(&self, f: &mut dyn FnMut(&S) -> T) -> Formula<T> {
        Formula {
            written: Arc::clone(&self.written),
            values: self.values.iter().map(&mut *f).collect(),
            range: self.range.each_ref().map(f),
            periodic: self.periodic,
            unit: self.unit,
        }
    }
}

/// u with its derivatives to third order by a variable.
#[cfg(not(target_arch = "wasm32"))]
type Third<S> = Jet<Dual<1, S>>;

/// The values of the names in the formulas, over a scalar `T` that contains `S`.
struct FormulaNames<'a, S, T> {
    parameters: &'a [usize],
    values: &'a [S],
    u: T,
    lift: fn(S) -> T,
}

impl<S: Real, T: Real> Values<T> for FormulaNames<'_, S, T> {
    fn parameter(&self, k: usize) -> T {
        let place = self.parameters.binary_search(&k).expect("a parameter of the formula");
        (self.lift)(self.values[place])
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

    /// x and y over a scalar that contains `S`.
    fn both<T: Real>(&self, u: T, lift: fn(S) -> T) -> [T; 2] {
        let named =
            FormulaNames { parameters: &self.written.parameters, values: &self.values, u, lift };
        [&self.written.x, &self.written.y].map(|tape| tape.evaluate(&named))
    }
}

#[cfg(not(target_arch = "wasm32"))]
impl<S: Real> Formula<S> {
    /// C at u.
    pub(super) fn point(&self, u: S) -> Local<S> {
        let [x, y] = self.both(self.within(u), |x| x);
        Local::new(x, y)
    }

    /// C and C′ at u.
    pub(super) fn tangent(&self, u: S) -> [Local<S>; 2] {
        let [x, y] = self.both(Dual::<1, S>::variable(self.within(u), 0), Dual::lift);
        [Local::new(x.value, y.value), Local::new(x.slope[0], y.slope[0])]
    }

    /// C, C′, C″ and C‴ at u.
    pub(super) fn derivatives(&self, u: S) -> [Local<S>; 4] {
        let u: Third<S> = Jet::new(Dual::variable(self.within(u), 0), Dual::one(), Dual::zero());
        let [x, y] = self
            .both(u, |x| Jet::lift(Dual::lift(x)))
            .map(|jet| [jet.value.value, jet.rate.value, jet.second.value, jet.second.slope[0]]);
        std::array::from_fn(|n| Local::new(x[n], y[n]))
    }
}

#[cfg(target_arch = "wasm32")]
impl<S: Real> Formula<S> {
    /// C at u.
    pub(super) fn point(&self, u: S) -> Local<S> {
        self.near(u, 0)[0]
    }

    /// C and C′ at u.
    pub(super) fn tangent(&self, u: S) -> [Local<S>; 2] {
        let [point, first, ..] = self.near(u, 1);
        [point, first]
    }

    /// C, C′, C″ and C‴ at u.
    pub(super) fn derivatives(&self, u: S) -> [Local<S>; 4] {
        self.near(u, 3)
    }

    /// The derivatives with respect to u up to `order`, from the series of lowest order that contains them. Higher
    /// derivatives in the result are not valid.
    fn near(&self, u: S, order: usize) -> [Local<S>; 4] {
        let number = |x: &S| x.in_lanes()[0];
        let u = self.within(u);
        let numbers = Formula {
            written: Arc::clone(&self.written),
            values: self.values.iter().map(number).collect(),
            range: self.range.each_ref().map(number),
            periodic: self.periodic,
            unit: self.unit,
        };
        let value = number(&u);
        let orders = match order + S::ORDER {
            0 => numbers.orders::<f64>(value),
            1..=3 => numbers.orders::<ThirdOrder>(value),
            _ => numbers.orders::<SeventhOrder>(value),
        };
        curve_series::at(&orders, u - S::constant(value))
    }
}

#[cfg(target_arch = "wasm32")]
impl Formula {
    fn orders<T: TaylorSeries>(&self, u: f64) -> Orders {
        let [x, y] = self.both(T::variable(u), T::constant);
        curve_series::orders(x, y)
    }
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
        let numbers: Vec<f64> = numbers.collect();
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
