//! The elites that a body must beat to enter an archive, as plain data.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use nbc_base::model::{Behavior, Direction, Niche};

/// The fitnesses of the elites that a body must beat, by its behavior: all that an evaluation needs of an archive.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "Written", into = "Written")]
pub struct Rivals {
    niche: Niche,
    /// For each behavior, in order of the functions' bits, the niches that it leads to; none if one of them is empty.
    behaviors: Vec<Vec<Vec<[f64; 2]>>>,
}

/// Each set of fitnesses once, because many behaviors lead to the same niches, and its places for each behavior.
#[derive(Serialize, Deserialize)]
struct Written {
    niche: Niche,
    fronts: Vec<Vec<[f64; 2]>>,
    behaviors: Vec<Vec<usize>>,
}

impl From<Rivals> for Written {
    fn from(Rivals { niche, behaviors }: Rivals) -> Self {
        let mut fronts: Vec<Vec<[f64; 2]>> = Vec::new();
        let mut places: BTreeMap<Vec<[u64; 2]>, usize> = BTreeMap::new();
        let mut place = |front: Vec<[f64; 2]>| {
            *places.entry(front.iter().map(|two| two.map(f64::to_bits)).collect()).or_insert_with(|| {
                fronts.push(front);
                fronts.len() - 1
            })
        };
        let behaviors = behaviors.into_iter().map(|niches| niches.into_iter().map(&mut place).collect()).collect();
        Self { niche, fronts, behaviors }
    }
}

impl TryFrom<Written> for Rivals {
    type Error = &'static str;

    fn try_from(Written { niche, fronts, behaviors }: Written) -> Result<Self, Self::Error> {
        if !matches!(behaviors.len(), 16 | 256) {
            return Err("each behavior has an entry");
        }
        let niches = |places: Vec<usize>| places.into_iter().map(|place| fronts.get(place).cloned()).collect();
        let behaviors: Option<_> = behaviors.into_iter().map(niches).collect();
        Ok(Self::new(niche, behaviors.ok_or("a niche that is not there")?))
    }
}

impl Rivals {
    pub fn new(niche: Niche, behaviors: Vec<Vec<Vec<[f64; 2]>>>) -> Self {
        assert!(matches!(behaviors.len(), 16 | 256), "each behavior has an entry");
        let is_open = |niches: &Vec<Vec<[f64; 2]>>| niches.iter().any(Vec::is_empty);
        let behaviors = behaviors.into_iter().map(|niches| if is_open(&niches) { Vec::new() } else { niches });
        Self { niche, behaviors: behaviors.collect() }
    }

    pub fn none(inputs: usize) -> Self {
        Self::new(Niche::default(), Behavior::all(inputs).map(|_| Vec::new()).collect())
    }

    pub fn behaviors(&self) -> &[Vec<Vec<[f64; 2]>>] {
        &self.behaviors
    }

    /// Whether a body with that behavior and fitnesses of at most `bound` could enter the archive.
    pub fn admit(&self, behavior: Behavior, bound: &[f64; 2]) -> bool {
        let niches = &self.behaviors[usize::from(behavior.function().bits())];
        niches.is_empty() || niches.iter().any(|rivals| has_room(self.niche, rivals, bound))
    }

    /// Whether a body with these displacements, an entry for each pattern, could enter whatever the others are. If not,
    /// then neither with more of them known: its second fitness, the smallest distance, can only decrease.
    pub fn admit_any(&self, known: &[Option<f64>]) -> bool {
        let least = known.iter().flatten().map(|d| d.abs()).fold(f64::INFINITY, f64::min);
        let may_show = |behavior: Behavior| {
            let mut each = behavior.patterns().zip(known);
            each.all(|(pattern, known)| known.is_none_or(|d| Direction::of(d) == behavior.direction(pattern)))
        };
        Behavior::all(known.len().ilog2() as usize)
            .any(|behavior| may_show(behavior) && self.admit(behavior, &[f64::INFINITY, least]))
    }
}

fn has_room(niche: Niche, rivals: &[[f64; 2]], bound: &[f64; 2]) -> bool {
    match niche {
        Niche::Dominance => rivals.iter().all(|there| exceeds(bound, there)),
        Niche::Pareto(_) => !rivals.iter().any(|there| reaches(there, bound)),
    }
}

pub(super) fn exceeds(a: &[f64; 2], b: &[f64; 2]) -> bool {
    a[0] > b[0] && a[1] > b[1]
}

pub(super) fn reaches(a: &[f64; 2], b: &[f64; 2]) -> bool {
    a[0] >= b[0] && a[1] >= b[1]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rivals(niche: Niche, niches: &[&[[f64; 2]]]) -> Rivals {
        let niches: Vec<Vec<[f64; 2]>> = niches.iter().map(|elites| elites.to_vec()).collect();
        Rivals::new(niche, Behavior::all(2).map(|_| niches.clone()).collect())
    }

    #[test]
    fn a_body_enters_where_one_of_its_niches_has_room() {
        let nand: Behavior = "RRRL".parse().unwrap();
        let one = rivals(Niche::Dominance, &[&[[1.0, 1.0]]]);
        assert!(one.admit(nand, &[2.0, 2.0]) && !one.admit(nand, &[2.0, 1.0]));
        let two = rivals(Niche::Dominance, &[&[[1.0, 1.0]], &[[0.5, 0.5]]]);
        assert!(two.admit(nand, &[0.6, 0.6]) && !two.admit(nand, &[0.5, 0.6]));
        assert!(rivals(Niche::Dominance, &[&[[1.0, 1.0]], &[]]).admit(nand, &[0.0, 0.0]));
        assert!(Rivals::none(2).admit(nand, &[0.0, 0.0]));
        let front = rivals(Niche::Pareto(3), &[&[[1.0, 0.0], [0.0, 1.0]]]);
        assert!(front.admit(nand, &[0.5, 0.5]) && !front.admit(nand, &[1.0, 0.0]));
    }

    #[test]
    fn a_body_is_admitted_as_long_as_a_behavior_that_it_may_show_has_room() {
        // Right under 00 leads to niches with elites of 2, left to those of 5; LLLL is open.
        let elite = |behavior: Behavior| match behavior.to_string().as_str() {
            "LLLL" => Vec::new(),
            word if word.starts_with('R') => vec![vec![[9.0, 2.0]]],
            _ => vec![vec![[9.0, 5.0]]],
        };
        let rivals = Rivals::new(Niche::Dominance, Behavior::all(2).map(elite).collect());
        let check = |known: [Option<f64>; 4], expected| assert_eq!(rivals.admit_any(&known), expected, "{known:?}");
        check([None; 4], true);
        check([Some(2.0), None, None, None], false);
        check([Some(2.1), None, None, None], true);
        check([Some(2.1), None, Some(-1.9), None], false);
        check([Some(-0.1), None, None, None], true);
        check([Some(-0.1), None, None, Some(4.0)], false);
        check([None, None, None, Some(1.0)], false);
        check([Some(-9.0), Some(-9.0), Some(-9.0), Some(5.1)], true);
        check([Some(-0.0), Some(0.0), Some(-9.0), Some(-9.0)], true);
    }
}
