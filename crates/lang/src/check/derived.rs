//! Records that take the fields they lack from another of their kind, named by `from`.

use crate::check::fields;
use crate::check::names::{Home, NameTable};
use crate::check::wording::{Expected, NameError};
use crate::syntax::tree::{RecordDeclaration, ValueSyntax};
use nbc_base::diag::Diagnostic;

/// The state of checking a record.
#[derive(Clone, Debug)]
pub(crate) enum CheckState<T> {
    /// Not yet checked. If another record takes its fields from it at this time, the two form a circle.
    Open,
    /// Invalid; its errors are already reported.
    Faulty,
    /// Valid.
    Sound(Box<T>),
}

/// The positions of records, each after the one named by its `from`, or else after that of the `usual` name, as far as
/// such an order exists. What the usual one is made from comes before it.
pub(crate) fn order(
    sources: &[(Home, &RecordDeclaration)],
    names: &NameTable,
    usual: Option<&'static str>,
) -> Vec<usize> {
    let mut taken = vec![false; sources.len()];
    let mut order = Vec::new();
    let is_usual = |place: &usize| usual == Some(sources[*place].1.name.text.as_str());
    let (first, others): (Vec<usize>, Vec<usize>) = (0..sources.len()).partition(is_usual);
    for start in first.into_iter().chain(others) {
        let mut chain = Vec::new();
        let mut at = Some(start);
        while let Some(place) = at.filter(|&place| !taken[place]) {
            taken[place] = true;
            chain.push(place);
            let (home, source) = sources[place];
            let from = source.record.field("from");
            let word = |value| fields::word(value, Expected::Name(names.kind().word())).ok();
            let name = match from {
                Some(field) => word(&field.value).map(|name| name.text.as_str()),
                None => usual,
            };
            at = name.and_then(|name| names.find(name, home));
        }
        order.extend(chain.into_iter().rev());
    }
    order
}

/// The record named by `from`, of those in `checked`.
pub(crate) fn base<'a, T>(
    value: &ValueSyntax,
    home: Home,
    names: &NameTable,
    checked: &'a [CheckState<T>],
) -> Result<&'a CheckState<T>, Diagnostic> {
    let kind = names.kind().word();
    let name = fields::word(value, Expected::Name(kind))?;
    let found = &checked[names.resolve(name, home)?];
    if matches!(found, CheckState::Open) {
        return Err(NameError::Circular { kind, name: name.text.clone() }.at(name.span));
    }
    Ok(found)
}
