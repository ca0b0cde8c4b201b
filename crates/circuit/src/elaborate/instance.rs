//! Parameters of a call: given, inferred from the widths of the operands, or by default.

use crate::elaborate::build::Builder;
use crate::elaborate::size;
use crate::elaborate::wording;
use nbc_base::budget::Limit;
use nbc_base::diag::Diagnostic;
use nbc_base::model::{Circuit, CircuitId, Size, SizeKind};
use nbc_base::source::Span;

impl Builder<'_> {
    pub(super) fn arguments(
        &mut self,
        circuit: CircuitId,
        given: Vec<Option<i128>>,
        operands: &[Option<u32>],
        span: Span,
    ) -> Option<Vec<i128>> {
        self.take(Limit::Steps, cost(self.circuit(circuit)), span)?;
        let arguments = arguments(self.circuit(circuit), given, operands, span);
        arguments.map_err(|fault| self.fault(fault)).ok()
    }
}

pub(super) fn cost(circuit: &Circuit) -> u64 {
    let ports = &circuit.nets[..circuit.inputs + circuit.outputs];
    let defaults = circuit.parameters.iter().filter_map(|parameter| parameter.default);
    let sizes = defaults.chain(ports.iter().filter_map(|net| net.width));
    let parts = sizes.map(|size| u64::from(size.0 - Size::first_part(&circuit.sizes, size).0) + 1);
    ports.len() as u64 + parts.sum::<u64>()
}

pub(super) fn arguments(
    circuit: &Circuit,
    mut given: Vec<Option<i128>>,
    operands: &[Option<u32>],
    span: Span,
) -> Result<Vec<i128>, Diagnostic> {
    for (net, width) in circuit.nets.iter().zip(operands) {
        let kind = net.width.map(|size| circuit.sizes[size.0 as usize].kind);
        if let (Some(SizeKind::Variable(slot)), Some(width)) = (kind, width) {
            given[slot as usize].get_or_insert(i128::from(*width));
        }
    }
    let mut values = Vec::new();
    for (parameter, given) in circuit.parameters.iter().zip(given) {
        let value = match (given, parameter.default) {
            (Some(value), _) => value,
            (None, Some(default)) => size::value(&circuit.sizes, default, &values)?,
            (None, None) => {
                return Err(wording::unknown_parameter(&circuit.name, &parameter.name, span));
            }
        };
        values.push(value);
    }
    Ok(values)
}

pub(super) fn output_widths(circuit: &Circuit, arguments: &[i128]) -> Option<Vec<u32>> {
    (circuit.inputs..circuit.inputs + circuit.outputs).map(|net| port_width(circuit, net, arguments)).collect()
}

pub(super) fn port_width(circuit: &Circuit, net: usize, arguments: &[i128]) -> Option<u32> {
    let Some(width) = circuit.nets[net].width else { return Some(1) };
    u32::try_from(size::value(&circuit.sizes, width, arguments).ok()?).ok()
}
