//! The matrices of Newton's iteration of implicit methods: a tangent and its real and complex factors, with one
//! elimination plan.

use crate::equations::iteration::{assemble, Coefficients, Places};
use crate::equations::kinematics::Motions;
use crate::equations::tangent::Tangent;
use crate::integrate::NewtonCoefficients;
use crate::math::Complex;
use crate::model::Model;
use crate::solve::BlockLu;

/// A tangent with the factors of its matrices.
pub(in crate::analyses) struct NewtonMatrix {
    tangent: Tangent,
    places: Places,
    real: BlockLu<f64>,
    /// Allocated for the first complex matrix.
    complex: Option<BlockLu<Complex>>,
}

impl NewtonMatrix {
    /// Memory for a model. The rows `omitted` are omitted.
    pub fn new(model: &Model, omitted: &[usize]) -> Self {
        let tangent = Tangent::new(model);
        let mut places = Places::new(model, &tangent);
        places.omit(omitted);
        Self { real: BlockLu::new(&places.plan), complex: None, tangent, places }
    }

    /// Omits these rows and no others.
    pub fn omit(&mut self, rows: &[usize]) {
        self.places.omit(rows);
    }

    /// Computes the tangent at the positions and rates of `motions`, and at `at` = [a, λ, z].
    pub fn linearize(&mut self, model: &Model, motions: &Motions, t: f64, at: [&[f64]; 3]) {
        self.tangent.linearize(model, motions, t, at);
    }

    /// Factorises the real matrix. Returns false if it is singular.
    pub fn factor(&mut self, coefficients: NewtonCoefficients) -> bool {
        assemble(&self.places, &self.tangent, parts(coefficients), &mut self.real);
        self.real.factor(&self.places.plan).is_ok()
    }

    /// Factorises the complex matrix. Returns false if it is singular.
    pub fn factor_complex(&mut self, coefficients: NewtonCoefficients<Complex>) -> bool {
        let plan = &self.places.plan;
        let lu = self.complex.get_or_insert_with(|| BlockLu::new(plan));
        assemble(&self.places, &self.tangent, parts(coefficients), lu);
        lu.factor(plan).is_ok()
    }

    /// Solves with the real factors, in place. x has the parts (q, z, λ).
    pub fn solve(&mut self, x: &mut [f64]) {
        self.real.solve(&self.places.plan, x);
    }

    /// Solves with the complex factors, in place.
    pub fn solve_complex(&mut self, x: &mut [Complex]) {
        if let Some(lu) = &mut self.complex {
            lu.solve(&self.places.plan, x);
        }
    }

    /// Computes (M x - K s, y + ∂ż/∂q s, -B s) for `of` = [x, y, s].
    pub fn times(&self, model: &Model, of: [&[f64]; 3], out: &mut [f64]) {
        self.tangent.times(model, of, out);
    }
}

fn parts<F>(of: NewtonCoefficients<F>) -> Coefficients<F> {
    Coefficients {
        motion: [of.mass, of.damping, of.stiffness, of.rate],
        states: [of.state_force, of.state_velocity, of.state_position, of.state_rate],
    }
}
