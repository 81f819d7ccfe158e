/// Protocol: simulates the paper's experiment (section IV).
#pragma once

#include <filesystem>
#include <iosfwd>
#include <span>
#include <string>
#include <vector>

#include "dotpose/device_options.hpp"
#include "dotpose/export.hpp"
#include "dotpose/tools/evaluate.hpp"
#include "dotpose/tools/print_model.hpp"
#include "dotpose/tools/simulate.hpp"

DOTPOSE_BEGIN_EXPORT

namespace dotpose {

/// Options for the simulated experiment.
struct ProtocolOptions {
    int samples = 20;  ///< number of samples for each Station
    /// Conditions of the experiment. Light, blur and noise are drawn at random once and are the
    /// same for all frames. The other conditions are ignored, because the device is at rest and not
    /// tilted, and the page has no dirt or graphics. The poses and the printing errors are
    /// prescribed by the experiment.
    Setup setup;
    DeviceOptions locate;
    int threads = 0;
    Progress progress;
};

/// Error statistics of one coordinate while the device is at rest.
struct Spread {
    /// Mean error: the mean of the measured minus the true values. The paper calls its magnitude
    /// "accuracy".
    double bias = 0;
    /// Standard deviation. The paper calls it "precision".
    double sigma = 0;
};

/// The results at one position or angle of the device.
struct Station {
    Vec2 place_mm;  ///< position relative to the middle of the area, y down
    double theta_deg = 0;
    Spread x_mm;  ///< errors of the correct fixes along x
    Spread y_mm;
    Spread theta;  ///< errors of the correct fixes in theta, in degrees
    int samples = 0;
    int located = 0;
    int wrong = 0;
};

/// The results of the experiment on one page.
struct ProtocolResult {
    /// Results for a grid of 11 x 11 positions in the 200 x 200 mm area, in spiral order from the
    /// middle outwards.
    std::vector<Station> positions;
    std::vector<Station> angles;  ///< results at 36 angles in the middle of the area
};

/// Results of the experiment on a perfect page and on a printed page.
struct Protocol {
    int samples = 0;
    /// Result for a page whose dots deviate from their intended positions only by jitter.
    ProtocolResult perfect;
    ProtocolResult printed;  ///< result for a page with the errors of `PrintModel`
};

/// Simulates the experiment. Throws Error if `progress` returned false, and BadArgument if there
/// are no samples.
Protocol run_protocol(const ProtocolOptions& options);

/// Returns Table III in Markdown, with the paper's numbers and the simulated numbers.
std::string table_3(const Protocol& protocol);
/// Writes one line for each station.
void write_stations_csv(std::ostream& out, std::span<const Station> stations);

/// Writes table-3.md, positions.csv and angles.csv (both for the printed page), and figure-13,
/// figure-14 and figure-15, each as .svg and .png.
void write_protocol(const std::filesystem::path& folder, const Protocol& protocol);

}  // namespace dotpose

DOTPOSE_END_EXPORT
