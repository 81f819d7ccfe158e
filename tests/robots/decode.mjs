// Decodes samples in the format of dotpose_dds_reader, using independent definitions of the types. Prints each sample
// as a line of JSON: node decode.mjs <samples
import { createInterface } from "node:readline";

import { MessageReader } from "@foxglove/rosmsg2-serialization";

import { definitionsOf } from "./definitions.mjs";

const readers = new Map();
const plain = (_key, value) => (ArrayBuffer.isView(value) ? Array.from(value) : value);

for await (const line of createInterface({ input: process.stdin })) {
  const [topic, type, bytes] = line.split(" ");
  if (!readers.has(type)) readers.set(type, new MessageReader(definitionsOf(type)));
  const message = readers.get(type).readMessage(Buffer.from(bytes, "hex"));
  console.log(JSON.stringify({ topic, type, message }, plain));
}
