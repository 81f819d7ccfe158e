// Tests the element through GStreamer's command-line tools and through its Python bindings.
#include <cstdlib>
#include <fstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "blackbox/watch_command.hpp"
#include "pipeline.hpp"

namespace dotpose::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// Skips a test if a program or the `rawvideoparse` element is missing.
#define DOTPOSE_NEEDS(program)                                             \
    if (run_shell("command -v " program " 2>&1").exit_code != 0 ||         \
        !has_element("rawvideoparse")) {                                   \
        GTEST_SKIP() << "without " program " or GStreamer's plugins-base"; \
    }

class GstreamerTools : public WatchCommand {
  protected:
    using ToolCommand::shell;
    static void SetUpTestSuite() { start_gstreamer(); }

    /// Runs gst-launch-1.0 on the frames of drive.raw and returns the exit code.
    int launch(const std::string& options, const std::string& properties) {
        return shell("timeout 60 gst-launch-1.0 " + options +
                     " filesrc location=drive.raw ! rawvideoparse format=gray8 width=320 "
                     "height=240 framerate=200/1 ! dotposelocate " +
                     properties + " ! fakesink");
    }
};

TEST_F(GstreamerTools, InspectShowsTheElement) {
    DOTPOSE_NEEDS("gst-inspect-1.0");
    ASSERT_EQ(shell("gst-inspect-1.0 dotposelocate"), 0) << errors_;
    EXPECT_EQ(errors_, "");
    EXPECT_THAT(output_, AllOf(HasSubstr("{ (string)GRAY8, (string)I420, (string)NV12 }"),
                               HasSubstr("Filter/Analyzer/Video"), HasSubstr("microdots")));
    for (const char* name : {"sheets", "camera", "code", "spacing-mm", "inverted", "track",
                             "max-speed-mm-s", "acceleration-mm-s2", "lost-after-ms", "max-p-wrong",
                             "post-messages", "attach-meta", "overlay"})
        EXPECT_THAT(output_, HasSubstr(std::string("\n  ") + name + ' '));
}

TEST_F(GstreamerTools, LaunchShowsMessages) {
    DOTPOSE_NEEDS("gst-launch-1.0");
    put_raw(3);
    ASSERT_EQ(launch("-m", "sheets=sheets.json"), 0) << errors_;
    std::size_t messages = 0;
    for (std::size_t at = 0; (at = output_.find("(element): dotpose, ", at)) != std::string::npos;
         ++at)
        ++messages;
    EXPECT_EQ(messages, 3U);
    EXPECT_THAT(output_,
                AllOf(HasSubstr("timestamp=(guint64)10000000"), HasSubstr("status=(string)ok"),
                      HasSubstr("sheet=(string)left"), HasSubstr("plane=(string)world")));
}

TEST_F(GstreamerTools, BadFilesAreErrorsOfTheElement) {
    if (!has_element("rawvideoparse")) GTEST_SKIP() << "without GStreamer's plugins-base";
    put_raw(3);
    std::ofstream(directory_ / "empty.json")
        << R"({"format":"dotpose-sheets","version":1,"sheets":[]})";
    std::ofstream(directory_ / "large.yaml") << kLargeCamera;
    const auto path = [this](const char* name) { return (directory_ / name).string(); };
    const auto error_of = [&path](const std::string& properties) {
        return run_pipeline("filesrc location=" + path("drive.raw") +
                            " ! rawvideoparse format=gray8 width=320 height=240 ! dotposelocate " +
                            properties)
            .error;
    };
    EXPECT_THAT(error_of("sheets=" + path("none.json")),
                HasSubstr("cannot read " + path("none.json") + ": no such file"));
    EXPECT_THAT(error_of("sheets=" + path("drive.raw")), HasSubstr("drive.raw"));
    EXPECT_THAT(error_of("sheets=" + path("empty.json")), HasSubstr("empty.json has no sheets"));
    EXPECT_THAT(error_of("camera=" + path("none.yaml")),
                HasSubstr("cannot read " + path("none.yaml")));
    EXPECT_THAT(error_of("camera=" + path("large.yaml")),
                HasSubstr("the camera file is for images of 640 x 480"));
    EXPECT_THAT(error_of("code=other"), HasSubstr("\"code\""));
    EXPECT_EQ(error_of(""), "");
}

TEST_F(GstreamerTools, ExampleInPythonReadsMessagesAndMeta) {
    if (!has_element("rawvideoparse")) GTEST_SKIP() << "without GStreamer's plugins-base";
    if (run_shell("/usr/bin/python3 -c 'import gi; gi.require_version(\"Gst\", \"1.0\")' 2>&1")
            .exit_code != 0) {
        GTEST_SKIP() << "without python3-gi";
    }
    put_raw(3);
    ASSERT_EQ(shell("/usr/bin/python3 '" DOTPOSE_EXAMPLES "/read_poses.py' 'filesrc "
                    "location=drive.raw ! rawvideoparse format=gray8 width=320 height=240 "
                    "framerate=200/1'"),
              0)
        << errors_;
    const std::string lines = output_;
    ASSERT_EQ(run(std::string("watch - ") + kRaw, "drive.raw"), 0);
    const json line = parsed(output_)[1];
    EXPECT_THAT(lines, HasSubstr("frame 5000000 ok 1\n"));
    EXPECT_THAT(lines,
                HasSubstr("message x " + std::to_string(line["x_mm"].get<double>()).substr(0, 8)));
}

}  // namespace
}  // namespace dotpose::test
