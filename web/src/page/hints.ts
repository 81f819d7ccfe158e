// Advice for frames that cannot be located, or are located with low accuracy.
import type { ImageQuality, Reading } from "../engine/messages.js";

/** Relation between a frame and the known sheets. */
export interface SheetContext {
    /** True if sheets are known, and the fix is on none of them. */
    is_on_unknown: boolean;
    /** True if only positions on known sheets are considered possible. */
    only_sheets: boolean;
}

export interface Hint {
    text: string;
    /** True if the frame was located. */
    good: boolean;
}

/** Recommended range of the spacing in the image. Patterns with spacings of 6 to 60 px can be located. */
const kMinSpacing_px = 7;
const kMaxSpacing_px = 50;
const kDark = 45;
const kBright = 245;
const kPale = 25;
/** Minimum sharpness of a picture in focus, as a fraction of its contrast. */
const kBlurred = 0.12;
/**
 * Limits for frames that cannot be located. If there are more than `kManyDots` dots, the dots are
 * probably too small. If there are fewer than `kFewDots`, too few dots are in view.
 */
const kManyDots = 1500;
const kFewDots = 60;
/** Pictures with fewer dots than this might not show a sheet at all. */
const kMinDots = 5;

const kBlurredHint = "Sharper: hold still, let the camera focus, or move a little away.";
const kNoDotsHint = "No dots are found: point the camera at a sheet, and let the camera focus.";

/** Returns advice for a blurred picture in which `dots` dots were found. */
function hintOfBlur(dots: number): string {
    return dots < kMinDots ? kNoDotsHint : kBlurredHint;
}

function hintOfLight(quality: ImageQuality): string | null {
    if (quality.brightness < kDark) return "Brighter: the picture is too dark.";
    if (quality.brightness > kBright) return "Less light: the picture is overexposed.";
    if (quality.contrast < kPale) return "Point the camera at a sheet with dots, in even light.";
    return null;
}

/**
 * Returns advice on light and focus, or null if there is nothing to improve. `dots` is the number of dots that were
 * found in the picture. It selects the advice for pictures of low sharpness: without dots, the picture may show a smooth
 * surface rather than a blurred sheet.
 */
export function hintOfPicture(quality: ImageQuality, dots: number): string | null {
    return hintOfLight(quality) ?? (quality.sharpness < kBlurred ? hintOfBlur(dots) : null);
}

function hintOfFailure(reading: Reading, only_sheets: boolean): string {
    const { fix, quality } = reading;
    const light = hintOfLight(quality);
    if (light !== null) return light;
    if (fix.status === "mirrored") return "The picture is mirrored: switch off the mirror effect of the camera.";
    if (only_sheets && (fix.status === "not_in_code" || fix.status === "not_certain"))
        return "No known sheet has these dots. If this sheet is not in the list, allow other sheets.";
    if (fix.status === "ambiguous_code") return "Two codes explain these dots: choose the sheet's code, or show more dots.";
    if (fix.status === "not_in_code") return "These dots belong to another code: choose the sheet's code.";
    if (quality.sharpness < kBlurred) return hintOfBlur(fix.dots_seen);
    if (fix.dots_seen > kManyDots) return "Closer: the dots are too small.";
    if (fix.dots_seen < kFewDots) return "Further away: too few dots are in view. Or no sheet is in view.";
    return "Closer and straighter: fill the picture with dots, seen from above.";
}

/** Returns advice for a frame, or null if there is nothing to improve. */
export function hintOf(reading: Reading, { is_on_unknown, only_sheets }: SheetContext): Hint | null {
    const { fix } = reading;
    if (!fix.ok) return { text: `${hintOfFailure(reading, only_sheets)} (${fix.message})`, good: false };
    if (is_on_unknown) return { text: "Located, but on no known sheet. Is this the right sheet?", good: false };
    if (fix.space?.is_ambiguous)
        return { text: "Located, but two tilts explain these dots. Show more of the sheet, or move closer.", good: false };
    if (fix.surface !== "even") return { text: "Located, but the paper is not flat here.", good: true };
    if (fix.spacing_px < kMinSpacing_px) return { text: "Located. Moving closer increases the accuracy.", good: true };
    if (fix.spacing_px > kMaxSpacing_px) return { text: "Located. Moving away shows more dots.", good: true };
    if (fix.attempt === "second") return { text: "Located by the second attempt. A sharper or brighter picture helps.", good: true };
    return null;
}
