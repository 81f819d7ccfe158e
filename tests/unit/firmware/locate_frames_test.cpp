// Tests the program that is common to all devices. In this test, the functions of `host` read the
// frames from a string and write the output to another string.
#include "locate_frames.hpp"

#include <cstring>
#include <memory>
#include <string>

#include <fmt/core.h>
#include <gtest/gtest.h>

#include "dotpose/locate.hpp"
#include "dotpose/tools/simulate.hpp"
#include "host.hpp"

namespace {

std::string input;
std::string output;
std::size_t taken = 0;

}  // namespace

namespace host {

bool open(const char* path) {
    taken = 0;
    output.clear();
    return std::string(path) == "frames";
}

bool read(void* bytes, std::size_t size) {
    if (input.size() - taken < size) return false;
    std::memcpy(bytes, input.data() + taken, size);
    taken += size;
    return true;
}

void print(const char* text) {
    output += text;
}

}  // namespace host

namespace dotpose {
namespace {

std::string pgm(const GreyImage& image) {
    return fmt::format("P5\n{} {}\n255\n", image.width_px, image.height_px) +
           std::string(image.pixels.begin(), image.pixels.end());
}

GreyImage frame(Preset preset, std::uint64_t index, int width_px = 188, int height_px = 120) {
    Setup setup;
    setup.preset = preset;
    setup.seed = 71;
    setup.camera.width_px = width_px;
    setup.camera.height_px = height_px;
    return render(draw_shot(setup, index));
}

/// Returns the expected output line for a frame, computed by `locate` from the whole image.
std::string expected_line(const GreyImage& image) {
    const auto memory = std::make_unique<DeviceMemory>();
    const Fix fix = DeviceLocator(*memory).locate(image.view());
    return fmt::format("{} {} {} {} {} {} {} {} {} {} {} {} {}\n", name(fix.status), fix.cell.x,
                       fix.cell.y, fix.fraction_x_q16, fix.fraction_y_q16, fix.theta_bam,
                       fix.section.u, fix.section.v, fix.spacing_px_q16, fix.dots_seen,
                       fix.dots_used, fix.bit_errors, fix.p_wrong_log2);
}

TEST(LocateFrames, PrintsALineForEachFrame) {
    input.clear();
    std::string expected;
    for (std::uint64_t i = 0; i < 6; ++i) {
        for (const Preset preset : {Preset::nominal, Preset::hard}) {
            const GreyImage image = frame(preset, i);
            input += pgm(image);
            expected += expected_line(image);
        }
    }
    EXPECT_EQ(locate_frames("frames"), 0);
    EXPECT_EQ(output, expected);
    EXPECT_NE(output.find("ok "), std::string::npos);
}

TEST(LocateFrames, GoesOnAfterAFrameOfAnotherSize) {
    const GreyImage small = frame(Preset::nominal, 1, 40, 30);
    const GreyImage narrow = frame(Preset::nominal, 2, 150, 110);
    input = pgm(small) + pgm(narrow);
    EXPECT_EQ(locate_frames("frames"), 0);
    EXPECT_EQ(output.substr(0, output.find(' ')), "image_too_small");
    EXPECT_EQ(output.substr(output.find('\n') + 1), expected_line(narrow));
}

TEST(LocateFrames, TracksFramesAfterAPrediction) {
    const GreyImage image = frame(Preset::nominal, 3);
    const auto memory = std::make_unique<DeviceMemory>();
    const Prediction p = Prediction::like(DeviceLocator(*memory).locate(image.view()));
    const PlaneFromImage& plane = p.pattern_from_image;
    const auto line_of = [&](int section_u) {
        return fmt::format("T {} {} {} {} {} {} {} {} {} {} {} {} {}\n", p.place.cell.x,
                           p.place.cell.y, section_u, p.place.section.v, plane.centre_q8.x,
                           plane.centre_q8.y, plane.at_centre_q16.x, plane.at_centre_q16.y,
                           plane.du_q24.x, plane.du_q24.y, plane.dv_q24.x, plane.dv_q24.y,
                           p.displacement_q16);
    };
    input = line_of(p.place.section.u) + pgm(image) + line_of((p.place.section.u + 1) % 63) +
            pgm(image) + pgm(image);
    EXPECT_EQ(locate_frames("frames"), 0);
    EXPECT_EQ(output.substr(0, 3), "ok ");
    EXPECT_NE(output.find("\nnot_tracked "), std::string::npos);
    EXPECT_NE(output.find(expected_line(image)), std::string::npos);
    input = "T 1 2 3\nP5\n188 120\n255\n";
    EXPECT_EQ(locate_frames("frames"), 1);
}

TEST(LocateFrames, AnEmptyFileHoldsNoFrame) {
    input.clear();
    EXPECT_EQ(locate_frames("frames"), 0);
    EXPECT_EQ(output, "");
}

TEST(LocateFrames, RefusesWhatIsNoFileOfFrames) {
    EXPECT_EQ(locate_frames("nothing"), 1);
    EXPECT_EQ(output, "cannot open the frames\n");
    for (const char* text : {"P", "P2\n188 120\n255\n", "P5\n188\n", "P5\n-1 2\n255\n", "P5\n",
                             "P5\n189 120\n255\n", "P5\n188 120\n65535\n", "P5\n0 120\n255\n"}) {
        SCOPED_TRACE(text);
        input = text;
        EXPECT_EQ(locate_frames("frames"), 1);
        EXPECT_EQ(output, "not a binary PGM of 8 bits, at most 188 px wide\n");
    }
    const std::string whole = pgm(frame(Preset::nominal, 1));
    input = whole.substr(0, whole.size() - 1);
    EXPECT_EQ(locate_frames("frames"), 1);
    EXPECT_EQ(output, "the file ends within a frame\n");
}

}  // namespace
}  // namespace dotpose
