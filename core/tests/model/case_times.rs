//! Analyses that end before they begin are found with their places.

use kempe::case::{self, Format};
use kempe::model;

/// A pendulum with analyses.
const HEAD: &str = "kempe = 1\n\n[parameters]\nT = 2\n\n[bodies.rod]\nmass = 1\ninertia = 1\n\n";

/// Messages and lines of the analyses that end before they begin.
fn backward(analyses: &str) -> Vec<(String, usize)> {
    let (case, document) = case::read(&format!("{HEAD}{analyses}"), Format::Toml).expect("reads");
    let model = model::build(&case.definition, &[]).expect("builds");
    let found = case.faults(&model);
    found
        .iter()
        .filter(|p| p.to_string().contains("lies before"))
        .map(|p| (p.to_string(), document.diagnose(p).line - HEAD.lines().count()))
        .collect()
}

fn analysis(name: &str, fields: &str) -> String {
    format!("[analyses.{name}]\ntype = 'dynamics'\n{fields}\n")
}

#[test]
fn an_end_before_the_start_is_found() {
    let found = backward(&analysis("a", "t_end = -1"));
    let expected = "analyses.a.t_end: -1 s lies before 0 s, where the run starts; t_end is a time, not a duration; it must \
                be at least 0 s";
    assert_eq!(found, [(expected.to_string(), 3)]);
}

#[test]
fn an_analysis_starts_where_the_one_before_it_ends() {
    let two = |second: &str| backward(&(analysis("a", "t_end = 'T'") + &analysis("b", second)));
    assert_eq!(two("t_end = 3"), []);
    assert_eq!(two("t_end = 2"), []);
    let found = two("t_end = 1");
    assert_eq!(found.len(), 1);
    assert!(found[0].0.starts_with("analyses.b.t_end: 1 s lies before 2 s"), "{found:?}");
    assert_eq!(found[0].1, 6);
}

#[test]
fn from_and_t_start_give_the_start() {
    let three = |third: &str| {
        backward(
            &(analysis("a", "t_end = 1") + &analysis("b", "t_end = 2") + &analysis("c", third)),
        )
    };
    assert_eq!(three("t_end = 1.5\nfrom = 'a'"), []);
    assert_eq!(three("t_end = 0.5\nfrom = 'start'"), []);
    assert_eq!(three("t_end = 0.5\nt_start = 0"), []);
    assert!(three("t_end = 0.5\nfrom = 'a'")[0].0.contains("0.5 s lies before 1 s"));
    assert!(three("t_end = 4\nt_start = 5")[0].0.contains("4 s lies before 5 s"));
}

#[test]
fn an_analysis_with_faulty_options_hides_only_its_successor() {
    let faulty = analysis("a", "t_end = 'what'") + &analysis("b", "t_end = -1");
    assert_eq!(backward(&faulty), []);
    let later = faulty + &analysis("c", "t_end = -2");
    assert_eq!(backward(&later).len(), 1);
}
