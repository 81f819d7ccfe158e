/// Evaluation: how often `locate` finds frames whose pose is known, and how far it is off.
///
///     const std::vector<TruthRow> rows = read_truth("frames/truth.csv");
///     FrameRun run;
///     run.frames = static_cast<int>(rows.size());
///     run.frame_at = frames_of_folder("frames", rows);
///     const Score score = score_of(evaluate(run).front());
///
/// `frames_of_setup` simulates the frames instead. The paper's own experiment (section IV) is
/// `run_protocol`; `run_sweep` worsens one condition step by step.
///
/// All results but the times depend on the frames alone, not on the number of threads. Functions
/// share no state. Errors of files and arguments are thrown as Error and BadArgument.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <iosfwd>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "dotpose/fix.hpp"
#include "dotpose/options.hpp"
#include "dotpose/tools/error.hpp"
#include "dotpose/tools/grey_image.hpp"
#include "dotpose/tools/sheet.hpp"
#include "dotpose/tools/simulate.hpp"
#include "dotpose/trace.hpp"

#pragma GCC visibility push(default)

namespace dotpose {

// ---- What is true ----

/// The true pose of a frame, in the terms of `Fix`.
struct Truth {
    bool has_pose = true;  ///< false: the frame shows no readable pattern and must be refused
    double x_grid = 0;
    double y_grid = 0;
    double theta_rad = 0;
    std::optional<Section> section;  ///< not judged if unknown
    double spacing_mm = kDefaultSpacing_mm;
};

Truth truth_of(const Shot& shot);

/// One line of truth.csv.
struct TruthRow {
    std::string file;
    Truth truth;
    std::optional<Profile> profile;  ///< as printed, if the file tells
};

/// Reads truth.csv as `dotpose simulate` writes it. Columns are found by their names and may stand
/// in any order; needed are file, theta_deg, and x_grid, y_grid or x_mm, y_mm (grid units win).
/// Known besides: section_u, section_v, profile, spacing_mm. A row with empty pose is a frame
/// without one. `spacing_mm`, if given, replaces that of the file.
/// Throws Error, naming file and line, if the file cannot be read or makes no sense.
std::vector<TruthRow> read_truth(const std::filesystem::path& path,
                                 std::optional<double> spacing_mm = std::nullopt);

// ---- Frames and what was found in them ----

/// A fix farther off than this is wrong: it does not count as an error but as a failure.
inline constexpr double kWrongFrom_grid = 0.5;
inline constexpr double kWrongFrom_deg = 2;

struct KnownFrame {
    GreyImage image;
    Truth truth;
    std::optional<Profile> profile;  ///< replaces that of the options
    std::string problem;             ///< why there is no image; empty if there is one
};

/// Gives frame `index`. Called from several threads; must depend on the index alone.
using FrameSource = std::function<KnownFrame(int index)>;

/// The files of a truth.csv. A file that cannot be read becomes a frame with a `problem`.
FrameSource frames_of_folder(const std::filesystem::path& folder, std::vector<TruthRow> rows);

/// `draw_shot(setup, index)`, rendered.
FrameSource frames_of_setup(const Setup& setup);

/// Told now and then, from the calling thread; false gives the work up with an Error.
using Progress = std::function<bool(int done, int total)>;

struct FrameRun {
    int frames = 0;
    FrameSource frame_at;
    /// Every frame is located with each of these.
    std::vector<Options> options = {Options{}};
    /// Frames that do not tell their profile are read in any, each by itself.
    bool any_code = false;
    /// What else is known of a fix that was just made, from the trace that it left, such as
    /// `with_camera` tells; none: nothing. Called from several threads; its time does not count.
    std::function<Fix(const Fix&, const Trace&)> refine;
    int threads = 0;  ///< 0: one for each core
    Progress progress;
};

/// Found minus true.
struct Deviation {
    double x_grid = 0;
    double y_grid = 0;
    double theta_rad = 0;  ///< in [-pi, pi]
};
Deviation deviation_of(const Fix& fix, const Truth& truth);

inline constexpr std::array kDecoders = {Decoder::window, Decoder::all};
inline constexpr std::array kEfforts = {Effort::device, Effort::once, Effort::twice};
const char* name(Decoder decoder);
const char* name(Effort effort);

/// One frame, located once.
struct Outcome {
    Fix fix;
    Truth truth;
    double elapsed_us = 0;  ///< of `locate` alone
    std::string problem;    ///< of the file; the rest means nothing then

    bool is_fix() const { return problem.empty() && fix.status == Status::ok; }
    bool is_wrong() const;
};

/// outcomes[k][i]: frame i, located with options[k].
std::vector<std::vector<Outcome>> evaluate(const FrameRun& run);

// ---- Numbers ----

/// By nearest rank: the least value that at least this share of all values does not exceed. Not a
/// number without values.
struct Quantiles {
    double median = std::numeric_limits<double>::quiet_NaN();
    double p95 = std::numeric_limits<double>::quiet_NaN();
    double max = std::numeric_limits<double>::quiet_NaN();
};
Quantiles quantiles_of(std::vector<double> values);

struct Score {
    int frames = 0;  ///< readable ones; each is either located, wrong, or has another status
    int unreadable = 0;
    int located = 0;                               ///< right fixes
    int wrong = 0;                                 ///< fixes that are not
    std::array<int, kStatusCount> by_status = {};  ///< `ok` counts right and wrong fixes

    // Of the right fixes.
    Quantiles position_um;  ///< distance in the plane
    Quantiles angle_deg;
    /// Mean of error^2 / variance, for x, y, theta: 1 if the covariance tells the truth, above it
    /// if the fixes are worse than they claim.
    std::array<double, 3> normalised = {};

    double largest_p_wrong = 0;  ///< claimed by any fix
    Quantiles elapsed_us;        ///< of all readable frames

    double located_share() const { return frames > 0 ? 1.0 * located / frames : 0; }
};
Score score_of(std::span<const Outcome> outcomes);

/// The score in words and numbers, for tables: (what, value).
std::vector<std::pair<std::string, std::string>> described(const Score& score);

// ---- One condition, worse and worse ----

enum class SweepKind : std::uint8_t {
    noise,      ///< sensor noise, grey levels
    blur,       ///< sigma of the lens's blur, px
    missing,    ///< dots not printed, %
    tilt,       ///< of the camera, about a random axis in the image, degrees
    spacing,    ///< grid spacing in the image, px
    occlusion,  ///< share of the image behind a straight dark edge from a random side, %
};
inline constexpr std::array kSweepKinds = {SweepKind::noise,   SweepKind::blur,
                                           SweepKind::missing, SweepKind::tilt,
                                           SweepKind::spacing, SweepKind::occlusion};
const char* name(SweepKind kind);

struct SweepOptions {
    Setup setup;                 ///< all other conditions
    int frames_per_value = 200;  ///< the same frames for each value
    Options locate;              ///< `decoder` does not matter: both are run
    int threads = 0;
    Progress progress;
};

struct SweepPoint {
    double value = 0;  ///< in the unit of the kind
    Score window;      ///< by Decoder
    Score all;
};

struct Sweep {
    SweepKind kind = SweepKind::noise;
    Preset preset = Preset::nominal;
    int frames_per_value = 0;
    std::vector<SweepPoint> points;
};

Sweep run_sweep(SweepKind kind, const SweepOptions& options);
void write_sweep_csv(std::ostream& out, const Sweep& sweep);
/// Success rate and errors of both decoders over the condition, as SVG.
void draw_sweep(std::ostream& out, const Sweep& sweep);

// ---- The paper's experiment, section IV, simulated ----

/// A model (not a measurement) of what a printer does to a page: a smooth shift of low frequency.
/// The amplitudes are chosen so that its largest values on the measured area are those that the
/// paper found (Table III): y, along which the paper is fed, is worse.
class PrintModel {
  public:
    static constexpr double kSide_mm = 200;  ///< of the area on which the amplitudes are reached

    PrintModel(double worst_x_mm = 0.15, double worst_y_mm = 0.27);

    /// Printed minus intended place, at a place relative to the middle of the area.
    Vec2 shift_mm(Vec2 from_middle_mm) const;

  private:
    Vec2 amplitude_mm_{1, 1};
};

struct ProtocolOptions {
    int samples = 20;  ///< at each position and angle
    /// Light, blur and noise are the device's and drawn once; dots lie where this page has them.
    Setup setup;
    Options locate;
    int threads = 0;
    Progress progress;
};

/// Deviations of one coordinate while the device stands still.
struct Spread {
    double bias = 0;   ///< mean of found minus true; its absolute value is the paper's accuracy
    double sigma = 0;  ///< the paper's precision
};

/// One position or angle of the device.
struct Station {
    Vec2 place_mm;  ///< from the middle of the area, y down
    double theta_deg = 0;
    Spread x_mm;  ///< of the right fixes
    Spread y_mm;
    Spread theta;  ///< degrees
    int samples = 0;
    int located = 0;
    int wrong = 0;
};

struct ProtocolResult {
    std::vector<Station> positions;  ///< 11 x 11 on 200 x 200 mm, in a spiral from the middle
    std::vector<Station> angles;     ///< 36, at the middle
};

struct Protocol {
    int samples = 0;
    ProtocolResult perfect;  ///< every dot where it should be, but for its jitter
    ProtocolResult printed;  ///< with `PrintModel`
};

/// Throws Error if interrupted.
Protocol run_protocol(const ProtocolOptions& options);

/// Table III in Markdown, the paper's figures beside the simulated ones.
std::string table_3(const Protocol& protocol);
void write_stations_csv(std::ostream& out, std::span<const Station> stations);
/// Figures 13 and 14: accuracy of x or y over the positions; Figure 15: of theta. SVG.
void draw_figure_13(std::ostream& out, const Protocol& protocol);
void draw_figure_14(std::ostream& out, const Protocol& protocol);
void draw_figure_15(std::ostream& out, const Protocol& protocol);

/// Writes table-3.md, positions.csv, angles.csv (the printed page) and figure-13, -14, -15, each as
/// .svg and .png.
void write_protocol(const std::filesystem::path& folder, const Protocol& protocol);
/// Writes sweep-KIND.csv, .svg and .png.
void write_sweep(const std::filesystem::path& folder, const Sweep& sweep);

}  // namespace dotpose

#pragma GCC visibility pop
