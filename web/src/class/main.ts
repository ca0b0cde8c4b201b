// Starts the teacher's page.

import { restoreTheme } from "../theme";
import { Board } from "./board";

restoreTheme();
const board = new Board();
document.body.append(board.host);
void board.start();
