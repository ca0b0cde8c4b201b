//! Tests against another circuit: which of its ports belong together with those of the tested one. Ports of the same
//! names do, whatever their order; where no name is the same, their order decides.

use crate::check::wording;
use crate::syntax::tree::{self, NameSyntax};
use nbc_base::diag::Diagnostic;
use nbc_base::model::{
    Block, Circuit, CircuitId, Column, Expression, ExpressionId, ExpressionKind, Net, NetSlot, Size, SizeId, SizeKind,
    Statement, Target,
};
use nbc_base::source::Span;

pub(crate) type PortLists<'a> = (&'a [Column], &'a [Column]);

pub(crate) fn port(column: &Column, place: Span, body: &mut tree::BodySyntax) -> tree::Port {
    let mut size = |value: usize| {
        body.sizes.push(tree::SizeSyntax { kind: tree::SizeSyntaxKind::Literal(value.to_string()), span: place });
        tree::SizeSyntaxId(body.sizes.len() as u32 - 1)
    };
    let width = size(column.width / column.words.unwrap_or(1));
    let words = column.words.map(size);
    tree::Port { words, ..tree::Port::new(NameSyntax { text: column.name.clone(), span: place }, Some(width)) }
}

pub(crate) fn reference(
    [tested, other]: [&NameSyntax; 2],
    own: PortLists<'_>,
    (circuit, arguments): (CircuitId, &[Option<u64>]),
    theirs: PortLists<'_>,
) -> Result<Circuit, Diagnostic> {
    let pair = |kind, own, theirs| {
        paired(own, theirs).map_err(|mix| match mix {
            None => wording::different_ports([tested, other]),
            Some(ports) => wording::mixed_ports([tested, other], kind, &ports),
        })
    };
    let inputs = pair("inputs", own.0, theirs.0)?;
    let outputs = pair("outputs", own.1, theirs.1)?;
    Ok(call(format!("{} as a reference", other.text), tested.span, own, (circuit, arguments), [inputs, outputs]))
}

fn paired(own: &[Column], theirs: &[Column]) -> Result<Vec<usize>, Option<[Vec<String>; 2]>> {
    let has = |ports: &[Column], name: &str| ports.iter().any(|port| port.name == name);
    let alone = |ports: &[Column], others: &[Column]| -> Vec<String> {
        ports.iter().map(|port| port.name.clone()).filter(|name| !has(others, name)).collect()
    };
    if own.len() != theirs.len() {
        return Err(None);
    }
    let unknown = [alone(own, theirs), alone(theirs, own)];
    let places: Vec<usize> = match unknown[1].len() {
        0 => theirs.iter().filter_map(|port| own.iter().position(|one| one.name == port.name)).collect(),
        all if all == theirs.len() => (0..theirs.len()).collect(),
        _ => return Err(Some(unknown)),
    };
    let fit = places.iter().zip(theirs).all(|(&place, port)| own[place].width == port.width);
    if fit { Ok(places) } else { Err(None) }
}

fn call(
    name: String,
    span: Span,
    (own_inputs, own_outputs): PortLists<'_>,
    (circuit, arguments): (CircuitId, &[Option<u64>]),
    [inputs, outputs]: [Vec<usize>; 2],
) -> Circuit {
    let mut sizes = Vec::new();
    let mut size = |value: i128| {
        sizes.push(Size { kind: SizeKind::Literal(value), span });
        SizeId(sizes.len() as u32 - 1)
    };
    let net = |port: &Column| Net {
        name: port.name.clone(),
        span,
        width: Some(size(port.width as i128)),
        words: None,
        default: None,
        members: None,
        selects: None,
        is_text: false,
    };
    let nets: Vec<Net> = own_inputs.iter().chain(own_outputs).map(net).collect();
    let arguments = arguments.iter().map(|value| value.map(|value| size(value as i128))).collect();
    let operand = |&place: &usize| Expression { kind: ExpressionKind::Net(NetSlot(place as u32)), span };
    let mut expressions: Vec<Expression> = inputs.iter().map(operand).collect();
    let operands = (0..inputs.len() as u32).map(|at| Some(ExpressionId(at))).collect();
    expressions.push(Expression { kind: ExpressionKind::Call { circuit, arguments, operands }, span });
    let target = |place: usize| Target {
        net: Some(NetSlot((own_inputs.len() + place) as u32)),
        word: None,
        bits: None,
        start: None,
        span,
    };
    let value = ExpressionId(inputs.len() as u32);
    let drive = Statement::Drive { targets: outputs.into_iter().map(target).collect(), joined: false, value };
    Circuit {
        name,
        span,
        parameters: Vec::new(),
        inputs: own_inputs.len(),
        outputs: own_outputs.len(),
        body: Block { nets: 0..nets.len() as u32, statements: vec![drive] },
        nets,
        sizes,
        expressions,
        tables: Vec::new(),
        variables: 0,
        memories: Vec::new(),
        bits: Vec::new(),
    }
}
