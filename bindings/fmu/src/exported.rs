//! What an FMU contains: its case, and the variables that the host sees.

use kempe::case::{read, Case, Format};
use kempe::model::{build, Problems, Value};
use serde::Deserialize;
use std::fs;
use std::path::Path;

/// An output: its name, and the expression of quantities that gives its value.
#[derive(Debug, Deserialize)]
pub struct Output {
    pub name: String,
    pub formula: String,
}

/// A parameter of the case.
#[derive(Debug, Deserialize)]
pub struct Parameter {
    pub name: String,
    /// Whether it is an input, which may change between steps. Others may change before the start only.
    pub input: bool,
}

/// The file `interface.json`. Value references are 0 for the time, then those of the outputs, then of the parameters.
#[derive(Debug, Deserialize)]
pub struct Interface {
    /// The token of `modelDescription.xml`.
    pub token: String,
    /// The analysis with the options of the run.
    pub analysis: String,
    pub outputs: Vec<Output>,
    pub parameters: Vec<Parameter>,
}

/// The content of an FMU.
#[derive(Debug)]
pub struct Exported {
    pub interface: Interface,
    pub case: Case,
    /// The place of the analysis in the case.
    pub analysis: usize,
    /// The values of the parameters in the case.
    pub defaults: Vec<f64>,
}

impl Exported {
    /// Reads the folder of the resources.
    pub fn read(folder: &Path) -> Result<Self, String> {
        let text = |name: &str| {
            let path = folder.join(name);
            fs::read_to_string(&path).map_err(|error| format!("{}: {error}", path.display()))
        };
        let interface: Interface = serde_json::from_str(&text("interface.json")?)
            .map_err(|error| format!("interface.json: {error}"))?;
        let (case, _) = read(&text("case.toml")?, Format::Toml).map_err(|found| {
            let texts: Vec<String> = found.iter().map(ToString::to_string).collect();
            texts.join("; ")
        })?;
        Self::new(interface, case)
    }

    /// Joins the two files.
    pub fn new(interface: Interface, case: Case) -> Result<Self, String> {
        let analysis = case.analyses.iter().position(|entry| entry.name == interface.analysis);
        let analysis = analysis.ok_or_else(|| format!("no analysis {}", interface.analysis))?;
        let model = build(&case.definition, &[]).map_err(|found| Problems(found).to_string())?;
        let value = |of: &Parameter| {
            let place = model.blueprint.parameters.iter().position(|known| *known == of.name);
            place.map(|k| model.parameters[k]).ok_or_else(|| format!("no parameter {}", of.name))
        };
        let defaults = interface.parameters.iter().map(value).collect::<Result<_, _>>()?;
        Ok(Self { interface, case, analysis, defaults })
    }

    /// The case with other values of parameters, by their places in the interface.
    pub fn with(&self, chosen: &[(usize, f64)]) -> Case {
        let mut case = self.case.clone();
        for (place, value) in chosen {
            let name = &self.interface.parameters[*place].name;
            for (known, written) in &mut case.definition.parameters {
                if known == name {
                    *written = Value::Number(*value);
                }
            }
        }
        case
    }
}
