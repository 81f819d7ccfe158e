#include "web_view.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string_view>
#include <utility>

#include <nlohmann/json.hpp>

#include "dotpose/tools/grey_image.hpp"
#include "image_copy.hpp"
#include "json_text.hpp"
#include "metrics_text.hpp"
#include "reading_fields.hpp"
#include "serve/frame_message.hpp"
#include "terminal_text.hpp"
#include "web_pages.hpp"

namespace dotpose::cli {
namespace {

using nlohmann::json;
using std::chrono::milliseconds;

constexpr milliseconds kFramePeriod{66};
constexpr milliseconds kStatePeriod{50};
constexpr milliseconds kSlowPeriod{1000};
constexpr milliseconds kAdvicePeriod{2000};
constexpr int kMaxSide_px = 1280;
constexpr int kMaxSmallSide_px = 480;
/// Maximum number of path points in a message.
constexpr std::size_t kMaxPathPoints = 2000;

/// Removes the user name and the password from a camera URL.
std::string without_user(const std::string& source) {
    const std::size_t scheme = source.find("://");
    if (scheme == std::string::npos) return source;
    const std::size_t begin = scheme + 3;
    const std::string_view host = std::string_view(source).substr(0, source.find('/', begin));
    const std::size_t at = host.rfind('@');
    if (at == std::string_view::npos) return source;
    return source.substr(0, begin) + source.substr(at + 1);
}

std::string names_of(const std::vector<std::string>& sources) {
    std::string text;
    for (const std::string& source : sources)
        text += (text.empty() ? "" : " ") + without_user(source);
    return text;
}

serve::ServerOptions with_pages(serve::ServerOptions options) {
    options.pages = live_pages();
    return options;
}

}  // namespace

WebView::WebView(WebOptions options, const Follower& follower)
    : options_(std::move(options)),
      follower_(follower),
      sheets_(map_sheets(follower.sheets(), plane_of(follower))),
      recordings_(options_.recordings, options_.messages, empty_record(follower)),
      rate_begun_(Clock::now()),
      server_(with_pages(options_.server)),
      setup_(server_.add_topic("setup", serve::Format::text)),
      frame_(server_.add_topic("frame", serve::Format::binary)),
      small_frame_(server_.add_topic("small-frame", serve::Format::binary)),
      state_(server_.add_topic("state", serve::Format::text)),
      history_topic_(server_.add_topic("history", serve::Format::text)),
      path_topic_(server_.add_topic("path", serve::Format::text)),
      advice_(server_.add_topic("advice", serve::Format::text)),
      sheet_topics_(server_),
      calibration_(options_.calibration, server_),
      adviser_([this](const std::string& reason) { publish_reason(reason); }) {
    if (!options_.sheets.path.empty()) {
        sheet_view_.emplace(options_.sheets, server_, sheet_topics_);
    }
    server_.start();
    if (sheet_view_) sheet_view_->start();
    // The log is offered for download only if it is a regular file, because the data in a pipe is
    // available only to the reader of the pipe.
    if (!std::filesystem::is_regular_file(options_.log)) options_.log.clear();
    if (!options_.log.empty()) {
        server_.set_route("/log.csv", [log = options_.log] {
            return serve::Answer{.type = "text/csv", .file = log, .download = "log.csv"};
        });
    }
    server_.set_route("/metrics", [this] {
        return serve::Answer{.type = kMetricsType, .body = metrics_.text()};
    });
    publish_setup();
    notify("the page is at " + server_.url());
}

void WebView::publish_setup() {
    json sheets = json::array();
    for (const draw::MapSheet& sheet : sheets_) {
        json corners = json::array();
        for (const draw::Point& corner : sheet.corners_mm)
            corners.push_back({corner.x, corner.y});
        sheets.push_back({{"name", sheet.name}, {"corners_mm", std::move(corners)}});
    }
    const json setup = {{"robot", options_.messages.robot},
                        {"source", names_of(options_.sources)},
                        {"plane", follower_.is_in_world() ? "world" : "pattern"},
                        {"sheets", std::move(sheets)},
                        {"has_sheet_file", sheet_view_.has_value()},
                        {"log", options_.log.empty() ? json(nullptr) : json("/log.csv")}};
    server_.publish(setup_, [text = text_of(setup)] { return text; });
}

bool WebView::is_time_for(const serve::Topic& topic, Timer& timer, milliseconds period,
                          Clock::time_point now) const {
    if (!timer.is_due(now) || !topic.is_wanted()) return false;
    timer.next = now + period;
    return true;
}

void WebView::take(const capture::Frame& frame, const Reading& reading, const WatchTally& tally,
                   const PathMemory& path, const SourceState& source) {
    const Clock::time_point now = Clock::now();
    count(reading, now);
    metrics_.take(reading.record.fix.status, tally, source.dropped, rate_hz_);
    obey();
    recordings_.take(frame, reading);
    offer_recordings();
    const bool has_image = !frame.image.pixels.empty();
    if (has_image) publish_frame(reading, now);
    if (has_image && sheet_view_) sheet_view_->take(reading, follower_.image());
    if (is_time_for(state_, state_timer_, kStatePeriod, now)) publish_state(reading, tally, source);
    if (is_time_for(history_topic_, history_timer_, kSlowPeriod, now)) publish_history();
    if (is_time_for(path_topic_, path_timer_, kSlowPeriod, now)) publish_path(path);
    if (has_image && is_time_for(advice_, advice_timer_, kAdvicePeriod, now))
        publish_advice(reading, source);
    calibration_.take(frame, reading, has_image ? image_for_calibration(frame) : ImageView{},
                      source.bits_per_px);
}

/// Returns the full frame if the located image is a reduced copy of it, and the located image
/// otherwise.
ImageView WebView::image_for_calibration(const capture::Frame& frame) const {
    const ImageView located = follower_.image();
    return located.width_px == frame.image.width_px ? located : frame.image.view();
}

std::optional<Camera> WebView::take_camera() {
    std::optional<Camera> camera = calibration_.take_camera();
    if (camera) recordings_.set_camera(*camera);
    if (camera && sheet_view_) sheet_view_->set_camera(*camera);
    return camera;
}

void WebView::count(const Reading& reading, Clock::time_point now) {
    history_.add(reading.time_us, reading.record.fix.status);
    if (const auto& place = reading.record.place) visited_.insert(place->entry->name);
    ++rate_frames_;
    const std::chrono::duration<double> elapsed = now - rate_begun_;
    if (elapsed.count() < 1) return;
    rate_hz_ = static_cast<double>(std::exchange(rate_frames_, 0)) / elapsed.count();
    rate_begun_ = now;
}

void WebView::publish_frame(const Reading& reading, Clock::time_point now) {
    const bool is_large = is_time_for(frame_, frame_timer_, kFramePeriod, now);
    const bool is_small = is_time_for(small_frame_, small_timer_, kFramePeriod, now);
    if (!is_large && !is_small) return;
    const ImageView image = follower_.image();
    // The server's thread encodes the images of both sizes from one shared copy.
    const auto shot = std::make_shared<const std::pair<GreyImage, serve::FrameOverlay>>(
        copy_of(image), serve::overlay_of(image, follower_.trace()));
    const auto encoder = [shot, index = reading.index](int max_side_px) {
        return [shot, index, max_side_px] {
            return serve::frame_message(shot->first.view(), shot->second, index, max_side_px);
        };
    };
    if (is_large) server_.publish(frame_, encoder(kMaxSide_px));
    if (is_small) server_.publish(small_frame_, encoder(kMaxSmallSide_px));
}

void WebView::publish_state(const Reading& reading, const WatchTally& tally,
                            const SourceState& source) {
    json state = {{"rate_hz", rate_hz_},       {"frames", tally.frames},
                  {"fixes", tally.fixes},      {"lost", tally.lost},
                  {"dropped", source.dropped}, {"clients", server_.clients()}};
    json doubts = json::array();
    for (const std::string& warning : warnings(reading.record)) {
        if (!warning.empty()) doubts.push_back(warning);
    }
    state["warnings"] = std::move(doubts);
    state["recording"] = {{"is_on", recordings_.is_running()},
                          {"name", recordings_.name()},
                          {"frames", recordings_.frames()},
                          {"notice", recordings_.notice()},
                          {"files", recordings_.files()}};
    // The line is the JSON output for the frame. docs/schema describes its keys.
    std::string line = json_line(fields(reading, Units::mm));
    server_.publish(state_, [state = std::move(state), line = std::move(line)] {
        std::string text = text_of(state);
        text.back() = ',';
        return text + "\"line\":" + line + "}";
    });
}

void WebView::publish_history() {
    json seconds = json::array();
    for (const RefusalHistory::Second& second : history_.seconds()) {
        json frames = json::object();
        for (const auto& [status, count] : second.frames)
            frames[name(status)] = count;
        seconds.push_back({{"second", second.second}, {"frames", std::move(frames)}});
    }
    server_.publish(history_topic_,
                    [text = text_of({{"seconds", std::move(seconds)}})] { return text; });
}

void WebView::publish_path(const PathMemory& path) {
    const std::vector<video::PathMark>& marks = path.marks();
    const std::size_t step = 1 + marks.size() / kMaxPathPoints;
    std::vector<std::vector<double>> strokes;
    bool is_jump = true;
    for (std::size_t i = 0; i < marks.size(); ++i) {
        is_jump = is_jump || marks[i].is_jump;
        if (i % step != 0 && !marks[i].is_jump) continue;
        if (std::exchange(is_jump, false)) strokes.emplace_back();
        strokes.back().push_back(std::round(marks[i].x * 1000) / 1000);
        strokes.back().push_back(std::round(marks[i].y * 1000) / 1000);
    }
    server_.publish(path_topic_, [strokes = std::move(strokes), visited = visited_] {
        return text_of({{"strokes_mm", strokes}, {"visited", visited}});
    });
}

void WebView::publish_advice(const Reading& reading, const SourceState& source) {
    if (reading.record.fix.status == Status::ok) {
        publish_reason({});
        return;
    }
    const PictureFacts facts{reading.record.fix.status, follower_.used_options(),
                             reading.record.code_is_given, source.bits_per_px};
    adviser_.ask({copy_of(follower_.image()), facts, reading.record});
}

void WebView::publish_reason(const std::string& reason) {
    server_.publish(advice_, [text = text_of({{"reason", reason}})] { return text; });
}

std::optional<std::vector<SheetEntry>> WebView::take_changed_sheets() {
    return sheet_view_ ? sheet_view_->take_changed() : std::nullopt;
}

void WebView::use_sheets() {
    sheets_ = map_sheets(follower_.sheets(), plane_of(follower_));
    calibration_.set_sheets(follower_.sheets());
    publish_setup();
}

void WebView::obey() {
    while (const std::optional<serve::Command> command = server_.take_command()) {
        if (sheet_view_ && sheet_view_->obey(*command)) continue;
        if (command->name == "calibrate") {
            calibration_.obey(*command);
            continue;
        }
        const bool* is_on = command->argument<bool>("on");
        if (command->name != "record" || is_on == nullptr) continue;
        if (*is_on) {
            recordings_.start();
        } else {
            recordings_.stop();
        }
    }
}

/// Adds a route for each finished recording. Since each file has a route of its own, requests
/// cannot read any other files.
void WebView::offer_recordings() {
    const std::vector<std::string>& files = recordings_.files();
    for (; offered_ < files.size(); ++offered_) {
        const std::string& file = files[offered_];
        const bool is_log = file.ends_with(".csv");
        server_.set_route("/recordings/" + file, [file, is_log, path = recordings_.path_of(file)] {
            return serve::Answer{.type = is_log ? "text/csv" : "application/octet-stream",
                                 .file = path.string(),
                                 .download = file};
        });
    }
}

}  // namespace dotpose::cli
