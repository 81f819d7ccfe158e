/// Outputs of `dotpose watch`.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lines.hpp"
#include "mqtt_arguments.hpp"
#include "output_arguments.hpp"
#include "path_memory.hpp"
#include "reading.hpp"
#include "robot_output.hpp"
#include "state_output.hpp"
#include "video/screen.hpp"
#include "watch_tally.hpp"
#include "web_view.hpp"

namespace dotpose::cli {

struct OutputOptions {
    LineArguments lines;
    // An output with an empty path is not written.
    std::string log;              ///< path of a CSV file with one line per frame
    std::string map;              ///< path of an SVG drawing of the robot's path
    std::string packets;          ///< path of a file or device for pose packets
    RobotOutputOptions messages;  ///< ROS messages
    PublishArguments publish;     ///< the MQTT broker and the name of the robot
    std::string sheets;           ///< path of the sheet file
    video::ScreenOptions screen;
    std::optional<WebOptions> web;  ///< options of the web page, or nullopt to serve no web page
};

/// Writes pose packets to a file or serial device.
class PacketOutput {
  public:
    /// Opens the file or device. Throws Error on failure. `write` throws ReaderLeft if the output
    /// is a pipe and its reader has closed the pipe, and Error on any other failure.
    explicit PacketOutput(const std::string& path);
    ~PacketOutput();
    PacketOutput(const PacketOutput&) = delete;
    PacketOutput& operator=(const PacketOutput&) = delete;
    void write(const Reading& reading, CodeVariant code);

  private:
    std::string path_;
    int descriptor_;
};

class WatchOutputs {
  public:
    /// Throws Error if an output cannot be opened.
    WatchOutputs(const OutputOptions& options, const Follower& follower);

    /// Writes the outputs for a frame. Returns false if the user closed the window, or if no output
    /// is left because all pipes were closed by their readers. Throws Error if an output cannot be
    /// written.
    bool take(const capture::Frame& frame, const Reading& reading, const SourceState& source);

    /// Returns the camera that was calibrated on the web page since the previous call, or nullopt.
    std::optional<Camera> take_camera();

    /// Writes the map, finishes the recording and sends the last states. Throws Error on failure.
    void finish();

    /// Returns the sheets if the web page or another program has changed them since the previous
    /// call. Returns nullopt if the sheets have not changed or no web page is served.
    std::optional<std::vector<SheetEntry>> take_changed_sheets();
    /// Makes all outputs use the current sheets of the follower. `was_in_world` is true if poses
    /// were in world coordinates before the sheets changed. If poses have changed from sheet to
    /// world coordinates or back, starts a new path, because the earlier points are in a different
    /// plane.
    void use_sheets(bool was_in_world);

    const WatchTally& tally() const { return tally_; }
    /// Returns the mean number of frames per second of wall-clock time.
    double rate() const;

  private:
    bool show(const capture::Frame& frame, const Reading& reading, std::int64_t dropped);
    void write_line(const std::string& line);
    void write_packet(const Reading& reading);
    bool is_anything_left() const;
    void draw_path() const;

    OutputOptions options_;
    const Follower& follower_;
    std::vector<draw::MapSheet> sheets_;
    std::optional<Lines> lines_;
    std::optional<Lines> log_;
    std::optional<PacketOutput> packets_;
    std::unique_ptr<ReadingSink> states_;
    std::optional<RobotOutput> messages_;
    video::Screen screen_;
    PathMemory path_;
    std::optional<WebView> web_;
    Track newest_;
    WatchTally tally_;
    std::chrono::steady_clock::time_point begun_;
};

}  // namespace dotpose::cli
