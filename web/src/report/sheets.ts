// A page with a schematic alone.

import type { Cell, Sheets } from "./data";
import { Schematic } from "./schematic";
import { part, readPage } from "./shown";

const { schematic, cells } = readPage<{ schematic: Sheets; cells: Cell[] }>();
new Schematic(part(document, ".schematic"), schematic, cells);
