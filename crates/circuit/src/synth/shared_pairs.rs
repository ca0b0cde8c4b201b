//! Shared pairs: trees of ANDs, or of ORs, become sets of literals, and the pair of literals that most sets have in
//! common is combined first. What remains of a set becomes a tree of few levels.

use std::collections::{BTreeMap, BTreeSet};

use crate::network::{Gate, Network, Signal, inverted};
use nbc_base::model::Function;

const MOST_LITERALS: usize = 100;

/// A signal of the network, maybe inverted: 2 times the signal, plus 1 if it is inverted.
type Literal = u32;

const FALSE: Literal = 0;
const TRUE: Literal = 1;

pub fn share_pairs(network: &Network) -> Network {
    let mut conjunctions = Conjunctions::of(network);
    conjunctions.share();
    conjunctions.network(network)
}

#[derive(Clone, Debug)]
enum Form {
    Alias,
    Exclusive([Literal; 2]),
    Set(usize),
    Pair([Literal; 2]),
}

struct Conjunctions {
    forms: Vec<Form>,
    literals: Vec<Literal>,
    sets: Vec<Vec<Literal>>,
    members: BTreeMap<Literal, BTreeSet<usize>>,
    counts: BTreeMap<[Literal; 2], u32>,
    ranked: BTreeSet<(u32, std::cmp::Reverse<[Literal; 2]>)>,
}

impl Conjunctions {
    fn of(network: &Network) -> Self {
        let mut conjunctions = Self {
            forms: vec![Form::Alias; 2 + network.inputs],
            literals: (0..2 + network.inputs as u32).map(|signal| 2 * signal).collect(),
            sets: Vec::new(),
            members: BTreeMap::new(),
            counts: BTreeMap::new(),
            ranked: BTreeSet::new(),
        };
        conjunctions.literals[1] = TRUE;
        for (i, gate) in network.gates.iter().enumerate() {
            let literal = conjunctions.equal_literal(2 + (network.inputs + i) as Signal, gate);
            conjunctions.literals.push(literal);
        }
        let readers = conjunctions.readers(network);
        for gate in &network.gates {
            let form = conjunctions.form(gate, &readers);
            conjunctions.forms.push(form);
        }
        conjunctions
    }

    /// The literal that a gate equals: of an earlier signal, or of its own.
    fn equal_literal(&self, signal: Signal, gate: &Gate) -> Literal {
        let Gate { function, pins } = *gate;
        if is_alias(gate) {
            let pin = pins[usize::from(!function.depends_on(0))];
            let literal = self.literals[pin as usize];
            return match (function.output(false, false), function.output(true, true)) {
                (false, true) => literal,
                (true, false) => literal ^ 1,
                (constant, _) => Literal::from(constant),
            };
        }
        let turned = match function {
            Function::XOR | Function::XNOR => {
                let pins = pins.map(|pin| self.literals[pin as usize]);
                pins[0] & 1 ^ pins[1] & 1 ^ Literal::from(function == Function::XNOR)
            }
            _ => Literal::from(function.bits().count_ones() == 3),
        };
        2 * signal + turned
    }

    /// The readers of each signal, direct or inverted; an output counts as two.
    fn readers(&self, network: &Network) -> Vec<u32> {
        let mut readers = vec![0; network.signals()];
        for gate in network.gates.iter().filter(|gate| !is_alias(gate)) {
            gate.pins.iter().for_each(|&pin| readers[(self.literals[pin as usize] / 2) as usize] += 1);
        }
        network.outputs.iter().for_each(|&output| readers[(self.literals[output as usize] / 2) as usize] += 2);
        readers
    }

    fn form(&mut self, gate: &Gate, readers: &[u32]) -> Form {
        if is_alias(gate) {
            return Form::Alias;
        }
        let literals = gate.pins.map(|pin| self.literals[pin as usize]);
        if gate.function == Function::XOR || gate.function == Function::XNOR {
            return Form::Exclusive(literals.map(|literal| literal & !1));
        }
        // One output of the gate differs from the other three. It is the one at which both literals are 1.
        let value = gate.function.bits().count_ones() == 1;
        let differs = |at: &u32| gate.function.output(at & 2 > 0, at & 1 > 0) == value;
        let at = (0..4).find(differs).expect("one output differs");
        let pins = [literals[0] ^ Literal::from(at & 2 == 0), literals[1] ^ Literal::from(at & 1 == 0)];
        self.set(pins, pins.map(|pin| readers[(pin / 2) as usize] == 1))
    }

    /// The set of two literals; a set that only this gate reads is part of it.
    fn set(&mut self, pins: [Literal; 2], alone: [bool; 2]) -> Form {
        let mut all: BTreeSet<Literal> = BTreeSet::new();
        for (pin, alone) in pins.into_iter().zip(alone) {
            match self.forms[(pin / 2) as usize] {
                Form::Set(inner) if alone && pin % 2 == 0 && self.sets[inner].len() + all.len() < MOST_LITERALS => {
                    all.extend(std::mem::take(&mut self.sets[inner]));
                }
                _ => {
                    all.insert(pin);
                }
            }
        }
        all.remove(&TRUE);
        let never = all.contains(&FALSE) || all.iter().any(|literal| literal % 2 == 0 && all.contains(&(literal ^ 1)));
        self.sets.push(if never { vec![FALSE] } else { all.into_iter().collect() });
        Form::Set(self.sets.len() - 1)
    }

    fn share(&mut self) {
        for i in 0..self.sets.len() {
            let set = self.sets[i].clone();
            for (at, &one) in set.iter().enumerate() {
                self.members.entry(one).or_default().insert(i);
                set[at + 1..].iter().for_each(|&two| *self.counts.entry([one, two]).or_default() += 1);
            }
        }
        let ranked = self.counts.iter().filter(|(_, count)| **count > 1);
        self.ranked = ranked.map(|(&pair, &count)| (count, std::cmp::Reverse(pair))).collect();
        while let Some((_, std::cmp::Reverse(pair))) = self.ranked.pop_last() {
            self.combine(pair);
        }
    }

    fn combine(&mut self, pair: [Literal; 2]) {
        let new = 2 * self.forms.len() as Literal;
        self.forms.push(Form::Pair(pair));
        let both: Vec<usize> = self.members[&pair[0]].intersection(&self.members[&pair[1]]).copied().collect();
        for i in both {
            let set = std::mem::take(&mut self.sets[i]);
            let mut rest: Vec<Literal> = set.into_iter().filter(|literal| !pair.contains(literal)).collect();
            self.count(pair, false);
            for &other in &rest {
                pair.iter().for_each(|&old| self.count(in_order(old, other), false));
                self.count([other, new], true);
            }
            pair.iter().for_each(|old| {
                self.members.get_mut(old).expect("a literal of a set").remove(&i);
            });
            self.members.entry(new).or_default().insert(i);
            rest.push(new);
            self.sets[i] = rest;
        }
    }

    fn count(&mut self, pair: [Literal; 2], more: bool) {
        let count = self.counts.entry(pair).or_default();
        self.ranked.remove(&(*count, std::cmp::Reverse(pair)));
        *count = if more { *count + 1 } else { *count - 1 };
        if *count > 1 {
            self.ranked.insert((*count, std::cmp::Reverse(pair)));
        } else if *count == 0 {
            self.counts.remove(&pair);
        }
    }

    fn network(&self, source: &Network) -> Network {
        let mut builder =
            Builder { network: Network::new(source.inputs), made: vec![None; self.forms.len()], levels: Vec::new() };
        builder.levels.resize(2 + source.inputs, 0);
        (0..2 + source.inputs as u32).for_each(|signal| builder.made[signal as usize] = Some(2 * signal));
        for signal in 2 + source.inputs..source.signals() {
            match &self.forms[signal] {
                Form::Exclusive(pins) => {
                    let pins = pins.map(|pin| builder.literal(pin, &self.forms));
                    builder.made[signal] = Some(builder.gate(Function::XOR, pins));
                }
                Form::Set(set) => {
                    let all = self.sets[*set].iter().map(|&literal| builder.literal(literal, &self.forms)).collect();
                    builder.made[signal] = Some(builder.tree(all));
                }
                Form::Alias | Form::Pair(_) => {}
            }
        }
        let outputs: Vec<Signal> = source
            .outputs
            .iter()
            .map(|&output| {
                let literal = builder.literal(self.literals[output as usize], &self.forms);
                builder.signal(literal)
            })
            .collect();
        builder.network.outputs = outputs;
        builder.network
    }
}

fn is_alias(gate: &Gate) -> bool {
    gate.pins[0] == gate.pins[1] || gate.function.arity() < 2
}

fn in_order(one: Literal, two: Literal) -> [Literal; 2] {
    [one.min(two), one.max(two)]
}

struct Builder {
    network: Network,
    made: Vec<Option<Literal>>,
    levels: Vec<u32>,
}

impl Builder {
    fn literal(&mut self, literal: Literal, forms: &[Form]) -> Literal {
        let signal = (literal / 2) as usize;
        let made = match (self.made[signal], &forms[signal]) {
            (Some(made), _) => made,
            (None, Form::Pair(pins)) => {
                let pins = pins.map(|pin| self.literal(pin, forms));
                let made = self.gate(Function::AND, pins);
                self.made[signal] = Some(made);
                made
            }
            (None, _) => unreachable!("signals are made in order"),
        };
        made ^ literal & 1
    }

    fn gate(&mut self, function: Function, pins: [Literal; 2]) -> Literal {
        let function = inverted(function, pins.map(|literal| literal % 2 == 1));
        let signals = pins.map(|pin| pin / 2);
        self.levels.push(1 + signals.map(|signal| self.levels[signal as usize]).into_iter().max().unwrap_or(0));
        2 * self.network.add(function, signals)
    }

    /// The AND of literals; those of few levels are combined first.
    fn tree(&mut self, literals: Vec<Literal>) -> Literal {
        let mut waiting: BTreeSet<(u32, Literal)> =
            literals.into_iter().map(|literal| (self.levels[(literal / 2) as usize], literal)).collect();
        loop {
            let Some((_, one)) = waiting.pop_first() else { return TRUE };
            let Some((_, two)) = waiting.pop_first() else { return one };
            let made = self.gate(Function::AND, [one, two]);
            waiting.insert((self.levels[(made / 2) as usize], made));
        }
    }

    fn signal(&mut self, literal: Literal) -> Signal {
        match literal {
            FALSE | TRUE => literal,
            _ if literal.is_multiple_of(2) => literal / 2,
            _ => {
                let signal = literal / 2;
                self.levels.push(0);
                self.network.add(Function::NOT, [signal; 2])
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::example::network;
    use crate::proof::equal;

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(200))]

        #[test]
        fn shared_pairs_keep_the_function(gates in prop::collection::vec(any::<(u8, u16, u16)>(), 1..60)) {
            let network = network(6, &gates);
            prop_assert!(equal(&network, &share_pairs(&network)).is_ok());
        }
    }

    #[test]
    fn a_pair_of_two_products_is_made_once() {
        let mut network = Network::new(4);
        let ac = network.add(Function::AND, [2, 4]);
        let product = network.add(Function::AND, [ac, 3]);
        let bd = network.add(Function::AND, [3, 5]);
        let other = network.add(Function::AND, [2, bd]);
        network.outputs = vec![product, other];
        assert_eq!(share_pairs(&network).gates.len(), 3);
    }
}
