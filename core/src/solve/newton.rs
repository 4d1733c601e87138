//! Damped Newton and Gauss–Newton iteration for F(x) = 0.
//!
//! The problem supplies its own linear solve, so that any structure of the Jacobian serves. A step is
//! taken when it lowers ‖F‖; otherwise it is shortened, or the Levenberg parameter raised (Dennis and
//! Schnabel, *Numerical Methods for Unconstrained Optimization and Nonlinear Equations*, 1983, 6.3 and
//! 10.2). It has converged when residual *and* step are small: near a singular Jacobian one without the
//! other means little.

/// A system of equations F(x) = 0 and its linearisation.
pub trait Equations {
    /// Why an evaluation cannot be had at all; passed through untouched.
    type Stop;

    /// Number of unknowns.
    fn unknowns(&self) -> usize;

    /// Number of equations; may differ from the unknowns (Gauss–Newton).
    fn equations(&self) -> usize;

    /// F(x) into `residual`, scaled as it is to be judged. Outside its domain it should be NaN.
    ///
    /// # Errors
    /// Ends the iteration at once.
    fn residual(&mut self, x: &[f64], residual: &mut [f64]) -> Result<(), Self::Stop>;

    /// The full step s into `step`: F′(x) s = -`residual`, or its least-squares or least-norm solution;
    /// with `levenberg` > 0, (F′ᵀF′ + levenberg² I) s = -F′ᵀ `residual`, or a similar damped step.
    ///
    /// # Errors
    /// Ends the iteration at once. A step that is not finite ends it as [`Outcome::NotFinite`].
    fn step(
        &mut self,
        x: &[f64],
        residual: &[f64],
        levenberg: f64,
        step: &mut [f64],
    ) -> Result<(), Self::Stop>;

    /// Size of a residual; Euclidean.
    fn residual_norm(&self, residual: &[f64]) -> f64 {
        euclidean(residual)
    }

    /// Size of a step from x; Euclidean.
    fn step_norm(&self, x: &[f64], step: &[f64]) -> f64 {
        let _ = x;
        euclidean(step)
    }
}

fn euclidean(x: &[f64]) -> f64 {
    let largest = x.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
    // the sum of squares overflows before the norm does
    if largest > 1e150 {
        return largest * x.iter().map(|v| (v / largest) * (v / largest)).sum::<f64>().sqrt();
    }
    x.iter().map(|v| v * v).sum::<f64>().sqrt()
}

/// The remedy for a step that does not reduce the residual.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Damping {
    /// Half of it is tried, up to this many times.
    Halving {
        /// Most halvings of one step.
        most: u32,
    },
    /// The Levenberg parameter is raised tenfold, and lowered tenfold after success.
    Levenberg {
        /// First parameter, > 0.
        initial: f64,
        /// Most increases for one step.
        most: u32,
    },
}

/// When the iteration has succeeded, and when it has failed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// Largest residual norm of a solution.
    pub residual_tolerance: f64,
    /// Largest norm of the last full step; infinite if only the residual counts.
    pub step_tolerance: f64,
    /// Most steps.
    pub max_iterations: usize,
    /// Damping.
    pub damping: Damping,
}

impl Default for Options {
    /// 1e-10 for residual and step, 50 steps, 20 halvings.
    fn default() -> Self {
        Self {
            residual_tolerance: 1e-10,
            step_tolerance: 1e-10,
            max_iterations: 50,
            damping: Damping::Halving { most: 20 },
        }
    }
}

/// One iteration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Record {
    /// Number of steps taken so far; 0 is the start.
    pub iteration: usize,
    /// ‖F‖ after them.
    pub residual_norm: f64,
    /// Norm of the last step before it was shortened; 0 at the start.
    pub step_norm: f64,
    /// Part of it that was taken, or the Levenberg parameter; 1 or the initial one at the start.
    pub damping: f64,
}

/// How an iteration ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// Residual and step are below their tolerances, or the residual was from the start.
    Converged,
    /// No step lowers the residual: x is at or near a local minimum of ‖F‖, or the Jacobian is wrong.
    Stalled,
    /// Still on its way.
    MaxIterations,
    /// Residual at the start, or a step, is not finite.
    NotFinite,
}

/// Part of ‖F‖ by which a full step must lower it (Armijo); small, since a Gauss–Newton step towards a minimum
/// that is not zero lowers it little.
const SUFFICIENT: f64 = 1e-6;

/// Memory and record of an iteration; may be used again for problems of any size.
#[derive(Clone, Debug, Default)]
pub struct Newton {
    residual: Vec<f64>,
    trial_residual: Vec<f64>,
    step: Vec<f64>,
    trial: Vec<f64>,
    history: Vec<Record>,
}

/// A step, or the reason for its failure.
enum Search {
    Found(Record),
    None,
    NotFinite,
}

impl Newton {
    /// Without memory yet.
    pub fn new() -> Self {
        Self::default()
    }

    /// The iterations of the last call, the start first.
    pub fn history(&self) -> &[Record] {
        &self.history
    }

    /// F at the x of the last call.
    pub fn residual(&self) -> &[f64] {
        &self.residual
    }

    /// Improves `x` until F(x) = 0 to the tolerances. Afterwards x is the last accepted iterate, whatever
    /// the outcome, and never worse than the start; a start that already satisfies the residual
    /// tolerance is returned untouched.
    ///
    /// # Errors
    /// The error of the equations.
    ///
    /// # Panics
    /// If `x` has another length than the unknowns.
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

    /// Searches a step that reduces the residual; the result is in `trial` and `trial_residual`.
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

    /// Residual norm after part of the step.
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

/// Whether the iteration ends after a step: solved, or with a residual that no longer falls.
fn judge(options: &Options, last: &Record, found: &Record) -> Option<Outcome> {
    if found.step_norm > options.step_tolerance {
        return None;
    }
    if found.residual_norm <= options.residual_tolerance {
        return Some(Outcome::Converged);
    }
    (found.residual_norm > 0.5 * last.residual_norm).then_some(Outcome::Stalled)
}
