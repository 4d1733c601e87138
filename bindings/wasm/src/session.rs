//! What a page holds: a text, a run, and the coordinate that was selected last.

use kempe::case::{self, Format};
use kempe::{assemble, build, dynamics, read_options, Flow, Model, Run};
use std::fmt::Display;

/// The state of the module between two calls.
#[derive(Default)]
pub struct Session {
    text: Vec<u8>,
    result: Option<(Model, Run)>,
    selected: Vec<f64>,
    message: String,
}

impl Session {
    /// Room for a text.
    pub fn room(&mut self, length: usize) -> *mut u8 {
        self.text = vec![0; length];
        self.text.as_mut_ptr()
    }

    /// Calls a function and keeps its error as the message; 0 if there is none.
    pub fn report(&mut self, call: fn(&mut Self) -> Result<(), String>) -> i32 {
        self.message = call(self).err().unwrap_or_default();
        i32::from(!self.message.is_empty())
    }

    /// Assembles the case of the text and runs its first analysis.
    pub fn run(&mut self) -> Result<(), String> {
        self.result = None;
        let (case, _) = case::read(self.given()?, Format::Toml).map_err(|found| lines(&found))?;
        let model = build(&case.definition, &[]).map_err(|found| lines(&found))?;
        let request = case.start.request(&model).map_err(|found| found.to_string())?;
        let (start, _) = assemble(&model, &request).map_err(|failure| failure.to_string())?;
        let analysis = case.analyses.first().ok_or("the case has no analysis")?;
        let path = ["analyses".to_string(), analysis.name.clone()];
        let options =
            read_options(&model, &analysis.fields, &path).map_err(|found| lines(&found))?;
        let run = dynamics(&model, &start, &options, |_| Flow::Continue)
            .map_err(|failure| failure.to_string())?;
        self.result = Some((model, run));
        Ok(())
    }

    /// Selects the coordinate that the text names.
    pub fn select(&mut self) -> Result<(), String> {
        self.selected.clear();
        let (model, run) = self.result.as_ref().ok_or("there is no run")?;
        let values = run.coordinate(model, self.given()?).map_err(|none| none.to_string())?;
        self.selected = values;
        Ok(())
    }

    /// The reported times, s.
    pub fn times(&self) -> &[f64] {
        self.result.as_ref().map_or(&[], |(_, run)| &run.trajectory.t)
    }

    /// The selected coordinate at the reported times.
    pub fn selected(&self) -> &[f64] {
        &self.selected
    }

    /// Why the last call failed.
    pub fn message(&self) -> &str {
        &self.message
    }

    fn given(&self) -> Result<&str, String> {
        std::str::from_utf8(&self.text).map_err(|fault| fault.to_string())
    }
}

fn lines(found: &[impl Display]) -> String {
    found.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n")
}
