//! A page with a schematic of which a sheet is shown at a time.

use serde_json::json;

use crate::html::Html;
use crate::page_bodies::cell_data;
use crate::schematic::SchematicPages;
use nbc_base::diag::counted;
use nbc_swarm::Assembly;

const SCRIPT: &str = include_str!("../page/sheets.js");

pub fn draw_schematic_page(assembly: &Assembly, schematic: &SchematicPages) -> String {
    let (robots, sheets) = (counted(assembly.members.len(), "robot"), counted(schematic.sheets.len(), "sheet"));
    Html {
        heading: &assembly.circuit,
        passed: true,
        verdict: format!("{robots} on {sheets}"),
        body: explorer(),
        script: Some((SCRIPT, json!({ "schematic": schematic, "cells": cell_data(assembly) }))),
    }
    .finish()
}

/// The frame of a schematic, which the script fills.
pub fn explorer() -> String {
    let buttons: String = [("nearer", "Zoom in", "+"), ("farther", "Zoom out", "−"), ("whole", "Show all", "all")]
        .map(|(class, label, sign)| {
            format!(
                "<button type=\"button\" class=\"{class}\" title=\"{label}\" aria-label=\"{label}\">{sign}</button>"
            )
        })
        .concat();
    format!(
        "<div class=\"beside\"><div class=\"schematic\"><nav class=\"crumbs\" aria-label=\"sheet\"></nav>\n\
         <div class=\"bar\"><input type=\"search\" class=\"search\" placeholder=\"Find a part, a robot or a net\" \
         aria-label=\"find a part, a robot or a net\"><label>mark <select class=\"reach\"><option value=\"wires\">its \
         wires</option><option value=\"before\">what it depends on</option><option value=\"after\">what depends on \
         it</option></select></label>{buttons}<ul class=\"results\"></ul></div>\n<div class=\"frame-of-sheet\"><div \
         class=\"sheet picture\" tabindex=\"0\" role=\"group\" aria-label=\"schematic\"></div><div \
         class=\"map-of-sheet picture\" aria-hidden=\"true\"></div></div>\n<p class=\"explained\"><span><i \
         class=\"box\"></i>a part: opens</span><span><i class=\"slow\"></i>slowest path</span><span><i \
         class=\"lit\"></i>chosen and marked</span></p></div><div class=\"robot\" aria-live=\"polite\"></div></div>\n"
    )
}
