#pragma once

/// Locates the frames in the file at `path`: binary PGM images (P5, 8 bits, no comments), one after
/// the other. Before an image may stand a prediction, and it is then tracked: a line of T and the
/// integers of Place (x, y, u, v), PlaneFromImage (centre, at_centre, du, dv) and displacement_q16,
/// with blanks between them. Prints one line for each:
///
///     STATUS CELL_X CELL_Y FRACTION_X FRACTION_Y THETA SECTION_U SECTION_V SPACING SEEN USED
///     BIT_ERRORS P_WRONG
///
/// with the integers of Fix as they are (fraction_q16, theta_bam, spacing_px_q16, p_wrong_log2).
/// Returns the exit status: 0 for all frames read, 1 for a file that cannot be read.
int locate_frames(const char* path);
