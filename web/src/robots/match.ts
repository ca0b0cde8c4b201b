// Whether a robot is what was looked for.

import { gateName } from "../gate";
import type { RobotCard } from "../protocol";

/** Whether each word is in the name of the robot, in that of its gate, or in its letters. */
export function matches(robot: Pick<RobotCard, "name" | "function" | "behavior">, wanted: string): boolean {
  const words = wanted
    .toLowerCase()
    .split(/\s+/)
    .filter(word => word !== "");
  const texts = [robot.name, robot.function, gateName(robot.function), robot.behavior].map(text => text.toLowerCase());
  return words.every(word => texts.some(text => text.includes(word)));
}
