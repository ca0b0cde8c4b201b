//! Flattens a module: everything inside it becomes cells of one netlist, with names and start values.

use crate::elaborate::build::Builder;
use crate::elaborate::module::{ModuleId, ModuleSignal};
use crate::elaborate::wording;
use crate::index::ListIndex;
use crate::register::Forcing;
use crate::{BlockId, Blocks, Cell, NetId, Netlist, Node, RegisterNode};
use nbc_base::diag::Diagnostic;
use nbc_base::source::Span;

/// An instance of a module: `base` is the offset of its signals.
struct Place {
    module: ModuleId,
    base: u32,
    inputs: Vec<u32>,
    prefix: String,
    block: BlockId,
}

pub(super) fn flatten(builder: &Builder<'_>, top: ModuleId, name: &str) -> Result<Netlist, Diagnostic> {
    let mut netlist = Netlist::new(name);
    let places = places(builder, top, netlist.blocks_mut());
    let same = resolve(aliases(builder, &places)).map_err(|at| self_driven(builder, &places, at))?;
    let mut nets = vec![None; same.len()];
    add_inputs(builder, top, &mut netlist, &mut nets);
    add_cells(builder, &places, &same, &mut netlist, &mut nets);
    let net = |end: u32| nets[end as usize].expect("every signal ends in a net");
    let nets: Vec<NetId> = same.into_iter().map(net).collect();
    connect(builder, &places, &mut netlist, &nets);
    name_cells(builder, &places, &mut netlist, &nets);
    add_outputs(builder, top, &mut netlist, &nets);
    Ok(netlist)
}

/// The module and everything inside it, outer modules first; each is a block.
fn places(builder: &Builder<'_>, top: ModuleId, blocks: &mut Blocks) -> Vec<Place> {
    let top = Place { module: top, base: 0, inputs: Vec::new(), prefix: String::new(), block: BlockId::TOP };
    let mut next = builder.module(top.module).signals.len() as u32;
    let mut places = vec![top];
    let mut at = 0;
    while at < places.len() {
        let (module, base, outer) = (builder.module(places[at].module), places[at].base, places[at].block);
        for site in &module.sites {
            let inputs = site.inputs.iter().map(|bit| base + bit).collect();
            let prefix = format!("{}{}/", places[at].prefix, site.name);
            let circuit = &builder.circuit(builder.module(site.module).circuit).name;
            let is_stored = builder.program.stored == Some(builder.module(site.module).circuit);
            let block = if is_stored { outer } else { blocks.add(&site.name, circuit, outer) };
            places.push(Place { module: site.module, base: next, inputs, prefix, block });
            next += builder.module(site.module).signals.len() as u32;
        }
        at += 1;
    }
    places
}

fn aliases(builder: &Builder<'_>, places: &[Place]) -> Vec<Option<ListIndex>> {
    let mut same = Vec::new();
    // The instances inside an instance are adjacent, after those inside earlier instances.
    let mut inside = 1;
    for (at, place) in places.iter().enumerate() {
        let module = builder.module(place.module);
        same.extend(module.signals.iter().map(|signal| match *signal {
            ModuleSignal::Input(_) if at == 0 => None,
            ModuleSignal::Input(bit) => Some(ListIndex::new(place.inputs[bit as usize])),
            ModuleSignal::Constant(_) | ModuleSignal::Gate { .. } | ModuleSignal::Register { .. } => None,
            ModuleSignal::Net { driver, .. } => {
                let driver = driver.expect("every net is driven");
                Some(ListIndex::new(place.base + driver.get()))
            }
            ModuleSignal::Output { site, bit } => {
                let inner = &places[inside + site as usize];
                Some(ListIndex::new(inner.base + builder.module(inner.module).output_bits[bit as usize]))
            }
        }));
        inside += module.sites.len();
    }
    same
}

fn resolve(mut same: Vec<Option<ListIndex>>) -> Result<Vec<u32>, usize> {
    for start in 0..same.len() {
        let mut end = start;
        let mut steps = 0;
        while let Some(next) = same[end] {
            end = next.get() as usize;
            steps += 1;
            if steps > same.len() {
                return Err(start);
            }
        }
        let mut at = start;
        while let Some(next) = same[at] {
            same[at] = Some(ListIndex::new(end as u32));
            at = next.get() as usize;
        }
    }
    Ok(same.into_iter().zip(0..).map(|(end, at)| end.map_or(at, ListIndex::get)).collect())
}

fn named<'a>(builder: &'a Builder<'_>, place: &'a Place) -> impl Iterator<Item = (u32, String, Span)> + 'a {
    let module = builder.module(place.module);
    module.signals.iter().enumerate().filter_map(move |(at, signal)| {
        let ModuleSignal::Net { net, bit, .. } = *signal else { return None };
        let net = &module.nets[net as usize];
        let bit = if net.width == Some(1) { String::new() } else { format!("[{bit}]") };
        Some((place.base + at as u32, format!("{}{}{bit}", place.prefix, net.name), net.span))
    })
}

fn self_driven(builder: &Builder<'_>, places: &[Place], at: usize) -> Diagnostic {
    let place = places.iter().rev().find(|place| place.base as usize <= at).expect("every signal has its place");
    // A signal that ends in a loop of names need not have a name itself; then the place's first net will do.
    let nets: Vec<_> = named(builder, place).collect();
    let (_, name, span) =
        nets.iter().find(|net| net.0 as usize == at).or(nets.first()).expect("only nets drive themselves");
    wording::driven_by_itself(name, *span)
}

fn add_inputs(builder: &Builder<'_>, top: ModuleId, netlist: &mut Netlist, nets: &mut [Option<NetId>]) {
    for (column, port) in builder.columns(top).0.iter().zip(&builder.module(top).inputs) {
        for (name, bit) in column.bits().into_iter().zip((0..port.width).rev()) {
            nets[(port.first + bit) as usize] = Some(netlist.add_input(name));
        }
    }
}

fn add_cells(builder: &Builder<'_>, places: &[Place], same: &[u32], netlist: &mut Netlist, nets: &mut [Option<NetId>]) {
    let mut constants = [None; 2];
    for place in places {
        for (signal, at) in builder.module(place.module).signals.iter().zip(place.base as usize..) {
            if same[at] as usize != at {
                continue;
            }
            nets[at] = match *signal {
                ModuleSignal::Gate { function, span, .. } => {
                    let cell = Cell { function, name: None, start: None, span: Some(span) };
                    let id = netlist.add_loose_cell(cell);
                    netlist.put_into(id, place.block);
                    Some(id)
                }
                ModuleSignal::Register { kind, forcing, start, .. } => {
                    let register = RegisterNode { kind, forcing, start: Some(start), name: None, span: None };
                    let id = netlist.add_loose_register(register);
                    netlist.put_into(id, place.block);
                    Some(id)
                }
                ModuleSignal::Constant(value) => {
                    Some(*constants[usize::from(value)].get_or_insert_with(|| netlist.add_constant(value)))
                }
                _ => nets[at],
            };
        }
    }
}

fn connect(builder: &Builder<'_>, places: &[Place], netlist: &mut Netlist, nets: &[NetId]) {
    for place in places {
        for (signal, at) in builder.module(place.module).signals.iter().zip(place.base as usize..) {
            let pins = match signal {
                ModuleSignal::Gate { function, pins, .. } => &pins[..function.arity()],
                ModuleSignal::Register { forcing: Forcing::Never, pins, .. } => &pins[..2],
                ModuleSignal::Register { forcing: Forcing::ToStart, pins: [data, clock, _, reset], .. } => {
                    &[*data, *clock, *reset]
                }
                ModuleSignal::Register { pins, .. } => &pins[..],
                _ => continue,
            };
            for (pin, bit) in (0..).zip(pins) {
                netlist.connect(nets[at], pin, nets[(place.base + bit) as usize]);
            }
        }
    }
}

/// Cells and registers are called as the outermost net that they drive; cells begin with its start value.
fn name_cells(builder: &Builder<'_>, places: &[Place], netlist: &mut Netlist, nets: &[NetId]) {
    for place in places {
        for (signal, name, _) in named(builder, place) {
            if let Node::Cell(Cell { name: own, .. }) | Node::Register(RegisterNode { name: own, .. }) =
                netlist.node_mut(nets[signal as usize])
            {
                own.get_or_insert(name);
            }
        }
        for &(bit, start) in &builder.module(place.module).starts {
            if let Some(cell) = netlist.cell_mut(nets[(place.base + bit) as usize]) {
                cell.start.get_or_insert(start);
            }
        }
    }
}

fn add_outputs(builder: &Builder<'_>, top: ModuleId, netlist: &mut Netlist, nets: &[NetId]) {
    let module = builder.module(top);
    let mut first = 0;
    for (column, port) in builder.columns(top).1.iter().zip(&module.outputs) {
        for (name, bit) in column.bits().into_iter().zip((0..port.width).rev()) {
            let signal = module.output_bits[(first + bit) as usize];
            netlist.add_output(name, nets[signal as usize]);
        }
        first += port.width;
    }
}
