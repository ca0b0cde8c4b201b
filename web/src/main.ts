// Starts the page of a server.

import { App } from "./app";
import { SERVER } from "./line";
import { restoreTheme } from "./theme";

restoreTheme();
new App(SERVER).start();
