// Reads types and their definitions, as JSON on standard input, and says where they differ from
// those of ROS 2. Comments, and constants, do not matter.
import { readFile } from "node:fs/promises";

import { parse } from "@foxglove/rosmsg";

import { definitionsOf } from "./definitions.mjs";

/** The members that a message has, as texts. */
function members(definition) {
  return definition.definitions
    .filter((member) => !member.isConstant)
    .map((member) => `${member.type}${member.isArray ? `[${member.arrayLength ?? ""}]` : ""} ${member.name}`)
    .join(", ");
}

let differ = false;
for (const { name, definition } of JSON.parse(await readFile("/dev/stdin", "utf8"))) {
  const type = name.replace("/msg/", "/");
  const parts = parse(definition, { ros2: true });
  // Their readers know a time without a definition; files of ROS have one.
  const time = parts.find((part) => part.name === "builtin_interfaces/Time");
  if (members(time) !== "int32 sec, uint32 nanosec") {
    console.log(`${name}: a time is ${members(time)}`);
    differ = true;
  }
  const ours = parts.filter((part) => part !== time);
  const theirs = definitionsOf(type);
  if (ours.length !== theirs.length) {
    console.log(`${name}: ${ours.length} definitions instead of ${theirs.length}`);
    differ = true;
  }
  for (const wanted of theirs) {
    // The first one has no name.
    const found = wanted.name === type ? ours[0] : ours.find((each) => each.name === wanted.name);
    if (found !== undefined && members(found) === members(wanted)) continue;
    console.log(`${wanted.name}: ${found && members(found)} instead of ${members(wanted)}`);
    differ = true;
  }
}
process.exit(differ ? 1 : 0);
