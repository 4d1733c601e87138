//! First-order states that the motion depends on and that depend on the motion, by every method, against closed forms.
//!
//! ```text
//! q″ = -q + z₁        z₁′ = -a z₁        z₂′ = (q - z₂) / τ        w′ = z₁²
//! ```
//!
//! For implicit methods a second mass follows with q₂ = 2 q, so that there is a multiplier.

use super::*;
use kempe::integrate::{
    AlphaParameters, ConstraintLevel, Dae, DaeLengths, DaeRates, DaeResidual, DaeState, Direction,
    Dop853, GeneralizedAlpha, ImplicitMethod, Iterate, NewtonCoefficients, Radau, Rk4, Rk45,
    StepControl, Structure,
};
use kempe::math::{Complex, Field};

/// a, and τ of the filter.
#[derive(Clone, Copy)]
struct Circuit {
    a: f64,
    tau: f64,
}

const SMOOTH: Circuit = Circuit { a: 0.7, tau: 0.3 };

impl Circuit {
    /// q, v, z₁, z₂ and w at t, from q = 1, v = 0, z₁ = 2, and z₂ without its transient.
    fn truth(&self, t: f64) -> [f64; 5] {
        let Self { a, tau } = *self;
        let p = 2.0 / (1.0 + a * a);
        let (c, s) = (1.0 - p, a * p);
        let (cos, sin, decay) = (t.cos(), t.sin(), (-a * t).exp());
        let q = c * cos + s * sin + p * decay;
        let v = -c * sin + s * cos - a * p * decay;
        let filtered = (c * (cos + tau * sin) + s * (sin - tau * cos)) / (1.0 + tau * tau);
        let z = filtered + p * decay / (1.0 - a * tau);
        [q, v, 2.0 * decay, z, 2.0 * (1.0 - decay * decay) / a]
    }
}

impl Ode for Circuit {
    type Stop = String;

    fn len(&self) -> usize {
        5
    }

    fn structure(&self) -> Structure {
        Structure { positions: 1, states: 2, quadratures: 1 }
    }

    fn rate(&mut self, _: f64, y: &[f64], dy: &mut [f64]) -> Result<(), String> {
        let Self { a, tau } = *self;
        dy.copy_from_slice(&[y[1], -y[0] + y[2], -a * y[2], (y[0] - y[3]) / tau, y[2] * y[2]]);
        Ok(())
    }
}

/// The largest error in four places of each step.
fn worst_error(method: &impl ExplicitMethod) -> f64 {
    let (mut worst, mut system) = (0.0_f64, SMOOTH);
    let mut observer = |step: &Step<'_>| {
        for k in 1..=4 {
            let t = step.t_old + 0.25 * f64::from(k) * (step.t - step.t_old);
            let mut y = [0.0; 5];
            step.interpolate(t, &mut y);
            let errors = y.iter().zip(SMOOTH.truth(t)).map(|(y, truth)| (y - truth).abs());
            worst = errors.fold(worst, f64::max);
        }
        Flow::Continue
    };
    let mut y = SMOOTH.truth(0.0);
    method.integrate(&mut system, 0.0, 10.0, &mut y, &mut observer).unwrap();
    worst
}

#[test]
fn explicit_methods_integrate_states_with_the_motion() {
    let dop853 = worst_error(&Dop853::new(1e-11, 1e-12));
    let rk45 = worst_error(&Rk45::new(1e-11, 1e-12));
    let rk4 = worst_error(&Rk4::new(5e-4));
    assert!(dop853 < 1e-9 && rk45 < 1e-9 && rk4 < 1e-9, "{dop853:.1e} {rk45:.1e} {rk4:.1e}");
}

/// Mass of the follower.
const FOLLOWER: f64 = 0.25;
/// M, with both masses.
const MASS: [f64; 2] = [1.0, FOLLOWER];
/// Force on the first mass for its unit acceleration.
const TOGETHER: f64 = 1.0 + 4.0 * FOLLOWER;

/// The circuit as a DAE of order (q₁, q₂, z₁, z₂, λ), with its matrices.
struct Constrained {
    circuit: Circuit,
    real: Vec<Vec<f64>>,
    complex: Vec<Vec<Complex>>,
}

impl Constrained {
    fn new(circuit: Circuit) -> Self {
        Self { circuit, real: Vec::new(), complex: Vec::new() }
    }

    fn force(q: &[f64], z: &[f64]) -> f64 {
        TOGETHER * (z[0] - q[0])
    }

    fn rates(&self, q: &[f64], z: &[f64]) -> [f64; 2] {
        [-self.circuit.a * z[0], (q[0] - z[1]) / self.circuit.tau]
    }

    fn matrix<F: Field>(&self, c: NewtonCoefficients<F>) -> Vec<Vec<F>> {
        let (zero, of) = (F::zero(), F::from_real);
        let over = of(1.0 / self.circuit.tau);
        vec![
            vec![
                c.mass + c.stiffness * of(TOGETHER),
                zero,
                -(c.state_force * of(TOGETHER)),
                zero,
                of(-2.0),
            ],
            vec![zero, c.mass * of(FOLLOWER), zero, zero, of(1.0)],
            vec![zero, zero, of(1.0) + c.state_rate * of(self.circuit.a), zero, zero],
            vec![-(c.state_position * over), zero, zero, of(1.0) + c.state_rate * over, zero],
            vec![of(-2.0), of(1.0), zero, zero, zero],
        ]
    }
}

/// Gauss with the largest pivots.
fn solve<F: Field>(matrix: &[Vec<F>], x: &mut [F]) {
    let (mut m, n) = (matrix.to_vec(), x.len());
    for k in 0..n {
        let best = (k..n)
            .max_by(|a, b| m[*a][k].magnitude().total_cmp(&m[*b][k].magnitude()))
            .expect("rows");
        m.swap(k, best);
        x.swap(k, best);
        let over = m[k][k].reciprocal();
        for i in (0..n).filter(|i| *i != k) {
            let factor = m[i][k] * over;
            let pivot_row = m[k].clone();
            for (to, from) in m[i].iter_mut().zip(pivot_row) {
                *to -= factor * from;
            }
            let part = factor * x[k];
            x[i] -= part;
        }
    }
    (0..n).for_each(|k| x[k] = x[k] * m[k][k].reciprocal());
}

impl Dae for Constrained {
    type Stop = String;

    fn lengths(&self) -> DaeLengths {
        DaeLengths { coordinates: 2, multipliers: 1, states: 2, quadratures: 1, columns: 1 }
    }

    fn accelerate(
        &mut self,
        _: f64,
        [q, _, z]: [&[f64]; 3],
        out: DaeRates<'_>,
    ) -> Result<(), String> {
        let a = Self::force(q, z) / TOGETHER;
        out.a.copy_from_slice(&[a, 2.0 * a]);
        out.lam[0] = -2.0 * FOLLOWER * a;
        out.dz.copy_from_slice(&self.rates(q, z));
        out.powers[0] = z[0] * z[0];
        Ok(())
    }

    fn residual(&mut self, _: f64, at: Iterate<'_>, level: ConstraintLevel, out: DaeResidual<'_>) {
        let Iterate { q, v, a, lam, z, dz } = at;
        out.forces[0] = a[0] - 2.0 * lam[0] - Self::force(q, z);
        out.forces[1] = FOLLOWER * a[1] + lam[0];
        let rates = self.rates(q, z);
        out.states.iter_mut().zip(dz.iter().zip(rates)).for_each(|(r, (dz, f))| *r = dz - f);
        let x = if level == ConstraintLevel::Position { q } else { v };
        out.rows[0] = x[1] - 2.0 * x[0];
        out.powers[0] = z[0] * z[0];
    }

    fn linearize(&mut self, _: f64, _: Iterate<'_>) {}

    fn factor(&mut self, c: NewtonCoefficients) -> bool {
        self.real = self.matrix(c);
        true
    }

    fn factor_complex(&mut self, c: NewtonCoefficients<Complex>) -> bool {
        self.complex = self.matrix(c);
        true
    }

    fn solve(&mut self, x: &mut [f64]) {
        solve(&self.real, x);
    }

    fn solve_complex(&mut self, x: &mut [Complex]) {
        solve(&self.complex, x);
    }

    fn times(&self, x: &[f64], y: &[f64], s: &[f64], out: &mut [f64]) {
        out[0] = MASS[0] * x[0] - TOGETHER * s[0];
        out[1] = MASS[1] * x[1];
        out[2] = y[0];
        out[3] = y[1] + s[0] / self.circuit.tau;
        out[4] = 0.0;
    }

    fn normal(&mut self, x: &mut [f64]) {
        let gap = (x[1] - 2.0 * x[0]) / (4.0 / MASS[0] + 1.0 / MASS[1]);
        x.copy_from_slice(&[-2.0 * gap / MASS[0], gap / MASS[1]]);
    }

    fn project(&mut self, _: f64, _: DaeState<'_>, _: bool) -> Result<bool, String> {
        Ok(false)
    }

    fn singular(&mut self, _: f64, _: [&[f64]; 3]) -> Option<String> {
        None
    }
}

/// The largest error of q, v, z and w at the ends of steps and between them, and the steps.
fn implicit_error(method: &impl ImplicitMethod, circuit: Circuit, inside: i32) -> (f64, usize) {
    let both = |[q, v, z1, z2, w]: [f64; 5]| [q, 2.0 * q, v, 2.0 * v, z1, z2, w];
    let mut worst = 0.0_f64;
    let mut observer = |step: &Step<'_>| {
        for k in 1..=inside {
            let t = step.t_old + f64::from(k) / f64::from(inside) * (step.t - step.t_old);
            let mut y = [0.0; 7];
            step.interpolate(t, &mut y);
            let errors = y.iter().zip(both(circuit.truth(t))).map(|(y, truth)| (y - truth).abs());
            worst = errors.fold(worst, f64::max);
        }
        Flow::Continue
    };
    let mut y = both(circuit.truth(0.0));
    let mut system = Constrained::new(circuit);
    let done = method.integrate(&mut system, 0.0, 5.0, &mut y, &mut observer).unwrap();
    (worst, done.steps)
}

#[test]
fn radau_integrates_states_with_the_motion() {
    let (error, _) = implicit_error(&Radau::new(1e-11, 1e-12), SMOOTH, 1);
    assert!(error < 1e-9, "{error:.1e}");
    let steps = |h| implicit_error(&Radau::constant(h, 1e-13, 1e-14), SMOOTH, 1).0;
    let slope = (steps(0.2) / steps(0.1)).log2();
    assert!((slope - 5.0).abs() < 0.4, "{slope}");
}

#[test]
fn generalized_alpha_integrates_states_with_order_two() {
    for parameters in [AlphaParameters::chung_hulbert(0.8), AlphaParameters::hht(-0.1)] {
        let steps = |h| {
            implicit_error(&GeneralizedAlpha::constant(parameters, h, 1e-12, 1e-13), SMOOTH, 2).0
        };
        let slope = (steps(0.01) / steps(0.005)).log2();
        assert!((slope - 2.0).abs() < 0.1, "{slope}");
        assert!(steps(1e-4) < 1e-7, "{:.1e}", steps(1e-4));
        let (error, _) = implicit_error(&GeneralizedAlpha::new(parameters, 1e-7, 1e-8), SMOOTH, 1);
        assert!(error < 1e-4, "{error:.1e}");
    }
}

/// A filter a million times faster than the motion holds no step.
#[test]
fn stiff_states_are_integrated_implicitly() {
    let stiff = Circuit { tau: 1e-6, ..SMOOTH };
    let (error, steps) = implicit_error(&Radau::new(1e-8, 1e-10), stiff, 2);
    assert!(error < 1e-6 && steps < 200, "{error:.1e} in {steps} steps");
    let method = GeneralizedAlpha::new(AlphaParameters::chung_hulbert(0.5), 1e-5, 1e-7);
    let (error, steps) = implicit_error(&method, stiff, 2);
    assert!(error < 5e-3 && steps < 1000, "{error:.1e} in {steps} steps");
    let mut system = stiff;
    let control = StepControl { max_steps: Some(10_000), ..StepControl::new(1e-6, 1e-8) };
    let mut y = stiff.truth(0.0);
    let mut look = |_: &Step<'_>| Flow::Continue;
    let explicit = Dop853 { control }.integrate(&mut system, 0.0, 5.0, &mut y, &mut look);
    assert!(explicit.is_err(), "an explicit method is held by stability");
}

/// At a restart there are two states at one time; every method continues from the second as from a start.
#[test]
fn a_stepper_locates_an_event_and_restarts() {
    let mut system = SMOOTH;
    let start = SMOOTH.truth(0.0);
    let dop853 = Dop853::new(1e-10, 1e-12).start(&system, (0.0, 5.0), &start).unwrap();
    let rk45 = Rk45::new(1e-10, 1e-12).start(&system, (0.0, 5.0), &start).unwrap();
    let rk4 = Rk4::new(1e-3).start(&system, (0.0, 5.0), &start).unwrap();
    for mut stepper in [dop853, rk45, rk4] {
        let mut passed = None;
        while passed.is_none() {
            stepper.step(&mut system).unwrap();
            let mut g = |_: f64, y: &[f64]| y[2] - 1.0;
            passed = stepper.locate(&mut system, &mut g, Direction::Falling, 0.0).unwrap();
        }
        let (t, mut y) = passed.unwrap();
        assert!((t - 2.0_f64.ln() / SMOOTH.a).abs() < 1e-8, "{t}");
        y[1] = -y[1];
        stepper.restart(t, &y).unwrap();
        assert_eq!((stepper.t(), stepper.y()), (t, &y[..]));
        assert!(stepper.last_step().is_none());
        while stepper.t() != stepper.t_end() {
            stepper.step(&mut system).unwrap();
        }
        let mut fresh = y.clone();
        let mut look = |_: &Step<'_>| Flow::Continue;
        Dop853::new(1e-12, 1e-13).integrate(&mut system, t, 5.0, &mut fresh, &mut look).unwrap();
        for (a, b) in stepper.y().iter().zip(&fresh) {
            assert!((a - b).abs() < 1e-7, "{a} {b}");
        }
    }
}
