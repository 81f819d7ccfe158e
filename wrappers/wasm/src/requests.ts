// The requests in module/requests.hpp, with the same fields in the same order. Every value is a
// double.
import { codeNumber, type Cell, type Code, type Section } from "./names.js";

/**
 * A page with the pattern. The defaults are the same as in the command-line tool: A4, margins of 5
 * mm, spacing 0.508 mm.
 */
export interface SheetOptions {
    /** Code variant. Default: "anoto". */
    code?: Code;
    /** Section of the code. Default: 0, 0. */
    section?: Section;
    /** Spacing of the printed grid. Default: 0.508. */
    spacing_mm?: number;
    /** Distance from the centre of a dot to its intersection. Default: a sixth of the spacing. */
    displacement_mm?: number;
    /** Diameter of a dot. Default: a sixth of the spacing. */
    dot_mm?: number;
    /** Cell of the upper left dot. Should be different for each sheet. Default: 0, 0. */
    origin?: Cell;
    /** Width of the page, at most 100,000. Default: 210. */
    width_mm?: number;
    /** Height of the page, at most 100,000. Default: 297. */
    height_mm?: number;
    /** Margin without ink on all sides. Default: 5. */
    margin_mm?: number;
}

/** Size and optics of the simulated camera. The defaults describe the device in the published paper. */
export interface Camera {
    /** Width of the image, 1 to 16384. Default: 188. */
    width_px?: number;
    /** Height of the image, 1 to 16384. Default: 120. */
    height_px?: number;
    /** Size of a pixel on the paper at the image centre. Default: 0.046. */
    mm_per_px?: number;
    /** Radial distortion per px^2, negative for barrel distortion. */
    k?: number;
    /**
     * Distance of the projection centre from the paper. This option has an effect only if the
     * camera is tilted. Default: 16.
     */
    working_distance_mm?: number;
}

/** Pose of the simulated camera. */
export interface CameraPose {
    /** x of the pattern point at the image centre. x increases to the right. */
    x_mm: number;
    /** y of the pattern point at the image centre. y increases downwards. */
    y_mm: number;
    /** Angle of the image's x axis in the pattern, clockwise as seen on the paper. */
    theta_rad?: number;
    /**
     * Tilt about the image x axis. If positive, the paper is farther from the camera at the bottom
     * of the image.
     */
    tilt_x_rad?: number;
    /**
     * Tilt about the image y axis. If positive, the paper is closer to the camera on the right side
     * of the image.
     */
    tilt_y_rad?: number;
}

/** Effects of printer, paper, light and sensor. By default, there are none. */
export interface Imperfections {
    /** Grey level of bare paper at the image centre, 0 to 255. Default: 200. */
    paper_level?: number;
    /** Reflectance of ink, relative to paper. Default: 0.15. */
    ink_reflectance?: number;
    /** Standard deviation of a dot's reflectance, relative to paper. */
    ink_variation?: number;
    /**
     * Contrast of the palest ink relative to the darkest ink. Each of the four directions of
     * displacement has its own ink. Default: 1.
     */
    palest_ink?: number;
    /** Fraction of the light that is lost in the corners, 0 to 1. */
    vignetting?: number;
    /**
     * Linear change in illumination across the image, relative to the illumination at the centre, 0
     * to 2.
     */
    fall?: number;
    /** Direction of decreasing brightness: angle from the image x axis towards the y axis
     * (down). */
    fall_direction_rad?: number;
    /** Standard deviation of the Gaussian blur, 0 to 100. */
    blur_sigma_px?: number;
    /**
     * Motion of the scene in the image during the exposure, to the right. The pose applies to the
     * middle of the exposure. The motion must not be longer than 100 px.
     */
    motion_x_px?: number;
    /** Motion of the scene in the image during the exposure, downwards. */
    motion_y_px?: number;
    /** Standard deviation of the noise, in grey levels. */
    noise_sigma?: number;
    /** Fraction of the pixels that are replaced with black or white at random. */
    salt_and_pepper?: number;
    /** Standard deviation of the position of a printed dot, per axis. */
    jitter_mm?: number;
    /** Fraction of the dots that are missing. */
    missing?: number;
    /** Number of dark specks in the frame. */
    dirt_blobs?: number;
    /** Number of thick strokes or words in the frame. */
    graphics?: number;
    /** Standard deviation of the reflectance of the paper. */
    texture?: number;
}

/** All inputs for a simulated frame. */
export interface Scene {
    /** The page, placed on a table. */
    sheet?: SheetOptions;
    /** True if there are dots everywhere, as on an infinite page. Default: false. */
    whole_plane?: boolean;
    /** Seed for the printing errors, which are the same in all frames of the page. Default: 1. */
    page_seed?: number;
    /** Reflectance of the table, relative to paper. Default: 0.2. */
    table_reflectance?: number;
    /** Size and optics of the camera. Default: the device described in the published paper. */
    camera?: Camera;
    /** Pose of the camera on the page. */
    pose: CameraPose;
    /** Effects of printer, paper, light and sensor. Default: none. */
    imperfections?: Imperfections;
    /** Seed for the noise and the dirt. Default: 1. */
    seed?: number;
}

const kSpacing_mm = 0.508;

export function sheetFields(sheet: SheetOptions): number[] {
    const spacing_mm = sheet.spacing_mm ?? kSpacing_mm;
    const { section = { u: 0, v: 0 }, origin = { x: 0, y: 0 } } = sheet;
    return [
        codeNumber(sheet.code ?? "anoto"),
        ...[section.u, section.v],
        ...[spacing_mm, sheet.displacement_mm ?? spacing_mm / 6, sheet.dot_mm ?? spacing_mm / 6],
        ...[origin.x, origin.y],
        ...[sheet.width_mm ?? 210, sheet.height_mm ?? 297, sheet.margin_mm ?? 5],
    ];
}

function cameraFields(camera: Camera, pose: CameraPose, spacing_mm: number): number[] {
    const x = pose.x_mm / spacing_mm;
    const y = pose.y_mm / spacing_mm;
    return [
        ...[camera.width_px ?? 188, camera.height_px ?? 120, camera.mm_per_px ?? 0.046],
        ...[camera.k ?? 0, camera.working_distance_mm ?? 16],
        ...[Math.floor(x), Math.floor(y), x - Math.floor(x), y - Math.floor(y)],
        ...[pose.theta_rad ?? 0, pose.tilt_x_rad ?? 0, pose.tilt_y_rad ?? 0],
    ];
}

function imperfectionFields(seen: Imperfections): number[] {
    return [
        ...[seen.paper_level ?? 200, seen.ink_reflectance ?? 0.15, seen.ink_variation ?? 0],
        ...[seen.palest_ink ?? 1, seen.vignetting ?? 0, seen.fall ?? 0, seen.fall_direction_rad ?? 0],
        ...[seen.blur_sigma_px ?? 0, seen.motion_x_px ?? 0, seen.motion_y_px ?? 0],
        ...[seen.noise_sigma ?? 0, seen.salt_and_pepper ?? 0, seen.jitter_mm ?? 0, seen.missing ?? 0],
        ...[seen.dirt_blobs ?? 0, seen.graphics ?? 0, seen.texture ?? 0],
    ];
}

export function sceneFields(scene: Scene): number[] {
    const sheet = scene.sheet ?? {};
    return [
        ...sheetFields(sheet),
        ...[scene.whole_plane ? 1 : 0, scene.page_seed ?? 1, scene.table_reflectance ?? 0.2],
        ...cameraFields(scene.camera ?? {}, scene.pose, sheet.spacing_mm ?? kSpacing_mm),
        ...imperfectionFields(scene.imperfections ?? {}),
        scene.seed ?? 1,
    ];
}
