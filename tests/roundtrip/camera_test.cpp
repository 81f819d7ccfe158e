// Tests that `dotpose locate` locates frames of pages written by `dotpose overlay`. A PDF renderer
// replaces the printer, and a simulated camera takes frames of the rendered pages.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/core.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "../paths.hpp"
#include "../temporary_directory.hpp"
#include "dotpose/tools/image_file.hpp"
#include "dotpose/tools/simulate.hpp"
#include "rendered_page.hpp"

namespace dotpose::roundtrip {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr int kPages = 5;
constexpr double kPageWidth_mm = 60;
constexpr double kPageHeight_mm = 80;
// Minimum distance between a frame's centre and the page edge. It is larger than half the diagonal
// of a frame, so frames do not extend beyond the page.
constexpr double kEdge_mm = 8;
constexpr int kPrinter_dpi = 1200;
// Tolerance for positions. A renderer may shift all dots by one of its pixels, which is 0.021 mm,
// and the error of a fix is about 0.002 mm.
constexpr double kTolerance_mm = 0.03;

struct TakenFrame {
    int page = 1;
    Vec2 at_mm;
    double theta_rad = 0;
};

/// A kind of camera, and the options with which `dotpose overlay` prints pages for it.
struct Camera {
    const char* name;
    const char* overlay_options;
    bool is_infrared;
    int places;
    /// Minimum number of located frames. Cameras that see black text miss the dots under it.
    int min_found;
};

class OverlaidBook : public testing::TestWithParam<Camera> {
  protected:
    std::string in_directory(const std::string& command) const {
        return run(fmt::format("cd '{}' && {}", directory_.path().string(), command));
    }

    /// Writes pages of text to in.pdf, and the same pages with dots to out.pdf. sheets.json
    /// contains these pages and another sheet.
    void make_book() const {
        std::ofstream roff(directory_.path() / "book.roff");
        roff << ".pl 8c\n.po 0.6c\n.ll 4.8c\n.ps 9\n.vs 11\n.hy 0\n";
        for (int page = 1; page <= kPages; ++page) {
            roff << (page > 1 ? ".bp\n" : "") << ".sp 0.5c\nPage " << page << ". ";
            for (int line = 0; line < 12; ++line)
                roff << "The quick brown fox " << page * line << " jumps over the lazy dog.\n";
        }
        roff.close();
        in_directory(fmt::format("groff -P-p{}c,{}c -Tpdf book.roff > in.pdf", kPageHeight_mm / 10,
                                 kPageWidth_mm / 10));
        const std::string tool = "'" + test::tool_path() + "'";
        in_directory(tool + " print -o a.svg --paper 60x80 --sheets sheets.json --name table");
        in_directory(tool + " overlay in.pdf -o out.pdf --sheets sheets.json --name book " +
                     GetParam().overlay_options);
    }

    /// Writes frames at random places. list.txt contains the file names, in the same order as the
    /// result.
    std::vector<TakenFrame> take_frames() const {
        constexpr std::uint64_t kSeed = 41;
        fmt::print("seed {}\n", kSeed);
        Rng rng(kSeed);
        std::vector<TakenFrame> taken(static_cast<std::size_t>(GetParam().places));
        for (TakenFrame& frame : taken) {
            frame.page = 1 + static_cast<int>(rng.uniform() * kPages);
            frame.at_mm = {kEdge_mm + rng.uniform() * (kPageWidth_mm - 2 * kEdge_mm),
                           kEdge_mm + rng.uniform() * (kPageHeight_mm - 2 * kEdge_mm)};
            frame.theta_rad = (2 * rng.uniform() - 1) * std::numbers::pi;
        }
        std::ranges::stable_sort(taken, {}, &TakenFrame::page);
        std::ofstream list(directory_.path() / "list.txt");
        GreyPage page;
        for (std::size_t i = 0; i < taken.size(); ++i) {
            const TakenFrame& frame = taken[i];
            if (i == 0 || frame.page != taken[i - 1].page) {
                const fs::path pdf = directory_.path() / "out.pdf";
                page = GetParam().is_infrared ? render_black(pdf, kPrinter_dpi, frame.page)
                                              : render("pdftoppm", pdf, kPrinter_dpi, frame.page);
            }
            const ImageView view{page.grey.data(), page.width_px, page.height_px, page.width_px};
            const PageImage seen{view, 25.4 / kPrinter_dpi, frame.at_mm};
            CameraPose pose;
            pose.theta_rad = frame.theta_rad;
            const std::string name = fmt::format("{}.pgm", i);
            write_pgm(directory_.path() / name,
                      dotpose::render(seen, CameraModel{}, pose,
                                      draw_imperfections(Preset::nominal, rng), i)
                          .view());
            list << name << '\n';
        }
        return taken;
    }

    test::TemporaryDirectory directory_;
};

TEST_P(OverlaidBook, is_located_on_the_right_page_in_the_right_place) {
    make_book();
    const std::vector<TakenFrame> taken = take_frames();
    std::istringstream lines(
        in_directory("'" + test::tool_path() + "' locate --sheets sheets.json --list list.txt"));
    int found = 0;
    double largest_mm = 0;
    for (const TakenFrame& frame : taken) {
        std::string line;
        ASSERT_TRUE(std::getline(lines, line));
        const json record = json::parse(line);
        if (record["status"] != "ok") continue;
        ++found;
        EXPECT_EQ(record["sheet"], fmt::format("book-{}", frame.page)) << line;
        const double error_mm = std::hypot(record["x_sheet_mm"].get<double>() - frame.at_mm.x,
                                           record["y_sheet_mm"].get<double>() - frame.at_mm.y);
        EXPECT_LE(error_mm, kTolerance_mm) << line;
        largest_mm = std::max(largest_mm, error_mm);
        const double theta_rad = record["theta_deg"].get<double>() * std::numbers::pi / 180;
        EXPECT_NEAR(std::remainder(theta_rad - frame.theta_rad, 2 * std::numbers::pi), 0, 0.01)
            << line;
    }
    fmt::print("{} of {} places found, largest error {:.1f} um\n", found, GetParam().places,
               largest_mm * 1000);
    EXPECT_GE(found, GetParam().min_found);
}

std::string camera_name(const testing::TestParamInfo<Camera>& tested) {
    return tested.param.name;
}

INSTANTIATE_TEST_SUITE_P(cameras, OverlaidBook,
                         testing::Values(Camera{"infrared", "--cmy-black", true, 150, 150},
                                         Camera{"light_text", "--lighten 0.75", false, 150, 150},
                                         Camera{"black_text", "", false, 80, 76}),
                         camera_name);

}  // namespace
}  // namespace dotpose::roundtrip
