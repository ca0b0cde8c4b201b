//! Palettes: the meaning of the codes of a body.

use std::cmp::Ordering;
use std::hash::{Hash, Hasher};
use std::sync::Arc;

use serde::{Deserialize, Serialize};

use super::wording::{material_name, palette_size, same_material};
use super::{Drive, Function, ImageSize, Material, MaterialKind, Response};

/// The materials of a body: code 0 is empty, code `k` is the `k`-th material.
///
/// Palettes are equal when their materials have the same names and, to the bit, the same numbers.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(try_from = "Vec<Material>", into = "Vec<Material>")]
pub struct Palette {
    materials: Vec<Material>,
}

impl Palette {
    /// The most materials of a palette. Codes are written as digits and lower-case letters; `0` is empty.
    pub const MAX_MATERIALS: usize = 35;

    pub fn new(materials: Vec<Material>) -> Self {
        assert!(materials.len() <= Self::MAX_MATERIALS, "a palette holds at most 35 materials");
        assert!(materials.iter().all(|material| material.kind.is_finite()), "the numbers of materials are finite");
        Self { materials }
    }

    /// The paper's eight materials (paper, Methods; codes as in docs/physics.md 1 and 10): 1 rigid, 2 soft, 3 active, 4
    /// active in antiphase, 5 and 6 shrink, 7 and 8 grow while stimulus 1 and 2 is present.
    pub fn paper() -> Arc<Self> {
        Arc::new(Self::new(paper_materials()))
    }

    /// The paper's materials, and 9 and 10 that shrink and grow while stimulus 3 is present (library/three.nb).
    pub fn three() -> Arc<Self> {
        let mut materials = paper_materials();
        materials.extend([sensor("s3_shrink", 2, 1.6, 0.6), sensor("s3_grow", 2, 0.6, 1.6)]);
        Arc::new(Self::new(materials))
    }

    pub fn is_paper(&self) -> bool {
        *self == *Self::paper()
    }

    /// The materials in order of their codes, code 1 first.
    pub fn materials(&self) -> &[Material] {
        &self.materials
    }

    /// The material of code `code`; `None` for empty.
    pub fn material(&self, code: u8) -> Option<&Material> {
        (code > 0).then(|| &self.materials[usize::from(code) - 1])
    }

    pub fn kind(&self, code: u8) -> Option<MaterialKind> {
        self.material(code).map(|material| material.kind)
    }

    /// The number of stimuli in patterns for bodies of these materials: up to the last that a material senses, and at
    /// least the paper's two.
    pub fn stimuli(&self) -> usize {
        let sensed = self.materials.iter().filter_map(|material| match material.kind {
            MaterialKind::Sensor(response) if response.image.is_none() => Some(response.stimulus + 1),
            _ => None,
        });
        sensed.fold(2, usize::max)
    }

    pub fn image(&self) -> Option<ImageSize> {
        self.materials.iter().find_map(|material| match material.kind {
            MaterialKind::Sensor(response) => response.image,
            _ => None,
        })
    }

    /// The number of inputs of bodies of these materials as gates: their stimuli, of which a gate has two or three. A
    /// fourth one stays absent.
    pub fn inputs(&self) -> usize {
        self.stimuli().min(Function::MOST_INPUTS)
    }

    /// Names and numbers in an order that is total.
    fn key(&self) -> impl Iterator<Item = (&str, (u8, u64, [u64; 3]))> {
        self.materials.iter().map(|material| (material.name.as_str(), material.kind.bits()))
    }
}

impl Material {
    /// The paper's code for a material with this name and these numbers, if there is one.
    pub fn paper_code(&self) -> Option<u8> {
        (1..).zip(&paper_materials()).find(|(_, known)| *known == self).map(|(code, _)| code)
    }
}

fn paper_materials() -> Vec<Material> {
    let named = |name: &str, kind| Material { name: name.to_owned(), kind };
    let drive = |phase| MaterialKind::Actuator(Drive { period: super::CYCLE_STEPS, phase, low: 0.6, high: 1.6 });
    vec![
        named("bone", MaterialKind::Rigid),
        named("flesh", MaterialKind::Soft),
        named("muscle", drive(0.0)),
        named("antimuscle", drive(180.0)),
        sensor("s1_shrink", 0, 1.6, 0.6),
        sensor("s2_shrink", 1, 1.6, 0.6),
        sensor("s1_grow", 0, 0.6, 1.6),
        sensor("s2_grow", 1, 0.6, 1.6),
    ]
}

fn sensor(name: &str, stimulus: usize, absent: f64, present: f64) -> Material {
    Material { name: name.to_owned(), kind: MaterialKind::Sensor(Response::of(stimulus, absent, present)) }
}

impl TryFrom<Vec<Material>> for Palette {
    type Error = String;

    fn try_from(materials: Vec<Material>) -> Result<Self, String> {
        if materials.is_empty() || materials.len() > Self::MAX_MATERIALS {
            return Err(palette_size(materials.len(), Self::MAX_MATERIALS));
        }
        for (i, Material { name, .. }) in materials.iter().enumerate() {
            if !is_name(name) {
                return Err(material_name(name));
            }
            if materials[..i].iter().any(|other| other.name == *name) {
                return Err(same_material(name));
            }
        }
        Ok(Self::new(materials))
    }
}

impl From<Palette> for Vec<Material> {
    fn from(palette: Palette) -> Self {
        palette.materials
    }
}

fn is_name(text: &str) -> bool {
    text.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_')
        && text.chars().all(|c| c.is_ascii_alphanumeric() || c == '_')
}

impl PartialEq for Palette {
    fn eq(&self, other: &Self) -> bool {
        self.key().eq(other.key())
    }
}

impl Eq for Palette {}

impl PartialOrd for Palette {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Palette {
    fn cmp(&self, other: &Self) -> Ordering {
        self.key().cmp(other.key())
    }
}

impl Hash for Palette {
    fn hash<H: Hasher>(&self, state: &mut H) {
        self.key().for_each(|key| key.hash(state));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn palettes_that_differ_in_one_number_or_name_are_different() {
        let paper = Palette::paper();
        let changed = |change: fn(&mut Vec<Material>)| {
            let mut materials = paper.materials().to_vec();
            change(&mut materials);
            Palette::new(materials)
        };
        assert!(changed(|_| ()).is_paper());
        assert!(!changed(|materials| materials[0].name.push('s')).is_paper());
        assert!(!changed(|materials| materials.swap(4, 5)).is_paper());
        let next = |number: &mut f64| *number = f64::from_bits(number.to_bits() + 1);
        let nudged = changed(|materials| {
            let MaterialKind::Actuator(drive) = &mut materials[2].kind else { panic!("code 3 is an actuator") };
            drive.high = f64::from_bits(drive.high.to_bits() + 1);
        });
        assert_ne!(nudged, *paper);
        let mut high = 1.6;
        next(&mut high);
        assert_ne!(nudged.cmp(&paper), Ordering::Equal, "1.6 and {high} are different numbers");
    }

    #[test]
    #[should_panic(expected = "the numbers of materials are finite")]
    fn materials_need_finite_numbers() {
        let kind = MaterialKind::Sensor(Response::of(0, f64::NAN, 1.0));
        Palette::new(vec![Material { name: "broken".to_owned(), kind }]);
    }
}
