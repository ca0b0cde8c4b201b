//! Symmetry: exchanging and inverting inputs by exchanging sensors, which is exact to the bit, and mirroring, which is
//! nearly so.

use crate::evolve::cppn::COLUMN;
use nbc_base::model::{
    Behavior, Body, Displacements, Function, Genotype, MaterialKind, NodeKind, Palette, Pattern, Response,
};

/// An exchange of sensor materials, which also exchanges or inverts the first two or three stimuli for a body.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Recoding {
    /// The stimulus that each one becomes.
    order: Vec<usize>,
    invert: Vec<bool>,
    /// The image of each code, code 0 first.
    codes: Vec<u8>,
}

/// The orders of two and of three stimuli, the identity first.
const PAIRS: [&[usize]; 2] = [&[0, 1], &[1, 0]];
const THREES: [&[usize]; 6] = [&[0, 1, 2], &[1, 0, 2], &[0, 2, 1], &[1, 2, 0], &[2, 0, 1], &[2, 1, 0]];

/// Those for which a palette has counterparts, at most eight of two stimuli and 48 of three, the identity first.
pub fn recodings(palette: &Palette) -> Vec<Recoding> {
    let stimuli = palette.inputs();
    let orders: &[&[usize]] = if stimuli == 2 { &PAIRS } else { &THREES };
    let mut found: Vec<Recoding> = Vec::new();
    for inverted in Pattern::all(stimuli) {
        // The first stimulus changes fastest.
        let invert: Vec<bool> = (0..stimuli).map(|i| inverted.has(stimuli - 1 - i)).collect();
        for &order in orders {
            let Some(codes) = recoded_palette(palette, order, &invert) else { continue };
            if !found.iter().any(|other| other.codes == codes) {
                found.push(Recoding { order: order.to_vec(), invert: invert.clone(), codes });
            }
        }
    }
    found
}

impl Recoding {
    pub fn is_identity(&self) -> bool {
        self.order.is_sorted() && !self.invert.contains(&true)
    }

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
        Pattern::of(self.order.iter().map(|&now| pattern.has(now) != self.invert[now]))
    }

    pub fn displacement(&self, displacement: &Displacements) -> Displacements {
        Displacements::under(self.order.len(), |pattern| displacement.at(self.before(pattern)))
    }

    pub fn behavior(&self, behavior: Behavior) -> Behavior {
        let stimuli = self.order.len();
        let right = |pattern: Pattern| behavior.function().under(self.before(pattern));
        let bits = Pattern::all(stimuli).enumerate().map(|(i, pattern)| u8::from(right(pattern)) << i).sum();
        Function::of(stimuli, bits).into()
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
fn recoded_palette(palette: &Palette, order: &[usize], invert: &[bool]) -> Option<Vec<u8>> {
    let recode = |response: Response| {
        let stimulus = order[response.stimulus];
        let (absent, present) =
            if invert[stimulus] { (response.present, response.absent) } else { (response.absent, response.present) };
        Response { stimulus, absent, present, ..response }
    };
    let sensor = |code: u8| match palette.kind(code) {
        Some(MaterialKind::Sensor(response)) if response.image.is_none() && response.stimulus < order.len() => {
            Some(response)
        }
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
    use nbc_base::model::{MutationWeights, Rules};

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
    fn recodings_of_three_stimuli_give_half_of_a_class_and_mirroring_the_rest() {
        let palette = Palette::three();
        let recodings = recodings(&palette);
        assert_eq!(recodings.len(), 48);
        assert!(recodings[0].is_identity() && recodings.iter().filter(|recoding| recoding.is_identity()).count() == 1);
        for function in [Function::MUX, Function::MAJ, Function::XOR3, Function::three(0x16)] {
            let images = recodings.iter().map(|recoding| recoding.behavior(function.into()).function());
            let mut class: Vec<Function> = images.flat_map(|image| [image, image.inverted()]).collect();
            class.sort_unstable();
            class.dedup();
            assert_eq!(class, function.class());
        }
    }

    #[test]
    fn recoded_voxels_react_as_before() {
        for palette in [Palette::paper(), Palette::three()] {
            check_voxels(&palette);
        }
    }

    fn check_voxels(palette: &Palette) {
        let width = |code: u8, pattern: Pattern| match palette.kind(code) {
            Some(MaterialKind::Sensor(r)) => Some(if pattern.has(r.stimulus) { r.present } else { r.absent }),
            _ => None,
        };
        for recoding in recodings(palette) {
            for code in 0..=palette.materials().len() as u8 {
                for pattern in Pattern::all(palette.inputs()) {
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
        for rules in [Rules::PAPER, Rules::CODE] {
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
