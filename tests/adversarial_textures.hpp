/// Frames without a pattern, computed pixel by pixel.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "altered_pattern.hpp"
#include "dotpose/tools/simulate.hpp"

namespace dotpose::test::detail {

inline std::uint8_t grey(double level) {
    return static_cast<std::uint8_t>(std::clamp(level, 0.0, 255.0) + 0.5);
}

/// Returns an image of the shot's size in which pixel (u, v) has the grey level `level(u, v)`.
template <typename Level>
GreyImage painted(const Shot& shot, Level level) {
    GreyImage image{{}, shot.camera.width_px, shot.camera.height_px};
    image.pixels.reserve(static_cast<std::size_t>(image.width_px * image.height_px));
    for (int v = 0; v < image.height_px; ++v) {
        for (int u = 0; u < image.width_px; ++u)
            image.pixels.push_back(grey(level(u, v)));
    }
    return image;
}

inline GreyImage noise(const Shot& shot, Rng& rng) {
    const int grain_px = 1 + static_cast<int>(rng.below(4));
    const double density = std::exp2(rng.uniform(-8, 0));
    const Imperfections& seen = shot.imperfections;
    std::vector<double> grains(static_cast<std::size_t>(shot.camera.width_px / grain_px + 1));
    return painted(shot, [&](int u, int v) {
        double& grain = grains[static_cast<std::size_t>(u / grain_px)];
        if (u % grain_px == 0 && v % grain_px == 0) {
            const Cell place{static_cast<std::uint32_t>(u / grain_px),
                             static_cast<std::uint32_t>(v / grain_px)};
            const bool is_dark = rng_of(shot.seed, place).uniform() < density;
            grain = seen.paper_level * (is_dark ? seen.ink_reflectance : 1);
        }
        return grain + seen.noise_sigma * rng.normal();
    });
}

/// Sine and cosine of a + k i for i = 0, 1, ..., `count` - 1. With such a table for each image
/// axis, `Wave` computes a plane wave without further trigonometric functions.
struct Phases {
    std::vector<double> sin, cos;

    Phases(double a, double k, int count) {
        for (int i = 0; i < count; ++i) {
            sin.push_back(std::sin(a + k * i));
            cos.push_back(std::cos(a + k * i));
        }
    }
};

/// A plane wave over an image: the sine or cosine of a phase that increases by `ku` per column and
/// by `kv` per row.
class Wave {
  public:
    Wave(const CameraModel& camera, double ku, double kv)
        : across_(0, ku, camera.width_px), down_(0, kv, camera.height_px) {}

    double sin(int u, int v) const {
        const auto i = static_cast<std::size_t>(u);
        const auto j = static_cast<std::size_t>(v);
        return across_.sin[i] * down_.cos[j] + across_.cos[i] * down_.sin[j];
    }
    double cos(int u, int v) const {
        const auto i = static_cast<std::size_t>(u);
        const auto j = static_cast<std::size_t>(v);
        return across_.cos[i] * down_.cos[j] - across_.sin[i] * down_.sin[j];
    }

  private:
    Phases across_, down_;
};

inline GreyImage halftone(const Shot& shot, Rng& rng) {
    const double pitch_px = rng.uniform(6, 16);
    const double angle = rng.uniform(0, std::numbers::pi);
    const double ku = 2 * std::numbers::pi / pitch_px * std::cos(angle);
    const double kv = 2 * std::numbers::pi / pitch_px * std::sin(angle);
    const double middle = rng.uniform(0, 1.6);
    const double swing = rng.uniform(0, 1);
    const double period_px = rng.uniform(20, 200);
    const Wave one(shot.camera, ku, kv);
    const Wave other(shot.camera, -kv, ku);
    const Wave slow(shot.camera, 1 / period_px, 0.7 / period_px);
    const Imperfections& seen = shot.imperfections;
    return painted(shot, [&](int u, int v) {
        const double screen = one.cos(u, v) + other.cos(u, v);
        const double shade = middle + swing * slow.sin(u, v);
        const double ink = std::clamp(2 * (screen - shade) + 0.5, 0.0, 1.0);
        return seen.paper_level * (1 - ink * (1 - seen.ink_reflectance)) +
               seen.noise_sigma * rng.normal();
    });
}

/// Random values at the nodes of a lattice, with linear interpolation between the nodes.
class ValueNoise {
  public:
    ValueNoise(std::uint64_t seed, const CameraModel& camera, double nodes_per_px)
        : nodes_per_px_(nodes_per_px),
          columns_(static_cast<std::size_t>(camera.width_px * nodes_per_px) + 2) {
        const auto rows = static_cast<std::size_t>(camera.height_px * nodes_per_px) + 2;
        for (std::size_t i = 0; i < columns_ * rows; ++i) {
            const Cell node{static_cast<std::uint32_t>(i % columns_),
                            static_cast<std::uint32_t>(i / columns_)};
            nodes_.push_back(rng_of(seed, node).uniform(-1, 1));
        }
    }

    double at(int u, int v) const {
        const double x = u * nodes_per_px_;
        const double y = v * nodes_per_px_;
        const auto i = static_cast<std::size_t>(x);
        const auto j = static_cast<std::size_t>(y);
        const double right = x - static_cast<double>(i);
        const double down = y - static_cast<double>(j);
        const double* above = &nodes_[j * columns_ + i];
        const double* below = above + columns_;
        return (above[0] * (1 - right) + above[1] * right) * (1 - down) +
               (below[0] * (1 - right) + below[1] * right) * down;
    }

  private:
    double nodes_per_px_;
    std::size_t columns_;
    std::vector<double> nodes_;
};

inline GreyImage texture(const Shot& shot, Rng& rng) {
    constexpr unsigned kOctaves = 5;
    const double scale_px = rng.uniform(8, 60);
    const double roughness = rng.uniform(0.5, 1);
    const double contrast = rng.uniform(0.05, 0.7);
    const bool is_binary = rng.below(2) == 0;
    const double threshold = rng.uniform(-0.8, 0.8);
    std::vector<ValueNoise> octaves;
    for (unsigned octave = 0; octave < kOctaves; ++octave)
        octaves.emplace_back(shot.seed + octave, shot.camera, (1U << octave) / scale_px);
    return painted(shot, [&](int u, int v) {
        double value = 0;
        double amplitude = 1;
        for (const ValueNoise& octave : octaves) {
            value += amplitude * octave.at(u, v);
            amplitude *= roughness;
        }
        if (is_binary) value = value < threshold ? -1 : 1;
        return shot.imperfections.paper_level * (1 + contrast * value) / (1 + contrast);
    });
}

}  // namespace dotpose::test::detail
