/// Images passed from Python, as arrays or file paths.
#pragma once

#include <filesystem>
#include <variant>
#include <vector>

#include "binding.hpp"
#include "dotpose/tools/grey_image.hpp"

namespace dotpose::python {

/// An image: pixels copied from an array, or the path of a file that is read when needed.
using Frame = std::variant<GreyImage, std::filesystem::path>;

/// Converts an array or a path to a Frame. Throws TypeError for any other object.
Frame frame_of(const py::handle& image);
/// Converts each image of a sequence to a Frame.
std::vector<Frame> frames_of(const py::iterable& images);
/// Returns the pixels of an image. Throws Error if the file cannot be read.
GreyImage pixels_of(const Frame& frame);

}  // namespace dotpose::python
