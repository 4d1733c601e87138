//! Projection of states onto the constraints Φ(q, t) = 0 and Φ_q v + Φ_t = 0.
//!
//! Positions are projected first, then velocities. The result is the nearest state that satisfies the constraints, in
//! the metric of the mass matrix. For velocities, the difference then has the least kinetic energy:
//!
//! ```text
//! [ M   Φ_qᵀ ] [ Δq ]   [  0 ]        [ M   Φ_qᵀ ] [ Δv ]   [        0        ]
//! [ Φ_q  0   ] [ μ  ] = [ -Φ ] ,      [ Φ_q  0   ] [ μ  ] = [ -(Φ_q v + Φ_t) ]
//! ```
//!
//! (Eich, *Convergence results for a coordinate projection method applied to mechanical systems with algebraic
//! constraints*, SIAM J. Numer. Anal. 30 (1993) 1467.) The matrix is that of the equations of motion, so their last
//! factor can be used for chord iterations. Each iteration multiplies the error by about the ratio of the correction
//! to the size of the mechanism. The matrix is factorised again only if this is too slow.

use crate::equations::kinematics::Motions;
use crate::equations::{constraints, Residuals, Workspace};
use crate::math::{Largest, Listed, Real};
use crate::model::{column_scales, Model};
use crate::solve::Breakdown;

/// Largest number of iterations for positions, and for velocities.
pub(super) const MOST: usize = 12;
/// Largest number of iterations for reported states, which cannot be replaced as a step can. Near a singular position
/// Newton's method converges linearly: each iteration divides the residual by about 4.
const MOST_REPORTED: usize = 60;
/// If a chord iteration does not reduce the residual below this fraction, the matrix is factorised again.
pub(super) const SLOW: f64 = 1e-2;
/// Fraction of the residual that an iteration for velocities leaves if the factor is that of the same state.
const LINEAR: f64 = 1e-10;
/// Safety factor on the measured convergence if the residual after the last iteration is not evaluated.
pub(super) const MARGIN: f64 = 10.0;
/// A residual up to this multiple of the tolerance is a rounding error if Newton's iteration does not reduce it.
const ROUNDING: f64 = 1e3;
/// Fraction of the tolerance that may remain near a singular position.
const SHARP: f64 = 1e-3;
/// A larger residual never counts as a rounding error, even for large coordinates: the joint is open.
pub(super) const CLOSED: f64 = 1e-8;

/// The options of projection.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Projection {
    /// Largest remaining residual. Lengths are relative to the size of the mechanism, angles in rad, and rates
    /// relative to the largest rate of the state, or of all states so far for states between steps.
    pub tolerance: f64,
}

impl Default for Projection {
    /// 1e-12.
    fn default() -> Self {
        Self { tolerance: 1e-12 }
    }
}

/// Memory for projections with one model. Over lanes, all states are iterated until each satisfies the tolerance.
#[derive(Clone, Debug)]
pub struct Projector<'a, S = f64> {
    model: &'a Model<S>,
    tolerance: f64,
    /// 1 / scale of each coordinate.
    per_scale: Vec<f64>,
    /// Φ and Φ̇.
    residuals: Residuals<S>,
    /// The largest scaled residual of Φ and of Φ̇.
    gaps: [f64; 2],
    /// The data that are up to date for the current state.
    known: Known,
    /// Factor by which the last iteration with the current factorisation reduced the residual.
    lowering: f64,
    /// Fraction of the tolerance that may remain.
    part: f64,
    /// Whether iterations for positions end only where rounding errors prevent a smaller residual.
    exhausts: bool,
    /// The largest rate so far. None if the tolerance is relative to the rates of each state.
    fastest: Option<f64>,
    /// Right side, then (Δ, μ).
    correction: Vec<S>,
    /// Number of factorisations.
    pub factorisations: usize,
}

/// The data that are up to date for a state.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Known {
    Nothing,
    /// The positions in the motions.
    Positions,
    /// The motions and the residuals.
    All,
}

/// The constraint equations to be satisfied, as index into the residuals.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Level {
    Position = 0,
    Velocity = 1,
}

impl<'a, S: Real> Projector<'a, S> {
    /// Memory for a model.
    pub fn new(model: &'a Model<S>, options: Projection) -> Self {
        let unknowns = model.layout.n_q + model.layout.n_rows;
        Self {
            model,
            tolerance: options.tolerance,
            per_scale: column_scales(model).into_iter().map(|scale| 1.0 / scale).list(),
            residuals: Residuals::new(model),
            gaps: [f64::NAN; 2],
            known: Known::Nothing,
            lowering: 1.0,
            part: 1.0,
            exhausts: false,
            fastest: None,
            correction: vec![S::zero(); unknowns],
            factorisations: 0,
        }
    }

    /// The options of the projection.
    pub fn options(&self) -> Projection {
        Projection { tolerance: self.tolerance }
    }

    /// Configures the projection for reported states, from which no step starts. Their tolerance is relative to the
    /// fastest rate of all states, so that a state nearly at rest is not projected to irrelevant digits.
    pub fn for_reports(self) -> Self {
        Self { fastest: Some(0.0), ..self }
    }

    /// The fastest rate of the reported states so far, scaled as in [`Self::largest`]; 0 for other states.
    pub fn fastest(&self) -> f64 {
        self.fastest.unwrap_or(0.0)
    }

    /// The largest scaled residual of Φ at the last state.
    pub fn gap(&self) -> f64 {
        self.gaps[Level::Position as usize]
    }

    /// Sets whether to project to rounding errors. Near a singular position, a residual of Φ appears in the
    /// accelerations divided by σ³. If it `exhausts` the digits, the residual becomes as small as possible.
    pub fn sharpen(&mut self, sharp: bool, exhausts: bool) {
        self.part = if sharp || exhausts { SHARP } else { 1.0 };
        self.exhausts = exhausts;
    }

    /// Projects (q, v) in place and returns whether they changed. The motions of the workspace are then those of the
    /// new state. With `factored`, its matrix contains the factor of a nearby state.
    ///
    /// # Errors
    /// [`Breakdown`]; q and v are then invalid.
    pub fn project(
        &mut self,
        workspace: &mut Workspace<S>,
        t: S,
        (q, v): (&mut [S], &mut [S]),
        factored: bool,
    ) -> Result<bool, Breakdown> {
        (self.known, self.lowering) = (Known::Nothing, 1.0);
        match self.is_good(workspace, t, (&*q, &*v)) {
            true => self.omitted_hold(workspace, t, (&*q, &*v)).map(|()| false),
            false => self.bring(workspace, t, (q, v), factored),
        }
    }

    /// Projects only v, in place.
    ///
    /// # Errors
    /// As [`project`](Self::project).
    pub fn project_velocities(
        &mut self,
        workspace: &mut Workspace<S>,
        t: S,
        (q, v): (&mut [S], &mut [S]),
    ) -> Result<bool, Breakdown> {
        (self.known, self.lowering) = (Known::Nothing, 1.0);
        self.meet(Level::Velocity, workspace, t, (q, v), &mut false)
    }

    /// Whether the state satisfies the tolerance, as most reported states do.
    #[inline(always)]
    fn is_good(&mut self, workspace: &mut Workspace<S>, t: S, (q, v): (&[S], &[S])) -> bool {
        self.look(workspace, t, (q, v));
        let [position, velocity] = self.gaps;
        position <= self.targets(Level::Position, q, v, position).0
            && velocity <= self.targets(Level::Velocity, q, v, velocity).0
    }

    /// Projects a state whose residuals have been computed.
    #[inline(never)]
    fn bring(
        &mut self,
        workspace: &mut Workspace<S>,
        t: S,
        (q, v): (&mut [S], &mut [S]),
        mut factored: bool,
    ) -> Result<bool, Breakdown> {
        let mut changed = false;
        for level in [Level::Position, Level::Velocity] {
            changed |= self.meet(level, workspace, t, (&mut *q, &mut *v), &mut factored)?;
        }
        self.omitted_hold(workspace, t, (&*q, &*v))?;
        self.move_bodies(&mut workspace.motions, (q, v));
        Ok(changed)
    }

    fn meet(
        &mut self,
        level: Level,
        workspace: &mut Workspace<S>,
        t: S,
        (q, v): (&mut [S], &mut [S]),
        factored: &mut bool,
    ) -> Result<bool, Breakdown> {
        let (mut last, mut newton) = (f64::INFINITY, false);
        let (mut target, mut rounding) = (0.0, 0.0);
        let most = if self.fastest.is_some() { MOST_REPORTED } else { MOST };
        for iteration in 0..most {
            self.look(workspace, t, (&*q, &*v));
            let gap = self.gaps[level as usize];
            if iteration == 0 {
                (target, rounding) = self.targets(level, q, v, gap);
            }
            if iteration > 0 {
                self.lowering = gap / last;
            }
            if gap <= target {
                return Ok(iteration > 0);
            }
            let slow = gap > SLOW * last;
            if newton && workspace.matrix.regularised() && gap > 0.5 * last {
                let scale = if level == Level::Velocity { self.largest(v) } else { 1.0 };
                if gap <= level.near() * scale {
                    return Ok(true);
                }
            }
            if slow && newton && gap <= rounding {
                return Ok(true);
            }
            newton = slow || !*factored;
            if newton {
                self.factor(workspace, t)?;
                *factored = true;
                self.lowering = if level == Level::Velocity { LINEAR } else { 1.0 };
            }
            let x = if level == Level::Position { &mut *q } else { &mut *v };
            self.correct(level, workspace, x);
            if level == Level::Velocity && MARGIN * self.lowering * gap <= target {
                return Ok(true);
            }
            last = gap;
        }
        Err(self.open(level))
    }

    /// Checks that the omitted rows are satisfied. If not, the state is on another branch, on which they are not
    /// redundant.
    fn omitted_hold(
        &mut self,
        workspace: &mut Workspace<S>,
        t: S,
        place: (&[S], &[S]),
    ) -> Result<(), Breakdown> {
        if workspace.matrix.omitted().is_empty() {
            return Ok(());
        }
        self.look(workspace, t, place);
        let (row, gap) = self.residuals.omitted;
        match gap <= CLOSED.max(self.tolerance) {
            true => Ok(()),
            false => Err(Breakdown::Open { row, gap: gap / self.residuals.per_scale[row] }),
        }
    }

    /// The row with the largest residual at the last evaluation.
    fn open(&self, level: Level) -> Breakdown {
        let mut worst = (0, 0.0, 0.0);
        let rows = self.residuals.rows[level as usize].iter().zip(&self.residuals.per_scale);
        for (row, (r, per_scale)) in rows.enumerate() {
            let gap = r.largest_magnitude();
            let scaled = gap * per_scale;
            // keeps NaN
            if scaled > worst.2 || scaled.is_nan() {
                worst = (row, gap, scaled);
            }
        }
        Breakdown::Open { row: worst.0, gap: worst.1 }
    }

    /// The target of the residual, and the residual that is accepted if rounding errors prevent the target.
    #[inline(always)] // the level is a constant at each call
    fn targets(&mut self, level: Level, q: &[S], v: &[S], gap: f64) -> (f64, f64) {
        let (target, most) = match level {
            Level::Position => {
                let target = self.part * self.tolerance;
                // rounding errors matter only if the tolerance is not satisfied
                let rounding = match gap <= target || self.exhausts {
                    true => 0.0,
                    false => 8.0 * f64::EPSILON * self.largest(q),
                };
                (target.max(rounding), CLOSED.max(self.tolerance))
            }
            // the rates of a mechanism at rest have no accurate digits
            Level::Velocity => {
                let largest = self.largest(v).max(gap);
                self.fastest = self.fastest.map(|fastest| fastest.max(largest));
                let target = self.part * self.tolerance * self.fastest.unwrap_or(largest);
                (target.max(f64::MIN_POSITIVE), f64::INFINITY)
            }
        };
        (target.min(most), (ROUNDING * target).min(most))
    }

    /// Updates motions, residuals and gaps for the current state.
    #[inline(never)] // one copy for several calls
    fn look(&mut self, workspace: &mut Workspace<S>, t: S, place: (&[S], &[S])) {
        if self.known == Known::All {
            return;
        }
        self.move_bodies(&mut workspace.motions, place);
        let Workspace { motions, compiled, matrix, .. } = workspace;
        let of = (self.model, &**compiled);
        self.gaps = self.residuals.look(of, motions, t, matrix.omitted());
        self.known = Known::All;
    }

    /// Updates the motions for the current state.
    fn move_bodies(&self, motions: &mut Motions<S>, (q, v): (&[S], &[S])) {
        match self.known {
            Known::Nothing => motions.place(&self.model.layout, q, v),
            Known::Positions => motions.set_rates(&self.model.layout, v),
            Known::All => {}
        }
    }

    /// Factorises at the state of the last call of `look`.
    fn factor(&mut self, workspace: &mut Workspace<S>, t: S) -> Result<(), Breakdown> {
        let Workspace { motions, matrix, compiled, .. } = workspace;
        self.residuals.jacobian(self.model, motions, t, matrix.jacobian_mut());
        matrix.set_mass(compiled, motions);
        self.factorisations += 1;
        matrix.factor()
    }

    /// One iteration with the current factor.
    fn correct(&mut self, level: Level, workspace: &Workspace<S>, x: &mut [S]) {
        let (upper, lower) = self.correction.split_at_mut(x.len());
        upper.fill(S::zero());
        let open = &self.residuals.rows[level as usize];
        lower.iter_mut().zip(open).for_each(|(right, r)| *right = -*r);
        workspace.matrix.solve(&mut self.correction);
        x.iter_mut().zip(&self.correction).for_each(|(x, dx)| *x += *dx);
        self.known = match level {
            Level::Position => Known::Nothing,
            Level::Velocity => Known::Positions,
        };
    }

    /// Projects a displacement onto the null space of Φ_q, with the current factor.
    pub fn tangent(&mut self, workspace: &Workspace<S>, x: &mut [S]) {
        let (upper, lower) = self.correction.split_at_mut(x.len());
        upper.fill(S::zero());
        for (k, slots) in self.model.layout.constraints.iter().enumerate() {
            let rows = &mut lower[slots.rows.clone()];
            constraints::times(self.model, k, workspace.matrix.jacobian(), x, rows);
            rows.iter_mut().for_each(|r| *r = -*r);
        }
        workspace.matrix.solve(&mut self.correction);
        x.iter_mut().zip(&self.correction).for_each(|(x, dx)| *x += *dx);
    }

    /// The largest coordinate or rate. Lengths are divided by the size of the mechanism.
    pub fn largest(&self, x: &[S]) -> f64 {
        self.largest_of(x.iter().copied())
    }

    /// The largest difference of coordinates or rates, scaled as in [`Self::largest`].
    pub fn largest_difference(&self, a: &[S], b: &[S]) -> f64 {
        self.largest_of(a.iter().zip(b).map(|(a, b)| *a - *b))
    }

    fn largest_of(&self, x: impl Iterator<Item = S>) -> f64 {
        let mut largest = Largest::new();
        x.zip(&self.per_scale).for_each(|(x, per_scale)| largest.add(x * S::constant(*per_scale)));
        largest.get()
    }
}

impl Level {
    /// Residual that may remain near a singular position, relative as the tolerance is. There, a deviation e leaves
    /// residuals of order e² in positions and of order e in velocities.
    fn near(self) -> f64 {
        match self {
            Self::Position => 1e-9,
            Self::Velocity => 1e-6,
        }
    }
}
