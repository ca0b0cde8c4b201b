//! Bodies and materials as Python has them: codes in reading order, body after body, and a shape for each.

use std::sync::Arc;

use nbc::{Body, MemoryWorld, Palette, Scheme, Session};
use numpy::{PyReadonlyArray1, PyReadonlyArray2};
use pyo3::prelude::*;

use crate::errors::bad_value;
use crate::work::at_once;

/// The palette of these materials, as JSON; the paper's if there are none.
pub fn palette(materials: Option<&str>) -> PyResult<Arc<Palette>> {
    let Some(text) = materials else { return Ok(Palette::paper()) };
    let read: Result<Palette, _> = serde_json::from_str(text);
    read.map(Arc::new).map_err(|error| bad_value(format!("materials: {}", without_place(&error.to_string()))))
}

/// A message of the JSON reader without its place in a text that the user never saw.
fn without_place(message: &str) -> &str {
    message.rfind(" at line ").map_or(message, |at| &message[..at])
}

/// Reads bodies of a palette, each in one piece.
///
/// # Errors
/// The first body that is invalid, by its index.
pub fn bodies(
    codes: &PyReadonlyArray1<'_, u8>,
    shapes: &PyReadonlyArray2<'_, u64>,
    palette: &Arc<Palette>,
) -> PyResult<Vec<Body>> {
    let mut rest = codes.as_slice()?;
    let mut bodies = Vec::new();
    for (i, shape) in shapes.as_array().outer_iter().enumerate() {
        let (height, width) = (shape[0] as usize, shape[1] as usize);
        let (own, others) = rest.split_at_checked(height * width).ok_or_else(|| bad_value("too few codes"))?;
        rest = others;
        let body = Body::from_codes(width, height, own, palette);
        let body = body.map_err(|error| bad_value(format!("bodies[{i}]: {error}")))?;
        if !body.is_connected() {
            return Err(bad_value(format!("bodies[{i}]: the body is not in one piece")));
        }
        bodies.push(body);
    }
    Ok(bodies)
}

/// Checks bodies as a simulation in the paper's world does.
#[pyfunction]
pub fn check_bodies(
    py: Python<'_>,
    codes: PyReadonlyArray1<'_, u8>,
    shapes: PyReadonlyArray2<'_, u64>,
) -> PyResult<()> {
    at_once(py, || bodies(&codes, &shapes, &Palette::paper()).map(|_| ()))
}

/// Why each body cannot be tried in an evolution; empty for those that can.
#[pyfunction]
pub fn invalid_bodies(
    py: Python<'_>,
    codes: PyReadonlyArray1<'_, u8>,
    shapes: PyReadonlyArray2<'_, u64>,
    materials: Option<&str>,
) -> PyResult<Vec<String>> {
    let palette = palette(materials)?;
    let mut rest = codes.as_slice()?;
    let reason = |shape: numpy::ndarray::ArrayView1<'_, u64>| {
        let (height, width) = (shape[0] as usize, shape[1] as usize);
        let (own, others) = rest.split_at_checked(height * width).ok_or_else(|| bad_value("too few codes"))?;
        rest = others;
        let reason = match Body::from_codes(width, height, own, &palette) {
            Err(error) => error.to_string(),
            Ok(body) => nbc::validate(&body).err().map_or_else(String::new, |reason| reason.to_string()),
        };
        Ok(reason)
    };
    at_once(py, || shapes.as_array().outer_iter().map(reason).collect())
}

/// The paper's materials, as JSON.
#[pyfunction]
pub fn paper_materials() -> String {
    serde_json::to_string(&*Palette::paper()).expect("materials can be written as JSON")
}

/// The robots of the library, as JSON.
#[pyfunction]
pub fn shipped_robots() -> String {
    let session = Session::new(MemoryWorld::default());
    let record = |robot: &nbc::Robot| {
        serde_json::json!({
            "name": robot.name,
            "function": robot.function().name(),
            "behavior": robot.behavior,
            "body": robot.body.rows(),
            "materials": &**robot.body.palette(),
            "displacement": robot.displacement,
            "character": robot.character,
            "provenance": robot.provenance,
        })
    };
    session.shipped().robots.iter().map(record).collect::<serde_json::Value>().to_string()
}

/// The picture of a body as SVG.
#[pyfunction]
pub fn draw_body(
    py: Python<'_>,
    title: &str,
    codes: PyReadonlyArray1<'_, u8>,
    shapes: PyReadonlyArray2<'_, u64>,
    materials: Option<&str>,
    safe_colors: bool,
) -> PyResult<String> {
    at_once(py, || {
        let bodies = bodies(&codes, &shapes, &palette(materials)?)?;
        let body = bodies.first().ok_or_else(|| bad_value("expected one body"))?;
        Ok(nbc::draw_portrait(title, body, scheme(safe_colors)).finish())
    })
}

/// The color scheme.
pub fn scheme(safe_colors: bool) -> Scheme {
    if safe_colors { Scheme::Safe } else { Scheme::Paper }
}
