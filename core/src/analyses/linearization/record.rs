//! Small motions about a state as an analysis.

use super::eigenvalues::eigenvalues;
use super::failure::{coordinate, Failure};
use super::linearize::{begins, linearize};
use super::options::Options;
use crate::analyses::record::{
    Analysis, ErrorClass, Fact, NamedNumber, NumberList, Observer, Outcome, Record, RunResult,
    StartState, Subject,
};
use crate::analyses::{dynamics::friction_modes, State};
use crate::elements::Mode;
use crate::math::{each, Complex, Listed, ShortArray};
use crate::model::{ForceMode, Model};
use serde_json::json;
use std::f64::consts::TAU;
use std::sync::Arc;

/// Rate or acceleration of a coordinate, beside |s| or |s|², that counts as an equilibrium.
const AT_REST: f64 = 1e-6;

impl Analysis for Options {
    const NUMBERS: &'static [NamedNumber] = &[
        NamedNumber::listed("frequency", "Hz"),
        NamedNumber::new("damping", "", |of, _| {
            NumberList::list(of.table("damping_ratio").iter().copied())
        }),
        NamedNumber::listed("omega", "rad/s"),
        NamedNumber::new("eigenvalues", "1/s", |of, _| {
            let rows = of.table("eigenvalues").chunks(2);
            NumberList::complex(rows.map(|s| Complex::new(s[0], s[1])).list())
        }),
        NamedNumber::finding("stable", ""),
        NamedNumber::finding("is_equilibrium", ""),
        NamedNumber::listed("values", ""),
        NamedNumber::listed("rates", ""),
        NamedNumber::listed("acceleration", ""),
    ];

    fn begins(&self, subject: &Subject<'_>, start: &StartState) -> Result<(), Outcome> {
        Ok(begins(&self.model(subject, start)?.0, &start.state)?)
    }

    fn run(&self, subject: &Subject<'_>, start: &StartState, _: Observer<'_>) -> RunResult {
        let (model, locked) = self.model(subject, start)?;
        let found = linearize(&model, &start.state, (&self.inputs, &self.outputs), self.rotating);
        let found = found.map_err(|failure| self.outcome(failure))?;
        let (f, n_q) = (found.coordinates.len(), model.layout.n_q);
        let n = 2 * f + found.states.len();
        let names = found.coordinates.iter().map(|column| coordinate(&model, *column));
        let mut findings = json!({
            "coordinates": names.list(), "columns": found.coordinates,
            "states": found.states, "inputs": self.inputs, "outputs": self.outputs, "n": self.n,
            "locked": locked,
        });
        let held = (!locked.is_empty()).then(|| Fact::new("locked by friction", locked.join(", ")));
        let mut modes = eigenvalues(&found);
        let named = modes.iter().enumerate().flat_map(|(k, s)| mode(k + 1, *s));
        let facts: Vec<Fact> = held.into_iter().chain(named).list();
        modes.truncate(self.n.unwrap_or(modes.len()));
        let own = |of: &[f64]| -> Vec<f64> { found.coordinates.iter().map(|k| of[*k]).list() };
        let motion = [own(&found.velocity), own(&found.acceleration)];
        let fastest = modes.iter().map(|s| size(*s)).fold(0.0, f64::max);
        let [moves, accelerates] = each([0, 1], |order| {
            let largest = motion[order].iter().map(|x| x.abs()).fold(0.0, f64::max);
            let scale = fastest.powi(order as i32 + 1);
            largest / if scale > 0.0 { scale } else { 1.0 } > AT_REST
        });
        findings["moves"] = json!(moves);
        findings["is_equilibrium"] = json!(!moves && !accelerates);
        findings["stable"] = json!(modes.iter().all(|s| s.re < 0.0));
        let [inputs, outputs] = [&self.inputs, &self.outputs].each(Vec::len);
        let [rates, acceleration] = motion;
        let of_modes = |read: fn(Complex) -> f64| modes.iter().map(|s| read(*s)).list();
        let count = modes.len();
        let pairs = modes.iter().flat_map(|s| [s.re, s.im]).list();
        Ok(Record::new(findings, start.clone())
            .facts(facts)
            .with("eigenvalues", [count, 2], pairs)
            .with("frequency", [count, 1], of_modes(|s| s.im / TAU))
            .with("omega", [count, 1], of_modes(size))
            .with("damping_ratio", [count, 1], of_modes(ratio))
            .with("rates", [1, f], rates)
            .positions([start.examined()])
            .with("basis", [f, n_q], found.basis.concat())
            .with("mass", [f, f], found.mass)
            .with("damping", [f, f], found.damping)
            .with("stiffness", [f, f], found.stiffness)
            .with("A", [n, n], found.a)
            .with("B", [n, inputs], found.b)
            .with("C", [outputs, n], found.c)
            .with("D", [outputs, inputs], found.d)
            .with("acceleration", [1, f], acceleration)
            .with("values", [1, outputs], found.values))
    }
}

/// |s|.
fn size(s: Complex) -> f64 {
    s.re.hypot(s.im)
}

/// The damping ratio -Re s / |s|; 0 for s = 0.
fn ratio(s: Complex) -> f64 {
    let size = size(s);
    0.0 - s.re / if size > 0.0 { size } else { 1.0 }
}

/// The frequency and the damping ratio of a mode with the eigenvalue s, or how it decays or grows.
fn mode(number: usize, s: Complex) -> Vec<Fact> {
    if s.im > 0.0 {
        let frequency = Fact::new(format!("mode {number}: frequency"), s.im / TAU).unit("Hz");
        return vec![frequency, Fact::new(format!("mode {number}: damping ratio"), ratio(s))];
    }
    match s.re {
        0.0 => vec![Fact::new(format!("mode {number}"), "it moves freely")],
        _ => {
            let way = if s.re < 0.0 { "decays" } else { "grows" };
            vec![Fact::new(format!("mode {number} {way} with the rate"), s.re).unit("1/s")]
        }
    }
}

impl Options {
    /// The model whose motions are small, and the names of the forces that lock joints in it.
    ///
    /// # Errors
    /// The forces that hold cannot be determined.
    pub(in crate::analyses) fn model(
        &self,
        subject: &Subject<'_>,
        start: &StartState,
    ) -> Result<(Arc<Model>, Vec<String>), Failure> {
        let model = subject.released(start);
        let State { t, q, v, z } = &start.state;
        let found = match self.lock_friction {
            true => friction_modes(&model, [&[*t], q, v, z]).map_err(Failure::Motion)?,
            false => Vec::new(),
        };
        let holds = |of: &ForceMode| matches!(of.mode, Mode::Holds(_));
        let modes: Vec<ForceMode> = found.concat().into_iter().filter(holds).list();
        let names = modes.iter().map(|of| model.forces[of.force].name.clone()).list();
        Ok(if modes.is_empty() {
            (model, names)
        } else {
            (Arc::new(model.in_modes(&modes)), names)
        })
    }

    fn outcome(&self, failure: Failure) -> Outcome {
        match failure {
            Failure::NoDerivative(k) => {
                let name = &self.outputs[k];
                let message = format!(
                    "{name}: it has no derivative at this state, such as the magnitude of a force \
                     that is zero"
                );
                Outcome::new(ErrorClass::Model, message).name(name)
            }
            other => other.into(),
        }
    }
}

impl From<Failure> for Outcome {
    fn from(failure: Failure) -> Self {
        let outcome = |class| Self::new(class, failure.to_string());
        match &failure {
            Failure::Singular { t, name, .. } => outcome(ErrorClass::Singularity)
                .name(name)
                .at(*t)
                .hint("give a state beside this position"),
            Failure::Open { t, name, .. } => outcome(ErrorClass::Assembly)
                .name(name)
                .at(*t)
                .hint("kp.assemble(model, from_state=state) assembles the mechanism anew"),
            Failure::NoInertia { t, name, .. } => {
                outcome(ErrorClass::Singularity).name(name).at(*t)
            }
            Failure::Motion(motion) => {
                let own = Self::from(motion.reason.clone());
                match own.class {
                    ErrorClass::Assembly => own.hint("give it a stiffness in place of restitution"),
                    _ => Self { class: ErrorClass::Singularity, ..own }
                        .hint("give a state beside this one, or change the mechanism"),
                }
            }
            Failure::Name(problem) => {
                outcome(ErrorClass::Model).hint(problem.hint.clone().unwrap_or_default())
            }
            Failure::Geometry { .. } | Failure::NoDerivative(_) => outcome(ErrorClass::Model),
            Failure::Rotation { t, .. } => outcome(ErrorClass::Assembly).at(*t).hint(
                "with rotating = true, all bodies rotate about one point of ground with the same constant rate, and the \
                 model has no gravity; leave it out for motions in the frame of ground",
            ),
        }
    }
}
