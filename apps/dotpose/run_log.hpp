/// Reads logs written by `dotpose watch`, in the CSV format of `--log` or as JSON lines. A log
/// contains one row for each frame, including frames without a fix.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "dotpose/files/error.hpp"

namespace dotpose::cli {

/// A row of a log. The cells are accessed by column name.
class LogCells {
  public:
    /// Maps the name of each column to the index of its cell in a row.
    using Columns = std::map<std::string, std::size_t, std::less<>>;

    LogCells(const Columns& columns, std::vector<std::string> cells)
        : columns_(columns), cells_(std::move(cells)) {}

    bool has(std::string_view column) const { return columns_.contains(column); }
    /// Returns the text in a cell, or an empty string if the column does not exist.
    std::string_view text(std::string_view column) const;
    /// Returns the number in a cell, or none if the cell is empty or the column does not exist.
    /// Throws Error if the cell contains anything other than a number.
    std::optional<double> number(std::string_view column) const;
    double required(std::string_view column) const;

  private:
    const Columns& columns_;
    std::vector<std::string> cells_;
};

/// Reads a log row by row. The functions throw Error, with the line number, if the file is not a
/// valid log. An incomplete last line, for example after a power failure, is ignored.
class LogReader {
  public:
    /// Columns that `read_log` needs. Logs written by `watch --log` contain all of them.
    static constexpr std::array<const char*, 13> kWatchColumns = {
        "frame",   "t_s",   "status",     "dots_seen",  "p_wrong", "state",  "events",
        "verdict", "plane", "track_x_mm", "track_y_mm", "vx_mm_s", "vy_mm_s"};

    /// Throws Error if the file is CSV and any of the columns in `needed` is missing.
    explicit LogReader(const std::filesystem::path& path,
                       std::span<const char* const> needed = kWatchColumns);

    /// Returns `parse(next row)`, or none at the end of the file. Adds the line number to any Error
    /// that `parse` throws.
    template <typename Parse>
    auto next(Parse parse) -> std::optional<decltype(parse(std::declval<const LogCells&>()))> {
        try {
            const std::optional<LogCells> row = next_row();
            if (!row) return std::nullopt;
            return parse(*row);
        } catch (const Error& error) {
            refuse(error);
        }
    }

  private:
    std::optional<LogCells> next_row();
    LogCells row_of_json(const std::string& line);
    [[noreturn]] void refuse(const Error& error) const;

    std::filesystem::path path_;
    std::ifstream file_;
    int line_ = 0;
    bool is_json_ = false;
    std::size_t width_ = 0;
    LogCells::Columns columns_;  ///< columns of the file or, for JSON lines, of the current row
};

struct LogRow {
    std::int64_t frame = 0;
    double t_s = 0;
    std::string status;
    std::string events;  ///< names of events, separated by spaces
    std::string verdict;
    std::string state;  ///< lost, moving or stationary
    std::string plane;  ///< pattern or world, or empty if the robot is lost
    int dots_seen = 0;
    std::optional<double> p_wrong;
    // Tracked position and speed of the robot. There is no position while the robot is lost.
    std::optional<double> x_mm;
    std::optional<double> y_mm;
    double speed_mm_s = 0;

    bool has_fix() const { return status == "ok"; }
};

/// Reads a whole log. Throws the same errors as LogReader.
std::vector<LogRow> read_log(const std::filesystem::path& path);

struct RunStatistics {
    std::int64_t frames = 0;
    std::int64_t fixes = 0;
    double duration_s = 0;
    std::map<std::string, std::int64_t> without_fix;  ///< number of frames without a fix, by status
    std::map<std::string, std::int64_t> events;       ///< number of events of each kind, by name
    std::map<std::string, std::int64_t> verdicts;
    std::int64_t gaps = 0;  ///< number of periods without a fix
    double longest_gap_s = 0;
    double stationary_s = 0;
    double distance_mm = 0;      ///< length of the path, excluding jumps
    double mean_speed_mm_s = 0;  ///< mean speed while the robot is moving
    double largest_speed_mm_s = 0;
    double largest_p_wrong = 0;
    std::set<std::string> planes;  ///< frames of reference used for poses: pattern, world, or both
};

RunStatistics statistics_of(const std::vector<LogRow>& rows);

/// Returns an SVG image of the path, with plots of the speed, the number of dots and the certainty
/// over time. Periods without a fix are marked in the plots.
std::string draw_run(const std::vector<LogRow>& rows, const std::string& title);

}  // namespace dotpose::cli
