//! Pictures of a circuit and of its swarm's run.

use crate::cli::Failure;
use crate::cli::draw::faults;
use crate::cli::draw::picture::{Drawing, Drawn};
use crate::cli::draw::request::DrawRequest;
use crate::cli::runs::run_page;
use nbc_circuit::formats;
use nbc_session::report::{self, draw_schematic_page};
use nbc_swarm::Room;

pub(super) fn dot(request: &DrawRequest) -> Result<Drawn, Failure> {
    Ok(Drawing::Text(formats::dot::write(&request.compiled()?.mapping.netlist)).into())
}

pub(super) fn schematic(request: &DrawRequest) -> Result<Drawn, Failure> {
    let compiled = request.compiled()?;
    let schematic = compiled.schematic(request.scheme());
    let page = draw_schematic_page(&compiled.assembly, &schematic.pages());
    Ok(Drawing::Sheets { top: schematic.top(), page }.into())
}

pub(super) fn vcd(request: &DrawRequest) -> Result<Drawn, Failure> {
    let ran = request.ran(None)?;
    let trace = &ran.swarm().trace;
    Ok(Drawn { drawing: Drawing::Text(report::vcd(trace)), faults: faults::of_swarm(trace) })
}

pub(super) fn page(request: &DrawRequest) -> Result<Drawn, Failure> {
    let ran = request.ran(Some(Room::SWARM))?;
    let page = run_page(&request.what, &ran, request.scheme());
    Ok(Drawn { drawing: Drawing::Text(page), faults: faults::of_swarm(&ran.swarm().trace) })
}
