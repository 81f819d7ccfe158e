// This file is compiled against the installed package to check the types of the package.
import { Locator, patternBits, Tracker, WorkerLocator } from "dotpose";
import type { Fix, KnownRegion, MapUse, MeasuredMotion, Track } from "dotpose";
import { Tools, type Scene } from "dotpose/tools";

const scene: Scene = { pose: { x_mm: 1, y_mm: 2 }, imperfections: { noise_sigma: 2 } };
const tools = await Tools.create();
const image = tools.render(scene);
const locator = await Locator.create({ code: "auto", spacing_mm: 0.508 });
const fix: Fix = locator.locate(image);
const next: Fix = locator.locate(image, { prediction: fix });
export const position: [number, number] = [next.x_mm, next.covariance[0]!];
export const back: ArrayBufferLike = (await (await WorkerLocator.create()).locate(image)).image.data.buffer;
export const bits: Uint8Array = await patternBits({ cell: { x: 1, y: 2 }, columns: 8, rows: 8 });
const sheet: KnownRegion = { first: { x: 0, y: 0 }, columns: 393, rows: 564 };
await Locator.create({ sheets: [sheet], only_sheets: true });
const motion: MeasuredMotion = { right_mm: 1.5, sigma_mm: 0.02, sigma_rad: 0.005 };
export const frames: number = locator.locate(image, { motion }).frames;
const tracker = await Tracker.create({ max_speed_mm_s: 500 });
const track: Track = tracker.update(10_000, next, motion);
export const [x_mm, lost]: [number, boolean] = [track.x_mm, track.events.includes("lost")];
locator.locate(image, { prediction: tracker.predict(20_000) });
const upright = await Locator.create({ space: { focal_px: 543.5, axis_px: [160, 120] } });
export const height_mm: number | undefined = upright.locate(image).space?.position_mm[2];
const mapped = await Locator.create({ print_map: new Uint8Array(await new Blob().arrayBuffer()) });
export const use: MapUse = mapped.locate(image).map_use;

// @ts-expect-error: unknown code
await Locator.create({ code: "morse" });
// @ts-expect-error: an image without a height
locator.locate({ data: new Uint8Array(9), width: 3 });
// @ts-expect-error: 16-bit images are not supported
locator.locate({ data: new Uint16Array(9), width: 3, height: 3 });
// @ts-expect-error: a motion without its standard deviations
locator.locate(image, { motion: { right_mm: 1.5 } });
