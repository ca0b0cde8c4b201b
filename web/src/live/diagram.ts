// What the diagrams over time have in common: the axis, the present, dragging, and seeking.

import { colors } from "../colors";
import { enlargement } from "../theme";
import { CanvasPane, type Pen } from "./pane";
import type { LiveSwarm } from "./swarm";
import type { Timeline } from "./timeline";
import type { View } from "./animation";

export const AXIS = 18;

export abstract class Diagram implements View {
  readonly pane: CanvasPane;
  readonly patient = true;

  constructor(
    protected readonly swarm: LiveSwarm,
    protected readonly timeline: Timeline,
    name: string,
    label: string,
    protected readonly changed: () => void,
  ) {
    this.pane = new CanvasPane(name, label, changed);
    timeline.zoom.on(changed);
    timeline.held.on(changed);
    this.#listen();
  }

  abstract draw(): void;
  protected abstract point(x: number, y: number): void;

  protected get label(): number {
    return Math.min(this.timeline.label * enlargement.value, this.pane.width * 0.3);
  }

  protected get span(): number {
    return Math.max(1, this.pane.width - this.label - 8);
  }

  protected range(): [number, number] {
    const start = this.timeline.start(this.span, this.swarm.playback.time);
    return [start, start + this.span / this.timeline.zoom.value];
  }

  protected x(cycle: number, start: number): number {
    return this.label + (cycle - start) * this.timeline.zoom.value;
  }

  protected cycleAt(x: number): number {
    return this.range()[0] + (x - this.label) / this.timeline.zoom.value;
  }

  protected drawAxis(pen: Pen, top: number, bottom: number): void {
    const [start, end] = this.range();
    const step = [1, 2, 5, 10, 20, 50, 100].find(size => size * this.timeline.zoom.value > 42) ?? 200;
    pen.font = `${11 * enlargement.value}px ${colors.value.font}`;
    pen.textAlign = "center";
    pen.textBaseline = "alphabetic";
    for (let cycle = Math.ceil(start / step) * step; cycle <= end; cycle += step) {
      pen.fillStyle = colors.value.line;
      pen.fillRect(Math.round(this.x(cycle, start)), top, 1, bottom - top);
      pen.fillStyle = colors.value.dim;
      pen.fillText(String(cycle), this.x(cycle, start), bottom + 13 * enlargement.value);
    }
    const now = this.x(this.swarm.playback.time, start);
    if (now >= this.label) {
      pen.fillStyle = colors.value.accent;
      pen.fillRect(now - 1, top, 2, bottom - top + 4);
    }
  }

  #place(event: MouseEvent): [number, number] {
    const box = this.pane.host.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  }

  #listen(): void {
    const { host } = this.pane;
    host.addEventListener("mousemove", event => this.point(...this.#place(event)));
    host.addEventListener("mouseleave", () => this.swarm.selection.point(null));
    host.addEventListener("pointerdown", event => this.#drag(event));
    host.addEventListener("keydown", event => this.#press(event));
  }

  /** Dragging moves through time; a press that does not move shows that cycle. */
  #drag(down: PointerEvent): void {
    if (down.button !== 0) {
      return;
    }
    const [x] = this.#place(down);
    let before = down.clientX;
    let moved = 0;
    const move = (event: PointerEvent): void => {
      moved += Math.abs(event.clientX - before);
      if (moved > 4) {
        this.timeline.drag(event.clientX - before, this.span, this.swarm.playback.time, this.swarm.log.first);
      }
      before = event.clientX;
    };
    const end = (): void => {
      window.removeEventListener("pointermove", move);
      if (moved <= 4 && x > this.label) {
        this.#seek(Math.ceil(this.cycleAt(x)));
      }
    };
    window.addEventListener("pointermove", move);
    window.addEventListener("pointerup", end, { once: true });
  }

  #seek(cycle: number): void {
    const { first, last } = this.swarm.log;
    void this.swarm.seek(Math.min(last, Math.max(first, cycle)));
  }

  #press(event: KeyboardEvent): void {
    const now = this.swarm.frame.value?.now ?? 0;
    const step = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
    if (step !== undefined) {
      event.preventDefault();
      this.#seek(now + step);
    } else if (event.key === "+" || event.key === "-") {
      this.timeline.zoomBy(event.key === "+" ? 1 : -1);
    }
    this.changed();
  }
}
