// Hypothesis: where the attempts of desktops think that the pattern is, and which of its cells they
// look at there.
#pragma once

#include "core/kernels/kernels.hpp"
#include "core/math/float_plane.hpp"
#include "dotpose/image.hpp"
#include "dotpose/options.hpp"
#include "locate/workspace.hpp"

namespace dotpose::core {

/// A hypothesis of where the pattern is in the image.
struct Hypothesis {
    FloatPlane pattern_from_image;  ///< upright, px counted from `from_centre`
    FloatVec from_centre;           ///< px from the image centre
    Place place;                    ///< place of the plane's cell (0, 0)
    float displacement = 0;         ///< of a typical dot, spacings
    bool is_certain = false;        ///< whether the place needs no confirmation
    bool is_predicted = false;      ///< whether one look at each dot may be enough
    /// Whether each dot is known to lie nearer to its predicted place than to another place of its
    /// cell.
    bool is_exact = false;
    bool shows_part = false;  ///< whether the pattern may cover only a part of the image, around
                              ///< `from_centre`
    /// True if doubts about a rough frame are left to the second attempt, which reads its bits
    /// better and in less time than it takes to count the alternatives closely.
    bool defers_if_rough = false;
    int depth_q8 = 0;  ///< darkness of a typical dot against paper in the smoothed patch, in 1/256
    float typical_mass = 0;  ///< sum of a dot's darkness beyond the cut, relative to the paper's
                             ///< level; 0: not known yet
};

/// Windows count the pixels that are darker than the paper by more than this share, in 1/256, of a
/// typical dot's darkness.
inline constexpr int kCutOfDepth_q8 = 160;

/// Returns the centre of an image, px from its first pixel.
FloatVec centre_px(const ImageView& image);

FloatLens float_lens(const Lens& lens);

/// Returns the input of `list_cells`: the cells in view within `reach_px` of the hypothesis's
/// point, thinned to about `most_cells`. Fills the workspace's rolls.
CellsInView cells_in_view(const ImageView& image, const Options& options,
                          const Hypothesis& hypothesis, float reach_px, int most_cells,
                          DesktopWorkspace& w);

/// Counts the cells of the hypothesis from the one nearest its point.
void count_from_centre(Profile profile, Hypothesis& hypothesis);

/// The shift, scale and turn that take predicted dots to where they were found, by least squares.
struct Similarity {
    FloatVec shift_px;
    float scale = 0;  ///< less 1
    float turn_rad = 0;
    float squares_px2 = 0;  ///< sum of the squared offsets that are left
};

/// Fits a similarity to the offsets of two dots or more.
Similarity similarity_of(const DotOffsets& found);

/// Moves, scales and turns a plane to where the dots were found.
FloatPlane moved(const FloatPlane& plane, const Similarity& by);

}  // namespace dotpose::core
