#include "run_log.hpp"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <sstream>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "dotpose/files/error.hpp"
#include "evaluate/csv.hpp"
#include "files/input_file.hpp"

namespace dotpose::cli {
namespace {

using csv::cells_of;

/// Converts a number to an integer. Throws Error unless the number is an integer in [0, 2^53), the
/// range in which a double represents all integers exactly.
std::int64_t whole(double value, const char* column) {
    if (!(value >= 0 && value < 9007199254740992.0) || value != std::floor(value)) {
        throw Error(fmt::format("{} is not a whole number of at least 0", column));
    }
    return static_cast<std::int64_t>(value);
}

/// Maximum number of rows: half a day at 100 frames per second, or about 1 GB of memory.
constexpr std::size_t kMaxLogRows = 5'000'000;

LogRow log_row(const LogCells& row) {
    LogRow result;
    result.frame = whole(row.required("frame"), "frame");
    result.t_s = row.required("t_s");
    result.status = row.text("status");
    result.events = row.text("events");
    result.verdict = row.text("verdict");
    result.state = row.text("state");
    result.plane = row.text("plane");
    result.dots_seen =
        static_cast<int>(std::min(whole(row.number("dots_seen").value_or(0), "dots_seen"),
                                  std::int64_t{std::numeric_limits<int>::max()}));
    result.p_wrong = row.number("p_wrong");
    result.x_mm = row.number("track_x_mm");
    result.y_mm = row.number("track_y_mm");
    result.speed_mm_s =
        std::hypot(row.number("vx_mm_s").value_or(0), row.number("vy_mm_s").value_or(0));
    return result;
}

LogCells::Columns columns_of(const std::string& header, std::span<const char* const> needed) {
    LogCells::Columns columns;
    const auto names = cells_of(header);
    for (std::size_t i = 0; i < names.size(); ++i)
        columns[names[i]] = i;
    for (const char* name : needed) {
        if (!columns.contains(name)) throw Error(fmt::format("no column {}", name));
    }
    return columns;
}

}  // namespace

std::string_view LogCells::text(std::string_view column) const {
    const auto found = columns_.find(column);
    return found == columns_.end() ? std::string_view() : cells_[found->second];
}

std::optional<double> LogCells::number(std::string_view column) const {
    const std::string_view cell = text(column);
    if (cell.empty()) return std::nullopt;
    double value = 0;
    const char* end = cell.data() + cell.size();
    const auto [stop, error] = std::from_chars(cell.data(), end, value);
    if (error != std::errc() || stop != end || !std::isfinite(value)) {
        throw Error(fmt::format("'{}' is not a number of {}", cell, column));
    }
    return value;
}

double LogCells::required(std::string_view column) const {
    const auto value = number(column);
    if (!value) throw Error(fmt::format("{} is missing", column));
    return *value;
}

LogReader::LogReader(const std::filesystem::path& path, std::span<const char* const> needed)
    : path_(path), file_(path, std::ios::binary) {
    const bool is_folder = std::filesystem::is_directory(path);
    if (is_folder || !file_) {
        throw Error(fmt::format("cannot read {}: {}; name a file that 'dotpose watch --log' wrote",
                                path.string(), std::strerror(is_folder ? EISDIR : errno)));
    }
    is_json_ = file_.peek() == '{';
    if (is_json_) return;
    line_ = 1;
    try {
        std::string header;
        if (!files::next_line(file_, header)) throw Error("it is empty");
        columns_ = columns_of(header, needed);
        width_ = cells_of(header).size();
    } catch (const Error& error) {
        refuse(error);
    }
}

std::optional<LogCells> LogReader::next_row() {
    std::string line;
    if (!files::next_line(file_, line)) return std::nullopt;
    ++line_;
    // Ignores a last line without a line break, because it is incomplete.
    if (file_.eof()) return std::nullopt;
    if (is_json_) return row_of_json(line);
    auto cells = cells_of(line);
    if (cells.size() != width_) {
        throw Error(fmt::format("{} values instead of {}", cells.size(), width_));
    }
    return LogCells(columns_, std::move(cells));
}

/// Converts a JSON line to the cells of a CSV row. Each element of a 3 x 3 or 6 x 6 matrix becomes
/// a cell whose name ends in the row and column indices. Each component of a quaternion becomes a
/// cell whose name ends in x, y, z or w.
LogCells LogReader::row_of_json(const std::string& line) {
    const nlohmann::json object = files::parse_json(line);
    if (!object.is_object()) throw Error("it is not an object");
    if (object.contains("track_x_m")) throw Error("its lengths are in m; write it in --units mm");
    columns_.clear();
    std::vector<std::string> cells;
    const auto add = [&](const std::string& name, const nlohmann::json& value) {
        columns_[name] = cells.size();
        cells.push_back(value.is_string() ? value.get<std::string>() : value.dump());
    };
    for (const auto& [name, value] : object.items()) {
        if (!value.is_array()) add(name, value);
        if (!value.is_array()) continue;
        const std::size_t rows = value.size() == 9 ? 3 : 6;
        for (std::size_t i = 0; rows * rows == value.size() && i < value.size(); ++i)
            add(fmt::format("{}_{}{}", name, i / rows, i % rows), value[i]);
        const bool is_vector = value.size() == 3 || value.size() == 4;
        for (std::size_t i = 0; is_vector && i < value.size(); ++i)
            add(fmt::format("{}_{}", name, "xyzw"[i]), value[i]);
    }
    return {columns_, std::move(cells)};
}

void LogReader::refuse(const Error& error) const {
    throw Error(
        fmt::format("{}:{}: not a log of dotpose watch: {}", path_.string(), line_, error.what()));
}

std::vector<LogRow> read_log(const std::filesystem::path& path) {
    std::vector<LogRow> rows;
    LogReader log(path);
    const auto parse = [&rows](const LogCells& row) {
        if (rows.size() == kMaxLogRows) {
            throw Error(fmt::format("more than {} frames", kMaxLogRows));
        }
        return log_row(row);
    };
    while (auto row = log.next(parse))
        rows.push_back(std::move(*row));
    return rows;
}

RunStatistics statistics_of(const std::vector<LogRow>& rows) {
    RunStatistics run;
    run.frames = static_cast<std::int64_t>(rows.size());
    if (rows.empty()) return run;
    run.duration_s = rows.back().t_s - rows.front().t_s;
    double moving_s = 0;
    double gap_begin_s = 0;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const LogRow& row = rows[i];
        const LogRow& before = rows[i > 0 ? i - 1 : 0];
        ++run.verdicts[row.verdict];
        if (!row.plane.empty()) run.planes.insert(row.plane);
        std::istringstream events(row.events);
        for (std::string name; events >> name;)
            ++run.events[name];
        run.fixes += row.has_fix();
        if (!row.has_fix()) {
            ++run.without_fix[row.status];
            if (i == 0 || before.has_fix()) {
                ++run.gaps;
                gap_begin_s = before.t_s;
            }
            run.longest_gap_s = std::max(run.longest_gap_s, row.t_s - gap_begin_s);
        }
        run.largest_p_wrong = std::max(run.largest_p_wrong, row.p_wrong.value_or(0));
        run.largest_speed_mm_s = std::max(run.largest_speed_mm_s, row.speed_mm_s);
        const bool goes_on = row.x_mm && before.x_mm && row.y_mm && before.y_mm &&
                             row.events.find("kidnapped") == std::string::npos &&
                             row.events.find("fix") == std::string::npos;
        if (!goes_on) continue;
        const double step_s = row.t_s - before.t_s;
        if (row.state == "stationary") {
            run.stationary_s += step_s;
            // Does not add the step to the path, because the measured motion of a stationary robot
            // is only noise.
            continue;
        }
        moving_s += step_s;
        run.distance_mm += std::hypot(*row.x_mm - *before.x_mm, *row.y_mm - *before.y_mm);
    }
    if (moving_s > 0) run.mean_speed_mm_s = run.distance_mm / moving_s;
    return run;
}

}  // namespace dotpose::cli
