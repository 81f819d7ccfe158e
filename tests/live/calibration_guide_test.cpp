// Tests CalibrationGuide with commands and sheet files that arrive while it computes a result.
#include "calibration_guide.hpp"

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "../drive.hpp"
#include "../temporary_directory.hpp"

namespace dotpose::cli {
namespace {

using namespace std::chrono_literals;

/// Waits until the state of a guide satisfies a condition.
testing::AssertionResult reaches(const CalibrationGuide& guide,
                                 const std::function<bool(const GuideState&)>& condition) {
    const auto end = std::chrono::steady_clock::now() + 60s;
    while (std::chrono::steady_clock::now() < end) {
        if (condition(guide.state())) return testing::AssertionSuccess();
        std::this_thread::sleep_for(1ms);
    }
    return testing::AssertionFailure() << name(guide.state().phase) << guide.state().problem;
}

std::function<bool(const GuideState&)> is_in(GuidePhase phase) {
    return [phase](const GuideState& state) { return state.phase == phase; };
}

/// Returns the sheet that the frames show, with the given print scale.
std::vector<SheetEntry> sheets_with_scale(double print_scale) {
    std::vector<SheetEntry> sheets = {test::drive_sheets().front()};
    sheets[0].print_scale_x = sheets[0].print_scale_y = print_scale;
    return sheets;
}

/// Returns frames taken by a mounted camera at different positions on the sheet.
std::vector<capture::Frame> frames_of_sheet() {
    const Sheet sheet = test::drive_sheets().front().sheet;
    std::vector<capture::Frame> frames;
    for (std::uint32_t i = 0; i < 5; ++i) {
        CameraPose pose;
        pose.cell = {sheet.origin.x + 100 + 40 * i, sheet.origin.y + 100 + 30 * (i % 3)};
        pose.theta_rad = 1.3 * i;
        capture::Frame& frame = frames.emplace_back();
        frame.image =
            render(page_of(sheet), CameraModel{}, pose, test::DriveCamera::nominal(), 1 + i);
        frame.index = i;
        // Frames from files are treated as frames from a camera at rest.
        frame.file = std::to_string(i);
    }
    return frames;
}

/// Starts the `lens` step, and offers each frame to the guide until the guide accepts it.
void collect(CalibrationGuide& guide, const std::vector<capture::Frame>& frames) {
    // The guide ignores a command while eight other commands are pending. `collect` therefore first
    // waits until all earlier commands have been executed.
    ASSERT_TRUE(reaches(guide, [&](const GuideState& state) {
        guide.cancel();
        return state.phase == GuidePhase::idle;
    }));
    guide.start(GuideStep::lens);
    ASSERT_TRUE(reaches(guide, [](const GuideState& state) {
        return state.phase == GuidePhase::collecting && state.frames == 0;
    }));
    for (std::size_t i = 0; i < frames.size(); ++i) {
        ASSERT_TRUE(reaches(guide, [&](const GuideState& state) {
            guide.take(frames[i], Reading{}, frames[i].image.view(), 0);
            return state.frames > static_cast<int>(i);
        }));
    }
}

TEST(CalibrationGuide, TakesNewSheetsWhileCommandsWait) {
    const test::TemporaryDirectory folder;
    GuideOptions options;
    options.file = (folder.path() / "camera.yaml").string();
    options.calibrate.sheets = sheets_with_scale(1);
    CalibrationGuide guide(options);
    const std::vector<capture::Frame> frames = frames_of_sheet();
    ASSERT_NO_FATAL_FAILURE(collect(guide, frames));
    guide.finish();
    ASSERT_TRUE(reaches(guide, is_in(GuidePhase::solving)));
    // The guide queues up to eight commands and ignores further ones.
    for (int i = 0; i < 8; ++i)
        guide.save();
    guide.set_sheets(sheets_with_scale(1.02));
    ASSERT_EQ(guide.state().phase, GuidePhase::solving) << "the commands did not wait";
    ASSERT_TRUE(reaches(guide, is_in(GuidePhase::saved)));
    const std::optional<Camera> first = guide.take_camera();
    ASSERT_TRUE(first && first->paper);
    EXPECT_NEAR(first->paper->mm_per_px_x, CameraModel{}.mm_per_px, 1e-4);

    ASSERT_NO_FATAL_FAILURE(collect(guide, frames));
    guide.finish();
    ASSERT_TRUE(reaches(guide, is_in(GuidePhase::solved)));
    const Camera second = guide.state().result->camera;
    ASSERT_TRUE(second.paper);
    EXPECT_NEAR(second.paper->mm_per_px_x, 1.02 * first->paper->mm_per_px_x, 1e-6);
}

/// A guide in the `readout` step, and a camera that moves by 2 spacings from frame to frame.
class FastDrive {
  public:
    explicit FastDrive(const test::TemporaryDirectory& folder) : guide_(options_in(folder)) {
        frame_.image = {std::vector<std::uint8_t>(8, 200), 4, 2};
        guide_.start(GuideStep::readout);
        EXPECT_TRUE(reaches(guide_, is_in(GuidePhase::collecting)));
    }

    void take(Status status) {
        Reading reading;
        reading.record.fix.status = status;
        reading.record.fix.cell = {100 + 2 * static_cast<std::uint32_t>(frame_.index), 100};
        guide_.take(frame_, reading, frame_.image.view(), 0);
        ++frame_.index;
        frame_.time_us += 20'000;
    }

    CalibrationGuide& guide() { return guide_; }

  private:
    static GuideOptions options_in(const test::TemporaryDirectory& folder) {
        GuideOptions options;
        options.file = (folder.path() / "camera.yaml").string();
        options.camera.emplace().paper.emplace();
        return options;
    }

    CalibrationGuide guide_;
    capture::Frame frame_;
};

TEST(CalibrationGuide, AFastDriveOffTheSheetEndsTheStep) {
    const test::TemporaryDirectory folder;
    FastDrive drive(folder);
    for (int i = 0; i < 20; ++i)
        drive.take(Status::ok);
    EXPECT_EQ(drive.guide().state().frames, 20);
    drive.take(Status::too_few_dots);
    // The frame images show no dots, so there is no result.
    EXPECT_TRUE(reaches(drive.guide(), is_in(GuidePhase::failed)));
}

TEST(CalibrationGuide, SaysThatTheFramesCannotBeLocated) {
    const test::TemporaryDirectory folder;
    FastDrive drive(folder);
    for (int i = 0; i < 5; ++i)
        drive.take(Status::ok);
    drive.take(Status::too_few_dots);
    EXPECT_EQ(drive.guide().state().frames, 0);
    EXPECT_EQ(drive.guide().state().advice, "go on at this speed");
    for (int i = 0; i < 10; ++i)
        drive.take(Status::too_few_dots);
    EXPECT_EQ(drive.guide().state().advice,
              "these frames cannot be located: keep the camera over the dots");
    drive.take(Status::ok);
    EXPECT_NE(drive.guide().state().advice,
              "these frames cannot be located: keep the camera over the dots");
}

}  // namespace
}  // namespace dotpose::cli
