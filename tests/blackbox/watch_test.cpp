// Tests `dotpose watch` on a simulated drive: events, accuracy and outputs.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "../drive_errors.hpp"
#include "dotpose/pose_packet.hpp"
#include "dotpose/tools/image_file.hpp"
#include "watch_command.hpp"

namespace dotpose::test {
namespace {

using testing::HasSubstr;

using Watch = WatchCommand;

DriveReading reading_of(const json& line) {
    DriveReading reading;
    reading.has_fix = line["status"] == "ok";
    reading.events = line.value("events", "");
    reading.is_accepted = line["state"] != "lost" && line["verdict"] == "accepted";
    if (reading.has_fix) {
        reading.raw = {line["x_m"].get<double>() * 1000, line["y_m"].get<double>() * 1000,
                       line["yaw_rad"]};
    }
    if (reading.is_accepted) {
        constexpr double kRadians = std::numbers::pi / 180;
        reading.filtered = {line["track_x_mm"], line["track_y_mm"],
                            line["track_theta_deg"].get<double>() * kRadians};
        reading.vx_mm_s = line["vx_mm_s"];
        reading.vy_mm_s = line["vy_mm_s"];
        reading.turn_rad_s = line["turn_deg_s"].get<double>() * kRadians;
    }
    return reading;
}

DriveErrors errors_of(const std::vector<json>& lines, const Drive& drive, int first = 0) {
    DriveErrors errors;
    for (const json& line : lines) {
        // Identifies the frame by its timestamp, because frames may be missing from a damaged
        // video.
        const int frame = static_cast<int>(std::lround(line["t_s"].get<double>() * kDriveFps));
        errors.add(drive.at(first + frame), reading_of(line));
    }
    return errors;
}

int frame_at(double seconds) {
    return static_cast<int>(std::lround(seconds * kDriveFps));
}

/// Returns the first frame in which x or y differs by more than 0.1 mm from the position at frame
/// `place`. Searches from frame `from` in steps of `step`, which is 1 or -1.
int first_away(const Drive& drive, int from, int step, int place) {
    const DriveState rest = drive.at(place);
    int frame = from;
    while (std::abs(drive.at(frame).x_mm - rest.x_mm) <= 0.1 &&
           std::abs(drive.at(frame).y_mm - rest.y_mm) <= 0.1) {
        frame += step;
    }
    return frame;
}

void expect_events(const std::vector<json>& lines, const Drive& drive) {
    std::vector<std::pair<int, std::string>> events;
    for (const json& line : lines) {
        if (line.contains("events")) events.emplace_back(line["frame"], line["events"]);
    }
    const DrivePlan& plan = drive.plan();
    const std::vector<std::string> names = {"fix",           "stationary", "moving", "lost",
                                            "fix kidnapped", "lost",       "fix",    "stationary"};
    ASSERT_EQ(events.size(), names.size());
    for (std::size_t i = 0; i < names.size(); ++i)
        EXPECT_EQ(events[i].second, names[i]) << i;
    EXPECT_EQ(events[0].first, 0);
    EXPECT_EQ(events[1].first, frame_at(0.5));
    EXPECT_NEAR(events[2].first, first_away(drive, frame_at(plan.start), 1, 0), 1);
    // The tracker reports `lost` 70 ms (14 frames) after the last frame that shows a sheet.
    EXPECT_EQ(events[3].first, frame_at(plan.lift) - 1 + 14);
    // At `put_down`, the robot is put down at a place that it cannot have reached at 400 mm/s. The
    // tracker reports `kidnapped` in the third frame that shows a sheet again.
    EXPECT_EQ(events[4].first, frame_at(plan.put_down) + 2);
    EXPECT_EQ(events[5].first, frame_at(plan.second_lift) - 1 + 14);
    EXPECT_EQ(events[6].first, frame_at(plan.second_put_down));
    const int arrival = first_away(drive, drive.frames() - 1, -1, drive.frames() - 1) + 1;
    EXPECT_NEAR(events[7].first, arrival + frame_at(0.5), 10);
}

void expect_accurate(const std::vector<json>& lines, const Drive& drive) {
    const DriveErrors errors = errors_of(lines, drive);
    const int lifted = frame_at(0.3) + frame_at(0.15);
    EXPECT_EQ(errors.wrong(), 0);
    EXPECT_GE(errors.fixes(), drive.frames() - lifted - 2);
    // Most of the position error comes from the print. The filter cannot reduce this error, but
    // must not increase it.
    EXPECT_LT(errors.filtered_um(), 1.01 * errors.raw_um());
    EXPECT_LT(errors.velocity_mm_s(), 0.3);
    EXPECT_LT(errors.turn_deg_s(), 1);
}

/// Expects the heading error of each frame near the seam to be less than five reported standard
/// deviations.
void expect_accurate_at_seam(const std::vector<json>& lines, const Drive& drive) {
    int frames = 0;
    for (const json& line : lines) {
        const DriveState truth = drive.at(line["frame"]);
        if (truth.is_lifted || std::abs(truth.x_mm - kSeam_mm) > 10) continue;
        ++frames;
        if (line["status"] != "ok") continue;
        const DrivePose off = DriveErrors::difference(reading_of(line).raw, truth);
        EXPECT_LT(std::abs(off.yaw_rad) * 180 / std::numbers::pi,
                  5 * line["sigma_theta_deg"].get<double>())
            << line;
    }
    EXPECT_GT(frames, 10);
}

// A single test checks all properties, because rendering and locating the drive takes seconds.
TEST_F(Watch, FollowsADrive) {
    put_video(drive_.frames(), "drive.avi");
    ASSERT_EQ(run(std::string("watch drive.avi ") + kTrack), 0);
    const std::string from_file = output_;
    const auto lines = parsed(from_file);
    ASSERT_EQ(lines.size(), static_cast<std::size_t>(drive_.frames()));
    EXPECT_THAT(errors_, HasSubstr("2 times lost, 1 times kidnapped, 0 frames dropped"));
    expect_events(lines, drive_);
    expect_accurate(lines, drive_);
    expect_accurate_at_seam(lines, drive_);

    shell("ffmpeg -v error -i drive.avi -f rawvideo -pix_fmt gray - | '" + test::tool_path() +
          "' watch - -o piped " + std::string(kRaw) + " " + kTrack + " 2>errors");
    EXPECT_TRUE(file("piped") == from_file);
}

TEST_F(Watch, WritesLogMapPacketsAndVideo) {
    put_video(61, "drive.avi");
    ASSERT_EQ(run(std::string("watch drive.avi --frames 60 --log run.csv --draw run.svg "
                              "--record run.mp4 --packets run.bin --format csv ") +
                  kTrack),
              0);
    EXPECT_EQ(file("run.csv"), output_);
    EXPECT_EQ(std::ranges::count(output_, '\n'), 61);
    EXPECT_THAT(file("run.svg"), HasSubstr("class=\"robot\""));
    EXPECT_THAT(file("run.svg"), HasSubstr(">left<"));
    EXPECT_EQ(run("replay run.csv"), 0);
    EXPECT_THAT(output_, HasSubstr("frames with a fix           60 (100.00 %)"));
    PacketReader reader;
    int packets = 0;
    for (const char byte : file("run.bin"))
        packets += reader.push(static_cast<std::uint8_t>(byte));
    EXPECT_EQ(packets, 60);
    EXPECT_EQ(reader.packet().sequence, 59);
    EXPECT_EQ(reader.packet().time_us, 295'000U);
    // The recording shows the frame (800 px wide) and, beside it, a panel (400 px wide).
    shell(
        "ffprobe -v error -count_frames -select_streams v -show_entries "
        "stream=codec_name,nb_read_frames,width -of csv=p=0 run.mp4 > probe");
    EXPECT_EQ(file("probe"), "h264,1200,60\n");
}

TEST_F(Watch, RecordsMotionJpegWhereTheNameAsksForIt) {
    put_video(5, "drive.avi");
    ASSERT_EQ(run(std::string("watch drive.avi --record run.avi ") + kTrack), 0) << errors_;
    shell(
        "ffprobe -v error -count_frames -select_streams v -show_entries "
        "stream=codec_name,nb_read_frames -of csv=p=0 run.avi > probe");
    EXPECT_EQ(file("probe"), "mjpeg,5\n");
    EXPECT_EQ(run(std::string("watch drive.avi --record run.notes ") + kTrack), 1);
    EXPECT_THAT(errors_, HasSubstr("cannot record to run.notes; try a name with .mp4"));
}

TEST_F(Watch, GoesThroughImages) {
    const DriveCamera camera(188, 120);
    for (int i = 0; i < 4; ++i)
        write_pgm(directory_ / ("b" + std::to_string(i) + ".pgm"), camera.frame(drive_, i).view());
    std::ofstream(directory_ / "b2.pgm") << "no image";
    ASSERT_EQ(run(std::string("watch 'b*.pgm' --fps 50 ") + kTrack), 0);
    const auto lines = parsed(output_);
    ASSERT_EQ(lines.size(), 3U);
    EXPECT_EQ(lines[2]["file"], "b3.pgm");
    EXPECT_EQ(lines[2]["frame"], 3);
    EXPECT_DOUBLE_EQ(lines[2]["t_s"], 0.06);
    EXPECT_EQ(lines[0]["sheet"], "left");
    // The first frame has no prediction. In all later frames, the dots are measured at their
    // predicted positions.
    EXPECT_EQ(lines[0]["attempt"], "first");
    for (std::size_t i = 1; i < lines.size(); ++i)
        EXPECT_EQ(lines[i]["attempt"], "tracked");
    EXPECT_THAT(errors_, HasSubstr("b2.pgm"));
    ASSERT_EQ(run(std::string("watch . --fps 50 ") + kTrack), 0);
    EXPECT_EQ(parsed(output_).size(), 3U);
}

/// Covers the whole frame except a window of `side` x `side` px in the middle.
void cover_all_but(GreyImage& image, int side) {
    for (int v = 0; v < image.height_px; ++v) {
        for (int u = 0; u < image.width_px; ++u) {
            const bool is_seen =
                std::abs(2 * u - image.width_px) < side && std::abs(2 * v - image.height_px) < side;
            if (!is_seen) image.pixels[static_cast<std::size_t>(v * image.width_px + u)] = 180;
        }
    }
}

TEST_F(Watch, BelievesWeakFramesThatThePriorSupports) {
    // In whole frames, p_wrong is below 1e-13. In frames with about 45 dots, p_wrong is above
    // 1e-13, even if the sheet is known.
    constexpr int kSide_px = 76;
    const DriveCamera camera(188, 120);
    std::ofstream raw(directory_ / "weak.raw", std::ios::binary);
    std::vector<bool> is_covered;
    for (int i = 300; i < 330; ++i) {
        GreyImage image = camera.frame(drive_, i);
        is_covered.push_back(i >= 310 && i % 2 == 1);
        if (is_covered.back()) cover_all_but(image, kSide_px);
        raw.write(reinterpret_cast<const char*>(image.pixels.data()),
                  static_cast<std::streamsize>(image.pixels.size()));
    }
    raw.close();
    ASSERT_EQ(run(std::string("watch - --size 188x120 --fps 200 --max-p-wrong 1e-13 ") + kTrack,
                  (directory_ / "weak.raw").string()),
              0);
    const auto lines = parsed(output_);
    ASSERT_EQ(lines.size(), is_covered.size());
    int with_prior = 0;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        if (lines[i]["status"] != "ok") continue;
        const DriveState truth = drive_.at(300 + static_cast<int>(i));
        EXPECT_NEAR(lines[i]["x_m"].get<double>() * 1000, truth.x_mm, 0.05);
        EXPECT_NEAR(lines[i]["y_m"].get<double>() * 1000, truth.y_mm, 0.05);
        EXPECT_LT(lines[i]["p_wrong"], 1e-13);
        with_prior += lines[i]["verdict"] == "with_prior";
        if (is_covered[i]) continue;
        EXPECT_EQ(lines[i]["verdict"], "accepted") << i;
    }
    EXPECT_GE(with_prior, 3);
    // If every frame shows only a small window, no fix is certain. The tracker then has no track,
    // and therefore no prior for the next frames.
    ASSERT_EQ(run(std::string("watch - --size 188x120 --fps 200 --max-p-wrong 1e-13 --roi "
                              "60,26,68x68 ") +
                      kTrack,
                  (directory_ / "weak.raw").string()),
              0);
    for (const json& line : parsed(output_))
        EXPECT_NE(line["verdict"], "with_prior");
}

// The robot drives at 250 mm/s. If a frame had the timestamp of the previous or next frame, its
// position error would exceed 1 mm.
TEST_F(Watch, KeepsTimesWhateverTheContainer) {
    constexpr int kFirst = 200;
    constexpr int kLength = 60;
    put_raw(kLength, kFirst);
    const auto watch = [&](const std::string& name) {
        exit_code_ = run("watch " + name + " " + kTrack);
        const auto lines = parsed(output_);
        const DriveErrors errors = errors_of(lines, drive_, kFirst);
        EXPECT_EQ(errors.wrong(), 0) << name;
        EXPECT_GE(errors.fixes(), static_cast<int>(lines.size()) - 1) << name;
        return lines.size();
    };
    // In H.264, the decoding order of frames differs from their display order.
    encode("-c:v libx264 -crf 12", "ordered.mp4");
    encode("-c:v libx264 -crf 12", "ordered.avi");
    EXPECT_EQ(watch("ordered.mp4"), std::size_t{kLength});
    EXPECT_EQ(watch("ordered.avi"), std::size_t{kLength});
    EXPECT_EQ(exit_code_, 0);

    encode("-c:v mjpeg -q:v 2", "whole.mp4");
    encode("-c:v mjpeg -q:v 2", "whole.mkv");
    encode("-c:v mjpeg -q:v 2", "whole.avi");
    for (const std::string name : {"hole.mp4", "hole.mkv", "hole.avi"}) {
        // Overwrites 2 % of the file with zeros, beginning in the middle. The index of AVI and MP4
        // files is at the end and remains intact.
        std::string video = file("whole" + name.substr(4));
        std::fill_n(video.begin() + static_cast<std::ptrdiff_t>(video.size() / 2),
                    video.size() / 50, '\0');
        std::ofstream(directory_ / name, std::ios::binary) << video;
        EXPECT_LT(watch(name), std::size_t{kLength});
        EXPECT_GT(parsed(output_).size(), std::size_t{kLength} * 8 / 10) << name;
        EXPECT_GT(parsed(output_).back()["t_s"], 0.29) << name;
        // A Matroska file does not contain the number of frames, so the tool cannot distinguish
        // damage from frames that were never recorded.
        const bool is_counted = name != "hole.mkv";
        EXPECT_EQ(exit_code_, is_counted ? 1 : 0);
        EXPECT_THAT(errors_,
                    HasSubstr(name + (is_counted ? " is damaged or cut short: "
                                                 : " has gaps, from damage or from its ")));
        EXPECT_THAT(errors_, HasSubstr(" of 60 frames were read\n"));
    }
    // Removes bytes from the middle of an AVI file. The offsets in its index are then wrong.
    std::string video = file("whole.avi");
    video.erase(video.size() / 2, video.size() / 50);
    std::ofstream(directory_ / "lacking.avi", std::ios::binary) << video;
    EXPECT_EQ(run(std::string("watch lacking.avi ") + kTrack), 1);
    EXPECT_THAT(
        errors_,
        HasSubstr("frames were read; times after the damage are counted from frame numbers\n"));
}

}  // namespace
}  // namespace dotpose::test
