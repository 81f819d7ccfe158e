// Reads truth.csv.
#include "dotpose/tools/truth.hpp"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>
#include <map>
#include <numbers>

#include <fmt/core.h>

#include "evaluate/csv.hpp"

namespace dotpose {
namespace {

std::vector<std::string> trimmed_cells_of(const std::string& line) {
    std::vector<std::string> cells = csv::cells_of(line);
    for (std::string& cell : cells) {
        constexpr const char* kBlanks = " \t\r";
        cell.erase(0, cell.find_first_not_of(kBlanks));
        cell.erase(cell.find_last_not_of(kBlanks) + 1);
    }
    return cells;
}

class TruthReader {
  public:
    TruthReader(const std::filesystem::path& path, std::optional<double> spacing_mm)
        : name_(path.string()), spacing_mm_(spacing_mm), stream_(path) {
        if (!stream_) throw Error("cannot read " + name_ + ": " + std::strerror(errno));
    }

    std::vector<TruthRow> rows() {
        read_header();
        std::vector<TruthRow> rows;
        while (next_line())
            rows.push_back(row());
        if (rows.empty()) throw Error(name_ + ": there are no frames in it");
        return rows;
    }

  private:
    [[noreturn]] void fail(const std::string& what) const {
        throw Error(fmt::format("{}, line {}: {}", name_, line_number_, what));
    }

    /// Reads the next non-empty line into `cells_`. Returns false if there is none.
    bool next_line() {
        std::string line;
        while (std::getline(stream_, line)) {
            ++line_number_;
            if (line_number_ == 1 && line.starts_with("\xEF\xBB\xBF")) line.erase(0, 3);
            cells_ = trimmed_cells_of(line);
            if (cells_.size() > 1 || !cells_[0].empty()) return true;
        }
        // Opening a directory succeeds, but reading from it fails.
        if (!stream_.eof()) throw Error("cannot read " + name_);
        return false;
    }

    void read_header() {
        if (!next_line()) throw Error(name_ + " is empty");
        for (std::size_t i = 0; i < cells_.size(); ++i)
            columns_.emplace(cells_[i], i);
        const bool in_grid = has("x_grid") && has("y_grid");
        in_mm_ = !in_grid;
        in_pattern_ = in_grid || (has("x_mm") && has("y_mm"));
        in_world_ = has("x_m") && has("y_m");
        on_sheet_ = has("x_sheet_mm") && has("y_sheet_mm");
        if (!in_pattern_ && !in_world_ && !on_sheet_) {
            fail(
                "the header names no coordinates: x_grid and y_grid, x_mm and y_mm, x_sheet_mm and "
                "y_sheet_mm, or x_m and y_m");
        }
        if (!has("file")) fail("the header does not name file");
        if (in_pattern_ && !has("theta_deg")) fail("the header does not name theta_deg");
    }

    bool has(const std::string& column) const { return columns_.contains(column); }

    /// Returns a cell of the current line, or an empty string if the line has no such cell.
    std::string text(const std::string& column) const {
        const auto found = columns_.find(column);
        return found != columns_.end() && found->second < cells_.size() ? cells_[found->second]
                                                                        : std::string();
    }

    double number(const std::string& column) const {
        const std::string cell = text(column);
        double value = 0;
        const auto [stop, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
        if (error != std::errc() || stop != cell.data() + cell.size() || !std::isfinite(value)) {
            fail(fmt::format("{} is '{}', not a number", column, cell));
        }
        return value;
    }

    std::optional<Section> section() const {
        if (text("section_u").empty() || text("section_v").empty()) return std::nullopt;
        const auto part = [&](const char* column) {
            const double value = number(column);
            if (!(value >= 0 && value < kSections && value == std::floor(value))) {
                fail(fmt::format("{} is {}, not a whole number from 0 to {}", column, value,
                                 kSections - 1));
            }
            return static_cast<std::uint8_t>(value);
        };
        return Section{part("section_u"), part("section_v")};
    }

    std::optional<CodeVariant> code() const {
        const std::string cell = text("code");
        if (cell.empty()) return std::nullopt;
        if (cell == "anoto") return CodeVariant::anoto;
        if (cell == "libdots") return CodeVariant::libdots;
        if (cell == "microdots") return CodeVariant::microdots;
        fail(fmt::format("code is '{}', not anoto, libdots or microdots", cell));
    }

    double spacing_mm() const {
        if (spacing_mm_) return *spacing_mm_;
        if (text("spacing_mm").empty()) return kDefaultSpacing_mm;
        const double value = number("spacing_mm");
        if (!(value > 0)) fail("spacing_mm must be above 0");
        return value;
    }

    /// Returns the pose on a sheet or in the world, or an empty optional if the cells of both
    /// coordinates are empty.
    std::optional<TruePlace> place() const {
        TruePlace place;
        place.is_in_world = in_world_;
        place.sheet = text("sheet");
        const std::string x = in_world_ ? "x_m" : "x_sheet_mm";
        const std::string y = in_world_ ? "y_m" : "y_sheet_mm";
        if (text(x).empty() && text(y).empty()) return std::nullopt;
        const double unit_mm = in_world_ ? 1000 : 1;
        place.x_mm = number(x) * unit_mm;
        place.y_mm = number(y) * unit_mm;
        const std::string degrees = in_world_ ? "yaw_deg" : "theta_sheet_deg";
        if (in_world_ && !text("yaw_rad").empty()) {
            place.angle_rad = number("yaw_rad");
        } else if (!text(degrees).empty()) {
            place.angle_rad = number(degrees) * std::numbers::pi / 180;
        }
        return place;
    }

    TruthRow row() const {
        TruthRow row;
        row.file = text("file");
        if (row.file.empty()) fail("file is empty");
        row.code = code();
        row.is_in_pattern = in_pattern_;
        if (in_world_ || on_sheet_) row.place = place();
        Truth& truth = row.truth;
        if (!in_pattern_) return row;
        truth.spacing_mm = spacing_mm();
        const std::string x = in_mm_ ? "x_mm" : "x_grid";
        const std::string y = in_mm_ ? "y_mm" : "y_grid";
        truth.has_pose = !(text(x).empty() && text(y).empty() && text("theta_deg").empty());
        if (!truth.has_pose) return row;
        const double unit_grid = in_mm_ ? 1 / truth.spacing_mm : 1;
        truth.x_grid = number(x) * unit_grid;
        truth.y_grid = number(y) * unit_grid;
        truth.theta_rad = number("theta_deg") * std::numbers::pi / 180;
        truth.section = section();
        return row;
    }

    std::string name_;
    std::optional<double> spacing_mm_;
    std::ifstream stream_;
    int line_number_ = 0;
    std::vector<std::string> cells_;
    std::map<std::string, std::size_t> columns_;
    bool in_mm_ = false;
    bool in_pattern_ = false;
    bool in_world_ = false;
    bool on_sheet_ = false;
};

}  // namespace

std::vector<TruthRow> read_truth(const std::filesystem::path& path,
                                 std::optional<double> spacing_mm) {
    return TruthReader(path, spacing_mm).rows();
}

Truth truth_of(const Shot& shot) {
    Truth truth;
    truth.x_grid = x_grid(shot.pose);
    truth.y_grid = y_grid(shot.pose);
    truth.theta_rad = shot.pose.theta_rad;
    truth.section = shot.page.pattern.section;
    truth.spacing_mm = shot.page.pattern.spacing_mm;
    return truth;
}

}  // namespace dotpose
