/// Table of fixes on sheets that are not one plane: whether their covariances are right.
#pragma once

#include <cstdint>
#include <string>

#include "counting.hpp"
#include "dotpose/tools/evaluate.hpp"

namespace dotpose {

/// Frames of one kind of sheet.
struct SheetFrames {
    std::string what;
    std::string view;  ///< size of the images
    FrameSource frame_at;
    Effort effort = Effort::twice;
};

/// Prints the head of the table in Markdown.
void print_uneven_head();

/// Locates that number of frames, prints their row and returns the number of wrong fixes. Throws
/// Error if interrupted.
int print_uneven_row(const SheetFrames& sheet, int frames, const Counting& counting);

}  // namespace dotpose
