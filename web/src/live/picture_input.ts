// A bus as a picture to draw on: a bit is a pixel, and the first is at the top left.

import { element } from "../element";
import type { PortBit } from "../ports";
import type { Column } from "../protocol";

/** The fewest bits on a side of a picture: narrower buses are numbers. */
const LEAST = 7;
const MOST = 32;

/** The pixels on a side if the bus may be a picture, else 0. */
export function pictureSide({ width }: Column): number {
  const side = Math.sqrt(width);
  return Number.isInteger(side) && side >= LEAST && side <= MOST ? side : 0;
}

export interface PictureInput {
  host: HTMLElement;
  update: () => void;
}

/**
 * A press sets pixels to the opposite of the first one until it ends. With the keyboard, arrows choose a pixel and the
 * space bar changes it.
 */
export function pictureInput(
  port: Column,
  bits: PortBit[],
  shown: (index: number) => number,
  set: (index: number, bit: number) => void,
): PictureInput {
  const side = pictureSide(port);
  let ink: number | null = null;
  const paint = (at: number) => {
    if (ink !== null) {
      set((bits[at] as PortBit).index, ink);
    }
  };
  const pixels = bits.map((bit, at) =>
    element("span", {
      role: "checkbox",
      tabindex: at === 0 ? 0 : -1,
      "aria-label": `input ${bit.name}`,
      "data-pixel": bit.name,
    }),
  );
  const placeOf = (event: PointerEvent) => {
    const under = document.elementFromPoint(event.clientX, event.clientY);
    return pixels.indexOf(under as HTMLSpanElement);
  };
  const host = element("div", {
    class: "drawn",
    role: "group",
    "aria-label": `input ${port.name} as a picture`,
    title: "Draw here",
    onpointerdown: event => {
      const at = placeOf(event);
      if (at >= 0) {
        event.preventDefault();
        host.setPointerCapture(event.pointerId);
        ink = 1 - shown((bits[at] as PortBit).index);
        paint(at);
      }
    },
    onpointermove: event => {
      const at = ink === null ? -1 : placeOf(event);
      if (at >= 0) {
        paint(at);
      }
    },
    onpointerup: () => (ink = null),
    onpointercancel: () => (ink = null),
    onkeydown: event => {
      const at = pixels.indexOf(event.target as HTMLSpanElement);
      const step = { ArrowLeft: -1, ArrowRight: 1, ArrowUp: -side, ArrowDown: side }[event.key];
      const next = step === undefined ? undefined : pixels[at + step];
      if (step !== undefined || event.key === " ") {
        event.preventDefault();
      }
      if (next !== undefined) {
        (pixels[at] as HTMLSpanElement).tabIndex = -1;
        next.tabIndex = 0;
        next.focus();
      } else if (event.key === " ") {
        const { index } = bits[at] as PortBit;
        set(index, 1 - shown(index));
      }
    },
  });
  // Styles in attributes are refused by the page's policy.
  host.style.gridTemplateColumns = `repeat(${side}, 1fr)`;
  host.append(...pixels);
  const before: number[] = [];
  const update = () =>
    bits.forEach(({ index }, at) => {
      const now = shown(index);
      if (before[at] !== now) {
        before[at] = now;
        (pixels[at] as HTMLSpanElement).setAttribute("aria-checked", String(now === 1));
      }
    });
  return { host, update };
}
