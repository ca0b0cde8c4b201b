//! Symmetry: exchanging and inverting inputs by exchanging sensors, which is exact to the bit, and mirroring, which is
//! nearly so.

use crate::evolve::cppn::COLUMN;
use nbc_base::model::{Behavior, Body, Genotype, MaterialKind, NodeKind, Palette, Pattern, Response};

/// An exchange of sensor materials, which also exchanges or inverts stimuli 1 and 2 for a body.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Recoding {
    swap: bool,
    invert: [bool; 2],
    /// The image of each code, code 0 first.
    codes: Vec<u8>,
}

/// The recodings for which a palette has counterpart materials, at most eight, the identity first.
pub fn recodings(palette: &Palette) -> Vec<Recoding> {
    let mut found: Vec<Recoding> = Vec::new();
    for bits in 0..8u8 {
        let (swap, invert) = (bits & 1 > 0, [bits & 2 > 0, bits & 4 > 0]);
        let Some(codes) = recoded_palette(palette, swap, invert) else { continue };
        if !found.iter().any(|other| other.codes == codes) {
            found.push(Recoding { swap, invert, codes });
        }
    }
    found
}

impl Recoding {
    /// Whether it is the identity.
    pub fn is_identity(&self) -> bool {
        !self.swap && self.invert == [false; 2]
    }

    /// The body with its sensors exchanged.
    pub fn body(&self, body: &Body) -> Body {
        body.recoded(|code| self.codes[usize::from(code)])
    }

    /// The network that develops into the recoded body. Outputs keep their order, which decides between equal scores.
    pub fn genotype(&self, genotype: &Genotype) -> Genotype {
        let recode = |kind| match kind {
            NodeKind::Output(code, activation) => NodeKind::Output(self.codes[usize::from(code)], activation),
            other => other,
        };
        let nodes = genotype.nodes.iter().map(|&(id, kind)| (id, recode(kind))).collect();
        Genotype { nodes, links: genotype.links.clone() }
    }

    /// The pattern under which the original body moved as the recoded body does under `pattern`.
    pub fn before(&self, pattern: Pattern) -> Pattern {
        let was = |stimulus: usize| {
            let now = if self.swap { 1 - stimulus } else { stimulus };
            pattern.has(now) != self.invert[now]
        };
        Pattern::new(&[was(0), was(1)])
    }

    /// The displacements of the recoded body from those of the original, for patterns 00, 01, 10, 11.
    pub fn displacement(&self, displacement: &[f64; 4]) -> [f64; 4] {
        Pattern::PAIRS.map(|pattern| displacement[self.before(pattern).pair_index()])
    }

    /// The recoded body's behavior.
    pub fn behavior(&self, behavior: Behavior) -> Behavior {
        let right = |pattern: Pattern| f64::from(behavior.function().output(pattern.has(0), pattern.has(1)));
        Behavior::of(&self.displacement(&Pattern::PAIRS.map(right)))
    }
}

/// The network that develops into the mirror image: the column's coordinate changes its sign.
pub fn mirrored(genotype: &Genotype) -> Genotype {
    let is_column = |&(_, kind): &_| kind == NodeKind::Input(COLUMN);
    let column = genotype.nodes.iter().find(|node| is_column(node)).map(|(id, _)| *id);
    let mut mirror = genotype.clone();
    for link in mirror.links.iter_mut().filter(|link| Some(link.source) == column) {
        link.weight = -link.weight;
    }
    mirror
}

/// The image of each code; `None` if a sensor has no counterpart. Equal sensors are paired in order.
fn recoded_palette(palette: &Palette, swap: bool, invert: [bool; 2]) -> Option<Vec<u8>> {
    let recode = |response: Response| {
        let stimulus = if swap { 1 - response.stimulus } else { response.stimulus };
        let (absent, present) =
            if invert[stimulus] { (response.present, response.absent) } else { (response.absent, response.present) };
        Response { stimulus, absent, present }
    };
    let sensor = |code: u8| match palette.kind(code) {
        Some(MaterialKind::Sensor(response)) if response.stimulus < 2 => Some(response),
        _ => None,
    };
    let alike = |response| (1..=palette.materials().len() as u8).filter(move |&code| sensor(code) == Some(response));
    let image = |code: u8| match sensor(code) {
        None => Some(code),
        Some(response) => {
            let place = alike(response).position(|other| other == code)?;
            alike(recode(response)).nth(place)
        }
    };
    let codes: Vec<u8> = (0..=palette.materials().len() as u8).map(image).collect::<Option<_>>()?;
    let mut sorted = codes.clone();
    sorted.sort_unstable();
    sorted.dedup();
    (sorted.len() == codes.len()).then_some(codes)
}

#[cfg(test)]
mod tests {
    use rand::SeedableRng;
    use rand_chacha::ChaCha8Rng;

    use super::*;
    use crate::evolve::{cppn, mutate, phenotype};
    use nbc_base::model::{Function, MutationWeights, Rules};

    fn network(rules: Rules, seed: u64) -> Genotype {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        let mut genotype = cppn::start(8, rules);
        for _ in 0..80 {
            mutate(&mut genotype, &MutationWeights::default(), rules, &mut rng);
        }
        genotype
    }

    #[test]
    fn the_papers_palette_has_eight_recodings_and_a_smaller_one_fewer() {
        assert_eq!(recodings(&Palette::paper()).len(), 8);
        let without_one = Palette::new(Palette::paper().materials()[..7].to_vec());
        assert_eq!(recodings(&without_one).len(), 2);
        let passive = Palette::new(Palette::paper().materials()[..4].to_vec());
        assert_eq!(recodings(&passive).len(), 1);
    }

    #[test]
    fn recodings_of_a_nand_give_half_of_its_npn_class() {
        let nand = Behavior::from(Function::NAND);
        let found: Vec<String> = recodings(&Palette::paper()).iter().map(|r| r.behavior(nand).to_string()).collect();
        let mut distinct = found.clone();
        distinct.sort();
        distinct.dedup();
        assert_eq!(distinct, ["LRRR", "RLRR", "RRLR", "RRRL"], "four by recoding, the other four by mirroring");
    }

    #[test]
    fn recoded_voxels_react_as_before() {
        let palette = Palette::paper();
        let width = |code: u8, pattern: Pattern| match palette.kind(code) {
            Some(MaterialKind::Sensor(r)) => Some(if pattern.has(r.stimulus) { r.present } else { r.absent }),
            _ => None,
        };
        for recoding in recodings(&palette) {
            for code in 0..=8 {
                for pattern in Pattern::PAIRS {
                    assert_eq!(
                        width(recoding.codes[usize::from(code)], pattern),
                        width(code, recoding.before(pattern))
                    );
                }
            }
        }
    }

    #[test]
    fn images_of_networks_develop_into_images_of_bodies() {
        for rules in [Rules::Paper, Rules::Code] {
            for seed in 0..60 {
                let genotype = network(rules, seed);
                let body = phenotype(&genotype, &Palette::paper(), rules, 7, 5);
                for recoding in recodings(&Palette::paper()) {
                    let image = phenotype(&recoding.genotype(&genotype), &Palette::paper(), rules, 7, 5);
                    assert_eq!(image, recoding.body(&body));
                }
                assert_eq!(phenotype(&mirrored(&genotype), &Palette::paper(), rules, 7, 5), body.mirrored());
            }
        }
    }
}
