//! Schematics: a circuit in sheets, each of them a part of it in layers, and each cell with the robot that plays it;
//! and the page that shows a sheet at a time.

use std::collections::{BTreeMap, BTreeSet};

use serde::Serialize;
use serde_json::json;

use crate::color::Scheme;
use crate::hierarchy::{CircuitPart, Hierarchy};
use crate::html::{Html, embedded};
use crate::looks::Looks;
use crate::page_bodies::cell_data;
use crate::sheet::{Sheet, SheetItem};
use crate::sprite::draw_body;
use crate::svg::Svg;
use crate::symbols::{SIDE, Symbols};
use crate::wires::{SheetPlan, draw_net};
use nbc_base::diag::counted;
use nbc_base::model::Robot;
use nbc_circuit::{NetId, Netlist};
use nbc_swarm::Assembly;

pub struct Schematic<'a> {
    circuit: &'a Netlist,
    hierarchy: Hierarchy,
    robots: Vec<&'a Robot>,
    numbers: BTreeMap<NetId, usize>,
    critical: Vec<NetId>,
    looks: Looks,
}

#[derive(Clone, Debug, Default, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct SchematicPages {
    pub sheets: Vec<SheetPage>,
    /// The bodies of the robots, as SVG. A group `body-K` of a sheet is the place of body `K`.
    pub bodies: Vec<String>,
    /// For each robot, the sheet that shows it.
    pub homes: Vec<usize>,
}

#[derive(Clone, Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct SheetPage {
    pub name: String,
    /// More about it, such as `adder, 37 robots`.
    pub about: String,
    pub outer: Option<usize>,
    /// The drawing: a group `cell-N` is robot `N`, `part-N` the box of sheet `N`, `net-NAME` the wires of a net, and
    /// `nets-N` those of several.
    pub svg: String,
    /// The names of the nets of each group `nets-N`.
    pub bundles: Vec<Vec<String>>,
}

impl<'a> Schematic<'a> {
    /// The schematic of a netlist. `robots` are those of its cells in order, or empty if none are chosen yet;
    /// `critical` are the nets of the slowest path.
    pub fn of(circuit: &'a Netlist, robots: &[&'a Robot], critical: &[NetId], scheme: Scheme) -> Self {
        Self {
            circuit,
            hierarchy: Hierarchy::of(circuit),
            robots: robots.to_vec(),
            numbers: circuit.cells().enumerate().map(|(number, (id, _))| (id, number)).collect(),
            critical: critical.to_vec(),
            looks: Looks::of(robots.iter().map(|robot| &robot.body), scheme),
        }
    }

    pub fn top(&self) -> Svg {
        self.draw(0, &self.bodies()).0
    }

    pub fn pages(&self) -> SchematicPages {
        let bodies = self.bodies();
        let page = |(number, part): (usize, &CircuitPart)| {
            let (svg, bundles) = self.draw(number, &bodies);
            SheetPage {
                name: self.hierarchy.titles(number).0.to_owned(),
                about: self.about(number),
                outer: part.outer,
                svg: embedded(&svg.emptied("body-")),
                bundles,
            }
        };
        let sprite = |robot: &&Robot| embedded(&draw_body(&robot.body, &self.looks, scale(robot)));
        SchematicPages {
            sheets: self.hierarchy.parts.iter().enumerate().map(page).collect(),
            bodies: bodies.iter().map(sprite).collect(),
            homes: self.numbers.keys().map(|id| self.hierarchy.home[id]).collect(),
        }
    }

    fn bodies(&self) -> Vec<&'a Robot> {
        let mut seen = BTreeSet::new();
        self.robots.iter().copied().filter(|robot| seen.insert(robot.name.as_str())).collect()
    }

    fn draw(&self, part: usize, bodies: &[&Robot]) -> (Svg, Vec<Vec<String>>) {
        let sheet = Sheet::of(self.circuit, &self.hierarchy, part);
        let plan = SheetPlan::of(&sheet.netlist);
        let path = self.hierarchy.path(part);
        let titles: Vec<&str> = path.iter().map(|&part| self.hierarchy.titles(part).0).collect();
        let title = if path.is_empty() { self.circuit.name.clone() } else { titles.join(" / ") };
        let mut svg = Svg::new(plan.width, plan.height, &format!("schematic of {title}"));
        let mut symbols = Symbols { svg: &mut svg, netlist: &sheet.netlist, plan: &plan };
        let critical = self.critical_wires(&sheet);
        symbols.draw_title(&title);
        let has_parts = !self.hierarchy.parts[part].inner.is_empty();
        symbols.draw_legend(critical.iter().next().is_some(), has_parts);
        let mut bundles = Vec::new();
        for net in plan.nets(&sheet.netlist) {
            let names: Vec<String> = sheet.nets[&net].iter().map(|&id| self.circuit.net_name(id)).collect();
            let (id, title) = match &names[..] {
                [name] => (format!("net-{name}"), self.circuit.net_label(sheet.nets[&net][0])),
                _ => (format!("nets-{}", bundles.len()), counted(names.len(), "net")),
            };
            if names.len() != 1 {
                bundles.push(names);
            }
            svg.group(&id, &title, |svg| draw_net(svg, &sheet.netlist, &plan, net, &critical));
        }
        let mut symbols = Symbols { svg: &mut svg, netlist: &sheet.netlist, plan: &plan };
        let calls: Vec<&CircuitPart> = path.iter().map(|&part| &self.hierarchy.parts[part]).collect();
        let calls: Vec<&str> =
            calls.iter().filter(|part| part.circuit.is_some()).map(|part| part.name.as_str()).collect();
        let prefix = calls.join("/") + "/";
        for (&id, shown) in &sheet.shown {
            match shown {
                SheetItem::Cell(cell) => {
                    let robot = self.robots.get(self.numbers[cell]).copied();
                    let body = robot.map(|robot| {
                        let number = bodies.iter().position(|other| other.name == robot.name);
                        (number.unwrap_or(0), robot, draw_body(&robot.body, &self.looks, scale(robot)))
                    });
                    let net = self.circuit.net_name(*cell);
                    let title = self.title_of(*cell, robot);
                    let own = net.strip_prefix(&prefix).unwrap_or(&net);
                    let short = if self.circuit.is_named(*cell) { own } else { "" };
                    symbols.draw_cell(id, (self.numbers[cell], &title, short), body);
                }
                SheetItem::Part(inner) => {
                    symbols.draw_part(id, *inner, (self.hierarchy.titles(*inner).0, &self.about(*inner)));
                }
                SheetItem::Port => {
                    let key = match &sheet.ports[&id][..] {
                        [net] => self.circuit.net_name(*net),
                        _ => sheet.netlist.net_name(id),
                    };
                    symbols.draw_port(id, &key);
                }
                SheetItem::Wire | SheetItem::Constant => symbols.draw_box(id),
            }
        }
        (svg, bundles)
    }

    /// `register, 37 robots`
    fn about(&self, part: usize) -> String {
        let robots = counted(self.hierarchy.parts[part].size, "robot");
        self.hierarchy.titles(part).1.map_or(robots.clone(), |more| format!("{more}, {robots}"))
    }

    /// `q = nand(set, nq), robot nand_1`
    fn title_of(&self, cell: NetId, robot: Option<&Robot>) -> String {
        let robot = robot.map_or(String::new(), |robot| format!(", robot {}", robot.name));
        if !self.circuit.is_named(cell) {
            return self.circuit.net_label(cell) + &robot;
        }
        let pins: Vec<String> = self.circuit.pins(cell).into_iter().map(|net| self.circuit.net_label(net)).collect();
        let function = self.circuit.cell(cell).map_or(String::new(), |cell| cell.function.to_string());
        format!("{} = {function}({}){robot}", self.circuit.net_name(cell), pins.join(", "))
    }

    fn critical_wires(&self, sheet: &Sheet) -> BTreeSet<(NetId, NetId)> {
        let nodes: Vec<Option<NetId>> = self.critical.iter().map(|&net| sheet.node_of(net)).collect();
        let pair = |pair: &[Option<NetId>]| Some((pair[0]?, pair[1]?)).filter(|(from, to)| from != to);
        nodes.windows(2).filter_map(pair).collect()
    }
}

fn scale(robot: &Robot) -> f64 {
    SIDE / robot.body.width().max(robot.body.height()) as f64
}

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
