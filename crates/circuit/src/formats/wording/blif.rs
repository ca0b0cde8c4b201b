//! Messages about BLIF files: their lines, then their models.

use crate::formats::wording::text::damaged;
use nbc_base::budget::Limit;
use nbc_base::diag::{Diagnostic, Severity};
use nbc_base::source::Span;

pub fn no_model(at: Span) -> Diagnostic {
    damaged("no `.model` in this BLIF file", at, "expected `.model`")
}

pub fn ignored_dont_cares(at: Span) -> Diagnostic {
    let error = damaged("external don't-cares are ignored", at, "up to the end of the model");
    Diagnostic { severity: Severity::Warning, ..error }
}

pub fn model_twice(model: &str, at: Span) -> Diagnostic {
    damaged(format!("model `{model}` is defined twice"), at, "defined again here")
}

pub fn before_model(directive: &str, at: Span) -> Diagnostic {
    damaged(format!("`{directive}` before `.model`"), at, "expected `.model` first")
}

pub fn incomplete(directive: &str, expected: &str, at: Span) -> Diagnostic {
    damaged(format!("`{directive}` is incomplete"), at, expected)
}

pub fn library_cell(directive: &str, at: Span) -> Diagnostic {
    let message = format!("`{directive}` names a cell of a library that is not in the file");
    damaged(message, at, "expected its function, written with `.names`")
}

pub fn unknown_directive(directive: &str, at: Span) -> Diagnostic {
    damaged(format!("unknown BLIF directive `{directive}`"), at, "not supported")
}

pub fn net_start(found: &str, at: Span) -> Diagnostic {
    damaged(format!("invalid start value `{found}` of a net"), at, "expected 0 or 1")
}

pub fn not_a_directive(found: &str, at: Span) -> Diagnostic {
    let label = "expected a directive such as `.names`, or a row after one";
    damaged(format!("`{found}` is not a directive"), at, label)
}

pub fn malformed_row(at: Span) -> Diagnostic {
    damaged("malformed row", at, "expected the digits of the inputs and of the output")
}

pub fn row_width(expected: usize, found: &str, at: Span) -> Diagnostic {
    let label = format!("expected {expected} digits `0`, `1` or `-`, found `{found}`");
    damaged("row has the wrong width", at, label)
}

pub fn row_output(found: &str, at: Span) -> Diagnostic {
    damaged("row has an invalid output", at, format!("expected `0` or `1`, found `{found}`"))
}

pub fn mixed_rows(at: Span) -> Diagnostic {
    damaged("rows have different outputs", at, "expected the same output in all rows of a `.names`")
}

pub fn model_depth(at: Span) -> Diagnostic {
    let message = format!("models are nested more than {} levels deep", Limit::Hierarchy.most());
    damaged(message, at, "the limit is reached here")
}

pub fn model_size(at: Span) -> Diagnostic {
    damaged("the circuit is too large once its models are expanded", at, "the limit is reached here")
}

pub fn latch_start(found: &str, at: Span) -> Diagnostic {
    let label = "expected 0, 1, 2 (any) or 3 (unknown)";
    damaged(format!("invalid start value `{found}` of a latch"), at, label)
}

pub fn latch_kind(found: &str, at: Span) -> Diagnostic {
    damaged(format!("invalid kind `{found}` of a latch"), at, "expected re, fe, ah or al")
}

pub fn no_clock(latch: &str, input: &str, at: Span) -> Diagnostic {
    damaged(format!("latch `{latch}` has no clock"), at, "expected a clock")
        .with_help(format!("write `.latch {input} {latch} re clk 0` or `.clock clk`, or pass `--clock clk`"))
}

pub fn missing_model(model: &str, at: Span) -> Diagnostic {
    damaged(format!("model `{model}` is missing"), at, "expected its `.model` in the file")
}

pub fn recursive_model(model: &str, at: Span) -> Diagnostic {
    damaged(format!("model `{model}` contains itself"), at, "instantiated here")
}

pub fn not_a_connection(found: &str, at: Span) -> Diagnostic {
    damaged(format!("`{found}` is not a connection"), at, "expected `port=net`")
}

pub fn unknown_port(model: &str, port: &str, at: Span) -> Diagnostic {
    damaged(format!("model `{model}` has no port `{port}`"), at, "connected here")
}

pub fn connected_twice(port: &str, at: Span) -> Diagnostic {
    damaged(format!("port `{port}` is connected twice"), at, "connected again here")
}

pub fn unconnected(model: &str, port: &str, at: Span) -> Diagnostic {
    let message = format!("input `{port}` of model `{model}` is not connected");
    damaged(message, at, format!("expected `{port}=net`"))
}
