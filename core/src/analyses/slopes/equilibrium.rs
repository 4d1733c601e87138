//! The numbers of an equilibrium with their derivatives.

use super::at_rest::{AtRest, RestPoint};
use super::statistics::Found;
use super::variables::parameters;
use super::variant::ReadyVariant;
use crate::analyses::assemble::{rate_slopes, state_until, Request, StartSlopes};
use crate::analyses::equilibrium::Options;
use crate::analyses::measures::Measure;
use crate::analyses::record::{parts, Record};
use crate::analyses::sweep::Wanted;
use crate::analyses::State;
use crate::equations::sensitivity::constants;
use crate::math::{Listed, ShortArray};
use crate::model::{Model, Value};
use std::sync::Arc;

/// The numbers that count, say yes or no, or belong to the search.
const FLAGS: [&str; 5] = ["stable", "steps", "relaxed", "complete", "residual"];

/// What the numbers of an equilibrium, or of a path of equilibria, follow from.
struct Rests<'a> {
    variant: ReadyVariant<'a>,
    options: &'a Options,
    record: &'a Record,
    model: Arc<Model>,
    /// The variables and the derivatives of the start, in blocks.
    blocks: Vec<(Vec<String>, StartSlopes)>,
}

impl ReadyVariant<'_> {
    /// The derivatives of the numbers of an equilibrium, or of a path of equilibria.
    pub fn of_equilibrium(&self, options: &Options, record: &Record) -> Vec<Found> {
        let rests = match self.rests(options, record) {
            Ok(rests) => rests,
            Err(reason) => return vec![Err(reason); self.sweep.wanted.len()],
        };
        let mut known = Vec::new();
        let each = self.sweep.wanted.iter().map(|one| match one {
            Wanted::Number(text) => rests.number(text, &mut known),
            Wanted::Statistic(..) => Err("an equilibrium has no statistics".to_string()),
        });
        each.list()
    }

    /// The derivatives of an equilibrium at which another analysis starts, in blocks of variables. Where drivers move,
    /// the rates at the start are those nearest to rest.
    pub fn rest_starts(
        &self,
        options: &Options,
        record: &Record,
    ) -> Result<Vec<StartSlopes>, String> {
        let rests = self.rests(options, record)?;
        let model = &*rests.model;
        let found = rests.at(0)?.into_iter().map(|(rest, _)| rest.start());
        if !model.driven {
            return Ok(found.list());
        }
        let (t, state) = (record.end.state.t, Some(record.end.state.clone()));
        let request = Request { state, t, ..Request::default() };
        let moving = state_until(model, &request, self.stop).map_err(|failure| failure.message)?;
        let with_rates = |([q, _, z], (names, _)): (StartSlopes, &(Vec<String>, _))| {
            let numbers = parameters(model, names, &[]).ok_or("its parameters cannot be read")?;
            let v = rate_slopes(model, &request, &numbers, (&q, &moving.v))?;
            Ok([q, v, z])
        };
        found.zip(&rests.blocks).map(with_rates).collect()
    }

    /// The equilibria, with the derivatives of the start as far as they depend on it: by the quantities that are held.
    fn rests<'b>(&'b self, options: &'b Options, record: &'b Record) -> Result<Rests<'b>, String> {
        let (names, start) = (self.names().into_iter(), &self.ready.start);
        let State { q, v, z, .. } = &start.state;
        let fixed = || [q, v, z].each(|x| constants(x));
        let blocks = match options.hold.is_empty() && !self.ready.after {
            true => names.map(|names| (names, fixed())).list(),
            false => names.zip(self.starts()?.in_time(self.count())?).list(),
        };
        let model = self.sweep.subject(self.ready).released(start);
        Ok(Rests { variant: *self, options, record, model, blocks })
    }
}

/// The derivatives of the equilibria at some points of a path, by their indices.
type Known = Vec<(usize, Result<Vec<(AtRest, usize)>, String>)>;

impl Rests<'_> {
    /// The derivatives of a number.
    fn number(&self, text: &str, known: &mut Known) -> Found {
        let (name, place) = parts(text);
        if FLAGS.contains(&name) {
            return Err("it counts, or belongs to the search, and does not change gradually".into());
        }
        let points = self.list("points").len();
        let of_path = ["values", "folds", "branches"].contains(&name);
        let count = if of_path { self.list(name).len() } else { points };
        let place = match (&self.options.over, place) {
            (None, _) => 0,
            (Some(_), Some(place)) if place < 0 => (count as i64 + place) as usize,
            (Some(_), place) => place.unwrap_or(0) as usize,
        };
        let folds = self.list("folds");
        let fold = |k: usize| folds.get(k).and_then(serde_json::Value::as_u64).map(|k| k as usize);
        let given = place == 0 || place + 1 == points && self.ends_in_range();
        match name {
            "folds" => self.fold(fold(place).ok_or("there is no such fold")?),
            "branches" => Err("it has no bound: other paths cross there".to_string()),
            "values" if (0..folds.len()).any(|k| fold(k) == Some(place)) => self.fold(place),
            "values" if given => Ok(vec![0.0; self.variant.count()]),
            _ if !given => {
                Err("the path chooses this point; its ends have derivatives".to_string())
            }
            _ => {
                if !known.iter().any(|(k, _)| *k == place) {
                    known.push((place, self.at(place)));
                }
                let found = known.iter_mut().find(|(k, _)| *k == place);
                let (_, found) = found.ok_or("its position is not known")?;
                let text = if self.options.over.is_some() { name } else { text };
                self.read(found.as_mut().map_err(|reason| reason.clone())?, text)
            }
        }
    }

    fn read(&self, blocks: &mut [(AtRest, usize)], text: &str) -> Found {
        let mut slopes = Vec::new();
        for (block, count) in blocks {
            let holder = |name| self.options.hold.iter().position(|held| held == name);
            let found = match text.strip_prefix("effort.").map(|name| (name, holder(name))) {
                Some((_, Some(holder))) => block.effort(holder),
                Some((name, None)) => block.effort_of(name).ok_or("there is no such driver")?,
                None => {
                    let declared = &self.variant.sweep.definition.measures;
                    let declared = declared.iter().find(|(of, _)| of == text);
                    let text = match declared {
                        Some((_, Value::Text(text))) => text,
                        _ => text,
                    };
                    let measure = Measure::read(&block.base, text);
                    block.read(&measure.map_err(|_| "it has no derivatives yet")?)
                }
            };
            slopes.extend(&found.slope[..*count]);
        }
        Ok(slopes)
    }

    /// A finding that is a list.
    fn list(&self, name: &str) -> &[serde_json::Value] {
        self.record.findings[name].as_array().map_or(&[], Vec::as_slice)
    }

    /// Whether the last point of a path has the first or the last value of the range.
    fn ends_in_range(&self) -> bool {
        matches!(self.record.findings["end"].as_str(), Some("last" | "first"))
    }

    /// The derivatives of the equilibrium at a point, in blocks.
    fn at(&self, point: usize) -> Result<Vec<(AtRest, usize)>, String> {
        self.with(point, |rest| {
            let of = |(names, start): &(Vec<String>, StartSlopes)| {
                Ok((AtRest::find(rest, names, start)?, names.len()))
            };
            self.blocks.iter().map(of).collect()
        })
    }

    /// The derivatives of the value of the parameter at a fold.
    fn fold(&self, point: usize) -> Found {
        let over = self.options.over.as_ref().ok_or("the result is not a path")?;
        self.with(point, |rest| {
            let mut slopes = Vec::new();
            for (names, start) in &self.blocks {
                slopes.extend(&AtRest::fold(rest, (over, names), start)?[..names.len()]);
            }
            Ok(slopes)
        })
    }

    /// Calls `f` with the equilibrium at a point.
    fn with<R>(
        &self,
        point: usize,
        f: impl FnOnce(&RestPoint<'_>) -> Result<R, String>,
    ) -> Result<R, String> {
        let (options, before) = (self.options, &*self.model);
        let of = &self.list("points")[point];
        let numbers = |name: &str| -> Option<Vec<f64>> {
            of[name].as_array()?.iter().map(serde_json::Value::as_f64).collect()
        };
        let read = || {
            // the multipliers of the joints and drivers, then those of the holders
            let holders = numbers("holders")?.into_iter().map(|effort| -effort);
            Some((numbers("q")?, numbers("z")?, numbers("lam")?.into_iter().chain(holders).list()))
        };
        let (q, z, lam) = read().ok_or("its multipliers are not known")?;
        let (v, start) = (vec![0.0; q.len()], &self.variant.ready.start.state);
        let state = &State { t: start.t, q, v, z };
        let value = self.list("values").get(point).and_then(serde_json::Value::as_f64);
        let change = options.over.clone().zip(value);
        let own = change.map(|change| before.with_values(&[change])).transpose();
        let own = own.map_err(|_| "its parameters cannot be read")?;
        let model = own.as_ref().unwrap_or(before);
        f(&RestPoint { model, options, state, lam: &lam, before, start })
    }
}
