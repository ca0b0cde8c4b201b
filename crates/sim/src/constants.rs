//! Every number of the physics, in one place, with its unit and its section in docs/physics.md.

use nbc_base::model::WorldFactors;

/// The constants of the model: of the paper's world by default, of others by [`Constants::in_world`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Constants {
    /// Edge of a voxel at rest, in meters (1).
    pub cell: f64,
    /// Length of a substep, in seconds (1).
    pub substep: f64,
    /// Substeps in an env step (1).
    pub substeps: u32,
    /// Downward acceleration, in meters per second squared (1).
    pub gravity: f64,
    /// Viscous drag of a point, in newtons per meter per second (1).
    pub drag: f64,
    /// Stiffness of a main edge between rigid voxels only, in newtons per meter (3).
    pub rigid_stiffness: f64,
    /// Stiffness of an active voxel's main edges, in newtons per meter (3).
    pub active_stiffness: f64,
    /// Stiffness of a soft voxel's main edges, in newtons per meter (3).
    pub soft_stiffness: f64,
    /// A rigid voxel's diagonals, as a fraction of its main stiffness (3).
    pub rigid_diagonal: f64,
    /// An active voxel's diagonals, likewise (3).
    pub active_diagonal: f64,
    /// A soft voxel's diagonals, likewise (3).
    pub soft_diagonal: f64,
    /// Smallest target width of a voxel, as a fraction of its rest width (4).
    pub least_target: f64,
    /// Largest target width of a voxel, as a fraction of its rest width (4).
    pub greatest_target: f64,
    /// Fraction of the distance to its goal by which an edge's working rest length moves in one substep (5).
    pub approach: f64,
    /// Stiffness of the plane under the ground, in newtons per meter (6).
    pub plane_stiffness: f64,
    /// Friction force of the plane at high speed, as a fraction of the normal force (6).
    pub plane_friction: f64,
    /// Steepness of the plane's friction: the factor of N·v in the hyperbolic tangent (6).
    pub plane_slope: f64,
    /// Determinant below which two edges count as parallel, in square meters (7).
    pub parallel: f64,
    /// Edge length below which an edge has no direction, in meters (7).
    pub shortest: f64,
    /// Distance from an edge without direction, in meters (7).
    pub nowhere: f64,
    /// Contact stiffness, in newtons per meter (7).
    pub contact_stiffness: f64,
    /// Depth added to every contact, in meters (7).
    pub contact_depth: f64,
    /// Damping of the point along the normal, in newtons per meter per second (7).
    pub point_damping: f64,
    /// Damping of each end of the edge along the normal, likewise (7).
    pub edge_damping: f64,
    /// Slope of friction against tangential speed, in newtons per meter per second (7).
    pub friction: f64,
    /// Speed at which friction saturates, per newton of normal force, in meters per second per newton (7).
    pub friction_range: f64,
    /// Longest length of an edge, as a fraction of its built length (8).
    pub longest: f64,
    /// Shortest length of an edge, as a fraction of its built length (8).
    pub tightest: f64,
    /// Fraction of an excess that is corrected in a substep (8).
    pub correction: f64,
    /// Longest length of an edge of a rigid voxel, as a fraction of its built length (8).
    pub rigid_longest: f64,
    /// Shortest an edge of a rigid voxel may be, likewise (8).
    pub rigid_tightest: f64,
    /// Fraction of a rigid voxel's excess that is corrected in a substep (8).
    pub rigid_correction: f64,
}

impl Default for Constants {
    fn default() -> Self {
        Self {
            cell: 0.1,
            substep: 1e-4,
            substeps: 30,
            gravity: 110.0,
            drag: 0.1,
            rigid_stiffness: 3e8 / 3.5,
            active_stiffness: 3e8 / 5.0,
            soft_stiffness: 3e8 / 6.0,
            rigid_diagonal: 0.5,
            active_diagonal: 0.5,
            soft_diagonal: 0.25,
            least_target: 0.6,
            greatest_target: 1.6,
            approach: 0.006,
            plane_stiffness: 1.4e7,
            plane_friction: 10.0 * 0.2,
            plane_slope: 0.2,
            parallel: 1e-4,
            shortest: 1e-6,
            nowhere: 1000.0,
            contact_stiffness: 300_000.0 * 7.0,
            contact_depth: 0.005,
            point_damping: 140.0,
            edge_damping: 70.0,
            friction: 1200.0,
            friction_range: 0.2,
            longest: 1.25,
            tightest: 0.75,
            correction: 0.8,
            rigid_longest: 1.03,
            rigid_tightest: 0.97,
            rigid_correction: 0.5,
        }
    }
}

impl Constants {
    /// These constants times the factors of a world (docs/physics.md 15).
    pub fn in_world(&self, factors: &WorldFactors) -> Self {
        let WorldFactors { friction, gravity, stiffness, drag, damping, swelling } = *factors;
        Self {
            friction: self.friction * friction,
            plane_friction: self.plane_friction * friction,
            gravity: self.gravity * gravity,
            rigid_stiffness: self.rigid_stiffness * stiffness,
            active_stiffness: self.active_stiffness * stiffness,
            soft_stiffness: self.soft_stiffness * stiffness,
            drag: self.drag * drag,
            point_damping: self.point_damping * damping,
            edge_damping: self.edge_damping * damping,
            approach: self.approach * swelling,
            ..*self
        }
    }

    /// Newtons on a unit mass in meters per substep squared, the kernel's unit of force.
    pub(crate) fn per_substep_squared(&self) -> f64 {
        self.substep * self.substep
    }
}
