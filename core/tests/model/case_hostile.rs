//! Hostile texts: damaged, huge or deep, they are refused and never end the program.

use crate::mechanisms::count;
use kempe::case::{self, Format, MOST_BYTES, MOST_DEPTH, MOST_REPORTED};

const FOUR_BAR: &str = include_str!("../../../examples/four_bar.toml");

/// Reads a text and, if it is a case, writes it and reads the result.
fn survives(text: &str, format: Format) {
    match case::read(text, format) {
        Ok((read, _)) => {
            let again = case::read(&case::write(&read, format), format).map(|(case, _)| case);
            assert_eq!(again, Ok(read), "{text}");
        }
        Err(faults) => {
            assert!(!faults.is_empty());
            // the last may be the number of further faults
            let placed = faults.len() - usize::from(faults.last().is_some_and(|f| f.line == 0));
            assert!(placed > 0 && placed <= MOST_REPORTED);
            for fault in &faults[..placed] {
                let lines = text.split('\n').count();
                assert!((1..=lines).contains(&fault.line), "{fault}");
                assert_eq!(fault.excerpt.lines().count(), 2, "{fault}");
            }
        }
    }
}

/// Three of the characters that matter, others at each place.
fn others(k: usize) -> [&'static str; 3] {
    const MARKS: [&str; 13] = ["\"", "[", "]", "{", "}", "=", ".", "\n", "\0", "9", "é", ":", ","];
    std::array::from_fn(|n| MARKS[(3 * k + n) % MARKS.len()])
}

/// A text with damage at every fifth place, and at every place in the full sample.
fn damaged(text: &str, format: Format) {
    for (k, old) in text.char_indices().step_by(count(5, 1) as usize) {
        let rest = &text[k + old.len_utf8()..];
        survives(&text[..k], format);
        survives(&format!("{}{}", &text[..k], rest), format);
        for c in others(k) {
            survives(&format!("{}{c}{}", &text[..k], rest), format);
        }
    }
}

#[test]
fn the_flagship_survives_damage_everywhere() {
    damaged(FOUR_BAR, Format::Toml);
}

#[test]
fn the_flagship_in_json_survives_damage_everywhere() {
    let (case, _) = case::read(FOUR_BAR, Format::Toml).expect("the example is right");
    damaged(&case::write(&case, Format::Json), Format::Json);
}

#[test]
fn deep_texts_are_refused() {
    let deep = 100_000;
    let dotted = vec!["a"; deep].join(".");
    for text in [
        format!("a = {}", "[".repeat(deep)),
        format!("a = {}{}", "[".repeat(deep), "]".repeat(deep)),
        "a = { b = ".to_string() + &"{ b = ".repeat(deep),
        format!("[{dotted}]"),
        format!("{dotted} = 1"),
        format!("a = {{ {dotted} = 1 }}"),
        "[[a.b]]\n".repeat(2) + &format!("c.{dotted} = 1"),
    ] {
        survives(&text, Format::Toml);
        assert!(case::parse_tree(&text, Format::Toml).is_err());
    }
    for text in ["[".repeat(deep), "{\"a\":".repeat(deep)] {
        survives(&format!("{{\"a\": {text}"), Format::Json);
    }
    let at_limit = |n: usize| format!("{{\"a\": {}{}}}", "[".repeat(n), "]".repeat(n));
    assert!(case::parse_tree(&at_limit(MOST_DEPTH), Format::Json).is_ok());
    assert!(case::parse_tree(&at_limit(MOST_DEPTH + 1), Format::Json).is_err());
    let toml = |n: usize| format!("a = {}{}", "[".repeat(n), "]".repeat(n));
    assert!(case::parse_tree(&toml(MOST_DEPTH), Format::Toml).is_ok());
    assert!(case::parse_tree(&toml(MOST_DEPTH + 1), Format::Toml).is_err());
}

#[test]
fn large_texts_are_refused_with_few_faults() {
    let large = " ".repeat(MOST_BYTES + 1);
    assert!(case::read(&large, Format::Toml).is_err_and(|f| f[0].message.contains("at most")));
    survives(&"=\n".repeat(100_000), Format::Toml);
    survives(&"a\n".repeat(100_000), Format::Toml);
    let keys: String = (0..20_000).map(|k| format!("a{k} = 1\n")).collect();
    survives(&keys, Format::Toml);
    let joints: String = (0..20_000).map(|k| format!("[joints.a{k}]\ntype = 3\n")).collect();
    survives(&joints, Format::Toml);
}
