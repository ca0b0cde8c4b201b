//! Bodies and materials as Python has them: codes in reading order, body after body, and a shape for each.

use std::ops::Range;
use std::sync::Arc;

use nbc::{Body, DiskWorld, LocalExecutor, Palette, Scheme, Session, Verified};
use numpy::{PyReadonlyArray1, PyReadonlyArray2};
use pyo3::prelude::*;
use rayon::prelude::*;
use serde_json::{Value, json};

use crate::errors::{bad_value, diagnosed, offering};
use crate::memory::{VOXEL_BYTES, reserved};
use crate::work::{self, Watch, at_once};

/// The most voxels of bodies that are simulated in one go; their points and springs are in memory at the same time.
const GROUP_VOXELS: usize = 500_000;

/// Codes and shapes, not yet read as bodies: some may be invalid.
pub struct Batch {
    codes: Vec<u8>,
    /// Rows and columns of each body, and the place of its first code.
    shapes: Vec<(usize, usize, usize)>,
    palette: Arc<Palette>,
}

impl Batch {
    pub fn read(
        codes: &PyReadonlyArray1<'_, u8>,
        shapes: &PyReadonlyArray2<'_, u64>,
        palette: &Arc<Palette>,
    ) -> PyResult<Self> {
        let found = codes.as_slice()?;
        let rows = shapes.as_array().nrows();
        let mut batch = Self { codes: reserved(found.len())?, shapes: reserved(rows)?, palette: palette.clone() };
        batch.codes.extend_from_slice(found);
        let mut at = 0_usize;
        for shape in shapes.as_array().outer_iter() {
            let (height, width) = (shape[0] as usize, shape[1] as usize);
            batch.shapes.push((height, width, at));
            let end = height.checked_mul(width).and_then(|size| at.checked_add(size));
            at = end.filter(|&end| end <= found.len()).ok_or_else(|| bad_value("too few codes"))?;
        }
        Ok(batch)
    }

    pub fn len(&self) -> usize {
        self.shapes.len()
    }

    /// Places for the voxels of a body.
    pub fn cells(&self, i: usize) -> usize {
        self.shapes[i].0 * self.shapes[i].1
    }

    /// Points that a body has at most.
    pub fn most_points(&self, i: usize) -> usize {
        let (height, width, _) = self.shapes[i];
        (2 * (height + 1) * (width + 1)).min(4 * height * width)
    }

    /// A body in one piece.
    pub fn body(&self, i: usize) -> Result<Body, String> {
        let body = self.any_body(i)?;
        if body.is_connected() { Ok(body) } else { Err("the body is not in one piece".to_owned()) }
    }

    /// A body, which need not be in one piece.
    fn any_body(&self, i: usize) -> Result<Body, String> {
        let (height, width, at) = self.shapes[i];
        let codes = &self.codes[at..at + height * width];
        Body::from_codes(width, height, codes, &self.palette).map_err(|error| error.to_string())
    }

    /// All bodies, each in one piece.
    pub fn all(&self, check: impl Fn(&Body) -> Result<(), String>) -> PyResult<Vec<Body>> {
        let mut bodies = reserved(self.len())?;
        let mut wrong = Vec::new();
        for i in 0..self.len() {
            match self.body(i).and_then(|body| check(&body).map(|()| body)) {
                Ok(body) => bodies.push(body),
                Err(reason) => wrong.push((i, reason)),
            }
        }
        let Some((i, reason)) = wrong.first() else { return Ok(bodies) };
        let others = match wrong.len() {
            1 => String::new(),
            2 => " (and one more body is invalid)".to_owned(),
            many => format!(" (and {} more bodies are invalid)", many - 1),
        };
        Err(bad_value(format!("bodies[{i}]: {reason}{others}")))
    }

    /// Ranges of bodies to be simulated together: at most `most`, and not too many voxels.
    pub fn groups(&self, most: usize) -> Vec<Range<usize>> {
        let (mut groups, mut start, mut voxels) = (Vec::new(), 0, 0);
        for i in 0..self.len() {
            voxels += self.cells(i);
            if i > start && (i - start >= most || voxels > GROUP_VOXELS) {
                groups.push(start..i);
                (start, voxels) = (i, self.cells(i));
            }
        }
        if start < self.len() {
            groups.push(start..self.len());
        }
        groups
    }

    /// The memory for the simulation of some bodies at once, in bytes.
    pub fn bytes(&self, bodies: Range<usize>) -> u64 {
        bodies.map(|i| self.cells(i) as u64 * VOXEL_BYTES).sum()
    }
}

pub fn palette(materials: &str) -> PyResult<Arc<Palette>> {
    let read: Result<Palette, _> = serde_json::from_str(materials);
    read.map(Arc::new).map_err(|error| bad_value(format!("materials: {}", offering(without_place(&error.to_string())))))
}

/// A message of the JSON reader without its place in a text that the user never saw.
fn without_place(message: &str) -> &str {
    message.rfind(" at line ").map_or(message, |at| &message[..at])
}

/// Why each body cannot be tried in an evolution; empty for those that can.
#[pyfunction]
pub fn invalid_bodies(
    py: Python<'_>,
    codes: PyReadonlyArray1<'_, u8>,
    shapes: PyReadonlyArray2<'_, u64>,
    materials: &str,
) -> PyResult<Vec<String>> {
    let palette = palette(materials)?;
    at_once(py, || {
        let batch = Batch::read(&codes, &shapes, &palette)?;
        let reason = |i| match batch.any_body(i) {
            Err(reason) => reason,
            Ok(body) => nbc::validate(&body).err().map_or_else(String::new, |reason| reason.to_string()),
        };
        Ok((0..batch.len()).map(reason).collect())
    })
}

#[pyfunction]
pub fn paper_materials() -> String {
    serde_json::to_string(&*Palette::paper()).expect("materials can be written as JSON")
}

/// The paper's materials and those of a third stimulus, as JSON.
#[pyfunction]
pub fn three_materials() -> String {
    serde_json::to_string(&*Palette::three()).expect("materials can be written as JSON")
}

/// The robots of a library, `shipped`, `three` or a folder, as JSON.
#[pyfunction]
pub fn robots(py: Python<'_>, library: &str) -> PyResult<String> {
    at_once(py, || {
        let read = Session::new(DiskWorld).library(library).map_err(|found| diagnosed(py, &found))?;
        Ok(read.robots.iter().map(robot_record).collect::<Value>().to_string())
    })
}

/// The robots of a library by their names, each with what a new measurement finds different from its file.
#[pyfunction]
pub fn verify(
    py: Python<'_>,
    library: &str,
    progress: Option<Bound<'_, PyAny>>,
) -> PyResult<Vec<(String, Vec<String>)>> {
    let robots = at_once(py, || {
        let read = Session::new(DiskWorld).library(library).map_err(|found| diagnosed(py, &found))?;
        Ok(read.robots)
    })?;
    let watch = Watch::over_parts(robots.len() as u64);
    let found = work::run(py, &watch, progress.as_ref(), move |watch| {
        let executor = LocalExecutor::new(watch.simulator());
        let verify = |(place, robot): (usize, &nbc::Robot)| {
            let verified = Verified::of(&executor, place, robot).filter(|_| !watch.is_stopped())?;
            watch.add(1);
            Some((robot.name.clone(), verified.differs))
        };
        robots.par_iter().enumerate().filter_map(verify).collect::<Vec<_>>()
    })?;
    found.finished()
}

/// A robot as JSON, with the text of its file.
pub fn robot_record(robot: &nbc::Robot) -> Value {
    json!({
        "name": robot.name,
        "function": robot.function().name(),
        "behavior": robot.behavior,
        "body": robot.body.rows(),
        "materials": &**robot.body.palette(),
        "displacement": robot.displacement,
        "character": robot.character,
        "provenance": robot.provenance,
        "file": nbc::print_robot(robot),
    })
}

#[pyfunction]
pub fn draw_body(
    py: Python<'_>,
    title: &str,
    codes: PyReadonlyArray1<'_, u8>,
    shapes: PyReadonlyArray2<'_, u64>,
    materials: &str,
    safe_colors: bool,
) -> PyResult<String> {
    at_once(py, || {
        let bodies = Batch::read(&codes, &shapes, &palette(materials)?)?.all(|_| Ok(()))?;
        let body = bodies.first().ok_or_else(|| bad_value("expected one body"))?;
        Ok(nbc::draw_portrait(title, body, scheme(safe_colors)).finish())
    })
}

pub fn scheme(safe_colors: bool) -> Scheme {
    if safe_colors { Scheme::Safe } else { Scheme::Paper }
}
