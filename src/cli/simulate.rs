//! `nbc simulate`: one body under a schedule of stimuli.

use std::path::Path;

use clap::Args;
use serde::Serialize;

use crate::cli::draw::wording::unknown_behavior;
use crate::cli::draw::{is_run, read_run};
use crate::cli::options::device::DeviceArguments;
use crate::cli::options::images::{ImagesArguments, ShownSchedule};
use crate::cli::options::number::number;
use crate::cli::options::robots::RobotsArguments;
use crate::cli::robots::read_body;
use crate::cli::{Context, Failure, OpenDevice, Status, wording};
use nbc_base::diag::{Diagnostic, counted};
use nbc_base::model::{Behavior, Body, CYCLE_STEPS, Direction, Fault, Schedule, Setting, Trajectory, Trial};
use nbc_base::source::Sources;
use nbc_session::behavior;
use nbc_session::report::{Align, Schema, TextTable};
use nbc_sim::LaneBackend;

/// Simulate one robot under a schedule of stimuli
#[derive(Args)]
#[command(after_help = "Examples:
  nbc simulate nand --schedule '00*10 01*10 10*10 11*10'
  nbc simulate body.yaml --schedule '01*56steps' --world-width 60 --start-x 28 --format json
  nbc simulate out/zeros_and_ones --behavior LLRR --images library/seeing.nb --schedule 'zeros*250steps ones*250steps'

A body is a robot file, or any YAML or JSON mapping with `body:` as rows of material codes, top row first: 0 empty, \
1 rigid, 2 soft, 3 actuator, 4 actuator in antiphase. While stimulus 1 is present, 5 shrinks and 7 grows; while \
stimulus 2 is present, 6 shrinks and 8 grows. A file may have `materials:` of its own; a pattern has a digit for each \
stimulus that they sense. The schedule of a body that sees names sets of images, each of which is shown for that time.
Exit status: 0 simulated to the end, 1 the simulation failed, 2 bad input.")]
pub struct SimulateArguments {
    /// A file with a body, the name of a robot in the library, or the folder of a run
    robot: String,
    /// Patterns of the stimuli with durations: `01*10` is ten cycles, `01*56steps` is 56 env steps
    #[arg(long)]
    schedule: String,
    #[command(flatten)]
    images: ImagesArguments,
    /// The best robot of a run with this behavior, such as `RRRL` or its function `nand`
    #[arg(long, value_name = "BEHAVIOR", value_parser = behavior)]
    behavior: Option<Behavior>,
    /// The ground column of the body's left column [default: the middle of the world]
    #[arg(long, value_name = "COLUMN", value_parser = number::<usize>)]
    start_x: Option<usize>,
    /// Ground voxels in a row
    #[arg(long, value_name = "VOXELS", default_value_t = Setting::default().world_width)]
    #[arg(value_parser = number::<usize>)]
    world_width: usize,
    #[command(flatten)]
    library: RobotsArguments,
    #[command(flatten)]
    device: DeviceArguments,
}

#[derive(Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub(super) struct SimulatedPath<'a> {
    /// Voxels walked in each entry of the schedule; null if the simulation ended before the entry did.
    displacement: Vec<Option<f64>>,
    /// Place of the center of mass in voxels, at the start and after each env step.
    com_x: &'a [f64],
    /// The env step that was abandoned, from 1.
    unstable_at: Option<u32>,
}

impl SimulateArguments {
    pub fn run(self, context: &mut Context) -> Result<Status, Failure> {
        let setting = Setting { world_width: self.world_width, start_x: self.start_x, ..Setting::default() };
        let body = self.body(context)?;
        let ShownSchedule { schedule, shown } =
            self.images.schedule(Some(&self.schedule), [&body])?.expect("a text is a schedule");
        setting.check(&body).map_err(wording::setting)?;
        let device = OpenDevice::open(self.device, LaneBackend::default(), context)?;
        let trial = Trial { body, schedule: schedule.clone() };
        let trajectory = device.simulator().run_trials(&setting, &[trial]).remove(0);
        device.end(context)?;
        let warnings: Vec<Diagnostic> = ground_ends(&setting, &trajectory).into_iter().collect();
        context.tell(&warnings, &Sources::default());
        context.print_result(Schema::Simulate, &SimulatedPath::of(&schedule, &trajectory), || {
            describe(&schedule, &shown, &trajectory)
        })?;
        Ok(if trajectory.fault.is_none() { Status::Done } else { Status::TestFailed })
    }

    fn body(&self, context: &Context) -> Result<Body, Failure> {
        let path = Path::new(&self.robot);
        match self.behavior {
            Some(_) if !is_run(path) => Err(wording::behavior_of_file().into()),
            Some(behavior) => match read_run(path, context)?.champion(behavior) {
                Some(elite) => Ok(elite.body.clone()),
                None => Err(unknown_behavior(&self.robot, behavior).into()),
            },
            None if is_run(path) => {
                let behaviors = read_run(path, context)?.behaviors();
                let behaviors: Vec<String> = behaviors.iter().map(Behavior::to_string).collect();
                Err(wording::body_of_run(&self.robot, &behaviors).into())
            }
            None => read_body(&self.robot, &self.library),
        }
    }
}

/// A robot that left its ground falls, or creeps along the plane below.
fn ground_ends(setting: &Setting, trajectory: &Trajectory) -> Option<Diagnostic> {
    let ground = 0.0..=setting.world_width as f64;
    let step = trajectory.com_x.iter().position(|x| !ground.contains(x))?;
    Some(wording::ground_ends(step, setting.world_width))
}

impl<'a> SimulatedPath<'a> {
    fn of(schedule: &Schedule, trajectory: &'a Trajectory) -> Self {
        Self {
            displacement: trajectory.displacements(schedule),
            com_x: &trajectory.com_x,
            unstable_at: trajectory.fault.map(|fault| fault.env_step),
        }
    }
}

fn describe(schedule: &Schedule, shown: &[String], trajectory: &Trajectory) -> String {
    use Align::{Left, Right};
    let mut table =
        TextTable::new(&[("stimuli", Left), ("length", Right), ("displacement", Right), ("direction", Left)]);
    for ((spell, shown), walked) in schedule.spells.iter().zip(shown).zip(trajectory.displacements(schedule)) {
        let length = match spell.steps % CYCLE_STEPS {
            0 => counted((spell.steps / CYCLE_STEPS) as usize, "cycle"),
            _ => counted(spell.steps as usize, "step"),
        };
        let (walked, direction) = match walked {
            Some(walked) => (format!("{walked:+.6}"), format!("{:?}", Direction::of(walked)).to_lowercase()),
            None => ("-".to_owned(), "-".to_owned()),
        };
        table.push(vec![shown.clone(), length, walked, direction]);
    }
    match trajectory.fault {
        None => format!("{table}voxels walked\n"),
        Some(Fault { kind, env_step }) => format!("{table}FAIL: the robot {kind} in env step {env_step}\n"),
    }
}
