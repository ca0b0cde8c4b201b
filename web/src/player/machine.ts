// The swarm of an exported page as something that can be run.

import { outputsOf } from "../gate";
import type { ExportedSwarm, ShownSwarm } from "../protocol";
import { SwarmLogic, type LogicRobot } from "./logic";
import { stridesOf, type Stride } from "./exported";

export class Machine {
  readonly swarm: ShownSwarm;
  readonly #robots: LogicRobot[];
  /** The strides of each robot, one for each pattern. Robots with the same body share them. */
  readonly strides: Stride[][];

  constructor(readonly recording: ExportedSwarm) {
    this.swarm = recording.swarm;
    const walks = recording.walks.map(stridesOf);
    this.strides = recording.robots.map(robot => walks[robot.walk] ?? []);
    this.#robots = recording.robots.map((recorded, i) => ({
      senses: this.swarm.robots[i]?.senses ?? [],
      table: outputsOf(recording.walks[recorded.walk]?.letters ?? ""),
      recorded,
    }));
  }

  /** The swarm at its start. */
  logic(): SwarmLogic {
    return new SwarmLogic(this.#robots, { start: this.swarm.start, beat: this.recording.beat });
  }

  /** A pattern under which a robot walks as it does before its first answer. */
  firstPattern(robot: number): number {
    const given = this.#robots[robot];
    return Math.max(0, given?.table.indexOf(Number(given.recorded.start)) ?? 0);
  }
}
