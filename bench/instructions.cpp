// Locates nominal frames of 188 x 120 px. The script bench/instructions runs this program under
// callgrind, and counts the instructions of the functions that call the locator. Prints the number
// of frames, and the number of frames that the first attempt locates without a given code. If a
// side length and a spacing, both in px, are given as arguments, locates small square frames
// instead, and prints 1 for each located frame and 0 for the others.
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <vector>

#include <dotpose/locate.hpp>
#include <dotpose/tools/evaluate.hpp>
#include <dotpose/tools/simulate.hpp>

namespace {

using namespace dotpose;

constexpr int kFrames = 200;
constexpr std::uint64_t kSeed = 606;

}  // namespace

/// The counted functions have C linkage to let callgrind select them by name.
extern "C" [[gnu::noinline]] void count_fresh_frame(const ImageView& image, Locator& locator) {
    locator.locate(image);
}
extern "C" [[gnu::noinline]] void count_tracked_frame(const ImageView& image,
                                                      const Prediction& prediction,
                                                      Locator& locator) {
    locator.locate(image, prediction);
}
extern "C" [[gnu::noinline]] void count_small_frame(const ImageView& image, Locator& locator) {
    locator.locate(image);
}
/// Locates a frame whose code is not given. count_frame_in_code locates the same frame with the
/// code given. The difference between the instruction counts of the two functions is the cost of
/// detecting the code.
extern "C" [[gnu::noinline]] CodeReading count_frame_in_any_code(const ImageView& image,
                                                                 Locator& locator) {
    return locator.locate_in_any_code(image, {});
}
extern "C" [[gnu::noinline]] void count_frame_in_code(const ImageView& image, Locator& locator) {
    locator.locate(image);
}

namespace {

/// Locates the frame with `count_frame_in_any_code` and with `count_frame_in_code`, and returns
/// true. Calls neither function and returns false if the first attempt does not locate the frame in
/// the `anoto` code.
bool compare_codes(const ImageView& image, Locator& locator) {
    const auto is_settled = [](const CodeReading& reading) {
        return reading.fix.status == Status::ok && reading.fix.attempt == Attempt::first &&
               reading.code == CodeVariant::anoto;
    };
    const bool is_ordinary = is_settled(locator.locate_in_any_code(image, {}));
    if (is_ordinary) {
        count_frame_in_any_code(image, locator);
        count_frame_in_code(image, locator);
    }
    DeviceOptions options = locator.options();
    options.code = CodeVariant::anoto;
    locator.set_options(options);
    return is_ordinary;
}

int count_small_frames(int side_px, double spacing_px) {
    constexpr double kSpacing_mm = 0.508;  // spacing of the dots on the simulated sheet
    Setup setup;
    setup.seed = kSeed;
    setup.camera.width_px = setup.camera.height_px = side_px;
    setup.camera.mm_per_px = kSpacing_mm / spacing_px;
    const auto memory = std::make_unique<SmallMemory>();
    for (int i = 0; i < kFrames; ++i) {
        const GreyImage image = render(draw_shot(setup, static_cast<std::uint64_t>(i)));
        Locator locator(*memory, DeviceOptions{});
        count_small_frame(image.view(), locator);
        std::printf("%d\n", locator.trace().fix.status == Status::ok ? 1 : 0);
    }
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc == 3) return count_small_frames(std::atoi(argv[1]), std::atof(argv[2]));
    Setup setup;
    setup.seed = kSeed;
    const auto memory = std::make_unique<SmallMemory>();
    Locator locator(*memory, DeviceOptions{});
    int in_any_code = 0;
    for (int i = 0; i < kFrames; ++i) {
        const GreyImage image = render(draw_shot(setup, static_cast<std::uint64_t>(i)));
        count_fresh_frame(image.view(), locator);
        const Fix fix = locator.trace().fix;
        if (fix.status != Status::ok) return 1;
        // The prediction is off by a fifth of a spacing and by one degree, as if the robot had
        // moved.
        constexpr std::int32_t kDegree_bam = 11930465;
        const Prediction prediction =
            moved(Prediction::like(fix), CodeVariant::anoto, {65536 / 5, 0}, kDegree_bam,
                  fix.pattern_from_image.centre_q8);
        count_tracked_frame(image.view(), prediction, locator);
        if (locator.trace().fix.attempt != Attempt::tracked) return 1;
        in_any_code += compare_codes(image.view(), locator) ? 1 : 0;
    }
    std::printf("%d %d\n", kFrames, in_any_code);
}
