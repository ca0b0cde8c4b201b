//! A learner: it tries every method on every output, and takes the best on rows that the method has not seen.

use std::ops::Range;

use rand::SeedableRng;
use rand::seq::SliceRandom;
use rand_chacha::ChaCha8Rng;

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

/// How much accuracy all permitted gates are worth: of two methods that are equally good, the smaller is taken.
const PRICE: f64 = 0.002;

/// A method that was tried on an output bit, or on all bits of its port.
#[derive(Clone, Debug, PartialEq)]
pub struct Tried {
    /// The method, in words.
    pub method: String,
    /// The share of the choosing rows that it got right.
    pub accuracy: f64,
    /// Its AND gates.
    pub ands: usize,
}

/// An output as it was learned.
#[derive(Clone, Debug, PartialEq)]
pub struct LearnedOutput {
    /// What it is, in words.
    pub what: String,
    /// The methods that were tried, in order.
    pub tried: Vec<Tried>,
}

/// How many rows are right.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Accuracy {
    /// The rows in which every output is as wanted.
    pub right: usize,
    /// All rows.
    pub rows: usize,
}

/// A circuit that was learned.
#[derive(Clone, Debug)]
pub struct LearnedCircuit {
    /// Its gates.
    pub graph: GateGraph,
    /// Its outputs.
    pub literals: Vec<Literal>,
    /// The outputs, as they were learned.
    pub outputs: Vec<LearnedOutput>,
    /// The rows that it was learned from.
    pub training: Examples,
    /// The rows that were held out.
    pub held_out: Examples,
}

impl LearnedCircuit {
    /// Its AND gates.
    pub fn ands(&self) -> usize {
        self.graph.ands(&self.literals)
    }

    /// The bits of its outputs in rows.
    pub fn outputs_in(&self, rows: &Examples) -> Vec<Bits> {
        if rows.rows == 0 {
            vec![Bits::all(0, false); self.literals.len()]
        } else {
            self.graph.values(&rows.inputs, &self.literals)
        }
    }

    /// How many rows it gets right.
    pub fn accuracy(&self, rows: &Examples) -> Accuracy {
        Accuracy { right: rows.right(&self.outputs_in(rows)).count(), rows: rows.rows }
    }
}

/// The training rows of an output bit.
#[derive(Clone, Debug)]
struct Parts {
    /// Those that methods learn from while they are compared.
    fit: OutputRows,
    /// Those that they are compared by.
    choose: OutputRows,
    /// Both.
    all: OutputRows,
}

impl Parts {
    fn of(training: &Examples, output: usize, group: usize) -> Self {
        let known = || training.outputs[output].known.ones();
        let part = |rows: Vec<usize>| training.of_output(output, &rows);
        Self {
            fit: part(known().filter(|row| !is_choosing(*row, group)).collect()),
            choose: part(known().filter(|row| is_choosing(*row, group)).collect()),
            all: part(known().collect()),
        }
    }
}

/// Whether a training row is one that methods are compared by; so many rows belong together.
fn is_choosing(row: usize, group: usize) -> bool {
    (row / group).is_multiple_of(CHOOSING)
}

/// The best method for an output bit.
#[derive(Clone, Debug)]
struct Choice {
    method: LearningMethod,
    worth: f64,
    /// What it has learned from the rows to fit.
    fitted: Fitted,
}

/// The best code for all bits of a port.
#[derive(Clone, Debug)]
struct CodeChoice {
    shape: CodeShape,
    worth: f64,
    /// What it has learned from the rows to fit.
    graph: GateGraph,
    literals: Vec<Literal>,
}

/// What is done for an output port.
#[derive(Clone, Debug)]
enum Phase {
    /// A method is tried on an output bit; the others come after it.
    Trying { parts: Parts, fitting: Fitting, methods: Vec<LearningMethod>, tried: Vec<Tried>, best: Option<Choice> },
    /// A code is tried on all bits; the others come after it.
    Coding { classes: Classes, fitting: CodeFitting, shapes: Vec<CodeShape>, best: Option<CodeChoice> },
    /// The chosen method learns an output bit from all training rows.
    Again { parts: Parts, fitting: Fitting },
    /// The chosen code learns all bits from all training rows.
    CodingAgain { classes: Classes, fitting: CodeFitting, choice: CodeChoice },
}

/// An output port that is being learned.
#[derive(Clone, Debug)]
struct PortWork {
    /// Its number, and its output bits.
    port: usize,
    bits: Range<usize>,
    phase: Phase,
    /// The choices for the bits whose methods were tried, with what was tried.
    choices: Vec<(Choice, Vec<Tried>)>,
    /// What the bits are that have learned from all training rows.
    learned: Vec<Fitted>,
    /// What was tried on all bits together.
    codes: Vec<Tried>,
}

/// A circuit that is being learned, in portions.
#[derive(Clone, Debug)]
pub struct Learner {
    options: LearnOptions,
    /// The widths of the output ports.
    ports: Vec<usize>,
    training: Examples,
    held_out: Examples,
    /// `None` when all ports are learned.
    work: Option<PortWork>,
    graph: GateGraph,
    literals: Vec<Literal>,
    outputs: Vec<LearnedOutput>,
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
        let mut learner = Self { options, ports, training, held_out, work: None, graph, literals, outputs };
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
        let parts = Parts::of(&self.training, output, self.options.group);
        let mut methods = LearningMethod::all();
        let fitting = Fitting::new(methods.remove(0), &parts.fit.inputs);
        Phase::Trying { parts, fitting, methods, tried: Vec::new(), best: None }
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
            Phase::Trying { methods: left, .. } => work.choices.len() * methods + methods - 1 - left.len(),
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
        let Some(PortWork { port, bits, phase, mut choices, mut learned, mut codes }) = self.work.take() else {
            return false;
        };
        let next = match phase {
            Phase::Trying { parts, fitting, methods, tried, best } => {
                match self.try_method(parts, fitting, methods, tried, best) {
                    Tries::More(phase) => Some(*phase),
                    Tries::Best(choice, tried) => {
                        choices.push((choice, tried));
                        Some(if choices.len() < bits.len() {
                            self.trying(bits.start + choices.len())
                        } else if let Some(classes) = self.classes(&bits, false) {
                            self.coding(CodeShape::ALL.to_vec(), None, classes, port)
                        } else {
                            self.again(&bits, &choices, 0)
                        })
                    }
                }
            }
            Phase::Coding { classes, mut fitting, shapes, best } => {
                let seed = self.options.seed;
                if fitting.advance(&classes, seed, port) {
                    Some(Phase::Coding { classes, fitting, shapes, best })
                } else {
                    let shape = fitting.shape();
                    let (graph, literals) = fitting.finish(&classes);
                    let (worth, tried) = self.rate(&graph, &literals, &bits, shape.to_string());
                    let best = match worth {
                        Some(worth) if best.as_ref().is_none_or(|best| worth > best.worth) => {
                            Some(CodeChoice { shape, worth, graph, literals })
                        }
                        _ => best,
                    };
                    codes.push(tried);
                    Some(if shapes.is_empty() {
                        let won = best.filter(|best| best.worth > self.worth_of(&choices, &bits));
                        // All training rows may have too many values, though those to learn from have few.
                        match won.and_then(|choice| Some((choice, self.classes(&bits, true)?))) {
                            Some((choice, all)) => {
                                let fitting = CodeFitting::new(choice.shape, &all, seed, port);
                                Phase::CodingAgain { classes: all, fitting, choice }
                            }
                            None => self.again(&bits, &choices, 0),
                        }
                    } else {
                        self.coding(shapes, best, classes, port)
                    })
                }
            }
            Phase::Again { parts, fitting } => match fitting.advance(&parts.all) {
                FittingStep::More(fitting) => Some(Phase::Again { parts, fitting }),
                FittingStep::Done(found) => {
                    let found = found.unwrap_or_else(|| Fitted::constant(&parts.all));
                    // From more rows it may have grown too large.
                    let fits = self.worth(1.0, found.ands(), 1).is_some();
                    learned.push(if fits { found } else { choices[learned.len()].0.fitted.clone() });
                    (learned.len() < bits.len()).then(|| self.again(&bits, &choices, learned.len()))
                }
            },
            Phase::CodingAgain { classes, mut fitting, choice } => {
                if fitting.advance(&classes, self.options.seed, port) {
                    Some(Phase::CodingAgain { classes, fitting, choice })
                } else {
                    let what = fitting.shape().to_string();
                    let (graph, literals) = fitting.finish(&classes);
                    let fits = self.worth(1.0, graph.ands(&literals), bits.len()).is_some();
                    let (graph, literals) = if fits { (graph, literals) } else { (choice.graph, choice.literals) };
                    learned.extend(literals.into_iter().map(|literal| Fitted {
                        graph: graph.clone(),
                        literal,
                        what: what.clone(),
                    }));
                    None
                }
            }
        };
        if let Some(phase) = next {
            self.work = Some(PortWork { port, bits, phase, choices, learned, codes });
            return true;
        }
        for (fitted, (_, tried)) in learned.into_iter().zip(choices) {
            self.literals.push(self.graph.adopt(&fitted.graph, fitted.literal));
            let tried = tried.into_iter().chain(codes.iter().cloned()).collect();
            self.outputs.push(LearnedOutput { what: fitted.what, tried });
        }
        self.work = self.port(port + 1);
        self.work.is_some()
    }

    /// The next portion of a method that is tried.
    fn try_method(
        &self,
        parts: Parts,
        fitting: Fitting,
        mut methods: Vec<LearningMethod>,
        mut tried: Vec<Tried>,
        mut best: Option<Choice>,
    ) -> Tries {
        let method = fitting.method();
        let mut is_exact = false;
        match fitting.advance(&parts.fit) {
            FittingStep::More(fitting) => {
                return Tries::More(Box::new(Phase::Trying { parts, fitting, methods, tried, best }));
            }
            FittingStep::Done(None) => {}
            FittingStep::Done(Some(fitted)) => {
                let (accuracy, ands) = (fitted.accuracy(&parts.choose), fitted.ands());
                tried.push(Tried { method: method.to_string(), accuracy, ands });
                if let Some(worth) = self.worth(accuracy, ands, 1) {
                    is_exact = accuracy == 1.0 && fitted.accuracy(&parts.fit) == 1.0;
                    if best.as_ref().is_none_or(|best| worth > best.worth) {
                        best = Some(Choice { method, worth, fitted });
                    }
                }
            }
        }
        // Nothing that comes later is better than what is recognized in all rows.
        if is_exact && method.is_recognition() {
            methods.clear();
        }
        // Where nothing that was grown fits the budget, smaller and smaller trees are tried.
        if methods.is_empty() && !is_exact && best.as_ref().is_none_or(|best| !best.method.is_grown()) {
            methods.extend(method.smaller_tree(parts.fit.target.rows()));
        }
        if methods.is_empty() {
            let constant =
                || Choice { method: LearningMethod::Constant, worth: 0.0, fitted: Fitted::constant(&parts.fit) };
            return Tries::Best(best.unwrap_or_else(constant), tried);
        }
        let fitting = Fitting::new(methods.remove(0), &parts.fit.inputs);
        Tries::More(Box::new(Phase::Trying { parts, fitting, methods, tried, best }))
    }

    /// The next code.
    fn coding(&self, mut shapes: Vec<CodeShape>, best: Option<CodeChoice>, classes: Classes, port: usize) -> Phase {
        let fitting = CodeFitting::new(shapes.remove(0), &classes, self.options.seed, port);
        Phase::Coding { classes, fitting, shapes, best }
    }

    /// The chosen method for an output bit, on all training rows.
    fn again(&self, bits: &Range<usize>, choices: &[(Choice, Vec<Tried>)], at: usize) -> Phase {
        let parts = Parts::of(&self.training, bits.start + at, self.options.group);
        let fitting = Fitting::new(choices[at].0.method, &parts.all.inputs);
        Phase::Again { parts, fitting }
    }

    /// What an accuracy is worth with so many AND gates for so many output bits; `None` if these are too many.
    fn worth(&self, accuracy: f64, ands: usize, bits: usize) -> Option<f64> {
        let budget = self.options.gates * bits / self.training.outputs.len();
        (ands <= budget).then(|| accuracy - PRICE * ands as f64 / budget.max(1) as f64)
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
    fn rate(
        &self,
        graph: &GateGraph,
        literals: &[Literal],
        bits: &Range<usize>,
        method: String,
    ) -> (Option<f64>, Tried) {
        let rows = self.port_rows(bits, |row| is_choosing(row, self.options.group));
        let right = if rows.rows == 0 { 0 } else { rows.right(&graph.values(&rows.inputs, literals)).count() };
        let (accuracy, ands) = (right as f64 / rows.rows.max(1) as f64, graph.ands(literals));
        (self.worth(accuracy, ands, bits.len()), Tried { method, accuracy, ands })
    }

    /// What the best methods for each bit of a port are worth together.
    fn worth_of(&self, choices: &[(Choice, Vec<Tried>)], bits: &Range<usize>) -> f64 {
        let mut graph = GateGraph::new(self.training.inputs.len());
        let literals: Vec<Literal> =
            choices.iter().map(|(choice, _)| graph.adopt(&choice.fitted.graph, choice.fitted.literal)).collect();
        self.rate(&graph, &literals, bits, String::new()).0.unwrap_or(0.0)
    }

    /// The circuit.
    ///
    /// # Panics
    /// When there is more to do.
    pub fn finish(self) -> LearnedCircuit {
        assert!(self.work.is_none(), "all portions are done");
        let Self { graph, literals, outputs, training, held_out, .. } = self;
        LearnedCircuit { graph, literals, outputs, training, held_out }
    }
}

/// How far the methods for an output bit came.
enum Tries {
    More(Box<Phase>),
    Best(Choice, Vec<Tried>),
}
