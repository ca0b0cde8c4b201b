//! Materials: what a voxel is made of, and how it answers time and stimuli.

use serde::{Deserialize, Serialize};

/// A declared material: a name and what it does.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Material {
    /// The name in the program.
    pub name: String,
    /// What it does.
    pub kind: MaterialKind,
}

/// What a material does (docs/physics.md 3 and 4).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum MaterialKind {
    /// Passive and stiff.
    Rigid,
    /// Passive and compliant.
    Soft,
    /// Swells and shrinks with time.
    Actuator(Drive),
    /// Swells or shrinks with a stimulus.
    Sensor(Response),
}

/// The sine that drives an actuator (docs/physics.md 10).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Drive {
    /// Samples of one period, in env steps; both ends are samples, so the last and the first have one phase.
    pub period: u32,
    /// Phase, in degrees.
    pub phase: f64,
    /// Least width, as a share of the width at rest.
    pub low: f64,
    /// Greatest width, as a share of the width at rest.
    pub high: f64,
}

/// How a sensor answers its stimulus (docs/physics.md 10).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Response {
    /// The stimulus it senses, counted from 0.
    pub stimulus: usize,
    /// Width while the stimulus is absent, as a share of the width at rest.
    pub absent: f64,
    /// Width while the stimulus is present, as a share of the width at rest.
    pub present: f64,
}

/// The materials a body may be made of: code 0 is empty, code `k` is the `k`-th material.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Palette {
    materials: Vec<Material>,
}

impl Palette {
    /// The most materials of a palette: codes are written as digits and lower-case letters, `0` for empty.
    pub const MAX_MATERIALS: usize = 35;

    /// A palette of these materials, in order of their codes.
    ///
    /// # Panics
    /// When there are more than [`Palette::MAX_MATERIALS`].
    pub fn new(materials: Vec<Material>) -> Self {
        assert!(materials.len() <= Self::MAX_MATERIALS, "a palette holds at most 35 materials");
        Self { materials }
    }

    /// The paper's eight materials (paper, Methods; codes as in docs/physics.md 1 and 10): 1 rigid, 2 soft, 3 active, 4 active in
    /// antiphase, 5 and 6 shrink, 7 and 8 grow while stimulus 1 and 2 is present.
    pub fn paper() -> Self {
        let named = |name: &str, kind| Material { name: name.to_owned(), kind };
        let drive = |phase| MaterialKind::Actuator(Drive { period: super::CYCLE_STEPS, phase, low: 0.6, high: 1.6 });
        let sensor = |stimulus, absent, present| MaterialKind::Sensor(Response { stimulus, absent, present });
        Self::new(vec![
            named("bone", MaterialKind::Rigid),
            named("flesh", MaterialKind::Soft),
            named("muscle", drive(0.0)),
            named("antimuscle", drive(180.0)),
            named("s1_shrink", sensor(0, 1.6, 0.6)),
            named("s2_shrink", sensor(1, 1.6, 0.6)),
            named("s1_grow", sensor(0, 0.6, 1.6)),
            named("s2_grow", sensor(1, 0.6, 1.6)),
        ])
    }

    /// The materials in order of their codes, code 1 first.
    pub fn materials(&self) -> &[Material] {
        &self.materials
    }

    /// What code `code` does; `None` for empty.
    ///
    /// # Panics
    /// When the palette has no such code.
    pub fn kind(&self, code: u8) -> Option<MaterialKind> {
        (code > 0).then(|| self.materials[usize::from(code) - 1].kind)
    }
}
