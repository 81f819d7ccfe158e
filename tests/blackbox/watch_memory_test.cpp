// Tests the memory usage of `dotpose watch` in a long run. The environment variable
// DOTPOSE_LONG_RUN sets the number of frames, for example 180000 for an hour at 50 frames/s.
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>

#include <fmt/core.h>
#include <gtest/gtest.h>

#include "../drive.hpp"
#include "tool_command.hpp"

namespace dotpose::test {
namespace {

class WatchMemory : public ToolCommand {
  protected:
    static constexpr int kCycle = 100;

    /// Writes half a second of the drive as raw frames. The test repeats these frames.
    void put_frames() {
        save_drive_sheets(directory_ / "sheets.json");
        const DriveCamera camera(188, 120);
        const Drive drive;
        std::ofstream raw(directory_ / "drive.raw", std::ios::binary);
        for (int i = 0; i < kCycle; ++i) {
            const GreyImage image = camera.frame(drive, 240 + i);
            raw.write(reinterpret_cast<const char*>(image.pixels.data()),
                      static_cast<std::streamsize>(image.pixels.size()));
        }
    }
};

TEST_F(WatchMemory, IsTheSameAfterATenthOfTheRunAndAtItsEnd) {
#ifdef __SANITIZE_ADDRESS__
    GTEST_SKIP() << "the sanitizer keeps what is freed";
#endif
    const char* wanted = std::getenv("DOTPOSE_LONG_RUN");
    const int cycles = std::max((wanted != nullptr ? std::atoi(wanted) : 3000) / kCycle, 10);
    const int frames = cycles * kCycle;
    put_frames();
    // The pipe stays open, so that the memory can be measured after the last frame.
    const std::string script = fmt::format(
        "peak() {{ until [ $(wc -l < run.jsonl) -ge $1 ]; do sleep 0.1; kill -0 $watch; done;"
        "          awk '/VmHWM/ {{ print $2 }}' /proc/$watch/status; }}\n"
        "set -e; mkfifo pipe; touch run.jsonl\n"
        "(for ((i = 0; i < {}; ++i)); do cat drive.raw; done; exec sleep 3600) > pipe & writer=$!\n"
        "trap 'kill $writer' EXIT\n"
        "\"$T\" watch - --size 188x120 --fps 200 --sheets sheets.json -o run.jsonl --log run.csv "
        "--draw run.svg < pipe & watch=$!\n"
        "peak {}; peak {}; kill -INT $watch; wait $watch\n",
        cycles, frames / 10, frames);
    std::ofstream(directory_ / "script") << script;
    shell("export T; bash script");
    std::istringstream peaks(output_);
    int first_kb = 0;
    int last_kb = 0;
    peaks >> first_kb >> last_kb;
    RecordProperty("first_kb", first_kb);
    RecordProperty("last_kb", last_kb);
    EXPECT_GT(first_kb, 10'000);
    // Only the stored path may grow, to at most 16,384 points of 24 bytes, which is 393 kB. While
    // the vector is reallocated, two copies of the path exist.
    EXPECT_LE(last_kb, first_kb + 1500);
    EXPECT_NE(errors_.find(fmt::format("{} frames, ", frames)), std::string::npos) << errors_;
    fmt::print("{} frames: {} kB after a tenth, {} kB at the end\n", frames, first_kb, last_kb);
}

}  // namespace
}  // namespace dotpose::test
