//! Places: faults found after reading are shown in the text.

use kempe::case::{self, Document, Format};
use kempe::model::Problem;

const FOUR_BAR: &str = include_str!("../../../examples/four_bar.toml");

fn document(text: &str) -> Document {
    match case::read(text, Format::Toml) {
        Ok((_, document)) => document,
        Err(faults) => panic!("{}", faults[0]),
    }
}

#[test]
fn a_problem_of_a_value_is_shown_below_it() {
    let text = "kempe = 1\n\n\n\n[bodies.crank]\ninertia = 1\nmass = -1\n";
    let problem = Problem::at(&["bodies", "crank", "mass"], "-1 kg; must not be negative");
    let shown = document(text).diagnose(&problem.clone().hint("a mass is positive")).to_string();
    let wanted = "bodies.crank.mass: -1 kg; must not be negative (line 7, column 8)\n  \
                  7 | mass = -1\n    |        ^^\nhint: a mass is positive";
    assert_eq!(shown, wanted);
    let at_key = document(text).diagnose(&problem.at_key());
    assert_eq!((at_key.line, at_key.column), (7, 1));
}

#[test]
fn a_part_of_a_formula_is_marked_alone() {
    let document = document(FOUR_BAR);
    let path = ["forces", "spring", "free_angle"];
    let found = document.diagnose(&Problem::at(&path, "what is this").within(4..7));
    assert!(found.excerpt.ends_with("| free_angle = \"270*deg\"\n     |                   ^^^"));
    let list = document.diagnose(&Problem::at(&["bodies", "ground", "points", "D", "0"], "no"));
    assert!(list.excerpt.ends_with("D = [\"G\", 0] }\n     |                             ^^^"));
}

#[test]
fn an_escaped_text_or_a_part_that_is_not_there_is_marked_entirely() {
    let document = document("kempe = 1\n[parameters]\na = \"\\u0031 + k\"\nb = 'k'\n");
    for (key, within) in [("a", 4..5), ("b", 0..9)] {
        let found = document.diagnose(&Problem::at(&["parameters", key], "no").within(within));
        assert_eq!(found.column, 5);
    }
    let found = document.diagnose(&Problem::at(&["parameters", "b"], "no").within(0..1));
    assert_eq!(found.column, 6);
}

#[test]
fn what_is_missing_is_shown_at_its_nearest_ancestor() {
    let document = document(FOUR_BAR);
    let found = document.diagnose(&Problem::at(&["joints", "C", "axes", "0"], "missing"));
    assert!(found.excerpt.contains("[joints.C]"), "{found}");
    let top = document.diagnose(&Problem::at(&["drivers"], "missing"));
    assert_eq!((top.line, top.column), (1, 1));
}

#[test]
fn a_coordinate_is_found_however_it_is_written() {
    for line in ["set = { 'a.x' = 1 }", "set.a.x = 1", "set = { a = { x = 1 } }"] {
        let text = format!("kempe = 1\n[start]\n{line}\n");
        let found = document(&text).diagnose(&Problem::at(&["start", "set", "a.x"], "no"));
        assert_eq!((found.line, found.column), (3, line.find('1').expect("it is there") + 1));
    }
}

#[test]
fn columns_count_characters_and_carets_stand_below_tabs() {
    let text = "kempe = 1\r\n\t'µ😀'\t=\t3\r\ntitle = 'a'\r\n";
    let faults = case::read(text, Format::Toml).expect_err("no such key");
    assert_eq!((faults[0].line, faults[0].column), (2, 2));
    assert_eq!(faults[0].excerpt, "  2 |     'µ😀'    =    3\n    |     ^^^^");
}

#[test]
fn long_lines_are_shortened_around_the_fault_and_hidden_characters_are_shown() {
    let blank = " ".repeat(300);
    let text = format!("kempe = 1\ngravity = [0,{blank}true,{blank}]\n");
    let faults = case::read(&text, Format::Toml).expect_err("true is not a number");
    assert_eq!(faults[0].column, 314);
    let lines: Vec<&str> = faults[0].excerpt.lines().collect();
    assert!(lines.iter().all(|line| line.chars().count() < 120));
    let caret = lines[1].find('^').expect("a caret");
    let above: String = lines[0].chars().skip(caret).take(4).collect();
    assert_eq!(above, "true");
    let hidden = "kempe = 1\n'a\u{202e}b' = 1\n";
    let faults = case::read(hidden, Format::Toml).expect_err("no such key");
    assert_eq!(faults[0].message, "unknown key 'a\\u{202e}b'");
    assert_eq!(faults[0].excerpt, "  2 | 'a\\u{202e}b' = 1\n    | ^^^^^^^^^^^^");
}
