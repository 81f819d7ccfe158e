#include "locate/fitted_pose.hpp"

#include <cmath>

#include "core/decode/nominal.hpp"
#include "core/detect/undistort.hpp"
#include "core/kernels/select.hpp"
#include "core/pose/covariance.hpp"
#include "core/pose/measure.hpp"
#include "core/pose/subgrid.hpp"
#include "core/pose/uneven.hpp"
#include "core/steps.hpp"
#include "locate/tuning.hpp"

namespace dotpose::core {

bool is_implausible(const PoseFit& fit, int bits, int bit_errors) {
    if (fit.displacement <= 0) return true;
    const float scatter = std::sqrt(fit.variance) / fit.displacement;
    const float contradicted = static_cast<float>(bit_errors) / static_cast<float>(bits);
    return scatter + contradicted > tuning::confirm::kMaxImplausible;
}

bool fit_pattern(const DeviceOptions& options, const ImageView& image, DesktopWorkspace& w,
                 PoseFit& fit) {
    const Nominal nominal(w.grid, options.code, w.decoding);
    w.pattern_from_image =
        upright_plane(w.grid_from_image, w.decoding.pattern_from_grid);  // paper, section II-B.8
    w.dot_count = measure_dots(image, options.lens, w.pattern_from_image, nominal, w.grid, w.dots);
    undistort(options.lens, image_centre_q8(w.threshold), first(w.dots, w.dot_count));
    w.seed_count = 0;  // seeds are indices of the previous dots
    const Observations observations(w.found_dots(), w.grid, nominal, &w.smoothing.paper);
    return refine_pose(observations, w.pattern_from_image, fit);
}

Status measure_pose(const DeviceOptions& options, const ImageView& image, DesktopWorkspace& w) {
    PoseFit fit;
    if (!fit_pattern(options, image, w, fit)) return Status::no_grid;
    const FixedVec reference = reference_q8(image_centre_q8(w.threshold), options);
    const Nominal nominal(w.grid, options.code, w.decoding);
    fit_uneven(kernels(), {w.found_dots(), w.grid, nominal}, reference, w.measured,
               w.pattern_from_image, fit);
    w.fix.displacement_q16 = static_cast<std::int32_t>(fit.displacement * 65536.0F);
    write_pose(w.pattern_from_image, reference, options.code, w.decoding.place, w.fix);
    estimate_covariance(fit, w.pattern_from_image, reference, w.fix);
    return is_implausible(fit, w.decoding.bits, w.fix.bit_errors) ? Status::not_certain
                                                                  : Status::ok;
}

}  // namespace dotpose::core
