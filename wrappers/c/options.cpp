// Options of a locator.
#include "convert.hpp"

namespace dotpose {
namespace {

/// Size of the options in the first version.
constexpr std::size_t kFirstBytes = 88;

dotpose_options options_of(const Options& o) {
    dotpose_options result{};
    result.size = sizeof result;
    result.profile = static_cast<std::int32_t>(o.profile);
    result.effort = static_cast<std::int32_t>(o.effort);
    result.decoder = static_cast<std::int32_t>(o.decoder);
    result.spacing_nm = o.spacing_nm;
    result.reference_dx_q8 = o.reference_dx_q8;
    result.reference_dy_q8 = o.reference_dy_q8;
    result.lens_k_q40 = o.lens.k_q40;
    result.lens_centre_dx_q8 = o.lens.centre_dx_q8;
    result.lens_centre_dy_q8 = o.lens.centre_dy_q8;
    result.max_p_wrong_log2 = o.integrity.max_p_wrong_log2;
    result.max_bit_error_q8 = o.integrity.max_bit_error_q8;
    result.most_dots = o.most_dots;
    result.threshold_low_q8 = o.threshold.low_q8;
    result.threshold_high_q8 = o.threshold.high_q8;
    result.min_contrast = o.threshold.min_contrast;
    result.min_area_px = o.blobs.min_area_px;
    result.min_mass_q8 = o.blobs.min_mass_q8;
    result.max_area_ratio = o.blobs.max_area_ratio;
    result.min_dots = o.lattice.min_dots;
    result.max_offset_q16 = o.lattice.max_offset_q16;
    result.show_stages = o.show_stages ? 1 : 0;
    return result;
}

Options options_of(const dotpose_options& o) {
    Options result;
    result.profile = static_cast<Profile>(o.profile);
    result.effort = static_cast<Effort>(o.effort);
    result.decoder = static_cast<Decoder>(o.decoder);
    result.spacing_nm = o.spacing_nm;
    result.reference_dx_q8 = o.reference_dx_q8;
    result.reference_dy_q8 = o.reference_dy_q8;
    result.lens.k_q40 = o.lens_k_q40;
    result.lens.centre_dx_q8 = o.lens_centre_dx_q8;
    result.lens.centre_dy_q8 = o.lens_centre_dy_q8;
    result.integrity.max_p_wrong_log2 = o.max_p_wrong_log2;
    result.integrity.max_bit_error_q8 = o.max_bit_error_q8;
    result.most_dots = o.most_dots;
    result.threshold.low_q8 = o.threshold_low_q8;
    result.threshold.high_q8 = o.threshold_high_q8;
    result.threshold.min_contrast = o.min_contrast;
    result.blobs.min_area_px = o.min_area_px;
    result.blobs.min_mass_q8 = o.min_mass_q8;
    result.blobs.max_area_ratio = o.max_area_ratio;
    result.lattice.min_dots = o.min_dots;
    result.lattice.max_offset_q16 = o.max_offset_q16;
    result.show_stages = o.show_stages != 0;
    return result;
}

}  // namespace

dotpose_status c::to_core(const dotpose_options* given, Options& options) {
    dotpose_options read = options_of(Options{});
    const dotpose_status status = c::read_sized(given, kFirstBytes, read);
    if (status != DOTPOSE_OK) return status;
    if (!c::is_profile(read.profile) || !c::is_one_of(read.effort, Effort::twice) ||
        !c::is_one_of(read.decoder, Decoder::all) || !c::is_one_of(read.show_stages, 1)) {
        return DOTPOSE_BAD_ARGUMENT;
    }
    options = options_of(read);
    return DOTPOSE_OK;
}

}  // namespace dotpose

extern "C" dotpose_status dotpose_options_init(dotpose_options* options, std::size_t bytes) {
    using namespace dotpose;
    return c::write_sized(options_of(Options{}), kFirstBytes, options, bytes);
}
