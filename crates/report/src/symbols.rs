//! The symbols of a sheet: cells with their robots, parts, ports, and the legend.

use crate::Color;
use crate::element::{Anchor, Paint, Point, Type};
use crate::layers::Slot;
use crate::svg::{Svg, shorten, shorten_start};
use crate::wires::{MOST_LETTERS, SheetPlan, wire};
use nbc_base::model::Robot;
use nbc_circuit::{NetId, Netlist};

pub const SIDE: f64 = 52.0;
/// The most letters in a cell: of its function and its net, and of its robot.
const LETTERS: (usize, usize) = (18, 22);

pub struct Symbols<'a> {
    pub svg: &'a mut Svg,
    pub netlist: &'a Netlist,
    pub plan: &'a SheetPlan,
}

impl Symbols<'_> {
    fn corner(&self, id: NetId) -> Point {
        self.plan.corners[&(self.plan.layers.layer_of(id), Slot::Node(id))]
    }

    pub fn draw_title(&mut self, title: &str) {
        let letters = (self.plan.width / 11.0) as usize;
        self.svg.text((14.0, 28.0), &shorten_start(title, letters.max(2)), Type::new(17.0).bold());
    }

    pub fn draw_cell(
        &mut self,
        id: NetId,
        (number, title, net): (usize, &str, &str),
        body: Option<(usize, &Robot, Svg)>,
    ) {
        let ((x, y), (width, height)) = (self.corner(id), self.plan.size(self.netlist, id));
        let function = self.netlist.cell(id).map_or("", |cell| cell.function.name());
        self.svg.group(&format!("cell-{number}"), title, |svg| {
            svg.rect((x, y), width, height, Paint::fill(Color::WHITE).with_stroke(Color::BLACK, 1.4));
            let bold = Type::new(11.0).bold();
            svg.text((x + 6.0, y + 15.0), &shorten(&function.to_uppercase(), LETTERS.0), bold);
            svg.text((x + 6.0, y + 28.0), &shorten_start(net, LETTERS.0), Type::new(10.0).colored(Color::GRAY));
            let Some((number, robot, body)) = body else { return };
            let at = (x + (width - body.width()) / 2.0, y + 33.0 + (SIDE - body.height()).max(0.0));
            let mut sprite = Svg::transparent(body.width(), body.height(), "");
            sprite.group(&format!("body-{number}"), &robot.name, |svg| svg.place((0.0, 0.0), 1.0, &body));
            svg.place(at, 1.0, &sprite);
            let middle = Type::new(9.0).colored(Color::GRAY).anchored(Anchor::Middle);
            svg.text((x + width / 2.0, y + height - 6.0), &shorten(&robot.name, LETTERS.1), middle);
        });
    }

    pub fn draw_part(&mut self, id: NetId, number: usize, (name, about): (&str, &str)) {
        let (corner, (width, height)) = (self.corner(id), self.plan.size(self.netlist, id));
        self.svg.group(&format!("part-{number}"), &format!("{name}: {about}"), |svg| {
            draw_part_box(svg, corner, (width, height));
            let (x, y) = (corner.0 + width / 2.0, corner.1 + height / 2.0);
            let line = |size| Type::new(size).anchored(Anchor::Middle);
            svg.text((x, y - 4.0), &shorten_start(name, LETTERS.0), line(11.0).bold());
            let (circuit, robots) = about.rsplit_once(", ").unwrap_or(("", about));
            svg.text((x, y + 14.0), &shorten(circuit, LETTERS.0), line(10.0));
            svg.text((x, y + 30.0), robots, line(10.0).colored(Color::GRAY));
        });
    }

    /// `key` is the port's net if it has only one.
    pub fn draw_port(&mut self, id: NetId, key: &str) {
        let name = self.netlist.net_name(id);
        let direction = if self.netlist.inputs().contains(&id) { "input" } else { "output" };
        let (corner, size) = (self.corner(id), self.plan.size(self.netlist, id));
        self.svg.group(&format!("{direction}-{key}"), &name, |svg| draw_label(svg, corner, size, &name));
    }

    pub fn draw_box(&mut self, id: NetId) {
        let (corner, size) = (self.corner(id), self.plan.size(self.netlist, id));
        draw_label(self.svg, corner, size, &self.netlist.net_name(id));
    }

    pub fn draw_legend(&mut self, has_critical_path: bool, has_parts: bool) {
        let y = self.plan.height - 12.0;
        let gray = Type::new(11.0).colored(Color::GRAY);
        if has_critical_path {
            self.svg.line((14.0, y - 4.0), (40.0, y - 4.0), wire(true));
            self.svg.text((46.0, y), "critical path", gray);
        }
        if has_parts {
            draw_part_box(self.svg, (146.0, y - 11.0), (22.0, 12.0));
            self.svg.text((176.0, y), "a part with robots", gray);
        }
    }
}

fn draw_part_box(svg: &mut Svg, (x, y): Point, (width, height): Point) {
    svg.rect((x, y), width, height, Paint::fill(Color::PALE).with_stroke(Color::BLACK, 1.4));
    svg.rect((x + 3.0, y + 3.0), width - 6.0, height - 6.0, Paint::stroke(Color::GRAY, 1.0));
}

fn draw_label(svg: &mut Svg, (x, y): Point, (width, height): Point, name: &str) {
    svg.rect((x, y), width, height, Paint::fill(Color::PALE).with_stroke(Color::GRAY, 1.0));
    let set = Type::new(11.0).bold().anchored(Anchor::Middle);
    svg.text((x + width / 2.0, y + height / 2.0 + 4.0), &shorten_start(name, MOST_LETTERS), set);
}
