// Counts the located views of sheets that were not printed by dotpose. The views are cut from page
// images at random positions and angles. Each view is located with the given code and with code
// detection. Prints the rows of a table in docs/integrity.md, in Markdown.
//
//   dotpose_tables views PAGE... --code NAME [--dpi D] [--views N] [--seed S]
//
// PAGE is an image of a page at D dots per inch, or a text file with one symbol (u, d, l or r) for
// each dot, row by row. The true pose of a view is determined from a larger part of the page, with
// the given code. N views of each size are distributed over all pages. The exit status is 1 if any
// fix is wrong.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/core.h>

#include "dotpose/files/code_names.hpp"
#include "dotpose/files/error.hpp"
#include "dotpose/tools/image_file.hpp"
#include "dotpose/tools/random.hpp"
#include "tables.hpp"

namespace dotpose::tables {
namespace {

constexpr double kMmPerInch = 25.4;
/// Side length, in spacings, of the part of the page that determines a view's true pose. This part
/// contains about 1500 dots.
constexpr double kSurroundings_grid = 40;
/// Number of views whose combined evidence is expected to identify the code.
constexpr int kFirstViews = 50;

struct ScannedPage {
    GreyImage image;
    double mm_per_px = 0;
};

/// Draws a page with one solid disc for each symbol of a text file.
GreyImage drawn(const std::vector<std::string>& rows, double dpi) {
    constexpr double kDisplacement_grid = 1.0 / 6;
    constexpr double kRadius_grid = 1.0 / 6;
    const double spacing_px = kDefaultSpacing_mm / kMmPerInch * dpi;
    GreyImage image;
    image.width_px = static_cast<int>(spacing_px * static_cast<double>(rows.front().size()));
    image.height_px = static_cast<int>(spacing_px * static_cast<double>(rows.size()));
    const auto is_ink = [&](double x_grid, double y_grid) {
        const auto i = static_cast<std::size_t>(x_grid);
        const auto j = static_cast<std::size_t>(y_grid);
        if (j >= rows.size() || i >= rows[j].size()) return false;
        const char symbol = rows[j][i];
        const double x =
            static_cast<double>(i) + 0.5 + kDisplacement_grid * ((symbol == 'r') - (symbol == 'l'));
        const double y =
            static_cast<double>(j) + 0.5 + kDisplacement_grid * ((symbol == 'd') - (symbol == 'u'));
        return std::hypot(x_grid - x, y_grid - y) <= kRadius_grid;
    };
    constexpr int kSamples = 3;
    for (int v = 0; v < image.height_px; ++v) {
        for (int u = 0; u < image.width_px; ++u) {
            int ink = 0;
            for (int k = 0; k < kSamples * kSamples; ++k) {
                ink += is_ink((u + (k % kSamples + 0.5) / kSamples) / spacing_px,
                              (v + (k / kSamples + 0.5) / kSamples) / spacing_px);
            }
            image.pixels.push_back(
                static_cast<std::uint8_t>(255 - 255 * ink / (kSamples * kSamples)));
        }
    }
    return image;
}

ScannedPage read_page(const std::string& path, double dpi) {
    if (!path.ends_with(".txt")) return {read_image(path, kMaxImagePixels), kMmPerInch / dpi};
    std::ifstream file(path);
    std::vector<std::string> rows;
    for (std::string row; std::getline(file, row);) {
        const bool is_row = row.find_first_not_of("udlr") == std::string::npos;
        if (row.empty() || !is_row || row.size() != (rows.empty() ? row : rows.front()).size())
            throw Error(fmt::format("{}, line {}: not symbols u d l r", path, rows.size() + 1));
        rows.push_back(row);
    }
    if (rows.empty()) throw Error(fmt::format("{}: no symbols", path));
    return {drawn(rows, dpi), kMmPerInch / dpi};
}

struct View {
    GreyImage frame;
    Truth truth;
};

/// Returns the pose at a point on the page, or nullopt if the surrounding part of the page cannot
/// be read.
std::optional<Fix> pose_on_page(const ScannedPage& page, double x_px, double y_px,
                                Locator& locator) {
    const int side_px =
        static_cast<int>(kSurroundings_grid * kDefaultSpacing_mm / page.mm_per_px) / 2 * 2;
    const auto begin = [&](double centre_px) {
        return static_cast<int>(std::lround(centre_px)) - side_px / 2;
    };
    const int u = begin(x_px);
    const int v = begin(y_px);
    const ImageView whole = page.image.view();
    if (u < 0 || v < 0 || u + side_px > whole.width_px || v + side_px > whole.height_px)
        return std::nullopt;
    const Fix fix = locator.locate({whole.row(v) + u, side_px, side_px, whole.stride_bytes});
    return fix.status == Status::ok ? std::optional(fix) : std::nullopt;
}

std::optional<View> draw_view(const ScannedPage& page, int width_px, int height_px, Rng& rng,
                              Locator& locator) {
    const double x_px = std::round(rng.uniform(0, page.image.width_px));
    const double y_px = std::round(rng.uniform(0, page.image.height_px));
    CameraModel camera;
    camera.width_px = width_px;
    camera.height_px = height_px;
    camera.mm_per_px = kDefaultSpacing_mm / rng.uniform(8, 16);
    CameraPose pose;
    pose.theta_rad = rng.uniform(0, 2 * std::numbers::pi);
    Imperfections seen;
    seen.blur_sigma_px = 0.7;
    seen.noise_sigma = 4;
    const std::uint64_t seed = rng.bits();

    const std::optional<Fix> on_page = pose_on_page(page, x_px, y_px, locator);
    if (!on_page) return std::nullopt;
    View view;
    view.frame =
        render({page.image.view(), page.mm_per_px, {x_px * page.mm_per_px, y_px * page.mm_per_px}},
               camera, pose, seen, seed);
    view.truth.x_grid = on_page->x_grid();
    view.truth.y_grid = on_page->y_grid();
    view.truth.theta_rad = on_page->theta_rad() + pose.theta_rad;
    view.truth.section = on_page->section;
    return view;
}

/// Counts for the views of one size.
struct ViewCounts {
    int views = 0;
    int given = 0;  ///< number of views located with the given code
    // The next four counts include only the views counted in `given`. These views are located again
    // with code detection.
    int alone = 0;        ///< number of views located without evidence from other views
    int ambiguous = 0;    ///< number of views refused as `ambiguous_code` without that evidence
    int later_given = 0;  ///< number of views after the first kFirstViews
    int later = 0;        ///< number of these views located with evidence from earlier views
    int wrong = 0;
    double max_against_log2 = 0;  ///< maximum evidence of one view against the given code, in bits
};

class ViewReader {
  public:
    explicit ViewReader(CodeVariant code) : code_(code), given_(options_of(code)) {}

    void read(const View& view, ViewCounts& row) {
        const ImageView image = view.frame.view();
        const auto is_located = [&](const Fix& fix) {
            Outcome outcome;
            outcome.fix = fix;
            outcome.truth = view.truth;
            row.wrong += outcome.is_wrong();
            return outcome.is_fix();
        };
        const bool given = is_located(given_.locate(image));
        const CodeReading alone_reading = any_.locate_in_any_code(image, {});
        const Fix& alone = alone_reading.fix;
        row.max_against_log2 =
            std::max(row.max_against_log2, -alone_reading.evidence.log2_q8(code_) / 256.0);
        const bool is_alone = is_located(alone);
        const CodeReading reading = stream_.locate_in_any_code(image, evidence_);
        evidence_ = reading.evidence;
        const bool in_stream = is_located(reading.fix);

        const bool is_later = row.views++ >= kFirstViews;
        if (!given) return;
        ++row.given;
        row.alone += is_alone;
        row.ambiguous += alone.status == Status::ambiguous_code;
        row.later_given += is_later;
        row.later += is_later && in_stream;
    }

    Locator& given() { return given_; }

  private:
    static DeviceOptions options_of(CodeVariant code) {
        DeviceOptions options;
        options.code = code;
        return options;
    }

    const CodeVariant code_;
    Locator given_{DeviceOptions{}};
    Locator any_{DeviceOptions{}};
    Locator stream_{DeviceOptions{}};
    CodeEvidence evidence_;
};

/// Locates `views` views of one size. Throws Error if interrupted.
ViewCounts read_views(const std::vector<ScannedPage>& pages, int width_px, int height_px,
                      CodeVariant code, int views, std::uint64_t seed) {
    ViewCounts row;
    ViewReader reader(code);
    cli::ProgressLine progress("views");
    for (std::uint64_t i = 0; row.views < views; ++i) {
        if (cli::interrupted()) throw Error("interrupted");
        if (i == 100 * (static_cast<std::uint64_t>(views) + 1))
            throw Error("the pages can hardly be read anywhere");
        Rng rng(seed, i);
        const ScannedPage& page = pages[i % pages.size()];
        if (const auto view = draw_view(page, width_px, height_px, rng, reader.given()))
            reader.read(*view, row);
        progress.update(row.views, views);
    }
    return row;
}

}  // namespace

bool views_table(TableRun& run) {
    std::vector<std::string> paths;
    std::string name = "libdots";
    double dpi = 1200;
    std::uint64_t views = 300;
    run.command.add_option("page", paths, "Images of pages, or texts of symbols")->required();
    run.command.add_option("--code", name, "Code of the pages: anoto, libdots, microdots")
        ->capture_default_str();
    run.command.add_option("--dpi", dpi, "Resolution of the images")->capture_default_str();
    run.add_count("--views", views, "Number of views of each size");
    run.add_seed();
    if (!run.parse()) return true;
    const std::optional<CodeVariant> code = code_by_name(name);
    if (!code) throw Error(fmt::format("--code {}: no such code", name));
    std::vector<ScannedPage> pages;
    for (const std::string& path : paths)
        pages.push_back(read_page(path, dpi));

    fmt::print(
        "| sheet | view | views | by itself | ambiguous | after {} views | wrong | "
        "bits against the code |\n|---|---|---:|---:|---:|---:|---:|---:|\n",
        kFirstViews);
    const auto percent = [](int part, int whole) { return 100.0 * part / std::max(whole, 1); };
    int wrong = 0;
    for (const auto& [width_px, height_px] :
         {std::array{188, 120}, std::array{320, 240}, std::array{640, 480}}) {
        const ViewCounts row =
            read_views(pages, width_px, height_px, *code, static_cast<int>(views), run.seed);
        fmt::print("| {} | {} x {} | {} | {:.1f} % | {:.1f} % | {:.1f} % | {} | {:.0f} |\n", name,
                   width_px, height_px, row.views, percent(row.alone, row.given),
                   percent(row.ambiguous, row.given), percent(row.later, row.later_given),
                   row.wrong, row.max_against_log2);
        std::fflush(stdout);
        wrong += row.wrong;
    }
    return wrong == 0;
}

}  // namespace dotpose::tables
