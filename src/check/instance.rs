//! Circuits named by tests and swarms, with numbers for their parameters.

use crate::check::circuit::Headers;
use crate::check::expression::parameter_place;
use crate::check::names::{Home, Names};
use crate::diag::{Code, Diagnostic, suggest};
use crate::model::{Instance, Program};
use crate::source::{FileId, Sources};
use crate::syntax::parse_instance;
use crate::syntax::tree::{self, SizeKind};

/// A circuit with numbers for its parameters.
pub(crate) fn instance(
    source: &tree::Instance,
    home: Home,
    names: &Names,
    headers: &Headers,
) -> Result<Instance, Diagnostic> {
    let header = &headers.circuits[names.resolve(&source.name, home)?];
    with_numbers(source, &header.name, &header.parameters)
}

/// The circuit named in a text such as `adder[8]` on a command line.
///
/// # Errors
/// When the text is not the name of a circuit with numbers for its parameters.
pub fn named(program: &Program, sources: &Sources, file: FileId) -> Result<Instance, Diagnostic> {
    let source = parse_instance(sources, file)?;
    let name = source.name.text.as_str();
    let circuit = program.circuit(name).ok_or_else(|| {
        let fault =
            Diagnostic::new(Code::Unknown, format!("no circuit is called `{name}`"), source.name.span, "not declared");
        match suggest::help(name, program.circuits.iter().map(|circuit| circuit.name.as_str())) {
            Some(help) => fault.with_help(help),
            None => fault,
        }
    })?;
    let parameters: Vec<String> = circuit.parameters.iter().map(|parameter| parameter.name.clone()).collect();
    with_numbers(&source, &circuit.name, &parameters)
}

/// A circuit whose parameters have these names, with the given numbers for them.
fn with_numbers(source: &tree::Instance, circuit: &str, parameters: &[String]) -> Result<Instance, Diagnostic> {
    let mut values = vec![None; parameters.len()];
    for (place, argument) in source.arguments.iter().enumerate() {
        let place = parameter_place(&source.name, parameters, place, argument)?;
        values[place] = Some(literal(&source.sizes[argument.value.0 as usize])?);
    }
    let given = values.iter().rposition(Option::is_some).map_or(0, |last| last + 1);
    let arguments: Option<Vec<u64>> = values[..given].iter().copied().collect();
    match arguments {
        Some(arguments) => Ok(Instance { circuit: circuit.to_owned(), arguments }),
        None => {
            let missing = values.iter().position(Option::is_none).unwrap_or_default();
            let message = format!("`{}` without its parameter `{}`", source.name.text, parameters[missing]);
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
