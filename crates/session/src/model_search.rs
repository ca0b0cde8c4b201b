//! Models of other tools, decided.

use crate::claim_report::ClaimReport;
use nbc_circuit::CancelFlag;
use nbc_circuit::formats::AigerModel;
use nbc_circuit::properties::{PropertySearch, SearchBudget};

/// The properties of a model that are being decided.
pub struct ModelSearch {
    file: String,
    model: AigerModel,
    search: PropertySearch,
}

impl ModelSearch {
    /// A search that has done nothing yet; `file` is where the model comes from.
    pub fn new(file: String, model: AigerModel, budget: SearchBudget, cancel: CancelFlag) -> Self {
        let search = PropertySearch::new(model.system.clone(), budget, cancel);
        Self { file, model, search }
    }

    /// Does a portion of the search; whether there is more to do.
    pub fn advance(&mut self) -> bool {
        self.search.advance();
        !self.search.is_done()
    }

    /// The properties that are decided, and all of them.
    pub fn progress(&self) -> [usize; 2] {
        [self.search.decided(), self.model.properties.len()]
    }

    /// The first steps in which no undecided property is violated.
    pub fn steps(&self) -> usize {
        self.search.steps()
    }

    /// What is known now.
    pub fn finish(self) -> ClaimReport {
        ClaimReport::of_model(&self.file, &self.model, &self.search.verdicts(), self.search.work())
    }
}
