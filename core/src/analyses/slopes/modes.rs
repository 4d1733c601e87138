//! The numbers of modes with their derivatives.

use super::gradient::NumberSlopes;
use super::spectrum::{ModeEquations, Moved, Vector};
use super::variant::ReadyVariant;
use crate::analyses::linearization::Options;
use crate::analyses::measures::Measure;
use crate::analyses::record::{parts, Record, StartState};
use crate::analyses::second_order;
use crate::analyses::signals::Seen;
use crate::analyses::sweep::Wanted;
use crate::analyses::AnyAnalysis;
use crate::elements::Group;
use crate::equations::sensitivity::{Sensitivity, Slope, ABREAST};
use crate::equations::Workspace;
use crate::expression::Tape;
use crate::math::{Complex, Field, Listed, Real, ShortArray};
use crate::model::{Dependence, Model};
use crate::solve::null_space;
use std::f64::consts::TAU;
use std::sync::Arc;

/// Relative distance of eigenvalues that count as equal.
const EQUAL: f64 = 1e-7;
/// Relative difference of magnitudes below which modes may change places.
const TIED: f64 = 1e-9;
/// Relative difference of derivatives that agree.
const AGREES: f64 = 1e-7;
/// The part of its terms below which ∂G/∂s is zero: eigenvalues meet at a root, as in critical damping.
const ROOT: f64 = 1e-7;
/// Largest remainder of the equations of a mode, relative to s².
const SOLVED: f64 = 1e-5;

/// Why eigenvalues that meet at a root have no derivatives.
const MEET: &str = "it has no bound: eigenvalues meet there, as in critical damping";

/// The numbers that count, or that say yes or no.
const FLAGS: [&str; 2] = ["stable", "is_equilibrium"];

/// The derivatives of the eigenvalue of a mode by each variable, or the reasons for which there are none.
type Eigenvalue = Result<Vec<Result<Complex, String>>, String>;

/// The modes at a state, and its changes with the variables, in blocks.
struct ModeSlopes<'a> {
    record: &'a Record,
    equations: ModeEquations<'a>,
    moved: Vec<Moved>,
}

impl ReadyVariant<'_> {
    /// The derivatives of the numbers of modes.
    pub fn of_modes(&self, options: &Options) -> NumberSlopes {
        let (count, wanted) = (self.count(), &self.sweep.wanted);
        let none = |reason: String| vec![Err(reason); count];
        let all = |reason: String| vec![none(reason); wanted.len()];
        let model = match options.model(&self.sweep.subject(self.ready), &self.ready.start) {
            Ok((model, _)) => model,
            Err(failure) => return all(failure.to_string()),
        };
        // a mode that is left out may have the same eigenvalue
        let whole = AnyAnalysis::Modes(Options { n: None, ..options.clone() });
        let record = match self.run(&whole) {
            Ok(record) => record,
            Err(failure) => return all(failure.message),
        };
        let found = self.mode_slopes(&model, &record);
        let each = wanted.iter().map(|one| match (one, &found) {
            (Wanted::Number(text), Ok(found)) => found.number(options, text, count),
            (Wanted::Statistic(..), _) => none("modes have no statistics".to_string()),
            (_, Err(reason)) => none(reason.clone()),
        });
        each.list()
    }

    fn mode_slopes<'m>(
        &self,
        model: &'m Arc<Model>,
        record: &'m Record,
    ) -> Result<ModeSlopes<'m>, String> {
        let StartState { state, .. } = &record.end;
        if let Some(reason) = refusal(model, &state.v) {
            return Err(reason.to_string());
        }
        if second_order::acting(model, state.t, &state.q).is_some() {
            return Err("an equation holds to second order only".to_string());
        }
        let lost = || "the equations of motion have no unique solution there".to_string();
        let mut workspace = Workspace::new(model);
        workspace.react(model, state.t, [&state.q, &state.v, &[]]).map_err(|_| lost())?;
        let blocks = self.blocks(model)?.into_iter().zip(self.starts()?.in_time(self.count())?);
        let sizes = self.sizes();
        let moved = blocks.zip(sizes.chunks(ABREAST)).map(|((mut over, [q, v, _]), sizes)| {
            let t = Slope::constant(state.t);
            over.respond((model, &mut workspace), t, [&q, &v, &[]]).map_err(|_| lost())?;
            Ok(Moved::new(over, [q, v], sizes))
        });
        let moved = moved.collect::<Result<Vec<_>, String>>()?;
        let at = [state.q.clone(), state.v.clone(), workspace.a().to_vec()];
        let basis = record.table("basis").chunks(state.q.len().max(1)).map(<[f64]>::to_vec);
        let columns = record.findings["columns"].as_array().into_iter().flatten();
        let columns = columns.filter_map(serde_json::Value::as_u64).map(|k| k as usize).list();
        let lam = workspace.lam().to_vec();
        let equations = ModeEquations::new(model, state.t, (at, &lam), (basis.list(), columns));
        Ok(ModeSlopes { record, equations: equations.ok_or_else(lost)?, moved })
    }
}

/// Why the modes of a model have no derivatives; None if they have.
fn refusal(model: &Model, v: &[f64]) -> Option<&'static str> {
    let changes = |item: &crate::model::ConstraintItem| {
        let mut depends = Dependence::default();
        if let Some(law) = &item.law {
            law.visit(&mut |tape: &Tape| depends.add(tape));
        }
        depends.time && (item.group != Group::Drivers || !depends.bodies.is_empty())
    };
    if v.iter().any(|v| *v != 0.0) {
        return Some("the state moves; modes at rest have derivatives");
    }
    if model.blueprint.functions.is_some() {
        return Some("the second derivatives of Python functions are not known; write formulas");
    }
    if model.layout.n_z > 0 {
        return Some("elements have first-order states");
    }
    if crate::equations::reactive::depends(model) || !model.switches.is_empty() {
        return Some("forces switch or depend on reactions");
    }
    model.constraints.iter().any(changes).then_some("a joint changes with the time")
}

impl ModeSlopes<'_> {
    /// The derivatives of a number by each variable.
    fn number(&self, options: &Options, text: &str, count: usize) -> Vec<Result<f64, String>> {
        let none = |reason: &str| vec![Err(reason.to_string()); count];
        let (name, place) = parts(text);
        if FLAGS.contains(&name) {
            return none("it says yes or no, and does not change gradually");
        }
        let row = |count: usize| {
            let from_end = if place.unwrap_or(0) < 0 { count as i64 } else { 0 };
            usize::try_from(place.unwrap_or(0) + from_end).unwrap_or(0)
        };
        let ModeEquations { model, t, .. } = &self.equations;
        let columns = self.record.findings["columns"].as_array().map_or(0, Vec::len);
        let of_state = |read: &dyn Fn(&Moved) -> Slope| {
            let each = self.moved.iter().flat_map(|block| read(block).slope);
            each.map(Ok).take(count).list()
        };
        let own = |of: &[Slope]| {
            let column = &self.record.findings["columns"][row(columns)];
            of[column.as_u64().unwrap_or(0) as usize]
        };
        match name {
            "values" => match Measure::read(model, &options.outputs[row(options.outputs.len())]) {
                Ok(measure) => of_state(&|block| value(block, *t, &measure)),
                Err(_) => none("kempe has no derivatives of this output"),
            },
            "rates" => of_state(&|block| own(&block.state[1])),
            "acceleration" => of_state(&|block| own(&block.over.a)),
            _ => {
                let modes = self.record.table("omega").len();
                self.of_mode(name, row(options.n.unwrap_or(modes).min(modes)))
            }
        }
    }

    /// The derivatives of a number of a mode.
    fn of_mode(&self, name: &str, mode: usize) -> Vec<Result<f64, String>> {
        let s = self.eigenvalues()[mode];
        let size = s.re.hypot(s.im);
        let of = |ds: Complex| {
            if s.im == 0.0 && ["frequency", "damping"].contains(&name) {
                return 0.0; // it neither oscillates nor begins to
            }
            let of_size = (s.re * ds.re + s.im * ds.im) / size;
            match name {
                "frequency" => ds.im / TAU,
                "omega" => of_size,
                "damping" => s.re / (size * size) * of_size - ds.re / size,
                _ => ds.re,
            }
        };
        match self.eigenvalue(mode) {
            Ok(all) => all.into_iter().map(|ds| ds.map(of)).list(),
            Err(reason) => {
                let count = self.moved.iter().map(Moved::count).sum();
                vec![Err(reason); count]
            }
        }
    }

    fn eigenvalues(&self) -> Vector {
        self.record.table("eigenvalues").chunks(2).map(|s| Complex::new(s[0], s[1])).list()
    }

    /// The derivatives of the eigenvalue of a mode.
    fn eigenvalue(&self, mode: usize) -> Eigenvalue {
        let all = self.eigenvalues();
        let (s, size) = (all[mode], |s: Complex| s.re.hypot(s.im));
        if size(s) == 0.0 {
            return Err("the eigenvalue is zero: the mode moves freely".to_string());
        }
        let near = |other: &Complex| size(*other - s) <= EQUAL * size(s);
        let mut equal = all.iter().filter(|other| near(other)).count();
        if s.im > 0.0 && 2.0 * s.im <= EQUAL * size(s) {
            equal += 1; // its conjugate
        }
        let tied =
            |other: &&Complex| !near(other) && (size(**other) - size(s)).abs() <= TIED * size(s);
        if let Some(other) = all.iter().position(|other| tied(&other)) {
            let [a, b] = [mode.min(other), mode.max(other)];
            return Err(format!(
                "modes {a} and {b} have eigenvalues of equal magnitude and change places"
            ));
        }
        let (xi, zeta) = self.vectors(s, equal)?;
        let rights = xi.iter().map(|xi| self.equations.right(s, xi)).list();
        let lefts = zeta.iter().map(|zeta| self.equations.left(s, zeta)).list();
        let pairs: Vec<(usize, usize)> =
            (0..equal).flat_map(|i| (0..equal).map(move |j| (i, j))).list();
        let by_s = pairs.iter().map(|(i, j)| self.equations.by_s(s, &lefts[*i], &xi[*j])).list();
        let terms = by_s.iter().fold(0.0, |most: f64, (_, terms)| most.max(*terms));
        let largest = |of: &mut dyn Iterator<Item = Complex>| {
            let larger = |a: (usize, f64), (k, x): (usize, Complex)| {
                if x.magnitude() > a.1 {
                    (k, x.magnitude())
                } else {
                    a
                }
            };
            of.enumerate().fold((0, 0.0), larger)
        };
        let (best, most) = largest(&mut by_s.iter().map(|(x, _)| *x));
        if most <= ROOT * terms {
            return Err(MEET.to_string());
        }
        let mut found = Vec::new();
        for block in &self.moved {
            let by_p =
                pairs.iter().map(|(i, j)| block.change(&self.equations, &rights[*j], &lefts[*i]));
            let by_p = by_p.list();
            for k in 0..block.count() {
                let ds = -(by_p[best][k] * by_s[best].0.reciprocal());
                let (_, scale) = largest(&mut by_p.iter().map(|by_p| by_p[k]));
                let off = by_p.iter().zip(&by_s).map(|(by_p, (by_s, _))| by_p[k] + ds * *by_s);
                let (_, off) = largest(&mut off.into_iter());
                found.push(match equal == 1 || off <= AGREES * scale {
                    true => Ok(ds),
                    false => Err("equal eigenvalues part with this variable".to_string()),
                });
            }
        }
        Ok(found)
    }

    /// The independent components of the motions and of the left vectors of `equal` eigenvalues s.
    fn vectors(&self, s: Complex, equal: usize) -> Result<(Vec<Vector>, Vec<Vector>), String> {
        let f = self.record.findings["columns"].as_array().map_or(0, Vec::len);
        if equal > f {
            return Err(MEET.to_string());
        }
        let [mass, damping, stiffness] =
            ["mass", "damping", "stiffness"].each(|name| self.record.table(name));
        let unit = |k: usize| mass[k * f + k].sqrt();
        let entry = |i: usize, j: usize| {
            let [m, c, k] = [mass, damping, stiffness]
                .each(|of| Complex::from_real(of[i * f + j] / (unit(i) * unit(j))));
            (s * m + c) * s + k
        };
        let places = || (0..f * f).map(|k| (k / f, k % f));
        let right = null_space(&places().map(|(i, j)| entry(i, j)).list(), f, equal);
        let left = null_space(&places().map(|(i, j)| entry(j, i)).list(), f, equal);
        if right.pivots[1] > SOLVED * (s * s).magnitude() {
            return Err(MEET.to_string());
        }
        let scaled = |vectors: Vec<Vector>| {
            let one = |x: &Vector| {
                let each = x.iter().enumerate();
                each.map(|(k, x)| Complex::from_real(1.0 / unit(k)) * *x).list()
            };
            vectors.iter().map(one).list()
        };
        Ok((scaled(right.vectors), scaled(left.vectors)))
    }
}

/// A measure at the state of a block.
fn value(block: &Moved, t: f64, measure: &Measure) -> Slope {
    let Moved { over, state: [q, v], .. } = block;
    let Sensitivity { model, motions, a, lam, .. } = over;
    let seen = Seen {
        t: Slope::constant(t),
        state: [q, v, &[]],
        works: &[],
        motions,
        solved: [a, lam],
        so_far: None,
    };
    measure.value_at(model, &seen)
}
