//! Newton's iteration: its order, its damping and every way it can end.

use kempe::solve::newton::{Damping, Equations, Newton, Options, Outcome};

/// Equations in one unknown, by closures for F and F′.
struct Scalar<F, D> {
    f: F,
    slope: D,
    evaluations: usize,
}

impl<F: Fn(f64) -> f64, D: Fn(f64) -> f64> Equations for Scalar<F, D> {
    type Stop = &'static str;
    fn unknowns(&self) -> usize {
        1
    }
    fn equations(&self) -> usize {
        1
    }
    fn residual(&mut self, x: &[f64], residual: &mut [f64]) -> Result<(), Self::Stop> {
        self.evaluations += 1;
        residual[0] = (self.f)(x[0]);
        Ok(())
    }
    fn step(
        &mut self,
        x: &[f64],
        residual: &[f64],
        levenberg: f64,
        step: &mut [f64],
    ) -> Result<(), Self::Stop> {
        let slope = (self.slope)(x[0]);
        step[0] = -slope * residual[0] / (slope * slope + levenberg * levenberg);
        Ok(())
    }
}

fn scalar<F: Fn(f64) -> f64, D: Fn(f64) -> f64>(f: F, slope: D) -> Scalar<F, D> {
    Scalar { f, slope, evaluations: 0 }
}

fn solve<E: Equations<Stop = &'static str>>(
    mut e: E,
    x: f64,
    options: &Options,
) -> (Outcome, f64, Newton) {
    let (mut newton, mut x) = (Newton::new(), [x]);
    let outcome = newton.solve(&mut e, &mut x, options).unwrap();
    (outcome, x[0], newton)
}

#[test]
fn converges_quadratically() {
    let (outcome, x, newton) =
        solve(scalar(|x| x * x - 2.0, |x| 2.0 * x), 1.0, &Options::default());
    assert_eq!(outcome, Outcome::Converged);
    assert!((x - 2.0_f64.sqrt()).abs() < 1e-15);
    let norms: Vec<f64> = newton.history().iter().map(|r| r.residual_norm).collect();
    // F(x₊) = s² exactly for a parabola, and s = F / (2 x) with x near √2
    for (k, w) in newton.history().windows(2).enumerate().take(4) {
        assert_eq!(w[1].iteration, k + 1);
        assert_eq!(w[1].damping, 1.0);
        assert!((w[1].residual_norm - w[1].step_norm * w[1].step_norm).abs() < 1e-15);
    }
    assert!(norms.len() <= 7, "{norms:?}");
}

#[test]
fn a_solution_is_returned_untouched() {
    let start = 2.0_f64.sqrt() + 1e-12; // not the best number, but good enough
    let mut equations = scalar(|x| x * x - 2.0, |_| panic!("no step is needed"));
    let (mut newton, mut x) = (Newton::new(), [start]);
    assert_eq!(newton.solve(&mut equations, &mut x, &Options::default()), Ok(Outcome::Converged));
    assert_eq!(x[0].to_bits(), start.to_bits());
    assert_eq!((equations.evaluations, newton.history().len()), (1, 1));
}

#[test]
fn halving_saves_what_full_steps_lose() {
    // full steps for atan diverge from beyond 1.39
    let equations = || scalar(f64::atan, |x| 1.0 / (1.0 + x * x));
    let (outcome, x, newton) = solve(equations(), 3.0, &Options::default());
    assert_eq!(outcome, Outcome::Converged);
    assert!(x.abs() < 1e-15);
    assert!(newton.history().iter().any(|r| r.damping < 1.0));
    assert!(newton.history().windows(2).all(|w| w[1].residual_norm <= w[0].residual_norm));
    let full = Options { damping: Damping::Halving { most: 0 }, ..Options::default() };
    assert_eq!(solve(equations(), 3.0, &full).0, Outcome::Stalled);
    let levenberg =
        Options { damping: Damping::Levenberg { initial: 1.0, most: 20 }, ..Options::default() };
    let (outcome, x, newton) = solve(equations(), 3.0, &levenberg);
    assert_eq!(outcome, Outcome::Converged);
    assert!(x.abs() < 1e-10);
    assert!(newton.history().last().unwrap().damping < 1e-3, "it ends as Newton's iteration");
}

#[test]
fn a_trial_outside_the_domain_is_halved() {
    let (outcome, x, _) = solve(scalar(f64::ln, f64::recip), 5.0, &Options::default());
    assert_eq!(outcome, Outcome::Converged);
    assert!((x - 1.0).abs() < 1e-15);
}

#[test]
fn without_a_root_it_stalls_at_the_least_residual() {
    let mut options = Options { max_iterations: 1000, ..Options::default() };
    for damping in [Damping::Halving { most: 40 }, Damping::Levenberg { initial: 1.0, most: 40 }] {
        options.damping = damping;
        let (outcome, x, newton) = solve(scalar(|x| x * x + 1.0, |x| 2.0 * x), 3.0, &options);
        assert_eq!(outcome, Outcome::Stalled);
        assert!(x.abs() < 0.02, "{x}");
        assert_eq!(newton.residual(), [x * x + 1.0]);
    }
}

#[test]
fn a_small_residual_with_a_large_step_is_not_yet_a_solution() {
    // x⁸: the residual is below 1e-10 at 0.05, steps are x / 8
    let equations = scalar(|x: f64| x.powi(8), |x: f64| 8.0 * x.powi(7));
    let options = Options { step_tolerance: 1e-6, max_iterations: 200, ..Options::default() };
    let (outcome, x, newton) = solve(equations, 1.0, &options);
    assert_eq!(outcome, Outcome::Converged);
    assert!(newton.history().last().unwrap().step_norm <= 1e-6 && x < 1e-5);
}

#[test]
fn iterations_run_out_and_numbers_too() {
    let few = Options { max_iterations: 2, ..Options::default() };
    let (outcome, _, newton) = solve(scalar(|x| x * x - 2.0, |x| 2.0 * x), 100.0, &few);
    assert_eq!((outcome, newton.history().len()), (Outcome::MaxIterations, 3));
    let (outcome, x, _) = solve(scalar(|_| f64::NAN, |_| 1.0), 1.0, &Options::default());
    assert_eq!((outcome, x), (Outcome::NotFinite, 1.0));
    let (outcome, x, _) = solve(scalar(|x| x * x - 2.0, |_| 0.0), 1.0, &Options::default());
    assert_eq!((outcome, x), (Outcome::NotFinite, 1.0), "a singular Jacobian");
}

/// A circle and a line, and once more the line: three equations in two unknowns; may refuse.
struct Overdetermined {
    refuse: bool,
}

impl Equations for Overdetermined {
    type Stop = &'static str;
    fn unknowns(&self) -> usize {
        2
    }
    fn equations(&self) -> usize {
        3
    }
    fn residual(&mut self, x: &[f64], r: &mut [f64]) -> Result<(), Self::Stop> {
        r.copy_from_slice(&[x[0] * x[0] + x[1] * x[1] - 2.0, x[0] - x[1], x[0] - x[1]]);
        Ok(())
    }
    fn step(&mut self, x: &[f64], r: &[f64], _: f64, step: &mut [f64]) -> Result<(), Self::Stop> {
        if self.refuse {
            return Err("singular");
        }
        // the equations agree, so two of them give the least-squares step
        let (a, b) = (2.0 * x[0], 2.0 * x[1]);
        step[0] = (-r[0] - b * r[1]) / (a + b);
        step[1] = step[0] + r[1];
        Ok(())
    }
}

#[test]
fn more_equations_than_unknowns_and_reuse_of_memory() {
    let mut newton = Newton::new();
    for start in [[3.0, 1.0], [0.5, 4.0]] {
        let mut x = start;
        let solved =
            newton.solve(&mut Overdetermined { refuse: false }, &mut x, &Options::default());
        assert_eq!(solved, Ok(Outcome::Converged));
        assert!((x[0] - 1.0).abs() < 1e-15 && (x[1] - 1.0).abs() < 1e-15, "{x:?}");
        assert_eq!(newton.history()[0].iteration, 0);
    }
    let mut x = [3.0, 1.0];
    let refused = newton.solve(&mut Overdetermined { refuse: true }, &mut x, &Options::default());
    assert_eq!((refused, x), (Err("singular"), [3.0, 1.0]));
}
