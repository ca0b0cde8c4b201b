//! Models of other tools, decided.

use crate::decided_claim::DecidedClaim;
use crate::decided_property::DecidedProperty;
use nbc_circuit::CancelFlag;
use nbc_circuit::formats::AigerModel;
use nbc_circuit::properties::{PropertySearch, PropertyVerdict, SearchBudget};

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

    pub fn finish(self) -> DecidedClaim {
        let Self { file, model, search } = self;
        let decided = |(number, (name, verdict)): (usize, (&String, PropertyVerdict))| {
            let empty = search.empty_proof(number).map(|_| "no step satisfies the constraints".to_owned());
            let witness = Some(model.witness(number, &verdict));
            DecidedProperty { witness, ..DecidedProperty::of((&model.system, number), name.clone(), &verdict, empty) }
        };
        let properties = model.properties.iter().zip(search.verdicts()).enumerate().map(decided).collect();
        DecidedClaim { file, line: None, circuit: None, title: None, properties, work: search.work() }
    }
}
