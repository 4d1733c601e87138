//! Scenes and display lists of all examples, and the words of the schema.

use kempe::case::{self, Format};
use kempe::elements::Mark;
use kempe::model::{Model, NODE};
use kempe::{assemble, build, State};
use kempe_drawing::display::{place, Item, Kind, Request, View};
use kempe_drawing::scene::{efforts, Scene};
use kempe_drawing::{display, scene, Pose};
use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::slice::from_ref;

const SIZE: [f64; 2] = [518.4, 291.6];

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// The start of an example; none if it needs a table from another file.
fn start(path: &Path) -> Option<(Model, State)> {
    let text = fs::read_to_string(path).unwrap();
    let (case, _) = case::read(&text, Format::Toml).ok()?;
    let model = build(&case.definition, &[]).ok()?;
    let request = case.start.request(&model).ok()?;
    let (state, _) = assemble(&model, &request).ok()?;
    Some((model, state))
}

fn poses(model: &Model, state: &State) -> Vec<Pose> {
    model.layout.bodies[1..].iter().map(|columns| columns.of(&state.q)).collect()
}

fn drawn(path: &Path) -> Option<(Scene, Vec<Pose>, View, Vec<Item>)> {
    let (model, state) = start(path)?;
    let poses = poses(&model, &state);
    let made = scene(&model, from_ref(&poses), &efforts(&model, &[state]));
    let view = View::around(made.bounds, SIZE);
    let list = display(&made, from_ref(&poses), &view, &Request::labelled());
    Some((made, poses, view, list))
}

fn examples() -> Vec<PathBuf> {
    let entries = fs::read_dir(root().join("examples")).unwrap();
    let files = entries.map(|entry| entry.unwrap().path());
    files.filter(|path| path.extension().is_some_and(|end| end == "toml")).collect()
}

#[test]
fn every_example_is_drawn_within_its_view() {
    let mut count = 0;
    for path in examples() {
        let Some((made, poses, view, list)) = drawn(&path) else { continue };
        count += 1;
        let all: Vec<Pose> = std::iter::once([0.0; 3]).chain(poses).collect();
        // the nodes of a beam are drawn as one body
        for body in made.bodies[1..].iter().filter(|body| body.kind != NODE) {
            assert!(list.iter().any(|item| item.of == body.name || !body.curves.is_empty()));
        }
        for item in &list {
            let points = place(item, &all, &view);
            assert!(points.iter().flatten().all(|x| x.is_finite()), "{path:?} {item:?}");
            if let Kind::Text { text, offset, .. } = &item.kind {
                let [x, y] = [points[0][0] + offset[0], points[0][1] + offset[1]];
                let inside = (0.0..=SIZE[0]).contains(&x) && (0.0..=SIZE[1]).contains(&y);
                assert!(inside, "{path:?} {text} at {x} {y}");
            }
        }
        assert!(list.windows(2).all(|pair| pair[0].layer <= pair[1].layer));
    }
    assert!(count > 20, "{count} examples");
}

#[test]
fn scenes_and_lists_are_read_as_they_were_written() {
    for name in ["four_bar", "slider_crank", "planetary_gear"] {
        let path = root().join(format!("examples/{name}.toml"));
        let (made, _, _, list) = drawn(&path).unwrap();
        let text = serde_json::to_string(&list).unwrap();
        assert_eq!(serde_json::from_str::<Vec<Item>>(&text).unwrap(), list);
        let read: Scene = serde_json::from_str(&serde_json::to_string(&made).unwrap()).unwrap();
        assert_eq!(read.bodies, made.bodies);
        assert_eq!(read.bounds, made.bounds);
    }
}

/// The crank of 10 m at 70°, whose pin is at A, reaches from (0, 0) to (3.42, 9.40).
#[test]
fn the_four_bar_linkage_is_where_it_is() {
    let (made, poses, view, list) = drawn(&root().join("examples/four_bar.toml")).unwrap();
    assert_eq!(made.bodies[1].outline, [[-5.0, 0.0], [5.0, 0.0]]);
    let all: Vec<Pose> = std::iter::once([0.0; 3]).chain(poses).collect();
    let link = list.iter().find(|item| item.of == "crank" && item.layer == 1).unwrap();
    let ends: Vec<_> = place(link, &all, &view).iter().map(|at| view.plane(*at)).collect();
    let angle = 70.0_f64.to_radians();
    for (found, wanted) in ends.iter().zip([[0.0, 0.0], [10.0 * angle.cos(), 10.0 * angle.sin()]]) {
        let apart = f64::hypot(found[0] - wanted[0], found[1] - wanted[1]);
        assert!(apart < 1e-6, "{found:?} {wanted:?}");
    }
}

#[test]
fn the_words_of_marks_are_those_of_the_schema() {
    let path = root().join("python/kempe/draw/assets/scene.schema.json");
    let schema: serde_json::Value =
        serde_json::from_str(&fs::read_to_string(path).unwrap()).unwrap();
    let words = schema["$defs"]["symbol"]["properties"]["mark"]["enum"].as_array().unwrap();
    let words: BTreeSet<&str> = words.iter().filter_map(|word| word.as_str()).collect();
    assert_eq!(words, Mark::ALL.iter().map(|mark| mark.name()).collect());
}
