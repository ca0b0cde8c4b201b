// A swarm of a run: the robots of the sheet that is open, each in a lane, or one that is followed.

import { colors } from "../colors";
import { LaneGrid } from "../live/camera";
import { CanvasPane, type Pen } from "../live/pane";
import { drawWalk } from "../live/walk";
import type { VoxelLook } from "../protocol";
import { outlineAt, type Gait } from "../robots/gait";
import { Clock } from "./clock";
import type { RecordedRobot, RecordedSwarm } from "../protocol";
import { gaitOf, isUnstable } from "./data";
import { Schematic } from "./schematic";
import { drawPresence, part } from "./shown";
import { Waveform } from "./waveform";

/** The heights of a lane among others, and of one alone. */
const LANE = 92;
const ALONE = 240;

export class SwarmPlayer {
  readonly #clock: Clock;
  readonly #schematic: Schematic;
  readonly #waveform: Waveform;
  readonly #stage = new CanvasPane("stage", "The robots of the sheet, walking", () => this.#clock.wake());
  readonly #note: HTMLElement;
  /** The recorded robots by their cells, in the order of these. */
  readonly #robots: Map<number, RecordedRobot>;
  readonly #gaits = new Map<RecordedRobot, Gait>();
  /** The places of the cameras. */
  readonly #cameras = new Map<RecordedRobot, number>();
  #lanes: RecordedRobot[] = [];

  constructor(
    section: HTMLElement,
    private readonly swarm: RecordedSwarm,
    private readonly looks: VoxelLook[],
  ) {
    this.#robots = new Map(swarm.robots.map(robot => [robot.cell, robot]));
    this.#note = part(section, ".unrecorded");
    this.#clock = new Clock(section, swarm.cycles, () => this.#draw());
    this.#schematic = new Schematic(part(section, ".schematic"), swarm.schematic, swarm.cells);
    this.#waveform = new Waveform(swarm, this.#clock, sheet => this.#schematic.open(sheet));
    part(section, ".stage").replaceWith(this.#stage.host);
    part(section, ".wave").replaceWith(this.#waveform.pane.host);
    this.#stage.host.addEventListener("click", event => {
      const top = event.clientY - this.#stage.host.getBoundingClientRect().top + this.#stage.scrolled;
      const robot = this.#lanes[this.#grid.at(0, top) ?? -1];
      if (robot !== undefined) {
        this.#schematic.choose(robot.cell);
      }
    });
    colors.on(() => this.#clock.wake());
    this.#schematic.sheet.on(() => this.#arrange());
    this.#schematic.robot.on(() => {
      this.#cameras.clear();
      this.#arrange();
    });
    this.#arrange();
  }

  get #grid(): LaneGrid {
    const isAlone = this.#followed !== undefined;
    return new LaneGrid(this.#lanes.length, 1, this.#stage.width, isAlone ? ALONE : LANE);
  }

  /** The robot that is followed alone, if it was recorded. */
  get #followed(): RecordedRobot | undefined {
    return this.#robots.get(this.#schematic.robot.value ?? -1);
  }

  /** Takes the lanes and rows of the sheet that is shown. */
  #arrange(): void {
    const shown = this.#schematic.shown();
    const recorded = shown.flatMap(cell => this.#robots.get(cell) ?? []);
    const left = shown.length - recorded.length;
    this.#lanes = this.#followed === undefined ? recorded : [this.#followed];
    this.#stage.host.hidden = this.#lanes.length === 0;
    this.#stage.host.style.height = `${this.#grid.height}px`;
    this.#note.hidden = left === 0;
    this.#note.textContent = `${left} robots of this sheet were not recorded: there is no room for all.`;
    this.#waveform.arrange(this.#schematic.sheet.value, shown);
    this.#clock.wake();
  }

  #draw(): void {
    this.#waveform.draw();
    if (!this.#stage.visible) {
      return;
    }
    const grid = this.#grid;
    const pen = this.#stage.begin(grid.height);
    for (const lane of grid.between(this.#stage.scrolled, this.#stage.scrolled + this.#stage.height)) {
      this.#drawLane(pen, this.#lanes[lane] as RecordedRobot, grid.top(lane) - this.#stage.scrolled, grid.laneHeight);
    }
  }

  #drawLane(pen: Pen, robot: RecordedRobot, top: number, height: number): void {
    const { cells } = this.swarm;
    const { time, cycle } = this.#clock;
    const label = Math.min(96, this.#stage.width * 0.28);
    const area = { left: label, top, width: this.#stage.width - label, height };
    const outline = outlineAt(this.#gait(robot), time);
    const walking = {
      outline,
      voxels: robot.voxels,
      looks: this.looks,
      tall: robot.size[1] + 1,
      wide: 12,
      columns: [],
    };
    this.#cameras.set(robot, drawWalk(pen, area, walking, this.#cameras.get(robot), colors.value));
    const { net, function: gate } = cells[robot.cell] ?? { net: "", function: "" };
    const middle = top + height / 2;
    pen.textAlign = "left";
    pen.textBaseline = "alphabetic";
    pen.font = `13px ${colors.value.font}`;
    pen.fillStyle = colors.value.ink;
    pen.fillText(`${net} = ${gate}`, 4, middle - 8, label - 8);
    robot.sensed.forEach((bits, i) => drawPresence(pen, i, Number(bits[cycle]), 5, middle));
    if (isUnstable(robot.fault, time, this.swarm)) {
      pen.fillStyle = colors.value.bad;
      pen.fillText("unstable", 4, middle + 34, label - 8);
    }
  }

  #gait(robot: RecordedRobot): Gait {
    const gait = this.#gaits.get(robot) ?? gaitOf(robot, this.swarm.pace);
    this.#gaits.set(robot, gait);
    return gait;
  }
}
