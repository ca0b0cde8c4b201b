import { element } from "../element";
export class LearnPanel {
  readonly host = element("div", { class: "learn" });
  constructor(_parts: object, _doors: object) {}
}
