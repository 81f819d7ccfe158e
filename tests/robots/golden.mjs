// Serialises messages with an independent serialiser and independent definitions, and prints each as a line
// with its type and its bytes. golden.txt contains the output. cdr_test.cpp builds the same messages.
//
//   node golden.mjs > golden.txt
import { MessageWriter } from "@foxglove/rosmsg2-serialization";

import { definitionsOf } from "./definitions.mjs";

const stamp = { sec: 1764091234, nanosec: 987654321 };
const counted = (first) => Array.from({ length: 36 }, (_, i) => first + i / 8);
const pose = {
  pose: { position: { x: 1.25, y: -0.5, z: 0 }, orientation: { x: 0, y: 0, z: 0.6, w: 0.8 } },
  covariance: counted(1),
};
const transform = (frame_id, child_frame_id, x) => ({
  header: { stamp, frame_id },
  child_frame_id,
  transform: {
    translation: { x, y: 2, z: 3 },
    rotation: { x: 0.5, y: -0.5, z: 0.5, w: -0.5 },
  },
});

const messages = {
  "geometry_msgs/PoseWithCovarianceStamped": { header: { stamp, frame_id: "map" }, pose },
  "nav_msgs/Odometry": {
    header: { stamp, frame_id: "odom" },
    child_frame_id: "base_link",
    pose,
    twist: {
      twist: { linear: { x: 0.1, y: 0.2, z: 0 }, angular: { x: 0, y: 0, z: -3 } },
      covariance: counted(-7),
    },
  },
  "tf2_msgs/TFMessage": {
    transforms: [transform("map", "odom", 1), transform("odom", "base_link", -1e9)],
  },
  "diagnostic_msgs/DiagnosticArray": {
    header: { stamp: { sec: -1, nanosec: 5 }, frame_id: "" },
    status: [
      {
        level: 1,
        name: "dotpose: anna",
        message: "moving",
        hardware_id: "anna",
        values: [
          { key: "state", value: "moving" },
          { key: "sheet", value: "table" },
        ],
      },
      { level: 2, name: "", message: "lost", hardware_id: "", values: [] },
    ],
  },
  "sensor_msgs/CompressedImage": {
    header: { stamp, frame_id: "camera_optical" },
    format: "png",
    data: Uint8Array.from([137, 80, 78, 71, 0, 255, 1]),
  },
};

for (const [type, message] of Object.entries(messages)) {
  const bytes = new MessageWriter(definitionsOf(type)).writeMessage(message);
  console.log(type, Buffer.from(bytes).toString("hex"));
}
