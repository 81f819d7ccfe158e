#pragma once

#include <dotpose/locate.hpp>

/// Returns the program's locator options. If the frames are small, the options also accept dots
/// that consist of a single pixel.
dotpose::DeviceOptions program_options();
/// Passes a known sheet to the locator if the program's frames are so small that they can only be
/// located on known sheets.
void set_known_sheet(dotpose::DeviceLocator& locator);

/// Locates the frames in the file at `path`. The file is a sequence of binary PGM images (P5, 8
/// bits, no comments). An image can be preceded by a prediction, which is then used to track it.
/// The prediction is a line with the letter T and the integer members of Place (x, y, u, v),
/// PlaneFromImage (centre, at_centre, du, dv) and displacement_q16, separated by spaces. Prints one
/// line for each frame:
///
///     STATUS CELL_X CELL_Y FRACTION_X FRACTION_Y THETA SECTION_U SECTION_V SPACING SEEN USED
///     BIT_ERRORS P_WRONG
///
/// The values are the integer members of Fix (fraction_q16, theta_bam, spacing_px_q16,
/// p_wrong_log2). Returns the exit status: 0 if all frames were read. Prints a message and returns
/// 1 if the file cannot be opened or has invalid content.
int locate_frames(const char* path);
