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
    let mut search = ClosestWord::to(word)?;
    candidates.into_iter().for_each(|candidate| search.look(candidate.as_ref()));
    search.best.map(|(_, candidate)| candidate)
}

/// The search among candidates of any type.
struct ClosestWord {
    word: String,
    length: usize,
    /// The closest candidate and its distance.
    best: Option<(usize, String)>,
}

impl ClosestWord {
    /// None if the word is too long.
    fn to(word: &str) -> Option<Self> {
        let word = word.to_lowercase();
        let length = word.chars().count();
        (length <= LONGEST).then_some(Self { word, length, best: None })
    }

    fn look(&mut self, candidate: &str) {
        let lower = candidate.to_lowercase();
        let other = lower.chars().count();
        let limit = self.length.max(other) / 3;
        // the distance is at least the difference in length; this test avoids the quadratic comparison
        if self.length.abs_diff(other) > limit {
            return;
        }
        let distance = strsim::osa_distance(&self.word, &lower);
        if distance <= limit && self.best.as_ref().is_none_or(|(least, _)| distance < *least) {
            self.best = Some((distance, candidate.to_string()));
        }
    }
}

/// The result of [`closest`] as a hint: "did you mean 'crank'?".
pub fn did_you_mean<T: AsRef<str>>(
    word: &str,
    candidates: impl IntoIterator<Item = T>,
) -> Option<String> {
    closest(word, candidates).map(|candidate| format!("did you mean '{candidate}'?"))
}

/// The hint for a word by which other programs name the frame of a body, where `words` name the frames of i and j.
pub fn frame_meant(word: &str, words: &[&str]) -> Option<String> {
    let own = words.contains(&"i") && ["local", "body", "own", "moving"].contains(&word);
    own.then(|| "did you mean 'i' or 'j'? they are the frames of the bodies".to_string())
}
