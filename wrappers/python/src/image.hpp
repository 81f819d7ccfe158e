/// Conversions between images and numpy arrays.
#pragma once

#include "binding.hpp"
#include "dotpose/image.hpp"
#include "dotpose/tools/grey_image.hpp"

namespace dotpose::python {

/// Returns a view of a two-dimensional uint8 array. The rows need not be contiguous. The array must
/// outlive the view. Throws TypeError with the expected and actual types.
ImageView view_of(const py::handle& image);

/// Returns an array that owns the pixels moved from the image.
py::array_t<std::uint8_t> array_of(GreyImage&& image);

/// Returns a copy of the pixels.
GreyImage copy_of(const ImageView& image);

}  // namespace dotpose::python
