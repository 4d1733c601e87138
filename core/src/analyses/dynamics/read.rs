//! Options of forward dynamics from a file or from Python. The structure has been checked before by
//! the tables of options; here values are put in.

use super::options::{Auto, Options, Output, Scheme, Stabilization};
use super::singularity_passage::Singularity;
use crate::equations::{at, Gains};
use crate::integrate::{AlphaParameters, Dop853, GeneralizedAlpha, Radau, Rk4, Rk45, StepControl};
use crate::model::{Model, Problem, Reach, Scope, Value};
use crate::stabilize::Projection;

/// Reads the fields of an analysis of type `dynamics`; `path` is where it stands in the file.
///
/// # Errors
/// Every value that cannot be right, with its path.
pub fn read(
    model: &Model,
    fields: &[(String, Value)],
    path: &[String],
) -> Result<Options, Vec<Problem>> {
    let bodies = vec!["ground".to_string()];
    let scope = Scope { parameters: model.blueprint.parameters.clone(), bodies };
    let mut problems = Vec::new();
    let mut reader = Reader { model, scope, fields, path: path.to_vec(), problems: &mut problems };
    let options = reader.options();
    if problems.is_empty() {
        Ok(options)
    } else {
        Err(problems)
    }
}

struct Reader<'a> {
    model: &'a Model,
    scope: Scope,
    fields: &'a [(String, Value)],
    path: Vec<String>,
    problems: &'a mut Vec<Problem>,
}

impl<'a> Reader<'a> {
    fn options(&mut self) -> Options {
        let mut options = Options::new(self.number("t_end", "s").unwrap_or(f64::NAN));
        options.t_start = self.number("t_start", "s");
        if let Some(h) = self.positive("output_step", "s") {
            options.output = Output::Every(h);
        }
        if let Some(Value::Flag(keep)) = self.get("dense_output") {
            options.dense_output = *keep;
        }
        if matches!(self.get("singularity"), Some(Value::Text(word)) if word == "pass") {
            options.singularity = Singularity::Pass;
        }
        let max_steps = self.positive("max_steps", "").map(|n| n as usize);
        options.scheme = self.inside("method", |reader, kind| reader.scheme(kind, max_steps));
        options.stabilization =
            self.inside("stabilization", |reader, kind| reader.stabilization(kind));
        options
    }

    fn scheme(&mut self, kind: &str, max_steps: Option<usize>) -> Scheme {
        if kind == "rk4" {
            let step = self.positive("step", "s").unwrap_or(f64::NAN);
            let control = StepControl { max_steps, ..StepControl::constant(step) };
            return Scheme::Rk4(Rk4 { control });
        }
        if kind == "radau" {
            let control = self.implicit_control(StepControl::USUAL, max_steps);
            return Scheme::Radau(Radau { control });
        }
        if matches!(kind, "generalized_alpha" | "hht") {
            return Scheme::GeneralizedAlpha(self.alpha_method(kind, max_steps));
        }
        let automatic = matches!(kind, "auto" | "");
        let usual = if automatic { StepControl::AUTO } else { StepControl::USUAL };
        let step = self.positive("step", "s");
        let control = StepControl { max_steps, step, ..self.tolerances(usual) };
        match kind {
            _ if automatic => Scheme::Auto(Auto { control }),
            "dop853" => Scheme::Dop853(Dop853 { control }),
            _ => Scheme::Rk45(Rk45 { control }),
        }
    }

    /// Generalized-α and HHT, which differ in what selects the member of the family.
    fn alpha_method(&mut self, kind: &str, max_steps: Option<usize>) -> GeneralizedAlpha {
        let parameters = if kind == "hht" {
            let good = |alpha| (-1.0 / 3.0..0.0).contains(&alpha);
            AlphaParameters::hht(self.checked("alpha", "", good, "in [-1/3, 0)").unwrap_or(-0.1))
        } else {
            let good = |rho| (0.0..1.0).contains(&rho);
            AlphaParameters::chung_hulbert(
                self.checked("rho", "", good, "in [0, 1)").unwrap_or(0.8),
            )
        };
        let control = self.implicit_control(StepControl::LOW_ORDER, max_steps);
        GeneralizedAlpha { parameters, control }
    }

    /// Tolerances and steps of an implicit method, with default tolerances.
    fn implicit_control(&mut self, usual: (f64, f64), max_steps: Option<usize>) -> StepControl {
        let step = self.positive("step", "s");
        if step.is_some() {
            self.not_together(
                &["first_step", "max_step"],
                "not together with step, which is constant",
            );
        }
        let usual = if step.is_some() { StepControl::NEWTON } else { usual };
        StepControl { max_steps, step, ..self.tolerances(usual) }
    }

    /// Tolerances, and bounds of controlled steps.
    fn tolerances(&mut self, (rtol, atol): (f64, f64)) -> StepControl {
        let mut control = StepControl::new(
            self.not_negative("rtol", "").unwrap_or(rtol),
            self.not_negative("atol", "").unwrap_or(atol),
        );
        control.first_step = self.positive("first_step", "s");
        control.max_step = self.positive("max_step", "s").unwrap_or(f64::INFINITY);
        control
    }

    fn stabilization(&mut self, kind: &str) -> Stabilization {
        match kind {
            "none" => Stabilization::None,
            "projection" | "" => {
                let default = Projection::default().tolerance;
                let tolerance = self.positive("tolerance", "").unwrap_or(default);
                Stabilization::Projection(Projection { tolerance })
            }
            _ if self.get("gains").is_some() => {
                self.not_together(
                    &["alpha", "beta"],
                    "not together with gains, which come from the step",
                );
                Stabilization::BaumgarteFromStep
            }
            _ => Stabilization::Baumgarte(Gains {
                alpha: self.not_negative("alpha", "1/s").unwrap_or(10.0),
                beta: self.not_negative("beta", "1/s").unwrap_or(200.0),
            }),
        }
    }

    /// Refuses each of `keys` that is given.
    fn not_together(&mut self, keys: &[&str], told: &str) {
        for key in keys {
            if self.get(key).is_none() {
                continue;
            }
            let path: Vec<String> = self.path.iter().cloned().chain([key.to_string()]).collect();
            self.problems.push(Problem::at(&path, format!("{told}; remove one of them")));
        }
    }

    /// Reads the table of options under `key`, whose `type` is given to `read`.
    fn inside<T>(&mut self, key: &str, read: impl FnOnce(&mut Reader<'_>, &str) -> T) -> T {
        let (kind, fields) = match self.get(key) {
            Some(Value::Table(fields)) => (field(fields, "type"), fields.as_slice()),
            Some(text @ Value::Text(_)) => (Some(text), &[][..]),
            _ => (None, &[][..]),
        };
        let kind = match kind {
            Some(Value::Text(kind)) => kind.as_str(),
            _ => "",
        };
        let mut path = self.path.clone();
        path.push(key.to_string());
        let scope = self.scope.clone();
        read(&mut Reader { fields, path, scope, model: self.model, problems: self.problems }, kind)
    }

    fn get(&self, key: &str) -> Option<&'a Value> {
        field(self.fields, key)
    }

    fn number(&mut self, key: &str, unit: &str) -> Option<f64> {
        let value = field(self.fields, key)?;
        let mut path = self.path.clone();
        path.push(key.to_string());
        let reach = Reach::Parameters;
        let tape = self.scope.formula(value, &path, unit, reach, self.problems)?;
        let x = tape.evaluate(&at(&self.model.parameters, &[], 0.0));
        if !x.is_finite() {
            self.problems.push(Problem::at(&path, format!("becomes {x}; must be finite")));
            return None;
        }
        Some(x)
    }

    fn checked(&mut self, key: &str, unit: &str, good: fn(f64) -> bool, must: &str) -> Option<f64> {
        let x = self.number(key, unit)?;
        if good(x) {
            return Some(x);
        }
        let path: Vec<String> = self.path.iter().cloned().chain([key.to_string()]).collect();
        let unit = if unit.is_empty() { String::new() } else { format!(" {unit}") };
        self.problems.push(Problem::at(&path, format!("{x}{unit}; must be {must}")));
        None
    }

    fn positive(&mut self, key: &str, unit: &str) -> Option<f64> {
        self.checked(key, unit, |x| x > 0.0, "> 0")
    }

    fn not_negative(&mut self, key: &str, unit: &str) -> Option<f64> {
        self.checked(key, unit, |x| x >= 0.0, ">= 0")
    }
}

fn field<'a>(fields: &'a [(String, Value)], key: &str) -> Option<&'a Value> {
    fields.iter().find(|(k, _)| k == key).map(|(_, v)| v)
}
