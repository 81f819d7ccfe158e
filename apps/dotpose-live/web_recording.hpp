/// Recordings that are started and stopped in the page of `dotpose watch --web`: a CSV log and an
/// MCAP file each.
#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "capture/frame_source.hpp"
#include "lines.hpp"
#include "reading.hpp"
#include "robot_output.hpp"

namespace dotpose::cli {

class WebRecordings {
  public:
    /// `messages` describes the robot; the MCAP file and the DDS publisher in it are ignored.
    /// `empty` is a record without a fix that has the fields of the run.
    WebRecordings(std::filesystem::path folder, RobotOutputOptions messages, Record empty);

    /// Starts a recording, unless one is running. Creates new files, named after the robot and the
    /// time. If they cannot be written, `notice` contains the reason.
    void start();

    /// Records a frame. Stops if a file cannot be written or if the disk is almost full.
    void take(const capture::Frame& frame, const Reading& reading);

    /// Completes the files of a running recording.
    void stop();

    /// Sets the camera of the next recording.
    void set_camera(const Camera& camera) { messages_.camera = camera; }

    bool is_running() const { return running_.has_value(); }
    /// Returns the name of the newest recording, without file extensions; empty if there is none.
    const std::string& name() const { return name_; }
    /// Returns the number of frames of the newest recording.
    std::int64_t frames() const { return frames_; }
    /// Returns a message for the user, or an empty string.
    const std::string& notice() const { return notice_; }
    /// Returns the names of all completed files, oldest first.
    const std::vector<std::string>& files() const { return files_; }
    std::filesystem::path path_of(const std::string& file) const { return folder_ / file; }

  private:
    struct Running {
        Running(const std::string& path, const RobotOutputOptions& options)
            : log(path), messages(options) {}

        Lines log;
        RobotOutput messages;
    };

    bool is_disk_full();

    std::filesystem::path folder_;
    RobotOutputOptions messages_;
    Record empty_;
    std::optional<Running> running_;
    std::string name_;
    std::int64_t frames_ = 0;
    std::string notice_;
    std::vector<std::string> files_;
    std::chrono::steady_clock::time_point space_checked_at_;
};

}  // namespace dotpose::cli
