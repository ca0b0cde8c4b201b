// A page with a schematic alone.

import type { SchematicPages } from "../protocol";
import type { Cell } from "./data";
import { Schematic } from "./schematic";
import { part, readPage } from "./shown";

const { schematic, cells } = readPage<{ schematic: SchematicPages; cells: Cell[] }>();
new Schematic(part(document, ".schematic"), schematic, cells);
