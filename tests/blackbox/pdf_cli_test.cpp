#include <array>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tool_command.hpp"

namespace dotpose::test {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

class PdfCommands : public ToolCommand {
  protected:
    /// Runs shell commands, in which $T is the tool. `output_` contains their stdout and stderr.
    int run(const std::string& commands) { return shell("{ " + commands + "; } 2>&1"); }

    bool exists(const char* name) const { return fs::exists(directory_ / name); }
};

TEST_F(PdfCommands, print_makes_pages_with_text_that_can_be_selected) {
    run("$T print -o 'my sheet.pdf' --pages 3 --paper A6 --section 1,2 --origin 9,8");
    EXPECT_EQ(exit_code_, 0);
    // Margins of 10 mm leave 85 x 128 mm for the dots. n cells of 0.508 mm need (n - 0.5) * 0.508
    // mm, so 167 x 252 cells fit.
    EXPECT_THAT(output_, HasSubstr("my sheet.pdf: 1/3, page 105 x 148 mm, cells 9,8 to 175,259 "));
    EXPECT_THAT(output_, HasSubstr("3/3, page 105 x 148 mm, cells 343,8 to 509,259 "));
    run("qpdf --check 'my sheet.pdf' && pdftotext -f 2 -l 2 'my sheet.pdf' -");
    EXPECT_EQ(exit_code_, 0);
    EXPECT_THAT(output_, HasSubstr("my sheet, page 2 of 3, cells 176,8 to 342,259"));
    EXPECT_THAT(output_, HasSubstr("section 1,2"));
    EXPECT_THAT(output_, HasSubstr("print at 100 %"));
    EXPECT_THAT(output_, HasSubstr("--section 1,2 --origin 9,8"));
    EXPECT_THAT(output_, Not(HasSubstr("uulu"))) << "the dots are letters, but no text";
}

TEST_F(PdfCommands, paper_sizes_and_landscape_are_true) {
    // pdfinfo prints the page sizes in points (1/72 inch), rounded.
    const std::array<std::array<const char*, 2>, 4> sizes = {
        {{"A0", "2383.94 x 3370.39"},
         {"A4 --landscape", "841.89 x 595.276"},
         {"Tabloid", "792 x 1224"},
         {"40x25.4", "113.386 x 72"}}};
    for (const auto& [paper, points] : sizes) {
        run(std::string("$T print -o a.pdf --margin 3 --paper ") + paper + " && pdfinfo a.pdf");
        EXPECT_THAT(output_, HasSubstr(std::string(points) + " pts")) << paper;
    }
}

TEST_F(PdfCommands, only_black_ink_is_used) {
    run("$T print -o a.pdf --paper A6 && gs -q -sDEVICE=ink_cov -r600 -o - a.pdf");
    EXPECT_EQ(exit_code_, 0);
    EXPECT_THAT(output_, HasSubstr(" 0.00000  0.00000  0.00000 "));
    EXPECT_THAT(output_, Not(HasSubstr(" 0.00000 CMYK"))) << "but there is some";
}

TEST_F(PdfCommands, print_refuses_what_a_pdf_cannot_be) {
    for (const char* arguments : {"-o a.png --pages 2", "-o a.pdf --pages 0", "-o a.pdf --dots ink",
                                  "-o a.pdf --spacing 0.5 --dots glyphs", "-o a.pdf --dpi 100"}) {
        run(std::string("$T print ") + arguments);
        EXPECT_EQ(exit_code_, 2) << arguments;
        EXPECT_THAT(output_, StartsWith("dotpose: ")) << arguments;
        EXPECT_TRUE(fs::is_empty(directory_)) << arguments;
    }
}

TEST_F(PdfCommands, overlay_says_which_region_each_page_got) {
    run("$T print -o in.pdf --pages 3 --paper 80x60 > /dev/null && "
        "$T overlay in.pdf -o out.pdf --pages 1,z --origin 5000,10 --spacing 1");
    EXPECT_EQ(exit_code_, 0);
    // Margins of 5 mm leave 70 x 50 mm, which is 70 x 50 cells of 1 mm.
    EXPECT_THAT(output_, HasSubstr("out.pdf 1: page 80 x 60 mm, cells 5000,10 to 5069,59 "));
    EXPECT_THAT(output_, HasSubstr("out.pdf 3: page 80 x 60 mm, cells 5070,10 to 5139,59 "));
    EXPECT_THAT(output_, HasSubstr("warning: pages 1, 3: black text or drawings hide dots"));
}

TEST_F(PdfCommands, overlay_enters_its_pages_in_a_sheet_file) {
    ASSERT_EQ(run("$T print -o in.pdf --pages 3 --paper 80x60 && "
                  "$T print -o desk.svg --paper 40x40 --sheets sheets.json --name desk && "
                  "$T overlay in.pdf -o out.pdf --pages 1,z --sheets sheets.json --name form && "
                  "$T overlay in.pdf -o letter.pdf --pages 2 --sheets sheets.json --name letter "
                  "--origin 7,9 --spacing 1 --section 3,4"),
              0)
        << output_;
    EXPECT_THAT(output_, HasSubstr(", sheet 'form-3' of sheets.json"));
    EXPECT_THAT(output_, HasSubstr(", sheet 'letter' of sheets.json"));
    const nlohmann::json sheets = nlohmann::json::parse(file("sheets.json"))["sheets"];
    ASSERT_EQ(sheets.size(), 4U);
    const struct {
        const char* name;
        int page;
        int origin_x;
        int origin_y;
        int columns;
    } expected[] = {
        // Between margins of 5 mm, n cells need (n - 0.5) * 0.508 mm. Automatically assigned
        // regions are kSheetGap_cells = 1024 cells apart.
        {"desk", 1, 1024, 1024, 59},
        {"form-1", 1, 1024 + 59 + 1024, 1024, 138},
        {"form-3", 3, 1024 + 59 + 1024 + 138 + 1024, 1024, 138},
        {"letter", 2, 7, 9, 70},
    };
    for (std::size_t i = 0; i < sheets.size(); ++i) {
        EXPECT_EQ(sheets[i]["name"], expected[i].name);
        EXPECT_EQ(sheets[i]["page"], expected[i].page) << i;
        EXPECT_EQ(sheets[i]["origin_x"], expected[i].origin_x) << i;
        EXPECT_EQ(sheets[i]["origin_y"], expected[i].origin_y) << i;
        EXPECT_EQ(sheets[i]["columns"], expected[i].columns) << i;
    }
    EXPECT_NEAR(sheets[1]["width_mm"], 80, 1e-4);
    EXPECT_EQ(sheets[3]["spacing_mm"], 1);
    EXPECT_EQ(sheets[3]["section_v"], 4);
}

TEST_F(PdfCommands, a_refused_or_stopped_overlay_leaves_the_sheet_file_alone) {
    ASSERT_EQ(run("$T print -o in.pdf --pages 2 --paper 80x60 && "
                  "$T overlay in.pdf -o a.pdf --sheets sheets.json --name a"),
              0)
        << output_;
    const std::string before = file("sheets.json");
    const struct {
        const char* arguments;
        int exit_code;
        const char* message;
    } refused[] = {
        {"in.pdf --sheets sheets.json --name a", 2, "there already is a sheet 'a-1'"},
        {"in.pdf --sheets sheets.json --name b --origin 1100,1100", 2,
         "sheet 'b-1' would share cells with sheet 'a-1', which has 1024,1024 to"},
        {"in.pdf --sheets sheets.json", 2, "--sheets requires --name"},
        {"in.pdf --name b", 2, "--name requires --sheets"},
        {"in.pdf --sheets sheets.json --name b --pages 3", 2, "give numbers from 1 to 2"},
        {"missing.pdf --sheets sheets.json --name b", 1, "cannot read missing.pdf"},
        {"in.pdf --sheets in.pdf --name b", 1, "in.pdf is not a sheet file"},
        {"in.pdf --sheets no/sheets.json --name b", 1, "cannot lock no/sheets.json"},
    };
    for (const auto& [arguments, exit_code, message] : refused) {
        EXPECT_EQ(run(std::string("$T overlay -o out.pdf ") + arguments), exit_code) << arguments;
        EXPECT_THAT(output_, HasSubstr(message)) << arguments;
    }
    run(std::string("$T print -o large.pdf --paper 3500x3500 --spacing 50 > /dev/null; "
                    "$T overlay large.pdf -o out.pdf --sheets sheets.json --name b & tool=$!; ") +
        kUntilItHandlesSignals + "kill $tool; wait $tool");
    EXPECT_EQ(exit_code_, 1);
    EXPECT_EQ(file("sheets.json"), before);
    run("ls -A");
    EXPECT_EQ(output_, "a.pdf\nin.pdf\nlarge.pdf\nsheets.json\n");
}

TEST_F(PdfCommands, overlay_refuses_and_writes_nothing) {
    ASSERT_EQ(
        run("$T print -o in.pdf --paper 80x60 && head -c 900 in.pdf > cut.pdf && echo x > no.pdf "
            "&& cp in.pdf same.pdf && qpdf --encrypt u o 256 -- in.pdf locked.pdf"),
        0);
    struct Case {
        const char* arguments;
        int exit_code;
        const char* message;
    };
    const Case cases[] = {
        {"in.pdf", 2, "--out"},
        {"-o out.pdf", 2, "pdf"},
        {"missing.pdf -o out.pdf", 1, "cannot read missing.pdf: No such file"},
        {"no.pdf -o out.pdf", 1, "no.pdf is not a PDF"},
        {"cut.pdf -o out.pdf", 1, "cut.pdf: damaged PDF"},
        {"locked.pdf -o out.pdf", 1, "a password is needed"},
        {"locked.pdf -o out.pdf --password x", 1, "wrong password"},
        {"same.pdf -o ./same.pdf", 2, "would overwrite the input same.pdf"},
        {"in.pdf -o out.pdf --pages 2", 2, "give numbers from 1 to 1"},
        {"in.pdf -o out.pdf --origin 410815300,0", 2, "page 1: 138 columns"},
        {"in.pdf -o out.pdf --margin 30", 2, "leaves nothing"},
        {"in.pdf -o out.pdf --lighten 1", 2, "under 1"},
    };
    for (const Case& tried : cases) {
        run(std::string("$T overlay ") + tried.arguments);
        EXPECT_EQ(exit_code_, tried.exit_code) << tried.arguments;
        EXPECT_THAT(output_, HasSubstr(tried.message)) << tried.arguments;
        EXPECT_FALSE(exists("out.pdf")) << tried.arguments;
    }
    EXPECT_EQ(run("cmp in.pdf same.pdf"), 0);
}

TEST_F(PdfCommands, a_signal_stops_overlay_and_leaves_no_litter) {
    run(std::string("$T print -o in.pdf --paper 3500x3500 --spacing 50 > /dev/null; "
                    "$T overlay in.pdf -o out.pdf & tool=$!; ") +
        kUntilItHandlesSignals + "kill $tool; wait $tool");
    EXPECT_EQ(exit_code_, 1);
    EXPECT_EQ(output_, "dotpose: stopped; nothing was written\n");
    run("ls -A");
    EXPECT_EQ(output_, "in.pdf\n");
}

TEST_F(PdfCommands, overlay_help_shows_an_example) {
    run("$T overlay --help");
    EXPECT_EQ(exit_code_, 0);
    EXPECT_THAT(output_, HasSubstr("dotpose overlay form.pdf -o form-dots.pdf"));
}

TEST_F(PdfCommands, copies_of_a_document_get_cells_of_their_own) {
    run("$T print -o in.pdf --pages 2 --paper 80x60 --spacing 2 > /dev/null && qpdf --linearize "
        "in.pdf plain.pdf && $T overlay plain.pdf -o out.pdf --copies 3 --pages 2 --sheets s.json "
        "--name form && pdfinfo out.pdf && qpdf --check out.pdf");
    ASSERT_EQ(exit_code_, 0) << output_;
    EXPECT_THAT(output_, HasSubstr("Pages:           6"));
    const nlohmann::json sheets = nlohmann::json::parse(file("s.json"))["sheets"];
    ASSERT_EQ(sheets.size(), 3U);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(sheets[i]["name"], "form-" + std::to_string(2 * i + 2));
        EXPECT_THAT(sheets[i]["print"]["command"], HasSubstr("overlay plain.pdf"));
        EXPECT_THAT(sheets[i]["print"]["command"], HasSubstr(" --pages 2 --origin "));
        EXPECT_THAT(sheets[i]["print"]["command"], Not(HasSubstr("--copies")));
    }
}

TEST_F(PdfCommands, dots_over_dots_are_noticed) {
    const std::string warning = "it already has dots of dotpose";
    run("$T print -o in.pdf --paper 80x60 && printf '.pl 8c\\nText.\\n' > page.roff && "
        "groff -P-p8c,6c -Tpdf page.roff > text.pdf && $T overlay text.pdf -o once.pdf");
    ASSERT_EQ(exit_code_, 0) << output_;
    EXPECT_THAT(output_, Not(HasSubstr(warning)));
    EXPECT_THAT(output_, HasSubstr("--cmy-black"));
    EXPECT_THAT(output_, HasSubstr("--lighten"));
    for (const char* dotted : {"in.pdf", "once.pdf"}) {
        run(std::string("$T overlay ") + dotted + " -o twice.pdf");
        EXPECT_EQ(exit_code_, 0);
        EXPECT_THAT(output_, HasSubstr("warning: page 1: " + warning)) << dotted;
    }
}

TEST_F(PdfCommands, labels_are_in_any_script) {
    const std::string names =
        "\u0421\u0442\u043e\u043b \u03a4\u03c1\u03b1\u03c0\u03ad\u03b6\u03b9 "
        "\u05e9\u05d5\u05dc\u05d7\u05df";
    run("$T print -o a.pdf --paper 100x80 --sheets s.json --name '" + names + "'");
    ASSERT_EQ(exit_code_, 0) << output_;
    run("qpdf --check a.pdf && pdftotext a.pdf - && pdffonts a.pdf");
    EXPECT_EQ(exit_code_, 0) << output_;
    EXPECT_THAT(output_,
                HasSubstr("\u0421\u0442\u043e\u043b \u03a4\u03c1\u03b1\u03c0\u03ad\u03b6\u03b9"));
    EXPECT_THAT(output_, Not(HasSubstr("?")));
    run("gs -q -sDEVICE=ink_cov -r600 -o - a.pdf");
    EXPECT_THAT(output_, HasSubstr(" 0.00000  0.00000  0.00000 "));
}

}  // namespace
}  // namespace dotpose::test
