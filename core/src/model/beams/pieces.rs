//! The division of a beam into elements.

use super::super::beam_names::PER_ELEMENT;
use crate::elements::beam_line::PLACES;
use crate::math::Listed;

/// An element of a beam: the texts of its first arc length and its length, and its nodes along the beam.
pub struct BeamElement {
    pub start: String,
    pub length: String,
    pub nodes: [usize; 4],
}

/// The nodes along a beam, and the elements between them.
pub struct Division {
    /// The arc length of each node as text.
    pub at: Vec<String>,
    pub elements: Vec<BeamElement>,
    /// Whether a node is a place with a name.
    pub named: Vec<bool>,
}

/// Divides a beam whose places with names have the arc lengths `places`, as texts and as numbers, from one end to the
/// other.
pub fn divide(places: &[(String, f64)], elements: usize) -> Division {
    let gaps: Vec<f64> = places.windows(2).map(|pair| pair[1].1 - pair[0].1).list();
    let mut counts = vec![1; gaps.len()];
    for _ in gaps.len()..elements {
        // the longest elements are divided first
        let longest = (0..gaps.len()).max_by(|a, b| {
            let size = |k: &usize| gaps[*k] / counts[*k] as f64;
            size(a).total_cmp(&size(b)).then(b.cmp(a))
        });
        longest.into_iter().for_each(|k| counts[k] += 1);
    }
    let mut made =
        Division { at: vec![places[0].0.clone()], elements: Vec::new(), named: vec![true] };
    for (gap, count) in counts.iter().enumerate() {
        let (from, to) = (&places[gap].0, &places[gap + 1].0);
        let length = format!("(({to}-{from})/{count})");
        for k in 0..*count {
            let start = if k == 0 { from.clone() } else { format!("({from}+{k}*{length})") };
            let first = made.at.len() - 1;
            for xi in &PLACES[1..3] {
                made.at.push(format!("({start}+({:?})*{length})", 0.5 * (1.0 + xi)));
                made.named.push(false);
            }
            let last = k + 1 == *count;
            made.at.push(if last { to.clone() } else { format!("({from}+{}*{length})", k + 1) });
            made.named.push(last);
            let nodes = [first, first + 1, first + 2, first + PER_ELEMENT];
            made.elements.push(BeamElement { start, length: length.clone(), nodes });
        }
    }
    made
}
