// Confirm: what the attempts of desktops share once they think they know where the pattern is:
// measure the dots where it has them, compare their bits, fit the pose.
#pragma once

#include "core/kernels/select.hpp"
#include "core/math/float_plane.hpp"
#include "core/workspace.hpp"
#include "dotpose/image.hpp"
#include "dotpose/options.hpp"

namespace dotpose::core {

/// Where the pattern is thought to be in the image.
struct Hypothesis {
    FloatPlane pattern_from_image;  ///< upright, counted from `from_centre`
    FloatVec from_centre;           ///< px, from the image centre
    Place place;                    ///< of the plane's cell (0, 0)
    float displacement = 0;         ///< of the typical dot, spacings
    bool is_certain = false;        ///< the place needs no confirmation
    bool is_predicted = false;      ///< one look at each dot may do
    /// Dots are known to lie nearer to where they are predicted than to another place of their
    /// cell.
    bool is_exact = false;
    bool shows_part = false;  ///< the pattern may cover any part of the image around `from_centre`
    int depth_q8 = 0;         ///< how much darker than paper a typical dot is, smoothed, in 1/256
    float typical_mass = 0;   ///< of a dot beyond the cut, over the paper's level; 0: not known yet
};

/// Windows count what is darker than the paper by this share, in 1/256, of a typical dot's
/// darkness.
inline constexpr int kCutOfDepth_q8 = 160;

FloatLens float_lens(const Lens& lens);

/// What `list_cells` is asked for: the cells in view within `reach_px` of the hypothesis's point,
/// at most about so many. Fills in the workspace's rolls.
CellsInView cells_in_view(const ImageView& image, const Options& options,
                          const Hypothesis& hypothesis, float reach_px, int most_cells,
                          Workspace& w);

/// Whether an image can show the grid so; all that follows relies on it.
bool is_plausible(const ImageView& image, const FloatPlane& plane);

/// Counts cells from the one at the image centre.
void count_from_centre(Profile profile, Hypothesis& hypothesis);

enum class Confirmation : std::uint8_t {
    ok,
    implausible,  ///< the dots are not where they were expected
    uncertain,    ///< they are, but their bits leave doubts
};

/// Measures, compares, fits: of a prediction at one look at each dot, where that is enough. Sets
/// the workspace's fix and what there is to see of it.
Confirmation confirm(const Kernels& kernels, const ImageView& image, const Options& options,
                     Hypothesis hypothesis, Workspace& w);

}  // namespace dotpose::core
