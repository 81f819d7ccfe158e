#include "apriltag.hpp"

#include <algorithm>
#include <cmath>

#include <apriltag/tag36h11.h>

#include "frames.hpp"
#include "tag_picture.hpp"

namespace dotpose::bench {
namespace {

struct DestroyDetections {
    void operator()(zarray_t* detections) const { apriltag_detections_destroy(detections); }
};
using Detections = std::unique_ptr<zarray_t, DestroyDetections>;

Detections detections_in(apriltag_detector_t* detector, GreyImage& image) {
    image_u8_t view = {image.width_px, image.height_px, image.width_px, image.pixels.data()};
    return Detections(apriltag_detector_detect(detector, &view));
}

GreyImage render_tag(const Shot& shot, const apriltag_family_t& family, int id) {
    constexpr int kPxPerSquare = 32;
    const GreyImage printed = draw_tag(family, id, kPxPerSquare);
    const int shorter_px = std::min(shot.camera.width_px, shot.camera.height_px);
    const double side_mm = shorter_px * shot.camera.mm_per_px * 2 / 3;
    PageImage page;
    page.image = printed.view();
    page.mm_per_px = side_mm / printed.width_px;
    page.centre_mm = {side_mm / 2, side_mm / 2};
    return render(page, shot.camera, shot.pose, shot.imperfections, shot.seed);
}

}  // namespace

std::vector<TagFrame> render_tags(const CameraModel& camera, int count) {
    Setup setup;
    setup.seed = kSeed;
    setup.camera = camera;
    const TagDetector any(1);
    std::vector<TagFrame> frames(static_cast<std::size_t>(count));
    on_all_cores(count, [&](int i) {
        const Shot shot = draw_shot(setup, static_cast<std::uint64_t>(i));
        const int id = i % static_cast<int>(any.family().ncodes);
        frames[static_cast<std::size_t>(i)] = {render_tag(shot, any.family(), id), id};
    });
    return frames;
}

void TagDetector::DestroyFamily::operator()(apriltag_family_t* family) const {
    tag36h11_destroy(family);
}

void TagDetector::DestroyDetector::operator()(apriltag_detector_t* detector) const {
    apriltag_detector_destroy(detector);
}

TagDetector::TagDetector(int decimate)
    : family_(tag36h11_create()), detector_(apriltag_detector_create()) {
    apriltag_detector_add_family(detector_.get(), family_.get());
    detector_->nthreads = 1;
    detector_->quad_decimate = static_cast<float>(decimate);
}

int TagDetector::detect(GreyImage& image) {
    return zarray_size(detections_in(detector_.get(), image).get());
}

bool TagDetector::is_right(TagFrame& frame) {
    const Detections found = detections_in(detector_.get(), frame.image);
    if (zarray_size(found.get()) != 1) return false;
    apriltag_detection_t* tag = nullptr;
    zarray_get(found.get(), 0, &tag);
    // In libapriltag, the origin is the corner of the first pixel, so the image centre is at half
    // the image size.
    const double u_error_px = tag->c[0] - frame.image.width_px / 2.0;
    const double v_error_px = tag->c[1] - frame.image.height_px / 2.0;
    return tag->id == frame.id && tag->hamming == 0 && std::hypot(u_error_px, v_error_px) < 1;
}

}  // namespace dotpose::bench
