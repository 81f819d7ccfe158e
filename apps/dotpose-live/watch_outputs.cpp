#include "watch_outputs.hpp"

#include <cerrno>
#include <cmath>
#include <cstring>

#include <fcntl.h>
#include <fmt/core.h>
#include <unistd.h>

#include "dotpose/files/error.hpp"
#include "dotpose/files/write_file.hpp"
#include "dotpose/pose_packet.hpp"
#include "panel_text.hpp"
#include "reading_fields.hpp"
#include "terminal_text.hpp"

namespace dotpose::cli {

PacketOutput::PacketOutput(const std::string& path)
    : path_(path),
      descriptor_(open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_NOCTTY | O_CLOEXEC, 0666)) {
    if (descriptor_ < 0) throw Error("cannot write " + path + ": " + std::strerror(errno));
}

PacketOutput::~PacketOutput() {
    close(descriptor_);
}

void PacketOutput::write(const Reading& reading, CodeVariant code) {
    const PacketBytes bytes =
        encode(make_packet(reading.record.fix, code, static_cast<std::uint16_t>(reading.index),
                           static_cast<std::uint32_t>(reading.time_us)));
    std::size_t written = 0;
    while (written < bytes.size()) {
        const ssize_t size = ::write(descriptor_, bytes.data() + written, bytes.size() - written);
        if (size < 0 && errno != EINTR) throw_unwritable(path_, errno);
        if (size > 0) written += static_cast<std::size_t>(size);
    }
}

WatchOutputs::WatchOutputs(const OutputOptions& options, const Follower& follower)
    : options_(options),
      follower_(follower),
      sheets_(map_sheets(follower.sheets(), plane_of(follower))),
      lines_(std::in_place, options.lines.out),
      screen_(options.screen),
      begun_(std::chrono::steady_clock::now()) {
    for (const std::string& late : {options.map, options.screen.record}) {
        if (!late.empty()) require_writable(late);
    }
    if (options.lines.format == RecordFormat::csv) {
        write_line(csv_header_of_readings(empty_record(follower), options.lines.units));
    }
    if (!options.log.empty()) {
        log_.emplace(options.log);
        log_->write(csv_header_of_readings(empty_record(follower), Units::mm));
    }
    if (!options.packets.empty()) packets_.emplace(options.packets);
    states_ = open_publisher(options.publish, options.sheets);
    if (options.messages.is_wanted()) messages_.emplace(options.messages);
    if (options.web) web_.emplace(*options.web, follower);
}

bool WatchOutputs::take(const capture::Frame& frame, const Reading& reading,
                        const SourceState& source) {
    tally_.count(reading);
    newest_ = reading.track;
    path_.add(reading.track);
    write_line(line_of(fields(reading, options_.lines.units), options_.lines.format));
    if (log_) log_->write(csv_line(fields(reading, Units::mm)));
    write_packet(reading);
    if (states_) states_->take(reading);
    if (messages_) messages_->take(frame, reading);
    if (web_) web_->take(frame, reading, tally_, path_, source);
    if (!is_anything_left()) return false;
    if (frame.image.pixels.empty()) return screen_.is_wanted();
    return !screen_.is_on() || show(frame, reading, source.dropped);
}

std::optional<Camera> WatchOutputs::take_camera() {
    if (!web_) return std::nullopt;
    std::optional<Camera> camera = web_->take_camera();
    if (camera && messages_) messages_->set_camera(*camera);
    return camera;
}

/// Writes a line. If the reader has closed the pipe, no more lines are written, but the other
/// outputs continue.
void WatchOutputs::write_line(const std::string& line) {
    if (!lines_) return;
    try {
        lines_->write(line);
    } catch (const ReaderLeft&) {
        lines_.reset();
    }
}

void WatchOutputs::write_packet(const Reading& reading) {
    if (!packets_) return;
    try {
        packets_->write(reading, follower_.used_options().code);
    } catch (const ReaderLeft& error) {
        notify(error.what());
        packets_.reset();
    }
}

bool WatchOutputs::is_anything_left() const {
    return lines_ || log_ || packets_ || states_ || messages_ || web_ || !options_.map.empty() ||
           screen_.is_on();
}

bool WatchOutputs::show(const capture::Frame& frame, const Reading& reading, std::int64_t dropped) {
    video::Scene scene;
    scene.image = frame.image.view();
    scene.trace = follower_.trace();
    scene.is_good = reading.record.fix.status == Status::ok;
    scene.y_up = reading.plane == Plane::sheet_world;
    scene.path = path_.marks();
    scene.sheets = sheets_;
    scene.lines = panel_text(reading);
    scene.lines.push_back(fmt::format("{:.0f} frames/s, {} dropped", rate(), dropped));
    return screen_.show(scene);
}

std::optional<std::vector<SheetEntry>> WatchOutputs::take_changed_sheets() {
    return web_ ? web_->take_changed_sheets() : std::nullopt;
}

void WatchOutputs::use_sheets(bool was_in_world) {
    sheets_ = map_sheets(follower_.sheets(), plane_of(follower_));
    // Starts a new path, because the earlier points are in a different plane.
    if (was_in_world != follower_.is_in_world()) path_ = PathMemory();
    if (web_) web_->use_sheets();
}

double WatchOutputs::rate() const {
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - begun_;
    return elapsed.count() > 0 ? static_cast<double>(tally_.frames) / elapsed.count() : 0;
}

void WatchOutputs::finish() {
    screen_.finish();
    if (messages_) messages_->finish();
    if (web_) web_->finish();
    if (!options_.map.empty()) draw_path();
    if (states_) states_->finish();
}

void WatchOutputs::draw_path() const {
    draw::Map map;
    map.title = fmt::format("{} frames, {} fixes", tally_.frames, tally_.fixes);
    map.y_up = follower_.is_in_world();
    map.sheets = sheets_;
    if (!path_.marks().empty()) {
        const video::PathMark& last = path_.marks().back();
        map.robots.push_back(
            {"",
             path_.strokes(),
             {last.x, last.y},
             newest_.is_lost ? std::nullopt : std::optional(newest_.pose.theta_rad()),
             newest_.is_lost ? "lost" : ""});
    }
    draw::keep_visited_sheets(map);
    write_file(options_.map, draw::draw_map(map));
}

}  // namespace dotpose::cli
