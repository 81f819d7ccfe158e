/// Runs `dotpose locate` as a black box, and provides frames and parsed records.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>
#include <png.h>

#include "dotpose/tools/image_file.hpp"
#include "dotpose/tools/simulate.hpp"
#include "tool_command.hpp"

namespace dotpose::test {

using nlohmann::json;

inline std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);)
        lines.push_back(line);
    return lines;
}

/// Returns the fields of one CSV line (RFC 4180, without line breaks inside fields).
inline std::vector<std::string> cells_of(const std::string& line) {
    std::vector<std::string> cells(1);
    bool is_quoted = false;
    for (std::size_t i = 0; i < line.size(); ++i) {
        if (line[i] == '"' && is_quoted && i + 1 < line.size() && line[i + 1] == '"') {
            cells.back() += line[++i];
        } else if (line[i] == '"') {
            is_quoted = !is_quoted;
        } else if (line[i] == ',' && !is_quoted) {
            cells.emplace_back();
        } else {
            cells.back() += line[i];
        }
    }
    return cells;
}

inline Shot shot(std::uint64_t index) {
    Setup setup;
    setup.seed = 20;
    return draw_shot(setup, index);
}

class LocateCommand : public ToolCommand {
  protected:
    int run(const std::string& arguments, const std::string& input = "/dev/null") {
        return ToolCommand::run("locate " + arguments, input);
    }

    std::vector<json> records() const {
        std::vector<json> result;
        for (const std::string& line : lines_of(output_))
            result.push_back(json::parse(line));
        return result;
    }
    std::vector<std::string> files() const {
        std::vector<std::string> result;
        for (const json& record : records())
            result.push_back(record["file"]);
        return result;
    }

    void write(const std::string& name, const std::string& content) const {
        std::ofstream(directory_ / name, std::ios::binary) << content;
    }
    void write_frame(const std::string& name, std::uint64_t index) const {
        write_pgm(directory_ / name, render(shot(index)).view());
    }
    void write_level(const std::string& name, int width_px, int height_px) const {
        GreyImage image{{}, width_px, height_px};
        image.pixels.assign(static_cast<std::size_t>(width_px * height_px), 200);
        write_pgm(directory_ / name, image.view());
    }
    /// Writes an image with libpng's simplified interface, which requires 16-bit samples to be
    /// proportional to the light intensity.
    void write_as_png(const std::string& name, const GreyImage& image, png_uint_32 format,
                      const void* samples) const {
        png_image png{};
        png.version = PNG_IMAGE_VERSION;
        png.width = static_cast<png_uint_32>(image.width_px);
        png.height = static_cast<png_uint_32>(image.height_px);
        png.format = format;
        ASSERT_NE(
            png_image_write_to_file(&png, (directory_ / name).c_str(), 0, samples, 0, nullptr), 0);
    }
};

}  // namespace dotpose::test
