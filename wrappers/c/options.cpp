// Options of a locator.
#include "convert.hpp"

namespace dotpose {
namespace {

/// Size of the options in the first version of the struct.
constexpr std::size_t kFirstBytes = 96;

dotpose_options options_of(const LocatorOptions& o) {
    dotpose_options result{};
    result.size = sizeof result;
    result.code = o.code ? static_cast<std::int32_t>(*o.code) : std::int32_t{DOTPOSE_CODE_DETECT};
    result.effort = static_cast<std::int32_t>(o.effort);
    result.decoder = static_cast<std::int32_t>(o.decoder);
    result.spacing_mm = o.spacing_mm;
    result.lens_k_per_px2 = o.lens_k_per_px2;
    result.lens_centre_dx_px = o.lens_centre_dx_px;
    result.lens_centre_dy_px = o.lens_centre_dy_px;
    result.reference_dx_px = o.reference_dx_px;
    result.reference_dy_px = o.reference_dy_px;
    result.max_p_wrong = o.max_p_wrong;
    result.max_bit_errors = o.max_bit_errors;
    result.min_contrast = o.min_contrast;
    result.min_dots = o.min_dots;
    result.show_stages = o.show_stages ? 1 : 0;
    result.bits_per_error = o.bits_per_error;
    return result;
}

LocatorOptions options_of(const dotpose_options& o) {
    LocatorOptions result;
    if (o.code != DOTPOSE_CODE_DETECT) result.code = static_cast<CodeVariant>(o.code);
    result.spacing_mm = o.spacing_mm;
    result.lens_k_per_px2 = o.lens_k_per_px2;
    result.lens_centre_dx_px = o.lens_centre_dx_px;
    result.lens_centre_dy_px = o.lens_centre_dy_px;
    result.reference_dx_px = o.reference_dx_px;
    result.reference_dy_px = o.reference_dy_px;
    result.max_p_wrong = o.max_p_wrong;
    result.max_bit_errors = o.max_bit_errors;
    result.bits_per_error = o.bits_per_error;
    result.min_contrast = o.min_contrast;
    result.min_dots = o.min_dots;
    result.effort = static_cast<Effort>(o.effort);
    result.decoder = static_cast<Decoder>(o.decoder);
    result.show_stages = o.show_stages != 0;
    return result;
}

const char* bad_member(const dotpose_options& o) {
    // The C++ enumerations have fewer bits than int32_t, so the values are checked before the
    // conversion.
    if (o.code != DOTPOSE_CODE_DETECT && !c::is_code(o.code)) return "code";
    if (!c::is_one_of(o.effort, Effort::twice)) return "effort";
    if (!c::is_one_of(o.decoder, Decoder::all)) return "decoder";
    if (!c::is_one_of(o.show_stages, 1)) return "show_stages";
    return bad_option(options_of(o));
}

}  // namespace

dotpose_status c::to_core(const dotpose_options* given, LocatorOptions& options) {
    dotpose_options read = options_of(LocatorOptions{});
    const dotpose_status status = c::read_sized(given, kFirstBytes, read);
    if (status != DOTPOSE_OK) return status;
    if (bad_member(read) != nullptr) return DOTPOSE_BAD_ARGUMENT;
    options = options_of(read);
    return DOTPOSE_OK;
}

}  // namespace dotpose

extern "C" {

dotpose_status dotpose_options_init(dotpose_options* options, std::size_t bytes) {
    using namespace dotpose;
    return c::write_sized(options_of(LocatorOptions{}), kFirstBytes, options, bytes);
}

const char* dotpose_bad_option(const dotpose_options* options) {
    using namespace dotpose;
    dotpose_options read = options_of(LocatorOptions{});
    return c::read_sized(options, kFirstBytes, read) == DOTPOSE_OK ? bad_member(read) : "size";
}
}
