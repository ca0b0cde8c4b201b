//! Pictures and timing of what a session made.

use std::fmt;

use crate::compiled::Compiled;
use crate::mapping::Mapping;
use crate::report::{self, PageSwarm, Schematic, SchematicPages, Scheme, Svg, SwarmOutcome, SwarmTiming};
use crate::run_report::RunReport;
use crate::swarm_run::SwarmRun;
use crate::test::TestRun;
use nbc_base::model::Robot;
use nbc_circuit::timing::PhaseTiming;

impl Compiled {
    pub fn schematic(&self, scheme: Scheme) -> Schematic<'_> {
        let robots: Vec<&Robot> = self.assembly.members.iter().map(|member| &member.robot).collect();
        Schematic::of(&self.mapping.netlist, &robots, &self.timing.critical_path, scheme)
    }

    pub fn swarm_timing(&self) -> SwarmTiming {
        let Mapping { netlist, cells, kept, waves, .. } = &self.mapping;
        let phases = PhaseTiming::of(netlist, &self.timing, cells.kinds_of(netlist), kept);
        let timing = SwarmTiming::of(netlist, &self.timing, &self.assembly, phases);
        waves.iter().fold(timing, SwarmTiming::with_waves)
    }
}

impl RunReport {
    pub fn page(&self, source: &str, scheme: Scheme) -> String {
        let tests = self.tests.iter();
        let tests = tests.filter_map(|run| Some((SwarmOutcome::Test(&run.verdict), run.swarm.as_ref()?)));
        let simulations = self.simulations.iter().map(|run| (SwarmOutcome::Simulation(&run.result), &run.swarm));
        run_page(source, &tests.chain(simulations).collect::<Vec<_>>(), scheme)
    }
}

impl fmt::Display for TestRun {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&report::describe_test(&self.verdict))
    }
}

pub fn run_page(source: &str, runs: &[(SwarmOutcome<'_>, &SwarmRun)], scheme: Scheme) -> String {
    let drawings: Vec<(SchematicPages, Svg)> = runs
        .iter()
        .map(|(_, SwarmRun { compiled, trace })| (compiled.schematic(scheme).pages(), report::draw_swarm(trace)))
        .collect();
    let swarms: Vec<PageSwarm<'_>> = runs
        .iter()
        .zip(&drawings)
        .map(|(&(outcome, SwarmRun { compiled, trace }), (schematic, spacetime))| PageSwarm {
            outcome,
            trace,
            assembly: &compiled.assembly,
            schematic,
            spacetime,
            timing: compiled.swarm_timing().describe(),
        })
        .collect();
    report::draw_run_page(source, &swarms, scheme)
}
