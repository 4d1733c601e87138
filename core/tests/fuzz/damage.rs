//! Texts with faults: lines and words lost, doubled or exchanged, numbers made extreme, bytes replaced.

use crate::random::Random;

/// The texts that are damaged.
pub const EXAMPLES: [&str; 4] = [
    include_str!("../../../examples/four_bar.toml"),
    include_str!("../../../examples/pendulum.toml"),
    include_str!("../../../examples/six_bar.toml"),
    include_str!("../../../examples/slider_crank.toml"),
];

/// Values in place of others.
const VALUES: [&str; 20] = [
    "0",
    "-1",
    "1e-300",
    "1e300",
    "1e308",
    "nan",
    "inf",
    "-0.0",
    "\"\"",
    "\"k\"",
    "\"2*t\"",
    "\"1/0\"",
    "\"sqrt(-1)\"",
    "\"crank.angle\"",
    "true",
    "[]",
    "[0, 0]",
    "{}",
    "1979-05-27",
    "\"\\u202e\"",
];
/// Characters that matter.
const MARKS: [&str; 12] = ["\"", "[", "]", "{", "}", "=", ".", "\n", "\0", "é", ",", "#"];

/// The text with one to three faults.
pub fn damaged(random: &mut Random, mut text: String) -> String {
    for _ in 0..=random.below(3) {
        text = match random.below(6) {
            0 => lines(random, &text, |random, lines| _ = lines.remove(random.below(lines.len()))),
            1 => lines(random, &text, |random, lines| {
                let [from, to] = [random.below(lines.len()), random.below(lines.len())];
                lines.insert(to, lines[from]);
            }),
            2 => lines(random, &text, |random, lines| {
                let [a, b] = [random.below(lines.len()), random.below(lines.len())];
                lines.swap(a, b);
            }),
            3 | 4 => value(random, &text),
            _ => mark(random, &text),
        };
    }
    text
}

fn lines<'a>(
    random: &mut Random,
    text: &'a str,
    change: impl FnOnce(&mut Random, &mut Vec<&'a str>),
) -> String {
    let mut lines: Vec<&str> = text.lines().collect();
    if lines.len() > 1 {
        change(random, &mut lines);
    }
    lines.join("\n")
}

/// Another value for a key.
fn value(random: &mut Random, text: &str) -> String {
    let mut lines: Vec<String> = text.lines().map(str::to_string).collect();
    let keys: Vec<usize> = (0..lines.len()).filter(|k| lines[*k].contains(" = ")).collect();
    if let Some(&k) = keys.get(random.below(keys.len())) {
        let key = lines[k].split(" = ").next().unwrap_or_default().to_string();
        lines[k] = format!("{key} = {}", random.choice(&VALUES));
    }
    lines.join("\n")
}

fn mark(random: &mut Random, text: &str) -> String {
    let places: Vec<usize> = text.char_indices().map(|(k, _)| k).collect();
    let Some(&k) = places.get(random.below(places.len())) else { return text.to_string() };
    let rest = text[k..].chars().next().map_or(0, char::len_utf8);
    format!("{}{}{}", &text[..k], random.choice(&MARKS), &text[k + rest..])
}
