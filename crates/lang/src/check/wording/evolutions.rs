//! Evolution runs and their setting.

use nbc_base::diag::{Code, Diagnostic, counted, suggest};
use nbc_base::source::Span;

/// An invalid evolution run.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum EvolutionError {
    /// A box without room for a body.
    SmallBox { columns: usize, rows: usize, least: usize },
    /// A palette without materials, or with too many.
    PaletteSize { materials: usize, most: usize },
    /// A palette of materials that cannot move a body.
    NoActuator { least: usize },
    /// A schedule of another number of stimuli than the two or three of a behavior.
    WrongStimuli { schedule: String, stimuli: usize },
    /// A sensor of a stimulus that the schedule never gives; it gives others.
    DeafSensor { material: String, stimulus: String, given: Vec<String> },
    /// A stimulus of the schedule that no material senses.
    Unsensed { stimulus: String, shows: bool },
    /// A behavior of another number of stimuli than the schedule has.
    ForeignBehavior { behavior: String, found: usize, stimuli: usize },
    /// A schedule that leaves out patterns of its stimuli.
    MissingPatterns { schedule: String, missing: Vec<String> },
    /// A range without seeds, or with too many.
    SeedRange { most: u32 },
    /// Too many stimuli.
    TooManyStimuli { most: usize },
    /// A matter that is one of networks only, where bodies are made of voxels.
    MatterOfNetworks,
    /// Mutations of no weight at all.
    NoMutation,
}

impl EvolutionError {
    /// The error at the name or value.
    pub(crate) fn at(self, span: Span) -> Diagnostic {
        match self {
            Self::SmallBox { columns, rows, least } => {
                let message = format!("a box of {columns} x {rows} voxels is too small for a body");
                let label = format!("expected room for at least {}", counted(least, "actuator"));
                Diagnostic::new(Code::OutOfRange, message, span, label)
            }
            Self::PaletteSize { materials, most } => {
                let message = format!("palette has {}", counted(materials, "material"));
                Diagnostic::new(Code::OutOfRange, message, span, format!("expected 1 to {most}"))
            }
            Self::NoActuator { least } => {
                let label = format!("expected an actuator, because a body needs {least} of them");
                Diagnostic::new(Code::Value, "no material is an actuator", span, label)
                    .with_help("add one, for example `muscle` of the prelude")
            }
            Self::WrongStimuli { schedule, stimuli } => {
                let noun = if stimuli == 1 { "stimulus" } else { "stimuli" };
                let message = format!("the schedule `{schedule}` has {stimuli} {noun}");
                Diagnostic::new(Code::Value, message, span, "expected two or three, the inputs of a robot")
            }
            Self::DeafSensor { material, stimulus, given } => {
                let message = format!("the material `{material}` senses `{stimulus}`, which the schedule never gives");
                let given = suggest::alternatives(&given, "and");
                let label = format!("the schedule of this evolution gives {given}");
                let help = format!("name a schedule with `{stimulus}` in `variable`, or materials that sense {given}");
                Diagnostic::new(Code::Value, message, span, label).with_help(help)
            }
            Self::Unsensed { stimulus, shows: true } => {
                let message = format!("no material senses `{stimulus}`, which the schedule shows");
                Diagnostic::new(Code::Value, message, span, "expected materials that sense the image").with_help(
                    format!(
                        "add a sensor, for example `material light {{ kind: sensor, stimulus: {stimulus}, absent: 0.6, \
                     present: 1.6 }}`"
                    ),
                )
            }
            Self::Unsensed { stimulus, shows: false } => {
                let message = format!("no material senses `{stimulus}`, which the schedule gives");
                let label = "expected materials that sense all three stimuli";
                Diagnostic::new(Code::Value, message, span, label)
                    .with_help(format!("add a sensor of `{stimulus}`, or name a schedule without it in `variable`"))
            }
            Self::ForeignBehavior { behavior, found, stimuli } => {
                let message = format!("the behavior `{behavior}` has {found} stimuli");
                let label = format!("the schedule of this evolution has {stimuli}");
                let help = match stimuli {
                    3 => "write behaviors of eight letters, or functions of three inputs such as `maj`",
                    _ => "write behaviors of four letters, or functions of two inputs such as `nand`",
                };
                Diagnostic::new(Code::Value, message, span, label).with_help(help)
            }
            Self::MissingPatterns { schedule, missing } => {
                let names = suggest::alternatives(&missing, "or");
                let message = format!("the schedule `{schedule}` never gives {names}");
                let many = if missing[0].len() == 2 { "four" } else { "eight" };
                let label = format!("expected all {many} patterns, under which a behavior is measured");
                let row: Vec<_> = missing[0].chars().map(String::from).collect();
                Diagnostic::new(Code::Value, message, span, label)
                    .with_help(format!("add a row, for example `{} for 10 cycles`", row.join(" ")))
            }
            Self::SeedRange { most } => {
                let message = "the range of seeds is empty or too long";
                Diagnostic::new(Code::OutOfRange, message, span, format!("expected 1 to {most} seeds"))
            }
            Self::TooManyStimuli { most } => {
                Diagnostic::new(Code::OutOfRange, "too many stimuli", span, format!("expected at most {most} stimuli"))
            }
            Self::MatterOfNetworks => {
                let message = "this matter has no effect, because the bodies are not made from networks";
                Diagnostic::new(Code::NoEffect, message, span, "used only with `genome: cppn`")
                    .with_help("remove it, or write `genome: cppn`")
            }
            Self::NoMutation => {
                let message = "no mutation has a weight, so no body would have offspring";
                Diagnostic::new(Code::OutOfRange, message, span, "expected one that is above 0")
                    .with_help("a weight that is left out is 1")
            }
        }
    }
}
