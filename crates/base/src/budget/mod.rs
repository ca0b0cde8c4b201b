//! One budget for everything that an input can expand to. It is checked before anything is expanded, so that a small
//! input cannot take all memory or time of a shared process.

mod limit;
mod wording;

pub use limit::{CYCLE_BITS, Limit};

use crate::source::CancelFlag;
use crate::source::grouped;

#[derive(Clone, Debug)]
pub struct WorkBudget {
    /// By the places of the limits in [`Limit::ALL`].
    used: [u64; Limit::ALL.len()],
    cancel: CancelFlag,
    unseen: u64,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OverBudget {
    Limit(Limit),
    Cancelled,
}

impl Default for WorkBudget {
    fn default() -> Self {
        Self::until(CancelFlag::default())
    }
}

/// What is made between two looks at the flag. Small programs are checked completely.
const BETWEEN_LOOKS: u64 = 1 << 16;

impl WorkBudget {
    pub fn until(cancel: CancelFlag) -> Self {
        Self { used: [0; Limit::ALL.len()], cancel, unseen: 0 }
    }

    pub fn take(&mut self, limit: Limit, amount: u64) -> Result<(), OverBudget> {
        self.unseen = self.unseen.saturating_add(amount);
        if self.unseen > BETWEEN_LOOKS {
            self.unseen = 0;
            if self.cancel.is_raised() {
                return Err(OverBudget::Cancelled);
            }
        }
        if amount > self.left(limit) {
            return Err(OverBudget::Limit(limit));
        }
        self.used[limit as usize] += amount;
        Ok(())
    }

    pub fn left(&self, limit: Limit) -> u64 {
        limit.most() - self.used[limit as usize]
    }
}

impl Limit {
    pub fn permit(self, amount: u64) -> Result<(), OverBudget> {
        if amount <= self.most() { Ok(()) } else { Err(OverBudget::Limit(self)) }
    }

    pub fn row(self) -> String {
        format!("| {} {} | {} |", self.things(), self.scope(), grouped(self.most()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_budget_is_asked_before_anything_is_made() {
        let mut budget = WorkBudget::default();
        let most = Limit::Cells.most();
        assert_eq!(budget.take(Limit::Cells, most), Ok(()));
        assert_eq!(budget.take(Limit::Cells, 1), Err(OverBudget::Limit(Limit::Cells)));
        assert_eq!((budget.take(Limit::Cells, 0), budget.take(Limit::Nets, 1)), (Ok(()), Ok(())));
        assert_eq!(budget.take(Limit::Nets, u64::MAX), Err(OverBudget::Limit(Limit::Nets)));
        assert_eq!(budget.left(Limit::Nets), Limit::Nets.most() - 1);
        assert_eq!(Limit::Width.permit(Limit::Width.most() + 1), Err(OverBudget::Limit(Limit::Width)));
    }

    #[test]
    fn long_work_ends_when_nobody_waits_for_it() {
        let cancel = CancelFlag::default();
        let mut budget = WorkBudget::until(cancel.clone());
        cancel.raise();
        assert_eq!(budget.take(Limit::Steps, 1), Ok(()), "small work is done");
        assert_eq!(budget.take(Limit::Steps, BETWEEN_LOOKS), Err(OverBudget::Cancelled));
    }
}
