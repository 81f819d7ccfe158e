/// Detection of AprilTags with Debian's libapriltag, for comparison with dotpose.
#pragma once

#include <memory>
#include <vector>

#include <apriltag/apriltag.h>

#include <dotpose/tools/simulate.hpp>

namespace dotpose::bench {

/// A frame that shows a tag of the tag36h11 family at the image centre.
struct TagFrame {
    GreyImage image;
    int id = 0;
};

/// Renders frames with a tag at a random angle. The tag and its white border span two thirds of the
/// shorter side of the frame. Illumination, blur and noise are the same as in nominal frames from
/// the same camera.
std::vector<TagFrame> render_tags(const CameraModel& camera, int count);

/// A single-threaded detector with the default options of libapriltag.
class TagDetector {
  public:
    /// `decimate` is the factor by which libapriltag downsamples the image before it searches for
    /// tags.
    explicit TagDetector(int decimate);

    const apriltag_family_t& family() const { return *family_; }
    int detect(GreyImage& image);
    /// Returns true if the tag is the only detection in the frame, its position is correct, and
    /// none of its bits are wrong.
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
