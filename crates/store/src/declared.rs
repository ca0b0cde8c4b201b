//! The declaration of a run, as its checkpoint stores it.

use std::collections::BTreeMap;
use std::sync::Arc;

use nbc_base::model::{Axis, Evolution, Image, Palette, Pattern, SearchObjective, Spell};

/// The declaration in a checkpoint.
#[derive(Clone, Debug, PartialEq)]
pub struct Declared {
    /// The declaration's name.
    pub name: String,
    /// The archive's axes; `None` in the oldest checkpoints, which do not have them.
    pub axes: Vec<Axis>,
    /// What fitness meant in the run.
    pub objective: SearchObjective,
    /// The meaning of the codes in its bodies.
    pub palette: Arc<Palette>,
    pub(super) whole: FullDeclaration,
}

/// All that a declaration says.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum FullDeclaration {
    /// As data.
    Data(Box<Evolution>),
    /// As the text by which checkpoints of format 1 are compared.
    Text(String),
}

impl Declared {
    pub(super) fn of(evolution: Evolution) -> Self {
        Self {
            name: evolution.name.clone(),
            axes: evolution.descriptors.clone(),
            objective: evolution.objective,
            palette: Arc::clone(&evolution.palette),
            whole: FullDeclaration::Data(Box::new(evolution)),
        }
    }

    /// The number of worlds besides its own in which the run tried bodies.
    pub fn others(&self) -> usize {
        match &self.whole {
            FullDeclaration::Data(evolution) => evolution.sample.map_or(0, |sample| sample.worlds as usize),
            FullDeclaration::Text(_) => 0,
        }
    }

    /// The number of generations that the run was to have; `None` in checkpoints of format 1.
    pub fn generations(&self) -> Option<u32> {
        match &self.whole {
            FullDeclaration::Data(evolution) => Some(evolution.generations),
            FullDeclaration::Text(_) => None,
        }
    }

    /// The first image of each set that bodies were shown; none of other objectives.
    pub fn images(&self) -> Vec<Arc<Image>> {
        let FullDeclaration::Data(evolution) = &self.whole else { return Vec::new() };
        let mut first: BTreeMap<Pattern, Arc<Image>> = BTreeMap::new();
        for Spell { pattern, image, .. } in &evolution.variable.spells {
            if let Some(image) = image {
                first.entry(*pattern).or_insert_with(|| Arc::clone(image));
            }
        }
        first.into_values().collect()
    }

    /// Whether a run of that declaration fills the same archive: its name, seeds and number of generations may be
    /// others.
    pub(super) fn fits(&self, evolution: &Evolution) -> bool {
        match &self.whole {
            FullDeclaration::Data(own) => {
                let Evolution { name, generations, seeds, .. } = evolution.clone();
                Evolution { name, generations, seeds, ..Evolution::clone(own) } == *evolution
            }
            FullDeclaration::Text(own) => *own == declaration_text(evolution),
        }
    }
}

/// Everything in a declaration that its archive depends on, as format 1 wrote it.
fn declaration_text(evolution: &Evolution) -> String {
    let spells = &evolution.variable.spells;
    let Evolution { width, height, palette, mutation, fixed_steps, descriptors, batch, newcomers, .. } = evolution;
    let Evolution { rules, objective, symmetry, niche, .. } = evolution;
    let text = format!(
        "{width} x {height}; {palette:?}; {mutation:?}; {spells:?}; {fixed_steps}; {descriptors:?}; {batch} + \
         {newcomers}; {rules:?}; \
         {objective:?}; {symmetry:?}; {niche:?}"
    );
    // Runs of format 1 knew no images.
    text.replace("image: None, ", "")
}
