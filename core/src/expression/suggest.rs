//! "Did you mean": the known word closest to an unknown word.

/// Longer words yield no suggestion, because the cost of the comparison is quadratic.
const LONGEST: usize = 100;

/// The candidate closest to `word`, if it is close enough to be intended.
///
/// Closeness is measured by the Damerau–Levenshtein distance (insertions, deletions, substitutions and swaps of
/// neighbours), which ignores case. At most a third of the longer word may differ, so that `L4` does not suggest
/// `L1`. Of equally close candidates, the first is returned.
pub fn closest<T: AsRef<str>>(
    word: &str,
    candidates: impl IntoIterator<Item = T>,
) -> Option<String> {
    let lower_word = word.to_lowercase();
    let length = lower_word.chars().count();
    if length > LONGEST {
        return None;
    }
    let mut best: Option<(usize, String)> = None;
    for candidate in candidates {
        let candidate = candidate.as_ref();
        let lower = candidate.to_lowercase();
        let other = lower.chars().count();
        let limit = length.max(other) / 3;
        // the distance is at least the difference in length; this test avoids the quadratic comparison
        if length.abs_diff(other) > limit {
            continue;
        }
        let distance = strsim::osa_distance(&lower_word, &lower);
        if distance <= limit && best.as_ref().is_none_or(|(least, _)| distance < *least) {
            best = Some((distance, candidate.to_string()));
        }
    }
    best.map(|(_, candidate)| candidate)
}

/// The result of [`closest`] as a hint: "did you mean 'crank'?".
pub fn did_you_mean<T: AsRef<str>>(
    word: &str,
    candidates: impl IntoIterator<Item = T>,
) -> Option<String> {
    closest(word, candidates).map(|candidate| format!("did you mean '{candidate}'?"))
}
