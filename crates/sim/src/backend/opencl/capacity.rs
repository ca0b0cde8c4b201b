//! The sizes for which a kernel is compiled: those of the paper's boxes and others, so that few programs serve all
//! bodies.

use std::fmt::Write;

use crate::backend::lanes::{MARGIN, SLACK};
use crate::backend::opencl::plan::BodyPlan;
use crate::constants::Constants;

/// The most masses, springs and surface voxels of the robots of a launch.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Capacity {
    pub masses: usize,
    pub springs: usize,
    pub tiles: usize,
}

/// Sides of square boxes: a full box of that side sets the masses and springs of a capacity.
const SIDES: [usize; 12] = [2, 3, 5, 7, 10, 14, 20, 28, 40, 57, 80, 101];

/// Numbers of surface voxels; full boxes of 5x5, 7x7 and 10x10 voxels have 16, 24 and 36.
const TILES: [usize; 12] = [4, 9, 16, 24, 36, 64, 128, 256, 512, 1024, 4096, 10_000];

/// Contacts whose forces are computed together; `PUSHED` in the kernel.
const PUSHED: usize = 32;

impl Capacity {
    pub fn of(plan: &BodyPlan) -> Self {
        let fits = |side: &&usize| plan.masses.len() <= masses(**side) && plan.springs() <= springs(**side);
        let side = *SIDES.iter().find(fits).unwrap_or(&SIDES[SIDES.len() - 1]);
        let most = TILES[TILES.len() - 1];
        let tiles = TILES.into_iter().find(|&tiles| plan.tiles() <= tiles).unwrap_or(most);
        Self {
            masses: masses(side).max(plan.masses.len()),
            springs: springs(side).max(plan.springs()),
            tiles: tiles.max(plan.tiles()),
        }
    }

    pub fn max(self, other: Self) -> Self {
        let Self { masses, springs, tiles } = other;
        Self { masses: self.masses.max(masses), springs: self.springs.max(springs), tiles: self.tiles.max(tiles) }
    }

    /// Bytes of local memory that a work-group needs, with room for what a compiler adds.
    pub fn local_bytes(self) -> usize {
        let (point_words, tile_words) = (self.masses.div_ceil(32), self.tiles.div_ceil(32));
        let vectors = 4 * self.masses + self.springs.max(3 * PUSHED);
        let words = self.tiles * (2 * point_words + tile_words + 3) + tile_words;
        16 * vectors + 4 * words + 1024
    }

    /// Bytes of the device's memory that a robot needs for its state and its centers of mass.
    pub fn global_bytes(self, window: usize) -> usize {
        16 * (3 * self.masses + window + 2)
    }

    pub fn prelude(self, group: usize, constants: &Constants) -> String {
        let mut text = String::new();
        for (name, value) in numbers(constants) {
            let _ = writeln!(text, "#define {name} as_double({:#018x}UL) // {value}", value.to_bits());
        }
        let sizes = [
            ("SUBSTEPS", constants.substeps as usize),
            ("GROUP", group),
            ("MASSES", self.masses),
            ("SPRINGS", self.springs),
            ("TILES", self.tiles),
        ];
        for (name, size) in sizes {
            let _ = writeln!(text, "#define {name} {size}u");
        }
        text
    }
}

fn masses(side: usize) -> usize {
    (side + 1) * (side + 1)
}

fn springs(side: usize) -> usize {
    4 * side * side + 2 * side
}

fn numbers(constants: &Constants) -> [(&'static str, f64); 35] {
    let c = constants;
    let diagonal = (c.cell * c.cell + c.cell * c.cell).sqrt();
    [
        ("CELL", c.cell),
        ("DIAGONAL", diagonal),
        ("SUBSTEP", c.substep),
        ("PER_SUBSTEP_SQUARED", c.per_substep_squared()),
        ("WEIGHT", -c.gravity * c.per_substep_squared()),
        ("DRAG", c.drag * c.substep),
        ("APPROACH", c.approach),
        ("REST", 1.0 - c.approach),
        ("SIXTH", 1.0 / 6.0),
        ("PLANE_STIFFNESS", c.plane_stiffness),
        ("PLANE_FRICTION", c.plane_friction),
        ("PLANE_SLOPE", c.plane_slope),
        ("PARALLEL", c.parallel),
        ("SHORTEST", c.shortest),
        ("NOWHERE", c.nowhere),
        ("CONTACT_STIFFNESS", c.contact_stiffness),
        ("CONTACT_DEPTH", c.contact_depth),
        ("POINT_DAMPING", c.point_damping),
        ("EDGE_DAMPING", c.edge_damping),
        ("FRICTION", c.friction),
        ("FRICTION_RANGE", c.friction_range),
        ("MAIN_MOST", c.cell * c.longest),
        ("MAIN_LEAST", c.cell * c.tightest),
        ("DIAGONAL_MOST", diagonal * c.longest),
        ("DIAGONAL_LEAST", diagonal * c.tightest),
        ("HALF_CORRECTION", c.correction / 2.0),
        ("RIGID_MOST", c.cell * c.rigid_longest),
        ("RIGID_LEAST", c.cell * c.rigid_tightest),
        ("HALF_RIGID_CORRECTION", c.rigid_correction / 2.0),
        ("MARGIN", MARGIN),
        ("SLACK", SLACK),
        ("BUDGET", MARGIN / 2.0 - SLACK),
        ("CLEAR", 1e-5),
        ("NEAR_DIAGONAL", 1e-7),
        ("LARGE", 1.0),
    ]
}
