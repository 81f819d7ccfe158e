/// Recordings that the user starts and stops on the web page of `dotpose watch --web`. Each
/// recording consists of a CSV log and an MCAP file.
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
    /// `messages` describes the robot. Its members `mcap` and `dds` are ignored. The columns of the
    /// log are the fields of `empty`, which is a record without a fix.
    WebRecordings(std::filesystem::path folder, RobotOutputOptions messages, Record empty);

    /// Starts a recording unless one is already running. Creates new files, which are named after
    /// the robot and the time. If they cannot be created, `notice` returns the reason.
    void start();

    /// Records a frame. Stops the recording if a file cannot be written or the disk is almost full.
    void take(const capture::Frame& frame, const Reading& reading);

    /// Stops a running recording and finishes its files.
    void stop();

    /// Sets the camera for later recordings.
    void set_camera(const Camera& camera) { messages_.camera = camera; }

    bool is_running() const { return running_.has_value(); }
    /// Returns the name of the newest recording without file extension, or an empty string if there
    /// is none.
    const std::string& name() const { return name_; }
    /// Returns the number of frames in the newest recording.
    std::int64_t frames() const { return frames_; }
    /// Returns a message for the user, or an empty string if there is none.
    const std::string& notice() const { return notice_; }
    /// Returns the names of all finished files, oldest first.
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
