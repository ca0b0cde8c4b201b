//! The paper's comparison of behaviors (paper, section 3 and figure 4): a behavior and its mirror image are one group.
//! The paper does not name its test. Here it is the exact Mann-Whitney U test between each two groups, with Holm's
//! correction and the effect size A12.

use std::collections::BTreeMap;
use std::fmt::Write;

use serde::Serialize;

use crate::{Align, TextTable};
use nbc_base::model::{Behavior, Pattern};
use nbc_swarm::evolve::Champion;

/// Thresholds of significance and their marks; the paper's is the last.
const THRESHOLDS: [(f64, &str); 3] = [(0.05, "*"), (0.01, "**"), (0.001, "***")];

#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct BehaviorGroup {
    /// Such as `XXYY` for LLRR and RRLL.
    pub name: &'static str,
    /// Stimuli that its robots answer.
    pub stimuli: usize,
    /// Its place in the paper's order of difficulty, from 0 to 3.
    pub difficulty: usize,
    /// The mean distance in voxels of the champions of each run that found any, one for each behavior found.
    pub values: Vec<f64>,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct GroupComparison {
    /// Their places among the groups.
    pub groups: [usize; 2],
    /// The probability, by the exact two-sided test, that values this far apart come from the same distribution.
    pub p: f64,
    /// After Holm's correction.
    pub p_adjusted: f64,
    /// The smallest adjusted value that is possible with so few runs.
    pub p_least: f64,
    /// The probability that a value of the first group exceeds one of the second, ties counting half.
    pub a12: f64,
    /// Whether ties made the exact test impossible, so that its normal approximation was used.
    pub is_approximate: bool,
}

const GROUPS: [(&str, usize, usize); 8] = [
    ("XXXX", 0, 0),
    ("XXYY", 1, 1),
    ("XYXY", 1, 1),
    ("XXXY", 2, 2),
    ("XXYX", 2, 2),
    ("XYXX", 2, 2),
    ("XYYY", 2, 2),
    ("XYYX", 2, 3),
];

pub(super) const DIFFICULTIES: [&str; 4] = ["none", "one", "both", "XOR and XNOR"];

pub(super) fn group_of(behavior: Behavior) -> usize {
    let first = behavior.direction(Pattern::PAIRS[0]);
    let letter = |pattern| if behavior.direction(pattern) == first { 'X' } else { 'Y' };
    let is_own = |name: &str| behavior.patterns().map(letter).eq(name.chars());
    GROUPS.iter().position(|&(name, ..)| is_own(name)).expect("there are eight such names")
}

pub fn difficulty_of(behavior: Behavior) -> usize {
    let (_, _, difficulty) = GROUPS[group_of(behavior)];
    difficulty
}

/// The groups' values, one for each run. Champions of one run are not independent samples, and neither are two runs
/// with the same seed, so runs are grouped by seed. Behaviors of three stimuli are in no group.
pub fn behavior_groups(runs: &BTreeMap<u64, Vec<Champion>>) -> Vec<BehaviorGroup> {
    let groups = GROUPS.iter().enumerate();
    groups
        .map(|(i, &(name, stimuli, difficulty))| BehaviorGroup { name, stimuli, difficulty, values: values(runs, i) })
        .collect()
}

fn values(runs: &BTreeMap<u64, Vec<Champion>>, group: usize) -> Vec<f64> {
    let mean = |run: &Vec<Champion>| {
        let champions =
            run.iter().filter(|champion| champion.behavior.stimuli() == 2 && group_of(champion.behavior) == group);
        let distances: Vec<f64> = champions.map(|champion| champion.fitness[0]).collect();
        (!distances.is_empty()).then(|| distances.iter().sum::<f64>() / distances.len() as f64)
    };
    runs.values().filter_map(mean).collect()
}

pub fn compare_groups(groups: &[BehaviorGroup]) -> Vec<GroupComparison> {
    let pairs = (0..groups.len()).flat_map(|a| (a + 1..groups.len()).map(move |b| [a, b]));
    let mut comparisons: Vec<GroupComparison> = pairs.filter_map(|pair| compare(groups, pair)).collect();
    let p: Vec<f64> = comparisons.iter().map(|comparison| comparison.p).collect();
    let tests = comparisons.len() as f64;
    for (comparison, adjusted) in comparisons.iter_mut().zip(holm(&p)) {
        comparison.p_adjusted = adjusted;
        comparison.p_least = (comparison.p_least * tests).min(1.0);
    }
    comparisons
}

fn compare(groups: &[BehaviorGroup], pair: [usize; 2]) -> Option<GroupComparison> {
    let [a, b] = pair.map(|i| groups[i].values.as_slice());
    if a.is_empty() || b.is_empty() {
        return None;
    }
    let is_approximate = a.iter().any(|value| b.contains(value));
    let u = u(a, b);
    let p = if is_approximate { approximate_p(u, a, b) } else { exact_p(u, a.len(), b.len()) };
    let a12 = u / (a.len() * b.len()) as f64;
    let p_least = 2.0 / choices(a.len() + b.len(), a.len());
    Some(GroupComparison { groups: pair, p, p_adjusted: p, p_least, a12, is_approximate })
}

/// The number of pairs of which the first value is larger, ties counting half.
fn u(a: &[f64], b: &[f64]) -> f64 {
    let pairs = a.iter().flat_map(|one| b.iter().map(move |other| one.total_cmp(other)));
    pairs.map(|order| f64::from(order as i8 + 1) / 2.0).sum()
}

/// The two-sided probability of a U at least as far from its mean by the normal distribution, corrected for ties and
/// for continuity.
fn approximate_p(u: f64, a: &[f64], b: &[f64]) -> f64 {
    let (pairs, all) = ((a.len() * b.len()) as f64, (a.len() + b.len()) as f64);
    let mut values = [a, b].concat();
    values.sort_by(f64::total_cmp);
    let ties = values.chunk_by(|one, other| one == other).map(|equal| equal.len() as f64);
    let tied: f64 = ties.map(|equal| equal * equal * equal - equal).sum();
    let variance = pairs / 12.0 * (all + 1.0 - tied / (all * (all - 1.0)));
    // Equal values throughout have no variance, and do not differ.
    if variance <= 0.0 {
        return 1.0;
    }
    let distance = (u - pairs / 2.0).abs() - 0.5;
    libm::erfc(distance / (2.0 * variance).sqrt()).min(1.0)
}

/// The two-sided probability of a U at least as far from its mean, without ties. It counts the orders of `m + n`
/// values, all equally likely, that give each U: the largest value is from the first sample and exceeds all of the
/// second, or it is from the second.
fn exact_p(u: f64, m: usize, n: usize) -> f64 {
    let mut orders: Vec<Vec<Vec<f64>>> = vec![vec![Vec::new(); n + 1]; m + 1];
    for i in 0..=m {
        for j in 0..=n {
            let mut counts = vec![0.0; i * j + 1];
            if i == 0 || j == 0 {
                counts[0] = 1.0;
            } else {
                orders[i - 1][j].iter().enumerate().for_each(|(u, count)| counts[u + j] += count);
                orders[i][j - 1].iter().enumerate().for_each(|(u, count)| counts[u] += count);
            }
            orders[i][j] = counts;
        }
    }
    let farther = u.max((m * n) as f64 - u);
    let counts = &orders[m][n];
    let tail: f64 = counts.iter().enumerate().filter(|(u, _)| *u as f64 >= farther).map(|(_, count)| count).sum();
    (2.0 * tail / counts.iter().sum::<f64>()).min(1.0)
}

/// Holm's step-down adjustment, in the order given.
fn holm(p: &[f64]) -> Vec<f64> {
    let mut order: Vec<usize> = (0..p.len()).collect();
    order.sort_by(|&a, &b| p[a].total_cmp(&p[b]));
    let mut adjusted = vec![0.0; p.len()];
    let mut least: f64 = 0.0;
    for (rank, &i) in order.iter().enumerate() {
        least = least.max((p.len() - rank) as f64 * p[i]).min(1.0);
        adjusted[i] = least;
    }
    adjusted
}

fn choices(n: usize, k: usize) -> f64 {
    (0..k).map(|i| (n - i) as f64 / (i + 1) as f64).product()
}

pub(super) fn mark(p_adjusted: f64) -> &'static str {
    THRESHOLDS.iter().rfind(|threshold| p_adjusted < threshold.0).map_or("", |threshold| threshold.1)
}

pub(super) fn describe_method(comparisons: &[GroupComparison]) -> String {
    format!("exact two-sided Mann-Whitney U, adjusted by Holm for {} pairs", comparisons.len())
}

pub fn describe_groups(groups: &[BehaviorGroup], comparisons: &[GroupComparison]) -> String {
    use Align::{Left, Right};
    let mut table = TextTable::new(&[
        ("group", Left),
        ("runs", Right),
        ("mean distance", Right),
        ("least", Right),
        ("most", Right),
    ]);
    for BehaviorGroup { name, values, .. } in groups {
        let number = |value: f64| if values.is_empty() { "-".to_owned() } else { format!("{value:.2}") };
        let mean = values.iter().sum::<f64>() / values.len() as f64;
        let (least, most) = values.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, m), &v| (v.min(l), v.max(m)));
        table.push(vec![(*name).to_owned(), values.len().to_string(), number(mean), number(least), number(most)]);
    }
    let columns: Vec<(&str, Align)> =
        std::iter::once(("", Left)).chain(groups.iter().skip(1).map(|group| (group.name, Left))).collect();
    let mut pairs = TextTable::new(&columns);
    for (row, group) in groups.iter().enumerate().take(groups.len().saturating_sub(1)) {
        let cell = |column| match comparisons.iter().find(|pair| pair.groups == [row, column]) {
            Some(pair) => {
                let ties = if pair.is_approximate { "~" } else { "" };
                format!("{:.2}{}{ties}", pair.a12, mark(pair.p_adjusted))
            }
            None => String::new(),
        };
        pairs.push(std::iter::once(group.name.to_owned()).chain((1..groups.len()).map(cell)).collect());
    }
    let marks: Vec<String> = THRESHOLDS.iter().map(|(threshold, mark)| format!("{mark} p < {threshold}")).collect();
    let mut text = format!(
        "champions' distance in voxels, a value for each run\n{table}\n\
         A12: how often a value of the row's group exceeds one of the column's; {}\n\
         {}\n{pairs}",
        marks.join(", "),
        describe_method(comparisons)
    );
    if comparisons.iter().any(|pair| pair.is_approximate) {
        text.push_str("~ approximate, because there are ties\n");
    }
    let mut before = 0;
    for (threshold, _) in THRESHOLDS {
        let beyond = comparisons.iter().filter(|comparison| comparison.p_least > threshold).count();
        // A comparison that cannot reach one threshold cannot reach a lower one either.
        if beyond > before {
            // Writing to a string cannot fail.
            let _ = writeln!(
                text,
                "with so few runs {beyond} of {} comparisons cannot reach p < {threshold}, whatever the values",
                comparisons.len()
            );
        }
        before = beyond;
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    fn run(distances: &[(&str, f64)]) -> Vec<Champion> {
        let champion = |&(behavior, d): &(&str, f64)| Champion {
            behavior: behavior.parse().unwrap(),
            fitness: [d, 0.0],
            niches: 1,
        };
        distances.iter().map(champion).collect()
    }

    fn seeds(runs: impl IntoIterator<Item = Vec<Champion>>) -> BTreeMap<u64, Vec<Champion>> {
        (1..).zip(runs).collect()
    }

    #[test]
    fn behaviors_fall_into_the_papers_groups() {
        let counts = Behavior::all(2).fold([0; 8], |mut counts, behavior| {
            counts[group_of(behavior)] += 1;
            counts
        });
        assert_eq!(counts, [2; 8]);
        for behavior in Behavior::all(2) {
            let (function, (name, stimuli, difficulty)) = (behavior.function(), GROUPS[group_of(behavior)]);
            assert_eq!(function.arity(), stimuli, "{name}");
            let is_xor = stimuli == 2 && function.bits().count_ones() == 2;
            assert_eq!(difficulty, stimuli + usize::from(is_xor), "{name}");
        }
    }

    #[test]
    fn three_runs_per_group_reach_p_of_a_tenth_at_most() {
        let runs = seeds((0..3).map(|i| {
            run(&[("LLLL", 30.0 + f64::from(i)), ("LLRR", 20.0 + f64::from(i)), ("RRLL", 22.0 + f64::from(i))])
        }));
        let groups = behavior_groups(&runs);
        assert_eq!(groups[1].values, [21.0, 22.0, 23.0]);
        let comparisons = compare_groups(&groups);
        assert_eq!(comparisons.len(), 1);
        let comparison = &comparisons[0];
        assert!((comparison.p - 0.1).abs() < 1e-12 && (comparison.p_least - 0.1).abs() < 1e-12);
        assert_eq!((comparison.a12, comparison.is_approximate), (1.0, false));
        let told = describe_groups(&groups, &comparisons);
        assert!(
            told.contains("1 of 1 comparisons cannot reach p < 0.05") && !told.contains("reach p < 0.001"),
            "{told}"
        );
    }

    #[test]
    fn the_exact_test_counts_orders() {
        let check = |u, m, n, expected: f64| {
            let p = exact_p(u, m, n);
            assert!((p - expected).abs() < 1e-12, "U = {u} of {m} and {n}: {p}");
        };
        // Published critical values: U of 2 at 5 and 5 is p = 0.032, U of 23 at 10 and 10 is p = 0.043.
        check(2.0, 5, 5, 8.0 / 252.0);
        check(0.0, 3, 3, 0.1);
        check(9.0, 3, 3, 0.1);
        check(4.0, 3, 3, 1.0);
        check(0.0, 10, 10, 2.0 / 184_756.0);
        assert!((exact_p(23.0, 10, 10) - 0.0433).abs() < 5e-5);
    }

    #[test]
    fn ties_count_half_and_lessen_the_variance() {
        // `scipy.stats.mannwhitneyu(a, b, method="asymptotic")` gives the same.
        let check = |a: &[f64], b: &[f64], expected: [f64; 2]| {
            let u = u(a, b);
            let p = approximate_p(u, a, b);
            assert!(u == expected[0] && (p - expected[1]).abs() < 1e-12, "{a:?} {b:?}: {u} {p}");
        };
        check(&[1.0, 2.0, 2.0, 5.0], &[2.0, 3.0, 8.0, 9.0], [3.0, 0.183150203156622]);
        check(&[7.0, 8.0, 9.0], &[1.0, 7.0], [5.5, 0.23613697022165292]);
        check(&[2.0, 2.0], &[2.0, 2.0, 2.0], [3.0, 1.0]);
    }

    #[test]
    fn a_comparison_matches_the_textbook() {
        // The example of scipy.stats.mannwhitneyu: U = 17, exact p = 1/9, for both orders of the samples.
        let [males, females] = [vec![19.0, 22.0, 16.0, 29.0, 24.0], vec![20.0, 11.0, 17.0, 12.0]];
        let group = |values: &[f64]| BehaviorGroup { name: "", stimuli: 0, difficulty: 0, values: values.to_vec() };
        for (a, b, u) in [(&males, &females, 17.0), (&females, &males, 3.0)] {
            let found = compare(&[group(a), group(b)], [0, 1]).unwrap();
            assert!((found.p - 1.0 / 9.0).abs() < 1e-12 && (found.a12 - u / 20.0).abs() < 1e-12, "{found:?}");
        }
    }

    #[test]
    fn holm_adjusted_values_never_decrease() {
        let adjusted = holm(&[0.03, 0.01, 0.04]);
        let expected = [0.06, 0.03, 0.06];
        assert!(adjusted.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-12), "{adjusted:?}");
        assert_eq!(holm(&[0.9, 0.8]), [1.0, 1.0]);
    }

    #[test]
    fn ten_runs_per_group_reach_the_papers_threshold() {
        let runs = seeds((0..10).map(|i| {
            let shift = 0.01 * f64::from(i);
            run(&[("LLLL", 40.0 + shift), ("LLRR", 20.0 + shift), ("LRRR", 10.0 + shift), ("LRRL", 1.0 + shift)])
        }));
        let groups = behavior_groups(&runs);
        let comparisons = compare_groups(&groups);
        assert_eq!(comparisons.len(), 6);
        assert!(comparisons.iter().all(|comparison| comparison.p_adjusted < 0.001 && comparison.a12 == 1.0));
        let told = describe_groups(&groups, &comparisons);
        assert!(
            told.contains("XXXX  1.00***")
                && told.contains("adjusted by Holm for 6 pairs")
                && !told.contains("cannot reach"),
            "{told}"
        );
    }

    #[test]
    fn ties_are_reported() {
        let runs = [run(&[("LLLL", 2.0), ("LLRR", 2.0)]), run(&[("LLLL", 3.0), ("LLRR", 1.0)])];
        let groups = behavior_groups(&seeds(runs));
        let comparisons = compare_groups(&groups);
        assert!(comparisons[0].is_approximate);
        let told = describe_groups(&groups, &comparisons);
        assert!(told.contains("XXXX  0.88~") && told.contains("~ approximate"), "{told}");
    }
}
