/// Picture: an SVG drawing that notebooks display.
#pragma once

#include <filesystem>
#include <string>

#include "binding.hpp"

namespace dotpose::python {

struct Picture {
    std::string svg;

    /// Writes the file. Throws Error on failure.
    void save(const std::filesystem::path& path) const;
};

void define_picture(py::module_& module);

}  // namespace dotpose::python
