// Draws a fix. Implements Fix.draw.
#include <sstream>

#include "dotpose/tools/draw.hpp"
#include "fix.hpp"
#include "picture.hpp"

namespace dotpose::python {
namespace {

Picture draw(PyFix& fix, const std::optional<std::filesystem::path>& path,
             const std::string& title) {
    const Stages& stages = fix.seen_stages();
    DrawOptions options;
    options.spacing_mm = stages.trace().fix.spacing_mm();
    options.title = title;
    std::ostringstream out;
    draw_frame(out, stages.image(), stages.trace(), options);
    Picture picture{out.str()};
    if (path) picture.save(*path);
    return picture;
}

}  // namespace

void define_drawing(py::module_& module) {
    module.def("_draw", &draw, "fix"_a, "path"_a, "title"_a);
}

}  // namespace dotpose::python
