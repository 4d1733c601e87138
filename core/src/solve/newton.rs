//! Damped Newton and Gauss–Newton iteration for F(x) = 0.
//!
//! The problem provides its own linear solver, so that the Jacobian may have any structure. A step is accepted if it
//! reduces ‖F‖. Otherwise it is shortened, or the Levenberg parameter is increased (Dennis and Schnabel, *Numerical
//! Methods for Unconstrained Optimization and Nonlinear Equations*, 1983, 6.3 and 10.2). The iteration has converged
//! when both the residual *and* the step are small: near a singular Jacobian, one of them alone is not sufficient.

/// A system of equations F(x) = 0 and its linearisation.
pub trait Equations {
    /// Error of an evaluation, passed on unchanged.
    type Stop;

    /// Number of unknowns.
    fn unknowns(&self) -> usize;

    /// Number of equations; may differ from the number of unknowns (Gauss–Newton).
    fn equations(&self) -> usize;

    /// Computes F(x) into `residual`, scaled as for the convergence test. Outside the domain of F, return NaN.
    ///
    /// # Errors
    /// An error ends the iteration at once.
    fn residual(&mut self, x: &[f64], residual: &mut [f64]) -> Result<(), Self::Stop>;

    /// Computes the full step s into `step`: F′(x) s = -`residual`, or its least-squares or least-norm solution. With
    /// `levenberg` > 0, (F′ᵀF′ + levenberg² I) s = -F′ᵀ `residual`, or a similar damped step.
    ///
    /// # Errors
    /// An error ends the iteration at once. A step that is not finite ends it as [`Outcome::NotFinite`].
    fn step(
        &mut self,
        x: &[f64],
        residual: &[f64],
        levenberg: f64,
        step: &mut [f64],
    ) -> Result<(), Self::Stop>;

    /// Norm of a residual; Euclidean by default.
    #[inline]
    fn residual_norm(&self, residual: &[f64]) -> f64 {
        euclidean(residual)
    }

    /// Norm of a step from x; Euclidean by default.
    #[inline]
    fn step_norm(&self, x: &[f64], step: &[f64]) -> f64 {
        let _ = x;
        euclidean(step)
    }
}

fn euclidean(x: &[f64]) -> f64 {
    let largest = x.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
    // the sum of squares may overflow although the norm does not
    if largest > 1e150 {
        return largest * x.iter().map(|v| (v / largest) * (v / largest)).sum::<f64>().sqrt();
    }
    x.iter().map(|v| v * v).sum::<f64>().sqrt()
}

/// The method for a step that does not reduce the residual.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Damping {
    /// The step is halved, at most this many times.
    Halving {
        /// Largest number of halvings of one step.
        most: u32,
    },
    /// The Levenberg parameter is multiplied by 10, and divided by 10 after a success.
    Levenberg {
        /// First parameter, > 0.
        initial: f64,
        /// Largest number of increases in one step.
        most: u32,
    },
}

/// The criteria of success and failure of the iteration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// Largest residual norm of a solution.
    pub residual_tolerance: f64,
    /// Largest norm of the last full step; infinite if only the residual is tested.
    pub step_tolerance: f64,
    /// Largest number of steps.
    pub max_iterations: usize,
    /// The damping of steps.
    pub damping: Damping,
}

impl Default for Options {
    /// 1e-10 for residual and step, 50 steps and 20 halvings.
    fn default() -> Self {
        Self {
            residual_tolerance: 1e-10,
            step_tolerance: 1e-10,
            max_iterations: 50,
            damping: Damping::Halving { most: 20 },
        }
    }
}

/// The record of one iteration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Record {
    /// Number of steps taken so far; 0 is the start.
    pub iteration: usize,
    /// ‖F‖ after these steps.
    pub residual_norm: f64,
    /// Norm of the last full step; 0 at the start.
    pub step_norm: f64,
    /// Fraction of the step that was taken, or the Levenberg parameter; at the start 1 or the initial parameter.
    pub damping: f64,
}

/// The outcome of an iteration.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// Residual and step are below their tolerances, or the residual was below its tolerance at the start.
    Converged,
    /// No step reduces the residual: x is at or near a local minimum of ‖F‖, or the Jacobian is wrong.
    Stalled,
    /// The largest number of steps was reached before convergence.
    MaxIterations,
    /// The residual at the start or a step is not finite.
    NotFinite,
}

/// Fraction of ‖F‖ by which a full step must reduce it (Armijo). It is small, since a Gauss–Newton step towards a
/// minimum with a nonzero residual reduces it little.
const SUFFICIENT: f64 = 1e-6;

/// Memory and history of an iteration. It can be used again for problems of any size.
#[derive(Clone, Debug, Default)]
pub struct Newton {
    residual: Vec<f64>,
    trial_residual: Vec<f64>,
    step: Vec<f64>,
    trial: Vec<f64>,
    history: Vec<Record>,
}

/// The accepted step, or the reason why there is none.
enum Search {
    Found(Record),
    None,
    NotFinite,
}

impl Newton {
    /// Allocates nothing.
    #[inline]
    pub fn new() -> Self {
        Self::default()
    }

    /// The iterations of the last call, beginning with the start.
    #[inline]
    pub fn history(&self) -> &[Record] {
        &self.history
    }

    /// F at the x of the last call.
    #[inline]
    pub fn residual(&self) -> &[f64] {
        &self.residual
    }

    /// Iterates `x` until F(x) = 0 within the tolerances. Afterwards x is the last accepted iterate, whatever the
    /// outcome, and never worse than the start. A start that already satisfies the residual tolerance is not changed.
    ///
    /// # Errors
    /// The error of the equations.
    ///
    /// # Panics
    /// If the length of `x` is not the number of unknowns.
    pub fn solve<E: Equations>(
        &mut self,
        equations: &mut E,
        x: &mut [f64],
        options: &Options,
    ) -> Result<Outcome, E::Stop> {
        self.prepare(equations, x);
        equations.residual(x, &mut self.residual)?;
        let norm = equations.residual_norm(&self.residual);
        let damping = match options.damping {
            Damping::Halving { .. } => 1.0,
            Damping::Levenberg { initial, .. } => initial,
        };
        let mut last = Record { iteration: 0, residual_norm: norm, step_norm: 0.0, damping };
        self.history.push(last);
        if !norm.is_finite() {
            return Ok(Outcome::NotFinite);
        }
        if norm <= options.residual_tolerance {
            return Ok(Outcome::Converged);
        }
        for _ in 0..options.max_iterations {
            let found = match self.search(equations, x, options, &last)? {
                Search::Found(record) => record,
                Search::None => return Ok(Outcome::Stalled),
                Search::NotFinite => return Ok(Outcome::NotFinite),
            };
            x.copy_from_slice(&self.trial);
            std::mem::swap(&mut self.residual, &mut self.trial_residual);
            self.history.push(found);
            if let Some(outcome) = judge(options, &last, &found) {
                return Ok(outcome);
            }
            last = found;
        }
        Ok(Outcome::MaxIterations)
    }

    fn prepare<E: Equations>(&mut self, equations: &E, x: &[f64]) {
        let (n, m) = (equations.unknowns(), equations.equations());
        assert_eq!(x.len(), n, "one start for each unknown");
        self.residual.resize(m, 0.0);
        self.trial_residual.resize(m, 0.0);
        self.step.resize(n, 0.0);
        self.trial.resize(n, 0.0);
        self.history.clear();
    }

    /// Searches for a step that reduces the residual. The result is in `trial` and `trial_residual`.
    fn search<E: Equations>(
        &mut self,
        equations: &mut E,
        x: &[f64],
        options: &Options,
        last: &Record,
    ) -> Result<Search, E::Stop> {
        let (most, levenberg) = match options.damping {
            Damping::Halving { most } => (most, false),
            Damping::Levenberg { most, .. } => (most, true),
        };
        let mut damping = if levenberg { last.damping } else { 1.0 };
        let mut step_norm = f64::NAN;
        for attempt in 0..=most {
            if attempt == 0 || levenberg {
                let parameter = if levenberg { damping } else { 0.0 };
                equations.step(x, &self.residual, parameter, &mut self.step)?;
                step_norm = equations.step_norm(x, &self.step);
                if !step_norm.is_finite() {
                    return Ok(Search::NotFinite);
                }
            }
            let part = if levenberg { 1.0 } else { damping };
            let residual_norm = self.try_part(equations, x, part)?;
            let enough = (1.0 - SUFFICIENT * part) * last.residual_norm;
            if residual_norm < enough || residual_norm <= options.residual_tolerance {
                let iteration = last.iteration + 1;
                let damping = if levenberg { 0.1 * damping } else { damping };
                return Ok(Search::Found(Record { iteration, residual_norm, step_norm, damping }));
            }
            damping *= if levenberg { 10.0 } else { 0.5 };
        }
        Ok(Search::None)
    }

    /// The residual norm after a fraction `part` of the step.
    #[inline]
    fn try_part<E: Equations>(
        &mut self,
        equations: &mut E,
        x: &[f64],
        part: f64,
    ) -> Result<f64, E::Stop> {
        for ((trial, x), step) in self.trial.iter_mut().zip(x).zip(&self.step) {
            *trial = x + part * step;
        }
        equations.residual(&self.trial, &mut self.trial_residual)?;
        Ok(equations.residual_norm(&self.trial_residual))
    }
}

/// Whether the iteration ends after a step, because it has converged or the residual no longer decreases.
fn judge(options: &Options, last: &Record, found: &Record) -> Option<Outcome> {
    if found.step_norm > options.step_tolerance {
        return None;
    }
    if found.residual_norm <= options.residual_tolerance {
        return Some(Outcome::Converged);
    }
    (found.residual_norm > 0.5 * last.residual_norm).then_some(Outcome::Stalled)
}
