// Writes the definitions of messages of ROS 2, and of all messages in them, as files
// FOLDER/PACKAGE/msg/NAME.msg.
import { mkdir, writeFile } from "node:fs/promises";

import { definitionsOf } from "./definitions.mjs";

const [folder, ...types] = process.argv.slice(2);
const found = new Map();
for (const type of types) definitionsOf(type, found);
found.set("builtin_interfaces/Time", { definitions: [
  { type: "int32", name: "sec" }, { type: "uint32", name: "nanosec" },
] });
for (const [type, { definitions }] of found) {
  const [packageName, name] = type.split("/");
  const members = definitions
    .filter((member) => !member.isConstant)
    .map((member) => {
      const memberType = member.type === "time" ? "builtin_interfaces/Time" : member.type;
      return `${memberType}${member.isArray ? `[${member.arrayLength ?? ""}]` : ""} ${member.name}\n`;
    });
  await mkdir(`${folder}/${packageName}/msg`, { recursive: true });
  await writeFile(`${folder}/${packageName}/msg/${name}.msg`, members.join(""));
}
