// A swarm at the level of logic: each robot answers when its stimuli have been the same for as many cycles as it needs.
// Robots sense the outputs of the others in the cycle before, as in the physics.

import type { BitSource, ExportedRobot } from "../protocol";

/** No pattern. */
const NONE = 255;

export interface LogicRobot {
  senses: BitSource[];
  /** Its output for each pattern of its stimuli. */
  table: number[];
  recorded: ExportedRobot;
}

/** The state of a swarm after a cycle. */
export interface LogicState {
  cycle: number;
  /** The output of each robot, and as the others sense it. */
  bits: Uint8Array;
  sensed: Uint8Array;
  /** The pattern that each robot senses, and the cycles for which it has been the same. */
  patterns: Uint8Array;
  steady: Uint16Array;
  /** The pattern that each robot has answered to last; 255 before its first answer. */
  answered: Uint8Array;
}

export class SwarmLogic {
  state: LogicState;

  constructor(
    private readonly robots: LogicRobot[],
    /** Cycles at the start in which robots sense the start values of the others, and those of a beat. */
    private readonly timing: { start: number; beat: number },
  ) {
    const count = robots.length;
    const starts = Uint8Array.from(robots, robot => Number(robot.recorded.start));
    this.state = {
      cycle: 0,
      bits: starts,
      sensed: starts.slice(),
      patterns: new Uint8Array(count).fill(NONE),
      steady: new Uint16Array(count),
      answered: new Uint8Array(count).fill(NONE),
    };
  }

  /** One cycle with these bits of the inputs. */
  step(inputs: ArrayLike<number>): void {
    const { cycle, ...before } = this.state;
    const [bits, patterns, steady] = [before.bits.slice(), before.patterns.slice(), before.steady.slice()];
    const answered = before.answered.slice();
    this.robots.forEach(({ senses, table, recorded }, robot) => {
      const pattern = senses.reduce((sum, source, i) => {
        const held = recorded.held[i]?.[cycle];
        return 2 * sum + (held === undefined ? valueOf(source, inputs, before.sensed) : Number(held));
      }, 0);
      const same = pattern === patterns[robot] ? Math.min(65_535, (steady[robot] ?? 0) + 1) : 1;
      patterns[robot] = pattern;
      steady[robot] = same;
      if (same >= recorded.delay) {
        answered[robot] = pattern;
        bits[robot] = table[pattern] ?? 0;
      }
    });
    const { start, beat } = this.timing;
    const sensed = cycle + 1 >= start && (cycle + 1) % beat === 0 ? bits.slice() : before.sensed;
    this.state = { cycle: cycle + 1, bits, sensed, patterns, steady, answered };
  }

  /** The bits of these sources after the last cycle. */
  values(sources: BitSource[], inputs: ArrayLike<number>): Uint8Array {
    return Uint8Array.from(sources, source => valueOf(source, inputs, this.state.bits));
  }
}

function valueOf(source: BitSource, inputs: ArrayLike<number>, robots: Uint8Array): number {
  if ("constant" in source) {
    return Number(source.constant);
  }
  return "input" in source ? (inputs[source.input] ?? 0) : (robots[source.robot] ?? 0);
}
