//! The robots with which an evolution begins: those of its library that fit into its box.

use crate::checked::Checked;
use crate::wording;
use nbc_base::diag::{Diagnostic, Diagnostics};
use nbc_base::model::{Body, Evolution, Palette, StartBodies};

impl Checked {
    /// `runs` is the folder of other evolutions' runs.
    pub fn started(&self, evolution: &Evolution, runs: &str) -> Result<Evolution, Diagnostics> {
        self.diagnosed(self.with_start(evolution, runs))
    }

    pub(super) fn with_start(&self, evolution: &Evolution, runs: &str) -> Result<Evolution, Vec<Diagnostic>> {
        let declared = evolution.start.as_ref().and_then(|start| self.program.library(&start.library));
        let Some(declared) = declared else { return Ok(evolution.clone()) };
        let robots = self.library(declared, runs)?.robots;
        let placed = robots.iter().filter_map(|robot| placed(&robot.body, evolution));
        let bodies: Vec<Vec<String>> = placed.map(|body| body.rows()).collect();
        if bodies.is_empty() {
            return Err(vec![wording::no_start_body(&evolution.name, &declared.name, declared.span)]);
        }
        let start = StartBodies { library: declared.name.clone(), bodies };
        Ok(Evolution { start: Some(start), ..evolution.clone() })
    }
}

/// A body on the ground in the middle of the evolution's box; `None` if it does not fit, or has other materials.
fn placed(body: &Body, evolution: &Evolution) -> Option<Body> {
    let Evolution { width, height, palette, .. } = evolution;
    let (above, left) = (height.checked_sub(body.height())?, width.checked_sub(body.width())? / 2);
    let mut codes = vec![0; width * height];
    for row in 0..body.height() {
        for column in 0..body.width() {
            codes[(above + row) * width + left + column] = code(body, body.code(row, column), palette)?;
        }
    }
    Some(Body::new(*width, *height, codes, palette.clone()))
}

fn code(body: &Body, code: u8, palette: &Palette) -> Option<u8> {
    let Some(place) = usize::from(code).checked_sub(1) else { return Some(0) };
    let material = &body.palette().materials()[place];
    palette.materials().iter().position(|other| other.kind == material.kind).map(|place| place as u8 + 1)
}
