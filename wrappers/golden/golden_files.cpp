// Writes frames and the exact bits of their fixes. The tests of the wrappers compare their fixes
// with these bits.
//
//   dotpose_golden_files DIRECTORY [TIMES]
//
// Writes two files for each set. The sets are `nominal` (200 frames), `hard` (150 frames) and `vga`
// (40 frames). The numbers of frames are multiplied by TIMES (default: 1).
//
//   SET.frames  a sequence of binary PGM images, two for each frame: the frame, and the frame after
//               a small motion of the camera, for the tracked attempt
//   SET.csv     a line for each combination of a frame and a method (locate, tracked, any_code,
//               device); wrappers/golden/README.md describes the columns
//
// The frames are the same as in accuracy/golden.cpp.
#include <bit>
#include <concepts>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

#include <fmt/core.h>
#include <fmt/ranges.h>

#include "dotpose/code_evidence.hpp"
#include "dotpose/locate.hpp"
#include "dotpose/tools/simulate.hpp"

namespace {

using namespace dotpose;

constexpr std::uint64_t kSeed = 2424;

struct Set {
    const char* name;
    Preset preset;
    std::uint64_t frames;
    int width_px;
    int height_px;
};
constexpr Set kSets[] = {{"nominal", Preset::nominal, 200, 188, 120},
                         {"hard", Preset::hard, 150, 188, 120},
                         {"vga", Preset::nominal, 40, 640, 480}};

struct CloseFile {
    void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

File create(const std::string& path) {
    File file(std::fopen(path.c_str(), "wb"));
    if (!file) {
        std::perror(path.c_str());
        std::exit(EXIT_FAILURE);
    }
    return file;
}

void write(const GreyImage& image, std::FILE* file) {
    fmt::print(file, "P5\n{} {}\n255\n", image.width_px, image.height_px);
    std::fwrite(image.pixels.data(), 1, image.pixels.size(), file);
}

/// Collects the numbers of a line, in column order. Floating-point numbers are stored as
/// hexadecimal bit patterns.
class Numbers {
  public:
    template <std::integral Int>
    void put(Int value) {
        all_.push_back(fmt::format("{}", std::int64_t{value}));
    }
    template <typename Enum>
    requires std::is_enum_v<Enum>
    void put(Enum value) { put(static_cast<int>(value)); }
    void put(float value) {
        all_.push_back(fmt::format("{:08x}", std::bit_cast<std::uint32_t>(value)));
    }
    void put(double value) {
        all_.push_back(fmt::format("{:016x}", std::bit_cast<std::uint64_t>(value)));
    }
    void put(const Place& place) {
        put(place.cell.x);
        put(place.cell.y);
        put(place.section.u);
        put(place.section.v);
    }
    void put(const PlaneFromImage& plane) {
        for (const FixedVec vec : {plane.centre_q8, plane.at_centre_q16, plane.du_q24, plane.dv_q24,
                                   plane.perspective_q30}) {
            put(vec.x);
            put(vec.y);
        }
        put(plane.lens_q40);
    }
    /// Stores the covariance, with lengths converted from spacings to another unit. `unit` is the
    /// length of a spacing in this unit.
    void put_covariance(const Fix& fix, double unit) {
        const double units[] = {unit, unit, 1};
        for (int i = 0; i < 9; ++i) {
            const auto value = static_cast<double>(fix.covariance[i / 3][i % 3]);
            put(static_cast<float>(units[i / 3] * units[i % 3] * value));
        }
    }
    std::string joined() const { return fmt::format("{}", fmt::join(all_, ",")); }

  private:
    std::vector<std::string> all_;
};

/// Returns all numbers in a fix, separated by commas. The status of the fix must be ok.
std::string numbers_of(const Fix& fix) {
    Numbers all;
    const double mm = fix.spacing_mm();
    constexpr double spacings = 1;
#define FIX_NUMBER(type, name, member, doc) all.put(fix.member);
#define FIX_EVIDENCE(type, name, is_known, doc) all.put(fix.name);
#define FIX_VALUE(type, name, value, none, doc) all.put(fix.value);
#define FIX_MATRIX(unit, name, doc) all.put_covariance(fix, unit);
#include "dotpose/fix_fields.def"
    return all.joined();
}

class Lines {
  public:
    Lines(std::FILE* file, std::uint64_t index) : file_(file), index_(index) {}

    void add(const char* way, const Fix& fix) {
        fmt::print(file_, "{},{},{},{}", index_, way, static_cast<int>(fix.status), fix.dots_seen);
        if (fix.status == Status::ok) fmt::print(file_, ",{}", numbers_of(fix));
        fmt::print(file_, "\n");
    }

  private:
    std::FILE* file_;
    std::uint64_t index_;
};

/// Locates a frame with every method. Also locates the next frame, with a prediction from the fix
/// of this frame.
void locate(const GreyImage& image, const GreyImage& next, Lines lines) {
    const auto memory = std::make_unique<LargeMemory>();
    Locator locator(*memory, DeviceOptions{});
    const Fix fix = locator.locate(image.view());
    lines.add("locate", fix);
    if (fix.status == Status::ok)
        lines.add("tracked", locator.locate(next.view(), Prediction::like(fix)));
    lines.add("any_code", locator.locate_in_any_code(image.view(), {}).fix);
    if (image.width_px > 188) return;
    DeviceMemory device_memory;
    lines.add("device", DeviceLocator(device_memory).locate(image.view()));
}

/// Returns the shot after the camera has moved by a quarter of a spacing along each axis and turned
/// by 2 degrees.
Shot moved(Shot shot) {
    constexpr double kStep = 0.25;
    constexpr double kTurn_rad = 0.035;
    shot.pose.fraction_x += kStep;
    shot.pose.fraction_y -= kStep;
    shot.pose.theta_rad += kTurn_rad;
    ++shot.seed;
    return shot;
}

void write(const Set& set, std::uint64_t times, const std::string& directory) {
    const File frames = create(directory + "/" + set.name + ".frames");
    const File csv = create(directory + "/" + set.name + ".csv");
    Setup setup;
    setup.preset = set.preset;
    setup.seed = kSeed;
    setup.camera.width_px = set.width_px;
    setup.camera.height_px = set.height_px;
    for (std::uint64_t index = 0; index < set.frames * times; ++index) {
        const Shot shot = draw_shot(setup, index);
        const GreyImage image = render(shot);
        const GreyImage next = render(moved(shot));
        write(image, frames.get());
        write(next, frames.get());
        locate(image, next, Lines(csv.get(), index));
    }
}

}  // namespace

int main(int argc, char** argv) {
    const std::uint64_t times = argc == 3 ? std::strtoull(argv[2], nullptr, 10) : 1;
    if (argc < 2 || argc > 3 || times == 0) {
        std::fputs("usage: dotpose_golden_files DIRECTORY [TIMES]\n", stderr);
        return 2;
    }
    std::filesystem::create_directories(argv[1]);
    for (const Set& set : kSets)
        write(set, times, argv[1]);
}
