/// Images: numpy arrays are seen without a copy, grey images become arrays of their own.
#pragma once

#include "binding.hpp"
#include "dotpose/image.hpp"
#include "dotpose/tools/grey_image.hpp"

namespace dotpose::python {

/// Returns a view of a two-dimensional array of uint8, whose rows may lie apart. The array must
/// live as long as the view. Throws TypeError, which says what is wanted and what was given.
ImageView view_of(const py::handle& image);

/// Returns the array of an image, which takes over its pixels.
py::array_t<std::uint8_t> array_of(GreyImage&& image);

/// Returns a copy of the pixels.
GreyImage copy_of(const ImageView& image);

}  // namespace dotpose::python
