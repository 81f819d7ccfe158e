/// The web page of `dotpose watch --web`. docs/web.md describes the topics.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "advice_worker.hpp"
#include "dotpose/tools/follower.hpp"
#include "draw/track_map.hpp"
#include "path_memory.hpp"
#include "reading.hpp"
#include "refusal_history.hpp"
#include "serve/server.hpp"
#include "watch_metrics.hpp"
#include "watch_tally.hpp"
#include "web_calibration.hpp"
#include "web_recording.hpp"
#include "web_sheets.hpp"

namespace dotpose::cli {

struct WebOptions {
    serve::ServerOptions server;
    std::vector<std::string> sources;  ///< names of the frame sources
    std::string recordings = ".";      ///< folder for recordings that are started on the page
    std::string log;                   ///< path of the log that clients may download, or empty
    RobotOutputOptions messages;       ///< describes the robot in recordings
    WebSheetsOptions sheets;           ///< `sheets.path` is empty if there is no sheet file
    /// Options for calibration on the web page, or nullopt to disable calibration.
    std::optional<GuideOptions> calibration;
};

/// State of the frame source.
struct SourceState {
    std::int64_t dropped = 0;  ///< total number of dropped frames
    double bits_per_px = 0;    ///< bit rate of a compressed video, or 0
};

class WebView {
  public:
    /// Starts the server and reports its address. `follower` must outlive this object. Throws
    /// BadArgument or Error on failure.
    WebView(WebOptions options, const Follower& follower);

    /// Sends a frame to the clients that are ready, and executes the clients' commands.
    void take(const capture::Frame& frame, const Reading& reading, const WatchTally& tally,
              const PathMemory& path, const SourceState& source);

    /// Returns the sheets if they have changed since the previous call, and nullopt otherwise.
    std::optional<std::vector<SheetEntry>> take_changed_sheets();
    /// Uses the follower's new sheets for the page and for later calibrations.
    void use_sheets();
    /// Returns the camera that was calibrated on the web page since the previous call, or nullopt.
    std::optional<Camera> take_camera();

    /// Finishes a running recording.
    void finish() { recordings_.stop(); }

  private:
    using Clock = std::chrono::steady_clock;
    /// Limits the rate at which a topic is published.
    struct Timer {
        Clock::time_point next{};
        bool is_due(Clock::time_point now) const { return now >= next; }
    };

    void publish_setup();
    void publish_frame(const Reading& reading, Clock::time_point now);
    void publish_state(const Reading& reading, const WatchTally& tally, const SourceState& source);
    void publish_history();
    void publish_path(const PathMemory& path);
    void publish_reason(const std::string& reason);
    void publish_advice(const Reading& reading, const SourceState& source);
    void obey();
    void offer_recordings();
    ImageView image_for_calibration(const capture::Frame& frame) const;
    void count(const Reading& reading, Clock::time_point now);
    bool is_time_for(const serve::Topic& topic, Timer& timer, std::chrono::milliseconds period,
                     Clock::time_point now) const;

    WebOptions options_;
    const Follower& follower_;
    std::vector<draw::MapSheet> sheets_;
    std::set<std::string> visited_;  ///< names of the sheets on which frames were located
    RefusalHistory history_;
    WatchMetrics metrics_;
    WebRecordings recordings_;
    std::size_t offered_ = 0;  ///< number of recorded files offered for download

    Clock::time_point rate_begun_;
    std::int64_t rate_frames_ = 0;
    double rate_hz_ = 0;  ///< frame rate in the last complete second

    Timer frame_timer_;
    Timer small_timer_;
    Timer state_timer_;
    Timer history_timer_;
    Timer path_timer_;
    Timer advice_timer_;

    serve::Server server_;
    serve::Topic& setup_;
    serve::Topic& frame_;
    serve::Topic& small_frame_;
    serve::Topic& state_;
    serve::Topic& history_topic_;
    serve::Topic& path_topic_;
    serve::Topic& advice_;
    SheetTopics sheet_topics_;
    std::optional<WebSheets> sheet_view_;  ///< nullopt if there is no sheet file
    WebCalibration calibration_;
    AdviceWorker adviser_;  ///< destroyed before the server, because its thread uses the server
};

}  // namespace dotpose::cli
