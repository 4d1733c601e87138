//! Variants of the flagship over 15 s by the default method: by hand, and by a sweep on one thread.

use crate::evaluations::{assembled, FLAGSHIP};
use crate::runs::timed;
use crate::turns::medians;
use kempe::analyses::sweep::{Outcome, Statistic, Sweep, VariantRow, Wanted};
use kempe::case::{read, Format};
use kempe_floor::chain::Chain;
use kempe_floor::dormand_prince::integrate;
use kempe_floor::linkage::{N_Y, STIFFNESS};
use serde_json::{json, Value};
use std::sync::Arc;

const T_END: f64 = 15.0;
const GRID: f64 = 0.01;
/// As many as the sweep of the Python package computes together.
const VARIANTS: usize = 32;

/// CPU times of a run at rtol 1e-6 by hand, and of a variant with the final rocker angle: "scalars" one variant after
/// the other, "lanes" four side by side.
pub fn measure(repeat: usize) -> Value {
    let (model, start) = assembled(FLAGSHIP);
    let y: [f64; N_Y] = [start.q.as_slice(), &start.v].concat().try_into().expect("three bodies");
    let (case, _) = read(FLAGSHIP, Format::Toml).expect("the flagship");
    let mut analyses = case.analyses.clone();
    analyses.truncate(1);
    analyses[0].fields.retain(|(name, _)| ["type", "t_end", "output_step"].contains(&&name[..]));
    let sweep = Sweep {
        model: Arc::new(model),
        definition: Arc::new(case.definition.clone()),
        set: case.start.set.clone(),
        guess: case.start.guess.clone(),
        analyses,
        measures: vec!["rocker.angle".into()],
        wanted: vec![Wanted::Statistic(0, Statistic::Final)],
    };
    let stiffness = |k: usize| STIFFNESS * (0.5 + 1.5 * k as f64 / VARIANTS as f64);
    let row = |k: usize| (vec![("k".to_string(), stiffness(k))], Vec::new());
    let rows: Vec<VariantRow> = (0..VARIANTS).map(row).collect();
    let together = |rows: &[VariantRow]| {
        let outcomes = sweep.variants(rows, &|| false);
        assert!(outcomes.iter().all(|one| matches!(one, Outcome::Values(_))), "{outcomes:?}");
    };
    let each = |seconds: f64| seconds / VARIANTS as f64;
    let by_hand =
        || (0..VARIANTS).for_each(|_| drop(integrate::<Chain>(&y, T_END, GRID, (1e-6, 1e-9))));
    let found = medians(
        repeat,
        &mut [
            &mut || each(timed(by_hand).0),
            &mut || each(timed(|| rows.chunks(1).for_each(together)).0),
            &mut || each(timed(|| together(&rows)).0),
        ],
    );
    json!({
        "chain_seconds": found[0],
        "scalars_seconds": found[1],
        "lanes_seconds": found[2],
        "scalars_over_floor": found[0] / found[1],
        "lanes_over_floor": found[0] / found[2],
    })
}
