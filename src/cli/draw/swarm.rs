//! Pictures of the swarm of a file's first test.

use crate::circuit::formats::dot;
use crate::cli::draw::Arguments;
use crate::cli::draw::canvas::Canvas;
use crate::cli::draw::kind::Kind;
use crate::cli::draw::several::{One, Several};
use crate::cli::run::run_page;
use crate::cli::{Failure, Progress};
use crate::diag::{Code, Diagnostic};
use crate::model::Robot;
use crate::pipeline::{self, Loaded, Options, TestRun};
use crate::report::{self, Film, STRIDE, Stage, Svg};
use crate::store::DiskWorld;

impl Arguments {
    pub(super) fn draw_swarm(&self, canvas: &Canvas) -> Result<(), Failure> {
        match self.kind {
            Kind::Comparison | Kind::Heatmap | Kind::Progress => {
                Err(self.not_of("a source file", "the folder of a run"))
            }
            Kind::Pose | Kind::Strip => Err(self.not_of("a source file", "a robot")),
            _ => self.draw_test(canvas, &self.run_first_test()?),
        }
    }

    fn draw_test(&self, canvas: &Canvas, run: &TestRun) -> Result<(), Failure> {
        let assembly = &run.compiled.assembly;
        let robots: Vec<&Robot> = assembly.members.iter().map(|member| &member.robot).collect();
        match self.kind {
            Kind::Schematic => {
                let (netlist, path) = (&run.compiled.mapped, &run.compiled.timing.critical_path);
                canvas.picture(&report::draw_schematic(netlist, &robots, path, self.scheme()))
            }
            Kind::Dot => canvas.bytes(dot::write(&run.compiled.mapped).as_bytes()),
            Kind::Vcd => canvas.bytes(report::vcd(&run.trace).as_bytes()),
            Kind::Report => canvas.bytes(run_page(&self.what, std::slice::from_ref(run), self.scheme()).as_bytes()),
            Kind::Sprite => self.draw_several(canvas, &cast(run)),
            Kind::Apng | Kind::Gif => {
                let largest = robots.iter().map(|robot| robot.body.width().max(robot.body.height())).max().unwrap_or(1);
                let lanes =
                    assembly.members.iter().map(|member| format!("{} ({})", member.net, member.robot.function()));
                let title = assembly.circuit.clone();
                let film = Film { title, lanes: lanes.collect(), scheme: self.scheme(), largest };
                canvas.film(&film, Stage::of_swarm(assembly, &run.trace, STRIDE))
            }
            _ => canvas.picture(&self.diagram(run)?),
        }
    }

    fn diagram(&self, run: &TestRun) -> Result<Svg, Failure> {
        if self.robots.is_empty() {
            return Ok(report::draw_swarm(&run.trace));
        }
        let chosen = self.robots.iter().map(|net| robot_of(run, net)).collect::<Result<Vec<usize>, _>>()?;
        Ok(report::draw_chosen(&run.trace, &chosen))
    }

    /// The file's first test, run in full physics.
    fn run_first_test(&self) -> Result<TestRun, Failure> {
        let Loaded { sources, checked } = pipeline::load(&DiskWorld, &self.what);
        if checked.has_errors() {
            return Err(Failure::input(checked.diagnostics, sources));
        }
        let Some(test) = checked.program.tests.first() else {
            let message = format!("`{}` declares no test, so there is no swarm to draw", self.what);
            return Err(Failure::plain(Diagnostic::without_place(Code::Empty, message)));
        };
        let bar = Progress::new("simulating", 0);
        pipeline::run_test(&checked.program, test, &Options::default(), &mut |done, all| {
            bar.set_total(all as u64);
            bar.set(done as u64);
        })
        .map_err(|faults| Failure::input(faults, sources))
    }
}

/// The place of the robot that drives a net.
fn robot_of(run: &TestRun, net: &str) -> Result<usize, Failure> {
    let robots = &run.trace.robots;
    robots.iter().position(|robot| robot.net == net).ok_or_else(|| {
        let known: Vec<String> = robots.iter().map(|robot| format!("`{}`", robot.net)).collect();
        let fault = Diagnostic::without_place(Code::Unknown, format!("no robot drives `{net}`"));
        Failure::plain(fault.with_help(format!("the robots drive {}", known.join(", "))))
    })
}

/// The robots of a swarm, each once.
fn cast(run: &TestRun) -> Several {
    let mut robots: Vec<One> = Vec::new();
    for member in &run.compiled.assembly.members {
        let robot = &member.robot;
        if robots.iter().all(|one| one.name != robot.name) {
            robots.push(One { behavior: robot.behavior, name: robot.name.clone(), body: robot.body.clone() });
        }
    }
    Several { title: format!("the robots of {}", run.compiled.assembly.circuit), robots }
}
