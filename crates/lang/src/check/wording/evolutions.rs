//! Evolution runs and their setting.

use crate::syntax::tree::NameSyntax;
use nbc_base::diag::{Code, Diagnostic, counted, suggest};
use nbc_base::source::Span;

pub(crate) fn small_box(columns: usize, rows: usize, least: usize, at: Span) -> Diagnostic {
    let message = format!("a box of {columns} x {rows} voxels is too small for a body");
    Diagnostic::new(Code::OutOfRange, message, at, format!("expected room for at least {}", counted(least, "actuator")))
}

pub(crate) fn palette_size(materials: usize, most: usize, at: Span) -> Diagnostic {
    let message = format!("palette has {}", counted(materials, "material"));
    Diagnostic::new(Code::OutOfRange, message, at, format!("expected 1 to {most}"))
}

pub(crate) fn no_actuator(least: usize, at: Span) -> Diagnostic {
    let label = format!("expected an actuator, because a body needs {least} of them");
    Diagnostic::new(Code::Value, "no material is an actuator", at, label)
        .with_help("add one, for example `muscle` of the prelude")
}

pub(crate) fn wrong_stimuli(schedule: &NameSyntax, stimuli: usize) -> Diagnostic {
    let noun = if stimuli == 1 { "stimulus" } else { "stimuli" };
    let message = format!("the schedule `{}` has {stimuli} {noun}", schedule.text);
    Diagnostic::new(Code::Value, message, schedule.span, "expected two or three, the inputs of a robot")
}

/// The schedule never gives the stimulus that the material senses; it gives others.
pub(crate) fn deaf_sensor(material: &str, stimulus: &str, given: &[&str], at: Span) -> Diagnostic {
    let message = format!("the material `{material}` senses `{stimulus}`, which the schedule never gives");
    let given = suggest::alternatives(given, "and");
    let help = format!("name a schedule with `{stimulus}` in `variable`, or materials that sense {given}");
    Diagnostic::new(Code::Value, message, at, format!("the schedule of this evolution gives {given}")).with_help(help)
}

pub(crate) fn unsensed_image(stimulus: &str, at: Span) -> Diagnostic {
    let message = format!("no material senses `{stimulus}`, which the schedule shows");
    let help = format!(
        "add a sensor, for example `material light {{ kind: sensor, stimulus: {stimulus}, absent: 0.6, present: 1.6 }}`"
    );
    Diagnostic::new(Code::Value, message, at, "expected materials that sense the image").with_help(help)
}

pub(crate) fn unsensed_stimulus(stimulus: &str, at: Span) -> Diagnostic {
    let message = format!("no material senses `{stimulus}`, which the schedule gives");
    Diagnostic::new(Code::Value, message, at, "expected materials that sense all three stimuli")
        .with_help(format!("add a sensor of `{stimulus}`, or name a schedule without it in `variable`"))
}

pub(crate) fn foreign_behavior(behavior: &str, found: usize, stimuli: usize, at: Span) -> Diagnostic {
    let message = format!("the behavior `{behavior}` has {found} stimuli");
    let help = match stimuli {
        3 => "write behaviors of eight letters, or functions of three inputs such as `maj`",
        _ => "write behaviors of four letters, or functions of two inputs such as `nand`",
    };
    Diagnostic::new(Code::Value, message, at, format!("the schedule of this evolution has {stimuli}")).with_help(help)
}

pub(crate) fn missing_patterns(schedule: &NameSyntax, missing: &[String]) -> Diagnostic {
    let names = suggest::alternatives(missing, "or");
    let message = format!("the schedule `{}` never gives {names}", schedule.text);
    let many = if missing[0].len() == 2 { "four" } else { "eight" };
    let label = format!("expected all {many} patterns, under which a behavior is measured");
    let row: Vec<_> = missing[0].chars().map(String::from).collect();
    Diagnostic::new(Code::Value, message, schedule.span, label)
        .with_help(format!("add a row, for example `{} for 10 cycles`", row.join(" ")))
}

pub(crate) fn seed_range(most: u32, at: Span) -> Diagnostic {
    let message = "the range of seeds is empty or too long";
    Diagnostic::new(Code::OutOfRange, message, at, format!("expected 1 to {most} seeds"))
}

pub(crate) fn many_stimuli(most: usize, at: Span) -> Diagnostic {
    Diagnostic::new(Code::OutOfRange, "too many stimuli", at, format!("expected at most {most} stimuli"))
}

pub(crate) fn matter_of_networks(at: Span) -> Diagnostic {
    let message = "this matter has no effect, because the bodies are not made from networks";
    Diagnostic::new(Code::NoEffect, message, at, "used only with `genome: cppn`")
        .with_help("remove it, or write `genome: cppn`")
}

pub(crate) fn no_mutation(at: Span) -> Diagnostic {
    let message = "no mutation has a weight, so no body would have offspring";
    Diagnostic::new(Code::OutOfRange, message, at, "expected one that is above 0")
        .with_help("a weight that is left out is 1")
}
