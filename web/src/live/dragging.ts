// Pointers that move a picture in its pane: one drags it, and two pinch it.

/** Pixels from the top left of the pane. */
type Place = [number, number];

/** Moves the picture by some pixels, and shows `factor` times as large what is at a place. */
type Move = (by: Place, factor: number, at: Place) => void;

/** A press that moves fewer pixels is a click. */
const SLACK = 4;

export class Dragging {
  readonly #pointers = new Map<number, Place>();
  #isClick = true;

  /** Presses on buttons move nothing; `click` is told of presses that did not move. */
  constructor(
    private readonly pane: HTMLElement,
    private readonly move: Move,
    click: (target: EventTarget | null) => void,
  ) {
    pane.addEventListener("pointerdown", event => this.#begin(event));
    pane.addEventListener("wheel", event => this.#wheel(event), { passive: false });
    pane.addEventListener("click", event => {
      if (this.#isClick) {
        click(event.target);
      }
    });
  }

  #place(event: MouseEvent): Place {
    const box = this.pane.getBoundingClientRect();
    return [event.clientX - box.left - this.pane.clientLeft, event.clientY - box.top - this.pane.clientTop];
  }

  /** The wheel zooms with Ctrl, as pinching does; without, the page scrolls. */
  #wheel(event: WheelEvent): void {
    if (event.ctrlKey) {
      event.preventDefault();
      this.move([0, 0], Math.exp(-event.deltaY / 300), this.#place(event));
    }
  }

  #begin(start: PointerEvent): void {
    if (start.button !== 0 || (start.target instanceof Element && start.target.closest("button") !== null)) {
      return;
    }
    const from = this.#place(start);
    this.#pointers.set(start.pointerId, from);
    this.#isClick = this.#pointers.size === 1;
    const move = (event: PointerEvent): void => {
      if (event.pointerId !== start.pointerId) {
        return;
      }
      const to = this.#place(event);
      this.#isClick &&= Math.hypot(to[0] - from[0], to[1] - from[1]) <= SLACK;
      if (!this.#isClick) {
        this.#moved(event.pointerId, to);
      }
    };
    const end = (event: PointerEvent): void => {
      if (event.pointerId === start.pointerId) {
        this.#pointers.delete(start.pointerId);
        window.removeEventListener("pointermove", move);
        window.removeEventListener("pointerup", end);
        window.removeEventListener("pointercancel", end);
      }
    };
    window.addEventListener("pointermove", move);
    window.addEventListener("pointerup", end);
    window.addEventListener("pointercancel", end);
  }

  #moved(pointer: number, to: Place): void {
    const from = this.#pointers.get(pointer) ?? to;
    const other = [...this.#pointers].find(([id]) => id !== pointer)?.[1];
    this.#pointers.set(pointer, to);
    const by: Place = [to[0] - from[0], to[1] - from[1]];
    if (other === undefined) {
      this.move(by, 1, to);
      return;
    }
    const apart = (place: Place): number => Math.max(1, Math.hypot(place[0] - other[0], place[1] - other[1]));
    this.move([by[0] / 2, by[1] / 2], apart(to) / apart(from), [(to[0] + other[0]) / 2, (to[1] + other[1]) / 2]);
  }
}
