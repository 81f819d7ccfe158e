// Tests that `locate` refuses all frames without a valid position.
#include <memory>
#include <string>

#include <gtest/gtest.h>

#include "dotpose/locate.hpp"
#include "dotpose/tools/simulate.hpp"

namespace dotpose {
namespace {

constexpr std::uint64_t kSeed = 4711;

struct Size {
    int width_px, height_px;
};

Shot shot_of(Preset preset, Size size, std::uint64_t index) {
    Setup setup;
    setup.preset = preset;
    setup.seed = kSeed;
    setup.camera.width_px = size.width_px;
    setup.camera.height_px = size.height_px;
    return draw_shot(setup, index);
}

/// Expects that `locate` refuses the frame because of its contents, not because of invalid
/// arguments.
void expect_refusal(const GreyImage& image, LargeMemory& memory, const std::string& what) {
    const Fix fix = Locator(memory, DeviceOptions{}).locate(image.view());
    switch (fix.status) {
        case Status::ok:
        case Status::bad_argument:
        case Status::image_too_small:
        case Status::image_too_large:
        case Status::bad_window:
            ADD_FAILURE() << what << " gave " << name(fix.status) << " at cell " << fix.cell.x
                          << ", " << fix.cell.y << " with 2^" << fix.p_wrong_log2 << ", seed "
                          << kSeed;
            break;
        default:
            EXPECT_NE(std::string(message(fix.status)), "");
    }
}

void refuse_all(Size size, std::uint64_t shots) {
    const auto memory = std::make_unique<LargeMemory>();
    for (const Scene scene : kScenes) {
        const bool has_density = scene == Scene::noise || scene == Scene::scattered_dots;
        for (std::uint64_t i = 0; i < shots; ++i) {
            const Preset preset = kPresets[static_cast<std::size_t>(i) % kPresets.size()];
            for (const double density : {0.002, 0.02, 0.1, 0.4, 0.8, 1.0}) {
                if (!has_density && density < 1) continue;
                const std::string what = std::string(name(scene)) + ", shot " + std::to_string(i) +
                                         ", density " + std::to_string(density) + ", " +
                                         std::to_string(size.width_px) + " px wide";
                expect_refusal(render_scene(scene, shot_of(preset, size, i), density), *memory,
                               what);
            }
        }
    }
}

TEST(Refusals, DeviceFrames) {
    refuse_all({188, 120}, 45);
}
TEST(Refusals, TheSmallestFrames) {
    refuse_all({64, 64}, 45);
}
TEST(RefusalsAtLength, LargerFrames) {
    refuse_all({640, 480}, 6);
}

TEST(Refusals, TheLargestFrame) {
    const auto memory = std::make_unique<LargeMemory>();
    const Shot shot = shot_of(Preset::clean, {4096, 4096}, 0);
    for (const Scene scene : {Scene::noise, Scene::random_symbols}) {
        expect_refusal(render_scene(scene, shot, 0.3), *memory, name(scene));
    }
}

TEST(Refusals, TheSmallestImages) {
    const auto memory = std::make_unique<LargeMemory>();
    for (const Size size : {Size{1, 1}, Size{1, 4096}, Size{4096, 1}, Size{63, 63}, Size{0, 0}}) {
        GreyImage image{{}, size.width_px, size.height_px};
        image.pixels.assign(
            static_cast<std::size_t>(size.width_px) * static_cast<std::size_t>(size.height_px),
            128);
        EXPECT_EQ(Locator(*memory, DeviceOptions{}).locate(image.view()).status,
                  Status::image_too_small);
    }
}

}  // namespace
}  // namespace dotpose
