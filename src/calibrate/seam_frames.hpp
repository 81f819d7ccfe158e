// Finds the poses of several sheets in one frame.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "calibrate/located_frame.hpp"
#include "dotpose/locate.hpp"
#include "dotpose/tools/calibrate.hpp"

namespace dotpose::calibrate {

/// Pose of the camera relative to one sheet, in one image. Maps a point q in the camera frame to
/// the point p = place + axes (q - middle) on the sheet, in nominal mm from the first intersection.
/// If the camera file contains a view of the paper, q is in mm. Otherwise, only the direction of
/// the x axis and the position of the image centre are known, and `middle` is the image centre.
struct SheetView {
    std::size_t sheet = 0;  ///< index of the sheet
    int frame = 0;
    Eigen::Vector2d middle = Eigen::Vector2d::Zero();
    Eigen::Vector2d place = Eigen::Vector2d::Zero();
    Eigen::Matrix2d axes = Eigen::Matrix2d::Identity();
    /// Transforms the errors of place and axes (column by column) into errors with standard
    /// deviation 1. Only the first `rows` rows are set. The other rows are 0, because the
    /// corresponding combinations of place and axes are not known.
    Eigen::Matrix<double, 6, 6> whitening = Eigen::Matrix<double, 6, 6>::Zero();
    int rows = 0;
    /// Cells of the dots: column in the upper 32 bits, row in the lower 32 bits.
    std::vector<std::uint64_t> dots;
    /// Bit mask of the fields of the image that show dots of the sheet. The image is divided into 8
    /// x 8 fields. Bit 8 j + i represents the field in column i and row j.
    std::uint64_t fields = 0;

    bool has_scale() const { return rows == 6; }
};

/// Locates parts of frames separately, because a frame that shows two patterns cannot be located as
/// a whole.
class SeamLocator {
  public:
    SeamLocator(const std::vector<SheetEntry>& sheets, const std::optional<Camera>& camera);

    /// Returns a view for each sheet in the frame. The view is computed from the part of the image
    /// that shows the most dots of the sheet. Throws Error if the size of the image differs from
    /// the image size in the camera file.
    std::vector<SheetView> views(const GreyImage& image);

    /// Rectangle in the image, in px.
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
    Locator locator_{DeviceOptions{}};
};

}  // namespace dotpose::calibrate
