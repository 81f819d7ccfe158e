/// AprilTag, as Debian ships it: the other way to know where a camera is.
#pragma once

#include <memory>
#include <vector>

#include <apriltag/apriltag.h>

#include <dotpose/tools/simulate.hpp>

namespace dotpose::bench {

/// A frame with one tag of the family tag36h11 in its middle.
struct TagFrame {
    GreyImage image;
    int id = 0;
};

/// The tag has two thirds of the frame's shorter side, its white border included, and any angle;
/// light, blur and noise are those of the nominal frames of the same camera.
std::vector<TagFrame> render_tags(const CameraModel& camera, int count);

/// A detector with the library's defaults, on one thread.
class TagDetector {
  public:
    /// decimate: the library looks for tags in an image smaller by this factor.
    explicit TagDetector(int decimate);

    const apriltag_family_t& family() const { return *family_; }
    /// Number of tags found.
    int detect(GreyImage& image);
    /// Whether just the tag of the frame is found, with all its bits, and in its place.
    bool is_right(TagFrame& frame);

  private:
    struct DestroyFamily {
        void operator()(apriltag_family_t* family) const;
    };
    struct DestroyDetector {
        void operator()(apriltag_detector_t* detector) const;
    };
    std::unique_ptr<apriltag_family_t, DestroyFamily> family_;
    std::unique_ptr<apriltag_detector_t, DestroyDetector> detector_;
};

}  // namespace dotpose::bench
