//! Messages of compiling and running a program that has no errors itself.

use crate::report;
use nbc_base::budget::Limit;
use nbc_base::diag::{Code, Diagnostic, Suggestion, counted, suggest};
use nbc_base::model::{Behavior, Function, ImageSize, NamedSchedule};
use nbc_base::source::Span;
use nbc_circuit::properties::NoSteps;
use nbc_circuit::waves::WaveError;
use nbc_circuit::{EnvironmentFault, MapError};
use nbc_swarm::WeakRobot;

fn bad(message: impl Into<String>) -> Diagnostic {
    Diagnostic::without_place(Code::BadValue, message)
}

fn helped(fault: Diagnostic, help: Option<String>) -> Diagnostic {
    help.into_iter().fold(fault, Diagnostic::with_help)
}

pub(super) fn no_row_format(file: &str) -> Diagnostic {
    bad(format!("unrecognized format of the rows in `{file}`; expected .csv or .pla"))
}

pub(super) fn empty_group() -> Diagnostic {
    bad("invalid group of 0 rows; expected at least 1")
}

pub(super) fn bad_hold_out(percent: f64) -> Diagnostic {
    bad(format!("invalid share {percent} % to hold out; expected a number from 0 to less than 100"))
}

pub(super) fn too_large_to_learn(inputs: usize, outputs: usize) -> Diagnostic {
    let (inputs, outputs) = (counted(inputs, "input bit"), counted(outputs, "output bit"));
    let message = format!("a circuit of {inputs} and {outputs} is too large to learn");
    let most = Limit::LearnedBits.most();
    Diagnostic::without_place(Code::TooLarge, message)
        .with_help(format!("expected at most {most} input bits times output bits"))
}

pub(super) fn no_training_rows(rows: usize, percent: f64) -> Diagnostic {
    bad(format!("{percent} % of {} leave none to learn from", counted(rows, "row")))
        .with_help("hold out fewer rows: `--hold-out 0`")
}

pub(super) fn no_confusion(circuit: &str) -> Diagnostic {
    bad(format!("`{circuit}` has no table of confusions"))
        .with_help("such a table is of one output with at most 16 values")
}

pub(super) fn unknown<'a>(kind: &str, name: &str, known: impl IntoIterator<Item = &'a str>) -> Diagnostic {
    Diagnostic::without_place(Code::Unknown, format!("no {kind} is called `{name}`"))
        .with_suggestion(None, &Suggestion::of(name, known))
}

pub(super) fn sees_no_images(evolution: &str) -> Diagnostic {
    bad(format!("the bodies of `{evolution}` see no images"))
        .with_help("expected an evolution with `objective: images`")
}

pub(super) fn other_sets(schedule: &str, found: usize, expected: usize) -> Diagnostic {
    let (found, sets) = (counted(found, "set"), counted(expected, "set"));
    bad(format!("the schedule `{schedule}` shows {found} of images, expected {sets}"))
        .with_help("its sets are those of the evolution's schedule, in the same order")
}

pub(super) fn no_bodies(evolution: &str) -> Diagnostic {
    Diagnostic::without_place(Code::Empty, format!("the run of `{evolution}` has no bodies"))
        .with_help("go on with it: `nbc evolve FILE --run NAME --resume`")
}

pub(super) fn other_materials(evolution: &str) -> Diagnostic {
    let message = format!("the bodies have other materials than `{evolution}` declares");
    Diagnostic::without_place(Code::Checkpoint, message)
}

pub(super) fn no_circuit() -> Diagnostic {
    Diagnostic::without_place(Code::Empty, "the file declares no circuit")
        .with_help("choose one that it uses: `--circuit NAME`")
}

/// `parameters` is the number of all parameters of the circuit.
pub(super) fn no_number(circuit: &str, parameter: &str, parameters: usize) -> Diagnostic {
    let numbers = vec!["4"; parameters].join(", ");
    let message = format!("the parameter `{parameter}` of `{circuit}` has no number");
    Diagnostic::without_place(Code::UnknownWidth, message)
        .with_help(format!("give one for each parameter, such as `--circuit '{circuit}[{numbers}]'`"))
}

pub(super) fn several_swarms(circuit: &str, [first, second]: [&str; 2]) -> Diagnostic {
    bad(format!("several swarms are declared for `{circuit}`"))
        .with_help(format!("choose one, for example `--swarm {first}` or `--swarm {second}`"))
}

pub(super) fn swarm_of_other_circuit(swarm: &str, own: &str, circuit: &str) -> Diagnostic {
    bad(format!("the swarm `{swarm}` is declared for `{own}`, not for `{circuit}`"))
}

pub(super) fn unmapped(error: &MapError) -> Diagnostic {
    let code = match error {
        MapError::Netlist(_) => Code::CircuitFile,
        MapError::TooLarge { .. } => Code::TooLarge,
        MapError::Incomplete { .. } => Code::IncompleteLibrary,
    };
    helped(Diagnostic::without_place(code, error.to_string()), error.help())
}

pub(super) fn no_multiplexer() -> Diagnostic {
    let message = "the library has no multiplexer without glitches, of which `registers: mux` makes latches";
    Diagnostic::without_place(Code::IncompleteLibrary, message).with_help("write `library: three`")
}

pub(super) fn waves_need_a_beat(world: &str) -> Diagnostic {
    let message = format!("a wave machine cannot run in the world `{world}`, whose robots are not heard at one time");
    let help = "all its robots react in the same cycle; leave out `phase`, `drift` and `hears`, or `registers: waves`";
    Diagnostic::without_place(Code::NoWaves, message).with_help(help)
}

pub(super) fn no_waves(error: &WaveError) -> Diagnostic {
    match error {
        WaveError::Unmapped(error) => unmapped(error),
        error => helped(Diagnostic::without_place(Code::NoWaves, error.to_string()), error.help()),
    }
}

pub(super) fn unknown_function(name: &str) -> Diagnostic {
    let known: Vec<&str> = Function::named().map(Function::name).collect();
    bad(format!("`{name}` is not a function of two inputs"))
        .with_help(format!("the functions are {}", known.join(", ")))
        .with_near(&Suggestion::near(name, known))
}

pub(super) fn no_test_to_harden(circuit: &str) -> Diagnostic {
    Diagnostic::without_place(Code::Empty, format!("the file has no test of `{circuit}`"))
        .with_help("hardening runs the tests of the circuit in many worlds")
}

pub(super) fn for_circuit(error: Diagnostic, place: Span) -> Diagnostic {
    error.with_label(place, "for this circuit")
}

/// Shows an error of a robot file at the library that has it; `command` makes the robots.
pub(super) fn of_library(error: Diagnostic, library: Span, command: Option<&str>) -> Diagnostic {
    let error = error.with_label(library, "the robots of this library");
    command.into_iter().fold(error, Diagnostic::with_help)
}

pub(super) fn of_declared_file(error: Diagnostic, declared: Span) -> Diagnostic {
    error.with_label(declared, "declared here")
}

pub(super) fn no_steps(circuit: &str, why: &NoSteps, at: Span) -> Diagnostic {
    let (message, help) = match why {
        NoSteps::ClockHasNoValue { .. } => (why.to_string(), "leave it out: after each edge it has the same value"),
        NoSteps::OtherSteps => (
            format!("`{circuit}` cannot be compared with this circuit for ever: {why}"),
            "give both the same clock, at the same port",
        ),
        _ => (
            format!("`{circuit}` has no steps: {why}"),
            "a step is an edge of the one clock of all registers, or a row of inputs after which all settles",
        ),
    };
    Diagnostic::new(Code::NoSteps, message, at, "claimed here").with_help(help)
}

pub(super) fn no_registers(swarm: &str, circuit: &str, at: Span) -> Diagnostic {
    let message = format!("`registers: mux` has no effect in the swarm `{swarm}`");
    Diagnostic::new(Code::NoEffect, message, at, format!("`{circuit}` has no register"))
        .with_help("remove `registers: mux`")
}

pub(super) fn no_start_body(evolution: &str, library: &str, at: Span) -> Diagnostic {
    let message = format!("no robot of `{library}` fits into the box and the materials of `{evolution}`");
    Diagnostic::new(Code::Value, message, at, "the evolution begins with these robots")
}

pub(super) fn unknown_robot<'a>(name: &str, known: impl IntoIterator<Item = &'a str>, at: Span) -> Diagnostic {
    Diagnostic::new(Code::Unknown, format!("the library has no robot `{name}`"), at, "not in the library")
        .with_suggestion(Some(at), &Suggestion::near(name, known))
}

pub(super) fn no_behavior(library: &str, absent: &[Behavior], at: Span) -> Diagnostic {
    let names: Vec<&str> = absent.iter().map(|behavior| behavior.function().name()).collect();
    let message = format!("`{library}` has no robot of {}", suggest::alternatives(&names, "or"));
    Diagnostic::new(Code::NoEffect, message, at, "its `behaviors` name what no robot does")
        .with_help("remove them from `behaviors`; `from: three` has robots of three stimuli")
}

pub(super) fn no_edge(clock: &str, rises: bool, at: Span) -> Diagnostic {
    let message = "a wave machine shows new outputs only after an edge of its clock";
    let how = if rises { "`^`" } else { "1 in a row and 0 in the next" };
    Diagnostic::new(Code::NoWaves, message, at, format!("`{clock}` makes no step here"))
        .with_help(format!("only the first row may have no edge; write {how} for `{clock}`"))
}

pub(super) fn hold_in_waves(step: Option<u32>, at: Span) -> Diagnostic {
    let label = match step {
        Some(step) => format!("a step has {}", counted(step as usize, "cycle")),
        None => "all steps have the same length".to_owned(),
    };
    Diagnostic::new(Code::NoWaves, "a row of a wave machine has no hold of its own", at, label)
        .with_help("leave out `for`")
}

pub(super) fn weak_robot(circuit: &str, robot: &WeakRobot, at: Span) -> Diagnostic {
    let message = format!("`{circuit}` uses the robot `{}`, {}", robot.robot, robot.complaint());
    let nets = robot.nets.join(", ");
    Diagnostic::new(Code::WeakRobot, message, at, "for this circuit")
        .with_help(format!("it drives {nets}; a library without it, or a longer hold, may do better"))
}

/// `path` is the slowest one by static timing.
pub(super) fn short_hold(hold: usize, needed: usize, path: &[String], at: Span) -> Diagnostic {
    let message = format!("a hold of {} is too short, expected at least {needed}", counted(hold, "cycle"));
    let path = report::describe_path(path);
    Diagnostic::new(Code::HoldTooShort, message, at, "held here")
        .with_help(format!("`hold: auto` holds each row until every robot has settled; the slowest path is {path}"))
}

#[derive(Clone, Copy)]
pub(super) enum ScheduleKind {
    Pattern { stimuli: usize },
    Set,
}

impl ScheduleKind {
    fn example(self) -> String {
        match self {
            Self::Pattern { stimuli } => format!("{:0>stimuli$}", 1),
            Self::Set => "zeros".to_owned(),
        }
    }

    fn fault(self, message: String, label: String, at: Span) -> Diagnostic {
        let what = match self {
            Self::Pattern { .. } => "stimuli",
            Self::Set => "a set of images",
        };
        let example = self.example();
        Diagnostic::new(Code::BadSchedule, message, at, label).with_help(format!(
            "write {what}, `*` and a duration: `{example}*10` is ten cycles, `{example}*56steps` is 56 env steps"
        ))
    }

    pub(super) fn empty(self, at: Span) -> Diagnostic {
        let label = format!("expected an entry such as `{}*10`", self.example());
        self.fault("the schedule is empty".to_owned(), label, at)
    }

    pub(super) fn too_long(self, steps: u64, most: u64, at: Span) -> Diagnostic {
        let message = format!("the schedule of {steps} env steps is too long");
        self.fault(message, format!("expected at most {most}"), at)
    }

    pub(super) fn no_duration(self, entry: &str, at: Span) -> Diagnostic {
        let label = format!("expected `*` and a number, for example `{entry}*10`");
        self.fault(format!("missing duration after `{entry}`"), label, at)
    }

    pub(super) fn not_a_duration(self, found: &str, at: Span) -> Diagnostic {
        let label = "expected a number of cycles, or of env steps as in `56steps`".to_owned();
        self.fault(format!("`{found}` is not a duration"), label, at)
    }

    pub(super) fn no_time(self, found: &str, at: Span) -> Diagnostic {
        self.fault(format!("the duration `{found}` is too short"), "expected at least 1".to_owned(), at)
    }

    pub(super) fn long_entry(self, found: &str, most: u64, at: Span) -> Diagnostic {
        let label = format!("expected at most {most} env steps");
        self.fault(format!("the duration `{found}` is too long"), label, at)
    }
}

pub(super) fn bad_pattern(found: &str, stimuli: usize, at: Span) -> Diagnostic {
    let expected = match stimuli {
        2 => "00, 01, 10 or 11".to_owned(),
        stimuli => format!("{stimuli} digits, 0 or 1, for the stimuli that the materials of the body sense"),
    };
    let message = format!("invalid stimulus pattern `{found}`");
    ScheduleKind::Pattern { stimuli }.fault(message, format!("expected {expected}"), at)
}

pub(super) fn unknown_images<'a>(name: &str, known: impl IntoIterator<Item = &'a str>, at: Span) -> Diagnostic {
    Diagnostic::new(Code::Unknown, format!("no set of images is called `{name}`"), at, "not declared")
        .with_near(&Suggestion::of(name, known))
}

pub(super) fn image_size(name: &str, found: ImageSize, expected: ImageSize, at: Span) -> Diagnostic {
    let label = format!("the body senses images of {expected} pixels");
    ScheduleKind::Set.fault(format!("the images `{name}` have {found} pixels"), label, at)
}

pub(super) fn too_many_sets(at: Span) -> Diagnostic {
    let label = format!("expected at most {}", NamedSchedule::MOST_SETS);
    ScheduleKind::Set.fault("the schedule shows too many sets of images".to_owned(), label, at)
}

pub(super) fn bad_environment(fault: &EnvironmentFault, at: Span) -> Diagnostic {
    let (message, help) = match fault {
        EnvironmentFault::Clock(error) => (format!("the environment cannot be simulated: {error}"), error.help()),
        EnvironmentFault::OtherClock => (
            "the registers and memories of an environment need one clock, and take their values when it rises"
                .to_owned(),
            None,
        ),
        EnvironmentFault::Circle => return never_agree(at),
    };
    helped(Diagnostic::new(Code::Operands, message, at, "here"), help)
}

pub(super) fn never_agree(at: Span) -> Diagnostic {
    let message = "the circuit and its environment change each other for ever";
    Diagnostic::new(Code::Operands, message, at, "here")
        .with_help("let a register of the environment keep one of the values that go round")
}

pub(super) fn no_word(path: &str, line: usize) -> Diagnostic {
    Diagnostic::without_place(Code::Value, format!("line {line} of `{path}` has no word of the memory"))
        .with_help("a `.hex` file has hexadecimal words, a `.csv` file numbers, a `.bin` file bytes")
}

pub(super) fn too_many_words(path: &str, found: usize, room: usize) -> Diagnostic {
    Diagnostic::without_place(Code::TooLarge, format!("`{path}` has {found} words, and the memory {room}"))
}

pub(super) fn of_words(error: Diagnostic, declared: Span) -> Diagnostic {
    error.with_label(declared, "here")
}

pub(super) fn too_long_for_physics(most: usize, at: Span) -> Diagnostic {
    Diagnostic::new(Code::TooLarge, format!("the test has more than {most} rows in physics"), at, "here")
        .with_help("test it at the level of logic: `nbc test --logic`")
}

pub(super) fn unknown_file<'a>(name: &str, known: impl IntoIterator<Item = &'a str>) -> Diagnostic {
    let fault = Diagnostic::without_place(Code::Unknown, format!("the program declares no file `{name}`"));
    match Suggestion::of(name, known) {
        near @ Suggestion::Near(_) => fault.with_suggestion(None, &near),
        _ => {
            fault.with_help(format!("declare it, `file {name} = \"…\"`, and let a memory begin with it: `init {name}`"))
        }
    }
}

pub(super) fn unused_file(name: &str) -> Diagnostic {
    Diagnostic::without_place(Code::NoEffect, format!("no memory begins with the file `{name}`"))
        .with_help(format!("let one of an environment do so: `net words[256][8] init {name}`"))
}
