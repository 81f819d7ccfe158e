// Locates nominal frames of 188 x 120 px for bench/instructions, which counts the instructions of
// the two calls. Prints the number of frames.
#include <cstdio>
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

/// The tool that counts instructions finds these functions by their names.
extern "C" [[gnu::noinline]] void count_fresh_frame(const ImageView& image, Locator& locator) {
    locator.locate(image);
}
extern "C" [[gnu::noinline]] void count_tracked_frame(const ImageView& image,
                                                      const Prediction& prediction,
                                                      Locator& locator) {
    locator.locate(image, prediction);
}

int main() {
    Setup setup;
    setup.seed = kSeed;
    const auto memory = std::make_unique<SmallMemory>();
    Locator locator(*memory);
    for (int i = 0; i < kFrames; ++i) {
        const GreyImage image = render(draw_shot(setup, static_cast<std::uint64_t>(i)));
        count_fresh_frame(image.view(), locator);
        const Fix fix = locator.trace().fix;
        if (fix.status != Status::ok) return 1;
        // A robot that has gone on by a fifth of a spacing and turned by a degree.
        constexpr std::int32_t kDegree_bam = 11930465;
        const Prediction prediction = moved(Prediction::like(fix), Profile::anoto, {65536 / 5, 0},
                                            kDegree_bam, fix.pattern_from_image.centre_q8);
        count_tracked_frame(image.view(), prediction, locator);
        if (locator.trace().fix.attempt != Attempt::tracked) return 1;
    }
    std::printf("%d\n", kFrames);
}
