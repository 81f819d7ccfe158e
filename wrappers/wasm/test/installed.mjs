// The packed and installed package. Environment variables: DOTPOSE_PACKAGE is the folder in which
// the package is installed, and DOTPOSE_TOOL the path of the command-line tool.
import { createRequire } from "node:module";
import { join } from "node:path";
import { pathToFileURL } from "node:url";

export const kTool = process.env.DOTPOSE_TOOL;
/** Returns the path of a file in the package. */
export const resolve = createRequire(join(process.env.DOTPOSE_PACKAGE, "package.json")).resolve;
export const url = (name) => pathToFileURL(resolve(name));
export const dotpose = await import(url("dotpose"));
export const { Tools } = await import(url("dotpose/tools"));
