// Tests poses in space in Node, on simulated frames with known poses.
import assert from "node:assert/strict";
import { before, describe, test } from "node:test";
import { dotpose, Tools } from "./installed.mjs";

const { Locator } = dotpose;

/** A frame with a known pose. */
const kScene = { sheet: { origin: { x: 1000, y: 2000 } }, pose: { x_mm: 560, y_mm: 1070, theta_rad: 0.5 } };

describe("poses in space", () => {
    let tools;
    before(async () => (tools = await Tools.create()));

    test("fits the pose of the camera in space", async () => {
        const [distance_mm, tilt_rad] = [25, 0.3];
        const camera = { width_px: 320, height_px: 240, mm_per_px: 0.046, working_distance_mm: distance_mm };
        const pose = { x_mm: 560, y_mm: 1070, tilt_y_rad: tilt_rad };
        const image = tools.render({ ...kScene, camera, pose, imperfections: { noise_sigma: 2, blur_sigma_px: 0.6 } });
        const locator = await Locator.create({ space: { focal_px: distance_mm / camera.mm_per_px } });
        for (let i = 0; i < 3; ++i) {
            const { space } = locator.locate(image);
            // The optical axis intersects the paper at the pose point, and the camera leans towards +x.
            const truth = [560 + distance_mm * Math.sin(tilt_rad), 1070, -distance_mm * Math.cos(tilt_rad)];
            space.position_mm.forEach((mm, axis) => assert.ok(Math.abs(mm - truth[axis]) < 0.03, `${axis}: ${mm}`));
            const [x, y, z, w] = space.quaternion_xyzw;
            assert.ok(Math.abs(y + Math.sin(tilt_rad / 2)) < 0.002 && Math.abs(Math.hypot(x, y, z, w) - 1) < 1e-9);
            assert.ok(Math.abs(space.tilt_rad - tilt_rad) < 0.003 && Math.abs(space.azimuth_rad) < 0.01);
            assert.equal(space.covariance.length, 36);
            assert.ok(space.covariance[14] > 0 && space.covariance[14] < 1e-3);
            assert.ok(space.dots > 500 && space.residual_px < 0.5);
            assert.equal(space.is_ambiguous, false);
        }
        const blank = { data: new Uint8Array(320 * 240).fill(200), width: 320, height: 240 };
        assert.equal(locator.locate(blank).space, null);
        assert.equal((await Locator.create()).locate(image).space, null);
        // Doubling the print scale doubles all distances from the origin of the pattern.
        const twice = await Locator.create({ space: { focal_px: distance_mm / 0.046, print_scale: 2 } });
        assert.ok(Math.abs(twice.locate(image).space.position_mm[2] + 2 * distance_mm * Math.cos(tilt_rad)) < 0.06);
    });

    test("fits the same pose to a part of the image, with the lens and the axis of the whole", async () => {
        const camera = { width_px: 400, height_px: 240, mm_per_px: 0.046, working_distance_mm: 25, k: -1e-6 };
        const image = tools.render({ ...kScene, camera, pose: { x_mm: 560, y_mm: 1070, tilt_y_rad: 0.2 } });
        const focal_px = 25 / camera.mm_per_px;
        const whole = await Locator.create({ lens_k_per_px2: camera.k, space: { focal_px } });
        const expected = whole.locate(image).space;
        const space = { focal_px: [focal_px, focal_px], axis_px: [199.5, 119.5] };
        const part = await Locator.create({ lens_k_per_px2: camera.k, lens_centre_offset_px: [40, 0], space });
        const found = part.locate({ ...image, width: 320, stride: 400 }).space;
        found.position_mm.forEach((mm, axis) => assert.ok(Math.abs(mm - expected.position_mm[axis]) < 0.01, `${axis}: ${mm}`));
        assert.ok(Math.abs(found.tilt_rad - expected.tilt_rad) < 0.001 && found.residual_px < 0.1);
        const wrong = await Locator.create({ lens_k_per_px2: camera.k, space: { focal_px } });
        assert.ok(wrong.locate({ ...image, width: 320, stride: 400 }).space.residual_px > 2 * found.residual_px);
    });

    test("the module of poses in space has the same fixes", async () => {
        const image = tools.render(kScene);
        const locator = await Locator.create({ space: { focal_px: 350 } });
        assert.deepEqual(locator.locate(image).bytes, (await Locator.create()).locate(image).bytes);
    });

    test("refuses cameras that cannot exist", async () => {
        for (const space of [{ focal_px: 0 }, { focal_px: NaN }, { focal_px: 300, print_scale: 0 }, { focal_px: 300, axis_px: [NaN, 0] }])
            await assert.rejects(Locator.create({ space }), RangeError, JSON.stringify(space));
        const aside = await Locator.create({ space: { focal_px: 300, axis_px: [5000, 0] } });
        assert.throws(() => aside.locate(tools.render(kScene)), { name: "RangeError", message: /pinhole_px is more than 1000 px/ });
    });
});
