// Runs the firmware program on a desktop, to obtain the lines that the devices must print. With
// --predict, writes a file of frames in which each frame is preceded by a prediction, so the
// devices track the frames.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <numbers>

#include <dotpose/tools/grey_image.hpp>
#include <dotpose/tools/random.hpp>

#include "host.hpp"
#include "locate_frames.hpp"

namespace host {
namespace {

std::FILE* input = nullptr;

}  // namespace

bool open(const char* path) {
    input = std::fopen(path, "rb");
    return input != nullptr;
}

bool read(void* bytes, std::size_t size) {
    return std::fread(bytes, 1, size, input) == size;
}

void print(const char* text) {
    std::fputs(text, stdout);
}

}  // namespace host

namespace {

/// Locates frames without a prediction. Writes each located frame, preceded by a prediction.
class Predictor {
  public:
    explicit Predictor(std::uint64_t seed) : rng_(seed) {}

    /// Locates `image`. If this succeeds, writes a prediction that is wrong by up to half a spacing
    /// and 4 degrees, and then the image.
    void write(const dotpose::GreyImage& image) {
        using namespace dotpose;
        const DeviceOptions options = program_options();
        DeviceLocator locator(memory_, options);
        set_known_sheet(locator);
        const Fix fix = locator.locate(image.view());
        if (fix.status != Status::ok) return;
        const double shift_q16 = 32768 * std::sqrt(rng_.uniform());
        const double direction_rad = rng_.uniform(-std::numbers::pi, std::numbers::pi);
        const double turn_rad = rng_.uniform(-4, 4) * std::numbers::pi / 180;
        const Prediction p =
            moved(Prediction::like(fix), options.code,
                  {static_cast<std::int32_t>(shift_q16 * std::cos(direction_rad)),
                   static_cast<std::int32_t>(shift_q16 * std::sin(direction_rad))},
                  static_cast<std::int32_t>(turn_rad * (2147483648.0 / std::numbers::pi)),
                  {(image.width_px - 1) * 128, (image.height_px - 1) * 128});
        const PlaneFromImage& plane = p.pattern_from_image;
        std::printf("T %u %u %d %d %d %d %d %d %d %d %d %d %d\n", p.place.cell.x, p.place.cell.y,
                    p.place.section.u, p.place.section.v, plane.centre_q8.x, plane.centre_q8.y,
                    plane.at_centre_q16.x, plane.at_centre_q16.y, plane.du_q24.x, plane.du_q24.y,
                    plane.dv_q24.x, plane.dv_q24.y, p.displacement_q16);
        std::printf("P5\n%d %d\n255\n", image.width_px, image.height_px);
        std::fwrite(image.pixels.data(), 1, image.pixels.size(), stdout);
    }

  private:
    dotpose::Rng rng_;
    dotpose::DeviceMemoryFor<DOTPOSE_FRAME_WIDTH_PX, DOTPOSE_FRAME_HEIGHT_PX> memory_;
};

/// Reads the frames in a file. If a frame can be located, writes a prediction and the frame to
/// standard output.
int predict(const char* path, std::uint64_t seed) {
    if (!host::open(path)) return 1;
    Predictor predictor(seed);
    dotpose::GreyImage image;
    while (std::fscanf(host::input, "P5 %d %d 255", &image.width_px, &image.height_px) == 2) {
        std::fgetc(host::input);
        image.pixels.resize(static_cast<std::size_t>(image.width_px) *
                            static_cast<std::size_t>(image.height_px));
        if (!host::read(image.pixels.data(), image.pixels.size())) return 1;
        predictor.write(image);
    }
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc == 4 && std::strcmp(argv[1], "--predict") == 0)
        return predict(argv[3], std::strtoull(argv[2], nullptr, 10));
    if (argc != 2) {
        std::fputs(
            "usage: dotpose_frames FRAMES (binary PGM images, one after the other)\n"
            "       dotpose_frames --predict SEED FRAMES >TRACKED_FRAMES\n",
            stderr);
        return 2;
    }
    return locate_frames(argv[1]);
}
