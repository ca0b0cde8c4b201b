// The page of an evolution.

import { Archive } from "./archive";
import type { EvolutionData } from "./data";
import { readPage } from "./shown";

new Archive(readPage<EvolutionData>());
