// Writes Table III of the paper and the CSV files of the protocol.
#include <cmath>
#include <ostream>

#include <fmt/core.h>

#include "dotpose/tools/draw.hpp"
#include "draw/svg.hpp"
#include "evaluate/protocol.hpp"
#include "evaluate/raster.hpp"

namespace dotpose {
namespace {

using namespace evaluate_detail;

/// Returns the table cells "accuracy | precision" for one coordinate.
std::string cells(const Summary& summary, const char* unit, int decimals) {
    return fmt::format("{0:.{1}f}{3} | ± {2:.{1}f}{3}", summary.worst, decimals,
                       summary.worst_sigma, unit);
}

struct TabledCoordinate {
    const char* name;
    const char* paper;
    const char* unit;
    int decimals;
    bool is_angle;
    SpreadOf spread;
};

std::vector<TabledCoordinate> coordinates() {
    return {
        {"x", "0.155 mm | ± 0.010 mm", " mm", 4, false, [](const Station& s) { return s.x_mm; }},
        {"y", "0.273 mm | ± 0.014 mm", " mm", 4, false, [](const Station& s) { return s.y_mm; }},
        {"θ", "1.581° | ± 0.407°", "°", 3, true, [](const Station& s) { return s.theta; }},
    };
}

std::string fraction(std::span<const Station> stations) {
    int located = 0;
    int samples = 0;
    for (const Station& station : stations) {
        located += station.located;
        samples += station.samples;
    }
    return samples > 0 ? fmt::format("{:.2f} %", 100.0 * located / samples) : "-";
}

}  // namespace

std::string table_3(const Protocol& protocol) {
    const auto row = [](const std::string& what, const std::string& paper,
                        const std::string& perfect, const std::string& printed) {
        return fmt::format("| {} | {} | {} | {} |\n", what, paper, perfect, printed);
    };
    std::string table = row("Coordinate", "Paper: accuracy | precision",
                            "Simulated, perfect page: accuracy | precision",
                            "Simulated, printer model: accuracy | precision") +
                        "|:---|---:|---:|---:|---:|---:|---:|\n";
    for (const TabledCoordinate& c : coordinates()) {
        const auto stations = [&c](const ProtocolResult& result) {
            return std::span<const Station>(c.is_angle ? result.angles : result.positions);
        };
        table += row(c.name, c.paper,
                     cells(summary_of(stations(protocol.perfect), c.spread), c.unit, c.decimals),
                     cells(summary_of(stations(protocol.printed), c.spread), c.unit, c.decimals));
    }
    table += row("positions decoded", "99.17 % (x), 100 % (y) | ",
                 fraction(protocol.perfect.positions) + " | ",
                 fraction(protocol.printed.positions) + " | ");
    table += row("angles decoded", "100 % | ", fraction(protocol.perfect.angles) + " | ",
                 fraction(protocol.printed.angles) + " | ");
    return table;
}

void write_stations_csv(std::ostream& out, std::span<const Station> stations) {
    out << "x_mm,y_mm,theta_deg,samples,located,wrong,x_bias_mm,x_sigma_mm,y_bias_mm,y_sigma_mm,"
           "theta_bias_deg,theta_sigma_deg\n";
    for (const Station& s : stations) {
        out << fmt::format("{:.3f},{:.3f},{:.3f},{},{},{}", s.place_mm.x, s.place_mm.y, s.theta_deg,
                           s.samples, s.located, s.wrong);
        for (const Spread& spread : {s.x_mm, s.y_mm, s.theta}) {
            // The cells are empty if there are no fixes.
            out << (s.located > 0 ? fmt::format(",{:.6f},{:.6f}", spread.bias, spread.sigma)
                                  : std::string(",,"));
        }
        out << '\n';
    }
}

void write_protocol(const std::filesystem::path& folder, const Protocol& protocol) {
    using Write = std::function<void(std::ostream&)>;
    const std::pair<const char*, Write> files[] = {
        {"table-3.md", [&](std::ostream& out) { out << table_3(protocol); }},
        {"positions.csv",
         [&](std::ostream& out) { write_stations_csv(out, protocol.printed.positions); }},
        {"angles.csv",
         [&](std::ostream& out) { write_stations_csv(out, protocol.printed.angles); }},
    };
    for (const auto& [name, write] : files)
        draw::write_file(folder / name, write);
    const std::pair<const char*, Write> figures[] = {
        {"figure-13", [&](std::ostream& out) { draw_figure_13(out, protocol); }},
        {"figure-14", [&](std::ostream& out) { draw_figure_14(out, protocol); }},
        {"figure-15", [&](std::ostream& out) { draw_figure_15(out, protocol); }},
    };
    for (const auto& [name, write] : figures)
        draw::write_figure(folder, name, write);
}

}  // namespace dotpose
