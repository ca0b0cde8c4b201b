// The page of an evolution.

import { Archive } from "./archive";
import type { EvolutionData } from "../protocol";
import { readPage } from "./shown";

new Archive(readPage<EvolutionData>());
