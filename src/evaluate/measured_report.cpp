// Writes the results of a comparison with measured positions: a report, the errors of each frame,
// and figures.
#include <cmath>
#include <functional>
#include <map>
#include <ostream>

#include <fmt/core.h>

#include "dotpose/files/degrees.hpp"
#include "dotpose/tools/measured.hpp"
#include "draw/svg.hpp"
#include "evaluate/csv.hpp"
#include "evaluate/protocol.hpp"
#include "evaluate/raster.hpp"

namespace dotpose {
namespace {

using namespace evaluate_detail;

std::string number(double value, int decimals) {
    return std::isfinite(value) ? fmt::format("{:.{}f}", value, decimals) : "-";
}

std::string numbers(const Quantiles& quantiles, int decimals) {
    return fmt::format("{} / {} / {}", number(quantiles.median, decimals),
                       number(quantiles.p95, decimals), number(quantiles.max, decimals));
}

struct Samples {
    Station station;
    std::vector<double> x_mm;
    std::vector<double> y_mm;
    std::vector<double> theta_deg;
};

/// Returns the stations in the order of their first visit. `key_of` returns the same value for all
/// frames of a station.
std::vector<Station> stations_of(const Measurement& measurement,
                                 const std::function<std::string(const TruePlace&)>& key_of) {
    std::vector<Samples> all;
    std::map<std::string, std::size_t> index;
    for (std::size_t i = 0; i < measurement.frames.size(); ++i) {
        const auto& truth = measurement.frames[i].truth;
        if (!truth) continue;
        const auto [found, is_new] = index.emplace(key_of(*truth), all.size());
        if (is_new) {
            Station station;
            station.place_mm = {truth->x_mm, truth->y_mm};
            station.theta_deg = truth->angle_rad.value_or(0) * kDegrees;
            all.push_back({station, {}, {}, {}});
        }
        Samples& samples = all[found->second];
        ++samples.station.samples;
        const auto& error = measurement.errors[i];
        if (error && error->is_wrong) ++samples.station.wrong;
        if (!error || error->is_wrong) continue;
        ++samples.station.located;
        samples.x_mm.push_back(error->x_mm);
        samples.y_mm.push_back(error->y_mm);
        if (error->angle_rad) samples.theta_deg.push_back(*error->angle_rad * kDegrees);
    }
    std::vector<Station> stations;
    for (Samples& samples : all) {
        samples.station.x_mm = spread_of(samples.x_mm);
        samples.station.y_mm = spread_of(samples.y_mm);
        samples.station.theta = spread_of(samples.theta_deg);
        stations.push_back(samples.station);
    }
    return stations;
}

}  // namespace

std::vector<std::pair<std::string, std::string>> described(const Measurement& measurement) {
    const std::size_t frames = measurement.frames.size();
    std::map<Status, int> failed;
    for (const MeasuredFrame& frame : measurement.frames) {
        if (frame.status != Status::ok) ++failed[frame.status];
    }
    std::vector<std::pair<std::string, std::string>> rows = {
        {"frames", fmt::format("{}", frames)},
        {"located", fmt::format("{} ({:.2f} %)", measurement.located,
                                100.0 * measurement.located / static_cast<double>(frames))},
        {"wrong fixes", fmt::format("{}", measurement.wrong)},
    };
    for (const auto& [status, count] : failed)
        rows.emplace_back(fmt::format("not located: {}", name(status)), fmt::format("{}", count));
    rows.emplace_back("true places", measurement.is_in_world ? "in the world" : "on the sheet");
    if (const auto& by = measurement.alignment) {
        rows.emplace_back("alignment: shift at the middle, mm: x / y",
                          fmt::format("{:.4f} / {:.4f}", by->shift_x_mm, by->shift_y_mm));
        rows.emplace_back("alignment: turn, degrees", number(by->turn_rad * kDegrees, 4));
        rows.emplace_back("alignment: scale, %", fmt::format("{:+.4f}", 100 * (by->scale - 1)));
        rows.emplace_back("alignment: angle offset, degrees",
                          number(by->angle_offset_rad * kDegrees, 4));
    } else {
        rows.emplace_back("alignment", "none");
    }
    rows.emplace_back("position error, um: median / 95 % / max",
                      numbers(measurement.position_um, 2));
    const auto spread = [](const Spread& s) {
        return fmt::format("{:.2f} / {:.2f}", s.bias, s.sigma);
    };
    rows.emplace_back("error of x, um: mean / standard deviation", spread(measurement.x_um));
    rows.emplace_back("error of y, um: mean / standard deviation", spread(measurement.y_um));
    rows.emplace_back("angle error, degrees: median / 95 % / max",
                      numbers(measurement.angle_deg, 4));
    return rows;
}

void write_errors_csv(std::ostream& out, const Measurement& measurement) {
    out << "file,status,sheet,true_x_mm,true_y_mm,true_angle_deg,found_x_mm,found_y_mm,"
           "found_angle_deg,error_x_um,error_y_um,error_angle_deg,wrong\n";
    for (std::size_t i = 0; i < measurement.frames.size(); ++i) {
        const MeasuredFrame& frame = measurement.frames[i];
        out << fmt::format("{},{},", csv::quoted(frame.file), name(frame.status));
        out << (frame.found ? csv::quoted(frame.found->sheet) : "") << ',';
        const auto angle = [](const std::optional<double>& rad) {
            return rad ? fmt::format("{:.5f}", *rad * kDegrees) : std::string();
        };
        out << (frame.truth ? fmt::format("{:.5f},{:.5f},{},", frame.truth->x_mm, frame.truth->y_mm,
                                          angle(frame.truth->angle_rad))
                            : ",,,");
        out << (frame.found ? fmt::format("{:.5f},{:.5f},{},", frame.found->x_mm, frame.found->y_mm,
                                          angle(frame.found->angle_rad))
                            : ",,,");
        const auto& error = measurement.errors[i];
        out << (error ? fmt::format("{:.3f},{:.3f},{},{}\n", 1000 * error->x_mm, 1000 * error->y_mm,
                                    angle(error->angle_rad), error->is_wrong ? 1 : 0)
                      : ",,,\n");
    }
}

void write_measurement(const std::filesystem::path& folder, const Measurement& measurement) {
    const std::vector<Station> positions = stations_of(measurement, [](const TruePlace& place) {
        return fmt::format("{:.3f} {:.3f}", place.x_mm, place.y_mm);
    });
    if (positions.empty()) throw Error("no frame has a true place to draw");
    const std::vector<Station> angles = stations_of(measurement, [](const TruePlace& place) {
        return fmt::format("{:.2f}", place.angle_rad.value_or(0) * kDegrees);
    });
    const auto write = [&](const char* table, std::span<const Station> stations,
                           std::initializer_list<int> figures) {
        draw::write_file(folder / table,
                         [&](std::ostream& out) { write_stations_csv(out, stations); });
        for (const int figure : figures) {
            draw::write_figure(folder, fmt::format("figure-{}", figure), [&](std::ostream& out) {
                draw_measured_figure(out, figure, stations, measurement.is_in_world);
            });
        }
    };
    write("positions.csv", positions, {13, 14});
    if (angles.size() > 1) write("angles.csv", angles, {15});
}

}  // namespace dotpose
