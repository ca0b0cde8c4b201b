//! Compiled circuits: netlist, timing, robots, schematic.

use std::sync::Arc;

use nbc::{Checked, Node, Session};
use pyo3::prelude::*;
use serde_json::{Value, json};

use crate::bodies::scheme;
use crate::errors::internal;
use crate::swarm::Swarm;
use crate::work::at_once;

#[pyclass(frozen)]
pub struct Compiled {
    session: Arc<Session>,
    checked: Arc<Checked>,
    compiled: Arc<nbc::Compiled>,
}

impl Compiled {
    pub fn new(session: Arc<Session>, checked: Arc<Checked>, compiled: nbc::Compiled) -> Self {
        Self { session, checked, compiled: Arc::new(compiled) }
    }
}

#[pymethods]
impl Compiled {
    /// Circuit, swarm, ports, proof, robots and warnings, as JSON.
    fn summary(&self, py: Python<'_>) -> PyResult<String> {
        at_once(py, || Ok(self.summary_json()))
    }

    /// Nodes and edges of the netlist of cells, or of the netlist as written, as JSON.
    fn netlist(&self, py: Python<'_>, as_written: bool) -> PyResult<String> {
        at_once(py, || Ok(self.netlist_json(as_written)))
    }

    fn timing(&self, py: Python<'_>) -> PyResult<String> {
        let timing = || serde_json::to_string(&self.compiled.swarm_timing());
        at_once(py, || timing().map_err(|error| internal(py, &error.to_string())))
    }

    fn schematic(&self, py: Python<'_>, safe_colors: bool) -> PyResult<String> {
        at_once(py, || Ok(self.compiled.schematic(scheme(safe_colors)).top().finish()))
    }

    fn swarm(&self, py: Python<'_>) -> PyResult<Swarm> {
        at_once(py, || Ok(Swarm::new(self.session.swarm(&self.compiled))))
    }
}

impl Compiled {
    fn summary_json(&self) -> String {
        let nbc::Compiled { plan, mapping, assembly, warnings, .. } = &*self.compiled;
        let warnings = nbc::Diagnostics { list: warnings.clone(), sources: self.checked.sources.clone() }.findings();
        let robot = |member: &nbc::Member| {
            json!({
                "net": member.net,
                "robot": member.robot.name,
                "function": member.robot.function().name(),
                "behavior": member.robot.behavior,
                "body": member.robot.body.rows(),
                "materials": &**member.robot.body.palette(),
            })
        };
        let summary = json!({
            "circuit": plan.circuit.to_string(),
            "swarm": plan.swarm,
            "window": plan.window,
            "inputs": assembly.inputs,
            "outputs": assembly.outputs,
            "cuts": mapping.proof.cuts,
            "robots": assembly.members.iter().map(robot).collect::<Vec<_>>(),
            "warnings": warnings,
        });
        summary.to_string()
    }

    fn netlist_json(&self, as_written: bool) -> String {
        let mapping = &self.compiled.mapping;
        let netlist = if as_written { &mapping.source } else { &mapping.netlist };
        let node = |id| {
            let (kind, function) = match netlist.node(id) {
                Node::Input(_) => ("input", None),
                Node::Output(_) => ("output", None),
                Node::Constant(_) => ("constant", None),
                Node::Wire { .. } => ("wire", None),
                Node::Cell(cell) => ("cell", Some(cell.function.name())),
                Node::Register(register) => ("register", Some(register.kind.word())),
            };
            json!({ "id": id.index(), "net": netlist.net_name(id), "kind": kind, "function": function })
        };
        let pins =
            |id| (0..).zip(netlist.pins(id)).map(move |(pin, net): (usize, _)| json!([net.index(), id.index(), pin]));
        let edges: Vec<Value> = netlist.ids().flat_map(pins).collect();
        json!({ "name": netlist.name, "nodes": netlist.ids().map(node).collect::<Vec<_>>(), "edges": edges })
            .to_string()
    }
}
