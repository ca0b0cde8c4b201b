//! The vertical positions of slots in a layered drawing, so that most wires are straight.

use crate::layers::{Layers, Slot};
use nbc_circuit::Netlist;

const SWEEPS: usize = 12;

/// The top of each slot, layer by layer, the uppermost at 0. Slots keep their order and are at least `gap` apart.
pub fn straighten(layers: &Layers, netlist: &Netlist, height: impl Fn(Slot) -> f64, gap: f64) -> Vec<Vec<f64>> {
    let stacked = |slots: &Vec<Slot>| {
        let tops = slots.iter().scan(0.0, |next, &slot| {
            let top = *next;
            *next += height(slot) + gap;
            Some(top)
        });
        tops.collect::<Vec<f64>>()
    };
    let mut tops: Vec<Vec<f64>> = layers.layers.iter().map(stacked).collect();
    for sweep in 0..SWEEPS {
        let count = layers.layers.len();
        let order: Vec<usize> = if sweep % 2 == 0 { (0..count).collect() } else { (0..count).rev().collect() };
        for layer in order {
            let wanted: Vec<f64> = (0..layers.layers[layer].len())
                .map(|place| wanted(layers, netlist, &tops, &height, (layer, place), sweep % 2 == 0))
                .collect();
            let needed: Vec<f64> = layers.layers[layer].iter().map(|&slot| height(slot) + gap).collect();
            tops[layer] = nearest(&wanted, &needed);
        }
    }
    let highest = tops.iter().flatten().copied().fold(f64::INFINITY, f64::min);
    tops.into_iter().map(|layer| layer.into_iter().map(|top| top - highest).collect()).collect()
}

/// The position of a slot at which its wires to one side are straight on average; its current position if it has none.
fn wanted(
    layers: &Layers,
    netlist: &Netlist,
    tops: &[Vec<f64>],
    height: &impl Fn(Slot) -> f64,
    (layer, place): (usize, usize),
    forwards: bool,
) -> f64 {
    let slot = layers.layers[layer][place];
    let top_of = |layer: usize, slot: Slot| {
        let place = layers.layers[layer].iter().position(|&other| other == slot);
        tops[layer][place.expect("a neighbor stands in its layer")]
    };
    // A wire leaves the middle of a slot, and enters at its pin.
    let wires: Vec<f64> = if forwards {
        layers
            .entries(netlist, slot, layer)
            .into_iter()
            .map(|(before, share)| top_of(layer - 1, before) + height(before) / 2.0 - height(slot) * share)
            .collect()
    } else {
        layers
            .after(netlist, slot, layer)
            .into_iter()
            .map(|(next, after)| {
                let entries = layers.entries(netlist, after, next).into_iter();
                let shares: Vec<f64> = entries.filter(|(before, _)| *before == slot).map(|(_, share)| share).collect();
                let share = shares.iter().sum::<f64>() / shares.len().max(1) as f64;
                top_of(next, after) + height(after) * share - height(slot) / 2.0
            })
            .collect()
    };
    if wires.is_empty() { tops[layer][place] } else { wires.iter().sum::<f64>() / wires.len() as f64 }
}

/// The tops closest to the wanted ones by least squares that keep the order and do not overlap: neighbors that would
/// overlap are placed together at their mean (isotonic regression by pooling adjacent violators).
fn nearest(wanted: &[f64], needed: &[f64]) -> Vec<f64> {
    let offsets: Vec<f64> = needed
        .iter()
        .scan(0.0, |next, room| {
            let offset = *next;
            *next += room;
            Some(offset)
        })
        .collect();
    let mut pools: Vec<(f64, usize)> = Vec::new();
    for (want, offset) in wanted.iter().zip(&offsets) {
        let mut pool = (want - offset, 1);
        while let Some(&(mean, count)) = pools.last().filter(|(mean, _)| *mean > pool.0) {
            pools.pop();
            let both = count + pool.1;
            pool = ((mean * count as f64 + pool.0 * pool.1 as f64) / both as f64, both);
        }
        pools.push(pool);
    }
    let free = pools.into_iter().flat_map(|(mean, count)| std::iter::repeat_n(mean, count));
    free.zip(offsets).map(|(mean, offset)| mean + offset).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(wanted: &[f64], needed: &[f64], expected: &[f64]) {
        assert_eq!(nearest(wanted, needed), expected);
    }

    #[test]
    fn slots_are_at_their_wanted_places_if_there_is_room() {
        check(&[0.0, 30.0], &[20.0, 20.0], &[0.0, 30.0]);
        check(&[], &[], &[]);
    }

    #[test]
    fn slots_with_the_same_wanted_place_share_it() {
        check(&[10.0, 10.0], &[20.0, 20.0], &[0.0, 20.0]);
        check(&[50.0, 0.0, 100.0], &[10.0, 10.0, 10.0], &[20.0, 30.0, 100.0]);
    }
}
