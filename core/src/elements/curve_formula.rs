//! A curve whose components are formulas in u and the parameters.

use crate::expression::{Symbol, Tape, Values};
use crate::math::{Dual, Jet, Lift, Local, Real};
use std::sync::Arc;

/// x(u) and y(u).
#[derive(Clone, Debug)]
pub struct Formula<S = f64> {
    written: Arc<Written>,
    /// Values of the parameters that the formulas use.
    values: Vec<S>,
    /// The ends of u.
    pub range: [S; 2],
    /// Whether it repeats itself beyond them.
    pub periodic: bool,
}

/// The formulas, and the indices of the parameters that they use.
#[derive(Debug)]
struct Written {
    x: Tape,
    y: Tape,
    parameters: Vec<usize>,
}

impl Formula<Tape> {
    /// From formulas in u, the only variable, and in parameters of a model.
    pub fn new(x: Tape, y: Tape, range: [Tape; 2], periodic: bool) -> Self {
        let mut parameters: Vec<usize> = x.parameters().chain(y.parameters()).collect();
        parameters.sort_unstable();
        parameters.dedup();
        let values = parameters.iter().map(|k| Tape::of(Symbol::Parameter(*k))).collect();
        Self { written: Arc::new(Written { x, y, parameters }), values, range, periodic }
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
        }
    }
}

/// u with its derivatives to third order by a variable.
type Third<S> = Jet<Dual<1, S>>;

/// The names of the formulas.
struct Named<'a, S> {
    parameters: &'a [usize],
    values: &'a [S],
    u: Third<S>,
}

impl<S: Real> Values<Third<S>> for Named<'_, S> {
    fn parameter(&self, k: usize) -> Third<S> {
        let place = self.parameters.binary_search(&k).expect("a parameter of the formula");
        Jet::lift(Dual::lift(self.values[place]))
    }
    fn time(&self) -> Third<S> {
        Jet::constant(f64::NAN)
    }
    fn variable(&self, _: usize) -> Third<S> {
        self.u
    }
}

impl<S: Real> Formula<S> {
    /// C, C′, C″ and C‴ at u.
    pub(super) fn derivatives(&self, u: S) -> [Local<S>; 4] {
        let [a, b] = self.range;
        let u = match self.periodic {
            // the formulas are those of the range
            true => u - ((u - a) / (b - a)).floor() * (b - a),
            false => u,
        };
        let u = Jet::new(Dual::variable(u, 0), Dual::one(), Dual::zero());
        let named = Named { parameters: &self.written.parameters, values: &self.values, u };
        let part = |tape: &Tape| {
            let jet = tape.evaluate(&named);
            [jet.value.value, jet.rate.value, jet.second.value, jet.second.slope[0]]
        };
        let (x, y) = (part(&self.written.x), part(&self.written.y));
        std::array::from_fn(|n| Local::new(x[n], y[n]))
    }
}
