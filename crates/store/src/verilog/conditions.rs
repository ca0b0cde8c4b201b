//! Conditions such as `` `ifdef ``, which leave parts of a text out.

/// The conditions that are open, outermost first.
#[derive(Debug, Default)]
pub(super) struct Conditions(Vec<Condition>);

#[derive(Debug)]
struct Condition {
    /// Whether the part that is being read is kept.
    holds: bool,
    /// Whether no later part can be kept: an earlier one was, or none may be.
    is_decided: bool,
}

impl Conditions {
    /// Whether the text that is being read is kept.
    pub(super) fn hold(&self) -> bool {
        self.0.last().is_none_or(|inner| inner.holds)
    }

    /// Whether one has not ended.
    pub(super) fn is_open(&self) -> bool {
        !self.0.is_empty()
    }

    /// The start of a condition.
    pub(super) fn begin(&mut self, holds: bool) {
        let outer = self.hold();
        self.0.push(Condition { holds: outer && holds, is_decided: !outer || holds });
    }

    /// Its next part; `None` if there is no condition.
    pub(super) fn otherwise(&mut self, holds: bool) -> Option<()> {
        let inner = self.0.last_mut()?;
        inner.holds = holds && !inner.is_decided;
        inner.is_decided |= holds;
        Some(())
    }

    /// Its end; `None` if there is no condition.
    pub(super) fn end(&mut self) -> Option<()> {
        self.0.pop().map(|_| ())
    }
}
