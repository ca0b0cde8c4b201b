//! Records that take the fields they lack from another of their kind, named by `from`.

use crate::check::fields;
use crate::check::names::{Home, NameTable};
use crate::check::wording;
use crate::syntax::tree::{RecordDeclaration, ValueSyntax};
use nbc_base::diag::Diagnostic;

#[derive(Clone, Debug)]
pub(crate) enum CheckState<T> {
    /// Not checked yet. A record that names it now closes a circle.
    Open,
    Faulty,
    Sound(Box<T>),
}

/// Positions of records, each after the one that its `from` names, else after the `usual` one, as far as possible.
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
            let name = match from {
                Some(field) => fields::name(&field.value, names.kind.word()).ok().map(|name| name.text.as_str()),
                None => usual,
            };
            at = name.and_then(|name| names.find(name, home));
        }
        order.extend(chain.into_iter().rev());
    }
    order
}

pub(crate) fn base<'a, T>(
    value: &ValueSyntax,
    home: Home,
    names: &NameTable,
    checked: &'a [CheckState<T>],
) -> Result<&'a CheckState<T>, Diagnostic> {
    let kind = names.kind.word();
    let name = fields::name(value, kind)?;
    let found = &checked[names.resolve(name, home)?];
    if matches!(found, CheckState::Open) {
        return Err(wording::circular_record(kind, name));
    }
    Ok(found)
}
