// The robots of a swarm, each in a lane of its own with a camera that follows it.

import { colors } from "../colors";
import { enlargement } from "../theme";
import { LaneGrid, middleOf } from "./camera";
import { crowdGrid, detailOf, drawDot, drawSilhouette } from "./crowd";
import { drawLamp, drawRobot, drawStimulus, drawThread, type Lane } from "./drawing";
import { fitText } from "./labels";
import { CanvasPane, type Pen } from "./pane";
import type { LiveSwarm } from "./swarm";
import { drawWalk, type Area } from "./walk";
import type { StimulusSource } from "../protocol";
import type { View } from "./animation";
import { sameSource } from "../selection";
import { gateName } from "../gate";

const GAP = 6;
/** A lane is at least this wide before there are two columns. */
const COLUMN = 430;
const FEW = 6;
/** A lane lower than this has no room for three lines. */
const LOW = 50;

export class Stage implements View {
  readonly pane: CanvasPane;
  readonly #cameras = new Map<number, number>();
  #grid = new LaneGrid(0, 1, 1, 1);

  constructor(
    private readonly swarm: LiveSwarm,
    changed: () => void,
  ) {
    this.pane = new CanvasPane("stage", "The robots of the swarm, walking", changed);
    this.#listen();
    swarm.definition.on(() => this.#cameras.clear());
    swarm.selection.followed.on(() => this.#cameras.clear());
    swarm.selection.opened.on(changed);
    swarm.selection.together.on(changed);
    // Lanes below the visible part cost nothing: their poses are not even sent.
    this.pane.host.addEventListener("scroll", () => this.#ask(), { passive: true });
  }

  /** Scrolls to a robot. */
  reveal(robot: number): void {
    const lane = this.#robots().indexOf(robot);
    const top = this.#grid.top(lane);
    if (
      lane >= 0 &&
      (top < this.pane.scrolled || top + this.#grid.laneHeight > this.pane.scrolled + this.pane.height)
    ) {
      this.pane.host.scrollTop = top;
    }
  }

  draw(): void {
    const definition = this.swarm.definition.value;
    if (definition === null || !this.pane.visible) {
      return;
    }
    this.#arrange();
    const pen = this.pane.begin(this.#grid.height);
    const robots = this.#robots();
    for (const lane of this.#visibleLanes(0)) {
      if (this.#together) {
        this.#drawCell(pen, robots[lane] as number, lane);
      } else {
        this.#drawLane(pen, robots[lane] as number, lane);
      }
    }
    this.#ask();
  }

  #robots(): number[] {
    const followed = this.swarm.selection.followed.value;
    const count = this.swarm.definition.value?.robots.length ?? 0;
    const all = (): number[] => this.swarm.selection.opened.value ?? Array.from({ length: count }, (_, i) => i);
    return followed === null ? all() : [followed];
  }

  /** Whether all robots are shown at once. */
  get #together(): boolean {
    return this.swarm.selection.together.value && this.swarm.selection.followed.value === null;
  }

  #arrange(): void {
    const count = this.#robots().length;
    if (this.#together) {
      this.#grid = crowdGrid(count, this.pane.width, this.pane.height);
      return;
    }
    const columns = count <= FEW ? 1 : Math.max(1, Math.floor(this.pane.width / (COLUMN * enlargement.value)));
    const share = this.pane.height / Math.ceil(count / columns);
    const least = (count <= FEW ? 44 : 66) * enlargement.value;
    const height = count === 1 ? this.pane.height : Math.max(least, Math.min(150, share));
    this.#grid = new LaneGrid(count, columns, this.pane.width, height);
  }

  #visibleLanes(margin: number): number[] {
    const top = this.pane.scrolled;
    return this.#grid.between(top - margin, top + this.pane.height + margin);
  }

  #ask(): void {
    const robots = this.#robots();
    const lanes = this.#visibleLanes(this.#grid.laneHeight);
    if (this.swarm.definition.value !== null && lanes.length > 0) {
      // Dots need no poses.
      const posed = !this.#together || detailOf(this.#grid) !== "dots";
      this.swarm.view(posed ? lanes.map(lane => robots[lane] as number) : []);
    }
  }

  #drawCell(pen: Pen, robot: number, lane: number): void {
    const grid = this.#grid;
    const cell: Area = {
      left: grid.left(lane),
      top: grid.top(lane) - this.pane.scrolled,
      width: grid.laneWidth,
      height: grid.laneHeight,
    };
    if (sameSource(this.swarm.selection.pointed.value, { robot })) {
      pen.fillStyle = colors.value.highlight;
      pen.fillRect(cell.left, cell.top, cell.width, cell.height);
    }
    const { playback } = this.swarm;
    const value = this.swarm.value({ robot });
    pen.fillStyle = value === null ? colors.value.line : value === 1 ? colors.value.one : colors.value.zero;
    const detail = detailOf(grid);
    const outline = detail === "dots" ? null : playback.outline(robot);
    const voxels = this.swarm.definition.value?.robots[robot]?.voxels ?? [];
    if (outline === null) {
      const before = this.swarm.value({ robot }, playback.cycle - 1) ?? value;
      drawDot(pen, cell, before ?? 0.5, value ?? 0.5, Math.max(0, 1 - (playback.cycle - playback.time)));
    } else if (detail === "silhouettes") {
      drawSilhouette(pen, cell, outline, voxels, middleOf(outline), this.#tallness(robot));
    } else {
      pen.fillRect(cell.left + 2, cell.top + cell.height - 4, cell.width - 4, 3);
      const scale = Math.min(
        (cell.width - 4) / (this.#tallness(robot) * 1.35),
        (cell.height - 6) / this.#tallness(robot),
      );
      const ground = cell.top + cell.height - 5;
      const lane: Lane = { ...cell, ground, scale, camera: middleOf(outline), columns: [] };
      drawRobot(pen, outline, voxels, this.swarm.definition.value?.looks ?? [], lane, colors.value);
    }
  }

  #drawLane(pen: Pen, robot: number, lane: number): void {
    const size = enlargement.value;
    const label = Math.min(124 * size, this.#grid.laneWidth * 0.32);
    const height = this.#grid.laneHeight - GAP;
    const left = this.#grid.left(lane);
    const top = this.#grid.top(lane) - this.pane.scrolled;
    const lamp = Math.min(64 * size, height);
    this.#drawFrame(pen, robot, left, top, height);
    const thread = this.swarm.thread({ robot });
    const badge = this.#hasThreads() ? 24 * size : 0;
    if (thread !== null) {
      drawThread(pen, thread, { left, top, height, right: left + label - 4 }, size, colors.value);
    }
    this.#drawLabel(pen, robot, left + 12, top, height, [label - 16, badge]);
    this.#drawWalk(pen, robot, { left: left + label, top, width: this.#grid.laneWidth - label - lamp, height });
    const value = this.swarm.value({ robot });
    drawLamp(
      pen,
      value,
      left + this.#grid.laneWidth - lamp / 2,
      top + height / 2,
      Math.min(17 * size, height / 3.4),
      colors.value,
    );
  }

  #hasThreads(): boolean {
    return (this.swarm.definition.value?.waves?.threads ?? 1) > 1;
  }

  #drawFrame(pen: Pen, robot: number, left: number, top: number, height: number): void {
    const pointed = sameSource(this.swarm.selection.pointed.value, { robot });
    pen.fillStyle = pointed ? colors.value.accent : colors.value.panel;
    pen.fillRect(left, top, this.#grid.laneWidth, height);
    if (pointed) {
      pen.fillStyle = colors.value.panel;
      pen.fillRect(left + 3, top + 3, this.#grid.laneWidth - 6, height - 6);
    }
  }

  /** The name, the gate and the stimuli of a robot; its name leaves room for a `badge` at the end of its line. */
  #drawLabel(
    pen: Pen,
    index: number,
    left: number,
    top: number,
    height: number,
    [width, badge]: [number, number],
  ): void {
    const robot = this.swarm.definition.value?.robots[index];
    if (robot === undefined) {
      return;
    }
    const size = enlargement.value;
    const middle = top + height / 2;
    pen.textAlign = "left";
    pen.textBaseline = "alphabetic";
    pen.fillStyle = colors.value.ink;
    pen.font = `600 ${14 * size}px ${colors.value.font}`;
    // A low lane has the net and its gate in one line.
    const low = height < LOW * size;
    const above = middle - (low ? 5 : 9) * size;
    // A robot whose net has no name is called by its gate.
    const gate = gateName(robot.function);
    const name = robot.named ? robot.label : gate;
    pen.fillText(name, left, above, low && robot.named ? (width - badge) / 2 : width - badge);
    const beside = Math.min((width - badge) / 2, pen.measureText(name).width) + 8 * size;
    pen.fillStyle = colors.value.dim;
    pen.font = `${12 * size}px ${colors.value.font}`;
    if (robot.named && low) {
      pen.fillText(gate, left + beside, above, width - badge - beside);
    } else if (robot.named) {
      pen.fillText(gate, left, middle + 5 * size, width);
    }
    // A robot of one input senses nothing but a constant by its other sides.
    const senses = robot.senses.filter(source => !("constant" in source));
    const share = width / Math.max(2, senses.length);
    senses.forEach((source, i) => this.#drawSense(pen, source, left + i * share, middle + (low ? 2 : 9) * size, share));
  }

  #drawSense(pen: Pen, source: StimulusSource, x: number, top: number, width: number): void {
    const size = enlargement.value;
    drawStimulus(pen, this.swarm.value(source), x, top, 12 * size, colors.value);
    pen.fillStyle = colors.value.dim;
    pen.font = `${11 * size}px ${colors.value.font}`;
    // What is too long is cut, and a net without a name is then called by its gate alone.
    const fit = (text: string): string => fitText(text, width - 20 * size, text => pen.measureText(text).width);
    const label = this.swarm.nameOf(source);
    const name = fit(label.includes("(") && fit(label) !== label ? label.slice(0, label.indexOf("(")) : label);
    pen.fillText(name, x + 16 * size, top + 10 * size);
  }

  #drawWalk(pen: Pen, robot: number, area: Area): void {
    const definition = this.swarm.definition.value;
    const walking = {
      outline: definition === null ? null : this.swarm.playback.outline(robot),
      voxels: definition?.robots[robot]?.voxels ?? [],
      looks: definition?.looks ?? [],
      tall: Math.max(5, this.#tallness(robot)),
      wide: 14,
      columns: definition?.ground ?? [],
    };
    this.#cameras.set(robot, drawWalk(pen, area, walking, this.#cameras.get(robot), colors.value));
  }

  /** The rows of a body. */
  #tallness(robot: number): number {
    return Math.sqrt(this.swarm.definition.value?.robots[robot]?.voxels.length ?? 25) + 1;
  }

  #laneAt(event: MouseEvent): number | null {
    const box = this.pane.host.getBoundingClientRect();
    const lane = this.#grid.at(event.clientX - box.left, event.clientY - box.top + this.pane.scrolled);
    return lane === null ? null : (this.#robots()[lane] ?? null);
  }

  #listen(): void {
    const { selection } = this.swarm;
    const { host } = this.pane;
    host.addEventListener("mousemove", event => {
      const robot = this.#laneAt(event);
      selection.point(robot === null ? null : { robot });
    });
    host.addEventListener("mouseleave", () => selection.point(null));
    host.addEventListener("click", event => {
      const robot = this.#laneAt(event);
      if (robot !== null) {
        selection.follow(robot);
      }
    });
    host.addEventListener("keydown", event => this.#press(event));
  }

  /** Arrows point at the robot before and after, Enter follows it, Escape follows all again. */
  #press(event: KeyboardEvent): void {
    const { selection } = this.swarm;
    const count = this.swarm.definition.value?.robots.length ?? 0;
    const pointed = selection.pointed.value;
    const current = pointed !== null && "robot" in pointed ? pointed.robot : -1;
    if (event.key === "ArrowDown" || event.key === "ArrowUp") {
      const step = event.key === "ArrowDown" ? 1 : -1;
      const robot = Math.min(count - 1, Math.max(0, current + step));
      selection.point({ robot });
      this.reveal(robot);
    } else if (event.key === "Enter" && current >= 0) {
      selection.follow(current);
    } else if (event.key === "Escape" && selection.followed.value !== null) {
      selection.followed.set(null);
    } else {
      return;
    }
    event.preventDefault();
  }
}
