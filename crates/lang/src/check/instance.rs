//! Circuits named by tests and swarms, with numbers for their parameters.

use crate::check::circuit::Headers;
use crate::check::constant;
use crate::check::expression::parameter_place;
use crate::check::names::Home;
use crate::check::vocabulary::Vocabulary;
use crate::check::wording;
use crate::syntax::parse_instance;
use crate::syntax::tree::{self, SizeSyntaxKind};
use nbc_base::diag::{Diagnostic, Suggestion};
use nbc_base::model::{Instance, Program};
use nbc_base::source::{FileId, Sources, Span};

pub(crate) fn instance(
    source: &tree::InstanceSyntax,
    home: Home,
    declared: Vocabulary<'_>,
    headers: &Headers,
) -> Result<Instance, Diagnostic> {
    let header = &headers.circuits[declared.names.circuits.resolve(&source.name, home)?];
    declared
        .names
        .circuits
        .note(source.arguments.iter().filter_map(|argument| header.parameter(argument.name.as_ref()?)));
    with_numbers(source, &header.name, &header.parameters, |name, place| declared.integer(name, place, home))
}

/// The circuit named in a text such as `adder[8]` on a command line.
pub fn named(program: &Program, sources: &Sources, file: FileId) -> Result<Instance, Diagnostic> {
    let source = parse_instance(sources, file)?;
    let name = source.name.text.as_str();
    let circuit = program.circuit(name).ok_or_else(|| {
        let meant = Suggestion::of(name, program.circuits.iter().map(|circuit| circuit.name.as_str()));
        wording::unknown("circuit", &source.name, &meant)
    })?;
    let parameters: Vec<String> = circuit.parameters.iter().map(|parameter| parameter.name.clone()).collect();
    with_numbers(&source, &circuit.name, &parameters, |_, _| None)
}

fn with_numbers(
    source: &tree::InstanceSyntax,
    circuit: &str,
    parameters: &[String],
    named: impl Fn(&str, Span) -> Option<Result<i128, Diagnostic>>,
) -> Result<Instance, Diagnostic> {
    let mut values = vec![None; parameters.len()];
    for (place, argument) in source.arguments.iter().enumerate() {
        let place = parameter_place(&source.name, parameters, place, argument)?;
        values[place] = Some(number(&source.sizes[argument.value.0 as usize], &named)?);
    }
    let given = values.iter().rposition(Option::is_some).map_or(0, |last| last + 1);
    let arguments: Option<Vec<u64>> = values[..given].iter().copied().collect();
    match arguments {
        Some(arguments) => Ok(Instance { circuit: circuit.to_owned(), arguments }),
        None => {
            let missing = values.iter().position(Option::is_none).unwrap_or_default();
            Err(wording::missing_parameter(&source.name, &parameters[missing]))
        }
    }
}

fn number(
    size: &tree::SizeSyntax,
    named: impl Fn(&str, Span) -> Option<Result<i128, Diagnostic>>,
) -> Result<u64, Diagnostic> {
    let named = match &size.kind {
        SizeSyntaxKind::Literal(digits) => {
            return constant::integer(digits).ok_or_else(|| wording::large_number(64, size.span));
        }
        SizeSyntaxKind::Name(name) => named(name, size.span).transpose()?,
        _ => None,
    };
    named.and_then(|value| u64::try_from(value).ok()).ok_or_else(|| wording::not_a_number(size.span))
}
