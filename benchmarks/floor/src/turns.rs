//! Medians of alternating programs, so that other load on the machine affects all of them equally.

/// Calls each program once per turn; returns the median of the results of each.
pub fn medians(turns: usize, programs: &mut [&mut dyn FnMut() -> f64]) -> Vec<f64> {
    let mut found = vec![Vec::with_capacity(turns); programs.len()];
    for _ in 0..turns {
        for (program, found) in programs.iter_mut().zip(&mut found) {
            found.push(program());
        }
    }
    let median = |values: &mut Vec<f64>| {
        values.sort_by(f64::total_cmp);
        values[values.len() / 2]
    };
    found.iter_mut().map(median).collect()
}
