// Starts an exported page.

import { element } from "../element";
import { restoreTheme } from "../theme";
import { readRecording } from "./exported";
import { Machine } from "./machine";
import { PlayerPage } from "./page";

restoreTheme();
readRecording(document.getElementById("data")?.textContent ?? "").then(
  recording => new PlayerPage(new Machine(recording)).start(),
  () => document.body.append(element("p", { class: "empty" }, "The data of this page is damaged: export it again.")),
);
