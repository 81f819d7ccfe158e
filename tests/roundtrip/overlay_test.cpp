#include "dotpose/tools/overlay.hpp"

#include <array>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../paths.hpp"
#include "../temporary_directory.hpp"
#include "dot_places.hpp"
#include "rendered_page.hpp"
#include "small_pdf.hpp"

namespace dotpose::roundtrip {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

/// A command that writes the document in.pdf from page.roff (two pages of text), from page.ps (a
/// picture), or from an existing document.
struct Producer {
    const char* name;
    const char* command;
};

constexpr Producer kProducers[] = {
    {"groff", "groff -P-p14.8c,10.5c -Tpdf page.roff > in.pdf"},
    {"ghostscript",
     "groff -P-p14.8c,10.5c -Tps page.roff > p.ps && gs -q -o in.pdf -sDEVICE=pdfwrite p.ps"},
    {"cairo", "groff -P-p14.8c,10.5c -Tpdf page.roff > p.pdf && pdftocairo -pdf p.pdf in.pdf"},
    {"mupdf", "groff -P-p14.8c,10.5c -Tpdf page.roff > p.pdf && mutool convert -o in.pdf p.pdf"},
    {"libtiff", "gs -q -o p.tif -sDEVICE=tifflzw -r72 page.ps && tiff2pdf -o in.pdf p.tif"},
    {"libreoffice", "cp \"$S\"/tests/roundtrip/documents/letter.pdf in.pdf"},
    {"pdftex", "cp \"$S\"/tests/roundtrip/documents/report.pdf in.pdf"},
};

class Documents : public testing::Test {
  protected:
    void SetUp() override {
        std::ofstream(path("page.roff"))
            << ".pl 14.8c\n.sp 2\nThe quick brown fox.\n.bp\nPage two.\n";
        std::ofstream(path("page.ps"))
            << "%!\n<< /PageSize [144 144] >> setpagedevice\n"
               "0.5 setgray 30 30 50 50 rectfill 0 setgray 60 60 40 40 rectfill showpage\n";
    }

    fs::path path(const std::string& name) const { return directory_.path() / name; }
    std::string in_directory(const std::string& command) const {
        return run(fmt::format("cd '{}' && S='{}' && ( {} )", directory_.path().string(),
                               test::source_dir(), command));
    }
    std::string text(const std::string& name) const {
        return in_directory("pdftotext -layout " + name + " - 2>&1");
    }
    /// Writes dots.pdf: a page with the size and the dots of `report.pages[page]`, and no other
    /// content.
    void write_blank(const OverlayReport& report, std::size_t page) const {
        const Sheet& sheet = report.pages[page].sheet;
        write_pdf(path("blank.pdf"),
                  {"<< /Type /Catalog /Pages 2 0 R >>", "<< /Type /Pages /Kids [3 0 R] /Count 1 >>",
                   fmt::format("<< /Type /Page /Parent 2 0 R /MediaBox [0 0 {:.6f} {:.6f}] >>",
                               sheet.width_mm * 72 / 25.4, sheet.height_mm * 72 / 25.4)});
        OverlayOptions options;
        options.pattern = sheet.pattern;
        options.origin = sheet.origin;
        overlay_pdf(path("blank.pdf"), path("dots.pdf"), options);
    }

    test::TemporaryDirectory directory_;
};

/// Returns the renderers that can draw the document. mutool is omitted if it cannot draw the
/// document: the version in Debian 13 loses a resource when it converts certain documents, and then
/// cannot draw its own result.
std::vector<const char*> renderers_of(const fs::path& pdf) {
    try {
        render("mutool", pdf, 72);
        return {"pdftoppm", "mutool"};
    } catch (const std::runtime_error&) {
        return {"pdftoppm"};
    }
}

class OverlaidDocument : public Documents, public testing::WithParamInterface<Producer> {};

TEST_P(OverlaidDocument, looks_as_before_with_dots_and_keeps_its_text) {
    in_directory(GetParam().command);
    OverlayOptions options;
    options.origin = {70'000, 300};
    const OverlayReport report = overlay_pdf(path("in.pdf"), path("out.pdf"), options);
    EXPECT_THAT(in_directory("qpdf --check out.pdf"),
                HasSubstr("No syntax or stream encoding errors"));
    EXPECT_EQ(text("out.pdf"), text("in.pdf"));
    constexpr int kResolution_dpi = 300;
    const std::vector<const char*> renderers = renderers_of(path("in.pdf"));
    for (std::size_t i = 0; i < report.pages.size(); ++i) {
        write_blank(report, i);
        const auto page = static_cast<int>(i + 1);
        for (const char* renderer : renderers) {
            const GreyPage before = render(renderer, path("in.pdf"), kResolution_dpi, page);
            const GreyPage dots = render(renderer, path("dots.pdf"), kResolution_dpi);
            const GreyPage after = render(renderer, path("out.pdf"), kResolution_dpi, page);
            ASSERT_EQ(after.grey.size(), before.grey.size());
            ASSERT_EQ(after.grey.size(), dots.grey.size());
            int different = 0;
            for (std::size_t k = 0; k < after.grey.size(); ++k) {
                const int expected = before.grey[k] * dots.grey[k] / 255;
                if (std::abs(after.grey[k] - expected) > 4) ++different;
            }
            EXPECT_EQ(different, 0) << renderer << ", page " << page;
            const DotErrors errors = measure_dots(dots, report.pages[i].sheet, kResolution_dpi);
            EXPECT_EQ(errors.wrong_symbols + errors.missing, 0) << renderer;
        }
    }
}

TEST_P(OverlaidDocument, leaves_black_ink_to_the_dots_when_asked) {
    in_directory(GetParam().command);
    OverlayOptions options;
    const OverlayReport plain = overlay_pdf(path("in.pdf"), path("plain.pdf"), options);
    EXPECT_THAT(plain.warnings, Not(IsEmpty()));
    options.black_to_cmy = true;
    options.lighten = 0.25;
    const OverlayReport report = overlay_pdf(path("in.pdf"), path("out.pdf"), options);
    EXPECT_THAT(report.warnings, IsEmpty());
    EXPECT_EQ(text("out.pdf"), text("in.pdf"));
    write_blank(report, 0);
    // Returns the mean amounts of cyan, magenta, yellow and black on the first page, in percent.
    const auto inks = [&](const char* name) {
        std::array<double, 4> ink{};
        const std::string output = in_directory(
            fmt::format("gs -q -sDEVICE=ink_cov -r300 -dLastPage=1 -o - {} | head -1", name));
        EXPECT_EQ(
            std::sscanf(output.c_str(), "%lf %lf %lf %lf", &ink[0], &ink[1], &ink[2], &ink[3]), 4)
            << output;
        return ink;
    };
    const auto dots = inks("dots.pdf");
    const auto out = inks("out.pdf");
    EXPECT_GT(dots[3], 0);
    EXPECT_NEAR(out[3], dots[3], 1e-4);
    EXPECT_GT(inks("plain.pdf")[3], dots[3] + 1e-3);
    for (int i = 0; i < 3; ++i)
        EXPECT_GT(out[static_cast<std::size_t>(i)], 1e-3);
}

std::string producer_name(const testing::TestParamInfo<Producer>& tested) {
    return tested.param.name;
}

INSTANTIATE_TEST_SUITE_P(producers, OverlaidDocument, testing::ValuesIn(kProducers), producer_name);

TEST_F(Documents, turned_and_cropped_pages_get_dots_as_they_are_shown) {
    for (const char* rotate : {"0", "90", "180", "270", "-90", "90.0", "-450."}) {
        write_pdf(path("in.pdf"),
                  {"<< /Type /Catalog /Pages 2 0 R >>",
                   fmt::format("<< /Type /Pages /Kids [3 0 R] /Count 1 /Rotate {} "
                               "/MediaBox [-20 10 400 300] /CropBox [30 40 230.4 150] >>",
                               rotate),
                   "<< /Type /Page /Parent 2 0 R >>"});
        OverlayOptions options;
        options.origin = {1'000'000, 77};
        const OverlayReport report = overlay_pdf(path("in.pdf"), path("out.pdf"), options);
        ASSERT_EQ(report.pages.size(), 1U);
        const Sheet& sheet = report.pages.front().sheet;
        const double width_pt = std::atoi(rotate) % 180 == 0 ? 200.4 : 110;
        EXPECT_NEAR(sheet.width_mm, width_pt * 25.4 / 72, 1e-9);
        for (const char* renderer : kRenderers) {
            const DotErrors errors =
                measure_dots(render(renderer, path("out.pdf"), 600), sheet, 600);
            EXPECT_EQ(errors.wrong_symbols + errors.missing, 0) << renderer << " " << rotate;
            EXPECT_LE(errors.largest_um, 12) << renderer << " " << rotate;
        }
    }
}

TEST_F(Documents, user_units_make_the_page_larger) {
    write_pdf(path("in.pdf"),
              {"<< /Type /Catalog /Pages 2 0 R >>", "<< /Type /Pages /Kids [3 0 R] /Count 1 >>",
               "<< /Type /Page /Parent 2 0 R /MediaBox [0 0 72 36] /UserUnit 2 >>"});
    const OverlayReport report = overlay_pdf(path("in.pdf"), path("out.pdf"));
    EXPECT_NEAR(report.pages.front().sheet.width_mm, 50.8, 1e-9);
    const DotErrors errors =
        measure_dots(render("mutool", path("out.pdf"), 600), report.pages.front().sheet, 600);
    EXPECT_EQ(errors.wrong_symbols + errors.missing, 0);
}

/// Returns a document of two pages that share content and inherit resources. The document has a
/// link, a form field and an outline. The content of the pages changes the graphics state and the
/// coordinates without restoring them.
std::vector<std::string> rich_document() {
    return {"<< /Type /Catalog /Pages 2 0 R /Outlines 8 0 R /AcroForm << /Fields [9 0 R] >> >>",
            "<< /Type /Pages /Kids [3 0 R 4 0 R] /Count 2 /MediaBox [0 0 200 100] "
            "/Resources << /Font << /F 5 0 R >> /XObject << /Dots1 10 0 R >> >> >>",
            "<< /Type /Page /Parent 2 0 R /Contents 6 0 R /Annots [7 0 R 9 0 R] >>",
            "<< /Type /Page /Parent 2 0 R /Contents 6 0 R >>",
            "<< /Type /Font /Subtype /Type1 /BaseFont /Helvetica >>",
            stream("Q q 3 0 0 3 9 9 cm BT /F 8 Tf 10 10 Td (kept) Tj ET /Dots1 Do q"),
            "<< /Type /Annot /Subtype /Link /Rect [0 0 9 9] /A << /S /URI /URI (http://a.example) "
            ">> >>",
            "<< /Type /Outlines >>",
            "<< /Type /Annot /Subtype /Widget /FT /Tx /T (field) /Rect [50 50 90 60] /P 3 0 R >>",
            "<< /Type /XObject /Subtype /Form /BBox [0 0 9 9] /Length 24 >>\nstream\n"
            "0 0 1 rg 0 0 2 2 re f  \nendstream"};
}

TEST_F(Documents, keep_links_forms_outlines_and_names) {
    write_pdf(path("in.pdf"), rich_document());
    OverlayOptions options;
    options.pages = "2";
    const OverlayReport report = overlay_pdf(path("in.pdf"), path("out.pdf"), options);
    ASSERT_EQ(report.pages.size(), 1U);
    EXPECT_EQ(report.pages.front().number, 2);
    EXPECT_THAT(in_directory("qpdf --check out.pdf"), Not(HasSubstr("WARNING")));
    const std::string out = in_directory("qpdf --qdf --object-streams=disable out.pdf -");
    for (const char* kept : {"http://a.example", "(field)", "/Outlines", "/AcroForm"})
        EXPECT_THAT(out, HasSubstr(kept));
    EXPECT_EQ(render("mutool", path("out.pdf"), 150, 1).grey,
              render("mutool", path("in.pdf"), 150, 1).grey);
    const DotErrors errors =
        measure_dots(render("pdftoppm", path("out.pdf"), 600, 2), report.pages.front().sheet, 600);
    EXPECT_LT(errors.wrong_symbols + errors.missing, errors.dots / 10) << "text hides a few";
}

TEST_F(Documents, are_refused_without_pages_and_with_content_that_ends_too_early) {
    std::vector<std::string> objects = rich_document();
    objects[5] = stream("BT /F 8 Tf (no end");
    write_pdf(path("cut.pdf"), objects);
    EXPECT_THAT([&] { overlay_pdf(path("cut.pdf"), path("out.pdf")); },
                testing::ThrowsMessage<Error>(HasSubstr("damaged PDF")));
    write_pdf(path("none.pdf"),
              {"<< /Type /Catalog /Pages 2 0 R >>", "<< /Type /Pages /Kids [] /Count 0 >>"});
    EXPECT_THAT([&] { overlay_pdf(path("none.pdf"), path("out.pdf")); },
                testing::ThrowsMessage<Error>(HasSubstr("no pages")));
    EXPECT_FALSE(fs::exists(path("out.pdf")));
}

TEST_F(Documents, colours_of_other_pages_stay) {
    write_pdf(path("in.pdf"), rich_document());
    OverlayOptions options;
    options.pages = "2";
    options.black_to_cmy = true;
    overlay_pdf(path("in.pdf"), path("out.pdf"), options);
    EXPECT_EQ(render("mutool", path("out.pdf"), 150, 1).grey,
              render("mutool", path("in.pdf"), 150, 1).grey);
}

TEST_F(Documents, encrypted_ones_stay_encrypted) {
    in_directory(kProducers[0].command);
    in_directory("qpdf --encrypt user owner 256 -- in.pdf locked.pdf");
    OverlayOptions options;
    EXPECT_THROW(overlay_pdf(path("locked.pdf"), path("out.pdf"), options), Error);
    options.password = "wrong";
    EXPECT_THROW(overlay_pdf(path("locked.pdf"), path("out.pdf"), options), Error);
    EXPECT_FALSE(fs::exists(path("out.pdf")));
    options.password = "user";
    overlay_pdf(path("locked.pdf"), path("out.pdf"), options);
    EXPECT_THAT(in_directory("qpdf --password=user --check out.pdf"),
                HasSubstr("User password = user"));
    EXPECT_EQ(in_directory("pdftotext -upw user out.pdf -"), in_directory("pdftotext in.pdf -"));
}

}  // namespace
}  // namespace dotpose::roundtrip
