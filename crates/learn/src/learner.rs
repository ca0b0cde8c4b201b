//! A learner: it tries every method on every output, and takes the best on rows that the method has not seen.

use std::ops::Range;

use rand::SeedableRng;
use rand::seq::SliceRandom;
use rand_chacha::ChaCha8Rng;
use serde::Serialize;

use crate::bits::Bits;
use crate::code::{Classes, CodeFitting, CodeShape};
use crate::examples::{Examples, OutputRows};
use crate::graph::{GateGraph, Literal};
use crate::method::{Fitted, Fitting, FittingStep, LearningMethod};

/// How a circuit is learned.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LearnOptions {
    /// The most AND gates of the circuit, inverters not counted.
    pub gates: usize,
    /// The share of the rows in percent that is held out: the learner does not see them.
    pub hold_out: f64,
    /// The seed of all random choices: which rows are held out, and of codes.
    pub seed: u64,
    /// So many rows after each other belong together, such as views of one thing: all of them are held out, or none.
    pub group: usize,
}

impl LearnOptions {
    /// How many of so many rows are held out.
    pub fn held_out(&self, rows: usize) -> usize {
        let groups = (rows.div_ceil(self.group) as f64 * self.hold_out / 100.0).round() as usize;
        (groups * self.group).min(rows)
    }
}

impl Default for LearnOptions {
    fn default() -> Self {
        Self { gates: 5_000, hold_out: 20.0, seed: 1, group: 1 }
    }
}

/// One row of so many of the training rows chooses the method, and the others are learned from.
const CHOOSING: usize = 5;

/// The most rows of a table of which the smallest circuit is searched for after one is recognized.
const FEW: usize = 1_024;

/// The fewest choosing rows that can show that a circuit foresees rows better than an exact one.
const TELLING: usize = 100;

/// How much accuracy all permitted gates are worth: of two methods that are equally good, the smaller is taken.
const PRICE: f64 = 0.002;

#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Tried {
    pub method: String,
    /// The share of the choosing rows that it got right.
    pub accuracy: f64,
    pub ands: usize,
}

#[derive(Clone, Debug, PartialEq)]
pub struct LearnedOutput {
    pub what: String,
    pub tried: Vec<Tried>,
}

#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Accuracy {
    /// The rows in which every output is as wanted.
    pub right: usize,
    pub rows: usize,
    /// Their share.
    pub accuracy: f64,
}

#[derive(Clone, Debug)]
pub struct LearnedCircuit {
    pub graph: GateGraph,
    pub literals: Vec<Literal>,
    pub outputs: Vec<LearnedOutput>,
    pub training: Examples,
    pub held_out: Examples,
}

impl LearnedCircuit {
    pub fn ands(&self) -> usize {
        self.graph.ands(&self.literals)
    }

    pub fn outputs_in(&self, rows: &Examples) -> Vec<Bits> {
        if rows.rows == 0 {
            vec![Bits::all(0, false); self.literals.len()]
        } else {
            self.graph.values(&rows.inputs, &self.literals)
        }
    }

    pub fn accuracy(&self, rows: &Examples) -> Accuracy {
        let right = rows.right(&self.outputs_in(rows)).count();
        Accuracy { right, rows: rows.rows, accuracy: right as f64 / rows.rows.max(1) as f64 }
    }
}

#[derive(Clone, Debug)]
struct Parts {
    /// Those that methods learn from while they are compared.
    fit: OutputRows,
    /// Those that they are compared by.
    choose: OutputRows,
    all: OutputRows,
    /// Whether all values of the inputs are there, so that no row has to be foreseen: then all parts are the same.
    is_table: bool,
}

/// Whether a training row is one that methods are compared by; so many rows belong together.
fn is_choosing(row: usize, group: usize) -> bool {
    (row / group).is_multiple_of(CHOOSING)
}

#[derive(Clone, Debug)]
struct Choice {
    method: LearningMethod,
    worth: f64,
    wrong: usize,
    /// Whether it gets all rows to fit right.
    is_exact: bool,
    fitted: Fitted,
}

#[derive(Clone, Debug)]
struct BitChoice {
    choice: Choice,
    /// The methods that learn it if the chosen one is not exact in all training rows.
    others: Vec<LearningMethod>,
    tried: Vec<Tried>,
    /// Whether it is an exact circuit of a table.
    is_final: bool,
    /// The most AND gates that it may have in the end.
    gates: usize,
}

/// Whether so many of some choosing rows are clearly more than others: by a standard deviation of their difference.
fn is_clearly_more(wrong: usize, others: usize, rows: usize) -> bool {
    let more = wrong.saturating_sub(others);
    rows >= TELLING && more * more > wrong + others
}

#[derive(Clone, Debug)]
struct CodeChoice {
    shape: CodeShape,
    worth: f64,
    wrong: usize,
    graph: GateGraph,
    literals: Vec<Literal>,
}

/// A method is tried on an output bit; the other methods come after it.
#[derive(Clone, Debug)]
struct Trial {
    parts: Parts,
    fitting: Fitting,
    methods: Vec<LearningMethod>,
    tried: Vec<Tried>,
    found: Vec<Choice>,
}

#[derive(Clone, Debug)]
enum Phase {
    Trying(Trial),
    /// A code is tried on all bits; the others come after it.
    Coding {
        classes: Classes,
        fitting: CodeFitting,
        shapes: Vec<CodeShape>,
        best: Option<CodeChoice>,
    },
    /// The chosen method learns an output bit from all training rows, and if that is not exact, `others` do.
    Again {
        parts: Parts,
        fitting: Fitting,
        others: Vec<LearningMethod>,
        learned: Option<Fitted>,
    },
    /// The chosen code learns all bits from all training rows.
    CodingAgain {
        classes: Classes,
        fitting: CodeFitting,
        choice: CodeChoice,
    },
}

#[derive(Clone, Debug)]
struct PortWork {
    /// Its number, and its output bits.
    port: usize,
    bits: Range<usize>,
    phase: Phase,
    choices: Vec<BitChoice>,
    /// What the bits are that have learned from all training rows.
    learned: Vec<Fitted>,
    codes: Vec<Tried>,
}

/// A circuit that is being learned, in portions.
#[derive(Clone, Debug)]
pub struct Learner {
    options: LearnOptions,
    ports: Vec<usize>,
    training: Examples,
    held_out: Examples,
    /// `None` when all ports are learned.
    work: Option<PortWork>,
    graph: GateGraph,
    literals: Vec<Literal>,
    outputs: Vec<LearnedOutput>,
    /// AND gates that the outputs so far may have.
    used: usize,
}

impl Learner {
    /// A learner of rows whose outputs are ports of these widths.
    ///
    /// # Panics
    /// When there are no inputs, outputs or rows to learn from.
    pub fn new(examples: &Examples, ports: &[usize], options: LearnOptions) -> Self {
        assert_eq!(ports.iter().sum::<usize>(), examples.outputs.len(), "the ports have all output bits");
        let mut groups: Vec<usize> = (0..examples.rows.div_ceil(options.group)).collect();
        groups.shuffle(&mut ChaCha8Rng::seed_from_u64(options.seed));
        let rows_of = |group: usize| group * options.group..((group + 1) * options.group).min(examples.rows);
        let order: Vec<usize> = groups.into_iter().flat_map(rows_of).collect();
        let (held, training) = order.split_at(options.held_out(examples.rows));
        let is_something = !training.is_empty() && !examples.inputs.is_empty() && !examples.outputs.is_empty();
        assert!(is_something, "inputs, outputs and rows to learn from");
        let (training, held_out) = (examples.pick(training), examples.pick(held));
        let graph = GateGraph::new(training.inputs.len());
        let (ports, literals, outputs) = (ports.to_vec(), Vec::new(), Vec::new());
        let mut learner = Self { options, ports, training, held_out, work: None, graph, literals, outputs, used: 0 };
        learner.work = learner.port(0);
        learner
    }

    /// The beginning of a port; `None` after the last.
    fn port(&self, port: usize) -> Option<PortWork> {
        let first: usize = self.ports[..port].iter().sum();
        let bits = first..first + self.ports.get(port)?;
        let phase = self.trying(first);
        Some(PortWork { port, bits, phase, choices: Vec::new(), learned: Vec::new(), codes: Vec::new() })
    }

    fn trying(&self, output: usize) -> Phase {
        let parts = self.parts(output);
        let mut methods = LearningMethod::all();
        let fitting = Fitting::new(methods.remove(0), &parts.fit.inputs);
        Phase::Trying(Trial { parts, fitting, methods, tried: Vec::new(), found: Vec::new() })
    }

    /// The training rows of an output bit. If nothing is held out, equal rows have the value of most of them.
    fn parts(&self, output: usize) -> Parts {
        let known: Vec<usize> = self.training.outputs[output].known.ones().collect();
        let mut all = self.training.of_output(output, &known);
        if !self.holds_out() {
            all.settle();
        }
        let is_table = !self.holds_out() && all.table().is_some();
        if is_table {
            return Parts { fit: all.clone(), choose: all.clone(), all, is_table };
        }
        let part = |choosing: bool| {
            let rows = known.iter().enumerate().filter(|(_, row)| is_choosing(**row, self.options.group) == choosing);
            all.pick(&rows.map(|(at, _)| at).collect::<Vec<_>>())
        };
        Parts { fit: part(false), choose: part(true), all, is_table }
    }

    fn holds_out(&self) -> bool {
        self.held_out.rows > 0
    }

    /// How much is done, and how much there is.
    pub fn progress(&self) -> (u64, u64) {
        let methods = LearningMethod::all().len();
        // A code takes about as long as some methods.
        let of_port = |width: usize| width * (methods + 1) + if width > 1 { CodeShape::ALL.len() * methods } else { 0 };
        let all: usize = self.ports.iter().map(|&width| of_port(width)).sum();
        let Some(work) = &self.work else { return (all as u64, all as u64) };
        let before: usize = self.ports[..work.port].iter().map(|&width| of_port(width)).sum();
        let own = match &work.phase {
            Phase::Trying(trial) => work.choices.len() * methods + methods - 1 - trial.methods.len(),
            Phase::Coding { shapes, .. } => {
                work.bits.len() * methods + (CodeShape::ALL.len() - 1 - shapes.len()) * methods
            }
            Phase::Again { .. } | Phase::CodingAgain { .. } => {
                of_port(work.bits.len()) - work.bits.len() + work.learned.len()
            }
        };
        ((before + own) as u64, all as u64)
    }

    /// Does the next portion, such as a tree. Returns false when all is done.
    pub fn advance(&mut self) -> bool {
        let Some(mut work) = self.work.take() else { return false };
        if self.learn_more(&mut work) {
            self.work = Some(work);
            return true;
        }
        let PortWork { port, bits, choices, mut learned, codes, .. } = work;
        let rows = self.port_rows(&bits, |_| true);
        let (number, most) = rows.most_frequent();
        let mut graph = GateGraph::new(rows.inputs.len());
        let literals: Vec<Literal> = learned.iter().map(|fitted| graph.adopt(&fitted.graph, fitted.literal)).collect();
        if most > 0 && rows.right(&graph.values(&rows.inputs, &literals)).count() < most {
            learned = number.into_iter().map(|bit| Fitted::constant(rows.inputs.len(), bit)).collect();
        }
        for (fitted, bit) in learned.into_iter().zip(&choices) {
            self.literals.push(self.graph.adopt(&fitted.graph, fitted.literal));
            let tried = bit.tried.iter().chain(&codes).cloned().collect();
            self.outputs.push(LearnedOutput { what: fitted.what, tried });
        }
        self.used += choices.iter().map(|bit| bit.gates).sum::<usize>();
        self.used = self.used.max(self.graph.ands(&self.literals));
        self.work = self.port(port + 1);
        self.work.is_some()
    }

    /// Does the next portion for a port. Returns false when its bits are learned.
    fn learn_more(&self, work: &mut PortWork) -> bool {
        let PortWork { port, bits, phase, choices, learned, codes } = work;
        let seed = self.options.seed;
        *phase = match phase {
            Phase::Trying(trial) => {
                let Some(choice) = self.try_method(trial, choices) else { return true };
                choices.push(choice);
                if choices.len() < bits.len() {
                    self.trying(bits.start + choices.len())
                } else if let Some(classes) = self.classes(bits, false)
                    && !choices.iter().all(|bit| bit.is_final)
                {
                    let mut shapes = CodeShape::ALL.to_vec();
                    let fitting = CodeFitting::new(shapes.remove(0), &classes, seed, *port);
                    Phase::Coding { classes, fitting, shapes, best: None }
                } else {
                    self.again(bits, choices, 0)
                }
            }
            Phase::Coding { classes, fitting, shapes, best } => {
                if fitting.advance(classes, seed, *port) {
                    return true;
                }
                let shape = fitting.shape();
                let (graph, literals) = fitting.finish(classes);
                let Rating { worth, wrong, tried, .. } = self.rate(&graph, &literals, bits, shape.to_string());
                codes.push(tried);
                if let Some(worth) = worth
                    && best.as_ref().is_none_or(|best| worth > best.worth)
                {
                    *best = Some(CodeChoice { shape, worth, wrong, graph, literals });
                }
                if !shapes.is_empty() {
                    *fitting = CodeFitting::new(shapes.remove(0), classes, seed, *port);
                    return true;
                }
                let won = best.take().filter(|best| self.is_better(best, choices, bits));
                // All training rows may have too many values, though those to learn from have few.
                match won.and_then(|choice| Some((choice, self.classes(bits, true)?))) {
                    Some((choice, classes)) => {
                        let fitting = CodeFitting::new(choice.shape, &classes, seed, *port);
                        Phase::CodingAgain { classes, fitting, choice }
                    }
                    None => self.again(bits, choices, 0),
                }
            }
            Phase::Again { parts, fitting, others, learned: first } => {
                let FittingStep::Done(found) = fitting.advance(&parts.all) else { return true };
                let at = learned.len();
                // From more rows it may have grown too large.
                let found = found.filter(|found| found.ands() <= choices[at].gates);
                let is_exact = found.as_ref().is_some_and(|found| found.accuracy(&parts.all) == 1.0);
                let best = match (first.take(), found) {
                    (Some(first), Some(_)) if !is_exact => first,
                    (first, found) => found.or(first).unwrap_or_else(|| choices[at].choice.fitted.clone()),
                };
                if !is_exact && !others.is_empty() {
                    *fitting = Fitting::new(others.remove(0), &parts.all.inputs);
                    *first = Some(best);
                    return true;
                }
                let constant = Fitted::most(&parts.all);
                let is_worse = best.accuracy(&parts.all) < constant.accuracy(&parts.all);
                learned.push(if is_worse { constant } else { best });
                if learned.len() == bits.len() {
                    return false;
                }
                self.again(bits, choices, at + 1)
            }
            Phase::CodingAgain { classes, fitting, choice } => {
                if fitting.advance(classes, seed, *port) {
                    return true;
                }
                let what = fitting.shape().to_string();
                let (mut graph, mut literals) = fitting.finish(classes);
                if graph.ands(&literals) > self.share(bits.len()).min(self.left(&[])) {
                    (graph, literals) = (choice.graph.clone(), choice.literals.clone());
                }
                let fitted = |literal| Fitted { graph: graph.clone(), literal, what: what.clone() };
                learned.extend(literals.into_iter().map(fitted));
                return false;
            }
        };
        true
    }

    /// Does a portion of the trial of a method. `before` are the choices for earlier bits. Returns the best method
    /// at the end.
    fn try_method(&self, trial: &mut Trial, before: &[BitChoice]) -> Option<BitChoice> {
        let Trial { parts, fitting, methods, tried, found } = trial;
        let method = fitting.method();
        let left = self.left(before);
        let share = self.share(1).min(left);
        let mut is_right = false;
        let FittingStep::Done(fitted) = fitting.advance(&parts.fit) else { return None };
        if let Some(fitted) = fitted {
            let (accuracy, ands) = (fitted.accuracy(&parts.choose), fitted.ands());
            tried.push(Tried { method: method.to_string(), accuracy, ands });
            let is_exact = fitted.accuracy(&parts.fit) == 1.0;
            // The smallest exact circuit of a table may take what others leave.
            if ands <= if parts.is_table && is_exact { left } else { share } {
                is_right = is_exact && accuracy == 1.0;
                let wrong = fitted.wrong(&parts.choose);
                found.push(Choice { method, worth: self.worth(accuracy, ands, 1), wrong, is_exact, fitted });
                let better = |one: &Choice, two: &Choice| two.worth.total_cmp(&one.worth);
                found.sort_by(|one, two| better(one, two).then(one.fitted.ands().cmp(&two.fitted.ands())));
            }
        }
        if is_right && parts.is_table && parts.fit.target.rows() <= FEW {
            // A smaller circuit may come later, but not of many trees.
            methods.retain(|method| !matches!(method, LearningMethod::Forest { .. }));
        } else if is_right && method.is_recognition() {
            // Nothing that comes later is better than what is recognized in all rows.
            methods.clear();
        }
        // Where nothing that was grown fits the budget, smaller and smaller trees are tried.
        if methods.is_empty() && !is_right && found.first().is_none_or(|best| !best.method.is_grown()) {
            methods.extend(method.smaller_tree(parts.fit.target.rows()));
        }
        if methods.is_empty() {
            return Some(self.chosen(std::mem::take(found), std::mem::take(tried), parts, share));
        }
        *fitting = Fitting::new(methods.remove(0), &parts.fit.inputs);
        None
    }

    /// The best of the methods that were tried on an output bit. If nothing is held out, an exact one is better than
    /// others that are not clearly more accurate.
    fn chosen(&self, mut found: Vec<Choice>, tried: Vec<Tried>, parts: &Parts, share: usize) -> BitChoice {
        if found.is_empty() {
            let (method, fitted) = (LearningMethod::Constant, Fitted::most(&parts.fit));
            found.push(Choice { method, worth: 0.0, wrong: 0, is_exact: false, fitted });
        }
        let (least, rows) = (found[0].wrong, parts.choose.target.rows());
        let is_preferred =
            |choice: &Choice| !self.holds_out() && choice.is_exact && !is_clearly_more(choice.wrong, least, rows);
        found.sort_by_key(|choice| !is_preferred(choice));
        let choice = found.remove(0);
        found.retain(|other| is_preferred(&choice) && is_preferred(other));
        let others = found.iter().map(|other| other.method).collect();
        let is_final = parts.is_table && choice.is_exact;
        let gates = if is_final { choice.fitted.ands() } else { share };
        BitChoice { choice, others, tried, is_final, gates }
    }

    /// An equal share of the permitted AND gates for so many output bits.
    fn share(&self, bits: usize) -> usize {
        self.options.gates.saturating_mul(bits) / self.training.outputs.len()
    }

    /// The AND gates that are left beside the outputs so far and some bits of the next port.
    fn left(&self, bits: &[BitChoice]) -> usize {
        self.options.gates - self.used - bits.iter().map(|bit| bit.gates).sum::<usize>()
    }

    /// What an accuracy is worth with so many AND gates for so many output bits.
    fn worth(&self, accuracy: f64, ands: usize, bits: usize) -> f64 {
        accuracy - PRICE * ands as f64 / self.share(bits).max(1) as f64
    }

    /// The chosen method for an output bit, on all training rows.
    fn again(&self, bits: &Range<usize>, choices: &[BitChoice], at: usize) -> Phase {
        let parts = self.parts(bits.start + at);
        let fitting = Fitting::new(choices[at].choice.method, &parts.all.inputs);
        Phase::Again { parts, fitting, others: choices[at].others.clone(), learned: None }
    }

    /// The training rows that are `wanted` and say what all bits of a port are.
    fn port_rows(&self, bits: &Range<usize>, wanted: impl Fn(usize) -> bool) -> Examples {
        let outputs = &self.training.outputs[bits.clone()];
        let is_known = |row: &usize| outputs.iter().all(|output| output.known.get(*row));
        let rows: Vec<usize> = (0..self.training.rows).filter(|&row| wanted(row)).filter(is_known).collect();
        let mut rows = self.training.pick(&rows);
        rows.outputs = rows.outputs[bits.clone()].to_vec();
        rows
    }

    /// The classes that the bits of a port are, in the rows to learn from or in all training rows; `None` if they are
    /// not few numbers.
    fn classes(&self, bits: &Range<usize>, all: bool) -> Option<Classes> {
        let rows = self.port_rows(bits, |row| all || !is_choosing(row, self.options.group));
        let outputs: Vec<Bits> = rows.outputs.iter().map(|output| output.value.clone()).collect();
        Classes::of(rows.inputs, &outputs, self.options.group)
    }

    /// What a circuit for all bits of a port is worth by the choosing rows.
    fn rate(&self, graph: &GateGraph, literals: &[Literal], bits: &Range<usize>, method: String) -> Rating {
        let rows = self.port_rows(bits, |row| is_choosing(row, self.options.group));
        let right = if rows.rows == 0 { 0 } else { rows.right(&graph.values(&rows.inputs, literals)).count() };
        let (accuracy, ands) = (right as f64 / rows.rows.max(1) as f64, graph.ands(literals));
        let fits = ands <= self.share(bits.len()).min(self.left(&[]));
        let worth = fits.then(|| self.worth(accuracy, ands, bits.len()));
        Rating { worth, wrong: rows.rows - right, rows: rows.rows, tried: Tried { method, accuracy, ands } }
    }

    /// Whether a code is better than the best methods for each bit of its port. If nothing is held out and these are
    /// exact, it must be clearly better.
    fn is_better(&self, code: &CodeChoice, choices: &[BitChoice], bits: &Range<usize>) -> bool {
        let mut graph = GateGraph::new(self.training.inputs.len());
        let fitted = choices.iter().map(|bit| &bit.choice.fitted);
        let literals: Vec<Literal> = fitted.map(|fitted| graph.adopt(&fitted.graph, fitted.literal)).collect();
        let alone = self.rate(&graph, &literals, bits, String::new());
        let is_exact = !self.holds_out() && choices.iter().all(|bit| bit.choice.is_exact);
        let is_clear = is_clearly_more(alone.wrong, code.wrong, alone.rows);
        code.worth > alone.worth.unwrap_or(0.0) && (!is_exact || is_clear)
    }

    pub fn finish(self) -> LearnedCircuit {
        assert!(self.work.is_none(), "all portions are done");
        let Self { graph, literals, outputs, training, held_out, .. } = self;
        LearnedCircuit { graph, literals, outputs, training, held_out }
    }
}

struct Rating {
    worth: Option<f64>,
    wrong: usize,
    rows: usize,
    tried: Tried,
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::examples::Wanted;

    fn examples(inputs: usize, outputs: usize, rows: &[(u64, u64)]) -> Examples {
        let bits = |width: usize, number: &dyn Fn(usize) -> u64| -> Vec<Bits> {
            (0..width).map(|bit| Bits::of((0..rows.len()).map(|row| number(row) >> bit & 1 == 1))).collect()
        };
        let wanted = |value| Wanted { known: Bits::all(rows.len(), true), value };
        let outputs = bits(outputs, &|row| rows[row].1).into_iter().map(wanted).collect();
        Examples { inputs: bits(inputs, &|row| rows[row].0), outputs, rows: rows.len() }
    }

    /// From all rows.
    fn options(gates: usize, group: usize) -> LearnOptions {
        LearnOptions { gates, group, hold_out: 0.0, ..LearnOptions::default() }
    }

    fn learned(examples: &Examples, ports: &[usize], options: LearnOptions) -> LearnedCircuit {
        let gates = options.gates;
        let mut learner = Learner::new(examples, ports, options);
        while learner.advance() {}
        let circuit = learner.finish();
        assert!(circuit.ands() <= gates, "{} of {gates}", circuit.ands());
        circuit
    }

    fn is_exact(examples: &Examples, circuit: &LearnedCircuit) -> bool {
        circuit.accuracy(examples).right == examples.rows
    }

    #[test]
    fn every_table_of_three_inputs_is_learned_exactly_with_few_gates() {
        for inputs in 1..=3 {
            for function in 0..1u64 << (1 << inputs) {
                let rows: Vec<(u64, u64)> = (0..1 << inputs).map(|row| (row, function >> row & 1)).collect();
                let examples = examples(inputs, 1, &rows);
                let circuit = learned(&examples, &[1], options(5_000, 1));
                assert!(is_exact(&examples, &circuit), "{function:b}: {:?}", circuit.outputs);
                assert!(circuit.ands() <= 8, "{function:b}: {} gates", circuit.ands());
            }
        }
    }

    fn random(at: u64) -> u64 {
        (at + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15).rotate_left(29).wrapping_mul(0xbf58_476d_1ce4_e5b9) >> 33
    }

    #[test]
    fn rows_that_do_not_contradict_each_other_are_learned_exactly() {
        for inputs in 4..=8 {
            let all: Vec<(u64, u64)> = (0..1 << inputs).map(|row| (row, random(row) & 7)).collect();
            let mut some = all.clone();
            some.retain(|(row, _)| !random(row + 1_000).is_multiple_of(3));
            for (rows, ports, group) in [(&all, &[1, 2][..], 1), (&some, &[1, 1, 1], 1), (&some, &[3], 3)] {
                let examples = examples(inputs, 3, rows);
                assert!(is_exact(&examples, &learned(&examples, ports, options(5_000, group))), "{inputs} {ports:?}");
            }
        }
        let wide: Vec<(u64, u64)> = (0..1 << 11).map(|row| (row, random(row) & 1)).collect();
        let wide = examples(11, 1, &wide);
        assert!(is_exact(&wide, &learned(&wide, &[1], options(1_200, 1))));
        let one = examples(3, 2, &[(5, 2)]);
        assert!(is_exact(&one, &learned(&one, &[2], options(0, 7))));
    }

    #[test]
    fn an_output_may_have_the_gates_that_others_leave() {
        let random: Vec<(u64, u64)> = (0..256).map(|row| (row, random(row) & 1 | row << 1 & 2)).collect();
        let examples = examples(8, 2, &random);
        let alone = learned(&examples, &[1, 1], options(5_000, 1)).ands();
        assert!(is_exact(&examples, &learned(&examples, &[1, 1], options(alone, 1))), "{alone}");
        assert!(!is_exact(&examples, &learned(&examples, &[1, 1], options(alone - 1, 1))));
    }

    #[test]
    fn no_output_is_right_in_fewer_rows_than_a_constant() {
        for seed in 0..240u64 {
            let (inputs, width, count) = (1 + seed % 6, 1 + seed as usize % 2, 1 + random(seed) % 90);
            let number = |at: u64| random(seed * 1_000 + at);
            let value =
                |at: u64| if seed.is_multiple_of(3) { u64::from(number(at) % 5 == 0) * 3 } else { number(at + 500) };
            let rows: Vec<(u64, u64)> = (0..count).map(|at| (number(at) % (1 << inputs), value(at))).collect();
            let examples = examples(inputs as usize, width, &rows);
            let gates = [0, 3, 20, 5_000][seed as usize / 2 % 4];
            for hold_out in [0.0, 20.0] {
                let circuit = learned(&examples, &[width], LearnOptions { gates, hold_out, ..LearnOptions::default() });
                let (right, least) = (circuit.accuracy(&circuit.training).right, circuit.training.most_frequent().1);
                assert!(right >= least, "seed {seed}: {right} of {count}, {least} by a constant");
                // Of equal rows, most are right.
                let mut best = examples.of_output(0, &(0..examples.rows).collect::<Vec<_>>());
                best.settle();
                let most = best.target.xor(&examples.outputs[0].value).not().count();
                assert!(
                    hold_out > 0.0 || gates < 5_000 || width > 1 || right == most,
                    "seed {seed}: {right} of {most}"
                );
            }
        }
    }
}
