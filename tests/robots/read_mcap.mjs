// Reads an MCAP file with independent readers, and prints every message as a line of JSON: topic, type, time, quality
// of service and content. The stream reader and the indexed reader must agree, and all checksums must be correct.
// Otherwise, the program prints the fault and exits with 1.
//
//   node read_mcap.mjs FILE [--stream]
//
// --stream: uses only the stream reader, for a truncated file.
import { open, readFile } from "node:fs/promises";

import { crc32 } from "@foxglove/crc";
import { parse } from "@foxglove/rosmsg";
import { MessageReader } from "@foxglove/rosmsg2-serialization";
import { McapIndexedReader, McapStreamReader } from "@mcap/core";

function fail(what) {
  console.error(what);
  process.exit(1);
}

function json(_key, value) {
  if (typeof value === "bigint") return value.toString();
  if (ArrayBuffer.isView(value)) return Array.from(value);
  return value;
}

/** Decodes messages with the schemas contained in the file. */
class Decoder {
  #schemas = new Map();
  #channels = new Map();

  addSchema(schema) {
    if (schema.encoding !== "ros2msg") fail(`schema in ${schema.encoding}`);
    const definitions = parse(new TextDecoder().decode(schema.data), { ros2: true });
    this.#schemas.set(schema.id, { type: schema.name, reader: new MessageReader(definitions) });
  }

  addChannel(channel) {
    if (channel.messageEncoding !== "cdr") fail(`messages in ${channel.messageEncoding}`);
    this.#channels.set(channel.id, channel);
  }

  line(message) {
    const channel = this.#channels.get(message.channelId);
    const schema = this.#schemas.get(channel.schemaId);
    return JSON.stringify(
      {
        topic: channel.topic,
        type: schema.type,
        sequence: message.sequence,
        log_ns: message.logTime,
        offered: channel.metadata.get("offered_qos_profiles"),
        message: schema.reader.readMessage(message.data),
      },
      json,
    );
  }
}

async function streamed(bytes, isCut) {
  const reader = new McapStreamReader({ validateCrcs: true });
  reader.append(bytes);
  const decoder = new Decoder();
  const lines = [];
  for (let record; (record = reader.nextRecord()); ) {
    if (record.type === "Schema") decoder.addSchema(record);
    if (record.type === "Channel") decoder.addChannel(record);
    if (record.type === "Message") lines.push(decoder.line(record));
  }
  if (!isCut && !reader.done()) fail("the file has no end");
  return lines;
}

async function indexed(path, bytes) {
  const file = await open(path);
  const readable = {
    size: async () => BigInt(bytes.length),
    read: async (offset, size) => {
      const buffer = new Uint8Array(Number(size));
      const { bytesRead } = await file.read(buffer, 0, buffer.length, Number(offset));
      if (bytesRead !== buffer.length) fail(`cannot read ${size} bytes at ${offset}`);
      return buffer;
    },
  };
  const reader = await McapIndexedReader.Initialize({ readable });
  if (reader.header.profile !== "ros2") fail(`profile ${reader.header.profile}`);
  // The readers do not check the checksum of the data section. They check only those of the chunks and the summary.
  const data = bytes.subarray(0, Number(reader.dataEndOffset));
  if (reader.dataSectionCrc !== crc32(data)) fail("the check sum of the data is wrong");
  const decoder = new Decoder();
  for (const schema of reader.schemasById.values()) decoder.addSchema(schema);
  for (const channel of reader.channelsById.values()) decoder.addChannel(channel);
  const lines = [];
  for await (const message of reader.readMessages({ validateCrcs: true }))
    lines.push(decoder.line(message));
  await file.close();
  if (reader.statistics.messageCount !== BigInt(lines.length))
    fail(`${lines.length} messages, and ${reader.statistics.messageCount} by the statistics`);
  return lines;
}

const [path, option] = process.argv.slice(2);
const isCut = option === "--stream";
const bytes = new Uint8Array(await readFile(path));
const lines = await streamed(bytes, isCut);
// The lines are sorted, because the two readers may return messages with equal times in different orders.
if (!isCut && (await indexed(path, bytes)).sort().join() !== lines.slice().sort().join())
  fail("the readers disagree");
for (const line of lines) console.log(line);
