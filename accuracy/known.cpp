// Measures how many small views of known sheets are located, and how many views of unknown sheets
// are incorrectly located on known sheets. Prints tables in Markdown.
//
//   dotpose_tables known [--frames N] [--foreign N] [--sheets N] [--device] [--seed S]
//
// The exit status is 1 if a fix is wrong.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include <fmt/core.h>

#include "dotpose/tools/simulate.hpp"
#include "tables.hpp"

namespace dotpose::tables {
namespace {

/// Columns and rows of an A4 page printed by `dotpose print`, and the gap between adjacent pages,
/// in cells.
constexpr std::uint32_t kColumns = 393;
constexpr std::uint32_t kRows = 564;
constexpr std::uint32_t kGap = 1024;

struct ViewSize {
    double spacing_px;
    int width_px;
    int height_px;
};

/// A kind of view: its size, its description, and a function that hides some of its dots.
struct HiddenView {
    ViewSize size;
    std::string what;
    std::function<void(Shot&)> hide;
};

std::vector<KnownRegion> sheets_of(std::uint64_t count) {
    std::vector<KnownRegion> sheets;
    for (std::uint64_t i = 0; i < count; ++i) {
        const auto x = static_cast<std::uint32_t>(kGap + i * (kColumns + kGap));
        sheets.push_back({CodeVariant::anoto, {}, {x, kGap}, kColumns, kRows});
    }
    return sheets;
}

struct KnownTally {
    std::uint64_t frames = 0;
    std::uint64_t located = 0;
    std::uint64_t wrong = 0;
    double claimed = 0;  ///< expected number of wrong fixes: the sum of p_wrong

    void operator+=(const KnownTally& other) {
        frames += other.frames;
        located += other.located;
        wrong += other.wrong;
        claimed += other.claimed;
    }
};

Setup setup_of(const ViewSize& size, std::uint64_t seed) {
    Setup setup = tables::setup_of(seed, size.width_px, size.height_px);
    setup.camera.mm_per_px = setup.pattern.spacing_mm / size.spacing_px;
    return setup;
}

/// Returns a random view that is completely inside a page.
Shot draw_on_page(const ViewSize& size, std::uint64_t seed, std::uint64_t index,
                  std::span<const KnownRegion> sheets) {
    Shot shot = draw_shot(setup_of(size, seed), index);
    Rng rng(shot.seed, 1);
    const KnownRegion& sheet = sheets[rng.below(static_cast<std::uint32_t>(sheets.size()))];
    const auto reach = static_cast<std::uint32_t>(
        std::hypot(size.width_px, size.height_px) / 2 / size.spacing_px + 1);
    shot.page.pattern.section = sheet.section;
    shot.pose.cell = {sheet.first.x + reach + rng.below(sheet.columns - 2 * reach),
                      sheet.first.y + reach + rng.below(sheet.rows - 2 * reach)};
    return shot;
}

/// Keeps only the dots in a strip of `rows` rows or columns of the pattern. The strip spans the
/// width of the image at a random height and is tilted by up to 5 degrees.
void leave_strip(Shot& shot, const ViewSize& size, int rows) {
    constexpr double kMaxTurn_rad = 5 * std::numbers::pi / 180;
    Rng rng(shot.seed, 3);
    const int quarter = static_cast<int>(rng.below(4));
    shot.pose.theta_rad = quarter * std::numbers::pi / 2 + rng.uniform(-kMaxTurn_rad, kMaxTurn_rad);
    // Limits the offset of the strip from the image centre to keep the whole strip in view, even at
    // the left and right borders of the image.
    const double tilted = size.width_px * std::tan(kMaxTurn_rad);
    const double room = (size.height_px - tilted) / size.spacing_px - rows - 1;
    const double offset = rng.uniform(-room / 2, room / 2);
    constexpr double kBeyondView = 1000;
    const bool is_along_x = quarter % 2 == 0;
    const CameraPose& pose = shot.pose;
    // Rounds the middle of the strip to put the edges of the strip halfway between intersections.
    const double middle =
        std::round((is_along_x ? y_grid(pose) : x_grid(pose)) + offset) + (rows % 2 == 0 ? 0.5 : 0);
    const PageArea strip{is_along_x ? x_grid(pose) : middle, is_along_x ? middle : y_grid(pose),
                         is_along_x ? kBeyondView : rows / 2.0,
                         is_along_x ? rows / 2.0 : kBeyondView};
    shot.page.areas = {strip};
}

/// Estimates the fraction of the dots that touch the graphics. The estimate is the fraction of
/// pixel positions at which a dot would touch the graphics.
double fraction_hidden(const Shot& shot) {
    constexpr double kPaper = 255;
    constexpr int kDotRadius_px = 2;
    Shot bare = shot;
    bare.imperfections = {};
    bare.imperfections.paper_level = kPaper;
    bare.imperfections.graphics = shot.imperfections.graphics;
    bare.imperfections.sub_pixels = 2;
    bare.page.columns = bare.page.rows = 1;  // the only dot is far outside the view
    const GreyImage image = render(bare);
    int touched = 0;
    int places = 0;
    for (int v = kDotRadius_px; v < image.height_px - kDotRadius_px; ++v) {
        for (int u = kDotRadius_px; u < image.width_px - kDotRadius_px; ++u) {
            bool is_touched = false;
            for (int dv = -kDotRadius_px; dv <= kDotRadius_px; ++dv) {
                const auto first = image.pixels.begin() + (v + dv) * image.width_px + u;
                is_touched |= std::any_of(first - kDotRadius_px, first + kDotRadius_px + 1,
                                          [](int grey) { return grey < 0.8 * kPaper; });
            }
            touched += is_touched;
            ++places;
        }
    }
    return static_cast<double>(touched) / places;
}

/// Draws random strokes and words until they hide between 57.5 % and 62.5 % of the dots.
void cover_with_graphics(Shot& shot) {
    for (std::uint64_t trial = 0;; ++trial) {
        shot.seed = Rng(shot.seed, trial).bits();
        shot.imperfections.graphics = 0;
        double hidden = 0;
        while (hidden < 0.575) {
            ++shot.imperfections.graphics;
            hidden = fraction_hidden(shot);
        }
        if (hidden < 0.625) return;
    }
}

std::vector<HiddenView> hidden_views() {
    std::vector<HiddenView> views;
    const ViewSize wide{20, 640, 480};
    for (const int rows : {3, 4, 5, 6}) {
        views.push_back({wide, fmt::format("strip of {} rows", rows),
                         [wide, rows](Shot& shot) { leave_strip(shot, wide, rows); }});
    }
    for (const ViewSize size : {ViewSize{11, 188, 120}, wide, ViewSize{11, 640, 480}})
        views.push_back({size, "60 % under graphics", cover_with_graphics});
    return views;
}

void locate(const Shot& shot, const DeviceOptions& options, std::span<const KnownRegion> sheets,
            OtherSheets others, KnownTally& tally) {
    Locator locator(thread_memory(), options);
    static_cast<void>(locator.set_known(sheets, others));
    Outcome outcome;
    const GreyImage image = render(shot);
    outcome.fix = locator.locate(image.view());
    outcome.truth = truth_of(shot);
    ++tally.frames;
    tally.located += outcome.is_fix();
    tally.wrong += outcome.is_wrong();
    if (outcome.is_fix()) tally.claimed += outcome.fix.p_wrong();
}

/// Prints a row of a table. Returns true if no fix is wrong.
bool print_row(const ViewSize& size, const std::string& dots, const Count<KnownTally>& count) {
    const KnownTally& tally = count.tally;
    fmt::print("| {} | {} x {} | {} | {} | {:.2f} | {} | {:.1e} | {:.0f} |\n", size.spacing_px,
               size.width_px, size.height_px, dots, tally.frames,
               100.0 * static_cast<double>(tally.located) / static_cast<double>(tally.frames),
               tally.wrong, tally.claimed, 1e6 * count.seconds / static_cast<double>(tally.frames));
    std::fflush(stdout);
    return tally.wrong == 0 && count.is_complete();
}

void print_head(const char* what) {
    fmt::print(
        "\n{}\n\n| spacing, px | view, px | dots | frames | located, % | wrong | claimed | time, "
        "us |\n"
        "|--:|--:|---|--:|--:|--:|--:|--:|\n",
        what);
}

constexpr std::array kSizes{
    ViewSize{11, 54, 54},   ViewSize{11, 58, 58},  ViewSize{11, 62, 62}, ViewSize{11, 66, 66},
    ViewSize{11, 72, 72},   ViewSize{11, 77, 77},  ViewSize{11, 88, 88}, ViewSize{11, 96, 96},
    ViewSize{11, 120, 120}, ViewSize{4.5, 36, 36}, ViewSize{5, 36, 36},  ViewSize{6, 36, 36},
    ViewSize{6.5, 36, 36},  ViewSize{7, 36, 36},   ViewSize{6, 40, 40},  ViewSize{6, 44, 44}};

}  // namespace

bool known_table(TableRun& run) {
    std::uint64_t frames = 2000;
    std::uint64_t foreign = 2000;
    std::uint64_t sheet_count = 1;
    run.add_count("--frames", frames, "Number of frames of each size");
    run.add_count("--foreign", foreign, "Number of frames of unknown sheets");
    run.add_count("--sheets", sheet_count, "Number of known sheets");
    bool as_device = false;
    run.command.add_flag("--device", as_device, "Locate as a DeviceLocator");
    run.add_seed();
    run.add_threads();
    if (!run.parse()) return true;
    DeviceOptions options;
    if (as_device) {
        options.effort = Effort::device;
        options.blobs.min_area_px = 1;
    }
    const std::vector<KnownRegion> sheets = sheets_of(std::max<std::uint64_t>(sheet_count, 1));

    bool is_right = true;
    for (const OtherSheets others : {OtherSheets::impossible, OtherSheets::possible}) {
        print_head(others == OtherSheets::possible ? "Other sheets are possible"
                                                   : "Other sheets are impossible");
        for (const ViewSize& size : kSizes) {
            if (frames == 0) break;
            is_right &= print_row(
                size, "all",
                run.count<KnownTally>("frames", frames, [&](std::uint64_t i, KnownTally& t) {
                    locate(draw_on_page(size, run.seed, i, sheets), options, sheets, others, t);
                }));
        }
        for (const HiddenView& view : hidden_views()) {
            if (frames == 0 || as_device) break;
            is_right &= print_row(
                view.size, view.what,
                run.count<KnownTally>("frames", frames, [&](std::uint64_t i, KnownTally& t) {
                    Shot shot = draw_on_page(view.size, run.seed, i, sheets);
                    view.hide(shot);
                    locate(shot, options, sheets, others, t);
                }));
        }
    }
    print_head("Frames of unknown sheets, anywhere");
    const ViewSize size{11, 77, 77};
    if (foreign > 0) {
        is_right &=
            print_row(size, "all",
                      run.count<KnownTally>("frames", foreign, [&](std::uint64_t i, KnownTally& t) {
                          locate(draw_shot(setup_of(size, run.seed), i), options, sheets,
                                 OtherSheets::impossible, t);
                      }));
    }
    return is_right;
}

}  // namespace dotpose::tables
