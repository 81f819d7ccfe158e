// Tests the directions and spacings found for synthetic grids.
#include "core/lattice/axes.hpp"

#include <gtest/gtest.h>

#include "../geometry.hpp"
#include "core/lattice/neighbours.hpp"
#include "core/math/plane.hpp"

namespace dotpose::core_test::axes_test {
namespace {

using namespace core;

constexpr std::uint64_t kSeed = 25;

/// Returns the symmetric edges (paper, figure 4) of the dots closest to the middle of an image.
std::vector<SeedEdge> edges_of(const std::vector<DetectedDot>& dots, Vec2 image_px) {
    std::array<std::uint16_t, kMaxSeeds> seeds;
    const FixedVec centre = fixed({(image_px.x - 1) / 2, (image_px.y - 1) / 2}, 8);
    const auto count = static_cast<std::size_t>(choose_seeds(dots, centre, seeds));
    const auto chosen = std::span<const std::uint16_t>(seeds).first(count);
    std::vector<std::array<std::int16_t, 4>> neighbours(count);
    std::vector<BucketedSeed> memory(count + 1);
    find_neighbours(dots, chosen, memory, neighbours);
    std::vector<SeedEdge> edges(2 * kMaxSeeds);
    edges.resize(static_cast<std::size_t>(connect_symmetric(dots, chosen, neighbours, edges)));
    return edges;
}

Status axes_of(const std::vector<SeedEdge>& edges, Lattice& lattice) {
    std::vector<std::int32_t> memory(2 * edges.size());
    return estimate_axes(edges, memory, lattice);
}

double degrees(Vec2 a) {
    return std::atan2(a.y, a.x) * 180 / std::numbers::pi;
}

TEST(Axes, AreFoundAtAnyAngleAndSpacing) {
    Rng rng(kSeed);
    std::vector<double> length_errors;
    std::vector<double> angle_errors;
    for (const double spacing : {6.0, 7.3, 11.04, 16.0, 27.5, 60.0}) {
        for (int angle = 0; angle < 180; angle += 2) {
            SCOPED_TRACE(testing::Message()
                         << "spacing " << spacing << ", " << angle << " degrees, seed " << kSeed);
            const Vec2 image{17 * spacing, 11 * spacing};
            const Mesh mesh = square_mesh(spacing, radians(angle), {8.3 * spacing, 5.1 * spacing});
            const auto dots = dots_of(
                placed_dots(mesh, 20, image, [&](int, int) { return random_displacement(rng); }));
            Lattice lattice;
            ASSERT_EQ(axes_of(edges_of(dots, image), lattice), Status::ok);
            const Mesh found = mesh_of(lattice);
            for (const Vec2 axis : {found.u, found.v}) {
                length_errors.push_back(std::abs(length(axis) / spacing - 1));
                angle_errors.push_back(std::abs(std::remainder(degrees(axis) - angle, 90)));
            }
            // v is u rotated by 90 degrees, in the direction from +x to +y.
            EXPECT_NEAR(std::remainder(degrees(found.v) - degrees(found.u) - 90, 360), 0, 1e-6);
        }
    }
    // Displacements change the length of an edge by up to a third, so the axes have an error of a
    // few percent. The limit is 5 % because the refinement starts with dots up to 4 cells away,
    // where an error of 5 % is 1/5 cell.
    const auto worst = [](std::vector<double>& errors, double fraction) {
        std::sort(errors.begin(), errors.end());
        return errors[static_cast<std::size_t>(fraction * static_cast<double>(errors.size() - 1))];
    };
    EXPECT_LT(worst(length_errors, 0.98), 0.05);
    EXPECT_LT(worst(length_errors, 1), 0.06);
    EXPECT_LT(worst(angle_errors, 0.98), 2);
    EXPECT_LT(worst(angle_errors, 1), 4);
}

TEST(Axes, AreNearlyExactWithoutDisplacements) {
    for (const double angle : {0.0, 1.0, 30.0, 45.0, 89.0}) {
        const Vec2 image{188, 120};
        const Mesh mesh = square_mesh(11, radians(angle), {93, 60});
        const auto dots = dots_of(placed_dots(mesh, 20, image, [](int, int) { return Vec2{}; }));
        Lattice lattice;
        ASSERT_EQ(axes_of(edges_of(dots, image), lattice), Status::ok) << angle;
        // The distance from a displaced dot to its nearest neighbour is usually shorter than the
        // spacing. The stage lengthens the axes by about 4 % to compensate for this.
        EXPECT_NEAR(length(mesh_of(lattice).u), 11 * 1.043, 0.05) << angle;
        EXPECT_NEAR(std::remainder(degrees(mesh_of(lattice).u) - angle, 90), 0, 0.2) << angle;
    }
}

TEST(Axes, NeedEdgesInTwoDirections) {
    Lattice lattice;
    EXPECT_EQ(axes_of({}, lattice), Status::no_grid);
    const auto edges = [](std::initializer_list<FixedVec> steps, int copies) {
        std::vector<SeedEdge> result;
        for (int i = 0; i < copies; ++i) {
            for (const FixedVec step : steps)
                result.push_back({0, 1, step});
        }
        return result;
    };
    EXPECT_EQ(axes_of(edges({{2816, 0}, {0, 2816}}, 40), lattice), Status::ok);
    EXPECT_EQ(axes_of(edges({{2816, 0}, {0, 2816}}, 2), lattice),
              Status::no_grid);  // too few edges
    EXPECT_EQ(axes_of(edges({{2816, 0}}, 80), lattice), Status::no_grid);
    EXPECT_EQ(axes_of(edges({{2816, 0}, {0, 900}}, 40), lattice),
              Status::no_grid);  // the axes have a length ratio of 3:1
    EXPECT_EQ(axes_of(edges({{2816, 0}, {1900, 2078}}, 40), lattice), Status::no_grid);
    EXPECT_EQ(axes_of(edges({{0, 0}}, 80), lattice), Status::no_grid);
}

TEST(Axes, NearlySquareMeansAboutOneLengthAtAboutARightAngle) {
    const auto judge = [](Vec2 u, Vec2 v) { return is_nearly_square(fixed(u, 16), fixed(v, 16)); };
    for (const double spacing : {6.0, 11.0, 60.0}) {
        for (int angle = 0; angle < 360; angle += 15) {
            const auto at = [&](double length_ratio, double degrees_on) {
                const double a = radians(angle + degrees_on);
                return Vec2{spacing * length_ratio * std::cos(a),
                            spacing * length_ratio * std::sin(a)};
            };
            EXPECT_TRUE(judge(at(1, 0), at(1, 90))) << spacing << ", " << angle;
            EXPECT_TRUE(judge(at(1, 0), at(1.2, 90)));
            EXPECT_TRUE(judge(at(1.15, 0), at(1, 85)));
            EXPECT_TRUE(judge(at(1, 0), at(1, 98)));
            EXPECT_FALSE(judge(at(1, 0), at(1.6, 90)));
            EXPECT_FALSE(judge(at(1.6, 0), at(1, 90)));
            EXPECT_FALSE(judge(at(1, 0), at(1, 60)));
            EXPECT_FALSE(judge(at(1, 0), at(1, 120)));
            EXPECT_FALSE(judge(at(1, 0), at(1, -90)));  // left-handed
        }
    }
}

TEST(Axes, APlaneHasASpacingOfAtLeastFourPixels) {
    for (int angle = 0; angle < 360; angle += 15) {
        const auto judge = [&](double spacing) {
            const Mesh mesh = square_mesh(spacing, radians(angle), {});
            return is_nearly_square(plane_from_lattice(lattice_of(mesh), {}));
        };
        for (const double spacing : {4.2, 6.0, 60.0, 200.0})
            EXPECT_TRUE(judge(spacing)) << spacing;
        for (const double spacing : {0.5, 1.0, 2.0, 3.8})
            EXPECT_FALSE(judge(spacing)) << spacing;
    }
}

TEST(Axes, BlobsFarApartDoNotOverflow) {
    // In the largest image, which is 4096 px wide, 40 blobs in a row can be 100 px apart. No grid
    // has such a spacing, but the sums must not overflow.
    Lattice lattice;
    for (const int step_px : {70, 100, 300, 1000}) {
        std::vector<SeedEdge> edges;
        for (int i = 0; i < 40; ++i) {
            edges.push_back({0, 1, {step_px * 256, i}});
            edges.push_back({0, 1, {-i, step_px * 256}});
        }
        if (axes_of(edges, lattice) != Status::ok) continue;
        EXPECT_NEAR(length(mesh_of(lattice).u), step_px, 0.06 * step_px);
    }
}

}  // namespace
}  // namespace dotpose::core_test::axes_test
