/// Simulates a print whose dots have random errors (jitter) and a periodic error along the paper
/// feed (wave). Provides frames for computing the map of the print, and other frames for testing
/// this map.
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>
#include <optional>
#include <vector>

#include <Eigen/Core>
#include <Eigen/QR>

#include "dotpose/tools/follower.hpp"
#include "dotpose/tools/print.hpp"
#include "dotpose/tools/print_mapping.hpp"
#include "dotpose/tools/simulate.hpp"

namespace dotpose::test {

struct MappedPrintOptions {
    double side_mm = 60;   ///< width of the page
    double height_mm = 0;  ///< height of the page, or 0 for a square page
    double wave_mm = 0.040;
    double wavelength_mm = 50;
    double jitter_mm = 0.010;
    int width_px = 320;
    int height_px = 240;
    std::uint64_t print = 1;  ///< seed of the print
};

class MappedPrint {
  public:
    explicit MappedPrint(const MappedPrintOptions& options) : options_(options) {
        SheetOptions sheet;
        sheet.paper = {options.side_mm, height_mm()};
        sheet.margin_mm = 0;
        sheet.origin = {2000, 3000};
        entry_.name = "page";
        entry_.sheet = make_sheet(sheet);
        page_ = page_of(entry_.sheet, options.print);
        page_.shift_mm = [this](Vec2 place) {
            return wave({(place.x - entry_.sheet.origin.x) * entry_.sheet.pattern.spacing_mm,
                         (place.y - entry_.sheet.origin.y) * entry_.sheet.pattern.spacing_mm});
        };
        Rng rng(2024);
        imperfections_ = draw_imperfections(Preset::nominal, rng);
        imperfections_.jitter_mm = options.jitter_mm;
        camera_.width_px = options.width_px;
        camera_.height_px = options.height_px;
    }
    MappedPrint(const MappedPrint&) = delete;
    MappedPrint& operator=(const MappedPrint&) = delete;

    const SheetEntry& entry() const { return entry_; }
    const MappedPrintOptions& options() const { return options_; }

    /// Returns the displacement of a dot due to the wave. The wave displaces dots along y, the
    /// direction of paper feed. Along x, its amplitude is a tenth of the amplitude along y.
    Vec2 wave(Vec2 at_mm) const {
        const double phase = 2 * std::numbers::pi * at_mm.y / options_.wavelength_mm;
        return {0.1 * options_.wave_mm * std::cos(phase), options_.wave_mm * std::sin(phase)};
    }

    struct Pose {
        Vec2 at_mm;  ///< position under the image centre, in mm from the first intersection
        double theta_rad;
    };
    /// Returns a random pose on the page. The distance of the position from the edges is at least
    /// 0.6 times half the diagonal of the view.
    Pose pose(std::uint64_t series, std::uint64_t index) const {
        Rng rng(series, index);
        const double reach =
            camera_.mm_per_px * std::hypot(camera_.width_px, camera_.height_px) / 2;
        const double low = 0.6 * reach;
        const double x_mm = rng.uniform(low, options_.side_mm - low);
        const double y_mm = rng.uniform(low, height_mm() - low);
        return {{x_mm, y_mm}, rng.uniform(-std::numbers::pi, std::numbers::pi)};
    }

    GreyImage frame(const Pose& pose, std::uint64_t seed) const {
        const Sheet& sheet = entry_.sheet;
        const double x = sheet.origin.x + pose.at_mm.x / sheet.pattern.spacing_mm;
        const double y = sheet.origin.y + pose.at_mm.y / sheet.pattern.spacing_mm;
        CameraPose camera;
        camera.cell = {static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y)};
        camera.fraction_x = x - std::floor(x);
        camera.fraction_y = y - std::floor(y);
        camera.theta_rad = pose.theta_rad;
        return render(page_, camera_, camera, imperfections_, seed);
    }

  private:
    double height_mm() const {
        return options_.height_mm > 0 ? options_.height_mm : options_.side_mm;
    }

    MappedPrintOptions options_;
    SheetEntry entry_;
    Page page_;
    Imperfections imperfections_;
    CameraModel camera_;
};

/// Position errors on a page, in mm.
class PlaceErrors {
  public:
    void add(Vec2 at_mm, Vec2 error_mm, Vec2 wave_mm, const Fix& fix) {
        places_.push_back({at_mm, error_mm, wave_mm});
        variance_ += kDefaultSpacing_mm * kDefaultSpacing_mm *
                     (static_cast<double>(fix.covariance[0][0]) +
                      static_cast<double>(fix.covariance[1][1])) /
                     2;
    }
    std::size_t count() const { return places_.size(); }

    /// Returns the rms error per axis after subtracting a fitted offset, rotation and scale.
    double absolute_um() const { return left_um(4, 0); }
    /// Returns the rms error per axis, excluding errors that vary slowly over the page. A displaced
    /// dot moves the fix in the opposite direction, so the function first adds `wave_fraction`
    /// times the wave of the print to each error. Then it subtracts a fitted cubic polynomial.
    double repeatability_um(double wave_fraction) const { return left_um(20, wave_fraction); }
    double sigma_um() const {
        return 1000 * std::sqrt(variance_ / static_cast<double>(places_.size()));
    }

  private:
    struct One {
        Vec2 at;
        Vec2 error;
        Vec2 wave;
    };

    double left_um(int terms, double wave_fraction) const {
        const auto rows = 2 * static_cast<Eigen::Index>(places_.size());
        Eigen::MatrixXd design = Eigen::MatrixXd::Zero(rows, terms);
        Eigen::VectorXd right(rows);
        for (std::size_t k = 0; k < places_.size(); ++k) {
            const auto row = 2 * static_cast<Eigen::Index>(k);
            const auto& [at, error, wave] = places_[k];
            if (terms == 4) {
                design.row(row) << 1, 0, at.x, -at.y;
                design.row(row + 1) << 0, 1, at.y, at.x;
            } else {
                const double x = at.x / 100;
                const double y = at.y / 100;
                Eigen::RowVectorXd cubic(10);
                cubic << 1, x, y, x * x, x * y, y * y, x * x * x, x * x * y, x * y * y, y * y * y;
                design.row(row).head(10) = cubic;
                design.row(row + 1).tail(10) = cubic;
            }
            right[row] = error.x + wave_fraction * wave.x;
            right[row + 1] = error.y + wave_fraction * wave.y;
        }
        const Eigen::VectorXd left = right - design * design.colPivHouseholderQr().solve(right);
        return 1000 * std::sqrt(left.squaredNorm() / static_cast<double>(rows - terms));
    }

    std::vector<One> places_;
    double variance_ = 0;
};

/// Computes the map of a print from `frames` frames. `begin` is called before each frame.
inline PrintMapResult map_of(const MappedPrint& print, int frames, std::uint64_t series = 100,
                             const PrintMap& earlier = {},
                             const std::function<void(int)>& begin = {}) {
    PrintMapping mapping({.sheets = {print.entry()}, .camera = {}, .earlier = earlier});
    for (int i = 0; i < frames; ++i) {
        if (begin) begin(i);
        const auto index = static_cast<std::uint64_t>(i);
        mapping.add(print.frame(print.pose(series, index), scramble(series + index)).view());
    }
    return mapping.solve();
}

/// Position errors in the same frames with and without a map.
struct MapTest {
    PlaceErrors without;
    PlaceErrors with;
    int used = 0;
    int contradicted = 0;
    int not_covered = 0;
};

/// Locates `frames` frames that were not used to compute the map, with and without the map.
inline MapTest test_map(const MappedPrint& print, const PrintMap& map, int frames,
                        std::uint64_t series = 200, const std::optional<Camera>& camera = {}) {
    MapTest result;
    FollowerOptions options;
    options.sheets = {print.entry()};
    options.camera = camera;
    Follower plain(options);
    options.print_map = map;
    Follower mapped(options);
    const double mm = print.entry().sheet.pattern.spacing_mm;
    const Cell origin = print.entry().sheet.origin;
    for (int i = 0; i < frames; ++i) {
        const auto index = static_cast<std::uint64_t>(i);
        const MappedPrint::Pose pose = print.pose(series, index);
        const GreyImage image = print.frame(pose, scramble(series + index));
        const Located before = plain.locate(image);
        const Located after = mapped.locate(image);
        if (!before.fix || !after.fix) continue;
        const auto add = [&](const Fix& fix, PlaceErrors& errors) {
            errors.add(pose.at_mm,
                       {(fix.x_grid() - origin.x) * mm - pose.at_mm.x,
                        (fix.y_grid() - origin.y) * mm - pose.at_mm.y},
                       print.wave(pose.at_mm), fix);
        };
        add(before.fix, result.without);
        add(after.fix, result.with);
        result.used += after.map_use == MapUse::used ? 1 : 0;
        result.contradicted += after.map_use == MapUse::contradicted ? 1 : 0;
        result.not_covered += after.map_use == MapUse::not_covered ? 1 : 0;
    }
    return result;
}

}  // namespace dotpose::test
