// Converts lengths and strings to PDF operands.

export const kPointsPerMm = 72 / 25.4;

/** Returns text as a PDF string. Non-ASCII characters become question marks. */
export function shown(text: string): string {
    return `(${text.replace(/[^\x20-\x7e]/g, "?").replace(/[\\()]/g, "\\$&")})`;
}
