// Seam frames: what frames that show parts of several sheets tell of each.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "dotpose/calibrate.hpp"
#include "dotpose/locate.hpp"

namespace dotpose::calibrate {

/// A place and direction on a plane with x right, y DOWN: mm and radians, from +x towards +y.
struct PlanePose {
    double x = 0;
    double y = 0;
    double turn = 0;

    /// The place of `inner`, which is told in the frame of this pose.
    PlanePose operator*(const PlanePose& inner) const;
    PlanePose inverse() const;
};

/// The pose of one frame's image centre on one sheet.
struct SheetView {
    std::size_t sheet = 0;  ///< index
    PlanePose pose;
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< of (x, y, turn)
    int dots = 0;
};

/// Locates in parts of frames: a frame that shows two patterns is refused as a whole.
class SeamLocator {
  public:
    SeamLocator(const std::vector<SheetEntry>& sheets, const std::optional<Camera>& camera);

    /// All sheets that are seen, each by the part that shows most of it. Throws Error.
    std::vector<SheetView> views(const GreyImage& image);

  private:
    struct Part {
        int u = 0;
        int v = 0;
        int width = 0;
        int height = 0;
    };
    static std::vector<Part> parts_of(const GreyImage& image);
    std::vector<SheetView> views_with(const GreyImage& image, Effort effort);
    std::optional<SheetView> view_in(const GreyImage& image, const Part& part, Effort effort);
    std::optional<SheetView> view_of(const Fix& fix, Profile profile) const;

    const std::vector<SheetEntry>& sheets_;
    std::optional<Camera> camera_;
    std::vector<Profile> profiles_;
    std::unique_ptr<LargeWorkspace> workspace_;
};

}  // namespace dotpose::calibrate
