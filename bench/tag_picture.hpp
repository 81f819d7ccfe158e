/// Pictures of AprilTags, for comparison with libapriltag.
#pragma once

#include <apriltag/apriltag.h>

#include <dotpose/tools/grey_image.hpp>

namespace dotpose::bench {

/// Returns the image of a printed tag with many pixels per square: a white border, a black border,
/// and the bits (white for 1). Does not use `apriltag_to_image`, because the library has no
/// function that frees its result completely.
GreyImage draw_tag(const apriltag_family_t& family, int id, int px_per_square);

}  // namespace dotpose::bench
