/// Selects the frames for four calibration steps: a turn on the spot, a straight drive, a fast
/// drive, and pivoting a pen about its tip.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "dotpose/fix.hpp"
#include "dotpose/tools/grey_image.hpp"
#include "video/screen.hpp"

namespace dotpose::cli {

/// A frame located by `dotpose watch`.
struct GuidedFrame {
    Fix fix;
    double spacing_mm = 0;
    std::int64_t time_us = 0;
    std::int64_t index = 0;  ///< number of the frame, counting dropped frames
    ImageView image;
};

/// Collects the frames of one calibration step while the user moves the robot as instructed on the
/// web page.
class GuidedFrames {
  public:
    using Images = std::vector<std::shared_ptr<const GreyImage>>;

    virtual ~GuidedFrames() = default;

    /// Copies a frame if the calibration needs it.
    virtual void take(const GuidedFrame& frame) = 0;
    /// Called for every frame without a fix.
    virtual void lose() {}

    /// Returns true if no more frames are needed.
    virtual bool is_complete() const = 0;
    /// Returns the progress towards each goal.
    virtual std::vector<video::Gauge> gauges() const = 0;
    virtual std::string advice() const = 0;
    /// Returns advice for each unmet requirement, most urgent first.
    virtual std::vector<std::string> needs() const { return {}; }

    const Images& images() const { return images_; }

  protected:
    void keep(ImageView image);
    Images images_;
};

/// Collects frames during a turn on the spot: one frame for each sector of headings.
class SpinFrames : public GuidedFrames {
  public:
    /// Number of sectors into which a full turn is divided.
    static constexpr int kDirections = 24;

    void take(const GuidedFrame& frame) override;
    bool is_complete() const override { return images_.size() == kDirections; }
    std::vector<video::Gauge> gauges() const override;
    std::string advice() const override;

    const std::array<bool, kDirections>& directions() const { return directions_; }

  private:
    std::array<bool, kDirections> directions_{};
};

/// Collects frames at regular distances during a straight drive.
class DriveFrames : public GuidedFrames {
  public:
    void take(const GuidedFrame& frame) override;
    bool is_complete() const override;
    std::vector<video::Gauge> gauges() const override;
    std::string advice() const override;

  private:
    struct Place {
        double x_mm = 0;
        double y_mm = 0;
    };
    static double distance_mm(const Place& from, const Place& to);

    Place first_;
    Place newest_;  ///< position of the last collected frame
    double length_mm_ = 0;
};

/// Collects consecutive frames during a fast drive.
class ReadoutFrames : public GuidedFrames {
  public:
    void take(const GuidedFrame& frame) override;
    void lose() override { end_run(); }
    bool is_complete() const override { return is_complete_; }
    std::vector<video::Gauge> gauges() const override;
    std::string advice() const override { return advice_; }

    /// Returns the mean interval between consecutive frames. Requires at least two frames.
    double interval_ms() const;

  private:
    struct Seen {
        double x_grid = 0;
        double y_grid = 0;
        std::int64_t time_us = 0;
        std::int64_t index = 0;
    };
    void end_run();

    std::vector<Seen> seen_;  ///< the current sequence of consecutive frames
    bool is_complete_ = false;
    std::string advice_ = "drive fast over the sheet";
};

/// Tilt of a pen as a vector on the sheet, with x to the right and y down. Its length is the
/// tangent of the angle between the optical axis of the camera and the normal of the paper.
struct PenLean {
    double x = 0;
    double y = 0;
};

/// Returns the tilt of the camera in a frame, computed from the perspective distortion of the grid.
/// The status of `fix` must be ok.
PenLean lean_in(const Fix& fix, double focal_px);

/// Collects frames with different tilts while a pen pivots about its tip.
class PivotFrames : public GuidedFrames {
  public:
    /// Number of directions in which the pen must be tilted. Direction 0 is towards the right edge
    /// of the sheet, and direction 2 towards the bottom edge.
    static constexpr int kDirections = 8;

    explicit PivotFrames(double focal_px) : focal_px_(focal_px) {}

    void take(const GuidedFrame& frame) override;
    bool is_complete() const override;
    std::vector<video::Gauge> gauges() const override;
    std::string advice() const override;
    std::vector<std::string> needs() const override;

    /// Returns the tilt of the pen in each collected frame.
    const std::vector<PenLean>& leans() const { return leans_; }
    /// Returns a flag for each direction: true if the pen is tilted in this direction in enough
    /// frames.
    std::array<bool, kDirections> directions() const;

  private:
    double max_tilt_deg() const;

    double focal_px_;
    std::vector<PenLean> leans_;
};

}  // namespace dotpose::cli
