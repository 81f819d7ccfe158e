#include "stages.hpp"

#include "image.hpp"

namespace dotpose::python {
namespace {

template <typename T>
std::vector<T> kept(std::span<const T>& shown) {
    std::vector<T> copy(shown.begin(), shown.end());
    // `shown` remains valid after `copy` is moved, because moving a vector does not relocate its
    // elements.
    shown = copy;
    return copy;
}

/// Returns a camera that contains only the lens from the options.
Camera camera_of(const FixedLens& lens, int width_px, int height_px) {
    Camera camera;
    camera.width_px = width_px;
    camera.height_px = height_px;
    camera.k_per_px2 = lens.k_q40 / 1099511627776.0;
    camera.centre_px = {(width_px - 1) / 2.0 + lens.centre_dx_q8 / 256.0,
                        (height_px - 1) / 2.0 + lens.centre_dy_q8 / 256.0};
    return camera;
}

}  // namespace

Stages::Stages(const ImageView& image, const Trace& trace)
    : image_(copy_of(image)),
      trace_(trace),
      dots_(kept(trace_.dots)),
      seeds_(kept(trace_.seeds)),
      edges_(kept(trace_.edges)),
      cells_(kept(trace_.grid.cells)) {}

std::vector<PixelPoint> Stages::dots_px() const {
    const Camera camera = camera_of(trace_.options.lens, image_.width_px, image_.height_px);
    std::vector<PixelPoint> pixels;
    pixels.reserve(dots_.size());
    for (const DetectedDot& dot : dots_) {
        const PixelPoint point{dot.centre_q8.x / 256.0, dot.centre_q8.y / 256.0};
        pixels.push_back(camera.k_per_px2 == 0 ? point : distorted(camera, point));
    }
    return pixels;
}

}  // namespace dotpose::python
