//! What the bodies of circuits can name beside nets and parameters.

use crate::check::names::{Home, MemberPlace, Names};
use crate::check::wording;
use nbc_base::diag::Diagnostic;
use nbc_base::model::{Enumeration, EnumerationMember, Program};
use nbc_base::source::Span;

#[derive(Clone, Copy)]
pub(crate) struct Vocabulary<'a> {
    pub(crate) names: &'a Names,
    pub(crate) all: &'a [Enumeration],
}

impl<'a> Vocabulary<'a> {
    pub(crate) fn of(names: &'a Names, program: &'a Program) -> Self {
        Self { names, all: &program.enumerations }
    }

    pub(crate) fn member(&self, name: &str, home: Home) -> Option<(usize, &EnumerationMember)> {
        let MemberPlace { enumeration, member } = self.names.members.find(name, home)?;
        Some((enumeration, &self.all[enumeration].members[member]))
    }

    pub(crate) fn integer(&self, name: &str, place: Span, home: Home) -> Option<Result<i128, Diagnostic>> {
        if let Some((_, member)) = self.member(name, home) {
            self.names.members.refer_to(name, place, home);
            let too_wide = |_| wording::wide_member(name, place);
            return Some(i128::try_from(member.value).map_err(too_wide));
        }
        let value = self.names.integers.find(name, home)?;
        self.names.integers.refer_to(name, place, home);
        Some(Ok(value))
    }
}
