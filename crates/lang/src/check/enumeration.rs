//! Enumerations and integers with names.

use crate::check::constant;
use crate::check::names::Home;
use crate::check::size;
use crate::check::vocabulary::Vocabulary;
use crate::check::wording;
use crate::syntax::tree::{EnumerationSyntax, LetSyntax, MemberSyntax, NameSyntax};
use nbc_base::diag::{Diagnostic, Suggestion};
use nbc_base::model::{Enumeration, EnumerationMember, MemberEncoding};
use nbc_base::source::Span;

pub(crate) fn enumeration(source: &EnumerationSyntax, faults: &mut Vec<Diagnostic>) -> Option<Enumeration> {
    let before = faults.len();
    let encoding = source.encoding.as_ref().map(|word| encoding(word).map_err(|fault| faults.push(fault)));
    if source.members.is_empty() {
        faults.push(wording::empty_enumeration(source.name.span));
    }
    if source.members.len() > MemberEncoding::MOST {
        faults.push(wording::many_members(source.members.len(), MemberEncoding::MOST, source.name.span));
    }
    let given = source.members.iter().filter(|member| member.value.is_some()).count();
    if given > 0
        && let Some(first) = source.members.iter().find(|member| member.value.is_none())
    {
        faults.push(wording::member_without_value(&first.name));
    }
    if let (Some(word), true) = (&source.encoding, given > 0) {
        faults.push(wording::two_encodings(word.span));
    }
    if faults.len() > before {
        return None;
    }
    let encoding = encoding.and_then(Result::ok).unwrap_or_default();
    let (width, values) = match given {
        0 => (encoding.width(source.members.len()), (0..source.members.len()).map(|at| encoding.value(at)).collect()),
        _ => values(&source.members, faults)?,
    };
    let member = |(source, value): (&MemberSyntax, u128)| EnumerationMember {
        name: source.name.text.clone(),
        span: source.name.span,
        value,
    };
    let members: Vec<EnumerationMember> = source.members.iter().zip(values).map(member).collect();
    for (at, member) in members.iter().enumerate() {
        if let Some(first) = members[..at].iter().find(|first| first.value == member.value) {
            faults.push(wording::same_member_value([&first.name, &member.name], first.span, member.span));
        }
    }
    Some(Enumeration { name: source.name.text.clone(), span: source.name.span, width, members })
}

fn encoding(word: &NameSyntax) -> Result<MemberEncoding, Diagnostic> {
    let found = MemberEncoding::WORDS.iter().find(|(_, known)| *known == word.text);
    found.map(|(encoding, _)| *encoding).ok_or_else(|| {
        let meant = Suggestion::of(&word.text, MemberEncoding::WORDS.map(|(_, word)| word));
        wording::unknown("encoding", word, &meant)
    })
}

/// One value with a width gives it to the others.
fn values(members: &[MemberSyntax], faults: &mut Vec<Diagnostic>) -> Option<(u32, Vec<u128>)> {
    let before = faults.len();
    let mut width: Option<(u32, Span)> = None;
    let mut values = Vec::new();
    for word in members.iter().filter_map(|member| member.value.as_ref()) {
        let Some((bits, value)) = constant::sized(&word.text) else {
            faults.push(wording::not_a_constant(word));
            continue;
        };
        match (bits, width) {
            (Some(bits), Some((before, first))) if bits != before => {
                faults.push(wording::member_widths(before, first, bits, word.span));
            }
            (Some(bits), None) => width = Some((bits, word.span)),
            _ => {}
        }
        values.push((value, word));
    }
    let largest = values.iter().map(|(value, _)| *value).max().unwrap_or(0);
    let width = width.map_or((u128::BITS - largest.leading_zeros()).max(1), |(width, _)| width);
    for (value, word) in &values {
        if width < u128::BITS && value >> width != 0 {
            faults.push(wording::wide_member_value(word, width));
        }
    }
    (faults.len() == before).then(|| (width, values.into_iter().map(|(value, _)| value).collect()))
}

pub(crate) fn integer(
    source: &LetSyntax,
    home: Home,
    declared: Vocabulary<'_>,
    faults: &mut Vec<Diagnostic>,
) -> Option<i128> {
    let value = size::value(&source.sizes, |name, place| declared.integer(name, place, home));
    value.map_err(|fault| faults.push(fault)).ok()
}
