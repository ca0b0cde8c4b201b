//! The nouns of the field as plain data: materials, bodies, robots, circuits, tests. Operations of a single stage are
//! in that stage.

mod behavior;
pub mod bodies;
mod body;
mod circuit;
mod claim;
mod column;
mod enumeration;
mod evolution;
mod function;
mod genotype;
mod ground;
mod ground_file;
mod image;
mod image_file;
mod image_size;
mod material;
mod objective;
mod palette;
#[cfg(feature = "pictures")]
mod png_file;
mod program;
mod register;
mod robot;
mod rules;
mod schedule;
mod stimulus;
mod table;
mod test;
mod trial;
mod value;
mod variation;
mod wording;
mod world;

pub use behavior::{Behavior, Direction, Displacements};
pub use body::{Body, LEAST_ACTUATORS};
pub use circuit::{
    BitDriver, Block, Circuit, CircuitId, Condition, DrivenBit, Expression, ExpressionId, ExpressionKind, FreeNumber,
    Instance, MemoryArray, MemoryRead, MemoryWrite, Net, NetSlot, Operator, Parameter, Relation, Size, SizeId,
    SizeKind, SizeOperator, Statement, Target,
};
pub use claim::{Claim, InnerNet, Property, PropertyKind};
pub use column::{Column, bit_parts};
pub use enumeration::{Enumeration, EnumerationMember, MemberEncoding};
pub use evolution::{
    Axis, Count, Evolution, Genome, ImageOrder, MutationWeights, Niche, SampledWorlds, StartBodies, Symmetry,
};
pub use function::Function;
pub use genotype::{Activation, Genotype, Link, NodeId, NodeKind};
pub use ground::{GroundProfile, GroundShape};
pub use image::Image;
pub use image_file::{ImageFile, LabeledImage};
pub use image_size::ImageSize;
pub use material::{Drive, Material, MaterialKind, Response};
pub use objective::SearchObjective;
pub use palette::Palette;
pub use program::{
    Hold, InputSpell, LibrarySource, NamedFile, NamedImages, NamedSchedule, Origin, Program, RegisterStyle, Simulation,
    Swarm, WaveTimes,
};
pub use register::{Forcing, RegisterKind};
pub use robot::{Character, Library, Provenance, Robot, SafeRadius, Transition};
pub use rules::{Matter, Rules};
pub use schedule::{Schedule, Spell};
pub use stimulus::Pattern;
pub use table::{OutputValue, Table, TableOutput, TablePattern, TableRow};
pub use test::{CircuitTest, RowSource, Script, ScriptStep, Stimulation, TestRow, Until};
pub use trial::{Fault, Setting, Trajectory, Trial};
pub use value::{Base, Value};
pub use variation::Variation;
pub use wording::{BodyError, FaultKind, GroundFileError, ImageFileError, SettingError};
pub use world::{Hears, NamedWorld, PhysicsWorld, WorldFactors, WorldNoise};

/// Env steps in one actuation cycle of the paper (docs/physics.md 10).
pub const CYCLE_STEPS: u32 = 84;

/// Seconds of the robots' time in an actuation cycle: an env step is 30 substeps of a ten-thousandth of a second.
pub const CYCLE_SECONDS: f64 = CYCLE_STEPS as f64 * 30.0 * 1e-4;
