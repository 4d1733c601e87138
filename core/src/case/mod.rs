//! Text of a case ↔ [`Case`]: strings in, strings out, with positions and suggestions.
//!
//! A case is a model, a start and any number of analyses, in TOML or JSON. [`read`] reports all faults of the
//! structure at once. Faults of the mechanics are [`Problem`](crate::model::Problem)s of the model, and
//! [`Document::diagnose`] finds their places in the text.
//!
//! | file | concept |
//! |---|---|
//! | `tree`, `fault` | values with their places, and faults of syntax |
//! | `json`, `toml`, `toml_tables` | text → tree |
//! | `diagnostic`, `document` | places → line, column, excerpt |
//! | `report` | problems by path |
//! | `names`, `values`, `fields`, `tables`, `bodies`, `start`, `sweep`, `columns`, `problems`, `check` | tree → [`Case`], with every fault of structure |
//! | `write_value`, `write_json`, `write_toml`, `write` | [`Case`] → text |
//! | `faults` | faults of the start and the analyses that can be found only with the model |
//! | `run` | the analyses of a case in their order |
//! | `schema`, `schema_parts`, `schema_requests`, `json_literal`, `catalogue` | the JSON Schema; the declarations of the possible contents of a case |

mod bodies;
mod body_builder;
mod builder;
mod catalogue;
mod check;
mod columns;
mod contents;
mod diagnostic;
mod document;
mod events;
pub mod exercise;
mod fault;
mod faults;
mod fields;
mod json;
mod json_literal;
mod names;
mod problems;
mod report;
mod run;
mod schema;
mod schema_parts;
mod schema_requests;
mod schema_tasks;
mod start;
mod start_builder;
mod sweep;
mod tables;
mod tasks;
mod toml;
mod toml_tables;
mod tree;
mod values;
mod write;
mod write_json;
mod write_toml;
mod write_value;

use crate::math::{Listed, Ordered};
pub use body_builder::{Bar, BodyBuilder, General, Ground, PointMass};
pub use builder::ModelBuilder;
pub use catalogue::catalogue;
pub use contents::{Case, Format, Start, FORMAT_VERSION, MOST_BYTES, MOST_REPORTED};
use diagnostic::shown;
pub use diagnostic::Diagnostic;
pub use document::Document;
pub use names::RESERVED;
pub use schema::schema;
pub use tree::{MOST_DEPTH, MOST_VALUES};
pub use write::write;
pub use write_value::digits;

use crate::model::Value;

/// Reads a case.
///
/// Errors: every fault of syntax. If there is none, every fault of structure: unknown or missing keys, wrong shapes
/// and invalid names. The faults are sorted by place, and at most [`MOST_REPORTED`] are returned. If there are more,
/// a last entry without a place contains their number.
pub fn read(text: &str, format: Format) -> Result<(Case, Document), Vec<Diagnostic>> {
    let (document, mut found) = Document::parse(text, format)?;
    let (case, (problems, dropped)) = check::case(document.root(), format);
    problems.iter().map(|problem| document.diagnose(problem)).append_to(&mut found);
    if found.is_empty() {
        return Ok((case, document));
    }
    found.order_by_key(|fault| (fault.line, fault.column));
    Err(shortened(found, dropped))
}

/// The values of any text in order, without checks of their meaning.
///
/// Errors: faults of syntax, and values that a case must not contain, such as dates and numbers that are not finite.
pub fn parse_tree(text: &str, format: Format) -> Result<Value, Vec<Diagnostic>> {
    let (document, mut found) = Document::parse(text, format)?;
    let (refused, dropped) = check::refused(document.root(), format);
    refused.iter().map(|problem| document.diagnose(problem)).append_to(&mut found);
    if found.is_empty() {
        Ok(document.value())
    } else {
        Err(shortened(found, dropped))
    }
}

/// The first faults, and the number of the others.
fn shortened(mut found: Vec<Diagnostic>, dropped: usize) -> Vec<Diagnostic> {
    let more = found.len().saturating_sub(MOST_REPORTED) + dropped;
    found.truncate(MOST_REPORTED);
    found.extend((more > 0).then(|| Diagnostic::more(more)));
    found
}
