//! Steps at the beginning and at the end of compliant contacts.
//!
//! Let m be the effective mass of the mechanism at the contact. If it arrives with speed v at a contact with the
//! force k δⁿ, it stays in contact for about 3 δ/v and reaches the depth δ = ((n + 1) m v²/(2 k))^(1/(n + 1)).
//! Constant steps of an explicit method may be too long for this. Methods with error control detect steps that are
//! too long. If n is not an integer, however, the force begins and ends like tⁿ, without higher derivatives, and
//! error estimates are too small there. The first and the last steps are then graded.

use super::modes::StateAt;
use super::motion_ode::MotionOde;
use crate::elements::Behaviour;
use crate::math::{Jet, Listed};
use crate::model::{Model, SwitchOwner};
use crate::solve::Breakdown;

/// Least number of constant steps in a contact.
const STEPS: f64 = 10.0;
/// Time in contact divided by δ/v: π for a linear spring, 2.94 for a sphere.
const DURATION: f64 = 3.0;
/// Ends of the first steps as fractions of the time in contact, and of the last steps as fractions of one step.
const GRADED: [f64; 4] = [0.25, 0.05, 0.01, 0.002];

/// How a method chooses its steps.
#[derive(Clone, Copy, Debug)]
pub(super) enum StepChoice {
    /// Constant steps of an explicit method.
    Constant(f64),
    /// Constant steps of an implicit method.
    Implicit,
    /// Steps chosen by the error.
    Chosen,
}

impl StepChoice {
    /// Whether contacts with this exponent change the steps.
    fn depend_on(self, exponent: f64) -> bool {
        match self {
            Self::Constant(_) => true,
            Self::Implicit => false,
            Self::Chosen => exponent.fract() != 0.0,
        }
    }
}

/// A contact that begins.
struct Onset {
    force: usize,
    /// Approximate duration, s.
    lasts: f64,
}

/// Ends of the first steps, last step first, of contacts that begin at a state where these switches change. None if
/// no contact begins that changes the steps. The arguments include the steps of the method and the direction of time.
///
/// # Errors
/// [`Breakdown::Unresolved`] if constant steps are too long.
pub(super) fn ends(
    ode: &mut MotionOde<'_>,
    at: (f64, &[f64]),
    changes: &[(usize, f64)],
    (steps, sign): (StepChoice, f64),
) -> Result<Option<Vec<f64>>, Breakdown> {
    let Some(onset) = Onset::find(ode, at, changes, steps)? else { return Ok(None) };
    Ok(Some(onset.ends(steps)?.into_iter().map(|after| at.0 + sign * after).list()))
}

/// Ends of the last steps, last step first, before a compliant contact is released at the end of a step. The force
/// ends as it begins.
pub(super) fn before_release(
    model: &Model,
    changes: &[(usize, f64)],
    (from, to): (f64, f64),
    steps: StepChoice,
) -> Vec<f64> {
    let is_released = |(switch, piece): &(usize, f64)| match model.switches[*switch].owner {
        SwitchOwner::Force(force) if *piece < 0.0 => {
            let behaviour = model.forces[force].element.behaviour();
            matches!(behaviour, Some(Behaviour::Compliant { exponent, .. }) if exponent.fract() != 0.0)
        }
        _ => false,
    };
    match steps {
        StepChoice::Chosen if changes.iter().any(is_released) => {
            GRADED.iter().rev().map(|part| to - part * (to - from)).list()
        }
        _ => Vec::new(),
    }
}

impl Onset {
    /// The shortest contact that begins where these switches change, among contacts that change the steps.
    fn find(
        ode: &mut MotionOde<'_>,
        at: (f64, &[f64]),
        changes: &[(usize, f64)],
        steps: StepChoice,
    ) -> Result<Option<Self>, Breakdown> {
        let model = ode.model;
        let begun = changes.iter().filter(|(_, piece)| *piece > 0.0);
        let compliant = begun.filter_map(|(switch, _)| match model.switches[*switch].owner {
            SwitchOwner::Force(force) => match model.forces[force].element.behaviour()? {
                Behaviour::Compliant { stiffness, exponent, .. } if steps.depend_on(exponent) => {
                    Some((force, stiffness, exponent))
                }
                _ => None,
            },
            SwitchOwner::Constraint(_) => None,
        });
        let (mut found, mut lifted): (Option<Self>, Option<Model<Jet>>) = (None, None);
        for contact in compliant {
            let lifted = lifted.get_or_insert_with(|| model.lift());
            let own = Self::of_contact(ode, lifted, at, contact)?;
            found = own.into_iter().chain(found).min_by(|a, b| a.lasts.total_cmp(&b.lasts));
        }
        Ok(found)
    }

    fn of_contact(
        ode: &mut MotionOde<'_>,
        lifted: &Model<Jet>,
        (t, y): (f64, &[f64]),
        (force, stiffness, exponent): (usize, f64, f64),
    ) -> Result<Option<Self>, Breakdown> {
        let model = ode.model;
        let mut y = y.to_vec();
        let speed = -StateAt::new(lifted, t, &mut y).gap_rate(lifted, force);
        let gradient = gradient(lifted, (t, &mut y.clone()), force);
        let response =
            ode.workspace.velocity_jump(model, t, model.layout.split(&y)[0], &gradient)?;
        let per_mass: f64 = gradient.iter().zip(&response).map(|(g, v)| g * v).sum();
        let work = 0.5 * speed * speed / per_mass;
        let depth = ((exponent + 1.0) * work / stiffness).powf(1.0 / (exponent + 1.0));
        let lasts = DURATION * depth / speed;
        Ok((speed > 0.0 && lasts.is_finite()).then_some(Self { force, lasts }))
    }

    /// Times after the beginning of the contact at which the first steps end, last step first.
    fn ends(&self, steps: StepChoice) -> Result<Vec<f64>, Breakdown> {
        let Self { force, lasts } = *self;
        match steps {
            StepChoice::Constant(step) if STEPS * step > lasts => {
                Err(Breakdown::Unresolved { force, lasts, step })
            }
            StepChoice::Chosen => Ok(GRADED.iter().map(|part| part * lasts).list()),
            _ => Ok(Vec::new()),
        }
    }
}

/// Derivatives of the rate of the gap with respect to the rates of the coordinates. Changes `y`.
fn gradient(model: &Model<Jet>, (t, y): (f64, &mut [f64]), force: usize) -> Vec<f64> {
    let mut rate = |one: Option<usize>| {
        let [_, v, ..] = model.layout.split_mut(y);
        v.fill(0.0);
        if let Some(k) = one {
            v[k] = 1.0;
        }
        StateAt::new(model, t, y).gap_rate(model, force)
    };
    let still = rate(None);
    let mut gradient = vec![0.0; model.layout.n_q];
    for body in model.forces[force].element.bodies() {
        let columns = model.layout.bodies[body.0].range();
        columns.for_each(|k| gradient[k] = rate(Some(k)) - still);
    }
    gradient
}
