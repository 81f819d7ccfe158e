// Fuzzes `locate` with arbitrary images, options and predictions. `locate` must terminate and
// access only its own memory. A fix must be complete, finite, and within the limits of the options.
#include <memory>
#include <span>

#include "locate_checks.hpp"
#include "locate_input.hpp"

using namespace dotpose;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const auto kMemory = std::make_unique<LargeMemory>();
    static const auto kOther = std::make_unique<LargeMemory>();
    fuzz::LocateHeader header;
    if (size < sizeof header) return -1;
    std::memcpy(&header, data, sizeof header);
    const DeviceOptions options = fuzz::options_of(header);
    const std::span<const std::uint8_t> rest{data + sizeof header, size - sizeof header};
    const fuzz::Pixels image = fuzz::pixels_of(header, rest);

    Locator locator(*kMemory, options);
    const Fix fix = locator.locate(image.view());
    fuzz::check(fix, options);
    const Prediction prediction = fuzz::prediction_of(header, rest, fix);
    fuzz::check(locator.locate(image.view(), prediction), options);
    if (options.effort == Effort::once && (header.flags & fuzz::LocateHeader::rows_pushed) != 0) {
        Locator other(*kOther, options);
        fuzz::check(fuzz::push_rows(image.view(), other), options);
    }
    return 0;
}
