//! The numbers of an equilibrium with their derivatives.

use super::at_rest::AtRest;
use super::statistics::Found;
use crate::analyses::assemble::StartSlopes;
use crate::analyses::equilibrium::Options;
use crate::analyses::measures::Measure;
use crate::analyses::record::Record;
use crate::analyses::sweep::{Ready, Sweep, VariantRow, Wanted};
use crate::math::Listed;
use crate::model::Value;

impl Sweep {
    /// The derivatives of the numbers of an equilibrium.
    pub(super) fn of_equilibrium(
        &self,
        ready: &Ready,
        options: &Options,
        record: &Record,
        row: &VariantRow,
        stop: &(dyn Fn() -> bool + Sync),
    ) -> Vec<Found> {
        let model = self.subject(ready).released(&ready.start);
        let mut blocks = match self.rests((ready, options, record), row, stop) {
            Ok(blocks) => blocks,
            Err(reason) => return vec![Err(reason); self.wanted.len()],
        };
        let mut read = |text: &str| -> Found {
            let mut slopes = Vec::new();
            for (block, count) in &mut blocks {
                let holder = |name| options.hold.iter().position(|held| held == name);
                let found = match text.strip_prefix("effort.").map(holder) {
                    Some(Some(holder)) => block.effort(holder),
                    Some(None) => return Err("it has no derivatives yet".to_string()),
                    None => {
                        let declared = self.definition.measures.iter().find(|(of, _)| of == text);
                        let text = match declared {
                            Some((_, Value::Text(text))) => text,
                            _ => text,
                        };
                        let measure = Measure::read(&model, text);
                        block.read(&measure.map_err(|_| "it has no derivatives yet")?)
                    }
                };
                slopes.extend(&found.slope[..*count]);
            }
            Ok(slopes)
        };
        let each = self.wanted.iter().map(|one| match one {
            Wanted::Number(text) => read(text),
            Wanted::Statistic(..) => Err("an equilibrium has no statistics".to_string()),
        });
        each.list()
    }

    /// The derivatives of an equilibrium, in blocks of variables, each with the number of its variables.
    pub(super) fn rests(
        &self,
        (ready, options, record): (&Ready, &Options, &Record),
        row: &VariantRow,
        stop: &(dyn Fn() -> bool + Sync),
    ) -> Result<Vec<(AtRest, usize)>, String> {
        let starts = self.starts(ready, row, stop)?;
        let model = self.subject(ready).released(&ready.start);
        let lam = multipliers(record).ok_or("its multipliers are not known")?;
        let names = Self::names(row);
        let of = |(names, slopes): (&Vec<String>, &StartSlopes)| {
            let (start, state) = (&ready.start.state, &record.end.state);
            let found = AtRest::find((&model, options), names, (start, slopes), (state, &lam));
            Ok((found?, names.len()))
        };
        names.iter().zip(&starts.states).map(of).collect()
    }
}

/// The multipliers of an equilibrium: those of the joints and drivers, then those of the holders.
fn multipliers(record: &Record) -> Option<Vec<f64>> {
    let point = record.findings["points"].as_array()?.first()?;
    let read = |name: &str| -> Option<Vec<f64>> {
        point[name].as_array()?.iter().map(serde_json::Value::as_f64).collect()
    };
    let holders = read("holders")?;
    Some(read("lam")?.into_iter().chain(holders.iter().map(|effort| -effort)).list())
}
