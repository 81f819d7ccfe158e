/// Print mapping: creates a map of a printed page from many frames, and uses the map to correct
/// fixes.
///
///     PrintMapping mapping({.sheets = read_sheets("sheets.json"), .camera = camera});
///     for (const GreyImage& image : images) mapping.add(image.view());
///     const PrintMapResult result = mapping.solve();
///     write_file("desk.map", print_map_bytes(result.map));
///
///     const MappedFix mapped = with_print_map(fix, result.map, locator.trace());
///     if (mapped.use == MapUse::used) use(mapped.fix);
///
/// `FollowerOptions::print_map` applies a map to all fixes of a Follower.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "dotpose/export.hpp"
#include "dotpose/files/camera.hpp"
#include "dotpose/files/print_map.hpp"
#include "dotpose/files/sheet_file.hpp"
#include "dotpose/fix.hpp"
#include "dotpose/image.hpp"
#include "dotpose/trace.hpp"

DOTPOSE_BEGIN_EXPORT

namespace dotpose {

struct PrintMappingOptions {
    std::vector<SheetEntry> sheets;  ///< the pages that may be in view
    /// Lens and view of the camera. If not given, the lens is assumed to have no distortion, and
    /// the view is computed from the fixes.
    std::optional<Camera> camera;
    /// Earlier map of some of the sheets. The frames update this map. Pages seen in fewer than
    /// `PrintMapping::kMinFrames` frames are copied from it unchanged.
    PrintMap earlier;
};

/// Statistics of the map of one page.
struct MappedPage {
    std::string name;              ///< name of the sheet
    std::size_t frames = 0;        ///< number of frames used
    std::size_t dots = 0;          ///< number of dots on the page
    std::size_t seen = 0;          ///< number of dots that were seen
    std::size_t observations = 0;  ///< number of dot measurements in all frames
    std::size_t outliers = 0;      ///< number of dot measurements rejected as outliers
    double noise_mm = 0;           ///< standard deviation of a measured dot centre, per axis
    /// Standard deviation of the print jitter, per axis (see MapPage::jitter).
    double jitter_mm = 0;
    /// Rms value of the slowly varying part of the dot offsets, per axis: sqrt(m - jitter_mm^2),
    /// where m is the mean square of the offsets.
    double slow_mm = 0;
    /// True if all frames had the same scale, as with a camera mounted at a constant height.
    bool is_rigid = true;
    int iterations = 0;  ///< number of conjugate gradient iterations in all rounds
    /// Standard deviation of the map error in a view, per axis (see MapErrors): the rms value over
    /// all dots that were seen. 0 if it is unknown because the earlier map does not contain its
    /// errors.
    double error_mm = 0;
};

struct PrintMapResult {
    PrintMap map;
    std::vector<MappedPage> pages;  ///< statistics of the pages in view, in the order of the map
    std::size_t frames = 0;         ///< number of input frames
};

/// Collects the dots of many frames, and computes the map from them. Needs 12 bytes of memory for
/// each dot in each frame.
class PrintMapping {
  public:
    /// Throws BadArgument if there are no sheets, or if a sheet or the camera is not valid. Throws
    /// Error if the earlier map contains a page that is not among the sheets.
    explicit PrintMapping(PrintMappingOptions options);
    ~PrintMapping();
    PrintMapping(PrintMapping&&) noexcept;
    PrintMapping& operator=(PrintMapping&&) noexcept;

    /// Locates a frame and stores its dots for `solve`. Ignores the frame and returns false if the
    /// frame shows none of the sheets, or fewer than 20 dots of a sheet. Throws BadArgument if the
    /// image size differs from that of `PrintMappingOptions::camera`.
    bool add(const ImageView& image);

    /// Minimum number of frames required to map a page.
    static constexpr std::size_t kMinFrames = 10;

    /// Computes the map. Calls `progress` with the completed fraction of the current page. Throws
    /// Error if `progress` returns false, if no page was seen in kMinFrames frames, or if the
    /// frames contradict the earlier map.
    PrintMapResult solve(const std::function<bool(double fraction)>& progress = {});

  private:
    struct State;
    std::unique_ptr<State> state_;
};

/// A fix that has been corrected with a map if `use` is MapUse::used.
struct MappedFix {
    Fix fix;
    MapUse use = MapUse::no_map;
};

/// Corrects a fix with a map of the print, given the trace of the frame. Fits the place, angle and
/// scale to the dots at their mapped positions. Also fits perspective and shear if they are
/// significant. The covariance of the result refers to the absolute position on the page. It is
/// computed from the residuals and the map error (`MapPage::error_covariance`), and does not
/// include printing errors. Fixes at the same place have the same map error. To obtain the
/// covariance of the difference between two such fixes, first subtract the covariance of the map
/// error from the covariance of each fix.
///
/// A map that contains the dots in view is used only if the variance of the residuals with the map
/// is at most 0.8 times the variance without the map, or at most twice the square of
/// `MapPage::noise`. Otherwise, `use` is MapUse::contradicted. If the map is not used, `fix` is
/// returned unchanged.
MappedFix with_print_map(const Fix& fix, const PrintMap& map, const Trace& trace);

}  // namespace dotpose

DOTPOSE_END_EXPORT
