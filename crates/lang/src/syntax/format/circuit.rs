//! Circuits and their statements.

use crate::syntax::format::expression::{Written, expression, index, size};
use crate::syntax::format::layout::{LayoutPiece, layout};
use crate::syntax::format::printer::Printer;
use crate::syntax::tree::{
    BodySyntax, CircuitSyntax, Grouping, ParameterSyntax, Port, SizeSyntax, StatementKind, StatementSyntax,
    TargetSyntax,
};
use nbc_base::source::Span;

impl Printer<'_> {
    pub(super) fn circuit(&mut self, circuit: &CircuitSyntax, span: Span) {
        let sizes = &circuit.body.sizes;
        let mut pieces = vec![LayoutPiece::Text(format!(
            "{} {}{}",
            keyword(circuit),
            circuit.name.text,
            parameters(sizes, &circuit.parameters)
        ))];
        ports(sizes, &circuit.inputs, &mut pieces);
        pieces.push(LayoutPiece::Text(" -> ".to_owned()));
        ports(sizes, &circuit.outputs, &mut pieces);
        let head = layout(&pieces, self.column(), self.indent);
        self.write(&head);
        self.write(" ");
        self.block(span.end, |printer| printer.statements(&circuit.body, &circuit.body.statements));
    }

    pub(super) fn statements(&mut self, body: &BodySyntax, statements: &[StatementSyntax]) {
        let mut at = 0;
        while at < statements.len() {
            let run = self.aligned_run(&statements[at..]);
            let lefts: Vec<_> = statements[at..at + run].iter().map(|statement| left(body, statement)).collect();
            let width = lefts.iter().map(|left| left.chars().count()).max().unwrap_or(0);
            for (statement, left) in statements[at..at + run].iter().zip(&lefts) {
                self.statement(body, statement, left, width);
            }
            at += run;
        }
    }

    /// The number of statements at the start whose `=` are aligned: drivers of one target on adjacent lines.
    fn aligned_run(&self, statements: &[StatementSyntax]) -> usize {
        let plain = |statement: &StatementSyntax| {
            matches!(statement.kind, StatementKind::Drive { grouping: Grouping::Single, .. })
        };
        let follows = |pair: &&[StatementSyntax]| {
            plain(&pair[0])
                && plain(&pair[1])
                && self.adjacent(pair[0].span, pair[1].span)
                && !self.has_comment_inside(pair[1].span)
        };
        1 + statements.windows(2).take_while(follows).count()
    }

    fn statement(&mut self, body: &BodySyntax, statement: &StatementSyntax, left: &str, width: usize) {
        let head = match &statement.kind {
            StatementKind::For { statements, .. } => {
                statements.first().map_or(statement.span.end, |first| first.span.start)
            }
            StatementKind::If { blocks, .. } => blocks[0].start + 1,
            _ => statement.span.end,
        };
        let pieces = match &statement.kind {
            StatementKind::Drive { value, .. } => {
                let (source, comments) = self.source();
                expression(Written { body, source, comments }, *value)
            }
            _ => Vec::new(),
        };
        self.place(places(&pieces));
        self.item_with_inside(statement.span, head, |printer| match &statement.kind {
            StatementKind::Nets(_) | StatementKind::Let { .. } => printer.write(left),
            StatementKind::If { .. } => printer.conditional(body, statement, left),
            StatementKind::For { statements, .. } => {
                printer.write(left);
                printer.block(statement.span.end, |printer| printer.statements(body, statements));
            }
            StatementKind::Drive { .. } => {
                printer.write(&format!("{left:width$} = "));
                let text = layout(&pieces, printer.column(), printer.indent);
                printer.write(&text);
            }
        });
    }

    fn conditional(&mut self, body: &BodySyntax, statement: &StatementSyntax, head: &str) {
        let StatementKind::If { then, otherwise, blocks, .. } = &statement.kind else { return };
        self.write(head);
        self.block(blocks[0].end, |printer| printer.statements(body, then));
        self.last_end(blocks[0].end);
        match &otherwise[..] {
            [] if blocks[1].start == blocks[1].end => {}
            [next] if next.span == blocks[1] && matches!(next.kind, StatementKind::If { .. }) => {
                self.write(" else ");
                let head = left(body, next);
                self.conditional(body, next, &head);
            }
            _ => {
                self.write(" else ");
                self.block(blocks[1].end, |printer| printer.statements(body, otherwise));
            }
        }
    }
}

fn keyword(circuit: &CircuitSyntax) -> &'static str {
    if circuit.is_environment { "environment" } else { "circuit" }
}

pub(super) fn places(pieces: &[LayoutPiece]) -> impl Iterator<Item = u32> {
    pieces.iter().filter_map(|piece| match piece {
        LayoutPiece::Comment { start, .. } => Some(*start),
        _ => None,
    })
}

fn left(body: &BodySyntax, statement: &StatementSyntax) -> String {
    let sizes = &body.sizes;
    match &statement.kind {
        StatementKind::Nets(nets) => {
            format!("net {}", nets.iter().map(|net| port(sizes, net)).collect::<Vec<_>>().join(", "))
        }
        StatementKind::Let { name, value } => format!("let {} = {}", name.text, size(sizes, *value)),
        StatementKind::If { left, comparison, right, .. } => {
            format!("if {} {} {} ", size(sizes, *left), comparison.sign(), size(sizes, *right))
        }
        StatementKind::For { variable, from, to, .. } => {
            format!("for {} in {}..{} ", variable.text, size(sizes, *from), size(sizes, *to))
        }
        StatementKind::Drive { targets, grouping, .. } => {
            let targets = targets.iter().map(|one| target(body, one)).collect::<Vec<_>>().join(", ");
            match grouping {
                Grouping::Single => targets,
                Grouping::Outputs => format!("({targets})"),
                Grouping::Joined => format!("{{{targets}}}"),
            }
        }
    }
}

fn target(body: &BodySyntax, target: &TargetSyntax) -> String {
    let start = target.start.map_or(String::new(), |start| format!(" init {}", size(&body.sizes, start)));
    let [index, second] = [&target.index, &target.second].map(|bits| bits.as_ref().map(|bits| index(body, bits)));
    format!("{}{}{}{start}", target.name.text, index.unwrap_or_default(), second.unwrap_or_default())
}

fn port(sizes: &[SizeSyntax], port: &Port) -> String {
    let mut text = port.name.text.clone();
    text.extend([port.words, port.width].into_iter().flatten().map(|bits| format!("[{}]", size(sizes, bits))));
    text.extend(port.members.iter().map(|name| format!(": {}", name.text)));
    text.extend(port.absent.iter().map(|value| format!(" = {}", size(sizes, *value))));
    text.extend(port.contents.iter().map(|name| format!(" init {}", name.text)));
    text
}

fn parameters(sizes: &[SizeSyntax], parameters: &[ParameterSyntax]) -> String {
    let one = |parameter: &ParameterSyntax| {
        let default = parameter.default.map_or(String::new(), |default| format!(" = {}", size(sizes, default)));
        format!("{}{default}", parameter.name.text)
    };
    match parameters {
        [] => String::new(),
        _ => format!("[{}]", parameters.iter().map(one).collect::<Vec<_>>().join(", ")),
    }
}

fn ports(sizes: &[SizeSyntax], list: &[Port], pieces: &mut Vec<LayoutPiece>) {
    pieces.extend([LayoutPiece::Text("(".to_owned()), LayoutPiece::Open]);
    for (at, one) in list.iter().enumerate() {
        pieces.push(LayoutPiece::Break(if at == 0 { "" } else { ", " }));
        pieces.push(LayoutPiece::Text(port(sizes, one)));
    }
    pieces.extend([LayoutPiece::EndBreak(""), LayoutPiece::Close, LayoutPiece::Text(")".to_owned())]);
}
