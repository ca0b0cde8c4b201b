// How far each robot has walked since the left edge: lines that rise walk right, lines that fall walk left.

import { sameSource } from "../selection";
import { colors } from "../colors";
import { enlargement } from "../theme";
import { AXIS, Diagram } from "./diagram";
import type { Pen } from "./pane";
import { spread } from "./spread";
import type { LiveSwarm } from "./swarm";
import type { Timeline } from "./timeline";

/** With more robots, names at the ends of the lines would cover each other. */
const NAMED = 12;
const REACH = 14;

interface Scale {
  start: number;
  end: number;
  y: (place: number) => number;
  top: number;
  bottom: number;
}

export class Spacetime extends Diagram {
  constructor(swarm: LiveSwarm, timeline: Timeline, changed: () => void) {
    super(swarm, timeline, "spacetime", "The place of each robot against time", changed);
  }

  draw(): void {
    const definition = this.swarm.definition.value;
    if (!this.pane.visible || definition === null) {
      return;
    }
    const pen = this.pane.begin(this.pane.height);
    const scale = this.#scale();
    this.drawAxis(pen, scale.top, scale.bottom);
    this.#drawPlaces(pen, scale);
    pen.save();
    pen.beginPath();
    const end = this.swarm.running.value ? this.x(this.swarm.playback.time, scale.start) : this.pane.width;
    pen.rect(this.label, 0, end - this.label, scale.bottom + 2);
    pen.clip();
    const lines = this.#robots();
    lines.filter(robot => !this.#isPointed(robot)).forEach(robot => this.#drawLine(pen, robot, scale, false));
    lines.filter(robot => this.#isPointed(robot)).forEach(robot => this.#drawLine(pen, robot, scale, true));
    pen.restore();
    this.#drawNames(pen, lines, scale);
  }

  protected point(x: number, y: number): void {
    const scale = this.#scale();
    const cycle = Math.min(this.swarm.log.last, Math.max(this.swarm.log.first, Math.round(this.cycleAt(x))));
    const distances = this.#robots().map(robot => {
      const place = this.#place(robot, cycle);
      return { robot, distance: place === null ? Infinity : Math.abs(scale.y(place) - y) };
    });
    const nearest = distances.sort((a, b) => a.distance - b.distance)[0];
    this.swarm.selection.point(nearest !== undefined && nearest.distance < REACH ? { robot: nearest.robot } : null);
  }

  #robots(): number[] {
    const { followed } = this.swarm.selection;
    const count = this.swarm.definition.value?.robots.length ?? 0;
    return followed.value === null ? Array.from({ length: count }, (_, i) => i) : [followed.value];
  }

  #isPointed(robot: number): boolean {
    return sameSource(this.swarm.selection.pointed.value, { robot });
  }

  /** The place after a cycle, from where the robot was at the left edge. */
  #place(robot: number, cycle: number): number | null {
    const { log } = this.swarm;
    const at = (time: number): number | null => (time === 0 ? 0 : (log.at(time)?.places[robot] ?? null));
    const oldest = log.first === 0 ? 0 : log.first + 1;
    const [place, start] = [at(cycle), at(Math.max(oldest, Math.floor(this.range()[0])))];
    return place === null ? null : place - (start ?? 0);
  }

  #placeAt(robot: number, time: number): number | null {
    const [from, to] = [this.#place(robot, Math.floor(time)), this.#place(robot, Math.ceil(time))];
    return from === null || to === null ? null : from + (to - from) * (time - Math.floor(time));
  }

  #newest(): number {
    const { log, playback, running } = this.swarm;
    return running.value ? playback.cycle : log.last;
  }

  #scale(): Scale {
    const [start, end] = this.range();
    const [from, to] = [
      Math.max(this.swarm.log.first, Math.floor(start)),
      Math.min(this.swarm.log.last, Math.ceil(end)),
    ];
    let [low, high] = [-2, 2];
    for (const robot of this.#robots()) {
      for (let cycle = from; cycle <= to; cycle++) {
        const place = this.#place(robot, cycle) ?? 0;
        low = Math.min(low, place);
        high = Math.max(high, place);
      }
    }
    const [top, bottom] = [8, this.pane.height - AXIS * enlargement.value];
    const y = (place: number): number => bottom - 6 - ((place - low) / (high - low)) * (bottom - top - 12);
    return { start, end, y, top, bottom };
  }

  #drawPlaces(pen: Pen, { y, top, bottom }: Scale): void {
    pen.font = `${11 * enlargement.value}px ${colors.value.font}`;
    pen.textAlign = "left";
    pen.textBaseline = "middle";
    pen.fillStyle = colors.value.dim;
    pen.fillText("right ▲", 6, top + 6, this.label - 10);
    pen.fillText("left ▼", 6, bottom - 6, this.label - 10);
    pen.fillRect(this.label, y(0), this.span, 0.5);
    pen.textAlign = "right";
    if (y(0) - top > 26 && bottom - y(0) > 26) {
      pen.fillText("start", this.label - 6, y(0));
    }
  }

  #drawLine(pen: Pen, robot: number, scale: Scale, pointed: boolean): void {
    const newest = this.#newest();
    const last = Math.min(newest, Math.ceil(scale.end));
    pen.lineWidth = pointed ? 4 : 1.8;
    pen.lineJoin = "round";
    pen.globalAlpha = this.swarm.selection.pointed.value !== null && !pointed ? 0.45 : 1;
    for (let cycle = Math.max(this.swarm.log.first + 1, Math.floor(scale.start)); cycle <= last; cycle++) {
      const [from, to] = [this.#place(robot, cycle - 1), this.#place(robot, cycle)];
      if (from !== null && to !== null) {
        pen.strokeStyle = this.swarm.value({ robot }, cycle) === 1 ? colors.value.one : colors.value.zero;
        pen.beginPath();
        pen.moveTo(this.x(cycle - 1, scale.start), scale.y(from));
        pen.lineTo(this.x(cycle, scale.start), scale.y(to));
        pen.stroke();
      }
    }
    pen.globalAlpha = 1;
  }

  /** The names at the ends of the lines, moved apart where they would cover each other. */
  #drawNames(pen: Pen, robots: number[], scale: Scale): void {
    const definition = this.swarm.definition.value;
    const time = this.swarm.running.value ? this.swarm.playback.time : this.#newest();
    const size = 11 * enlargement.value;
    // What has no room is left out: those without a name in the program first.
    const room = Math.max(1, Math.floor((scale.bottom - scale.top) / (size + 1)));
    const rank = (robot: number): number => (definition?.robots[robot]?.named === true ? 0 : 1);
    const named =
      robots.length <= NAMED
        ? [...robots].sort((a, b) => rank(a) - rank(b)).slice(0, room)
        : robots.filter(robot => this.#isPointed(robot));
    const ends = named.flatMap(robot => {
      const place = this.#placeAt(robot, time);
      return place === null || time === 0 ? [] : [{ robot, y: scale.y(place) }];
    });
    spread(ends, size + 1, scale.top + 4, scale.bottom - 4);
    pen.textAlign = "left";
    pen.textBaseline = "middle";
    pen.fillStyle = colors.value.ink;
    for (const { robot, y } of ends) {
      pen.font = `${this.#isPointed(robot) ? "600 " : ""}${size}px ${colors.value.font}`;
      pen.fillText(
        definition?.robots[robot]?.label ?? "",
        Math.min(this.x(time, scale.start), this.pane.width - 40) + 6,
        y,
      );
    }
  }
}
