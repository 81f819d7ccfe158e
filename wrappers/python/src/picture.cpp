#include "picture.hpp"

#include <fstream>

#include "dotpose/files/error.hpp"

namespace dotpose::python {

void Picture::save(const std::filesystem::path& path) const {
    std::ofstream out(path, std::ios::binary);
    out << svg;
    out.close();
    if (!out) throw Error(path.string() + ": cannot be written");
}

void define_picture(py::module_& module) {
    py::class_<Picture>(module, "Picture", "A drawing as an SVG document, which notebooks display.")
        .def_readonly("svg", &Picture::svg, "The text of the document.")
        .def("save", &Picture::save, "path"_a, "Write the document to a file.")
        .def("_repr_svg_", [](const Picture& self) { return self.svg; })
        .def("__repr__", [](const Picture& self) {
            return "<Picture of " + std::to_string(self.svg.size()) + " bytes>";
        });
}

}  // namespace dotpose::python
