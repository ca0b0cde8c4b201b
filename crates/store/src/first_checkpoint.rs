//! Checkpoints of format 1, whose declaration is text.

use std::sync::Arc;

use serde::Deserialize;

use crate::declared::{Declared, FullDeclaration};
use crate::search_state::SearchRecord as StateRecord;
use nbc_base::model::{Axis, Drive, Material, MaterialKind, Palette, Response, SearchObjective};

/// The part of such a checkpoint after its header.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct FirstRecord {
    pub(super) version: String,
    evolution: String,
    declaration: String,
    #[serde(default)]
    descriptors: Vec<Axis>,
    #[serde(default)]
    objective: SearchObjective,
    pub(super) state: StateRecord,
    pub(super) env_steps: u64,
    pub(super) left_out: u64,
}

impl FirstRecord {
    /// The declaration; `None` if its text has no materials.
    pub(super) fn declared(&self) -> Option<Declared> {
        Some(Declared {
            name: self.evolution.clone(),
            axes: self.descriptors.clone(),
            objective: self.objective,
            palette: Arc::new(palette(&self.declaration)?),
            whole: FullDeclaration::Text(self.declaration.clone()),
        })
    }
}

/// The materials in the text of a declaration: `Palette { materials: [Material { name: "bone", kind: Rigid }, …] }`.
fn palette(declaration: &str) -> Option<Palette> {
    let (_, rest) = declaration.split_once("Palette { materials: [")?;
    let (list, _) = rest.split_once("] }")?;
    let materials = list.split("Material { ").skip(1).map(material).collect::<Option<Vec<_>>>()?;
    Palette::try_from(materials).ok()
}

/// A material in such a text: `name: "muscle", kind: Actuator(Drive { period: 84, … }) }, `.
fn material(text: &str) -> Option<Material> {
    let (name, kind) = text.strip_prefix("name: \"")?.split_once("\", kind: ")?;
    let number = |field: &str| {
        let (_, rest) = kind.split_once(&format!("{field}: "))?;
        rest.split([',', ' ']).next()
    };
    let real = |field| number(field)?.parse::<f64>().ok().filter(|number| number.is_finite());
    let kind = match kind.split(['(', ' ']).next()? {
        "Rigid" => MaterialKind::Rigid,
        "Soft" => MaterialKind::Soft,
        "Actuator" => MaterialKind::Actuator(Drive {
            period: number("period")?.parse().ok()?,
            phase: real("phase")?,
            low: real("low")?,
            high: real("high")?,
        }),
        "Sensor" => MaterialKind::Sensor(Response {
            stimulus: number("stimulus")?.parse().ok()?,
            image: None,
            absent: real("absent")?,
            present: real("present")?,
        }),
        _ => return None,
    };
    Some(Material { name: name.to_owned(), kind })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_palette_reads_back_from_its_text() {
        let mut materials = Palette::paper().materials().to_vec();
        let drive = Drive { period: 42, phase: -12.5, low: 0.98, high: 1.02 };
        materials.insert(3, Material { name: "heart".to_owned(), kind: MaterialKind::Actuator(drive) });
        let own = Palette::new(materials);
        assert_eq!(palette(&format!("5 x 5; {own:?}; MutationWeights {{ }}")), Some(own));
        assert_eq!(palette("5 x 5; Palette { materials: [Material { name: \"a\", kind: Gas }] }"), None);
    }
}
