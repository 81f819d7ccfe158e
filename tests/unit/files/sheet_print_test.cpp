// Tests the print parameters of pages in sheet files, and the renaming of sheets.
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "../print/files.hpp"
#include "dotpose/files/sheet_file.hpp"
#include "sheet_files.hpp"

namespace dotpose {
namespace {

using nlohmann::json;
using print_test::hand_written;
using print_test::page;
using print_test::read_file;
using print_test::TemporaryDirectory;
using print_test::write_file;
using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

SheetPrint some_print() {
    SheetPrint print;
    print.title = "tiles";
    print.pages = 12;
    print.dpi = 1200;
    print.dots = "strokes";
    print.has_labels = false;
    print.command = "dotpose print -o tiles.pdf --origin 1,2";
    print.document = "form.pdf";
    return print;
}

TEST(SheetFile, keeps_how_a_page_was_printed) {
    const TemporaryDirectory directory;
    SheetFile file(directory / "s.json");
    SheetEntry entry = file.allocate("tiles-1", page())[0];
    entry.print = some_print();
    file.replace(entry);
    file.save();
    const SheetPrint print = read_sheets(directory / "s.json").at(0).print.value();
    EXPECT_EQ(print.title, "tiles");
    EXPECT_EQ(print.pages, 12);
    EXPECT_EQ(print.dpi, 1200);
    EXPECT_EQ(print.dots, "strokes");
    EXPECT_FALSE(print.has_labels);
    EXPECT_EQ(print.command, "dotpose print -o tiles.pdf --origin 1,2");
    EXPECT_EQ(print.document, "form.pdf");
}

TEST(SheetFile, a_command_that_is_no_text_does_not_spoil_the_file) {
    const TemporaryDirectory directory;
    SheetFile file(directory / "s.json");
    SheetEntry entry = file.allocate("tiles-1", page())[0];
    entry.print = some_print();
    entry.print->command = "dotpose print -o '\xff.pdf'";
    file.replace(entry);
    file.save();
    EXPECT_EQ(read_sheets(directory / "s.json").at(0).print->command,
              "dotpose print -o '\xEF\xBF\xBD.pdf'");
}

TEST(SheetFile, refuses_prints_that_cannot_be) {
    const TemporaryDirectory directory;
    const json print = {{"title", "a"},   {"pages", 1},     {"dpi", 600},
                        {"dots", "auto"}, {"labels", true}, {"command", "b"}};
    const struct {
        const char* key;
        json value;
        const char* problem;
    } wrong[] = {
        {"dpi", 0, "(table): 0 dpi: a resolution is above 0"},
        {"dpi", "600", "sheets[0].print.dpi must be a number"},
        {"dots", "ink", "dots drawn as 'ink'"},
        {"pages", 0, "sheets[0].print.pages is 0; it must be 1 to"},
        {"labels", 1, "sheets[0].print.labels must be true or false"},
        {"title", 7, "sheets[0].print.title must be a string"},
        {"document", 7, "sheets[0].print.document must be a string"},
    };
    for (const auto& [key, value, problem] : wrong) {
        json document = hand_written();
        document["sheets"][0]["print"] = print;
        document["sheets"][0]["print"][key] = value;
        write_file(directory / "s.json", document.dump());
        EXPECT_THAT([&] { (void)read_sheets(directory / "s.json"); },
                    ThrowsMessage<Error>(AllOf(HasSubstr("s.json"), HasSubstr(problem))));
    }
}

TEST(SheetFile, renamed_sheets_keep_their_unknown_keys_and_no_others) {
    const TemporaryDirectory directory;
    {
        SheetFile file(directory / "s.json");
        file.allocate("a", page());
        file.allocate("b", page());
        file.save();
    }
    json document = json::parse(read_file(directory / "s.json"));
    document["sheets"][0]["colour"] = "red";
    document["sheets"][1]["colour"] = "blue";
    write_file(directory / "s.json", document.dump());
    SheetFile file(directory / "s.json");
    file.rename("a", "c");
    file.rename("b", "a");
    file.rename("c", "d");
    file.rename("d", "d");
    file.save();
    file.rename("d", "e");
    file.save();
    const json sheets = json::parse(read_file(directory / "s.json"))["sheets"];
    ASSERT_EQ(sheets.size(), 2U);
    EXPECT_EQ(sheets[0]["name"], "e");
    EXPECT_EQ(sheets[0]["colour"], "red");
    EXPECT_EQ(sheets[1]["name"], "a");
    EXPECT_EQ(sheets[1]["colour"], "blue");
    EXPECT_THAT([&] { file.rename("x", "y"); },
                ThrowsMessage<BadArgument>(HasSubstr("has no sheet 'x'")));
    EXPECT_THAT([&] { file.rename("a", "e"); },
                ThrowsMessage<BadArgument>(HasSubstr("there already is a sheet 'e'")));
    EXPECT_EQ(file.sheets()[1].name, "a");
}

}  // namespace
}  // namespace dotpose
