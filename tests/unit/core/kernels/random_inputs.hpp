// Random inputs for kernels, and records of kernel outputs that can be compared bit by bit.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include <gtest/gtest.h>

#include "code/basis.hpp"
#include "core/kernels/select.hpp"
#include "dotpose/tools/random.hpp"

namespace dotpose::core_test {

using core::kNoDot_px;
using core::MeasuredDots;
using core::Patch;
using core::PatchDots;

/// Returns the kernel implementations (portable, wide, AVX2) that this processor can run.
inline std::vector<const core::Kernels*> forms() {
    std::vector<const core::Kernels*> all{&core::portable_kernels(), &core::wide_kernels()};
    if (core::avx2_kernels() != nullptr) all.push_back(core::avx2_kernels());
    return all;
}

/// The output of a kernel as bytes.
class Record {
  public:
    /// Adds the bytes of a value, whose type must have no padding.
    template <typename T>
    void add(const T& value) {
        static_assert(std::is_trivially_copyable_v<T>);
        const auto* bytes = reinterpret_cast<const unsigned char*>(&value);
        bytes_.insert(bytes_.end(), bytes, bytes + sizeof value);
    }
    template <typename T, std::size_t kExtent>
    void add(std::span<T, kExtent> values, int count) {
        for (const auto& value : values.first(static_cast<std::size_t>(count)))
            add(value);
    }
    bool operator==(const Record&) const = default;

  private:
    std::vector<unsigned char> bytes_;
};

/// Calls `run(kernels, record)` for every kernel implementation, and expects every record to equal
/// that of the portable implementation.
template <typename Run>
void expect_same(Run run) {
    Record expected;
    run(core::portable_kernels(), expected);
    for (const core::Kernels* form : forms()) {
        Record found;
        run(*form, found);
        EXPECT_TRUE(found == expected) << form->name;
    }
}

inline constexpr std::uint64_t kPlainSeed = 20262;

/// Calls `use(kernels, rng)` `times` times for each kernel implementation. The random numbers
/// differ between calls, but are the same for all implementations.
template <typename Use>
void repeat_with_each_form(int times, Use use) {
    for (const core::Kernels* form : forms()) {
        for (int i = 0; i < times && !testing::Test::HasFailure(); ++i) {
            SCOPED_TRACE(std::string(form->name) + ", seed " + std::to_string(kPlainSeed) +
                         ", case " + std::to_string(i));
            Rng rng(kPlainSeed, static_cast<std::uint64_t>(i));
            use(*form, rng);
        }
    }
}

inline int whole(Rng& rng, int least, int most) {
    return least + static_cast<int>(rng.below(static_cast<std::uint32_t>(most - least + 1)));
}
inline float number(Rng& rng, double least, double most) {
    return static_cast<float>(rng.uniform(least, most));
}

/// An image and its pixel buffer. The padding bytes between rows are random.
struct Picture {
    std::vector<std::uint8_t> pixels;
    ImageView view;

    Picture(int width_px, int height_px, int padding, Rng& rng)
        : pixels(static_cast<std::size_t>((width_px + padding) * height_px)),
          view{nullptr, width_px, height_px, width_px + padding} {
        for (std::uint8_t& pixel : pixels)
            pixel = static_cast<std::uint8_t>(rng.below(256));
        view.pixels = pixels.data();
    }
    int at(int u, int v) const { return view.row(v)[u]; }
    int at_or_white(int u, int v) const {
        return u >= 0 && v >= 0 && u < view.width_px && v < view.height_px ? at(u, v) : 255;
    }
    /// Draws paper with dots about `spacing_px` apart.
    void draw_dots(double spacing_px, Rng& rng) {
        for (std::uint8_t& pixel : pixels)
            pixel = static_cast<std::uint8_t>(200 + rng.below(40));
        for (double y = 0; y < view.height_px; y += spacing_px) {
            for (double x = 0; x < view.width_px; x += spacing_px)
                draw_dot(x + rng.uniform(-2, 2), y + rng.uniform(-2, 2), rng);
        }
    }

  private:
    void draw_dot(double x, double y, Rng& rng) {
        for (int v = static_cast<int>(y) - 2; v <= static_cast<int>(y) + 2; ++v) {
            for (int u = static_cast<int>(x) - 2; u <= static_cast<int>(x) + 2; ++u) {
                if (u < 0 || v < 0 || u >= view.width_px || v >= view.height_px) continue;
                pixels[static_cast<std::size_t>(v * view.stride_bytes + u)] =
                    static_cast<std::uint8_t>(30 + rng.below(90));
            }
        }
    }
};

/// Measured dots and the memory that contains them.
class DotTable {
  public:
    explicit DotTable(int capacity) {
        const auto size = static_cast<std::size_t>(capacity + 8);
        for (auto& numbers : floats_)
            numbers.resize(size);
        for (auto& numbers : ints_)
            numbers.resize(size);
        dots.column = floats_[0];
        dots.row = floats_[1];
        dots.x = floats_[2];
        dots.y = floats_[3];
        dots.bits = ints_[0];
        dots.window_u = ints_[1];
        dots.window_v = ints_[2];
        dots.mass = ints_[3];
        dots.sum_u = ints_[4];
        dots.sum_v = ints_[5];
        dots.paper = ints_[6];
    }
    DotTable(const DotTable& other) : DotTable(other.dots.capacity()) {
        dots.count = other.dots.count;
        for (std::size_t i = 0; i < floats_.size(); ++i)
            std::copy(other.floats_[i].begin(), other.floats_[i].end(), floats_[i].begin());
        for (std::size_t i = 0; i < ints_.size(); ++i)
            std::copy(other.ints_[i].begin(), other.ints_[i].end(), ints_[i].begin());
    }
    DotTable& operator=(const DotTable&) = delete;

    void record_places(Record& record) const {
        record.add(dots.count);
        record.add(dots.column, dots.count);
        record.add(dots.row, dots.count);
        record.add(dots.bits, dots.count);
        record.add(dots.window_u, dots.count);
        record.add(dots.window_v, dots.count);
    }
    void record_measures(Record& record) const {
        record.add(dots.mass, dots.count);
        record.add(dots.sum_u, dots.count);
        record.add(dots.sum_v, dots.count);
        record.add(dots.paper, dots.count);
        record.add(dots.x, dots.count);
        record.add(dots.y, dots.count);
    }

    MeasuredDots dots;

  private:
    std::array<std::vector<float>, 4> floats_;
    std::array<std::vector<std::int32_t>, 7> ints_;
};

/// Returns the map from an image to the pattern. The pattern is rotated, and the camera has some
/// tilt and lens distortion.
inline core::FloatPlane random_plane(Rng& rng, double spacing_px, double tilt, double bend) {
    const double turn = rng.uniform(0, 6.283);
    const double unit = 1 / spacing_px;
    core::FloatPlane plane;
    plane.at_x = number(rng, -0.5, 0.5);
    plane.at_y = number(rng, -0.5, 0.5);
    plane.du_x = static_cast<float>(std::cos(turn) * unit);
    plane.du_y = static_cast<float>(std::sin(turn) * unit);
    plane.dv_x = static_cast<float>(-std::sin(turn) * unit * rng.uniform(0.95, 1.05));
    plane.dv_y = static_cast<float>(std::cos(turn) * unit * rng.uniform(0.95, 1.05));
    plane.tilt_x = number(rng, -tilt, tilt);
    plane.tilt_y = number(rng, -tilt, tilt);
    plane.bend = number(rng, -bend, bend);
    return plane;
}

/// Returns `count` measured dots, row by row. An eighth of the dots are missing, and a tenth have a
/// wrong x bit.
inline DotTable random_measures(const core::FloatPlane& plane, int count, float displacement,
                                Rng& rng) {
    DotTable table(count);
    MeasuredDots& dots = table.dots;
    dots.count = count;
    const int side = std::max(static_cast<int>(std::sqrt(count)), 1);
    const float determinant = plane.du_x * plane.dv_y - plane.dv_x * plane.du_y;
    for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k) {
        const int column = static_cast<int>(k) % side - side / 2;
        const int row = static_cast<int>(k) / side - side / 2;
        const int bits = whole(rng, 0, 3);
        const int x_bit = bits & 1;
        const int y_bit = bits >> 1;
        const float a = static_cast<float>(column) - plane.at_x +
                        displacement * static_cast<float>(y_bit - x_bit) + number(rng, -0.1, 0.1);
        const float b = static_cast<float>(row) - plane.at_y +
                        displacement * static_cast<float>(x_bit + y_bit - 1) +
                        number(rng, -0.1, 0.1);
        dots.column[k] = static_cast<float>(column);
        dots.row[k] = static_cast<float>(row);
        dots.bits[k] = rng.below(10) == 0 ? bits ^ 1 : bits;
        const bool is_missing = rng.below(8) == 0;
        dots.x[k] = is_missing ? kNoDot_px : (plane.dv_y * a - plane.dv_x * b) / determinant;
        dots.y[k] = is_missing ? 0 : (plane.du_x * b - plane.du_y * a) / determinant;
    }
    for (std::size_t k = dots.x.size() - 8; k < dots.x.size(); ++k)
        dots.x[k] = kNoDot_px;
    return table;
}

}  // namespace dotpose::core_test
