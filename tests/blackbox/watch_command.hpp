/// Runs `dotpose watch` on a simulated drive over two sheets.
#pragma once

#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "../drive.hpp"
#include "tool_command.hpp"

namespace dotpose::test {

using nlohmann::json;

inline std::vector<json> parsed(const std::string& text) {
    std::vector<json> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);)
        lines.push_back(json::parse(line));
    return lines;
}

class WatchCommand : public ToolCommand {
  protected:
    static constexpr int kWidth = 320;
    static constexpr int kHeight = 240;
    static constexpr const char* kRaw = "--size 320x240 --fps 200";
    static constexpr const char* kTrack = "--sheets sheets.json --max-speed 400";

    void SetUp() override {
        ToolCommand::SetUp();
        save_drive_sheets(directory_ / "sheets.json");
    }

    /// Returns a frame of the drive. Each frame is rendered only once per process.
    static const GreyImage& frame(int index) {
        static const Drive drive;
        static const DriveCamera camera(kWidth, kHeight);
        static std::map<int, GreyImage> frames;
        const auto known = frames.find(index);
        if (known != frames.end()) return known->second;
        return frames.emplace(index, camera.frame(drive, index)).first->second;
    }
    void put_raw(int frames, int first = 0) {
        std::ofstream raw(directory_ / "drive.raw", std::ios::binary);
        for (int i = 0; i < frames; ++i) {
            const GreyImage& image = frame(first + i);
            raw.write(reinterpret_cast<const char*>(image.pixels.data()),
                      static_cast<std::streamsize>(image.pixels.size()));
        }
    }
    void put_video(int frames, const std::string& name) {
        put_raw(frames);
        encode("-c:v ffv1", name);
    }
    void encode(const std::string& options, const std::string& name) {
        shell("ffmpeg -v error -f rawvideo -pix_fmt gray -s 320x240 -r 200 -i drive.raw " +
              options + " " + name);
    }
    void shell(const std::string& command) {
        ASSERT_EQ(std::system(("cd '" + directory_.string() + "' && " + command).c_str()), 0);
    }

    const Drive drive_;
};

}  // namespace dotpose::test
