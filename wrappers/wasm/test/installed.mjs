// Access to the packed and installed package. The environment variable DOTPOSE_PACKAGE is the
// folder in which the package is installed. DOTPOSE_TOOL is the path of the command-line tool.
import { createRequire } from "node:module";
import { join } from "node:path";
import { pathToFileURL } from "node:url";

export const kTool = process.env.DOTPOSE_TOOL;
/** Returns the path of a file in the package. */
export const resolve = createRequire(join(process.env.DOTPOSE_PACKAGE, "package.json")).resolve;
export const url = (name) => pathToFileURL(resolve(name));
export const dotpose = await import(url("dotpose"));
export const { Tools } = await import(url("dotpose/tools"));
