//! Light bodies: which bodies get mass while the equations are solved.

mod mechanisms;

use kempe::equations::Compiled;
use kempe::model::Model;
use mechanisms::model;

/// Bars of these masses that hang on each other, the first on ground.
fn chain(masses: &[&str]) -> Model {
    let mut text = "[bodies.ground]\npoints = { Q = [0, 0] }\n".to_string();
    let (mut joints, mut last) = (String::new(), "ground".to_string());
    for (k, mass) in masses.iter().enumerate() {
        text += &format!(
            "[bodies.b{k}]\ntype = \"bar\"\nmass = {mass}\nlength = 1\nends = [\"P\", \"Q\"]\n"
        );
        joints +=
            &format!("[joints.j{k}]\ntype = \"revolute\"\ni = \"{last}.Q\"\nj = \"b{k}.P\"\n");
        last = format!("b{k}");
    }
    model(&(text + &joints))
}

/// The bodies that get mass.
fn light(masses: &[&str]) -> Vec<usize> {
    let compiled = Compiled::new(&chain(masses));
    let found = compiled.added.iter().enumerate().filter(|(_, added)| added.any());
    found.map(|(k, _)| k).collect()
}

#[test]
fn bodies_between_heavier_ones_are_light() {
    assert_eq!(light(&["1", "1e-4", "1"]), [1]);
    assert_eq!(light(&["1e-4", "1"]), [0], "between ground and a heavy body");
    assert_eq!(light(&["1", "1e-4"]), [] as [usize; 0], "it hangs on a heavy body");
    assert_eq!(light(&["1", "1e-4", "1e-8"]), [] as [usize; 0], "each hangs on a heavier one");
    assert_eq!(light(&["1", "1e-2", "1"]), [] as [usize; 0], "hardly light");
    assert_eq!(light(&["1", "0"]), [1], "without mass");
}

#[test]
fn the_examples_have_no_light_bodies() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../examples");
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_some_and(|extension| extension == "toml") {
            let compiled = Compiled::new(&model(&std::fs::read_to_string(&path).unwrap()));
            assert!(!compiled.added.iter().any(|added| added.any()), "{path:?}");
        }
    }
}
