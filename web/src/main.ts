// Starts the page.

import { App } from "./app";
import { restoreTheme } from "./theme";

restoreTheme();
new App().start();
