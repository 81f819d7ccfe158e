// Lengths and texts as operands of PDF.

export const kPointsPerMm = 72 / 25.4;

/** Returns a text; what ASCII has no character for becomes a question mark. */
export function shown(text: string): string {
    return `(${text.replace(/[^\x20-\x7e]/g, "?").replace(/[\\()]/g, "\\$&")})`;
}
