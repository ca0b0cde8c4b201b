//! Models of other tools, decided.

use crate::claim_report::ClaimReport;
use nbc_circuit::CancelFlag;
use nbc_circuit::formats::AigerModel;
use nbc_circuit::properties::{PropertySearch, SearchBudget};

pub struct ModelSearch {
    file: String,
    model: AigerModel,
    search: PropertySearch,
}

impl ModelSearch {
    pub fn new(file: String, model: AigerModel, budget: SearchBudget, cancel: CancelFlag) -> Self {
        let mut checks = model.system.clone();
        checks.bad.fill(1);
        let search = PropertySearch::new(model.system.clone(), budget, cancel).with_checks(checks);
        Self { file, model, search }
    }

    pub fn search(&mut self) -> &mut PropertySearch {
        &mut self.search
    }

    pub fn finish(self) -> ClaimReport {
        ClaimReport::of_model(&self.file, &self.model, &self.search)
    }
}
