// Tests that a sheet file and its pages are either both written or both left unchanged, even if
// several tools write at the same time.
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sheets_command.hpp"

namespace dotpose::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

using SheetFileWriting = SheetsCommand;

TEST_F(SheetFileWriting, a_refused_or_failed_print_changes_nothing) {
    ASSERT_EQ(print("-o a.svg --paper 40x40 --sheets sheets.json --name a"), 0);
    const std::string before = read_file(directory_ / "sheets.json");
    const struct {
        const char* arguments;
        int exit_code;
        const char* problem;
    } wrong[] = {
        {"-o b.svg --sheets sheets.json --name a", 2, "there already is a sheet 'a'"},
        {"-o b.svg --sheets sheets.json --name b --origin 1050,1050", 2,
         "sheet 'b' would share cells with sheet 'a', which has 1024,1024 to"},
        {"-o b.svg --sheets sheets.json", 2, "--sheets requires --name"},
        {"-o b.svg --name b", 2, "--name requires --sheets"},
        {"-o b.svg --sheets sheets.json --name ''", 2, "a name that is not empty"},
        {"-o b.svg --sheets '' --name b", 2, "--sheets"},
        {"-o b.jpg --sheets sheets.json --name b", 2, "the name must end in"},
        {"-o b.png --dpi 100 --sheets sheets.json --name b", 2, "100 dpi is too low"},
        {"-o missing/b.svg --sheets sheets.json --name b", 1, "cannot create missing/b.svg"},
        {"-o b.svg --sheets missing/sheets.json --name b", 1, "cannot lock missing/sheets.json"},
        {"-o b.svg --sheets a.svg --name b", 1, "a.svg is not a sheet file"},
    };
    for (const auto& [arguments, exit_code, problem] : wrong) {
        EXPECT_EQ(print(arguments), exit_code) << arguments;
        EXPECT_THAT(errors_, StartsWith("dotpose: ")) << arguments;
        EXPECT_THAT(errors_, HasSubstr(problem)) << arguments;
        EXPECT_EQ(read_file(directory_ / "sheets.json"), before) << arguments;
        EXPECT_FALSE(fs::exists(directory_ / "b.svg")) << arguments;
        EXPECT_FALSE(fs::exists(directory_ / ".sheets.json.lock")) << arguments;
    }
    ASSERT_EQ(print("-o b.svg --paper 40x40 --sheets sheets.json --name b --origin 7,9"), 0);
    EXPECT_EQ(sheets().at(1)["origin_x"], 7);
    EXPECT_EQ(sheets().at(1)["origin_y"], 9);
}

TEST_F(SheetFileWriting, an_interrupted_print_adds_no_sheet) {
    ASSERT_EQ(print("-o a.svg --paper 40x40 --sheets sheets.json --name a"), 0);
    const std::string before = read_file(directory_ / "sheets.json");
    // Printing this page takes minutes, so the tool is terminated before the page is complete.
    const int status = print(
        "-o huge.png --paper 20000x20000 --dpi 1200 --sheets sheets.json --name b & tool=$!; "
        "until ls -A | grep huge > during || ! kill -0 $tool; do sleep 0.02; done; "
        "kill $tool; wait $tool");
    EXPECT_EQ(status, 1);
    EXPECT_THAT(read_file(directory_ / "during"), HasSubstr(".huge.png."));
    EXPECT_EQ(read_file(directory_ / "sheets.json"), before);
    EXPECT_FALSE(fs::exists(directory_ / "huge.png"));
    EXPECT_FALSE(fs::exists(directory_ / ".sheets.json.lock"));
}

TEST_F(SheetFileWriting, no_page_is_written_where_its_entry_cannot_be) {
    ASSERT_EQ(shell("$T print -o in.pdf --paper 40x40 && mkdir folder.json"), 0) << errors_;
    const struct {
        const char* command;
        const char* problem;
    } wrong[] = {
        {"$T print -o new.svg --paper 40x40 --sheets folder.json --name a", "Is a directory"},
        {"$T overlay in.pdf -o new.svg --sheets folder.json --name a", "Is a directory"},
        // Simulates a full disk. Files are limited to 512 bytes, and the entry of one sheet is
        // larger than this limit.
        {"(trap '' XFSZ; ulimit -f 1; $T print -o new.svg --paper 30x20 --sheets s.json --name a)",
         "cannot write s.json: File too large"},
        {"$T print -o new.svg --paper 40x40 --sheets /proc/s.json --name a",
         "cannot lock /proc/s.json"},
    };
    for (const auto& [command, problem] : wrong) {
        EXPECT_EQ(shell(command), 1) << command;
        EXPECT_THAT(errors_, HasSubstr(problem)) << command;
        EXPECT_EQ(shell("ls -A"), 0);
        EXPECT_EQ(output_, "folder.json\nin.pdf\n") << command;
    }
}

TEST_F(SheetFileWriting, a_page_that_cannot_be_written_leaves_no_entry) {
    // Files are limited to 4 blocks of 512 bytes. This is enough for the entry in the sheet file
    // (about 700 bytes), but not for the page.
    EXPECT_EQ(
        shell("trap '' XFSZ; ulimit -f 4; $T print -o a.svg --paper 40x40 --sheets sheets.json "
              "--name a"),
        1);
    EXPECT_THAT(errors_, HasSubstr("cannot write a.svg: File too large"));
    EXPECT_EQ(shell("ls -A"), 0);
    EXPECT_THAT(output_, IsEmpty());
}

TEST_F(SheetFileWriting, waiting_for_others_is_told_and_ends) {
    EXPECT_EQ(
        shell("(exec 9>.sheets.json.lock; flock 9; echo > locked; exec sleep 60) & holder=$!; "
              "until [ -e locked ]; do sleep 0.01; done; "
              "$T print -o a.svg --paper 40x40 --sheets sheets.json --name a --wait 0.1; "
              "code=$?; kill $holder; wait $holder; exit $code"),
        1);
    EXPECT_THAT(errors_, HasSubstr("waiting for another program that is changing sheets.json"));
    EXPECT_THAT(errors_, HasSubstr("another program has been changing it for 0.1 s"));
    EXPECT_FALSE(fs::exists(directory_ / "a.svg"));
    EXPECT_EQ(print("-o a.svg --paper 40x40 --wait 1"), 2);
    EXPECT_THAT(errors_, HasSubstr("--wait requires --sheets"));
}

TEST_F(SheetFileWriting, whoever_is_killed_leaves_no_page_without_its_entry) {
    ASSERT_EQ(shell("for i in 1 2 3 4 5 6 7 8 9 10 11 12; do timeout -s KILL 0.0$((i * 7 + 10)) "
                    "$T print -o n$i.svg --paper 40x40 --sheets sheets.json --name n$i; done; "
                    "$T print -o last.svg --paper 40x40 --sheets sheets.json --name last"),
              0)
        << errors_;
    std::vector<std::string> names;
    for (const json& sheet : sheets())
        names.push_back(sheet["name"]);
    EXPECT_THAT(names, testing::Contains("last"));
    for (const auto& entry : fs::directory_iterator(directory_)) {
        if (entry.path().extension() != ".svg") continue;
        EXPECT_THAT(names, testing::Contains(entry.path().stem().string()));
    }
}

TEST_F(SheetFileWriting, prints_at_the_same_time_all_get_regions_of_their_own) {
    ASSERT_EQ(shell("for i in 1 2 3 4 5 6 7 8; do $T print -o $i.svg --paper 40x40 "
                    "--sheets sheets.json --name n$i & done; wait"),
              0);
    std::vector<std::uint32_t> origins;
    for (const json& sheet : sheets())
        origins.push_back(sheet["origin_x"]);
    // Each region is 59 columns wide. The gaps before and between the regions are 1024 columns
    // wide.
    EXPECT_THAT(origins, ElementsAre(1024, 2107, 3190, 4273, 5356, 6439, 7522, 8605));
}

}  // namespace
}  // namespace dotpose::test
