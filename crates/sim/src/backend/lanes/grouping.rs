//! The cheapest division of a flock into groups, which share batches. It does not affect results.

use std::cmp::Reverse;
use std::collections::BTreeMap;

use crate::backend::lanes::kernel::Kernel;
use crate::lattice::Lattice;

/// How many of the next groups each group exchanges robots with, so that large swarms are grouped quickly. Not tuned.
const NEIGHBORS: usize = 16;

/// How often all groups exchange robots at most. Not tuned.
const EXCHANGES: usize = 4;

#[derive(Clone, Copy, Debug)]
pub struct LaneRequest<'a> {
    pub lattice: &'a Lattice,
    /// The number of its body: equal bodies have one number.
    pub body: usize,
}

#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct LaneGrouping {
    pub groups: Vec<Vec<usize>>,
    /// The cost of a substep of all groups, in the unit of [`Kernel::cost`].
    pub cost: u64,
}

impl LaneGrouping {
    /// A good division into groups of at most `lanes` robots. A group costs what the union of its robots' voxels does.
    /// Sorted by box, large ones first, rare bodies before frequent ones, then by voxels: equal bodies stay together.
    /// Groups are the cheapest of consecutive robots; then near groups exchange robots where that makes them cheaper.
    pub fn of(robots: &[LaneRequest], kernel: Kernel, lanes: usize) -> Self {
        let mut counts: BTreeMap<usize, usize> = BTreeMap::new();
        for robot in robots {
            *counts.entry(robot.body).or_default() += 1;
        }
        let mut order: Vec<usize> = (0..robots.len()).collect();
        order.sort_by_key(|&i| {
            let LaneRequest { lattice, body } = robots[i];
            let ((columns, rows), voxels) = (lattice.size(), lattice.voxels().len());
            (Reverse(columns * rows), columns, counts[&body], Reverse(voxels), body, i)
        });
        let costs = Costs::new(robots, kernel);
        let mut groups = costs.divide(&order, lanes);
        for _ in 0..EXCHANGES {
            if !costs.exchange(&mut groups) {
                break;
            }
        }
        let mut groups: Vec<(u64, Vec<usize>)> =
            groups.into_iter().map(|group| (costs.of(group.iter().copied()), group)).collect();
        groups.sort_by_key(|(cost, _)| Reverse(*cost));
        Self { cost: groups.iter().map(|(cost, _)| cost).sum(), groups: groups.into_iter().map(|(_, g)| g).collect() }
    }
}

struct Costs {
    kernel: Kernel,
    bodies: Vec<usize>,
    voxels: Vec<Vec<u64>>,
}

impl Costs {
    fn new(robots: &[LaneRequest], kernel: Kernel) -> Self {
        let most = |side: fn((usize, usize)) -> usize| robots.iter().map(|robot| side(robot.lattice.size())).max();
        let (columns, rows) = (most(|size| size.0).unwrap_or(0), most(|size| size.1).unwrap_or(0));
        let bits = |robot: &LaneRequest| {
            let mut bits = vec![0u64; (columns * rows).div_ceil(64)];
            for voxel in robot.lattice.voxels() {
                let place = voxel.row * columns + voxel.column;
                bits[place / 64] |= 1 << (place % 64);
            }
            bits
        };
        let bodies = robots.iter().map(|robot| robot.body).collect();
        Self { kernel, bodies, voxels: robots.iter().map(bits).collect() }
    }

    fn of(&self, robots: impl ExactSizeIterator<Item = usize> + Clone) -> u64 {
        let words = self.voxels.first().map_or(0, Vec::len);
        let union = |word: usize| robots.clone().fold(0, |bits, robot| bits | self.voxels[robot][word]);
        let voxels: u32 = (0..words).map(|word| union(word).count_ones()).sum();
        let alike = robots.clone().zip(robots.clone().skip(1)).all(|(a, b)| self.bodies[a] == self.bodies[b]);
        u64::from(voxels) * self.kernel.cost(robots.len(), alike)
    }

    /// The cheapest division of a sequence of robots into groups, by dynamic programming over prefixes.
    fn divide(&self, robots: &[usize], lanes: usize) -> Vec<Vec<usize>> {
        let mut best: Vec<(u64, usize)> = vec![(0, 0)];
        for end in 1..=robots.len() {
            let starts = end.saturating_sub(lanes)..end;
            let found = starts.map(|start| (best[start].0 + self.of(robots[start..end].iter().copied()), start)).min();
            best.push(found.expect("a group has a robot at least"));
        }
        let (mut groups, mut end) = (Vec::new(), robots.len());
        while end > 0 {
            let start = best[end].1;
            groups.push(robots[start..end].to_vec());
            end = start;
        }
        groups
    }

    /// Exchanges robots of neighboring groups where both together become cheaper; returns whether it did.
    fn exchange(&self, groups: &mut [Vec<usize>]) -> bool {
        let mut costs: Vec<u64> = groups.iter().map(|group| self.of(group.iter().copied())).collect();
        let mut found = false;
        for one in 0..groups.len() {
            for other in one + 1..groups.len().min(one + 1 + NEIGHBORS) {
                found |= self.exchange_between(groups, &mut costs, [one, other]);
            }
        }
        found
    }

    fn exchange_between(&self, groups: &mut [Vec<usize>], costs: &mut [u64], [one, other]: [usize; 2]) -> bool {
        let with = |group: &[usize], place: usize, robot: usize| {
            self.of((0..group.len()).map(|i| if i == place { robot } else { group[i] }))
        };
        let mut found = false;
        for a in 0..groups[one].len() {
            for b in 0..groups[other].len() {
                let (robot, instead) = (groups[one][a], groups[other][b]);
                if self.bodies[robot] == self.bodies[instead] {
                    continue;
                }
                let now = [with(&groups[one], a, instead), with(&groups[other], b, robot)];
                if now[0] + now[1] < costs[one] + costs[other] {
                    (groups[one][a], groups[other][b]) = (instead, robot);
                    [costs[one], costs[other]] = now;
                    found = true;
                }
            }
        }
        found
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::InstructionSet;
    use crate::constants::Constants;
    use nbc_base::model::{Body, Palette};

    fn check(robots: &[(&Body, usize)], lanes: usize, expected: &[&[usize]]) {
        let lattices: Vec<Lattice> = robots.iter().map(|(body, _)| Lattice::new(body, &Constants::default())).collect();
        let requests = lattices.iter().zip(robots).map(|(lattice, &(_, body))| LaneRequest { lattice, body });
        let kernel = Kernel::of(InstructionSet::Avx512, 8);
        assert_eq!(LaneGrouping::of(&requests.collect::<Vec<_>>(), kernel, lanes).groups, expected);
    }

    #[test]
    fn equal_bodies_stay_together_and_the_large_robots_lanes_are_filled_with_the_others() {
        let (five, seven) = (Body::patchwork(5, 0), Body::patchwork(7, 0));
        let others = vec![(&seven, 1), (&seven, 2), (&seven, 3), (&five, 4), (&five, 5)];
        check(&[vec![(&five, 0); 8], others].concat(), 8, &[&[8, 9, 10, 11, 12], &[0, 1, 2, 3, 4, 5, 6, 7]]);
        // A giant is alone, and no group has more robots than lanes.
        let twenty = Body::patchwork(20, 0);
        check(&[vec![(&five, 0); 4], vec![(&twenty, 1)]].concat(), 8, &[&[4], &[0, 1, 2, 3]]);
        check(&[(&five, 0); 5], 2, &[&[3, 4], &[1, 2], &[0]]);
        check(&[], 8, &[]);
    }

    #[test]
    fn bodies_of_one_shape_share_a_group() {
        let [left, right] =
            [["3000", "3000", "3333"], ["0003", "0003", "3333"]].map(|rows| Body::parse(&rows, &Palette::paper()));
        let (left, right) = (left.unwrap(), right.unwrap());
        let robots = [(&left, 0), (&right, 1), (&left, 2), (&right, 3), (&right, 4), (&left, 5)];
        check(&robots, 3, &[&[3, 4, 1], &[0, 5, 2]]);
    }
}
