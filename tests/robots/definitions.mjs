// The definitions of ROS 2 messages, from an independent package.
import common from "@foxglove/rosmsg-msgs-common";

const all = common.ros2jazzy;

/** Returns the definition of a type such as "nav_msgs/Odometry", followed by the definitions of all
 * types that it contains. */
export function definitionsOf(type, found = new Map()) {
  const definition = all[type] ?? all[type.replace("builtin_interfaces/", "")];
  if (definition === undefined) throw new Error(`no definition of ${type}`);
  found.set(type, { ...definition, name: type });
  for (const member of definition.definitions)
    if (member.isComplex && !found.has(member.type)) definitionsOf(member.type, found);
  return [...found.values()];
}
