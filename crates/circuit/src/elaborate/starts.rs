//! Start values: which modules have memory, and nets whose start value is not that of the memory that drives them.

use crate::elaborate::build::{Builder, ModuleBuilder};
use crate::elaborate::module::{Bit, Module, ModuleId, ModuleSignal};
use crate::elaborate::wording;
use nbc_base::budget::Limit;

impl Builder<'_> {
    pub(super) fn has_memory(&self, top: ModuleId) -> bool {
        let mut seen = vec![false; self.modules.len()];
        let mut open = vec![top];
        while let Some(id) = open.pop() {
            let module = self.module(id);
            if !module.starts.is_empty() {
                return true;
            }
            if !std::mem::replace(&mut seen[id.0 as usize], true) {
                open.extend(module.sites.iter().map(|site| site.module));
            }
        }
        false
    }

    /// Through nets and outputs of circuits inside; `steps` counts these.
    fn start_of(&self, module: &Module, bit: Bit, steps: &mut u64) -> Option<bool> {
        let (mut module, mut at, mut nets) = (module, bit, 0);
        // A net that is driven by itself has an error of its own.
        while nets <= module.signals.len() {
            nets += 1;
            *steps += 2;
            match module.signals[at as usize] {
                ModuleSignal::Net { driver, .. } => match module.start(at) {
                    Some(start) => return Some(start),
                    None => at = driver?.get(),
                },
                ModuleSignal::Output { site, bit } => {
                    module = self.module(module.sites[site as usize].module);
                    (at, nets) = (module.output_bits[bit as usize], 0);
                }
                ModuleSignal::Input(_)
                | ModuleSignal::Constant(_)
                | ModuleSignal::Gate { .. }
                | ModuleSignal::Register { .. } => return None,
            }
        }
        None
    }
}

impl ModuleBuilder<'_, '_> {
    pub(super) fn contradicting_starts(&mut self) {
        self.module.starts.sort_unstable();
        let mut items: Vec<u32> = Vec::new();
        for at in 0..self.module.starts.len() {
            let (bit, start) = self.module.starts[at];
            let ModuleSignal::Net { driver: Some(driver), by, .. } = self.module.signals[bit as usize] else {
                continue;
            };
            let mut steps = 0;
            let own = self.builder.start_of(&self.module, driver.get(), &mut steps);
            if self.take(Limit::Steps, steps).is_none() {
                return;
            }
            if own.is_some_and(|own| own != start) {
                items.push(by);
            }
        }
        items.dedup();
        for item in items {
            let target = self.items[item as usize].targets.iter().find(|target| target.start.is_some());
            let Some((span, net)) = target.and_then(|target| Some((target.span, target.net?))) else { continue };
            self.fault(wording::other_start(&self.circuit.nets[net.0 as usize].name, span));
        }
    }
}
