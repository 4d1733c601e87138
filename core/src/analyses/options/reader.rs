//! Options from a file or from Python. The tables have already checked their structure; here the values are computed.

use crate::analyses::signal_names::signal;
use crate::analyses::signal_units;
use crate::equations::at;
use crate::math::Listed;
use crate::model::{Model, Problem, Reach, Scope, Value, ANY_UNIT};

/// Reads the fields of one table of options and stores the reports of their faults.
pub struct Reader<'a> {
    model: &'a Model,
    scope: &'a Scope,
    fields: &'a [(String, Value)],
    path: Vec<String>,
    problems: &'a mut Vec<Problem>,
}

impl<'a> Reader<'a> {
    /// Reads fields by `read`; `path` is their path in the file. Numbers may be formulas of the model's parameters.
    ///
    /// # Errors
    /// Every faulty value, with its path.
    pub fn read<T>(
        model: &Model,
        fields: &[(String, Value)],
        path: &[String],
        read: impl FnOnce(&mut Reader<'_>) -> Option<T>,
    ) -> Result<T, Vec<Problem>> {
        let b = &model.blueprint;
        let scope = &Scope::of_parameters(&b.parameters, &b.inferred, &b.tables);
        let mut problems = Vec::new();
        let path = path.to_vec();
        let found = read(&mut Reader { model, scope, fields, path, problems: &mut problems });
        match found {
            Some(found) if problems.is_empty() => Ok(found),
            _ => Err(problems),
        }
    }

    /// A value as it is written.
    pub fn get(&self, key: &str) -> Option<&'a Value> {
        self.fields.iter().find(|(k, _)| k == key).map(|(_, value)| value)
    }

    /// The keys that are given.
    pub fn keys(&self) -> impl Iterator<Item = &'a str> {
        self.fields.iter().map(|(key, _)| key.as_str())
    }

    /// Reports a fault within a value.
    pub fn report<T>(&mut self, key: &str, problem: Problem) -> Option<T> {
        self.problems.push(Problem { path: self.path_of(key), ..problem });
        None
    }

    /// Reports the fault of a value.
    pub fn refuse<T>(&mut self, key: &str, message: impl Into<String>) -> Option<T> {
        self.problems.push(Problem::at(&self.path_of(key), message));
        None
    }

    /// A finite number for which `holds` is true. Otherwise reports that the number must be `must`.
    pub fn number(
        &mut self,
        key: &str,
        unit: &str,
        (holds, must): (fn(f64) -> bool, &str),
    ) -> Option<f64> {
        let (value, path) = (self.get(key)?, self.path_of(key));
        let tape = self.scope.formula(value, &path, unit, Reach::Parameters, self.problems)?;
        let x = tape.evaluate(&at(&self.model.parameters, &[], &[], 0.0));
        if !x.is_finite() {
            return self.refuse(key, format!("becomes {x}; must be finite"));
        }
        if !holds(x) {
            let unit = if unit.is_empty() { String::new() } else { format!(" {unit}") };
            return self.refuse(key, format!("{x}{unit}; must be {must}"));
        }
        Some(x)
    }

    /// A finite number of this unit within the value of `key`.
    pub fn value(&mut self, key: &str, value: &Value, unit: &str) -> Option<f64> {
        let path = self.path_of(key);
        let reach = Reach::Parameters;
        let tape = self.scope.formula(value, &path, unit, reach, self.problems)?;
        let x = tape.evaluate(&at(&self.model.parameters, &[], &[], 0.0));
        match x.is_finite() {
            true => Some(x),
            false => self.refuse(key, format!("becomes {x}; must be finite")),
        }
    }

    /// The SI unit of a name: of the quantity of a driver, of a parameter or of another quantity. Any unit if it is not
    /// known.
    pub fn unit_of(&self, name: Option<&Value>) -> String {
        let Some(Value::Text(name)) = name else { return ANY_UNIT.to_string() };
        let (model, blueprint) = (self.model, &self.model.blueprint);
        let named = model.constraints.iter().find(|item| item.name == *name);
        let driven = named.and_then(|item| item.element.drives());
        let parameter = blueprint.parameters.iter().position(|known| known == name);
        let of_parameter = || blueprint.inferred[parameter?].unit();
        let of_quantity = || Some(signal_units::unit_of(model, name, &signal(model, name)?));
        let found = driven.map(|of| of.kind().unit().to_string());
        found.or_else(of_parameter).or_else(of_quantity).unwrap_or(ANY_UNIT.to_string())
    }

    /// A list of names. `check` receives each name with the names before it.
    pub fn names(
        &mut self,
        key: &str,
        what: &str,
        check: impl Fn(&Model, &str, &[String]) -> Result<(), Problem>,
    ) -> Option<Vec<String>> {
        let Some(Value::List(items)) = self.get(key) else {
            return self.refuse(key, format!("must be a list of {what}"));
        };
        let mut names = Vec::new();
        for item in items {
            let Value::Text(name) = item else {
                return self.refuse(key, format!("must be a list of {what}"));
            };
            if let Err(problem) = check(self.model, name, &names) {
                return self.report(key, problem);
            }
            names.push(name.clone());
        }
        Some(names)
    }

    /// The model.
    pub fn model(&self) -> &'a Model {
        self.model
    }

    /// A table, whose fields `read` reads.
    pub fn table<T>(
        &mut self,
        key: &str,
        read: impl FnOnce(&mut Reader<'_>) -> Option<T>,
    ) -> Option<T> {
        let Some(Value::Table(fields)) = self.get(key) else {
            return self.refuse(key, "must be a table");
        };
        let (model, scope, path) = (self.model, self.scope, self.path_of(key));
        read(&mut Reader { model, scope, fields, path, problems: &mut *self.problems })
    }

    /// A table of options. `read` receives its `type`.
    pub fn chosen<T>(
        &mut self,
        key: &str,
        read: impl FnOnce(&mut Reader<'_>, &str) -> Option<T>,
    ) -> Option<T> {
        self.table(key, |inner| match inner.get("type") {
            Some(Value::Text(kind)) => read(inner, kind),
            _ => inner.refuse("type", "missing"),
        })
    }

    fn path_of(&self, key: &str) -> Vec<String> {
        self.path.iter().cloned().chain([key.to_string()]).list()
    }
}
