// Tests that `dotpose watch` saves frames for calibration and reports why most frames fail.
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "dotpose/tools/image_file.hpp"
#include "tool_command.hpp"

namespace dotpose::test {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

class WatchSave : public ToolCommand {
  protected:
    static constexpr int kPlaces = 5;

    /// Writes simulated frames, each taken at a different place, to the folder `frames`. Also
    /// writes `slow.raw`, a video that contains each of these frames three times.
    void SetUp() override {
        ASSERT_EQ(run("simulate -o frames --seed 91 --frames " + std::to_string(kPlaces)), 0);
        ASSERT_EQ(shell("ffmpeg -v error -framerate 10 -i frames/frame_%06d.pgm -vf fps=30 "
                        "-f rawvideo -pix_fmt gray slow.raw"),
                  0)
            << errors_;
    }

    int watch(const std::string& options) {
        return run("watch - --size 188x120 --fps 30 --no-window " + options, "slow.raw");
    }

    std::vector<std::string> saved() const {
        std::vector<std::string> names;
        for (const auto& entry : fs::directory_iterator(directory_ / "saved"))
            names.push_back(entry.path().filename().string());
        std::ranges::sort(names);
        return names;
    }

    std::vector<std::uint8_t> pixels(const std::string& name) const {
        return read_image(directory_ / name).pixels;
    }
};

TEST_F(WatchSave, OneFramePerNewPlaceAndNothingIsOverwritten) {
    ASSERT_EQ(watch("--save saved"), 0) << errors_;
    EXPECT_THAT(errors_, HasSubstr("dotpose: 5 frames saved in saved\n"));
    ASSERT_EQ(saved().size(), std::size_t{kPlaces});
    for (int i = 0; i < kPlaces; ++i) {
        const std::string number = "frame_00000" + std::to_string(i);
        EXPECT_EQ(pixels("saved/" + number + ".png"), pixels("frames/" + number + ".pgm"));
    }
    EXPECT_EQ(run("calibrate saved"), 0) << errors_;
    EXPECT_THAT(output_, HasSubstr("5 of 5 located"));

    const std::string first = file("saved/frame_000000.png");
    std::ofstream(directory_ / "saved/frame_000006.txt") << "somebody else's";
    ASSERT_EQ(watch("--save saved"), 0) << errors_;
    EXPECT_EQ(saved().size(), std::size_t{2 * kPlaces + 1});
    EXPECT_EQ(saved().back(), "frame_000011.png");
    EXPECT_EQ(file("saved/frame_000000.png"), first);
}

TEST_F(WatchSave, EveryNthFrame) {
    ASSERT_EQ(watch("--save saved --save-every 5"), 0) << errors_;
    EXPECT_THAT(saved(),
                testing::ElementsAre("frame_000000.png", "frame_000001.png", "frame_000002.png"));
    EXPECT_EQ(pixels("saved/frame_000001.png"), pixels("frames/frame_000001.pgm"));
    EXPECT_EQ(watch("--save-every 5"), 2);
    EXPECT_THAT(errors_, HasSubstr("--save DIR"));
}

TEST_F(WatchSave, FramesAreSavedAsTheyCame) {
    ASSERT_EQ(watch("--save saved --save-every 99 --inverted"), 0) << errors_;
    EXPECT_EQ(pixels("saved/frame_000000.png"), pixels("frames/frame_000000.pgm"));
}

TEST_F(WatchSave, AFolderThatCannotBeMadeIsNamed) {
    EXPECT_EQ(watch("--save no/such/folder"), 1);
    EXPECT_THAT(errors_, HasSubstr("cannot create the folder no/such/folder"));
    std::ofstream(directory_ / "saved") << "a file";
    EXPECT_EQ(watch("--save saved"), 1);
    EXPECT_THAT(errors_, HasSubstr("cannot create the folder saved"));
}

class WatchHint : public WatchSave {};

TEST_F(WatchHint, AtTheEndOfAShortRun) {
    ASSERT_EQ(watch(""), 0);
    EXPECT_THAT(errors_, Not(HasSubstr("not located")));
    // Almost black frames with noise, like those of a camera in the dark.
    std::string frames = file("slow.raw");
    for (std::uint32_t i = 0; i < frames.size(); ++i) {
        const std::uint32_t noise = (i * 2654435761U >> 20) % 4;
        frames[i] = static_cast<char>(static_cast<unsigned char>(frames[i]) / 64 + noise);
    }
    std::ofstream(directory_ / "dark.raw", std::ios::binary) << frames;
    ASSERT_EQ(run("watch - --size 188x120 --fps 30 --no-window", "dark.raw"), 0);
    EXPECT_THAT(errors_, HasSubstr("15 of 15 frames were not located; "));
    EXPECT_THAT(errors_, HasSubstr("the picture is too dark"));
}

TEST_F(WatchHint, NamesCompression) {
    const auto encode = [this](const std::string& options) {
        ASSERT_EQ(shell("ffmpeg -v error -y -framerate 30 -i frames/frame_%06d.pgm -c:v libx264 " +
                        options + " video.mp4"),
                  0)
            << errors_;
    };
    encode("-crf 45");
    ASSERT_EQ(run("watch video.mp4 --no-window"), 0);
    EXPECT_THAT(errors_, HasSubstr("the video is compressed too much, to 0.0"));
    ASSERT_EQ(run("locate video.mp4"), 0);
    EXPECT_THAT(output_, HasSubstr("the video is compressed too much, to 0.0"));
    encode("-crf 28");
    ASSERT_EQ(run("locate video.mp4"), 0);
    EXPECT_THAT(output_, Not(HasSubstr("compressed")));
    EXPECT_THAT(errors_, IsEmpty());
}

TEST_F(WatchSave, OtherFormatsAreForFastCameras) {
    ASSERT_EQ(watch("--save saved --save-every 5 --image-format pgm"), 0) << errors_;
    EXPECT_EQ(pixels("saved/frame_000001.pgm"), pixels("frames/frame_000001.pgm"));
    ASSERT_EQ(watch("--save saved --save-every 5 --image-format jpeg"), 0) << errors_;
    EXPECT_THAT(saved(), testing::Contains("frame_000005.jpg"));
    ASSERT_EQ(run("locate --code anoto saved"), 0);
    EXPECT_THAT(output_, Not(HasSubstr("no_grid")));
    EXPECT_EQ(watch("--mcap run.mcap --mcap-images --image-format pgm"), 2);
    EXPECT_THAT(errors_, HasSubstr("--image-format jpeg"));
    ASSERT_EQ(watch("--mcap run.mcap --mcap-images --image-format jpeg"), 0) << errors_;
    EXPECT_THAT(file("run.mcap"), HasSubstr("\xff\xd8\xff"));
}

TEST_F(WatchSave, RecordedFramesAreTakenInTheirOwnTime) {
    using namespace std::chrono;
    const auto begun = steady_clock::now();
    ASSERT_EQ(watch("--realtime"), 0) << errors_;
    // The last of 15 frames at 30 frames per second is due after 14 periods.
    EXPECT_GE(steady_clock::now() - begun, milliseconds(14 * 1000 / 30));
}

}  // namespace
}  // namespace dotpose::test
