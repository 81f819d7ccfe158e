// Tests the bits that are sampled from drawn images with known dots.
#include "core/decode/sample_cells.hpp"

#include <gtest/gtest.h>

#include "../canvas.hpp"
#include "../reading.hpp"
#include "core/decode/upright.hpp"
#include "core/detect/paper.hpp"

namespace dotpose::core_test::sample_cells_test {
namespace {

using namespace core;

constexpr std::uint64_t kSeed = 44;

GreyImage drawn(const View& view) {
    GreyImage image = blank(static_cast<int>(view.image_px.x), static_cast<int>(view.image_px.y));
    for (const PlacedDot& dot : pattern_dots(view))
        darken(image, dot.centre_px, 0.1 * view.spacing_px, 0.8);
    return image;
}

/// The cells of a view, sampled from an image.
struct Sampled {
    Sampled(const View& view_, QuarterTurn turn_, const GreyImage& image)
        : view(view_), turn(turn_), owned(64) {
        zero = {static_cast<int>(std::lround(view.at_centre.x)),
                static_cast<int>(std::lround(view.at_centre.y))};
        std::array<std::uint8_t, 400> levels;
        std::array<std::uint8_t, 400> brightest;
        PaperMap paper;
        paper.levels = levels;
        paper.brightest = brightest;
        measure_paper(image.view(), paper);
        const PlaneFromImage plane = plane_from_lattice(lattice_of(view.mesh_turned(turn, zero)),
                                                        fixed(view.centre_px(), 8));
        sample_cells(image.view(), paper, FixedLens{}, plane, owned.grid);
    }
    const Grid& grid() const { return owned.grid; }
    /// Calls use(cell, px, bits, symbol) for each cell, with its position in the image, its bits in
    /// an upright grid, and its symbol in the code.
    template <typename Use>
    void visit(Use use) const {
        for (int j = grid().j0; j < grid().j0 + grid().rows; ++j) {
            for (int i = grid().i0; i < grid().i0 + grid().columns; ++i) {
                const GridCell& cell = grid().at(i, j);
                const FixedVec step = turn({i, j});
                const FixedVec on_pattern{zero.x + step.x, zero.y + step.y};
                const Place at = moved(view.code, view.place, on_pattern.x, on_pattern.y);
                use(cell, view.mesh().at(on_pattern.x, on_pattern.y), turned(turn, cell),
                    symbol_at(view.code, at.cell, at.section));
            }
        }
    }

    View view;
    QuarterTurn turn;
    OwnedGrid owned;
    FixedVec zero;
};

bool is_right(Bits bits, Symbol symbol) {
    return (bits.x > 0) == (x_bit(symbol) == 1) && (bits.y > 0) == (y_bit(symbol) == 1);
}

TEST(SampleCells, ReadsTheBitsOfACleanFrame) {
    Rng rng(kSeed);
    for (int i = 0; i < 20; ++i) {
        View view = random_view(rng);
        view.spacing_px = rng.uniform(8, 16);
        const Sampled sampled(view, QuarterTurn{i % 4}, drawn(view));
        int inside = 0;
        sampled.visit([&](const GridCell& cell, Vec2 at, Bits bits, Symbol symbol) {
            SCOPED_TRACE(testing::Message()
                         << "view " << i << " at " << at.x << ", " << at.y << ", seed " << kSeed);
            // If all four possible positions of the dot are outside the image, the bits of the cell
            // are unknown.
            const double outside = view.spacing_px / 6 + 1;
            if (at.x < -outside || at.y < -outside || at.x > view.image_px.x - 1 + outside ||
                at.y > view.image_px.y - 1 + outside) {
                EXPECT_EQ(cell.x, 0);
                EXPECT_EQ(cell.y, 0);
            }
            // If the whole blurred dot is inside the image, the bits of the cell are known.
            const double margin = view.spacing_px / 6 + 2;
            if (at.x < margin || at.y < margin || at.x > view.image_px.x - 1 - margin ||
                at.y > view.image_px.y - 1 - margin) {
                return;
            }
            ++inside;
            EXPECT_TRUE(is_right(bits, symbol));
            EXPECT_GE(std::min(std::abs(bits.x), std::abs(bits.y)), 40);
            EXPECT_FALSE(cell.is_hidden());
        });
        EXPECT_GE(inside, 40);
    }
}

TEST(SampleCells, CellsUnderABlackStrokeSayNothing) {
    Rng rng(kSeed);
    for (int i = 0; i < 20; ++i) {
        const View view = random_view(rng);
        GreyImage image = drawn(view);
        constexpr int kTop = 50;
        constexpr int kBottom = 66;
        fill(image, 0, kTop, image.width_px, kBottom, 5);
        const Sampled sampled(view, QuarterTurn{i % 4}, image);
        int under = 0;
        int beside = 0;
        sampled.visit([&](const GridCell& cell, Vec2 at, Bits bits, Symbol symbol) {
            SCOPED_TRACE(testing::Message()
                         << "view " << i << " at " << at.x << ", " << at.y << ", seed " << kSeed);
            if (at.x < 8 || at.y < 8 || at.x > 179 || at.y > 111) return;
            if (at.y > kTop && at.y < kBottom - 1) {
                EXPECT_EQ(cell.x, 0);
                EXPECT_EQ(cell.y, 0);
                ++under;
            } else if (at.y < kTop - 0.75 * view.spacing_px ||
                       at.y > kBottom + 0.75 * view.spacing_px) {
                EXPECT_TRUE(is_right(bits, symbol));
                ++beside;
            }
        });
        EXPECT_GE(under, 10);
        EXPECT_GE(beside, 50);
    }
}

}  // namespace
}  // namespace dotpose::core_test::sample_cells_test
