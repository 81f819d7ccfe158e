#include <cstdint>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "../../paths.hpp"
#include "../print/files.hpp"
#include "dotpose/files/code_names.hpp"
#include "dotpose/files/sheet_file.hpp"
#include "dotpose/tools/print.hpp"
#include "sheet_files.hpp"

namespace dotpose {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using print_test::hand_written;
using print_test::read_file;
using print_test::TemporaryDirectory;
using print_test::write_file;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(read_sheets, reads_every_value) {
    const TemporaryDirectory directory;
    write_file(directory / "s.json", hand_written().dump());
    const auto sheets = read_sheets(directory / "s.json");
    ASSERT_EQ(sheets.size(), 1U);
    const SheetEntry& table = sheets[0];
    EXPECT_EQ(table.name, "table");
    EXPECT_EQ(table.page, 2);
    EXPECT_EQ(table.sheet.pattern.code, CodeVariant::microdots);
    EXPECT_EQ(table.sheet.pattern.section, (Section{5, 62}));
    EXPECT_EQ(table.sheet.pattern.spacing_mm, 0.6);
    EXPECT_EQ(table.sheet.pattern.displacement_mm, 0.1);
    EXPECT_EQ(table.sheet.pattern.dot_mm, 0.12);
    EXPECT_EQ(table.sheet.origin, (Cell{1000, 410'000'000}));
    EXPECT_EQ(table.sheet.columns, 20);
    EXPECT_EQ(table.sheet.rows, 10);
    EXPECT_EQ(table.sheet.width_mm, 40);
    EXPECT_EQ(table.sheet.height_mm, 30);
    EXPECT_EQ(table.sheet.origin_x_mm, 7.5);
    EXPECT_EQ(table.sheet.origin_y_mm, 8.25);
    EXPECT_EQ(table.print_scale_x, 1.01);
    EXPECT_EQ(table.print_scale_y, 0.99);
    ASSERT_TRUE(table.world);
    EXPECT_EQ(table.world->x_m, -1.5);
    EXPECT_EQ(table.world->y_m, 2);
    EXPECT_EQ(table.world->yaw_rad, 3);
}

TEST(read_sheets, print_scale_and_world_may_be_missing) {
    const TemporaryDirectory directory;
    json document = hand_written();
    for (const char* key : {"print_scale_x", "print_scale_y", "world"})
        document["sheets"][0].erase(key);
    write_file(directory / "s.json", document.dump());
    const auto sheets = read_sheets(directory / "s.json");
    ASSERT_EQ(sheets.size(), 1U);
    EXPECT_EQ(sheets[0].print_scale_x, 1);
    EXPECT_EQ(sheets[0].print_scale_y, 1);
    EXPECT_FALSE(sheets[0].world);
}

TEST(read_sheets, reads_the_example_of_the_documentation) {
    const std::string page = read_file(test::source_dir() + "/docs/sheet-files.md");
    const std::string start = "```json\n";
    const std::size_t first = page.find(start) + start.size();
    const TemporaryDirectory directory;
    write_file(directory / "s.json", page.substr(first, page.find("```", first) - first));
    const auto sheets = read_sheets(directory / "s.json");
    ASSERT_EQ(sheets.size(), 1U);
    // The documented example must match the entry that the command above the example writes.
    SheetFile file(directory / "other.json");
    const SheetEntry table = file.allocate("table", make_sheet({}))[0];
    EXPECT_EQ(sheets[0].sheet.origin, table.sheet.origin);
    EXPECT_EQ(sheets[0].sheet.columns, table.sheet.columns);
    EXPECT_EQ(sheets[0].sheet.rows, table.sheet.rows);
    EXPECT_NEAR(sheets[0].sheet.origin_x_mm, table.sheet.origin_x_mm, 1e-9);
    EXPECT_TRUE(sheets[0].world);
    const std::string text = read_file(directory / "s.json");
    SheetFile same(directory / "s.json");
    same.save();
    EXPECT_EQ(read_file(directory / "s.json"), text);
}

void expect_refused(const std::string& text, const std::string& problem) {
    const TemporaryDirectory directory;
    write_file(directory / "s.json", text);
    EXPECT_THAT([&] { (void)read_sheets(directory / "s.json"); },
                ThrowsMessage<Error>(AllOf(HasSubstr("s.json"), HasSubstr(problem))))
        << text;
    // Opening the file for changes reports the same error, and the file remains unchanged.
    EXPECT_THAT([&] { const SheetFile file(directory / "s.json"); },
                ThrowsMessage<Error>(HasSubstr(problem)));
    EXPECT_EQ(read_file(directory / "s.json"), text);
    EXPECT_THAT(directory.names(), ElementsAre("s.json"));
}

TEST(read_sheets, refuses_other_files) {
    expect_refused("", "is not a sheet file");
    expect_refused("<svg/>", "is not a sheet file: parse error at line 1, column 1");
    expect_refused("{\"format\": \"dotpose-sheets\", ", "is not a sheet file: parse error");
    expect_refused(std::string(100'000, '['), "is not a sheet file");
    expect_refused("\xff\xfe", "is not a sheet file");
    expect_refused("[]", "is not a sheet file");
    expect_refused("null", "is not a sheet file");
    expect_refused("{}", "is not a sheet file");
    expect_refused(R"({"format": "other", "version": 1, "sheets": []})", "is not a sheet file");
    expect_refused(R"({"format": 1, "version": 1, "sheets": []})", "is not a sheet file");
    expect_refused(R"({"format": "dotpose-sheets", "sheets": []})", "version is missing");
    expect_refused(R"({"format": "dotpose-sheets", "version": 2, "sheets": []})",
                   "version is 2; this dotpose reads version 1");
    expect_refused(R"({"format": "dotpose-sheets", "version": "1", "sheets": []})",
                   "version must be a whole number");
    expect_refused(R"({"format": "dotpose-sheets", "version": 1})", "sheets is missing");
    expect_refused(R"({"format": "dotpose-sheets", "version": 1, "sheets": {}})",
                   "sheets must be an array");
    expect_refused(R"({"format": "dotpose-sheets", "version": 1, "sheets": [7]})",
                   "sheets[0] must be an object");
}

TEST(read_sheets, names_the_key_that_is_missing_or_wrong) {
    const json whole = hand_written();
    for (const auto& [key, value] : whole["sheets"][0].items()) {
        json document = hand_written();
        document["sheets"][0][key] = value.is_string() ? json(7) : json("7");
        expect_refused(document.dump(), "sheets[0]." + key + " must be a");
        if (key.starts_with("print_scale") || key == "world") continue;
        document["sheets"][0].erase(key);
        expect_refused(document.dump(), "sheets[0]." + key + " is missing");
    }
    for (const char* key : {"x_m", "y_m", "yaw_rad"}) {
        json document = hand_written();
        document["sheets"][0]["world"].erase(key);
        expect_refused(document.dump(), std::string("sheets[0].world.") + key + " is missing");
        document["sheets"][0]["world"][key] = nullptr;
        expect_refused(document.dump(),
                       std::string("sheets[0].world.") + key + " must be a number");
    }
}

TEST(read_sheets, refuses_values_out_of_range) {
    const struct {
        const char* key;
        json value;
        const char* problem;
    } wrong[] = {
        {"name", "", "a name that is not empty"},
        {"name", "a\nb", "control characters"},
        {"name",
         "a\xC2\x9B"
         "2J",
         "control characters"},
        {"name",
         "a\xE2\x80\xAE"
         "b",
         "change the writing direction"},
        {"page", 0, "sheets[0].page is 0"},
        {"page", 1.5, "sheets[0].page must be a whole number"},
        {"code", "Anoto", "sheets[0].code is 'Anoto'; it must be anoto, libdots or microdots"},
        {"section_u", 63, "sheets[0].section_u is 63; it must be 0 to 62"},
        {"section_v", -1, "sheets[0].section_v is -1"},
        {"origin_x", 410'815'348, "sheets[0].origin_x is 410815348"},
        {"origin_y", std::uint64_t{1} << 63, "sheets[0].origin_y is 9223372036854775808"},
        {"origin_y", 410'815'340, "run past the end of the code plane"},
        {"columns", 7, "sheets[0].columns is 7; it must be 8 to"},
        {"rows", 1e3, "sheets[0].rows must be a whole number"},
        {"columns", 1000, "do not fit on a page"},
        {"spacing_mm", 0, "the spacing must be more than 0 mm"},
        {"dot_mm", 1, "dots of 1 mm would touch"},
        {"width_mm", -1, "a page of -1 x 30 mm"},
        {"first_x_mm", -2, "do not fit on a page"},
        {"print_scale_x", 101, "a print scale of 101: it must be 0.5 to 2"},
        {"print_scale_y", 0.4, "a print scale of 0.4"},
    };
    for (const auto& [key, value, problem] : wrong) {
        json document = hand_written();
        document["sheets"][0][key] = value;
        expect_refused(document.dump(), problem);
    }
    std::string text = hand_written().dump();
    text.replace(text.find("0.6"), 3, "1e999");
    expect_refused(text, "is not a sheet file: number overflow");
}

TEST(read_sheets, refuses_equal_names_and_shared_cells) {
    json document = hand_written();
    document["sheets"].push_back(document["sheets"][0]);
    document["sheets"][1]["origin_x"] = 5000;
    expect_refused(document.dump(), "sheets[1] (table): there already is a sheet 'table'");
    document["sheets"][1]["name"] = "desk";
    document["sheets"][1]["origin_x"] = 1019;
    document["sheets"][1]["origin_y"] = 410'000'009;
    expect_refused(document.dump(),
                   "sheets[1] (desk): sheet 'desk' would share cells with sheet 'table', which has "
                   "1000,410000000 to 1019,410000009");
    document["sheets"][1]["origin_x"] = 1020;  // beside the region
    const TemporaryDirectory directory;
    write_file(directory / "s.json", document.dump());
    EXPECT_EQ(read_sheets(directory / "s.json").size(), 2U);
}

TEST(read_sheets, says_why_a_file_cannot_be_read) {
    const TemporaryDirectory directory;
    EXPECT_THAT([&] { (void)read_sheets(directory / "s.json"); },
                ThrowsMessage<Error>(AllOf(HasSubstr("cannot read"), HasSubstr("no such file"))));
    fs::create_directory(directory / "folder");
    EXPECT_THAT([&] { (void)read_sheets(directory / "folder"); },
                ThrowsMessage<Error>(HasSubstr("Is a directory")));
    EXPECT_THAT([&] { const SheetFile file(directory / "folder"); },
                ThrowsMessage<Error>(HasSubstr("Is a directory")));
    EXPECT_THAT([&] { const SheetFile file(directory / "missing/s.json"); },
                ThrowsMessage<Error>(AllOf(HasSubstr("cannot lock"), HasSubstr("No such file"))));
}

TEST(code_by_name, is_the_way_back) {
    for (const CodeVariant code :
         {CodeVariant::anoto, CodeVariant::libdots, CodeVariant::microdots})
        EXPECT_EQ(code_by_name(name(code)), code);
    EXPECT_EQ(code_by_name("published"), std::nullopt);
    EXPECT_EQ(code_by_name(""), std::nullopt);
    EXPECT_EQ(code_by_name("Anoto"), std::nullopt);
}

}  // namespace
}  // namespace dotpose
