// Reads types and their definitions from standard input, as JSON, and prints how they differ from the definitions of
// ROS 2. Comments and constants are ignored. The type hashes are computed from the definitions of ROS 2 according to
// REP 2011.
import { createHash } from "node:crypto";
import { readFile } from "node:fs/promises";

import { parse } from "@foxglove/rosmsg";

import { definitionsOf } from "./definitions.mjs";

/** Returns the members of a message as text. */
function members(definition) {
  return definition.definitions
    .filter((member) => !member.isConstant)
    .map((member) => `${member.type}${member.isArray ? `[${member.arrayLength ?? ""}]` : ""} ${member.name}`)
    .join(", ");
}

/** Type numbers from type_description_interfaces/FieldType. */
const typeIds = { message: 1, uint8: 3, int32: 6, uint32: 7, float64: 11, byte: 16, string: 17 };
const kOfArrays = 48;
const kOfSequences = 144;

/** ROS types of the members that have a different type in the npm package. */
const asInRos = { "diagnostic_msgs/DiagnosticStatus level": "byte" };

function described({ name, definitions }) {
  const fields = definitions.filter((member) => !member.isConstant).map((member) => {
    const given = asInRos[`${name} ${member.name}`] ?? member.type;
    const type = given === "time" ? "builtin_interfaces/Time" : given;
    const isMessage = type.includes("/");
    const kind = !member.isArray ? 0 : member.arrayLength ? kOfArrays : kOfSequences;
    return {
      name: member.name,
      type: {
        type_id: typeIds[isMessage ? "message" : type] + kind,
        capacity: member.arrayLength ?? 0,
        string_capacity: 0,
        nested_type_name: isMessage ? type.replace("/", "/msg/") : "",
      },
    };
  });
  return { type_name: name.replace("/", "/msg/"), fields };
}

/** Returns the hash of a type, given its definition and the definitions of all types that it contains.
   The hash is computed from JSON with spaces after commas and colons. */
function typeHash([whole, ...parts]) {
  const byName = (a, b) => (a.type_name < b.type_name ? -1 : 1);
  const text = JSON.stringify({
    type_description: described(whole),
    referenced_type_descriptions: parts.map(described).sort(byName),
  });
  const spaced = text.replace(/([,:])/g, "$1 ");  // names contain neither commas nor colons
  return `RIHS01_${createHash("sha256").update(spaced).digest("hex")}`;
}

const timeDefinition = {
  name: "builtin_interfaces/Time",
  definitions: [{ type: "int32", name: "sec" }, { type: "uint32", name: "nanosec" }],
};

let differ = false;
for (const { name, definition, hash } of JSON.parse(await readFile("/dev/stdin", "utf8"))) {
  const type = name.replace("/msg/", "/");
  const parts = parse(definition, { ros2: true });
  // Readers do not need the definition of the Time type, but files written by ROS contain it.
  const time = parts.find((part) => part.name === "builtin_interfaces/Time");
  if (members(time) !== "int32 sec, uint32 nanosec") {
    console.log(`${name}: a time is ${members(time)}`);
    differ = true;
  }
  const ours = parts.filter((part) => part !== time);
  const theirs = definitionsOf(type);
  if (hash !== typeHash([...theirs, timeDefinition])) {
    console.log(`${name}: hash ${hash} instead of ${typeHash([...theirs, timeDefinition])}`);
    differ = true;
  }
  if (ours.length !== theirs.length) {
    console.log(`${name}: ${ours.length} definitions instead of ${theirs.length}`);
    differ = true;
  }
  for (const wanted of theirs) {
    // The first definition is that of `type` itself. It has no name.
    const found = wanted.name === type ? ours[0] : ours.find((each) => each.name === wanted.name);
    if (found !== undefined && members(found) === members(wanted)) continue;
    console.log(`${wanted.name}: ${found && members(found)} instead of ${members(wanted)}`);
    differ = true;
  }
}
process.exit(differ ? 1 : 0);
