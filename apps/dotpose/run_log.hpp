/// Reads a log of `dotpose watch --log`, which has one row for each frame, with a fix or without.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace dotpose::cli {

struct LogRow {
    std::int64_t frame = 0;
    double t_s = 0;
    std::string status;
    std::string events;  ///< names of events, separated by blanks
    std::string verdict;
    std::string state;  ///< lost, moving, stationary
    std::string plane;  ///< pattern or world; empty while lost
    int dots_seen = 0;
    std::optional<double> p_wrong;
    // The pose of the track in mm, degrees and mm/s; none while it is lost.
    std::optional<double> x_mm;
    std::optional<double> y_mm;
    double speed_mm_s = 0;

    bool has_fix() const { return status == "ok"; }
};

/// Reads a log. Throws Error with the number of the line if the file is not a valid log. A last
/// line that is incomplete, for example after a loss of power, is ignored.
std::vector<LogRow> read_log(const std::filesystem::path& path);

/// Statistics of a run.
struct RunStatistics {
    std::int64_t frames = 0;
    std::int64_t fixes = 0;
    double duration_s = 0;
    std::map<std::string, std::int64_t> without_fix;  ///< number of frames by status
    std::map<std::string, std::int64_t> events;       ///< number of events by name
    std::map<std::string, std::int64_t> verdicts;
    std::int64_t gaps = 0;  ///< stretches of frames without a fix
    double longest_gap_s = 0;
    double stationary_s = 0;
    double distance_mm = 0;      ///< length of the path without jumps
    double mean_speed_mm_s = 0;  ///< mean of the frames in which it moves
    double largest_speed_mm_s = 0;
    double largest_p_wrong = 0;
};

RunStatistics statistics_of(const std::vector<LogRow>& rows);

/// Draws the path, and speed, dots and certainty over time with gaps marked, as SVG.
std::string draw_run(const std::vector<LogRow>& rows, const std::string& title);

}  // namespace dotpose::cli
