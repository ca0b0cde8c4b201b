// Eight short lessons. Each has a few sentences, and steps that the page checks.

import { NEW_PROGRAM } from "../editor/files";
import type { TabName } from "../layout";
import { designs, hasShown, keeps, type Check } from "./checks";

export interface Step {
  task: string;
  check: Check;
}

export interface Lesson {
  name: string;
  title: string;
  text: string[];
  /** The program that it is about, and where it happens. */
  program: string | null;
  tab: TabName;
  steps: Step[];
}

const NOT = `circuit invert(a) -> (q) {
    q = not a
}
`;

const AND = `circuit both(a, b) -> (q) {
    q = a and b
}
`;

const NAND = `circuit not_both(a, b) -> (q) {
    q = a nand b
}
`;

const ADDER = `circuit adder(a[2], b[2]) -> (sum[3]) {
    sum = {0, a} + {0, b}
}

test adder "all sums" for all inputs {
    sum = {0, a} + {0, b}
}
`;

const MEMORY = `// Each of the two nets depends on the other. init is the value at the start.

circuit memory(set, reset) -> (q, nq) {
    q init 0  = nand(not set, nq)
    nq init 1 = nand(not reset, q)
}
`;

const LATCH = `//! The paper's D latch, built from five evolved robots.

circuit d_latch(d, e) -> (q, nq) {
    q init 0  = nand(nand(d, e), nq)
    nq init 1 = nand(nand(not d, e), q)
}

test d_latch "follows d while e is on, remembers when e goes off" {
    d e | q
    0 1 | 0
    1 1 | 1
    1 0 | 1
    0 0 | 1
    0 1 | 0
}
`;

export const LESSONS: Lesson[] = [
  {
    name: "gate",
    title: "A robot is a gate",
    text: [
      "This robot has no brain. Some of its voxels swell and shrink by themselves, others change when " +
        "a stimulus is present. So its body decides which way it walks.",
      "A robot that walks right stands for 1, and one that walks left stands for 0. This one walks " +
        "right where a is 0: it is a NOT gate.",
    ],
    program: NOT,
    tab: "swarm",
    steps: [
      { task: "Switch a on, and wait until the robot has turned round: q goes out.", check: keeps({ a: 1, q: 0 }) },
      { task: "Switch a off again: q lights up.", check: keeps({ a: 0, q: 1 }) },
    ],
  },
  {
    name: "stimuli",
    title: "Two stimuli",
    text: [
      "A robot can sense two stimuli, like two lights. Its materials react to the first, to the second, or to neither.",
      "Two stimuli have four patterns, and the robot walks right or left in each. That makes sixteen possible gates.",
    ],
    program: AND,
    tab: "swarm",
    steps: [
      { task: "Find the one pattern of a and b in which this robot walks right.", check: keeps({ q: 1 }) },
      {
        task: "Show it all four patterns, each until it has settled.",
        check: hasShown([
          { a: 0, b: 0, q: 0 },
          { a: 0, b: 1, q: 0 },
          { a: 1, b: 0, q: 0 },
          { a: 1, b: 1, q: 1 },
        ]),
      },
    ],
  },
  {
    name: "nand",
    title: "NAND",
    text: [
      "NAND is 0 only where both inputs are 1. Every circuit can be built of NAND gates alone, and so " +
        "of one kind of robot.",
      "The tab Robots has all robots of the library as cards. Each shows its truth table and how it walks.",
    ],
    program: NAND,
    tab: "swarm",
    steps: [
      { task: "Make q go out.", check: keeps({ a: 1, b: 1, q: 0 }) },
      {
        task: "In the tab Robots, find a NAND robot and open it in the designer.",
        check: designs(name => name === "nand"),
      },
      {
        task: "There, change its body until it is another gate. Swapping inputs changes nothing here: why?",
        check: designs(name => name !== "nand"),
      },
    ],
  },
  {
    name: "adder",
    title: "An adder",
    text: [
      "The motion of one robot can be the stimulus of the next. So robots become circuits.",
      "This one adds two numbers of two bits. The compiler chose the robots; each of them computes " +
        "one net of the schematic.",
    ],
    program: ADDER,
    tab: "swarm",
    steps: [
      { task: "Let it compute 3 + 2, and wait until the sum is 5.", check: keeps({ a: 3, b: 2, sum: 5 }) },
      {
        task: "In the tab Tests, run its test as logic or in physics.",
        check: ({ tests, passed }) => tests > 0 && passed === tests,
      },
    ],
  },
  {
    name: "memory",
    title: "Feedback and memory",
    text: [
      "Here two robots sense each other: each is the stimulus of the other. Such a loop can rest in " +
        "two states, and stays in the one it is in.",
      "That is a memory of one bit. set makes it 1, and reset makes it 0.",
    ],
    program: MEMORY,
    tab: "swarm",
    steps: [
      { task: "Switch set on until q lights up.", check: keeps({ set: 1, reset: 0, q: 1 }) },
      { task: "Switch set off. q stays lit: the robots remember.", check: keeps({ set: 0, reset: 0, q: 1 }) },
      { task: "Clear the memory with reset, and switch reset off again.", check: keeps({ set: 0, reset: 0, q: 0 }) },
    ],
  },
  {
    name: "latch",
    title: "The paper's latch",
    text: [
      "This is the circuit of the paper “No-brainer”: a D latch of five evolved robots. While e is " +
        "on, q follows d. When e goes off, q keeps its value, whatever d does.",
      "Look at the spacetime diagram: each line is one robot. Where it bends, the robot has turned round.",
    ],
    program: LATCH,
    tab: "swarm",
    steps: [
      { task: "Make q light up.", check: keeps({ d: 1, e: 1, q: 1 }) },
      { task: "Keep it lit after e goes off.", check: keeps({ d: 1, e: 0, q: 1 }) },
      { task: "Now switch d off, too. q still remembers.", check: keeps({ d: 0, e: 0, q: 1 }) },
    ],
  },
  {
    name: "evolution",
    title: "Evolution",
    text: [
      "Nobody designed these bodies. A search changed random bodies again and again, and kept the " +
        "best of each kind: by their size, by how much of them is active, and by how they behave.",
      "The archive shows the kinds as squares. They fill as the search finds bodies.",
    ],
    program: null,
    tab: "robots",
    steps: [
      {
        task: "In the tab Robots, make a body, such as a random one, and choose “Evolve from here”.",
        check: ({ search }) => search.running,
      },
      { task: "Wait until at least five kinds are filled.", check: ({ search }) => search.niches.length >= 5 },
      {
        task: "Click one of them to put its body in the designer, and watch it walk.",
        check: ({ search, design }) => search.chosen !== null && search.chosen.body.join() === design.body.join(),
      },
    ],
  },
  {
    name: "own",
    title: "Your own circuit",
    text: [
      "Write a circuit of your own. The swarm follows whenever the program has no errors. Some ideas: " +
        "a light with two switches, a vote of three, a comparison of two numbers.",
      "The button with the file's name has examples to look at.",
    ],
    program: NEW_PROGRAM,
    tab: "swarm",
    steps: [
      {
        task: "Change the circuit and its test.",
        check: ({ text, errors, circuits, tests }) =>
          errors === 0 && circuits > 0 && tests > 0 && text.trim() !== NEW_PROGRAM.trim(),
      },
      { task: "Run its tests until all of them pass.", check: ({ tests, passed }) => tests > 0 && passed === tests },
      {
        task: "Make an output light up.",
        check: ({ now, text, port }) => outputNames(text).some(name => (port(name, now) ?? 0) > 0),
      },
    ],
  },
];

/** The names of the outputs of all circuits in a text. */
export function outputNames(text: string): string[] {
  return [...text.matchAll(/->\s*\(([^)]*)\)/g)].flatMap(([, list = ""]) =>
    [...list.matchAll(/([A-Za-z_]\w*)(?:\[[^\]]*\])?\s*(?:,|$)/g)].map(([, name = ""]) => name),
  );
}

/** Where a lesson's program is, until it is saved elsewhere. */
export function lessonPath(lesson: Lesson): string {
  return `lesson_${lesson.name}.nb`;
}
