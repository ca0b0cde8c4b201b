//! Reports: what was found, as text, pictures and data. Everything here is text or bytes; who writes them where is decided above.

mod chart;
mod color;
mod film;
mod layers;
mod listing;
mod page;
mod raster;
mod recording;
mod result;
mod schematic;
mod spacetime;
mod sprite;
mod stage;
mod strip;
mod svg;
mod swatches;
mod table;
mod vcd;
mod verdict;

pub use chart::{Panel, Scale, range_of, tick_label};
pub use color::Color;
pub use film::{Film, STRIDE, write_apng, write_gif};
pub use listing::{Listing, describe_robot};
pub use page::{PageTest, draw_page};
pub use raster::{png, rasterize};
pub use recording::{Recorded, Recording};
pub use result::{RobotResult, RunResult, TestResult};
pub use schematic::draw_schematic;
pub use spacetime::{Strip, Track, draw_robot, draw_swarm};
pub use sprite::{Pose, Scheme, draw_body, draw_portrait, draw_sprite};
pub use stage::{Moment, Stage};
pub use strip::draw_strip;
pub use svg::{Anchor, Paint, Point, Svg, Type};
pub use table::{Align, Table};
pub use vcd::vcd;
pub use verdict::{describe_swarm, describe_test};
