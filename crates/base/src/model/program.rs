//! A checked program: every declaration as plain data, in order of declaration, those of the prelude first.

use std::collections::BTreeMap;
use std::sync::Arc;

use super::{
    Base, Behavior, Circuit, CircuitId, CircuitTest, Claim, Column, Enumeration, Evolution, Image, ImageSize, Instance,
    Material, NamedWorld, Pattern, Schedule, Spell,
};
use crate::source::Span;

/// All declarations of a source file and the files it uses.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Program {
    /// The stimuli, in the order that numbers them.
    pub stimuli: Vec<String>,
    /// The sizes of those stimuli that are images, by their numbers.
    pub image_sizes: BTreeMap<usize, ImageSize>,
    pub images: Vec<NamedImages>,
    pub materials: Vec<Material>,
    pub worlds: Vec<NamedWorld>,
    pub schedules: Vec<NamedSchedule>,
    pub evolutions: Vec<Evolution>,
    /// The names of the evolution runs of the file itself, not of files it uses.
    pub own_evolutions: Vec<String>,
    pub circuits: Vec<Circuit>,
    /// The circuit `select` of the prelude: its second operand selects a bit of its first.
    pub selector: Option<CircuitId>,
    /// The circuit `stored` of the prelude, of which each bit is a register.
    pub stored: Option<CircuitId>,
    pub enumerations: Vec<Enumeration>,
    pub files: Vec<NamedFile>,
    /// The environments among the circuits, which no swarm is made of.
    pub environments: Vec<CircuitId>,
    /// Declared libraries; the built-in one is not among them.
    pub libraries: Vec<LibrarySource>,
    pub swarms: Vec<Swarm>,
    /// The simulations of the file itself, not of files it uses.
    pub simulations: Vec<Simulation>,
    pub tests: Vec<CircuitTest>,
    pub claims: Vec<Claim>,
}

#[derive(Clone, Debug, PartialEq)]
pub struct NamedSchedule {
    pub name: String,
    /// Its stimuli, as indices of [`Program::stimuli`].
    pub stimuli: Vec<usize>,
    pub schedule: Schedule,
    /// The names of the sets whose images it shows, in the order that numbers them; none for other stimuli.
    pub sets: Vec<String>,
}

impl NamedSchedule {
    /// The most sets of images: as many as two stimuli have patterns.
    pub const MOST_SETS: usize = Pattern::PAIRS.len();

    /// Their pattern is the number of the set, the least significant bit first.
    pub fn show(&mut self, set: &NamedImages, steps: u32) {
        let number = self.sets.iter().position(|name| *name == set.name).unwrap_or_else(|| {
            self.sets.push(set.name.clone());
            self.sets.len() - 1
        });
        let pattern = Schedule::of_set(number);
        let spell = |image: &Arc<Image>| Spell { image: Some(image.clone()), ..Spell::of(pattern, steps) };
        self.schedule.spells.extend(set.images.iter().map(spell));
    }
}

#[derive(Clone, Debug, PartialEq)]
pub struct NamedImages {
    pub name: String,
    /// The stimulus that shows them, as an index of [`Program::stimuli`].
    pub stimulus: usize,
    pub images: Vec<Arc<Image>>,
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NamedFile {
    pub name: String,
    /// The path, from the same place as that of the source file which names it.
    pub path: String,
    pub span: Span,
}

#[derive(Clone, Debug, PartialEq)]
pub struct LibrarySource {
    pub name: String,
    pub span: Span,
    pub from: Origin,
    pub behaviors: Option<Vec<Behavior>>,
    pub without: Vec<(String, Span)>,
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Origin {
    Shipped,
    Three,
    Evolution(String),
    /// Robot files in a folder; the path starts from the same place as that of the source file which names it.
    Folder(String),
}

#[derive(Clone, Debug, PartialEq)]
pub struct Swarm {
    pub name: String,
    pub span: Span,
    pub circuit: Instance,
    pub library: String,
    pub hold: Hold,
    /// The number of cycles over which a robot's output is measured; the paper's is 1.
    pub window: u32,
    pub registers: RegisterStyle,
    pub waves: WaveTimes,
    pub world: NamedWorld,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum RegisterStyle {
    /// Two latches each, as written.
    #[default]
    MasterSlave,
    /// Two latches each, of one multiplexer that reads itself.
    Mux,
    /// Nothing: every loop takes the same time, and the state travels round it as a wave.
    Waves,
}

/// The times of a wave machine; the compiler chooses those that are not set.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct WaveTimes {
    /// Cycles for which robots sense the same, and in which each of them reacts.
    pub beat: Option<u32>,
    /// Cycles of a step, from one edge of the clock to the next.
    pub step: Option<u32>,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Hold {
    /// Until every robot has settled, row by row.
    #[default]
    Auto,
    Cycles(u32),
}

#[derive(Clone, Debug, PartialEq)]
pub struct Simulation {
    /// The swarm's name in [`Program::swarms`], or the name of a circuit without a swarm.
    pub swarm: String,
    pub circuit: Instance,
    pub span: Span,
    pub file: String,
    pub line: usize,
    pub inputs: Vec<Column>,
    pub spells: Vec<InputSpell>,
    pub world: Option<NamedWorld>,
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub struct InputSpell {
    /// The input bits in order of the ports, the most significant bit of a port first.
    pub inputs: Vec<bool>,
    /// The notation of the values of the ports; empty if they come from a schedule of stimuli.
    pub bases: Vec<Base>,
    pub cycles: u32,
    pub line: usize,
}

impl Program {
    pub fn default_world(&self) -> NamedWorld {
        let declared = self.worlds.iter().find(|named| named.name == NamedWorld::DEFAULT);
        declared.cloned().unwrap_or_default()
    }

    pub fn circuit(&self, name: &str) -> Option<&Circuit> {
        self.circuits.iter().find(|circuit| circuit.name == name)
    }

    pub fn evolution(&self, name: &str) -> Option<&Evolution> {
        self.evolutions.iter().find(|evolution| evolution.name == name)
    }

    pub fn library(&self, name: &str) -> Option<&LibrarySource> {
        self.libraries.iter().find(|library| library.name == name)
    }

    pub fn swarm(&self, name: &str) -> Option<&Swarm> {
        self.swarms.iter().find(|swarm| swarm.name == name)
    }

    pub fn schedule(&self, name: &str) -> Option<&NamedSchedule> {
        self.schedules.iter().find(|schedule| schedule.name == name)
    }
}
