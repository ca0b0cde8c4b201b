//! What is known of circuits that were built.

use crate::elaborate::build::Builder;
use nbc_base::budget::OverBudget;
use nbc_base::diag::Diagnostic;
use nbc_base::model::Instance;
use nbc_base::source::Span;

#[derive(Clone, Debug, Default)]
pub struct Inspection {
    pub diagnostics: Vec<Diagnostic>,
    pub widths: NetWidths,
    pub instances: Vec<Instance>,
    /// Whether it ended early, so that a part of the result is missing.
    pub is_cancelled: bool,
}

impl Inspection {
    pub(super) fn of(builder: Builder<'_>) -> Self {
        let nets = builder.modules.iter().flat_map(|module| &module.nets);
        let widths = NetWidths::new(nets.filter_map(|net| Some((net.span, net.width?))));
        let instances = builder.instances().collect();
        let is_cancelled = builder.over == Some(OverBudget::Cancelled);
        Self { diagnostics: builder.diagnostics, widths, instances, is_cancelled }
    }
}

/// The widths of nets, by the places of their declarations. A net of a circuit with parameters may have several.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct NetWidths {
    list: Vec<(Span, u32)>,
}

impl NetWidths {
    fn new(widths: impl Iterator<Item = (Span, u32)>) -> Self {
        let mut list: Vec<_> = widths.collect();
        list.sort_unstable();
        list.dedup();
        Self { list }
    }

    /// The widths of a net, in order; none if its circuit was not built.
    pub fn of(&self, declared: Span) -> impl Iterator<Item = u32> + '_ {
        let start = self.list.partition_point(|(place, _)| *place < declared);
        self.list[start..].iter().take_while(move |(place, _)| *place == declared).map(|(_, width)| *width)
    }
}
