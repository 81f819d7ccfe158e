// Converts drawings to PNG, for programs that cannot display SVG.
#pragma once

#include <filesystem>
#include <functional>
#include <iosfwd>
#include <string>

namespace dotpose::draw {

/// Writes an SVG drawing as a PNG file with two pixels per unit. Throws Error if the file cannot be
/// written, or if dotpose was built without librsvg.
void write_png(const std::filesystem::path& path, const std::string& svg);

/// Writes NAME.svg and NAME.png into a folder, or only NAME.svg if dotpose was built without
/// librsvg. `draw` writes the SVG. Throws Error if a file cannot be written.
void write_figure(const std::filesystem::path& folder, const std::string& name,
                  const std::function<void(std::ostream&)>& draw);

}  // namespace dotpose::draw
