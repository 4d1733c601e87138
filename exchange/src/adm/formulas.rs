//! Formulas and angles of `.adm` files.

use super::statements::Statement;
use crate::space::{product, Rotation};

/// The rotation of Euler's angles: about z, then the new x, then the new z.
pub(super) fn euler(angles: [f64; 3]) -> Rotation {
    let z = |angle: f64| {
        let (s, c) = angle.sin_cos();
        [[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]]
    };
    let (s, c) = angles[1].sin_cos();
    product(&product(&z(angles[0]), &[[1.0, 0.0, 0.0], [0.0, c, -s], [0.0, s, c]]), &z(angles[2]))
}

/// The formula of a statement, with degrees such as `30D` in rad.
pub(super) fn function(statement: &Statement) -> Result<String, String> {
    let text = statement.get("FUNCTION").ok_or("FUNCTION is missing")?;
    let characters: Vec<char> = text.to_lowercase().chars().collect();
    let mut out = String::new();
    let mut k = 0;
    while k < characters.len() {
        let begins = characters[k].is_ascii_digit()
            && !out.ends_with(|c: char| c.is_alphanumeric() || c == '_' || c == '.');
        if !begins {
            out.push(characters[k]);
            k += 1;
            continue;
        }
        let start = k;
        while k < characters.len() && (characters[k].is_ascii_digit() || characters[k] == '.') {
            k += 1;
        }
        let digits: String = characters[start..k].iter().collect();
        let degrees = characters.get(k) == Some(&'d')
            && !characters.get(k + 1).is_some_and(|c| c.is_alphanumeric());
        out += &if degrees { format!("({digits}*pi/180)") } else { digits };
        k += usize::from(degrees);
    }
    Ok(out)
}

/// The formula with a measure of a pair of markers, in either order, replaced.
pub(super) fn replaced(law: &str, name: &str, pair: &[String; 2], by: &str) -> String {
    let mut out = String::new();
    let mut rest = law;
    let head = format!("{name}(");
    while let Some((before, after)) = rest.split_once(&head) {
        let inside = after.split(')').next().unwrap_or_default();
        let mut ids: Vec<&str> =
            inside.split(',').map(|id| id.trim().trim_start_matches('0')).collect();
        let mut wanted: Vec<&str> = pair.iter().map(String::as_str).collect();
        ids.sort_unstable();
        wanted.sort_unstable();
        out += before;
        if ids == wanted && after.len() > inside.len() {
            out += by;
            rest = &after[inside.len() + 1..];
        } else {
            out += &head;
            rest = after;
        }
    }
    out + rest
}
