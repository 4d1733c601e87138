//! Options of forward dynamics.

use super::absolute_tolerance;
use super::methods::Scheme;
use super::stabilizations::Stabilization;
use crate::analyses::event_options::{condition, drivers, events, values};
use crate::analyses::options::{
    count, flag, name, number, options, positive, words, Declared, Reader,
};
use crate::equations::Gains;
use crate::model::{Model, Problem, Value};
use serde::{Deserialize, Serialize};

/// Numerator of the default of max_steps, which is divided by the number of moving bodies. It corresponds to some
/// seconds, and to half a gigabyte if everything is stored.
const MOST_WORK: usize = 1_000_000;
/// Smallest default of max_steps, for large models.
const LEAST_BOUND: usize = 50_000;

/// The states that are reported without `output_step`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Output {
    /// The solver's own steps.
    Steps,
}

/// The policy at a singular position where the motion does not decide the branch.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Singularity {
    /// Stop with an error that names time, position and joints.
    #[default]
    Stop,
    /// Continue; rounding decides the branch.
    Pass,
}

/// The contacts that act in an impact.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum ImpactOrder {
    /// Those that approach, in rounds until none approaches.
    #[default]
    Sequential,
    /// All that are closed, in one complementarity problem.
    Simultaneous,
}

/// The meaning of the restitution where contacts have friction or act together.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum RestitutionLaw {
    /// The impulse of expansion over the impulse of compression.
    #[default]
    Poisson,
    /// The rate of a gap after the impact over the rate before it.
    Newton,
}

/// The policy where no reaction agrees with the friction of a contact.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Jam {
    /// Stop with an error that names the contact.
    #[default]
    Refuse,
    /// An impact without collision ends the sliding, if it is unique.
    Impact,
}

/// The laws of impacts.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
pub struct ImpactLaws {
    /// The contacts that act.
    pub order: ImpactOrder,
    /// The meaning of the restitution.
    pub restitution: RestitutionLaw,
    /// The policy at a friction paradox.
    pub jam: Jam,
}

words!(Jam { "refuse" => Self::Refuse, "impact" => Self::Impact });
words!(ImpactOrder { "sequential" => Self::Sequential, "simultaneous" => Self::Simultaneous });
words!(RestitutionLaw { "poisson" => Self::Poisson, "newton" => Self::Newton });
words!(Output { "steps" => Self::Steps });
words!(Singularity { "stop" => Self::Stop, "pass" => Self::Pass });

options! {
    /// Motion under forces, computed by integration of the equations of motion.
    Options, "dynamics", "Dynamics" (
        /// Time at which the simulation ends.
        t_end: number [s]
    ) {
        /// Time between the reported states; if absent, the steps of the solver are reported.
        output_step: Option<positive> [s] = None,
        /// Method of integration.
        method: Scheme = Scheme::default(),
        /// Stabilization of the constraints against drift.
        stabilization: Stabilization = Stabilization::default(),
        /// Largest number of steps. The run fails if it needs more steps. It fails at once if this
        /// number of steps of the largest allowed length cannot reach t_end. If absent, 1 000 000
        /// divided by the number of moving bodies, but at least 50 000. With explicit methods, half
        /// of this number of rejected steps, but at least 10 000, also ends the run.
        max_steps: Option<count> = None,
        /// Whether the solution can be evaluated at any time.
        dense_output: flag = true,
        /// Time at which the simulation starts; if absent, the time of the first state.
        t_start: Option<number> [s] = None,
        /// Behaviour at a singular position where the motion does not determine its branch. "stop"
        /// ends the run with an error. "pass" continues, and rounding determines the branch.
        singularity: Singularity = Singularity::Stop,
        /// Contacts and stops that act in an impact. "sequential": those that approach, in rounds until
        /// none approaches. "simultaneous": all that are closed, in one complementarity problem.
        impacts: ImpactOrder = ImpactOrder::Sequential,
        /// Restitution where contacts have friction or act simultaneously. "poisson": the impulse of
        /// expansion over that of compression. "newton": the rate after the impact over that before
        /// it; the run ends where this would gain energy.
        restitution_law: RestitutionLaw = RestitutionLaw::Poisson,
        /// Behaviour where no reaction agrees with the friction of a contact that slides (Painlevé's
        /// paradox). "refuse" ends the run with an error. "impact" takes the impact without collision
        /// that ends the sliding, if it is the only one.
        jam: Jam = Jam::Refuse,
        /// "steps" reports the steps of the solver, which is also the default without
        /// `output_step`.
        output: Option<Output> = None,
        /// State at which the analysis starts: "start", or the name of an earlier analysis to use
        /// its final state. If absent, the final state of the previous analysis.
        from: Option<name> = None,
        /// Events by name, each with its condition. A comparison is an event where it becomes true.
        /// An expression is an event at each of its zeros. A table has more fields:
        /// `{ condition = "C.force - 900", direction = "rising", stop = true }`.
        /// `stop = 3` ends the run at the third event.
        events: events = Vec::new(),
        /// Condition at which the run ends.
        stop: Option<condition> = None,
        /// Drivers that are released in this analysis and in analyses that start from it.
        release: drivers = Vec::new(),
        /// Values of parameters that replace those of the model in this analysis.
        parameters: values = Vec::new(),
        /// Largest residual of the Newton-Euler equations of the result, relative to the largest
        /// force. A result beyond this limit, or one of the next three, is an error.
        force_limit: positive = 1e-8,
        /// Largest opening of a joint in the result, relative to the size of the mechanism, or in
        /// rad. If absent, 1e-9, or the tolerance of the projection if it is larger. Without
        /// projection, an opening beyond the limit, 1e-4 if absent, is a warning.
        joint_limit: Option<positive> = None,
        /// Largest depth of a stop or contact with restitution in the result, relative to the size
        /// of the mechanism, or in rad. If absent, 1e-6, or 100 rtol if it is larger. Without
        /// projection, a larger depth is a warning.
        penetration_limit: Option<positive> = None,
        /// Largest energy balance of the result, relative to the largest energy. If absent, 1e-3,
        /// or 10 000 rtol if it is larger. Without projection, with constant steps and with
        /// methods that damp (generalized_alpha, hht), a larger balance is a warning.
        energy_limit: Option<positive> = None,
    }
    excludes { output_step: output; }
}

/// Reads the fields of an analysis of type `dynamics`; `path` is its path in the file.
///
/// # Errors
/// Every faulty value, with its path.
pub fn read(
    model: &Model,
    fields: &[(String, Value)],
    path: &[String],
) -> Result<Options, Vec<Problem>> {
    Reader::read(model, fields, path, Options::read)
}

/// Default of max_steps: 1 000 000 over the number of moving bodies, and at least 50 000.
pub fn most_steps(model: &Model) -> usize {
    (MOST_WORK / (model.bodies.len() - 1).max(1)).max(LEAST_BOUND)
}

impl Options {
    /// The laws of impacts.
    pub(super) fn impact_laws(&self) -> ImpactLaws {
        ImpactLaws { order: self.impacts, restitution: self.restitution_law, jam: self.jam }
    }

    /// The classical options: Dormand–Prince with Baumgarte's α = 10, β = 200.
    pub fn classical(t_end: f64) -> Self {
        Self {
            method: Scheme::Rk45(Default::default()),
            stabilization: Stabilization::classical(),
            ..Self::new(t_end)
        }
    }

    /// The fault of a run whose end is before its start. Runs of this crate may go backward in time; runs of cases
    /// and of the Python package may not.
    ///
    /// # Arguments
    /// `t` is the time of the first state, s; `path` is the path of t_end in the file.
    pub fn backward(&self, t: f64, path: &[&str]) -> Option<Problem> {
        let begin = self.t_start.unwrap_or(t);
        (self.t_end < begin).then(|| {
            let message = format!("{} s lies before {begin} s, where the run starts", self.t_end);
            Problem::at(path, message)
                .hint(format!("t_end is a time, not a duration; it must be at least {begin} s"))
        })
    }

    /// The method with a limit on its steps (its own, the run's, or [`most_steps`]) and with an absolute tolerance
    /// for this model.
    pub(super) fn bounded_method(&self, model: &Model) -> Scheme {
        let mut bounded = self.method.clone();
        let most = self.max_steps.unwrap_or_else(|| most_steps(model));
        let control = bounded.control_mut();
        control.max_steps.get_or_insert(most);
        control.atol = absolute_tolerance::for_model(model, &control.atol);
        bounded
    }

    /// The gains that the right side uses.
    pub fn gains(&self) -> Gains {
        match self.stabilization {
            Stabilization::Baumgarte(gains) => gains,
            _ => Gains::default(),
        }
    }
}
