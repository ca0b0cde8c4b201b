// Dialogs that are made when they open.

import { element, type Child } from "./element";

/** Opens a dialog, which a press outside closes, too. The result is what it was closed with; null without an answer. */
export function ask<T>(
  label: string,
  kind: string,
  inside: (close: (answer: T) => void) => Child[],
): Promise<T | null> {
  return new Promise(resolve => {
    let answer: T | null = null;
    const close = (given: T): void => {
      answer = given;
      dialog.close();
    };
    const dialog: HTMLDialogElement = element("dialog", { class: kind, "aria-label": label }, ...inside(close));
    dialog.onclose = () => {
      dialog.remove();
      resolve(answer);
    };
    dialog.onclick = event => event.target === dialog && dialog.close();
    document.body.append(dialog);
    dialog.showModal();
  });
}
