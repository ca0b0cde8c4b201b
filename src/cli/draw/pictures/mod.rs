//! The kinds of pictures, one file each.

mod comparison;
mod discovery;
mod dot;
mod film;
mod heatmap;
mod page;
mod pose;
mod progress;
mod schematic;
mod spacetime;
mod sprite;
mod strip;
mod vcd;

use crate::cli::draw::picture::{FilmFormat, PictureKind};

pub(in crate::cli) use page::run_page;

/// In the order of the help.
pub(super) const PICTURES: [&dyn PictureKind; 14] = [
    &film::FilmPicture(FilmFormat::Apng),
    &comparison::ComparisonPicture,
    &discovery::DiscoveryPicture,
    &dot::DotPicture,
    &film::FilmPicture(FilmFormat::Gif),
    &heatmap::HeatmapPicture,
    &pose::PosePicture,
    &progress::ProgressPicture,
    &page::PagePicture,
    &schematic::SchematicPicture,
    &spacetime::SpacetimePicture,
    &sprite::SpritePicture,
    &strip::StripPicture,
    &vcd::VcdPicture,
];
