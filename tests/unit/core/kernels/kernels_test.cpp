// Tests that all forms of a kernel (portable, wide and AVX2) give bit-identical results for any
// input. `kernels_plain_test.cpp` tests that the results are correct.
#include "core/kernels/kernels.hpp"

#include <cmath>
#include <memory>

#include "core/detect/patch.hpp"
#include "random_inputs.hpp"

namespace dotpose::core_test::kernels_test {
namespace {

using namespace core;

constexpr std::uint64_t kSeed = 20261;

class KernelsTest : public ::testing::Test {
  protected:
    /// Calls `use(rng)` `times` times, each time with different random numbers.
    template <typename Use>
    void repeat(int times, Use use) {
        for (int i = 0; i < times; ++i) {
            SCOPED_TRACE("seed " + std::to_string(kSeed) + ", case " + std::to_string(i));
            Rng rng(kSeed, static_cast<std::uint64_t>(i));
            use(rng);
            if (HasFailure()) return;
        }
    }
};

void record_patch(Patch& patch, Record& record) {
    for (int v = 0; v < patch.height_px; ++v) {
        record.add(std::span(patch.row(patch.pixels, v), Patch::kMaxWidth_px), patch.width_px);
        record.add(std::span(patch.row(patch.smoothed, v), Patch::kMaxWidth_px), patch.width_px);
    }
    const int columns = (patch.width_px + Patch::kTileWidth_px - 1) / Patch::kTileWidth_px;
    for (int v = 0; v < patch.height_px; v += Patch::kTileHeight_px) {
        const std::size_t first =
            static_cast<std::size_t>(v / Patch::kTileHeight_px) * Patch::kTilesPerRow;
        record.add(std::span(patch.brightest).subspan(first), columns);
        record.add(std::span(patch.darkness).subspan(first), columns);
    }
}

void record_dots(const PatchDots& dots, Record& record) {
    record.add(dots.count);
    record.add(std::span(dots.x), dots.count);
    record.add(std::span(dots.y), dots.count);
}

void record(const BitLines& lines, Record& record) {
    record.add(lines.bits);
    record.add(lines.valid);
}

/// Returns `count` dots at random positions. The remaining elements of the arrays contain no dots.
std::unique_ptr<PatchDots> random_dots(int count, Rng& rng) {
    auto dots = std::make_unique<PatchDots>();
    dots->count = count;
    for (std::size_t i = 0; i < dots->x.size(); ++i) {
        const bool is_dot = i < static_cast<std::size_t>(count);
        dots->x[i] = is_dot ? number(rng, -112, 112) : kNoDot_px;
        dots->y[i] = is_dot ? number(rng, -80, 80) : 0;
    }
    return dots;
}

TEST_F(KernelsTest, HaveNames) {
    for (const Kernels* form : forms())
        EXPECT_STRNE(form->name, "");
    RecordProperty("forms", static_cast<int>(forms().size()));
}

TEST_F(KernelsTest, PatchesAreTheSame) {
    repeat(60, [](Rng& rng) {
        const int scale = 1 << whole(rng, 0, 2);
        Picture picture(whole(rng, 48 * scale, 300), whole(rng, 48 * scale, 260), whole(rng, 0, 9),
                        rng);
        if (rng.below(2) == 0) picture.draw_dots(rng.uniform(6, 20), rng);
        auto patch = std::make_unique<Patch>();
        ASSERT_TRUE(place_patch(picture.view, picture.view.width_px / 2, picture.view.height_px / 2,
                                224 * scale, 160 * scale, scale, *patch));
        for (std::uint8_t& threshold : patch->thresholds)
            threshold = static_cast<std::uint8_t>(rng.below(256));
        expect_same([&](const Kernels& kernels, Record& record) {
            auto here = std::make_unique<Patch>(*patch);
            kernels.fill_patch(picture.view, *here);
            kernels.smooth_patch(*here);
            record_patch(*here, record);
            kernels.find_minima(*here);
            record_dots(here->dots, record);
        });
    });
}

TEST_F(KernelsTest, WavesAreTheSame) {
    repeat(40, [](Rng& rng) {
        const auto dots = random_dots(whole(rng, 0, 64), rng);
        const float per_px = number(rng, 0.02, 0.2);
        expect_same([&](const Kernels& kernels, Record& record) {
            record.add(
                kernels.strongest_waves(dots->x.data(), dots->y.data(), dots->count, per_px));
            record.add(kernels.strongest_skewed_waves(dots->x.data(), dots->y.data(), dots->count,
                                                      per_px));
        });
    });
}

TEST_F(KernelsTest, SumsOverCellsAreTheSame) {
    repeat(100, [](Rng& rng) {
        const auto dots = random_dots(whole(rng, 0, 400), rng);
        const double tilt = rng.below(2) == 0 ? 0 : 0.001;
        const FloatPlane plane = random_plane(rng, rng.uniform(5, 30), tilt, tilt / 100);
        const CellPass pass{number(rng, 10, 120), number(rng, 0.1, 0.5),
                            rng.below(2) == 0 ? 0.0F : number(rng, 0.1, 0.2), rng.below(2) == 0};
        expect_same([&](const Kernels& kernels, Record& record) {
            record.add(kernels.sum_cells(*dots, plane, pass));
        });
    });
}

TEST_F(KernelsTest, CellsReadAreTheSame) {
    repeat(60, [](Rng& rng) {
        const auto dots = random_dots(whole(rng, 0, 700), rng);
        const FloatPlane plane = random_plane(rng, rng.uniform(3, 20), 0.001, 1e-5);
        const float displacement = number(rng, 0.1, 0.25);
        expect_same([&](const Kernels& kernels, Record& all) {
            BitLines columns;
            BitLines rows;
            kernels.read_cells(*dots, plane, displacement, columns, rows);
            record(columns, all);
            record(rows, all);
        });
    });
}

TEST_F(KernelsTest, ScoresOfLinesAreTheSame) {
    repeat(300, [](Rng& rng) {
        const std::uint64_t bits = rng.bits();
        const int length = whole(rng, 0, 64);
        std::uint64_t valid =
            length == 0 ? 0 : ~std::uint64_t{0} >> (64 - length) << whole(rng, 0, 64 - length);
        if (rng.below(2) == 0) valid &= rng.bits();
        expect_same([&](const Kernels& kernels, Record& record) {
            ScoredLine line;
            kernels.score_line(bits, valid, line);
            record.add(line.scores);
            record.add(line.best.score);
            record.add(line.best.margin);
        });
    });
}

/// A random view of an image of the given size, and memory for its rolls.
struct RandomView {
    CellsInView view;
    std::vector<std::uint8_t> rolls;

    RandomView(int width_px, int height_px, double spacing_px, double tilt, Rng& rng)
        : rolls(2 * kMaxLinesInView) {
        for (std::uint8_t& roll : rolls)
            roll = static_cast<std::uint8_t>(rng.below(63));
        view.plane = random_plane(rng, spacing_px, tilt / spacing_px, tilt / 1e4);
        view.width_px = static_cast<float>(width_px);
        view.height_px = static_cast<float>(height_px);
        view.centre_x = (view.width_px - 1) / 2;
        view.centre_y = (view.height_px - 1) / 2;
        view.margin_px = 1.7F;
        view.reach_px = number(rng, 20, 400);
        view.displacement = 0.167F;
        view.windows = rng.below(2) == 0 ? Windows::on_dots : Windows::on_intersections;
        view.step = rng.below(3) == 0 ? whole(rng, 2, 80) : 1;
        if (rng.below(3) == 0)
            view.lens = {number(rng, -2e-6, 2e-6), number(rng, -5, 5), number(rng, -5, 5)};
        view.columns = whole(rng, 1, 120);
        view.rows = whole(rng, 1, 120);
        view.first_column = whole(rng, -view.columns, 0);
        view.first_row = whole(rng, -view.rows, 0);
        view.column_rolls = rolls.data();
        view.row_rolls = rolls.data() + kMaxLinesInView;
    }
};

TEST_F(KernelsTest, ListedCellsAreTheSame) {
    repeat(200, [](Rng& rng) {
        RandomView random(whole(rng, 64, 700), whole(rng, 64, 500), rng.uniform(5, 40),
                          rng.below(2) * 0.02, rng);
        if (rng.below(3) == 0) random.view.windows = Windows::none;
        random.view.limits_intersections = rng.below(2) == 0;
        const int capacity = rng.below(2) == 0 ? 4096 : whole(rng, 8, 100);
        expect_same([&](const Kernels& kernels, Record& record) {
            DotTable table(capacity);
            kernels.list_cells(random.view, table.dots);
            EXPECT_LE(table.dots.count, capacity);
            table.record_places(record);
        });
    });
}

TEST_F(KernelsTest, ShiftsAreTheSame) {
    repeat(60, [](Rng& rng) {
        Picture picture(whole(rng, 64, 250), whole(rng, 64, 250), whole(rng, 0, 9), rng);
        if (rng.below(2) == 0) picture.draw_dots(rng.uniform(6, 20), rng);
        DotTable table(whole(rng, 1, 90));
        table.dots.count = table.dots.capacity();
        for (std::size_t i = 0; i < static_cast<std::size_t>(table.dots.count); ++i) {
            table.dots.window_u[i] = whole(rng, -5, picture.view.width_px + 5);
            table.dots.window_v[i] = whole(rng, -5, picture.view.height_px + 5);
        }
        const int step_px = whole(rng, 1, 4);
        const int max_px = whole(rng, 1, 8 * step_px);
        expect_same([&](const Kernels& kernels, Record& record) {
            FixedVec shift;
            int cut_q8 = 0;
            record.add(
                kernels.find_shift(picture.view, table.dots, max_px, step_px, shift, cut_q8));
            record.add(shift);
            record.add(cut_q8);
        });
    });
}

TEST_F(KernelsTest, WindowsAreTheSame) {
    repeat(80, [](Rng& rng) {
        Picture picture(whole(rng, 64, 400), whole(rng, 64, 300), whole(rng, 0, 9), rng);
        const double spacing_px = rng.uniform(5, 80);
        if (rng.below(4) != 0) picture.draw_dots(spacing_px, rng);
        RandomView random(picture.view.width_px, picture.view.height_px, spacing_px,
                          rng.below(2) * 0.03, rng);
        random.view.step = 1;
        random.view.first_column = random.view.first_row = -60;
        const WindowOptions options{static_cast<float>(spacing_px), number(rng, 0.2, 0.5),
                                    whole(rng, 10, 220)};
        const float window_radius_px = number(rng, 3.3, kMaxCentroidRadius_px);
        DotTable listed(4096);
        portable_kernels().list_cells(random.view, listed.dots);
        expect_same([&](const Kernels& kernels, Record& record) {
            DotTable table(listed);
            kernels.measure_windows(picture.view, random.view, options, table.dots);
            table.record_measures(record);
            kernels.refine_centres(picture.view, random.view, window_radius_px, table.dots);
            table.record_measures(record);
        });
    });
}

TEST_F(KernelsTest, LevelsAndCentresOfPredictedDotsAreTheSame) {
    repeat(80, [](Rng& rng) {
        Picture picture(whole(rng, 64, 400), whole(rng, 64, 300), whole(rng, 0, 9), rng);
        const double spacing_px = rng.uniform(8, 13);
        if (rng.below(4) != 0) picture.draw_dots(spacing_px, rng);
        RandomView random(picture.view.width_px, picture.view.height_px, spacing_px,
                          rng.below(2) * 0.03, rng);
        random.view.first_column = random.view.first_row = -60;
        const int dot_contrast_q8 = whole(rng, 0, 256);
        DotTable listed(4096);
        portable_kernels().list_cells(random.view, listed.dots);
        expect_same([&](const Kernels& kernels, Record& all) {
            DotTable table(listed);
            BitLines columns;
            BitLines rows;
            all.add(kernels.read_levels(picture.view, random.view, dot_contrast_q8, table.dots,
                                        &columns, &rows));
            record(columns, all);
            record(rows, all);
            all.add(kernels.find_centres(picture.view, random.view, 1, 0, table.dots));
            all.add(kernels.find_centres(picture.view, random.view, 3, 0.84F, table.dots));
            table.record_measures(all);
        });
    });
}

TEST_F(KernelsTest, BitsReadAreTheSame) {
    repeat(100, [](Rng& rng) {
        const double spacing_px = rng.uniform(5, 30);
        const FloatPlane plane = random_plane(rng, spacing_px, 0.01 / spacing_px, 1e-7);
        const DotTable table = random_measures(plane, whole(rng, 0, 5000), 0.167F, rng);
        expect_same([&](const Kernels& kernels, Record& all) {
            BitLines columns;
            BitLines rows;
            all.add(kernels.read_bits(table.dots, plane, 0.167F, &columns, &rows));
            all.add(kernels.read_bits(table.dots, plane, 0.167F, nullptr, nullptr));
            record(columns, all);
            record(rows, all);
        });
    });
}

TEST_F(KernelsTest, SumsOfFitsAreTheSame) {
    repeat(100, [](Rng& rng) {
        const double spacing_px = rng.uniform(5, 30);
        const FloatPlane plane = random_plane(rng, spacing_px, 0.01 / spacing_px, 1e-7);
        const DotTable table = random_measures(plane, whole(rng, 0, 500), 0.167F, rng);
        const float limit = number(rng, 0.001, 0.05);
        const float reach = number(rng, 30, 400);
        const float scale = number(rng, 3, 40);
        expect_same([&](const Kernels& kernels, Record& record) {
            record.add(kernels.sum_fit(table.dots, plane, 0.167F, scale, limit));
            const BlockSums blocks = kernels.sum_blocks(table.dots, plane, 0.167F, limit, reach, 6);
            for (std::size_t b = 0; b < 36; ++b)
                record.add(blocks.all[b]);
            record.add(blocks.squares);
        });
    });
}

TEST_F(KernelsTest, SimilarPlacesAreTheSame) {
    repeat(300, [](Rng& rng) {
        const auto code = static_cast<CodeVariant>(rng.below(3));
        const code::Basis& basis = code::basis(code);
        std::array<std::uint32_t, 4> own;
        for (std::size_t k = 0; k < own.size(); ++k)
            own[k] = rng.below(basis[k].length);
        StepLosses steps;
        steps.count = whole(rng, 0, 63);
        for (std::uint8_t& parts : steps.parts)
            parts = static_cast<std::uint8_t>(whole(rng, 0, StepLosses::kLimitParts));
        std::vector<LineLoss> lines;
        const int dearest = whole(rng, 0, 12);
        const int count = whole(rng, 1, 64);
        for (int line = 0; line < count; ++line) {
            lines.push_back({static_cast<std::uint8_t>(line),
                             static_cast<std::uint8_t>(whole(rng, 0, dearest))});
        }
        std::stable_sort(lines.begin(), lines.end(),
                         [](LineLoss a, LineLoss b) { return a.loss > b.loss; });
        const int enough = whole(rng, 1, 40);
        const int unlisted_limit = whole(rng, 1, 40);
        const auto sequences = static_cast<unsigned>(whole(rng, 1, 15));
        expect_same([&](const Kernels& kernels, Record& record) {
            for (std::size_t k = 0; k < own.size(); ++k)
                record.add(kernels.find_similar_places(basis[k], own[k], steps));
            SimilarPlaceList list;
            list.unlisted_limit = unlisted_limit;
            record.add(kernels.list_similar_places(basis, own, sequences, lines, enough, list));
            record.add(std::span(list.places), list.count);
            record.add(list.unlisted_count);
        });
    });
}

TEST_F(KernelsTest, FarAlternativesAreTheSame) {
    repeat(100, [](Rng& rng) {
        FarAlternatives sets;
        for (std::size_t i = 0; i < 5; ++i) {
            sets.equal[i] = number(rng, 0.01, 0.2);
            sets.number[i] = number(rng, 1e4, 1e9);
        }
        std::vector<float> best(static_cast<std::size_t>(whole(rng, 8, 64)));
        for (float& odds : best)
            odds = std::ldexp(1.0F, -whole(rng, 0, 60));
        const int max_shared = whole(rng, 5, 7);
        expect_same([&](const Kernels& kernels, Record& record) {
            record.add(kernels.sum_far_alternatives(best, max_shared, sets));
        });
    });
}

}  // namespace
}  // namespace dotpose::core_test::kernels_test
