//! The paper's comparison of behaviors (paper, section 3 and figure 5): groups of equal difficulty, the exact
//! Mann-Whitney U test between each two, Holm's correction, and the effect size A12.

use std::collections::BTreeMap;
use std::fmt::Write;

use serde::Serialize;
use statrs::stats_tests::Alternative;
use statrs::stats_tests::mannwhitneyu::{MannWhitneyUMethod, mannwhitneyu};

use crate::evolve::Champion;
use crate::model::{Behavior, Pattern};
use crate::report::{Align, TextTable};

/// The thresholds of significance that are spoken of; the paper's is the last.
const THRESHOLDS: [f64; 2] = [0.05, 0.001];

/// The behaviors of one difficulty, which differ by exchanging left and right.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct BehaviorGroup {
    /// Such as `XXYY, XYXY`.
    pub name: &'static str,
    /// The number of stimuli that its robots depend on.
    pub stimuli: usize,
    /// For each run that found any, the mean distance in voxels of its champions, one for each behavior found.
    pub values: Vec<f64>,
}

/// Two groups compared.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct GroupComparison {
    /// The groups, by their places.
    pub groups: [usize; 2],
    /// The probability, by the exact two-sided test, that values this far apart come from the same distribution.
    pub p: f64,
    /// The same after Holm's correction for all pairs.
    pub p_adjusted: f64,
    /// The smallest adjusted value that is possible with so few runs.
    pub p_least: f64,
    /// The probability that a value of the first group exceeds one of the second, ties counting half.
    pub a12: f64,
    /// Whether ties made the exact test impossible, so that its normal approximation was used.
    pub is_approximate: bool,
}

/// The robots that follow one stimulus, compared by which one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SideComparison {
    /// The probability as in [`GroupComparison`], of one test alone.
    pub p: f64,
    /// How often a robot of the first stimulus goes farther than one of the second, likewise.
    pub a12: f64,
}

/// Groups and their names, in the paper's order of difficulty.
const GROUPS: [(&str, usize); 4] = [("XXXX", 0), ("XXYY, XYXY", 1), ("XXXY, XXYX, XYXX, XYYY", 2), ("XYYX", 2)];

/// The place of the group of a behavior.
pub(super) fn group_of(behavior: Behavior) -> usize {
    let function = behavior.function();
    match (function.arity(), function.bits().count_ones()) {
        (0, _) => 0,
        (1, _) => 1,
        (_, 2) => 3,
        _ => 2,
    }
}

/// The groups' values, one for each run. Champions of one run are not independent samples, and neither are two runs
/// with the same seed, so runs are grouped by seed.
pub fn behavior_groups(runs: &BTreeMap<u64, Vec<Champion>>) -> Vec<BehaviorGroup> {
    let groups = GROUPS.iter().enumerate();
    groups
        .map(|(i, &(name, stimuli))| BehaviorGroup {
            name,
            stimuli,
            values: values(runs, |behavior| group_of(behavior) == i),
        })
        .collect()
}

/// For each run that found any of these behaviors, the mean distance of their champions in voxels.
fn values(runs: &BTreeMap<u64, Vec<Champion>>, is_member: impl Fn(Behavior) -> bool) -> Vec<f64> {
    let mean = |run: &Vec<Champion>| {
        let champions = run.iter().filter(|champion| is_member(champion.behavior));
        let distances: Vec<f64> = champions.map(|champion| champion.fitness[0]).collect();
        (!distances.is_empty()).then(|| distances.iter().sum::<f64>() / distances.len() as f64)
    };
    runs.values().filter_map(mean).collect()
}

/// Compares XXYY with XYXY; `None` if one of them was never found.
pub fn compare_sides(runs: &BTreeMap<u64, Vec<Champion>>) -> Option<SideComparison> {
    let follows = |stimulus: usize| {
        let changes = move |behavior: Behavior| {
            let at = |i: usize| behavior.direction(Pattern::PAIRS[i]);
            // The patterns 01 and 10 differ from 00 in the second and in the first stimulus.
            at(0) != at([2, 1][stimulus]) && at(0) == at([1, 2][stimulus])
        };
        let is_member = move |behavior: Behavior| group_of(behavior) == 1 && changes(behavior);
        BehaviorGroup { name: ["XXYY", "XYXY"][stimulus], stimuli: 1, values: values(runs, is_member) }
    };
    let GroupComparison { p, a12, .. } = compare(&[follows(0), follows(1)], [0, 1])?;
    Some(SideComparison { p, a12 })
}

/// Every two groups compared, in order; pairs without values are left out.
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
    let approximate = MannWhitneyUMethod::AsymptoticInclContinuityCorrection;
    let (u, p) = mannwhitneyu(a, b, approximate, Alternative::TwoSided).ok()?;
    let is_approximate = a.iter().any(|value| b.contains(value));
    // Equal values throughout have no variance, and differ as little as can be.
    let p = if !is_approximate {
        exact_p(u, a.len(), b.len())
    } else if p.is_nan() {
        1.0
    } else {
        p
    };
    let a12 = u / (a.len() * b.len()) as f64;
    let p_least = 2.0 / choices(a.len() + b.len(), a.len());
    Some(GroupComparison { groups: pair, p, p_adjusted: p, p_least, a12, is_approximate })
}

/// The two-sided probability of a U at least as far from its mean, without ties. (`statrs` 0.19 is correct only if the
/// first sample is the larger; otherwise it returns the complement.) It counts the orders of `m + n` values, all
/// equally likely, that give each U: the largest value is from the first sample and exceeds all of the second, or it is
/// from the second.
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

/// The number of ways to choose `k` of `n`.
fn choices(n: usize, k: usize) -> f64 {
    (0..k).map(|i| (n - i) as f64 / (i + 1) as f64).product()
}

/// The groups and their comparisons in words.
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
    let mut pairs = TextTable::new(&[("compared", Left), ("p", Right), ("Holm", Right), ("A12", Right), ("", Left)]);
    for comparison in comparisons {
        let [a, b] = comparison.groups.map(|i| groups[i].name.split(',').next().unwrap_or_default());
        let note = if comparison.is_approximate { "approximate: there are ties" } else { "" };
        let [p, adjusted] = [comparison.p, comparison.p_adjusted].map(probability);
        pairs.push(vec![format!("{a} > {b}"), p, adjusted, format!("{:.2}", comparison.a12), note.to_owned()]);
    }
    let mut text = format!(
        "champions' distance in voxels, a value for each run\n{table}\nexact Mann-Whitney U, two-sided, Holm-adjusted; \
         A12: how often a value of the first group exceeds one of the second\n{pairs}"
    );
    let mut told = 0;
    for threshold in THRESHOLDS {
        let beyond = comparisons.iter().filter(|comparison| comparison.p_least > threshold).count();
        // A comparison that cannot reach one threshold cannot reach a lower one either.
        if beyond > told {
            // Writing to a string cannot fail.
            let _ = writeln!(
                text,
                "with so few runs {beyond} of {} comparisons cannot reach p < {threshold}, whatever the values",
                comparisons.len()
            );
        }
        told = beyond;
    }
    text
}

/// A probability with three digits that matter.
fn probability(p: f64) -> String {
    if p < 0.001 { format!("{p:.2e}") } else { format!("{p:.3}") }
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

    /// Runs of the seeds 1, 2, …
    fn seeds(runs: impl IntoIterator<Item = Vec<Champion>>) -> BTreeMap<u64, Vec<Champion>> {
        (1..).zip(runs).collect()
    }

    #[test]
    fn behaviors_fall_into_the_papers_groups() {
        let counts = Behavior::all().fold([0; 4], |mut counts, behavior| {
            counts[group_of(behavior)] += 1;
            counts
        });
        assert_eq!(counts, [2, 4, 8, 2]);
        assert_eq!(group_of("LRRL".parse().unwrap()), 3);
        assert_eq!(group_of("RLRL".parse().unwrap()), 1);
        assert_eq!(group_of("LRRR".parse().unwrap()), 2);
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
        assert!(told.contains("1 of 1 comparisons cannot reach p < 0.05") && !told.contains("p < 0.001"), "{told}");
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
        for larger in [[1.0, 2.0, 5.0, 7.0], [1.0, 2.0, 3.5, 4.0], [2.0, 8.5, 9.5, 7.0]] {
            let (u, p) =
                mannwhitneyu(&larger, &[3.0, 8.0, 9.0], MannWhitneyUMethod::Exact, Alternative::TwoSided).unwrap();
            check(u, 4, 3, p);
        }
    }

    #[test]
    fn a_comparison_matches_the_textbook() {
        // The example of scipy.stats.mannwhitneyu: U = 17, exact p = 1/9, for both orders of the samples.
        let [males, females] = [vec![19.0, 22.0, 16.0, 29.0, 24.0], vec![20.0, 11.0, 17.0, 12.0]];
        let group = |values: &[f64]| BehaviorGroup { name: "", stimuli: 0, values: values.to_vec() };
        for (a, b, u) in [(&males, &females, 17.0), (&females, &males, 3.0)] {
            let found = compare(&[group(a), group(b)], [0, 1]).unwrap();
            assert!((found.p - 1.0 / 9.0).abs() < 1e-12 && (found.a12 - u / 20.0).abs() < 1e-12, "{found:?}");
        }
    }

    #[test]
    fn one_stimulus_is_compared_with_the_other() {
        let runs = seeds((0..4).map(|i| {
            let shift = 0.1 * f64::from(i);
            run(&[("LLRR", 10.0 + shift), ("RRLL", 12.0 + shift), ("LRLR", 8.0 + shift), ("LLLL", 90.0)])
        }));
        let sides = compare_sides(&runs).unwrap();
        assert!((sides.p - 2.0 / 70.0).abs() < 1e-12 && sides.a12 == 1.0, "{sides:?}");
        assert_eq!(compare_sides(&seeds([run(&[("LLRR", 1.0)])])), None);
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
        assert!(told.contains("1.08e-5  6.50e-5  1.00") && !told.contains("cannot reach"), "{told}");
    }

    #[test]
    fn ties_are_reported() {
        let runs = [run(&[("LLLL", 2.0), ("LLRR", 2.0)]), run(&[("LLLL", 3.0), ("LLRR", 1.0)])];
        let groups = behavior_groups(&seeds(runs));
        let comparisons = compare_groups(&groups);
        assert!(comparisons[0].is_approximate);
        assert!(describe_groups(&groups, &comparisons).contains("approximate"));
    }
}
