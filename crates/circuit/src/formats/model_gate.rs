//! Models that are gates: the function of one or two inputs that their covers compute together.

use std::collections::BTreeMap;

use nbc_base::model::Function;

pub(super) struct ModelCover<'t> {
    pub(super) pins: Vec<&'t str>,
    pub(super) output: &'t str,
    /// Cubes with a digit `0`, `1` or `-` for each pin.
    pub(super) cubes: &'t [Vec<u8>],
    pub(super) value: bool,
}

/// The values of the inputs in the four rows of a table: the bits of the functions `a` and `b`.
const INPUTS: [Function; 2] = [Function::BUF, Function::BUF_B];
const ROWS: u8 = 0b1111;

/// Of one input, the function ignores the second. `None` if a net is undefined, defined twice or on a loop.
pub(super) fn gate<'t>(inputs: &[&'t str], output: &str, mut covers: Vec<ModelCover<'t>>) -> Option<Function> {
    let mut known: BTreeMap<&str, u8> =
        inputs.iter().zip(INPUTS).map(|(&input, values)| (input, values.bits())).collect();
    while !covers.is_empty() {
        let waiting = covers.len();
        let ready = |cover: &ModelCover<'_>| cover.pins.iter().all(|pin| known.contains_key(pin));
        let (now, later): (Vec<_>, Vec<_>) = covers.into_iter().partition(ready);
        for cover in &now {
            let values = values(cover, &known);
            if known.insert(cover.output, values).is_some() {
                return None;
            }
        }
        covers = later;
        if covers.len() == waiting {
            return None;
        }
    }
    known.get(output).map(|&bits| Function::new(bits)).filter(|function| function.arity() > 0)
}

fn values(cover: &ModelCover<'_>, known: &BTreeMap<&str, u8>) -> u8 {
    let literal = |(pin, digit): (&&str, &u8)| match digit {
        b'1' => known[pin],
        b'0' => !known[pin] & ROWS,
        _ => ROWS,
    };
    let product = |cube: &Vec<u8>| cover.pins.iter().zip(cube).map(literal).fold(ROWS, |all, one| all & one);
    let sum = cover.cubes.iter().map(product).fold(0, |any, one| any | one);
    if cover.value { sum } else { !sum & ROWS }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The function of `y` for covers such as `a b t: 11`, where rows of a cover with output 0 follow `!`.
    fn check(covers: &[&'static str], expected: Option<Function>) {
        let parse = |text: &&'static str| {
            let (names, rows) = text.split_once(':').unwrap();
            let mut pins: Vec<&str> = names.split_whitespace().collect();
            let output = pins.pop().unwrap();
            let value = !rows.contains('!');
            let cubes: Vec<Vec<u8>> = rows.replace('!', "").split_whitespace().map(|row| row.into()).collect();
            ModelCover { pins, output, cubes: Vec::leak(cubes), value }
        };
        assert_eq!(gate(&["a", "b"], "y", covers.iter().map(parse).collect()), expected, "{covers:?}");
    }

    #[test]
    fn covers_in_any_order_make_one_function() {
        check(&["t y: 0", "a b t: 11"], Some(Function::NAND));
        check(&["a b y: ! 11"], Some(Function::NAND));
        check(&["a n: 0", "n b y: 1- -1"], Some(Function::parse("nota_or_b").unwrap()));
        check(&["b y: 1", "unused:"], Some(Function::BUF_B));
    }

    #[test]
    fn anything_else_is_no_gate() {
        check(&["y:"], None);
        check(&["a z y: 11"], None);
        check(&["a y y: 11"], None);
        check(&["a y: 1", "b y: 1"], None);
        check(&["a a: 1", "a y: 1"], None);
    }
}
