#include "image.hpp"

#include <algorithm>
#include <limits>
#include <memory>
#include <utility>

namespace dotpose::python {
namespace {

constexpr const char* kWanted = "an image is a numpy array of uint8 with the shape (height, width)";

std::string described(const py::array& array) {
    return "an array of " + std::string(py::str(array.dtype())) + " with the shape " +
           std::string(py::str(array.attr("shape")));
}

[[noreturn]] void refuse(const std::string& given, const char* advice) {
    throw py::type_error(std::string(kWanted) + ", not " + given + advice);
}

/// Converts a length to int. Lengths beyond the range of int are clamped to its maximum. Locators
/// accept only much smaller images, so an image with a clamped length is rejected as too large.
int side_px(py::ssize_t length) {
    return static_cast<int>(std::min<py::ssize_t>(length, std::numeric_limits<int>::max()));
}

}  // namespace

ImageView view_of(const py::handle& image) {
    if (!py::isinstance<py::array>(image)) {
        refuse("a " + std::string(py::str(py::type::of(image).attr("__name__"))),
               "; numpy.asarray(image) converts most images");
    }
    const auto array = py::reinterpret_borrow<py::array>(image);
    if (array.ndim() == 3) {
        refuse(described(array),
               "; convert a colour image to grey by image.mean(axis=2).astype("
               "\"uint8\") or cv2.cvtColor(image, cv2.COLOR_BGR2GRAY)");
    }
    if (array.ndim() != 2) refuse(described(array), "");
    if (!py::isinstance<py::array_t<std::uint8_t>>(array)) {
        refuse(described(array), "; image.astype(\"uint8\") converts grey levels from 0 to 255");
    }
    if (array.shape(1) > 1 && array.strides(1) != 1) {
        refuse(described(array) + " whose rows are not contiguous",
               "; numpy.ascontiguousarray(image) makes them contiguous");
    }
    return {static_cast<const std::uint8_t*>(array.data()), side_px(array.shape(1)),
            side_px(array.shape(0)), array.strides(0)};
}

py::array_t<std::uint8_t> array_of(GreyImage&& image) {
    auto owner = std::make_unique<GreyImage>(std::move(image));
    const GreyImage& kept = *owner;
    const py::capsule free_it(owner.release(),
                              [](void* owned) { delete static_cast<GreyImage*>(owned); });
    return py::array_t<std::uint8_t>({kept.height_px, kept.width_px}, kept.pixels.data(), free_it);
}

GreyImage copy_of(const ImageView& image) {
    GreyImage copy{{}, image.width_px, image.height_px};
    copy.pixels.reserve(static_cast<std::size_t>(image.width_px) *
                        static_cast<std::size_t>(image.height_px));
    for (int v = 0; v < image.height_px; ++v)
        copy.pixels.insert(copy.pixels.end(), image.row(v), image.row(v) + image.width_px);
    return copy;
}

}  // namespace dotpose::python
