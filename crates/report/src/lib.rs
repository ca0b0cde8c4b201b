//! Reports: results as text, pictures and data. Everything here returns text or bytes; the layers above write them.

mod champions;
mod chart;
mod color;
mod comparison;
mod confusion;
mod csv;
mod curves;
mod discovery;
mod document;
mod element;
mod evolution;
mod evolution_page;
mod evolution_results;
mod export;
#[cfg(feature = "pictures")]
mod film;
#[cfg(feature = "pictures")]
mod font;
mod groups;
mod heatmap;
mod hierarchy;
mod history;
mod html;
mod image;
mod layers;
mod listing;
mod looks;
mod net_names;
mod occlusion;
mod page_bodies;
mod pose;
mod progress;
#[cfg(feature = "pictures")]
mod raster;
mod result;
mod robustness;
mod run_page;
mod schematic;
#[cfg(feature = "pictures")]
mod shades;
mod sheet;
mod spacetime;
mod sprite;
mod stage;
mod strip;
mod svg;
#[cfg(feature = "pictures")]
mod swatches;
mod symbols;
mod table;
mod timing;
mod truth_table;
mod vcd;
mod verdict;
mod wires;

pub use champions::{Champions, draw_champions};
pub use color::{Color, Scheme};
pub use comparison::{draw_accuracies, draw_comparison};
pub use confusion::Confusion;
pub use csv::cycle_table;
pub use curves::{draw_response, draw_schedule};
pub use discovery::{Discovery, draw_discovery};
pub use document::{Document, Schema};
pub use element::{Anchor, Paint, Point, Type};
pub use evolution::{EvolutionLine, evolution_table};
pub use evolution_page::{PageFigure, draw_evolution_page};
pub use evolution_results::{ArchiveAxis, EvolutionResults, SeedRun};
pub use export::{EliteData, Elites, robots_csv};
#[cfg(feature = "pictures")]
pub use film::{FRAMES_PER_CYCLE, Film, write_apng, write_gif};
pub use groups::{BehaviorGroup, GroupComparison, behavior_groups, compare_groups, describe_groups, difficulty_of};
pub use heatmap::{ArchiveMap, draw_heatmap, heat};
pub use history::{History, ProgressLine};
pub use html::base64;
pub use listing::{Answer, Listing, Outcome, describe_robot};
pub use looks::{Look, Looks, Mark, describe_material};
pub use occlusion::{OcclusionMap, draw_occlusion};
pub use page_bodies::{VoxelLook, about_robot, voxel_data, voxel_looks};
pub use pose::draw_pose;
pub use progress::{Course, Series, draw_progress};
#[cfg(feature = "pictures")]
pub use raster::png;
pub use result::{RobotResult, RunResult, SwarmResult};
pub use robustness::{YieldCurve, describe_robustness, draw_yields};
pub use run_page::{PageSwarm, SwarmOutcome, draw_logic_page, draw_run_page};
pub use schematic::{Schematic, SchematicPages, SheetPage, draw_schematic_page};
pub use spacetime::{Spells, Strip, Track, draw_chosen, draw_robot, draw_swarm};
pub use sprite::{Portrait, Pose, draw_body, draw_portrait, draw_portraits, draw_sprite};
pub use stage::{Moment, Stage};
pub use strip::draw_strip;
pub use svg::Svg;
pub use table::{Align, TextTable};
pub use timing::{SwarmTiming, describe_fan_out, describe_memory, describe_path, describe_settling};
pub use vcd::vcd;
pub use verdict::{describe_simulation, describe_swarm, describe_test, describe_verdict};
#[cfg(feature = "schema")]
pub use {evolution_page::EvolutionData, run_page::RunData, schematic::SheetsData};
