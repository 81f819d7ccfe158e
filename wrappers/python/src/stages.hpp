/// Stages: a locator's intermediate results for one frame. They are kept as long as a fix refers to
/// them.
#pragma once

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "dotpose/files/camera.hpp"
#include "dotpose/tools/grey_image.hpp"
#include "dotpose/trace.hpp"

namespace dotpose::python {

/// A frame and its trace. The spans of the trace refer to vectors in this object, so the object
/// cannot be copied or moved.
class Stages {
  public:
    Stages(const ImageView& image, const Trace& trace);
    Stages(const Stages&) = delete;
    Stages& operator=(const Stages&) = delete;

    ImageView image() const { return image_.view(); }
    const Trace& trace() const { return trace_; }
    /// Returns the positions of the detected dots in the image.
    std::vector<PixelPoint> dots_px() const;

  private:
    GreyImage image_;
    Trace trace_;
    std::vector<DetectedDot> dots_;
    std::vector<std::uint16_t> seeds_;
    std::vector<SeedEdge> edges_;
    std::vector<GridCell> cells_;
};

/// Interface of objects that locate frames in sequence and can return the stages of the newest
/// frame.
class StageSource {
  public:
    virtual ~StageSource() = default;
    /// Returns the stages of the frame with the given number. Throws Error if they are no longer
    /// available, for example because a newer frame was located.
    virtual std::shared_ptr<const Stages> stages_of(std::uint64_t number) = 0;
};

}  // namespace dotpose::python
