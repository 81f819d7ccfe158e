#include "core/attempts/rows.hpp"

#include "core/attempts/fitted_pose.hpp"
#include "core/attempts/steps.hpp"
#include "core/attempts/tuning.hpp"
#include "core/decode/likelihood.hpp"
#include "core/decode/position.hpp"
#include "core/decode/window.hpp"
#include "core/integrity/verify.hpp"
#include "core/kernels/select.hpp"

namespace dotpose::core {
namespace {

/// Decodes by the decoder of the options.
Status decode(const Options& options, Workspace& w) {
    if (options.decoder == Decoder::window) {
        return decode_window(w.grid, options.profile, w.line_scores, w.decoding);
    }
    return decode_briefly(w.grid, options.profile, w.line_scores, w.decoding);
}

/// Finds the position in the code from the bits.
Status read_position(const Options& options, Workspace& w) {
    w.decoding.window = choose_window(w.grid, kWindowSide);  // II-B.5
    choose_region(w);
    const Status status = decode(options, w);  // II-B.6-7
    return status == Status::ok ? status : refused(status, w);
}

/// Checks whether all dots in view agree with the position.
Status verify_position(const Options& options, Workspace& w) {
    const Status status = verify_among_codes(w.grid, options.profile, wanted_codes(w), w.decoding,
                                             options.integrity, w.line_scores, w.fix);
    return status == Status::ok ? status : refused(status, w);
}

}  // namespace

Fix finish_rows(const Options& options, Workspace& w) {
    Status status = find_dots(options, w);                     // II-B.1
    if (status == Status::ok) status = find_grid(options, w);  // II-B.2-3
    if (status == Status::ok) {
        status = assign_affine_likelihoods(w.found_dots(), w.grid_from_image, w.grid);  // II-B.4
    }
    if (status == Status::ok) status = read_position(options, w);  // II-B.5-7
    if (status == Status::ok) status = verify_position(options, w);
    if (status == Status::ok) status = measure_pose(options, nullptr, w);  // II-B.8
    if (status == Status::ok) {
        weigh_other_codes(kernels(), w.grid, options.profile, w.decoding, w.line_scores,
                          wanted_codes(w));
    }
    w.fix.status = status;
    return w.fix;
}

bool is_rough(float residual_px, float spacing_px) {
    return residual_px >= std::max(tuning::rows::kRough_px, tuning::rows::kRough * spacing_px);
}

bool is_rough(const Fix& fix) {
    return is_rough(fix.residual_px, static_cast<float>(fix.spacing_px_q16) / 65536.0F);
}

}  // namespace dotpose::core
