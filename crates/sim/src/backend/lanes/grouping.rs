//! The cheapest division of a flock into groups, which share batches. It does not affect results.

use std::cmp::Reverse;
use std::collections::BTreeMap;
use std::ops::Range;

use crate::backend::lanes::kernel::Kernel;

/// A robot that needs a lane.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LaneRequest {
    /// Columns and rows of its box.
    pub size: (usize, usize),
    /// The number of its body: equal bodies have one number.
    pub body: usize,
}

/// A division of a flock.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct LaneGrouping {
    /// The robots of each group, the most costly group first.
    pub groups: Vec<Vec<usize>>,
    /// The cost of a substep of all groups, in the unit of [`Kernel::cost`].
    pub cost: u64,
}

impl LaneGrouping {
    /// The best division into groups of at most `lanes` robots.
    ///
    /// Robots are sorted by box, large ones first, and within a box rare bodies before frequent ones; groups are
    /// consecutive robots. So lanes next to large robots go to unique bodies, and equal bodies stay together, which is
    /// faster.
    pub fn of(robots: &[LaneRequest], kernel: Kernel, lanes: usize) -> Self {
        let mut counts: BTreeMap<usize, usize> = BTreeMap::new();
        for robot in robots {
            *counts.entry(robot.body).or_default() += 1;
        }
        let mut order: Vec<usize> = (0..robots.len()).collect();
        order.sort_by_key(|&i| {
            let LaneRequest { size: (columns, rows), body } = robots[i];
            (Reverse(columns * rows), columns, counts[&body], body, i)
        });
        let ordered: Vec<LaneRequest> = order.iter().map(|&i| robots[i]).collect();
        let (cuts, cost) = divide(&ordered, kernel, lanes);
        let mut groups: Vec<(u64, Vec<usize>)> =
            cuts.into_iter().map(|group| (cost_of(&ordered[group.clone()], kernel), order[group].to_vec())).collect();
        groups.sort_by_key(|(cost, _)| Reverse(*cost));
        Self { groups: groups.into_iter().map(|(_, group)| group).collect(), cost }
    }
}

/// The cheapest division of a sequence of robots into groups, and its cost, by dynamic programming over prefixes.
fn divide(robots: &[LaneRequest], kernel: Kernel, lanes: usize) -> (Vec<Range<usize>>, u64) {
    let mut best: Vec<(u64, usize)> = vec![(0, 0)];
    for end in 1..=robots.len() {
        let groups = end.saturating_sub(lanes)..end;
        let found = groups.map(|start| (best[start].0 + cost_of(&robots[start..end], kernel), start)).min();
        best.push(found.expect("a group has a robot at least"));
    }
    let (mut cuts, mut end) = (Vec::new(), robots.len());
    while end > 0 {
        let start = best[end].1;
        cuts.push(start..end);
        end = start;
    }
    (cuts, best[robots.len()].0)
}

/// The cost of a substep of these robots in one batch.
fn cost_of(robots: &[LaneRequest], kernel: Kernel) -> u64 {
    let most = |side: fn(&LaneRequest) -> usize| robots.iter().map(side).max().unwrap_or(0) as u64;
    let alike = robots.windows(2).all(|pair| pair[0].body == pair[1].body);
    most(|robot| robot.size.0) * most(|robot| robot.size.1) * kernel.cost(robots.len(), alike)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::InstructionSet;

    fn check(robots: &[(usize, usize)], lanes: usize, expected: &[&[usize]]) {
        let robots: Vec<LaneRequest> =
            robots.iter().map(|&(side, body)| LaneRequest { size: (side, side), body }).collect();
        let kernel = Kernel::of(InstructionSet::Avx512, 8);
        assert_eq!(LaneGrouping::of(&robots, kernel, lanes).groups, expected);
    }

    #[test]
    fn equal_bodies_stay_together_and_the_large_robots_lanes_are_filled_with_the_others() {
        let robots = [vec![(5, 0); 8], vec![(7, 1), (7, 2), (7, 3), (5, 4), (5, 5)]].concat();
        check(&robots, 8, &[&[8, 9, 10, 11, 12], &[0, 1, 2, 3, 4, 5, 6, 7]]);
    }

    #[test]
    fn a_giant_is_alone() {
        check(&[vec![(5, 0); 4], vec![(20, 1)]].concat(), 8, &[&[4], &[0, 1, 2, 3]]);
    }

    #[test]
    fn no_group_has_more_robots_than_lanes() {
        check(&[(5, 0); 5], 2, &[&[3, 4], &[1, 2], &[0]]);
        check(&[], 8, &[]);
    }
}
