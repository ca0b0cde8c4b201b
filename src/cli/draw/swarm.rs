//! Pictures of the circuits of a source file, and of the swarms of its tests and simulations.

use crate::circuit::formats::dot;
use crate::circuit::is_same_instance;
use crate::cli::Failure;
use crate::cli::draw::arguments::DrawArguments;
use crate::cli::draw::canvas::Canvas;
use crate::cli::draw::kind::Kind;
use crate::cli::draw::several::{One, Several};
use crate::cli::run::{Ran, run_page, run_simulation, run_test};
use crate::cli::wording::DrawError;
use crate::model::{CircuitTest, Instance, Robot};
use crate::report::{self, Film, STRIDE, Stage, Svg};
use crate::session::{self, Checked, CompileOptions, Compiled, Session, SwarmRun};
use crate::store::DiskWorld;
use crate::swarm::{Assembly, Room, SwarmTrace};

impl DrawArguments {
    pub(super) fn draw_program(&self, canvas: &Canvas) -> Result<(), Failure> {
        match self.kind {
            Kind::Comparison | Kind::Heatmap | Kind::Progress => {
                Err(self.not_of("a source file", "the folder of a run"))
            }
            Kind::Pose | Kind::Strip => Err(self.not_of("a source file", "a robot")),
            Kind::Dot | Kind::Schematic | Kind::Sprite => self.draw_circuit(canvas, &self.compiled()?),
            _ => self.draw_ran(canvas, &self.ran()?),
        }
    }

    /// Pictures that need no simulation.
    fn draw_circuit(&self, canvas: &Canvas, compiled: &Compiled) -> Result<(), Failure> {
        match self.kind {
            Kind::Dot => canvas.bytes(dot::write(&compiled.mapping.netlist).as_bytes()),
            Kind::Sprite => self.draw_several(canvas, &cast(&compiled.assembly)),
            _ => {
                let robots: Vec<&Robot> = compiled.assembly.members.iter().map(|member| &member.robot).collect();
                let (netlist, path) = (&compiled.mapping.netlist, &compiled.timing.critical_path);
                canvas.picture(&report::draw_schematic(netlist, &robots, path, self.scheme()))
            }
        }
    }

    fn draw_ran(&self, canvas: &Canvas, ran: &Ran) -> Result<(), Failure> {
        let SwarmRun { compiled, trace } = ran.swarm();
        let assembly = &compiled.assembly;
        match self.kind {
            Kind::Vcd => canvas.bytes(report::vcd(trace).as_bytes()),
            Kind::Report => canvas.bytes(run_page(&self.what, ran, self.scheme()).as_bytes()),
            Kind::Apng | Kind::Gif => {
                let bodies = assembly.members.iter().map(|member| &member.robot.body);
                let largest = bodies.map(|body| body.width().max(body.height())).max().unwrap_or(1);
                let lanes =
                    assembly.members.iter().map(|member| format!("{} ({})", member.net, member.robot.function()));
                let title = assembly.circuit.clone();
                let film = Film { title, lanes: lanes.collect(), scheme: self.scheme(), largest };
                canvas.film(&film, Stage::of_swarm(assembly, trace, STRIDE))
            }
            _ => canvas.picture(&self.diagram(trace)?),
        }
    }

    fn diagram(&self, trace: &SwarmTrace) -> Result<Svg, Failure> {
        if self.robots.is_empty() {
            return Ok(report::draw_swarm(trace));
        }
        let chosen = self.robots.iter().map(|net| robots_of(trace, net)).collect::<Result<Vec<_>, _>>()?;
        Ok(report::draw_chosen(trace, &chosen.concat()))
    }

    /// The chosen circuit, compiled: that of the chosen test, else the one that `nbc build` would build.
    fn compiled(&self) -> Result<Compiled, Failure> {
        let mut session = Session::new(DiskWorld);
        let file = session.open(&self.what)?;
        let mut choice = self.circuit.choice();
        if let Some(name) = &self.test {
            choice.circuit = Some(test_called(&file, name)?.circuit.to_string());
        }
        let circuit = file.circuit(&choice)?;
        let options = CompileOptions { swarm: choice.swarm, ..self.runs.options() };
        Ok(session.compile(&file, &circuit, &options)?)
    }

    /// The chosen test, run in physics: the first one, or the first simulation if the file has no test.
    fn ran(&self) -> Result<Ran, Failure> {
        let mut session = Session::new(DiskWorld);
        if self.kind == Kind::Report {
            session = session.with_poses(Room::SWARM);
        }
        let file = session.open(&self.what)?;
        let choice = self.circuit.choice();
        let is_choice = choice.circuit.is_some() || choice.swarm.is_some();
        let chosen = if is_choice { Some(file.circuit(&choice)?) } else { None };
        let program = &file.program;
        let is_chosen =
            |circuit: &Instance| chosen.as_ref().is_none_or(|chosen| is_same_instance(program, chosen, circuit));
        let test = match &self.test {
            Some(name) => Some(test_called(&file, name)?),
            None => program.tests.iter().find(|test| is_chosen(&test.circuit)),
        };
        let options = CompileOptions { swarm: choice.swarm.clone(), ..self.runs.options() };
        if let Some(test) = test {
            let clear = session::check_swarm_is_clear(program, &test.circuit, options.swarm.as_deref());
            clear.map_err(Failure::plain)?;
            return Ok(Ran::Test(run_test(&session, &file, test, &options)?.remove(0)));
        }
        let swarm = |name: &str| program.swarm(name).expect("a simulation names a swarm of its program");
        let simulation = program.simulations.iter().find(|simulation| {
            is_chosen(&swarm(&simulation.swarm).circuit)
                && choice.swarm.as_ref().is_none_or(|name| *name == simulation.swarm)
        });
        match simulation {
            Some(simulation) => Ok(Ran::Simulation(run_simulation(&session, &file, simulation, &options)?)),
            None => {
                let what = chosen.map_or_else(|| self.what.clone(), |circuit| circuit.to_string());
                Err(DrawError::NoRun { what }.into())
            }
        }
    }
}

/// The first test of that title or circuit.
fn test_called<'f>(file: &'f Checked, name: &'f str) -> Result<&'f CircuitTest, Failure> {
    let unknown = || DrawError::UnknownTest { file: file.path.clone(), name: name.to_owned() };
    file.tests(name).next().ok_or_else(|| unknown().into())
}

/// The indices of the robots that drive a net, or all nets that begin with the text before a final `*`.
fn robots_of(trace: &SwarmTrace, net: &str) -> Result<Vec<usize>, Failure> {
    let robots = &trace.robots;
    let is_meant = |driven: &str| match net.strip_suffix('*') {
        Some(beginning) => driven.starts_with(beginning),
        None => driven == net,
    };
    let meant: Vec<usize> = (0..robots.len()).filter(|&k| is_meant(&robots[k].net)).collect();
    if meant.is_empty() {
        let known = robots.iter().map(|robot| robot.net.clone()).collect();
        return Err(DrawError::UnknownNet { net: net.to_owned(), known }.into());
    }
    Ok(meant)
}

/// The robots of a swarm, each once.
fn cast(assembly: &Assembly) -> Several {
    let mut robots: Vec<One> = Vec::new();
    for member in &assembly.members {
        let robot = &member.robot;
        if robots.iter().all(|one| one.name != robot.name) {
            robots.push(One { behavior: robot.behavior, name: robot.name.clone(), body: robot.body.clone() });
        }
    }
    Several { title: format!("the robots of {}", assembly.circuit), robots }
}
