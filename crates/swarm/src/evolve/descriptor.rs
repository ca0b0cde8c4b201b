//! Descriptors: the niche of a body in the archive (paper, Methods; docs/physics.md 11).

use serde::{Deserialize, Serialize};

use nbc_base::model::{Axis, Behavior, Body, Count, Evolution, Function, MaterialKind, Matter, Rules};

/// The bin on each axis, from 0; of behaviors the bits of the function, of classes those of the first of the class.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub struct NicheKey(pub Vec<u16>);

#[derive(Clone, Debug, PartialEq)]
pub struct Descriptor {
    axes: Vec<Axis>,
    area: usize,
    rules: Rules,
    inputs: usize,
    /// The class of each behavior, in order of the functions' bits: the lowest bits of its functions.
    classes: Vec<u8>,
}

impl Descriptor {
    pub fn new(evolution: &Evolution) -> Self {
        Self {
            axes: evolution.descriptors.clone(),
            area: evolution.width * evolution.height,
            rules: evolution.rules,
            inputs: evolution.palette.inputs(),
            classes: Function::all_of(evolution.palette.inputs()).map(|one| one.class()[0].bits()).collect(),
        }
    }

    /// The number of niches; some can never be filled, such as all voxels active and all sensory.
    pub fn niches(&self) -> usize {
        self.axes.iter().map(|axis| axis.bins(self.inputs)).product()
    }

    pub(super) fn inputs(&self) -> usize {
        self.inputs
    }

    pub fn niche(&self, body: &Body, behavior: Behavior) -> NicheKey {
        let bin = |axis: &Axis| match *axis {
            Axis::Count { of, bins } => self.bin(self.count(body, of), bins),
            Axis::Behavior => u16::from(behavior.function().bits()),
            Axis::Class => u16::from(self.classes[usize::from(behavior.function().bits())]),
        };
        NicheKey(self.axes.iter().map(bin).collect())
    }

    /// Bins are whole numbers of voxels wide, `area / bins` rounded down; the last takes the rest.
    fn bin(&self, count: usize, bins: usize) -> u16 {
        let width = (self.area / bins.max(1)).max(1);
        (count / width).min(bins.saturating_sub(1)) as u16
    }

    fn count(&self, body: &Body, of: Count) -> usize {
        body.codes().iter().filter(|&&code| code > 0 && self.counts(body.palette().kind(code), code, of)).count()
    }

    fn counts(&self, kind: Option<MaterialKind>, code: u8, of: Count) -> bool {
        match (of, kind) {
            (Count::Voxels, kind) => kind.is_some(),
            (Count::Active, kind) => matches!(kind, Some(MaterialKind::Actuator(_))),
            // The authors' code counts codes 5 and 6 alone (docs/physics.md 11).
            (Count::Sensory, kind) => {
                let is_counted = !self.rules.follow_code(Matter::Sensors) || matches!(code, 5 | 6);
                matches!(kind, Some(MaterialKind::Sensor(_))) && is_counted
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::evolve::search::tests::evolution;
    use nbc_base::model::Palette;

    fn check(rules: Rules, rows: &[&str], expected: [u16; 4]) {
        let descriptor = Descriptor::new(&Evolution { rules, ..evolution() });
        let body = Body::parse(rows, &Palette::paper()).unwrap();
        assert_eq!(descriptor.niche(&body, "RRRL".parse().unwrap()).0, expected);
    }

    #[test]
    fn counts_fall_into_bins_of_a_quarter_of_the_box() {
        check(Rules::PAPER, &["33333", "55555", "00000", "00000", "00000"], [1, 0, 0, 7]);
        check(Rules::PAPER, &["33333", "35555", "51000", "00000", "00000"], [2, 1, 0, 7]);
        check(Rules::PAPER, &["33333"; 5], [3, 3, 0, 7]);
        // The code counts two of the four sensors.
        let rows = ["77777", "88888", "33300", "00000", "00000"];
        check(Rules::PAPER, &rows, [2, 0, 1, 7]);
        check(Rules::CODE, &rows, [2, 0, 0, 7]);
        assert_eq!(Descriptor::new(&evolution()).niches(), 1024);
    }
}
