//! The objective, the limits and the columns of a search.

use super::bound::{bounds, Bound};
use super::text::{compared, Columns};
use super::{entry, number, refused, text_of};
use crate::columns::{sweep, unit, with_slopes};
use crate::fault::Fault;
use crate::loaded::Loaded;
use kempe::analyses::sweep::Sweep;
use kempe::expression::parameters::Parameters;
use kempe::expression::unit::Unit;
use kempe::expression::Expression;
use kempe::math::Dual;
use kempe::model::Value as Written;
use kempe_synthesis::Known;

/// Values with the derivatives by three variables.
type Slope = Dual<3>;

/// The aim of a search.
pub enum Aim {
    /// A formula times this sign is made small; its square if it is a root of squares.
    Formula { sign: f64, square: bool },
    /// Formulas have these values; deviations are parts of these sizes.
    Target(Vec<(f64, f64)>),
}

/// A problem: variables, the sweep of its columns, and formulas of these and of parameters.
pub struct Task {
    /// The variables.
    pub bounds: Vec<Bound>,
    sweep: Sweep,
    columns: usize,
    formulas: Parameters,
    aim: Aim,
    /// The objective in words.
    pub label: String,
    /// Its SI unit.
    pub unit: String,
    /// The number of limits.
    limits: usize,
}

/// A value and its derivatives by the variables, later by their shares.
type Sloped = (f64, Vec<f64>);

/// The numbers of a run.
#[derive(Clone)]
pub struct Seen {
    /// The objective itself.
    pub objective: f64,
    /// The room of each limit, as a part of the size of what it compares.
    pub room: Vec<f64>,
}

/// The aim, its label, and its formulas.
fn aim(section: &[(String, Written)]) -> Result<(Aim, String, Vec<&str>), Fault> {
    for (key, sign) in [("minimize", 1.0), ("maximize", -1.0)] {
        match entry(section, key) {
            Some(Written::Text(text)) => {
                let square = text.ends_with(".rms") && !text.contains(['+', '-', '*', '/', '(']);
                return Ok((Aim::Formula { sign, square }, text.clone(), vec![text]));
            }
            Some(_) => return Err(refused("several objectives, or a path")),
            None => {}
        }
    }
    let Some(Written::Table(given)) = entry(section, "target") else {
        return Err(Fault::new("there is no objective").hint("choose a number"));
    };
    let of = |(_, x): &(String, Written)| {
        let x = number(Some(x));
        (x, if x == 0.0 { 1.0 } else { x.abs() })
    };
    let label = "deviation from the target".to_string();
    let texts = given.iter().map(|(name, _)| &name[..]).collect();
    Ok((Aim::Target(given.iter().map(of).collect()), label, texts))
}

/// The limits of the section, and the formulas of their sides: the smaller ones, the larger ones, and the rooms.
fn limits(section: &[(String, Written)]) -> Vec<&str> {
    match entry(section, "subject_to") {
        Some(Written::Text(text)) => vec![text],
        Some(Written::List(texts)) => texts.iter().filter_map(text_of).collect(),
        _ => Vec::new(),
    }
}

fn parsed(text: &str) -> Result<Expression, Fault> {
    Expression::parse(text).map_err(|error| Fault::new(format!("'{text}': {error}")))
}

/// A number with the SI unit of a column, in place of which its values come.
fn placeholder(known: &str) -> Result<Expression, Fault> {
    match Unit::parse(known) {
        Ok(_) if known != "1" => parsed(&format!("1 {known}")),
        _ => parsed("1"),
    }
}

impl Task {
    /// The problem of the section of a case.
    pub fn read(loaded: &Loaded) -> Result<Self, Fault> {
        let section = &loaded.case.optimize;
        if entry(section, "loads").is_some() {
            return Err(refused("load cases"));
        }
        let bounds = bounds(loaded, section)?;
        let (aim, label, objectives) = aim(section)?;
        let limits = limits(section);
        let mut columns = Columns::new(&loaded.model.blueprint.parameters);
        let mut written: Vec<(String, String)> = Vec::new();
        for (k, text) in objectives.iter().enumerate() {
            written.push((format!("__f{k}"), columns.named(text)?));
        }
        for (k, text) in limits.iter().enumerate() {
            let [small, large] = compared(text)?;
            written.push((format!("__s{k}"), columns.named(small)?));
            written.push((format!("__l{k}"), columns.named(large)?));
            written.push((format!("__r{k}"), format!("__l{k} - __s{k}")));
        }
        let names: Vec<&str> = columns.found.iter().map(|name| &name[..]).collect();
        let analysis = entry(section, "analysis").and_then(text_of);
        let (sweep, model) = sweep(loaded, &names, analysis, None)?;
        let mut all = sweep.model.blueprint.formulas.clone();
        for (k, name) in names.iter().enumerate() {
            all.push((format!("__c{k}"), placeholder(&unit(&loaded.case, &model, name))?));
        }
        let first = all.len();
        for (name, text) in written {
            all.push((name, parsed(&text)?));
        }
        let formulas = Parameters::compile(&all, &sweep.model.blueprint.tables);
        let formulas = formulas.map_err(|of| {
            let place = of.name.trim_start_matches("__r").parse::<usize>().ok();
            let text = place.and_then(|k| limits.get(k).copied()).unwrap_or(&label);
            Fault::new(format!("'{text}': {}", of.error))
        })?;
        let unit = match (&aim, &names[..]) {
            (Aim::Target(_), _) => String::new(),
            (_, [name, ..]) if **name == *label => unit(&loaded.case, &model, name),
            _ => formulas.inferred()[first].unit().unwrap_or_default(),
        };
        let (columns, limits) = (names.len(), limits.len());
        Ok(Self { bounds, columns, sweep, formulas, aim, label, unit, limits })
    }

    /// The values of all formulas at a point of the unit cube, with their derivatives by its coordinates.
    fn values(&self, shares: &[f64]) -> Result<Vec<Sloped>, Fault> {
        let (mut row, mut ends) = (Vec::new(), Vec::new());
        for (bound, share) in self.bounds.iter().zip(shares) {
            row.push((bound.name.clone(), bound.at(*share)));
            ends.push(bound.ends);
        }
        let (values, slopes) = with_slopes(&self.sweep, &row, &ends)?;
        let (n, names) = (row.len(), &self.sweep.model.blueprint.formulas);
        let first = names.len() + self.columns;
        let mut found: Vec<Sloped> = Vec::new();
        for chunk in (0..n).step_by(3) {
            let given = |k: usize| -> Option<Slope> {
                if let Some((name, _)) = names.get(k) {
                    let j = row.iter().position(|(other, _)| other == name)?;
                    let mut of = Slope { value: row[j].1, slope: [0.0; 3] };
                    if let Some(seed) = j.checked_sub(chunk).filter(|seed| *seed < 3) {
                        of.slope[seed] = 1.0;
                    }
                    return Some(of);
                }
                let column = Some(k - names.len()).filter(|k| *k < self.columns)?;
                let mut of = Slope { value: values[column], slope: [0.0; 3] };
                for j in chunk..n.min(chunk + 3) {
                    let slope = slopes[column * n + j];
                    of.slope[j - chunk] = if slope.is_finite() { slope } else { 0.0 };
                }
                Some(of)
            };
            let all = self.formulas.evaluate(given);
            found.resize(all.len() - first, (0.0, Vec::new()));
            for (one, of) in found.iter_mut().zip(&all[first..]) {
                one.0 = of.value;
                for (slope, j) in of.slope.iter().zip(chunk..n) {
                    one.1.push(slope * self.bounds[j].rate(row[j].1));
                }
            }
        }
        Ok(found)
    }

    /// The objective itself, and what is made small.
    fn objective(&self, all: &[Sloped]) -> (f64, Sloped) {
        let (mut sum, mut slope) = (0.0, vec![0.0; self.bounds.len()]);
        let mut add = |factor: f64, by: &[f64]| {
            slope.iter_mut().zip(by).for_each(|(of, by)| *of += factor * by);
        };
        match &self.aim {
            Aim::Formula { sign, square } => {
                let (x, by) = &all[0];
                let (value, rate) = if *square { (x * x, 2.0 * x) } else { (*x, 1.0) };
                add(sign * rate, by);
                (*x, (sign * value, slope))
            }
            Aim::Target(targets) => {
                for ((x, by), (wanted, size)) in all.iter().zip(targets) {
                    let (apart, share) = ((x - wanted) / size, 1.0 / targets.len() as f64);
                    sum += share * apart * apart;
                    add(2.0 * share * apart / size, by);
                }
                (sum.sqrt(), (sum, slope))
            }
        }
    }

    /// A run: what the search needs, and what is shown. The first run sets the sizes of the limits.
    pub fn run(&self, shares: &[f64], sizes: &mut Vec<f64>) -> Result<(Known, Seen), Fault> {
        let all = self.values(shares)?;
        let (own, sides) = all.split_at(all.len() - 3 * self.limits);
        let (objective, (value, slope)) = self.objective(own);
        let mut known = Known { value, slope, room: Vec::new(), room_slopes: Vec::new() };
        let (first, mut parts) = (sizes.is_empty(), Vec::new());
        for (k, of) in sides.chunks(3).enumerate() {
            let (room, by) = &of[2];
            let steepest = by.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
            let mut size = of[0].0.abs().max(of[1].0.abs());
            for other in [steepest, 1.0] {
                size = if size > 0.0 { size } else { other };
            }
            if first {
                sizes.push(size);
            }
            let mut by = by.clone();
            by.iter_mut().for_each(|x| *x /= sizes[k]);
            known.room.push(room / sizes[k]);
            known.room_slopes.push(by);
            parts.push(room / size);
        }
        if !known.is_finite() {
            return Err(Fault::new(format!("{} or a limit has no value here", self.label)));
        }
        Ok((known, Seen { objective, room: parts }))
    }
}
