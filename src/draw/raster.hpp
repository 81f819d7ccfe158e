// Raster: a drawing in pixels, for what does not show SVG.
#pragma once

#include <filesystem>
#include <functional>
#include <iosfwd>
#include <string>

namespace dotpose::draw {

/// Writes a drawing, which is SVG, as PNG, with two pixels to its unit. Throws Error.
void write_png(const std::filesystem::path& path, const std::string& svg);

/// Writes NAME.svg and NAME.png into a folder, by means of a function that draws SVG. Throws Error.
void write_figure(const std::filesystem::path& folder, const std::string& name,
                  const std::function<void(std::ostream&)>& draw);

}  // namespace dotpose::draw
