#include "web_recording.hpp"

#include <ctime>
#include <utility>

#include <fmt/core.h>

#include "dotpose/files/error.hpp"
#include "reading_fields.hpp"

namespace dotpose::cli {
namespace {

constexpr const char* kLogEnding = ".csv";
constexpr const char* kMessagesEnding = ".mcap";

/// Returns a name for a recording, without characters that have a special meaning in paths or URLs.
std::string name_at(const std::string& robot, std::time_t now) {
    std::tm utc{};
    gmtime_r(&now, &utc);
    return fmt::format("{}-{:04}{:02}{:02}T{:02}{:02}{:02}Z", ros_name(robot), utc.tm_year + 1900,
                       utc.tm_mon + 1, utc.tm_mday, utc.tm_hour, utc.tm_min, utc.tm_sec);
}

}  // namespace

WebRecordings::WebRecordings(std::filesystem::path folder, RobotOutputOptions messages,
                             Record empty)
    : folder_(std::move(folder)), messages_(std::move(messages)), empty_(std::move(empty)) {
    messages_.dds.reset();
}

void WebRecordings::start() {
    if (running_) return;
    notice_.clear();
    const std::string base = name_at(messages_.robot, std::time(nullptr));
    std::string name = base;
    const auto is_used = [this, &name] {
        return std::filesystem::exists(path_of(name + kLogEnding)) ||
               std::filesystem::exists(path_of(name + kMessagesEnding));
    };
    try {
        for (int i = 2; is_used(); ++i)
            name = fmt::format("{}-{}", base, i);
        RobotOutputOptions options = messages_;
        options.mcap = path_of(name + kMessagesEnding).string();
        running_.emplace(path_of(name + kLogEnding).string(), options);
        running_->log.write(csv_header_of_readings(empty_, Units::mm));
    } catch (const std::exception& error) {
        running_.reset();
        notice_ = fmt::format(
            "{}. Start dotpose with --web-recordings and a folder that it may "
            "write to.",
            error.what());
        return;
    }
    name_ = name;
    frames_ = 0;
}

void WebRecordings::take(const capture::Frame& frame, const Reading& reading) {
    if (!running_) return;
    try {
        running_->log.write(csv_line(fields(reading, Units::mm)));
        running_->messages.take(frame, reading);
        ++frames_;
        if (!is_disk_full()) return;
        stop();
        notice_ = "The recording was stopped because the disk is almost full.";
    } catch (const Error& error) {
        stop();
        notice_ = fmt::format("The recording was stopped: {}.", error.what());
    }
}

void WebRecordings::stop() {
    if (!running_) return;
    try {
        running_->messages.finish();
    } catch (const Error& error) {
        notice_ = fmt::format("The recording is incomplete: {}.", error.what());
    }
    running_.reset();
    files_.push_back(name_ + kLogEnding);
    files_.push_back(name_ + kMessagesEnding);
}

/// Measures the free disk space at most once per second. Returns true only if this call measured
/// the space and found less than 256 MiB.
bool WebRecordings::is_disk_full() {
    constexpr std::uintmax_t kReserve_bytes = 256 << 20;
    const auto now = std::chrono::steady_clock::now();
    if (now - space_checked_at_ < std::chrono::seconds(1)) return false;
    space_checked_at_ = now;
    std::error_code failed;
    const std::filesystem::space_info space = std::filesystem::space(folder_, failed);
    return !failed && space.available < kReserve_bytes;
}

}  // namespace dotpose::cli
