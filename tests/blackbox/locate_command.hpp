/// `dotpose locate` as its user sees it: a program in a directory with files.
#pragma once

#include <array>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <png.h>
#include <stdlib.h>
#include <sys/wait.h>

#include "dotpose/image_file.hpp"
#include "dotpose/simulate.hpp"

namespace dotpose::test {

namespace fs = std::filesystem;
using nlohmann::json;

inline std::string read_file(const fs::path& path) {
    std::ifstream stream(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

inline std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);)
        lines.push_back(line);
    return lines;
}

/// The cells of one CSV line (RFC 4180; no line breaks within).
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

/// Nominal frames with known poses.
inline Shot shot(std::uint64_t index) {
    Setup setup;
    setup.seed = 20;
    return draw_shot(setup, index);
}

/// Runs `dotpose locate ARGUMENTS` in a directory of its own.
class LocateCommand : public testing::Test {
  protected:
    void SetUp() override {
        std::string name = (fs::temp_directory_path() / "dotpose-tool-XXXXXX").string();
        ASSERT_NE(mkdtemp(name.data()), nullptr);
        directory_ = name;
    }
    void TearDown() override { fs::remove_all(directory_); }

    void run(const std::string& arguments, const std::string& input = "/dev/null") {
        const std::string command = "cd '" + directory_.string() +
                                    "' && '" DOTPOSE_TOOL "' locate " + arguments + " <" + input +
                                    " 2>.stderr";
        output_.clear();
        std::FILE* pipe = popen(command.c_str(), "r");
        ASSERT_NE(pipe, nullptr);
        std::array<char, 4096> buffer;
        for (std::size_t n = 1; n > 0;) {
            n = std::fread(buffer.data(), 1, buffer.size(), pipe);
            output_.append(buffer.data(), n);
        }
        const int status = pclose(pipe);
        exit_code_ = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
        errors_ = read_file(directory_ / ".stderr");
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
    /// By libpng's simplified interface; 2-byte samples are linear, as it calls 16 bits.
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

    fs::path directory_;
    int exit_code_ = -1;
    std::string output_;
    std::string errors_;
};

}  // namespace dotpose::test
