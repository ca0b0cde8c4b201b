// The robots of a swarm, each in a lane of its own with a camera that follows it.

import { colors } from "../colors";
import { enlargement } from "../theme";
import { LaneGrid, middleOf } from "./camera";
import { crowdGrid, detailOf, drawDot, drawSilhouette } from "./crowd";
import { drawDial, drawLamp, drawRobot, drawStimulus, drawThread, type Lane } from "./drawing";
import { fitCall } from "./labels";
import { CanvasPane, type Pen } from "./pane";
import type { LiveSwarm } from "./swarm";
import { drawWalk, type Area } from "./walk";
import type { StimulusSource } from "../protocol";
import type { View } from "./animation";
import { sameSource } from "../selection";

const GAP = 6;
/** A lane's least width and height, and what its two lines of text need above the robot. */
const [NARROW, LOW, HEAD] = [270, 112, 38];
/** Voxels beside and above each other for which a lane has room. */
const [WIDE, TALL] = [10, 7];

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

  get #together(): boolean {
    return this.swarm.selection.together.value && this.swarm.selection.followed.value === null;
  }

  #arrange(): void {
    const count = this.#robots().length;
    if (this.#together) {
      this.#grid = crowdGrid(count, this.pane.width, this.pane.height);
      return;
    }
    const { width, height } = this.pane;
    const size = enlargement.value;
    const most = Math.max(1, Math.min(count, Math.floor(width / (NARROW * size))));
    const grids = Array.from({ length: most }, (_, i) => {
      const rows = Math.ceil(count / (i + 1));
      return new LaneGrid(count, Math.ceil(count / rows), width, Math.min(height, Math.max(LOW * size, height / rows)));
    });
    // The robots are as large as they can be; where that does not decide, more of them are seen.
    const scale = (grid: LaneGrid): number =>
      Math.min(grid.laneWidth / WIDE, (grid.laneHeight - GAP - HEAD * size) / TALL);
    this.#grid = grids.reduce((best, grid) => (scale(grid) >= scale(best) ? grid : best));
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
    const [left, top] = [this.#grid.left(lane), this.#grid.top(lane) - this.pane.scrolled];
    const [width, height] = [this.#grid.laneWidth - GAP, this.#grid.laneHeight - GAP];
    const head = HEAD * size;
    pen.fillStyle = colors.value.sky;
    pen.fillRect(left, top, width, head);
    this.#drawWalk(pen, robot, { left, top: top + head, width, height: height - head });
    const thread = this.swarm.thread({ robot });
    const right = left + width - 34 * size;
    if (thread !== null) {
      drawThread(pen, thread, { left, top, height, right }, size, colors.value);
    }
    const share = this.swarm.ownCycle(robot);
    if (share !== null) {
      drawDial(pen, share, right - 13 * size, top + 18 * size, 9 * size, colors.value);
    }
    const isMarked = this.#hasThreads() || share !== null;
    this.#drawLabel(pen, robot, left + 10, top, right - left - 14 - (isMarked ? 26 * size : 0));
    drawLamp(pen, this.swarm.value({ robot }), left + width - 18 * size, top + 18 * size, 12 * size, colors.value);
    if (sameSource(this.swarm.selection.pointed.value, { robot })) {
      pen.strokeStyle = colors.value.accent;
      pen.lineWidth = 3;
      pen.strokeRect(left + 1.5, top + 1.5, width - 3, height - 3);
    }
  }

  #hasThreads(): boolean {
    return (this.swarm.definition.value?.waves?.threads ?? 1) > 1;
  }

  #drawLabel(pen: Pen, index: number, left: number, top: number, width: number): void {
    const robot = this.swarm.definition.value?.robots[index];
    if (robot === undefined) {
      return;
    }
    const size = enlargement.value;
    // A robot of one input senses nothing but a constant by its other sides.
    const senses = robot.senses.filter(source => !("constant" in source));
    pen.textAlign = "left";
    pen.textBaseline = "alphabetic";
    pen.fillStyle = colors.value.ink;
    pen.font = `600 ${14 * size}px ${colors.value.font}`;
    const measured = (text: string): number => pen.measureText(text).width;
    const name = fitCall(robot.label, width, measured);
    pen.fillText(name, left, top + 17 * size);
    const beside = measured(name);
    pen.fillStyle = colors.value.dim;
    pen.font = `${12 * size}px ${colors.value.font}`;
    const call = ` = ${robot.function}(${senses.map(source => this.swarm.nameOf(source)).join(", ")})`;
    if (robot.named && beside + measured(call) <= width) {
      pen.fillText(call, left + beside, top + 17 * size);
    }
    const share = width / Math.max(2, senses.length);
    senses.forEach((source, i) => this.#drawSense(pen, source, left + i * share, top + 24 * size, share));
  }

  #drawSense(pen: Pen, source: StimulusSource, x: number, top: number, width: number): void {
    const size = enlargement.value;
    drawStimulus(pen, this.swarm.value(source), x, top, 12 * size, colors.value);
    pen.fillStyle = colors.value.dim;
    pen.font = `${11 * size}px ${colors.value.font}`;
    const name = fitCall(this.swarm.nameOf(source), width - 20 * size, text => pen.measureText(text).width);
    pen.fillText(name, x + 16 * size, top + 10 * size);
  }

  #drawWalk(pen: Pen, robot: number, area: Area): void {
    const definition = this.swarm.definition.value;
    const walking = {
      outline: definition === null ? null : this.swarm.playback.outline(robot),
      voxels: definition?.robots[robot]?.voxels ?? [],
      looks: definition?.looks ?? [],
      tall: Math.max(5, this.#tallness(robot) - 1),
      wide: WIDE,
      columns: definition?.ground ?? [],
    };
    this.#cameras.set(robot, drawWalk(pen, area, walking, this.#cameras.get(robot), colors.value));
  }

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
