//! Films: robots walking, frame by frame, as GIF and APNG. One frame is held at a time, however long the film.

use std::collections::BTreeMap;
use std::io::{self, Write};

use tiny_skia::{self, FillRule, PathBuilder, Pixmap, Rect, Stroke, Transform};

use crate::Color;
use crate::color::Scheme;
use crate::element::{Anchor, Paint, Type};
use crate::image::{ink, pixel_side};
use crate::looks::{Look, Looks, draw_mark};
use crate::raster::{ink as ink_path, line, rasterize, solid};
use crate::sprite::Pose;
use crate::stage::{Moment, Stage};
use crate::svg::{Svg, shorten};
use crate::swatches::{Swatches, UNCHANGED};
use nbc_base::model::{GroundProfile, Image, ImageSize, Pattern};

pub const FRAMES_PER_CYCLE: u32 = 12;
/// Hundredths of a second for a frame: a cycle takes about half a second, half the robots' own pace.
const DELAY: u16 = 4;

const LARGE: usize = 32;
const HEAD: f64 = 34.0;
const FOOT: f64 = 14.0;
const GROUND: f64 = 9.0;

#[derive(Clone, Debug)]
pub struct Film {
    pub title: String,
    pub lanes: Vec<String>,
    pub scheme: Scheme,
    pub largest: usize,
    pub stimuli: usize,
    pub ground: GroundProfile,
}

struct Painter<'a> {
    film: &'a Film,
    backdrop: Pixmap,
    looks: Looks,
    swatches: Swatches,
    sees: bool,
    /// The world's x at the middle of each lane.
    cameras: Vec<f64>,
    frame: Pixmap,
    indexed: Vec<u8>,
}

struct Patch {
    left: u32,
    top: u32,
    width: u32,
    height: u32,
    pixels: Vec<u8>,
}

impl<'a> Painter<'a> {
    fn new(film: &'a Film, stage: &Stage) -> Self {
        let sees = stage.palettes.iter().any(|palette| palette.image().is_some());
        let backdrop = rasterize(&film.backdrop(sees), 1.0);
        let looks = Looks::of_palettes(&stage.palettes, film.scheme);
        let swatches = Swatches::new(&looks, film.scheme, film.stimuli);
        let frame = backdrop.clone();
        Self { film, backdrop, looks, swatches, sees, cameras: Vec::new(), frame, indexed: Vec::new() }
    }

    fn size(&self) -> (u32, u32) {
        (self.backdrop.width(), self.backdrop.height())
    }

    fn paint(&mut self, moment: &Moment, share: f64) -> Patch {
        self.frame.data_mut().copy_from_slice(self.backdrop.data());
        self.follow(moment);
        for lane in 0..moment.poses.len() {
            self.paint_lane(moment, lane);
        }
        let (width, height) = self.size();
        fill_rect(&mut self.frame, (0.0, f64::from(height) - 4.0), f64::from(width) * share, 4.0, Color::GRAY);
        let index = |pixel: &tiny_skia::PremultipliedColorU8| [pixel.red(), pixel.green(), pixel.blue()];
        let fresh: Vec<u8> = self.frame.pixels().iter().map(|pixel| self.swatches.index(index(pixel))).collect();
        let patch = patch(&self.indexed, &fresh, width, height);
        self.indexed = fresh;
        patch
    }

    fn follow(&mut self, moment: &Moment) {
        if self.cameras.is_empty() {
            self.cameras = moment.centers.iter().map(|center| center[0]).collect();
        }
        let slack = self.film.span() / self.film.scale() / 6.0;
        for (camera, center) in self.cameras.iter_mut().zip(&moment.centers) {
            if center[0].is_finite() {
                *camera = camera.clamp(center[0] - slack, center[0] + slack);
            }
        }
    }

    fn paint_ground(&mut self, camera: f64, half: f64, lane: usize, to_pixel: impl Fn((f64, f64)) -> (f64, f64)) {
        let film = self.film;
        let (left, top) = (film.left(lane) + film.labels(), film.top(lane));
        let columns = (camera - half).floor().max(0.0) as usize..(camera + half).ceil().max(0.0) as usize;
        let corner = |column: usize, row: usize| {
            let (x, y) = to_pixel((column as f64, row as f64));
            (x.clamp(left, left + film.span()), y.max(top))
        };
        for column in columns {
            let stretches = film.ground.stretches(column);
            for rows in &stretches {
                let (high, low) = (corner(column, rows.end), corner(column + 1, rows.start.max(1)));
                fill_rect(&mut self.frame, high, low.0 - high.0, low.1 - high.1, Color::GROUND);
            }
            if stretches.first().is_none_or(|rows| rows.start > 0) {
                let (from, to) = (corner(column, 1), corner(column + 1, 1));
                fill_rect(&mut self.frame, from, to.0 - from.0, GROUND, Color::SKY);
            }
        }
    }

    fn paint_lane(&mut self, moment: &Moment, lane: usize) {
        let film = self.film;
        let (scale, ground, left) = (film.scale(), film.ground(lane), film.left(lane));
        let middle = left + film.labels() + film.span() / 2.0;
        let camera = self.cameras[lane];
        let to_pixel = |(x, y): (f64, f64)| (middle + (x - camera) * scale, ground - (y - 1.0) * scale);
        let half = film.span() / 2.0 / scale;
        for voxel in (camera - half).ceil() as i64..=(camera + half).floor() as i64 {
            let tall = if voxel % 5 == 0 { 7.0 } else { 3.0 };
            fill_rect(&mut self.frame, (to_pixel((voxel as f64, 0.0)).0, ground), 1.0, tall, Color::PALE);
        }
        self.paint_ground(camera, half, lane, to_pixel);
        paint_pose(&mut self.frame, &moment.poses[lane], &self.looks, !film.is_dense(), to_pixel);
        match &moment.spells[lane].image {
            Some(image) => self.paint_image(image, (left + film.lamp(), ground)),
            None if self.sees => {}
            None => self.paint_stimuli(moment.spells[lane].pattern, (left + film.lamp(), ground)),
        }
        if moment.faults[lane] {
            fill_rect(&mut self.frame, (left + film.labels(), ground + GROUND), film.span(), 4.0, Color::FAULT);
        }
    }
}

impl Painter<'_> {
    fn paint_stimuli(&mut self, pattern: Pattern, (left, bottom): (f64, f64)) {
        let side = self.film.lamp();
        for (i, color) in Color::STIMULI.into_iter().take(self.film.stimuli).enumerate() {
            let place = (left + i as f64 * side * 1.375, bottom - side);
            fill_rect(&mut self.frame, place, side, side, color);
            if !pattern.has(i) {
                let (edge, inner) = (side / 8.0, side * 0.75);
                fill_rect(&mut self.frame, (place.0 + edge, place.1 + edge), inner, inner, Color::WHITE);
            }
        }
    }

    fn paint_image(&mut self, image: &Image, (left, bottom): (f64, f64)) {
        let (ImageSize { rows, columns }, side) = (image.size(), pixel_side(image, self.film.shown(true)));
        let (wide, high) = (columns as f64 * side, rows as f64 * side);
        fill_rect(&mut self.frame, (left - 1.0, bottom - high - 1.0), wide + 2.0, high + 2.0, Color::PALE);
        for (at, &value) in image.pixels().iter().enumerate() {
            let (row, column) = (at / columns, at % columns);
            let corner = (left + column as f64 * side, bottom - (rows - row) as f64 * side);
            fill_rect(&mut self.frame, corner, side, side, ink(value));
        }
    }
}

impl Film {
    fn is_dense(&self) -> bool {
        self.lanes.len() > LARGE
    }

    fn max_rows(&self) -> usize {
        if self.is_dense() { self.lanes.len().isqrt() * 4 / 3 } else { 8 }
    }

    fn columns(&self) -> usize {
        self.lanes.len().div_ceil(self.max_rows()).max(1)
    }

    fn rows(&self) -> usize {
        self.lanes.len().div_ceil(self.columns())
    }

    fn lane_width(&self) -> f64 {
        match self.columns() {
            1 => 560.0,
            _ if self.is_dense() => 140.0,
            _ => 340.0,
        }
    }

    fn labels(&self) -> f64 {
        if self.is_dense() { 60.0 } else { 108.0 }
    }

    fn lamp(&self) -> f64 {
        if self.is_dense() { 8.0 } else { 16.0 }
    }

    fn shown(&self, sees: bool) -> f64 {
        if sees { self.lamp() * 4.0 } else { self.lamp() }
    }

    fn span(&self) -> f64 {
        self.lane_width() - self.labels()
    }

    fn scale(&self) -> f64 {
        let most = match (self.lanes.len(), self.columns()) {
            (1, _) => 16.0,
            (_, 1) => 10.0,
            _ if self.is_dense() => return 3.0,
            _ => 6.0,
        };
        (120.0 / self.largest as f64).clamp(5.0, most)
    }

    /// Whole pixels, so that the edges of the ground are sharp.
    fn lane_height(&self) -> f64 {
        let high = self.ground.heights().into_iter().max().map_or(0.0, f64::from);
        ((self.largest as f64 * 1.25 + 0.5 + high) * self.scale()).round() + 26.0
    }

    fn left(&self, lane: usize) -> f64 {
        (lane / self.rows()) as f64 * self.lane_width()
    }

    fn ground(&self, lane: usize) -> f64 {
        HEAD + ((lane % self.rows()) as f64 + 1.0) * self.lane_height() - 16.0
    }

    fn top(&self, lane: usize) -> f64 {
        self.ground(lane) - self.lane_height() + 16.0
    }

    fn backdrop(&self, sees: bool) -> Svg {
        let width = self.lane_width() * self.columns() as f64;
        let height = HEAD + self.lane_height() * self.rows() as f64 + FOOT;
        let mut svg = Svg::new(width, height, &self.title);
        svg.text((14.0, 22.0), &self.title, Type::new(14.0).bold());
        let legend = Type::new(10.0).colored(Color::GRAY).anchored(Anchor::End);
        let shown = if sees { "left: the image" } else { "squares: stimuli 1, 2" };
        svg.text((width - 10.0, 21.0), &format!("{shown}; long ticks: 5 voxels"), legend);
        for (lane, name) in self.lanes.iter().enumerate() {
            let (left, ground) = (self.left(lane), self.ground(lane));
            let top = self.top(lane);
            svg.rect((left + self.labels(), top), self.span(), ground - top, Paint::fill(Color::SKY));
            svg.rect((left + self.labels(), ground), self.span(), GROUND, Paint::fill(Color::GROUND));
            let (letters, size) = if self.is_dense() { (13, 7.0) } else { (15, 11.0) };
            let above = self.shown(sees) + self.lamp() / 2.0;
            svg.text((left + self.lamp() - 2.0, ground - above), &shorten(name, letters), Type::new(size));
        }
        svg
    }
}

fn fill_rect(frame: &mut Pixmap, (x, y): (f64, f64), width: f64, height: f64, color: Color) {
    let mut paint = solid(color, 1.0);
    paint.anti_alias = false;
    if let Some(rect) = Rect::from_xywh(x as f32, y as f32, width as f32, height as f32) {
        frame.fill_rect(rect, &paint, Transform::identity(), None);
    }
}

/// Small robots have no `smooth` edges: they blur, and make a film half as large again.
fn paint_pose(
    frame: &mut Pixmap,
    pose: &Pose,
    looks: &Looks,
    smooth: bool,
    to_pixel: impl Fn((f64, f64)) -> (f64, f64),
) {
    let paint = |color| tiny_skia::Paint { anti_alias: smooth, ..solid(color, 1.0) };
    let mut shapes: BTreeMap<u8, PathBuilder> = BTreeMap::new();
    for (corners, code) in &pose.voxels {
        let path = shapes.entry(*code).or_default();
        for (i, &corner) in corners.iter().enumerate() {
            let (x, y) = to_pixel(corner);
            if i == 0 { path.move_to(x as f32, y as f32) } else { path.line_to(x as f32, y as f32) }
        }
        path.close();
    }
    for (code, shape) in shapes {
        // Voxels whose corners are not finite have no path.
        let Some(path) = shape.finish() else { continue };
        let Look { color, mark } = looks.look(&pose.palette, code);
        frame.fill_path(&path, &paint(color), FillRule::Winding, Transform::identity(), None);
        let edge = paint(color.mix(Color::BLACK, 0.5));
        frame.stroke_path(&path, &edge, &Stroke { width: 0.8, ..Stroke::default() }, Transform::identity(), None);
        let Some(mark) = mark else { continue };
        for (corners, _) in pose.voxels.iter().filter(|(_, own)| *own == code) {
            draw_mark(&mark, &corners.map(&to_pixel), |polygon, color| {
                ink_path(frame, line(polygon, true), &Paint::fill(color), Transform::identity());
            });
        }
    }
}

/// The smallest rectangle around all changed pixels; the others in it are [`UNCHANGED`], which compresses well.
fn patch(old: &[u8], fresh: &[u8], width: u32, height: u32) -> Patch {
    if old.len() != fresh.len() {
        return Patch { left: 0, top: 0, width, height, pixels: fresh.to_vec() };
    }
    let row = width as usize;
    let [left, top, right, bottom] = changed(old, fresh, row).unwrap_or_default();
    let pixel = |at: usize| if old[at] == fresh[at] { UNCHANGED } else { fresh[at] };
    let pixels = (top..=bottom).flat_map(|y| (y * row + left..=y * row + right).map(pixel)).collect();
    let (wide, high) = ((right - left + 1) as u32, (bottom - top + 1) as u32);
    Patch { left: left as u32, top: top as u32, width: wide, height: high, pixels }
}

/// Left, top, right and bottom of the changes.
fn changed(old: &[u8], fresh: &[u8], row: usize) -> Option<[usize; 4]> {
    let rows = old.chunks(row).zip(fresh.chunks(row)).enumerate();
    let differing = rows.filter(|(_, (old, fresh))| old != fresh);
    let spans = differing.filter_map(|(y, (old, fresh))| {
        let differs = |x: &usize| old[*x] != fresh[*x];
        Some((y, (0..row).find(differs)?, (0..row).rfind(differs)?))
    });
    spans.fold(None, |found: Option<[usize; 4]>, (y, first, last)| {
        let [left, top, right, _] = found.unwrap_or([first, y, last, y]);
        Some([left.min(first), top, right.max(last), y])
    })
}

pub fn write_gif(film: &Film, stage: Stage, out: &mut dyn Write, observe: &mut dyn FnMut(usize)) -> io::Result<()> {
    let mut painter = Painter::new(film, &stage);
    let (width, height) = painter.size();
    let last = stage.moments().saturating_sub(1).max(1) as f64;
    let side = |pixels: u32| u16::try_from(pixels).map_err(|_| io::Error::other("too many robots for one film"));
    let mut encoder =
        gif::Encoder::new(out, side(width)?, side(height)?, &painter.swatches.bytes()).map_err(io_error)?;
    encoder.set_repeat(gif::Repeat::Infinite).map_err(io_error)?;
    for (i, moment) in stage.enumerate() {
        let patch = painter.paint(&moment, i as f64 / last);
        let frame = gif::Frame {
            delay: DELAY,
            transparent: Some(UNCHANGED),
            left: patch.left as u16,
            top: patch.top as u16,
            width: patch.width as u16,
            height: patch.height as u16,
            buffer: patch.pixels.into(),
            ..gif::Frame::default()
        };
        encoder.write_frame(&frame).map_err(io_error)?;
        observe(i + 1);
    }
    Ok(())
}

pub fn write_apng(film: &Film, stage: Stage, out: &mut dyn Write, observe: &mut dyn FnMut(usize)) -> io::Result<()> {
    let mut painter = Painter::new(film, &stage);
    let (width, height) = painter.size();
    let moments = stage.moments();
    let mut encoder = png::Encoder::new(out, width, height);
    encoder.set_color(png::ColorType::Indexed);
    encoder.set_palette(painter.swatches.bytes());
    encoder.set_trns((0..=UNCHANGED).map(|color| if color == UNCHANGED { 0 } else { 255 }).collect::<Vec<u8>>());
    encoder.set_compression(png::Compression::Fast);
    encoder.set_animated(moments as u32, 0)?;
    encoder.set_blend_op(png::BlendOp::Over)?;
    encoder.set_frame_delay(DELAY, 100)?;
    let mut writer = encoder.write_header()?;
    for (i, moment) in stage.enumerate() {
        let patch = painter.paint(&moment, i as f64 / moments.saturating_sub(1).max(1) as f64);
        writer.reset_frame_position()?;
        writer.set_frame_dimension(patch.width, patch.height)?;
        writer.set_frame_position(patch.left, patch.top)?;
        writer.write_image_data(&patch.pixels)?;
        observe(i + 1);
    }
    Ok(writer.finish()?)
}

fn io_error(error: gif::EncodingError) -> io::Error {
    match error {
        gif::EncodingError::Io(error) => error,
        other => io::Error::other(other),
    }
}
