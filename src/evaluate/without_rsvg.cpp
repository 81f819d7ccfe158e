// Implements raster.hpp for builds without librsvg. Figures are written only as SVG.
#include "dotpose/files/error.hpp"
#include "draw/svg.hpp"
#include "evaluate/raster.hpp"

namespace dotpose::draw {

void write_png(const std::filesystem::path& path, const std::string&) {
    throw Error("cannot write " + path.string() +
                ": dotpose was built without librsvg; write an SVG file and convert it");
}

void write_figure(const std::filesystem::path& folder, const std::string& name,
                  const std::function<void(std::ostream&)>& draw) {
    write_file(folder / (name + ".svg"), draw);
}

}  // namespace dotpose::draw
