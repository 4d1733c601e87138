//! Elimination order.

use kempe::solve::groups_first;

#[test]
fn the_first_set_goes_first_and_blocks_stay_together() {
    // a closed chain of 30 groups of three, each joined to the next by a block of two or one rows
    let (groups, n_first) = (30, 90);
    let mut starts: Vec<usize> = (0..n_first).step_by(3).collect();
    let (mut entries, mut n) = (vec![], n_first);
    for k in 0..groups {
        starts.push(n);
        entries.extend([(n, 3 * k), (n, 3 * ((7 * k + 1) % groups))]);
        n += 1 + k % 2;
    }
    let order = groups_first(n_first, n, &entries, Some(&starts));
    assert!(order[..n_first].iter().all(|&i| i < n_first));
    let mut sorted = order.clone();
    sorted.sort_unstable();
    assert!(sorted.into_iter().eq(0..n));
    for (k, &i) in order.iter().enumerate() {
        if !starts.contains(&i) {
            assert_eq!(order[k - 1], i - 1);
        }
    }
}

#[test]
fn a_chain_is_eaten_from_its_first_end() {
    let entries: Vec<_> = (1..9).map(|k| (k, k - 1)).collect();
    let order = groups_first(0, 9, &entries, None);
    assert!(order.into_iter().eq(0..9));
}
