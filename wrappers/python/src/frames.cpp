#include "frames.hpp"

#include "dotpose/tools/frame_file.hpp"
#include "image.hpp"

namespace dotpose::python {

Frame frame_of(const py::handle& image) {
    if (py::isinstance<py::str>(image) || py::hasattr(image, "__fspath__")) {
        return image.cast<std::filesystem::path>();
    }
    return copy_of(view_of(image));
}

std::vector<Frame> frames_of(const py::iterable& images) {
    std::vector<Frame> frames;
    for (const py::handle& image : images)
        frames.push_back(frame_of(image));
    return frames;
}

GreyImage pixels_of(const Frame& frame) {
    if (const auto* path = std::get_if<std::filesystem::path>(&frame)) return read_frame(*path);
    return std::get<GreyImage>(frame);
}

}  // namespace dotpose::python
