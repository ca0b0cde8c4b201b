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
        let mut checks = model.system.clone();
        checks.bad.fill(1);
        let search = PropertySearch::new(model.system.clone(), budget, cancel).with_checks(checks);
        Self { file, model, search }
    }

    /// The search, to be advanced.
    pub fn search(&mut self) -> &mut PropertySearch {
        &mut self.search
    }

    /// What is known now.
    pub fn finish(self) -> ClaimReport {
        ClaimReport::of_model(&self.file, &self.model, &self.search)
    }
}
