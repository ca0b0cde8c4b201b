//! The interface of a circuit.

use crate::figures::Subject;
use crate::files::Files;
use nbc_base::diag::counted;
use nbc_base::model::{Circuit, Instance, Net};
use nbc_base::source::Span;

pub(super) fn text(files: &Files<'_>, declared: Span) -> (Option<String>, Option<Subject>) {
    let Some(circuit) = files.checked.program.circuits.iter().find(|circuit| circuit.span == declared) else {
        return (None, None);
    };
    let subject = instance(files, circuit).map(|instance| Subject::Circuit(instance, None));
    (Some(interface(files, circuit)), subject)
}

pub(super) fn of_swarm(files: &Files<'_>, name: &str) -> Option<Subject> {
    let swarm = files.checked.program.swarm(name)?;
    Some(Subject::Circuit(swarm.circuit.clone(), Some(swarm.name.clone())))
}

/// The circuit with parameters, if a name alone means it.
pub(super) fn instance(files: &Files<'_>, circuit: &Circuit) -> Option<Instance> {
    let checked = files.checked;
    let is_meant = checked.program.circuit(&circuit.name).is_some_and(|found| found.span == circuit.span);
    checked.in_use(circuit).filter(|_| is_meant)
}

fn interface(files: &Files<'_>, circuit: &Circuit) -> String {
    let (inputs, rest) = circuit.nets.split_at(circuit.inputs);
    let port = |net: &Net| match width(files, net.span) {
        Some(bits) if bits != "1 bit" => format!("`{}` ({bits})", net.name),
        _ => format!("`{}`", net.name),
    };
    let ports = |nets: &[Net]| match nets {
        [] => "none".to_owned(),
        nets => nets.iter().map(port).collect::<Vec<_>>().join(", "),
    };
    let mut text = format!("- inputs: {}\n- outputs: {}", ports(inputs), ports(&rest[..circuit.outputs]));
    if !circuit.parameters.is_empty() {
        let names: Vec<_> = circuit.parameters.iter().map(|parameter| format!("`{}`", parameter.name)).collect();
        text.push_str(&format!("\n- parameters: {}", names.join(", ")));
    }
    text
}

pub(super) fn width(files: &Files<'_>, declared: Span) -> Option<String> {
    let widths: Vec<u32> = files.checked.widths.of(declared).collect();
    match &widths[..] {
        [] => None,
        [one] => Some(counted(*one as usize, "bit")),
        several => {
            let words: Vec<String> = several.iter().map(u32::to_string).collect();
            Some(format!("{} bits", words.join(" or ")))
        }
    }
}
