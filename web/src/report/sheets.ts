// A page with a schematic alone.

import type { SheetsData } from "../protocol";
import { Schematic } from "./schematic";
import { part, readPage } from "./shown";

const { schematic, cells } = readPage<SheetsData>();
new Schematic(part(document, ".schematic"), schematic, cells);
