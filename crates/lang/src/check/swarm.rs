//! Swarms: a circuit made of a library's robots.

use crate::check::circuit::Headers;
use crate::check::fields::{self, Fields};
use crate::check::instance::instance;
use crate::check::names::{Home, Names};
use crate::check::quantity;
use crate::check::wording::Expected;
use crate::check::world::Worlds;
use crate::syntax::tree::{RecordDeclaration, ValueKind, ValueSyntax};
use nbc_base::diag::Diagnostic;
use nbc_base::model::{Hold, PhysicsWorld, RegisterStyle, Swarm};

/// The default library of a swarm; the prelude declares it.
pub const DEFAULT_LIBRARY: &str = "shipped";

/// The largest window of an output, in cycles.
const MAX_WINDOW: u32 = 1000;

/// Checks a swarm.
pub(crate) fn swarm(
    source: &RecordDeclaration,
    home: Home,
    names: &Names,
    headers: &Headers,
    worlds: Worlds<'_>,
    faults: &mut Vec<Diagnostic>,
) -> Option<Swarm> {
    let mut fields = Fields::new("swarm", source);
    let circuit = fields.need("circuit", "circuit: d_latch", |value| match &value.kind {
        ValueKind::Instance(source) => instance(source, home, &names.circuits, headers),
        _ => Err(quantity::wrong_kind(Expected::Name("circuit"), value.span)),
    });
    let library = fields.read("library", DEFAULT_LIBRARY.to_owned(), |value| {
        let name = fields::word(value, Expected::Name("library"))?;
        names.libraries.resolve(name, home).map(|_| name.text.clone())
    });
    let hold = fields.read("hold", Hold::Auto, hold);
    let window = fields.read("window", 1, |value| match &value.kind {
        ValueKind::Quantity(window) => {
            quantity::whole(f64::from(quantity::cycles(window)?), 1..=MAX_WINDOW, value.span, "cycles")
        }
        _ => Err(quantity::wrong_kind(Expected::Time("3 cycles"), value.span)),
    });
    let registers = fields.read("registers", RegisterStyle::MasterSlave, |value| {
        fields::choice(value, &[("master_slave", RegisterStyle::MasterSlave), ("pulsed", RegisterStyle::Pulsed)])
    });
    let world = fields.read("world", PhysicsWorld::default(), |value| worlds.of(value, home));
    faults.extend(fields.finish());
    let (name, span) = (source.name.text.clone(), source.name.span);
    Some(Swarm { name, span, circuit: circuit?, library, hold, window, registers, world })
}

fn hold(value: &ValueSyntax) -> Result<Hold, Diagnostic> {
    match &value.kind {
        ValueKind::Quantity(hold) => quantity::cycles(hold).map(Hold::Cycles),
        _ => fields::choice(value, &[("auto", Hold::Auto)])
            .map_err(|_| fields::not_one_of(value, Expected::Hold, &["auto"])),
    }
}
