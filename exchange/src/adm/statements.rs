//! The statements of an `.adm` file: `NAME/number, KEYWORD, KEY = value, value`, continued by lines that begin with a comma.

/// In place of the comma at the beginning of a line, which may lie within a formula.
const CONTINUED: char = '\u{1}';

/// A statement with its first line.
#[derive(Debug, Default)]
pub(super) struct Statement {
    pub(super) line: usize,
    pub(super) kind: String,
    pub(super) id: String,
    /// The name that the other program shows, or the kind with the number.
    pub(super) name: String,
    pub(super) words: Vec<String>,
    pub(super) fields: Vec<(String, Vec<String>)>,
}

impl Statement {
    /// The first value of a key.
    pub(super) fn get(&self, key: &str) -> Option<&str> {
        self.all(key)?.first().map(String::as_str)
    }

    pub(super) fn all(&self, key: &str) -> Option<&[String]> {
        self.fields.iter().find(|(name, _)| name == key).map(|(_, values)| &values[..])
    }

    pub(super) fn is(&self, word: &str) -> bool {
        self.words.iter().any(|found| found == word)
    }

    /// The number that a reference names, without leading zeros.
    pub(super) fn reference(&self, key: &str) -> Option<String> {
        self.get(key).map(plain)
    }

    /// The numbers of a key; angles may be in degrees: `90D`.
    pub(super) fn numbers(&self, key: &str) -> Result<Option<Vec<f64>>, String> {
        let Some(values) = self.all(key) else { return Ok(None) };
        let one = |text: &String| {
            number(text).ok_or_else(|| format!("{key}: '{}' is not a number", short(text)))
        };
        values.iter().map(one).collect::<Result<_, _>>().map(Some)
    }

    /// The only number of a key.
    pub(super) fn number(&self, key: &str) -> Result<Option<f64>, String> {
        match self.numbers(key)?.as_deref() {
            None => Ok(None),
            Some(&[x]) => Ok(Some(x)),
            Some(_) => Err(format!("{key}: must be one number")),
        }
    }
}

/// The beginning of a text, for messages.
pub(super) fn short(text: &str) -> String {
    text.chars().take(60).collect()
}

/// An identifier without leading zeros.
fn plain(id: &str) -> String {
    let digits = id.trim().trim_start_matches('0');
    if digits.is_empty() {
        "0".into()
    } else {
        digits.to_string()
    }
}

/// A number; a `D` after it makes it an angle in degrees.
fn number(text: &str) -> Option<f64> {
    let text = text.trim();
    let (digits, factor) = match text.strip_suffix(['D', 'd']) {
        Some(digits) => (digits, std::f64::consts::PI / 180.0),
        None => (text, 1.0),
    };
    digits.trim().parse::<f64>().ok().filter(|x| x.is_finite()).map(|x| x * factor)
}

/// The statements of a text.
pub(super) fn read(text: &str) -> Vec<Statement> {
    let mut found: Vec<(usize, String, String)> = Vec::new();
    let mut view = String::new();
    // the first line is a title
    for (k, line) in text.lines().enumerate().skip(1) {
        if let Some((_, name)) = line.split_once("adams_view_name='") {
            view = name.split('\'').next().unwrap_or_default().to_string();
        }
        let content = line.split('!').next().unwrap_or_default().trim();
        if content.is_empty() {
            continue;
        }
        match found.last_mut() {
            Some((_, _, whole)) if content.starts_with(',') => {
                whole.push(CONTINUED);
                whole.push_str(&content[1..]);
            }
            _ => found.push((k + 1, std::mem::take(&mut view), content.to_string())),
        }
    }
    found.into_iter().map(|(line, view, whole)| statement(line, &view, &whole)).collect()
}

fn statement(line: usize, view: &str, whole: &str) -> Statement {
    let (head, rest) = whole.split_once('/').unwrap_or((whole, ""));
    let mut made = Statement { line, kind: head.trim().to_uppercase(), ..Statement::default() };
    let mut parts = parts(rest).into_iter().peekable();
    if let Some(id) = parts.next_if(|part| !part.contains('=')) {
        made.id = plain(&id);
    }
    made.name =
        if view.is_empty() { format!("{}_{}", made.kind, made.id) } else { view.to_string() };
    let mut open = false;
    for part in parts {
        match part.split_once('=') {
            Some((key, value)) => {
                made.fields.push((
                    key.trim().to_uppercase(),
                    vec![value.replace(CONTINUED, " ").trim().to_string()],
                ));
                open = true;
            }
            // a formula goes on after a comma
            None if made.fields.last().is_some_and(|(key, _)| key == "FUNCTION") => {
                if let Some(law) = made.fields.last_mut().and_then(|(_, values)| values.last_mut())
                {
                    law.push_str(&part.replace(CONTINUED, " "));
                }
            }
            None if open && number(&part).is_some() => {
                if let Some((_, values)) = made.fields.last_mut() {
                    values.push(part.trim().to_string());
                }
            }
            None => {
                made.words.push(part.trim().to_uppercase());
                open = false;
            }
        }
    }
    made
}

/// The parts of a statement between commas outside of parentheses.
fn parts(text: &str) -> Vec<String> {
    let (mut found, mut depth) = (vec![String::new()], 0_i64);
    for c in text.chars() {
        match c {
            '(' => depth += 1,
            ')' => depth -= 1,
            _ => {}
        }
        if (c == ',' || c == CONTINUED) && depth <= 0 {
            found.push(String::new());
        } else if let Some(last) = found.last_mut() {
            last.push(c);
        }
    }
    found.retain(|part| !part.trim().is_empty());
    found
}
