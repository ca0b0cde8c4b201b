// What the pages of results contain.

import type { SchematicPages, SwarmRobot, VoxelLook } from "../protocol";
import { decodeNumbers, type Gait } from "../robots/gait";

/** A body with its poses. */
export interface Recorded {
  /** Columns and rows. */
  size: [number, number];
  voxels: SwarmRobot["voxels"];
  /** The number of points. */
  corners: number;
  /** The base64 of hundredths of a voxel: x and y of each point, frame by frame. */
  frames: string;
}

/** How a recorded body walks, with so many frames a cycle. */
export function gaitOf({ corners: points, frames }: Recorded, posesPerCycle: number): Gait {
  const coordinates = decodeNumbers(frames);
  const cycles = (coordinates.length / points / 2 - 1) / posesPerCycle;
  return { posesPerCycle, cycles, points, origin: 0, coordinates };
}

/** Whether a robot has become unstable by a time in cycles. A cycle that the fault ended was not recorded whole. */
export function isUnstable(
  fault: number | null,
  time: number,
  { pace, cycles }: Pick<RecordedSwarm, "pace" | "cycles">,
): boolean {
  return fault !== null && time * pace >= Math.min(fault, cycles * pace);
}

/** A robot of a circuit. */
export interface Cell {
  net: string;
  function: string;
  /** Words with their texts. */
  about: [string, string][];
  /** The nets that it senses. */
  reads: string[];
}

/** A row of a waveform: a text of bits, or the values of a bus. They apply `shift` cycles later. */
export interface Row {
  name: string;
  /** The name of its color in the style sheet. */
  color: string;
  shift: number;
  values: string | string[];
}

export interface RecordedRobot extends Recorded {
  /** Its place among the cells. */
  cell: number;
  /** The frame in which it became unstable. */
  fault: number | null;
  /** For each stimulus, a digit a cycle. */
  sensed: string[];
}

export interface RecordedSwarm {
  /** Frames in a cycle. */
  pace: number;
  robots: RecordedRobot[];
  /** The bits of each are hexadecimal digits of four cycles, the first one highest. */
  cells: (Cell & { bits: string })[];
  schematic: SchematicPages;
  cycles: number;
  /** The cycles at which inputs change. */
  marks: number[];
  inputs: Row[];
  outputs: Row[];
}

export interface RunData {
  looks: VoxelLook[];
  swarms: RecordedSwarm[];
}

/** The best of a niche; there may have been no room for its gait. */
export interface Elite extends Partial<Recorded> {
  behavior: string;
  function: string;
  /** Its bin of each axis. */
  niche: number[];
  fitness: number[];
  color: string;
  about: [string, string][];
}

export interface EvolutionData {
  looks: VoxelLook[];
  /** What is shown of each image: rows from the top, 1 is black. */
  images: number[][][];
  /** The patterns, or as many as there are images. */
  patterns: string[];
  /** Cycles under each of them. */
  cycles: number;
  /** Frames in a cycle. */
  pace: number;
  axes: { word: string; bins: number }[];
  behaviors: { word: string; function: string }[];
  elites: Elite[];
}
