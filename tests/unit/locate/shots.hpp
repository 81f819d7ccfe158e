// Simulates frames with any grid spacing, and checks their fixes.
#pragma once

#include <cmath>
#include <cstring>
#include <memory>
#include <numbers>

#include <gtest/gtest.h>

#include "core/kernels/select.hpp"
#include "dotpose/locate.hpp"
#include "dotpose/tools/simulate.hpp"
#include "locate/workspace.hpp"

namespace dotpose::core_test {

/// Parameters of a simulated frame. The defaults are those of a nominal frame.
struct ShotSize {
    double spacing_px = 11;
    int width_px = 188;
    int height_px = 120;
    Preset preset = Preset::nominal;
    CodeVariant code = CodeVariant::anoto;
};

inline Shot shot_of(const ShotSize& size, std::uint64_t seed, std::uint64_t index) {
    Setup setup;
    setup.preset = size.preset;
    setup.seed = seed;
    setup.pattern.code = size.code;
    setup.camera.width_px = size.width_px;
    setup.camera.height_px = size.height_px;
    setup.camera.mm_per_px = setup.pattern.spacing_mm / size.spacing_px;
    // The angle of view is the same for all spacings.
    setup.camera.working_distance_mm = 350 * setup.camera.mm_per_px * size.width_px / 188;
    return draw_shot(setup, index);
}

inline double turn_between(double a_rad, double b_rad) {
    return std::abs(std::remainder(a_rad - b_rad, 2 * std::numbers::pi));
}

/// Returns true if the fix has the true section, a position error of less than a fifth of a spacing
/// along each axis, and an angle error of less than two degrees.
inline bool is_right(const Fix& fix, const Shot& shot) {
    return std::abs(fix.x_grid() - x_grid(shot.pose)) < 0.2 &&
           std::abs(fix.y_grid() - y_grid(shot.pose)) < 0.2 &&
           turn_between(fix.theta_rad(), shot.pose.theta_rad) < 0.035 &&
           fix.section == shot.page.pattern.section;
}

/// Expects that two fixes have the same status, pose, counts, residual and covariance. The
/// covariances must be equal bit by bit.
inline void expect_same_bits(const Fix& a, const Fix& b) {
    EXPECT_EQ(a.status, b.status);
    EXPECT_EQ(a.attempt, b.attempt);
    EXPECT_EQ(a.cell, b.cell);
    EXPECT_EQ(a.fraction_x_q16, b.fraction_x_q16);
    EXPECT_EQ(a.fraction_y_q16, b.fraction_y_q16);
    EXPECT_EQ(a.theta_bam, b.theta_bam);
    EXPECT_EQ(a.section, b.section);
    EXPECT_EQ(a.spacing_px_q16, b.spacing_px_q16);
    EXPECT_EQ(a.dots_seen, b.dots_seen);
    EXPECT_EQ(a.dots_used, b.dots_used);
    EXPECT_EQ(a.bit_errors, b.bit_errors);
    EXPECT_EQ(a.p_wrong_log2, b.p_wrong_log2);
    EXPECT_EQ(a.residual_px, b.residual_px);
    EXPECT_EQ(a.displacement_q16, b.displacement_q16);
    EXPECT_EQ(std::memcmp(a.covariance, b.covariance, sizeof a.covariance), 0);
}

/// Returns the kernel implementations (portable, wide, AVX2) that this machine supports.
inline std::vector<const core::Kernels*> kernel_forms() {
    std::vector<const core::Kernels*> forms{&core::portable_kernels(), &core::wide_kernels()};
    if (core::avx2_kernels() != nullptr) forms.push_back(core::avx2_kernels());
    return forms;
}

inline LargeMemory& large_memory() {
    static const auto memory = std::make_unique<LargeMemory>();
    return *memory;
}

inline core::DesktopWorkspace& large_workspace() {
    static const auto workspace = std::make_unique<core::LargeWorkspace>();
    return *workspace;
}

}  // namespace dotpose::core_test
