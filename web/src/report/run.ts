// The page of a run: its swarms walk in step with their waveforms. Everything is in the page; nothing is fetched.

import type { RunData } from "../protocol";
import { part, readPage } from "./shown";
import { SwarmPlayer } from "./swarm";

const { swarms, looks } = readPage<RunData>();
swarms.forEach((swarm, i) => new SwarmPlayer(part(document, `#swarm-${i}`), swarm, looks));
