#include <array>
#include <cstdio>
#include <filesystem>
#include <stdexcept>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stdlib.h>
#include <sys/wait.h>

namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

struct Outcome {
    int exit_code = -1;
    std::string output;  ///< standard output and standard error
};

/// Shell commands in a directory of their own, in which $T is the tool.
class PdfCommands : public testing::Test {
  protected:
    void SetUp() override {
        std::string name = (fs::temp_directory_path() / "dotpose-pdf-XXXXXX").string();
        ASSERT_NE(mkdtemp(name.data()), nullptr);
        directory_ = name;
    }
    void TearDown() override { fs::remove_all(directory_); }

    Outcome run(const std::string& commands) const {
        const std::string line = "cd '" + directory_.string() + "' && T='" DOTPOSE_TOOL "' && { " +
                                 commands + "; } 2>&1";
        std::FILE* pipe = popen(line.c_str(), "r");
        if (pipe == nullptr) throw std::runtime_error("cannot run " + line);
        Outcome outcome;
        std::array<char, 4096> buffer;
        while (std::fgets(buffer.data(), static_cast<int>(buffer.size()), pipe) != nullptr)
            outcome.output += buffer.data();
        const int status = pclose(pipe);
        if (WIFEXITED(status)) outcome.exit_code = WEXITSTATUS(status);
        return outcome;
    }
    bool exists(const char* name) const { return fs::exists(directory_ / name); }

    fs::path directory_;
};

TEST_F(PdfCommands, print_makes_pages_with_text_that_can_be_selected) {
    const Outcome printed =
        run("$T print -o 'my sheet.pdf' --pages 3 --paper A6 --section 1,2 --origin 9,8");
    EXPECT_EQ(printed.exit_code, 0);
    // 85 mm and 128 mm between the margins of 10 mm hold 167 and 252 cells of 0.508 mm.
    EXPECT_THAT(printed.output,
                HasSubstr("my sheet.pdf: 1/3, page 105 x 148 mm, cells 9,8 to 175,259 "));
    EXPECT_THAT(printed.output, HasSubstr("3/3, page 105 x 148 mm, cells 343,8 to 509,259 "));
    const Outcome text = run("qpdf --check 'my sheet.pdf' && pdftotext -f 2 -l 2 'my sheet.pdf' -");
    EXPECT_EQ(text.exit_code, 0);
    EXPECT_THAT(text.output, HasSubstr("my sheet, page 2 of 3, cells 176,8 to 342,259"));
    EXPECT_THAT(text.output, HasSubstr("section 1,2"));
    EXPECT_THAT(text.output, HasSubstr("print at 100 %"));
    EXPECT_THAT(text.output, HasSubstr("--section 1,2 --origin 9,8"));
    EXPECT_THAT(text.output, Not(HasSubstr("uulu"))) << "the dots are letters, but no text";
}

TEST_F(PdfCommands, paper_sizes_and_landscape_are_true) {
    // In points: 72 / 25.4 per mm, as pdfinfo rounds them.
    const std::array<std::array<const char*, 2>, 4> sizes = {
        {{"A0", "2383.94 x 3370.39"},
         {"A4 --landscape", "841.89 x 595.276"},
         {"Tabloid", "792 x 1224"},
         {"40x25.4", "113.386 x 72"}}};
    for (const auto& [paper, points] : sizes) {
        const Outcome outcome =
            run(std::string("$T print -o a.pdf --margin 3 --paper ") + paper + " && pdfinfo a.pdf");
        EXPECT_THAT(outcome.output, HasSubstr(std::string(points) + " pts")) << paper;
    }
}

TEST_F(PdfCommands, only_black_ink_is_used) {
    const Outcome inks =
        run("$T print -o a.pdf --paper A6 && gs -q -sDEVICE=ink_cov -r600 -o - a.pdf");
    EXPECT_EQ(inks.exit_code, 0);
    EXPECT_THAT(inks.output, HasSubstr(" 0.00000  0.00000  0.00000 "));
    EXPECT_THAT(inks.output, Not(HasSubstr(" 0.00000 CMYK"))) << "but there is some";
}

TEST_F(PdfCommands, print_refuses_what_a_pdf_cannot_be) {
    for (const char* arguments : {"-o a.png --pages 2", "-o a.pdf --pages 0", "-o a.pdf --dots ink",
                                  "-o a.pdf --spacing 0.5 --dots glyphs", "-o a.pdf --dpi 100"}) {
        const Outcome outcome = run(std::string("$T print ") + arguments);
        EXPECT_EQ(outcome.exit_code, 2) << arguments;
        EXPECT_THAT(outcome.output, StartsWith("dotpose: ")) << arguments;
        EXPECT_TRUE(fs::is_empty(directory_)) << arguments;
    }
}

TEST_F(PdfCommands, overlay_says_which_region_each_page_got) {
    const Outcome outcome =
        run("$T print -o in.pdf --pages 3 --paper 80x60 > /dev/null && "
            "$T overlay in.pdf -o out.pdf --pages 1,z --origin 5000,10 --spacing 1");
    EXPECT_EQ(outcome.exit_code, 0);
    // 70 mm and 50 mm between the margins of 5 mm.
    EXPECT_THAT(outcome.output, HasSubstr("out.pdf 1: page 80 x 60 mm, cells 5000,10 to 5069,59 "));
    EXPECT_THAT(outcome.output, HasSubstr("out.pdf 3: page 80 x 60 mm, cells 5070,10 to 5139,59 "));
    EXPECT_THAT(outcome.output, HasSubstr("warning: pages 1, 3: black text or drawings hide dots"));
}

TEST_F(PdfCommands, overlay_refuses_and_writes_nothing) {
    ASSERT_EQ(
        run("$T print -o in.pdf --paper 80x60 && head -c 900 in.pdf > cut.pdf && echo x > no.pdf "
            "&& cp in.pdf same.pdf && qpdf --encrypt u o 256 -- in.pdf locked.pdf")
            .exit_code,
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
        {"no.pdf -o out.pdf", 1, "no.pdf: damaged PDF"},
        {"cut.pdf -o out.pdf", 1, "cut.pdf: damaged PDF"},
        {"locked.pdf -o out.pdf", 1, "a password is needed"},
        {"locked.pdf -o out.pdf --password x", 1, "wrong password"},
        {"same.pdf -o ./same.pdf", 2, "is the document itself"},
        {"in.pdf -o out.pdf --pages 2", 2, "give numbers from 1 to 1"},
        {"in.pdf -o out.pdf --origin 410815300,0", 2, "page 1: 138 columns"},
        {"in.pdf -o out.pdf --margin 30", 2, "leaves nothing"},
        {"in.pdf -o out.pdf --lighten 1", 2, "under 1"},
    };
    for (const Case& tried : cases) {
        const Outcome outcome = run(std::string("$T overlay ") + tried.arguments);
        EXPECT_EQ(outcome.exit_code, tried.exit_code) << tried.arguments;
        EXPECT_THAT(outcome.output, HasSubstr(tried.message)) << tried.arguments;
        EXPECT_FALSE(exists("out.pdf")) << tried.arguments;
    }
    EXPECT_EQ(run("cmp in.pdf same.pdf").exit_code, 0);
}

TEST_F(PdfCommands, a_signal_stops_overlay_and_leaves_no_litter) {
    const Outcome outcome =
        run("$T print -o in.pdf --paper 8000x8000 --spacing 50 > /dev/null; $T overlay in.pdf -o "
            "out.pdf & "
            "tool=$!; sleep 0.5; kill $tool; wait $tool");
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_EQ(outcome.output, "dotpose: stopped; nothing was written\n");
    EXPECT_EQ(run("ls -A").output, "in.pdf\n");
}

TEST_F(PdfCommands, overlay_help_shows_an_example) {
    const Outcome outcome = run("$T overlay --help");
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_THAT(outcome.output, HasSubstr("dotpose overlay form.pdf -o form-dots.pdf"));
}

}  // namespace
