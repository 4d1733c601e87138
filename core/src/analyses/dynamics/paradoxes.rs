//! Friction paradoxes of a run, and what it reports about the uniqueness of its motion.

use super::failure::{Failure, Reason};
use super::modes::{self, Settled, StateAt, Uniqueness};
use super::options::Jam;
use super::run::{PhaseEnd, Progress};
use super::run_results::Run;
use super::setting::Setting;
use crate::elements::Mode;
use crate::math::Listed;
use crate::model::{listed, Model};
use serde::{Deserialize, Serialize};

/// The contacts at which a paradox ended a phase, and what was reported.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(super) struct Paradoxes {
    lost: Vec<usize>,
    /// Whether a paradox, several motions, motions that were not examined, or shared friction were reported.
    told: [bool; 4],
}

impl Paradoxes {
    /// The contacts at which a paradox ended the phase.
    pub fn take(&mut self) -> Vec<usize> {
        std::mem::take(&mut self.lost)
    }

    /// Ends a phase that fails, if the normal force of a contact that slides grows without bound.
    ///
    /// # Errors
    /// The failure of the phase where it has another cause.
    pub fn end(
        &mut self,
        (base, setting, jam): (&Model, &Setting, Jam),
        at: &mut Progress,
        failure: Box<Failure>,
    ) -> Result<PhaseEnd, Box<Failure>> {
        if matches!(failure.reason, Reason::Singular { .. } | Reason::Integration { .. }) {
            self.lost = lost(base, setting, at, &|_| true);
        }
        if self.lost.is_empty() {
            return Err(failure.advised(jam));
        }
        Ok(PhaseEnd::Event)
    }

    /// Looks for paradoxes where the modes of some forces end. Where its force grows without bound, sliding ends at a speed
    /// or a force that is not zero, or at no event.
    pub fn look(
        &mut self,
        (base, setting): (&Model, &Setting),
        at: &mut Progress,
        ended: &[usize],
    ) {
        let none = at.fired.is_empty();
        if none || !ended.is_empty() {
            let own = |force: usize, k: usize| k == force || base.forces[k].partner == Some(force);
            let of = |force| none || ended.iter().any(|k| own(force, *k));
            self.lost = lost(base, setting, at, &of);
        }
    }

    /// Adds what a user has to know about the motion that follows. Each kind is reported once.
    pub fn tell(
        &mut self,
        (model, place): (&Model, &StateAt<'_>),
        settled: &Settled,
        run: &mut Run,
    ) {
        let (t, name) = (place.t, |k: usize| &model.forces[k].name);
        let jam = settled.jammed.first();
        if let Some(k) = jam.filter(|_| !std::mem::replace(&mut self.told[0], true)) {
            run.doubts.push(format!(
                "friction paradox (Painlevé) of {} at t = {t:.6} s: no normal force agrees with its friction; an impact \
                 without collision ended the sliding (jam = \"impact\")",
                name(*k)
            ));
        }
        let asked = !self.told[3];
        let names = if asked { modes::shared_at(model, &settled.modes, place) } else { Vec::new() };
        if !names.is_empty() {
            self.told[3] = true;
            let names = listed(&names.iter().map(|name| &name[..]).list());
            run.notes.push(format!(
                "from t = {t:.6} s on, the forces of {names} are not unique: contacts and friction at rest share the load \
                 in one of several ways, each within its limits"
            ));
        }
        match settled.uniqueness {
            Uniqueness::Several(k) if !std::mem::replace(&mut self.told[1], true) => {
                run.doubts.push(format!(
                    "the motion from t = {t:.6} s on is not unique: with rigid contacts and their friction, {} can \
                     press or separate; less friction, or a stiffness in place of restitution, makes it unique",
                    name(k)
                ));
            }
            Uniqueness::Unknown if !std::mem::replace(&mut self.told[2], true) => {
                run.notes.push(format!(
                    "from t = {t:.6} s on it was not examined whether the motion is unique: more than {} contacts \
                     with friction slide, or other friction slides or sticks beside them",
                    modes::MOST
                ));
            }
            _ => {}
        }
    }
}

/// The contacts that rest and slide in a paradox, among those with friction `of` some forces.
fn lost(
    base: &Model,
    setting: &Setting,
    at: &mut Progress,
    of: &dyn Fn(usize) -> bool,
) -> Vec<usize> {
    let modes = setting.modes.iter().filter(|own| of(own.force));
    if !modes.clone().any(|own| matches!(own.mode, Mode::Slides(_))) {
        return Vec::new();
    }
    let Ok(open) = setting.open(base) else { return Vec::new() };
    let place = StateAt::new(&*open, at.t, &mut at.y);
    let found = modes.map(|own| modes::lost(&open, &place, &setting.modes, own));
    found.filter_map(|found| found.ok().flatten()).list()
}
