//! The options that were read last for a model. Loops over starts pass the same text many times.

use kempe::analyses::dynamics::Options;
use std::sync::{Mutex, PoisonError};

/// The text and the options that were read last.
#[derive(Default)]
pub struct RecentOptions(Mutex<Option<(String, Options)>>);

impl RecentOptions {
    /// The options of this text, if it was the last text.
    pub fn of(&self, text: &str) -> Option<Options> {
        let last = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        last.as_ref().filter(|(known, _)| known == text).map(|(_, options)| options.clone())
    }

    /// Stores the options of a text.
    pub fn keep(&self, text: &str, options: &Options) {
        let mut last = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        *last = Some((text.to_string(), options.clone()));
    }
}
