/// Images of AprilTags, for comparison with libapriltag.
#pragma once

#include <apriltag/apriltag.h>

#include <dotpose/tools/grey_image.hpp>

namespace dotpose::bench {

/// Returns the image of a printed tag with `px_per_square` pixels per square: a white border, a
/// black border, and the bits (white for 1). Does not use `apriltag_to_image`, because libapriltag
/// has no function that completely frees its result.
GreyImage draw_tag(const apriltag_family_t& family, int id, int px_per_square);

}  // namespace dotpose::bench
