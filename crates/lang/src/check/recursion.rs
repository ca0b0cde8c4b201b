//! Circuits that contain themselves.

use crate::check::circuit::Headers;
use crate::check::wording;
use nbc_base::diag::Diagnostic;
use nbc_base::model::CircuitId;
use nbc_base::source::Span;

struct Open {
    circuit: usize,
    next: usize,
}

/// Also returns which circuits are valid with all that they contain. No recursion: a chain of circuits may be long.
pub(crate) fn look(
    calls: &[Vec<(CircuitId, Span)>],
    own_sound: &[bool],
    headers: &Headers,
) -> (Vec<Diagnostic>, Vec<bool>) {
    let mut faults = Vec::new();
    let mut sound = own_sound.to_vec();
    let mut seen = vec![false; calls.len()];
    let mut on_path = vec![false; calls.len()];
    for start in 0..calls.len() {
        let mut path = vec![Open { circuit: start, next: 0 }];
        if seen[start] {
            continue;
        }
        seen[start] = true;
        on_path[start] = true;
        while let Some(top) = path.last_mut() {
            let circuit = top.circuit;
            let Some(&(callee, span)) = calls[circuit].get(top.next) else {
                path.pop();
                on_path[circuit] = false;
                if let Some(outer) = path.last() {
                    sound[outer.circuit] &= sound[circuit];
                }
                continue;
            };
            top.next += 1;
            let callee = callee.0 as usize;
            if on_path[callee] {
                sound[circuit] = false;
                faults.push(recursion(&path, callee, span, headers));
            } else if seen[callee] {
                sound[circuit] &= sound[callee];
            } else {
                seen[callee] = true;
                on_path[callee] = true;
                path.push(Open { circuit: callee, next: 0 });
            }
        }
    }
    (faults, sound)
}

fn recursion(path: &[Open], callee: usize, span: Span, headers: &Headers) -> Diagnostic {
    let first = path.iter().position(|open| open.circuit == callee).unwrap_or_default();
    let name = |circuit: usize| headers.circuits[circuit].name.as_str();
    let through: Vec<&str> = path[first..].iter().skip(1).map(|open| name(open.circuit)).take(4).collect();
    wording::recursion(name(callee), &through, span)
}
