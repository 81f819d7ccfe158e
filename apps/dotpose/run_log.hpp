/// A log of `dotpose watch --log`, read back: one row for each frame, with a fix or without.
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
    std::string events;  ///< names with blanks between
    std::string verdict;
    std::string state;  ///< lost, moving, stationary
    std::string plane;  ///< pattern or world; empty while lost
    int dots_seen = 0;
    std::optional<double> p_wrong;
    // Of the track, while it is not lost; mm, degrees, mm/s.
    std::optional<double> x_mm;
    std::optional<double> y_mm;
    double speed_mm_s = 0;

    bool has_fix() const { return status == "ok"; }
};

/// Throws Error, with the line's number, if the file is no such log. A last line that was cut off,
/// by a loss of power for example, is left out.
std::vector<LogRow> read_log(const std::filesystem::path& path);

/// Figures of a run.
struct RunStatistics {
    std::int64_t frames = 0;
    std::int64_t fixes = 0;
    double duration_s = 0;
    std::map<std::string, std::int64_t> without_fix;  ///< by status
    std::map<std::string, std::int64_t> events;       ///< by name
    std::map<std::string, std::int64_t> verdicts;
    std::int64_t gaps = 0;  ///< stretches of frames without a fix
    double longest_gap_s = 0;
    double stationary_s = 0;
    double distance_mm = 0;      ///< driven, jumps left out
    double mean_speed_mm_s = 0;  ///< while moving
    double largest_speed_mm_s = 0;
    double largest_p_wrong = 0;
};

RunStatistics statistics_of(const std::vector<LogRow>& rows);

/// A picture (SVG): the path, and speed, dots and certainty over time, gaps marked.
std::string draw_run(const std::vector<LogRow>& rows, const std::string& title);

}  // namespace dotpose::cli
