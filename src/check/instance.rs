//! Circuits named outside circuits: by tests and swarms, with numbers for their parameters.

use crate::check::circuit::Headers;
use crate::check::expression::parameter_place;
use crate::check::names::{Home, Names};
use crate::diag::{Code, Diagnostic};
use crate::model::Instance;
use crate::syntax::tree::{self, SizeKind};

/// A circuit with numbers for its parameters.
pub(crate) fn instance(
    source: &tree::Instance,
    home: Home,
    names: &Names,
    headers: &Headers,
) -> Result<Instance, Diagnostic> {
    let header = &headers.circuits[names.resolve(&source.name, home)?];
    let mut values = vec![None; header.parameters.len()];
    for (place, argument) in source.arguments.iter().enumerate() {
        let place = parameter_place(&source.name, &header.parameters, place, argument)?;
        values[place] = Some(literal(&source.sizes[argument.value.0 as usize])?);
    }
    let given = values.iter().rposition(Option::is_some).map_or(0, |last| last + 1);
    let arguments: Option<Vec<u64>> = values[..given].iter().copied().collect();
    match arguments {
        Some(arguments) => Ok(Instance { circuit: header.name.clone(), arguments }),
        None => {
            let missing = values.iter().position(Option::is_none).unwrap_or_default();
            let message = format!("`{}` without its parameter `{}`", source.name.text, header.parameters[missing]);
            Err(Diagnostic::new(
                Code::Operands,
                message,
                source.name.span,
                "parameters before the last one given are needed",
            ))
        }
    }
}

fn literal(size: &tree::Size) -> Result<u64, Diagnostic> {
    match &size.kind {
        SizeKind::Literal(digits) => digits.parse::<u32>().map(u64::from).map_err(|_| {
            Diagnostic::new(Code::OutOfRange, "the number is too large", size.span, "expected at most 4294967295")
        }),
        _ => Err(Diagnostic::new(Code::Value, "a parameter that is no number", size.span, "expected a number")),
    }
}
