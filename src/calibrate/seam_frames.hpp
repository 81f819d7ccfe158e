// Seam frames: how frames that show parts of several sheets lie on each of them.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "calibrate/located_frame.hpp"
#include "dotpose/locate.hpp"
#include "dotpose/tools/calibrate.hpp"

namespace dotpose::calibrate {

/// How one frame's camera lies on one sheet: the point q of the camera frame is seen at p = place +
/// axes (q - middle), in mm of the sheet as it was meant to be printed, from its first
/// intersection. A camera whose view is known measures in mm of its own. Of any other camera, only
/// the direction of its x axis and the place of its image centre are known, and `middle` is that
/// centre.
struct SheetView {
    std::size_t sheet = 0;  ///< index of the sheet
    int frame = 0;
    Eigen::Vector2d middle = Eigen::Vector2d::Zero();
    Eigen::Vector2d place = Eigen::Vector2d::Zero();
    Eigen::Matrix2d axes = Eigen::Matrix2d::Identity();
    /// Scales the errors of place and axes (column by column) to standard deviation 1; rows from
    /// `rows` on are 0, because these combinations are not known.
    Eigen::Matrix<double, 6, 6> whitening = Eigen::Matrix<double, 6, 6>::Zero();
    int rows = 0;
    std::vector<std::uint64_t> dots;  ///< cells of the dots
    /// The fields of the image that show dots of the sheet: bit 8 j + i is that of column i, row j
    /// of 8 x 8 fields.
    std::uint64_t fields = 0;

    bool has_scale() const { return rows == 6; }
};

/// Locates parts of frames, because a frame that shows two patterns is refused as a whole.
class SeamLocator {
  public:
    SeamLocator(const std::vector<SheetEntry>& sheets, const std::optional<Camera>& camera);

    /// Returns all sheets that are seen, each by the part that shows most of it. Throws Error.
    std::vector<SheetView> views(const GreyImage& image);

    /// A rectangle of the image, in px.
    struct Part {
        int u = 0;
        int v = 0;
        int width = 0;
        int height = 0;
    };

  private:
    static std::vector<Part> parts_of(const GreyImage& image);
    Camera camera_of(const GreyImage& image, const Part& part) const;
    std::vector<SheetView> views_with(const GreyImage& image, Effort effort);
    std::optional<SheetView> view_in(const GreyImage& image, const Part& part, Effort effort);
    std::optional<SheetView> view_of(const GreyImage& image, const Part& part, const Fix& fix,
                                     const Camera& camera, CodeVariant code) const;

    const std::vector<SheetEntry>& sheets_;
    std::optional<Camera> camera_;
    std::vector<CodeVariant> codes_;
    Locator locator_{Options{}};
};

}  // namespace dotpose::calibrate
