//! Files of other tools, and JSON files of kempe, as the text of a case.

use crate::fault::Fault;
use kempe::case::{self, Format};
use kempe_exchange::Format as Foreign;
use serde_json::{json, Value};

/// Comments of a text list so many parts that were not read.
const LISTED: usize = 200;

/// The text of the case in a file. Its name and its first lines give the format. Comments at its beginning list what
/// the case lacks; `lost` counts those that change the motion or the forces.
pub fn read(content: &str, name: &str) -> Result<Value, Fault> {
    let ending = name.rsplit_once('.').map_or("", |(_, ending)| ending);
    if ending.eq_ignore_ascii_case("json") {
        return Ok(json!({ "text": rewritten(content)?, "lost": 0 }));
    }
    let Some(format) = Foreign::named(ending).or_else(|| Foreign::of(content)) else {
        if content.contains("<mujoco") {
            return Err(Fault::new(format!(
                "{name} is a file of MuJoCo, which the page cannot read"
            ))
            .hint(format!("kempe convert {name} case.toml")));
        }
        return Ok(json!({ "text": content, "lost": 0 }));
    };
    let read = kempe_exchange::read(content, format);
    let mut notes: Vec<String> = read.unread.iter().map(ToString::to_string).collect();
    let Some(found) = read.case else {
        return Err(Fault::new(format!("cannot read {name}: {}", notes.join("; "))));
    };
    let lost = read.unread.iter().filter(|part| !part.harmless).count();
    let more = notes.len().saturating_sub(LISTED);
    notes.truncate(LISTED);
    if more > 0 {
        notes.push(format!("and {more} more; kempe convert lists all"));
    }
    if !read.results.is_empty() {
        notes.push("its results; kp.compare reads them".to_string());
    }
    let text = rewritten(&found)?;
    if notes.is_empty() {
        return Ok(json!({ "text": text, "lost": lost }));
    }
    let lines: Vec<String> = notes.iter().map(|note| format!("#   {}\n", one_line(note))).collect();
    let head = format!("# Not read from {}:\n{}", one_line(name), lines.concat());
    Ok(json!({ "text": head + "\n" + &text, "lost": lost }))
}

/// A case in JSON as TOML.
fn rewritten(content: &str) -> Result<String, Fault> {
    let read = case::read(content, Format::Json);
    let (case, _) = read.map_err(|problems| Fault::of_diagnostics(&problems))?;
    Ok(case::write(&case, Format::Toml))
}

/// A text for a comment: control characters would end it.
fn one_line(text: &str) -> String {
    text.chars().map(|c| if c.is_control() { ' ' } else { c }).collect()
}
