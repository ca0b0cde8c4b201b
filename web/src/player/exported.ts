// What an exported page contains: the swarm, how its robots walk, and the rows of the tests. It is compressed.

import type { ExportedSwarm } from "../protocol";
import { decodeNumbers } from "../robots/gait";

/** Reads the data of an exported page: base64 of JSON, compressed as zlib does. */
export async function readRecording(text: string): Promise<ExportedSwarm> {
  const bytes = Uint8Array.from(atob(text.trim()), letter => letter.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return JSON.parse(await new Response(stream).text()) as ExportedSwarm;
}

/** How a body walks under one pattern in a cycle that repeats. */
export interface Stride {
  /** Voxels that it moves in the cycle. */
  shift: number;
  /** Voxels: x and y of each point, pose after pose, without the motion of the whole. */
  poses: Float32Array;
}

/** The strides of a walk, one for each pattern. */
export function stridesOf(walk: ExportedSwarm["walks"][number]): Stride[] {
  return walk.strides.map(({ shift, poses }) => ({
    shift,
    poses: Float32Array.from(decodeNumbers(poses), hundredths => hundredths / 100),
  }));
}
