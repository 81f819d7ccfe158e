/// Stages: what a locator saw in one frame, kept for as long as a fix needs it.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "dotpose/files/camera.hpp"
#include "dotpose/tools/grey_image.hpp"
#include "dotpose/trace.hpp"

namespace dotpose::python {

/// A frame and its trace, whose spans show the vectors beside it. Never copied or moved.
class Stages {
  public:
    Stages(const ImageView& image, const Trace& trace);
    Stages(const Stages&) = delete;
    Stages& operator=(const Stages&) = delete;

    const Trace& trace() const { return trace_; }
    /// Returns the pixels of the image where dots were found.
    std::vector<PixelPoint> dots_px() const;
    /// Returns the picture of `draw_frame`, an SVG document.
    std::string drawn(const std::string& title) const;

  private:
    GreyImage image_;
    Trace trace_;
    std::vector<DetectedDot> dots_;
    std::vector<std::uint16_t> seeds_;
    std::vector<SeedEdge> edges_;
    std::vector<GridCell> cells_;
};

/// Something that locates frames, one after the other, and can show the stages of its newest.
class StageSource {
  public:
    virtual ~StageSource() = default;
    /// Returns the stages of the frame with this number. Throws Error if there was another frame
    /// since.
    virtual std::shared_ptr<const Stages> stages_of(std::uint64_t number) = 0;
};

}  // namespace dotpose::python
