// Simulates a drive over two sheets, and sends its frames through the element in all supported
// formats. The poses must equal those of `dotpose watch`, no frame may be lost, and timestamps and
// pixels must not change.
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "blackbox/watch_command.hpp"
#include "lines.hpp"
#include "pipeline.hpp"

namespace dotpose::test {
namespace {

/// Skips a test if the element that parses raw video is not installed.
#define DOTPOSE_NEEDS_PARSER() \
    if (!has_element("rawvideoparse")) GTEST_SKIP() << "without GStreamer's plugins-base"

class GstreamerDrive : public WatchCommand {
  protected:
    static void SetUpTestSuite() { start_gstreamer(); }

    /// Copies the frames of drive.raw to colours.raw, and appends neutral chroma planes to each
    /// frame.
    void put_colours() {
        const std::string grey = file("drive.raw");
        const std::size_t size = std::size_t{kWidth} * kHeight;
        std::ofstream stream(directory_ / "colours.raw", std::ios::binary);
        for (std::size_t at = 0; at < grey.size(); at += size)
            stream << grey.substr(at, size) << std::string(size / 2, '\x80');
    }

    /// Runs a pipeline that reads raw frames in `format` from a file, at a frame rate of 200 per
    /// second, and passes them through the element.
    Outcome run_element(const std::string& frames, const std::string& format,
                        const std::string& properties) {
        return run_pipeline("filesrc location=" + (directory_ / frames).string() +
                            " ! rawvideoparse framerate=200/1 height=240 " + format +
                            " ! dotposelocate " + properties);
    }
    std::string sheets() const {
        return "sheets=" + (directory_ / "sheets.json").string() + " max-speed-mm-s=400 ";
    }
    std::vector<json> watch(const std::string& options) {
        EXPECT_EQ(run(std::string("watch - ") + kRaw + " " + options, "drive.raw"), 0) << errors_;
        return parsed(output_);
    }
};

/// Expects that the messages, metas and times of all frames agree with the lines that
/// `dotpose watch` writes.
void expect_lines(const std::vector<json>& lines, const Outcome& outcome) {
    ASSERT_EQ(outcome.error, "");
    ASSERT_EQ(outcome.messages.size(), lines.size());
    ASSERT_EQ(outcome.frames.size(), lines.size());
    for (std::size_t i = 0; i < lines.size(); ++i) {
        expect_told(lines[i], outcome.messages[i]);
        EXPECT_EQ(outcome.messages[i]["frame"], i);
        EXPECT_EQ(outcome.messages[i], outcome.frames[i].meta);
        constexpr GstClockTime kInterval = 5 * GST_MSECOND;
        EXPECT_EQ(outcome.frames[i].pts, i * kInterval);
        EXPECT_EQ(outcome.frames[i].duration, kInterval);
        EXPECT_EQ(outcome.messages[i]["timestamp"], i * kInterval);
        EXPECT_EQ(outcome.messages[i]["running-time"], i * kInterval);
        if (testing::Test::HasFailure()) return;
    }
}

void expect_bytes(const std::string& bytes, const Outcome& outcome) {
    std::size_t at = 0;
    for (const Arrived& frame : outcome.frames) {
        ASSERT_TRUE(bytes.compare(at, frame.bytes.size(), frame.bytes) == 0);
        at += frame.bytes.size();
    }
    EXPECT_EQ(at, bytes.size());
}

TEST_F(GstreamerDrive, HasThePosesOfTheLines) {
    DOTPOSE_NEEDS_PARSER();
    put_raw(drive_.frames());
    put_colours();
    const auto lines = watch(kTrack);
    ASSERT_EQ(lines.size(), static_cast<std::size_t>(drive_.frames()));
    for (const std::string format : {"gray8", "i420", "nv12"}) {
        SCOPED_TRACE(format);
        const std::string frames = format == "gray8" ? "drive.raw" : "colours.raw";
        const Outcome outcome = run_element(frames, "width=320 format=" + format, sheets());
        expect_lines(lines, outcome);
        expect_bytes(file(frames), outcome);
    }
}

TEST_F(GstreamerDrive, RowsMayLieApart) {
    DOTPOSE_NEEDS_PARSER();
    put_raw(40);
    put_colours();
    const auto lines = watch(std::string(kTrack) + " --roi 0,0,300x240");
    const Outcome grey = run_element(
        "drive.raw", "format=gray8 width=300 frame-size=76800 plane-strides=<320>", sheets());
    expect_lines(lines, grey);
    const Outcome nv12 = run_element(
        "colours.raw",
        "format=nv12 width=300 frame-size=115200 plane-strides=<320,320> plane-offsets=<0,76800>",
        sheets());
    expect_lines(lines, nv12);
}

TEST_F(GstreamerDrive, WithoutSheetsTheCodeIsFoundOut) {
    DOTPOSE_NEEDS_PARSER();
    put_raw(20);
    const std::string format = "format=gray8 width=320";
    expect_lines(watch(""), run_element("drive.raw", format, ""));
    expect_lines(watch("--code anoto --spacing 0.5"),
                 run_element("drive.raw", format, "code=anoto spacing-mm=0.5"));
    // The sheets are not printed in the `microdots` code, so no frame has a fix. The messages must
    // report the same failures as `watch`.
    expect_lines(watch("--code microdots"), run_element("drive.raw", format, "code=microdots"));
}

TEST_F(GstreamerDrive, CamerasHaveTheirFile) {
    DOTPOSE_NEEDS_PARSER();
    put_raw(20);
    std::ofstream(directory_ / "camera.yaml")
        << "{format: dotpose-camera, version: 1, width_px: 320, height_px: 240, k_per_px2: 0, "
           "centre_px: [159.5, 119.5], mm_per_px: [0.0458, 0.0458], reference_px: [59.5, 119.5]}";
    expect_lines(watch(std::string(kTrack) + " --camera camera.yaml"),
                 run_element("drive.raw", "format=gray8 width=320",
                             sheets() + "camera=" + (directory_ / "camera.yaml").string()));
}

TEST_F(GstreamerDrive, TunesTheTracker) {
    DOTPOSE_NEEDS_PARSER();
    put_raw(80, 380);
    expect_lines(watch("--sheets sheets.json --max-speed 500 --acceleration 900 --lost-after 30 "
                       "--max-p-wrong 1e-6"),
                 run_element("drive.raw", "format=gray8 width=320",
                             sheets() + "max-speed-mm-s=500 acceleration-mm-s2=900 "
                                        "lost-after-ms=30 max-p-wrong=1e-6"));
}

TEST_F(GstreamerDrive, EachFrameByItselfIsWhatLocateTells) {
    DOTPOSE_NEEDS_PARSER();
    put_raw(20);
    ASSERT_EQ(run("locate - --size 320x240 --sheets sheets.json", "drive.raw"), 0) << errors_;
    expect_lines(parsed(output_),
                 run_element("drive.raw", "format=gray8 width=320", sheets() + "track=false"));
}

TEST_F(GstreamerDrive, TakesWhiteDotsOnBlack) {
    DOTPOSE_NEEDS_PARSER();
    put_raw(10);
    std::string frames = file("drive.raw");
    for (char& grey : frames)
        grey = static_cast<char>(~grey);
    std::ofstream(directory_ / "drive.raw", std::ios::binary) << frames;
    const auto lines = watch(std::string(kTrack) + " --inverted");
    EXPECT_EQ(lines[9]["status"], "ok");
    const Outcome outcome =
        run_element("drive.raw", "format=gray8 width=320", sheets() + "inverted=true");
    expect_lines(lines, outcome);
    expect_bytes(frames, outcome);
}

TEST_F(GstreamerDrive, OverlayIsDrawnOnTheLumaAlone) {
    DOTPOSE_NEEDS_PARSER();
    put_raw(30);
    put_colours();
    const auto lines = watch(kTrack);
    const std::string frames = file("colours.raw");
    const Outcome outcome =
        run_element("colours.raw", "format=i420 width=320", sheets() + "overlay=true");
    expect_lines(lines, outcome);
    constexpr std::size_t kLuma = std::size_t{kWidth} * kHeight;
    for (std::size_t i = 0; i < outcome.frames.size(); ++i) {
        const std::string& drawn = outcome.frames[i].bytes;
        const std::string before = frames.substr(i * kLuma * 3 / 2, kLuma * 3 / 2);
        EXPECT_TRUE(drawn.substr(kLuma) == before.substr(kLuma));
        // The rings around 600 dots cover about 12,000 pixels. Many of these pixels are already
        // dark and do not change.
        std::size_t changed = 0;
        for (std::size_t at = 0; at < kLuma; ++at)
            changed += drawn[at] != before[at] ? 1 : 0;
        EXPECT_GT(changed, kLuma / 20);
        EXPECT_LT(changed, kLuma / 2);
    }
}

TEST_F(GstreamerDrive, TellsOnlyWhatIsWanted) {
    DOTPOSE_NEEDS_PARSER();
    put_raw(3);
    const std::string format = "format=gray8 width=320";
    const Outcome silent = run_element("drive.raw", format, "post-messages=false");
    EXPECT_TRUE(silent.messages.empty());
    ASSERT_EQ(silent.frames.size(), 3U);
    EXPECT_EQ(silent.frames[0].meta["status"], "ok");
    const Outcome bare = run_element("drive.raw", format, "attach-meta=false");
    EXPECT_EQ(bare.messages.size(), 3U);
    EXPECT_TRUE(bare.frames[0].meta.is_null());
}

TEST_F(GstreamerDrive, MetaStaysWithConvertedFrames) {
    DOTPOSE_NEEDS_PARSER();
    if (!has_element("videoscale") || !has_element("videoconvert")) GTEST_SKIP();
    put_raw(3);
    const Outcome outcome =
        run_element("drive.raw", "format=gray8 width=320",
                    "! videoscale ! videoconvert ! video/x-raw,format=RGB,width=160,height=120");
    ASSERT_EQ(outcome.error, "");
    ASSERT_EQ(outcome.frames.size(), 3U);
    EXPECT_EQ(outcome.frames[2].bytes.size(), 160U * 120 * 3);
    EXPECT_EQ(outcome.frames[2].meta, outcome.messages[2]);
}

}  // namespace
}  // namespace dotpose::test
