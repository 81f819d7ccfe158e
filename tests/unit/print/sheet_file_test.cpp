#include "dotpose/sheet_file.hpp"

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "dotpose/print.hpp"
#include "files.hpp"

namespace dotpose {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using print_test::read_file;
using print_test::TemporaryDirectory;
using print_test::write_file;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

Sheet page(double width_mm = 30, double height_mm = 20) {
    SheetOptions options;
    options.paper = {.width_mm = width_mm, .height_mm = height_mm};
    return make_sheet(options);
}

SheetEntry entry(const std::string& name, Cell origin) {
    SheetEntry entry;
    entry.name = name;
    entry.sheet = page();
    entry.sheet.origin = origin;
    return entry;
}

/// A file as a user may have written it.
json hand_written() {
    return json::parse(R"({
        "format": "dotpose-sheets", "version": 1,
        "sheets": [{
            "name": "table", "page": 2, "code": "microdots", "section_u": 5, "section_v": 62,
            "origin_x": 1000, "origin_y": 410000000, "columns": 20, "rows": 10,
            "spacing_mm": 0.6, "displacement_mm": 0.1, "dot_mm": 0.12,
            "width_mm": 40, "height_mm": 30, "first_x_mm": 7.5, "first_y_mm": 8.25,
            "print_scale_x": 1.01, "print_scale_y": 0.99,
            "world": {"x_m": -1.5, "y_m": 2, "yaw_rad": 3}
        }]
    })");
}

TEST(read_sheets, reads_every_value) {
    const TemporaryDirectory directory;
    write_file(directory / "s.json", hand_written().dump());
    const auto sheets = read_sheets(directory / "s.json");
    ASSERT_EQ(sheets.size(), 1U);
    const SheetEntry& table = sheets[0];
    EXPECT_EQ(table.name, "table");
    EXPECT_EQ(table.page, 2);
    EXPECT_EQ(table.sheet.pattern.profile, Profile::microdots);
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
    const std::string page = read_file(DOTPOSE_SOURCE_DIR "/docs/sheet-files.md");
    const std::string start = "```json\n";
    const std::size_t first = page.find(start) + start.size();
    const TemporaryDirectory directory;
    write_file(directory / "s.json", page.substr(first, page.find("```", first) - first));
    const auto sheets = read_sheets(directory / "s.json");
    ASSERT_EQ(sheets.size(), 1U);
    // The page that the text above the example prints.
    SheetFile file(directory / "other.json");
    const SheetEntry table = file.allocate("table", make_sheet({}))[0];
    EXPECT_EQ(sheets[0].sheet.origin, table.sheet.origin);
    EXPECT_EQ(sheets[0].sheet.columns, table.sheet.columns);
    EXPECT_EQ(sheets[0].sheet.rows, table.sheet.rows);
    EXPECT_NEAR(sheets[0].sheet.origin_x_mm, table.sheet.origin_x_mm, 1e-9);
    EXPECT_TRUE(sheets[0].world);
    // Saved again, it is the same text.
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
    // Who wants to change the file is told the same, and the file stays as it is.
    EXPECT_THAT([&] { const SheetFile file(directory / "s.json"); },
                ThrowsMessage<Error>(HasSubstr(problem)));
    EXPECT_EQ(read_file(directory / "s.json"), text);
    EXPECT_THAT(directory.names(), ElementsAre("s.json"));
}

TEST(read_sheets, refuses_other_files) {
    expect_refused("", "is no sheet file");
    expect_refused("<svg/>", "is no sheet file: parse error at line 1, column 1");
    expect_refused("{\"format\": \"dotpose-sheets\", ", "is no sheet file: parse error");
    expect_refused(std::string(100'000, '['), "is no sheet file");
    expect_refused("\xff\xfe", "is no sheet file");
    expect_refused("[]", "is no sheet file");
    expect_refused("null", "is no sheet file");
    expect_refused("{}", "is no sheet file");
    expect_refused(R"({"format": "other", "version": 1, "sheets": []})", "is no sheet file");
    expect_refused(R"({"format": 1, "version": 1, "sheets": []})", "is no sheet file");
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
        {"page", 0, "sheets[0].page is 0"},
        {"page", 1.5, "sheets[0].page must be a whole number"},
        {"code", "Anoto", "sheets[0].code is 'Anoto'; it must be anoto, published or microdots"},
        {"section_u", 63, "sheets[0].section_u is 63; it must be 0 to 62"},
        {"section_v", -1, "sheets[0].section_v is -1"},
        {"origin_x", 410'815'348, "sheets[0].origin_x is 410815348"},
        {"origin_y", std::uint64_t{1} << 63, "sheets[0].origin_y is 9223372036854775808"},
        {"origin_y", 410'815'340, "run past the end of the code plane"},
        {"columns", 7, "sheets[0].columns is 7; it must be 8 to"},
        {"rows", 1e3, "sheets[0].rows must be a whole number"},
        {"columns", 1000, "do not lie on a page"},
        {"spacing_mm", 0, "the spacing must be more than 0 mm"},
        {"dot_mm", 1, "dots of 1 mm would touch"},
        {"width_mm", -1, "a page of -1 x 30 mm"},
        {"first_x_mm", -2, "do not lie on a page"},
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
    expect_refused(text, "is no sheet file: number overflow");
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
    document["sheets"][1]["origin_x"] = 1020;  // beside it
    const TemporaryDirectory directory;
    write_file(directory / "s.json", document.dump());
    EXPECT_EQ(read_sheets(directory / "s.json").size(), 2U);
}

TEST(read_sheets, says_why_a_file_cannot_be_read) {
    const TemporaryDirectory directory;
    EXPECT_THAT([&] { (void)read_sheets(directory / "s.json"); },
                ThrowsMessage<Error>(
                    AllOf(HasSubstr("cannot read"), HasSubstr("No such file or directory"))));
    fs::create_directory(directory / "folder");
    EXPECT_THAT([&] { (void)read_sheets(directory / "folder"); },
                ThrowsMessage<Error>(HasSubstr("Is a directory")));
    EXPECT_THAT([&] { const SheetFile file(directory / "folder"); },
                ThrowsMessage<Error>(HasSubstr("Is a directory")));
    EXPECT_THAT([&] { const SheetFile file(directory / "missing/s.json"); },
                ThrowsMessage<Error>(AllOf(HasSubstr("cannot lock"), HasSubstr("No such file"))));
}

TEST(overlap, means_a_common_cell_in_the_same_section_of_the_same_code) {
    const Sheet a = page();
    Sheet b = a;
    EXPECT_TRUE(overlap(a, b));
    b.pattern.profile = Profile::published;  // agrees with anoto on most of the plane
    EXPECT_TRUE(overlap(a, b));
    b.pattern.profile = Profile::microdots;
    EXPECT_FALSE(overlap(a, b));
    b = a;
    b.pattern.section.v = 1;
    EXPECT_FALSE(overlap(a, b));
    b = a;
    b.origin.x = static_cast<std::uint32_t>(a.columns - 1);
    EXPECT_TRUE(overlap(a, b));
    EXPECT_TRUE(overlap(b, a));
    b.origin.x += 1;
    EXPECT_FALSE(overlap(a, b));
    EXPECT_FALSE(overlap(b, a));
    b.origin = {.x = 0, .y = static_cast<std::uint32_t>(a.rows)};
    EXPECT_FALSE(overlap(a, b));
}

/// Free cells between two regions, along the axis on which they are farther apart.
std::int64_t gap_between(const Sheet& a, const Sheet& b) {
    const auto along = [](std::int64_t a0, std::int64_t an, std::int64_t b0, std::int64_t bn) {
        return std::max(b0 - (a0 + an), a0 - (b0 + bn));
    };
    return std::max(along(a.origin.x, a.columns, b.origin.x, b.columns),
                    along(a.origin.y, a.rows, b.origin.y, b.rows));
}

TEST(SheetFile, allocates_regions_that_keep_their_distance) {
    const TemporaryDirectory directory;
    std::mt19937 random(4);
    std::printf("seed 4\n");
    SheetFile file(directory / "s.json");
    // Some regions that others chose, in other sections and profiles too.
    for (int i = 0; i < 10; ++i) {
        SheetEntry other = entry("old " + std::to_string(i), {});
        other.sheet.origin = {static_cast<std::uint32_t>(random() % 6000),
                              static_cast<std::uint32_t>(i * 700)};
        other.sheet.pattern.section.u = static_cast<std::uint8_t>(random() % 63);
        if (i % 2 == 0) other.sheet.pattern.profile = Profile::microdots;
        file.add(other);
    }
    for (int i = 0; i < 10; ++i) {
        const double width_mm = 20 + static_cast<double>(random() % 400);
        file.allocate("new " + std::to_string(i), page(width_mm, 50), 1 + i % 3);
    }
    const auto& sheets = file.sheets();
    ASSERT_EQ(sheets.size(), 10U + 4 * 1 + 3 * 2 + 3 * 3);
    for (std::size_t i = 10; i < sheets.size(); ++i) {
        const Sheet& sheet = sheets[i].sheet;
        EXPECT_GE(sheet.origin.x, 1024U);
        EXPECT_GE(sheet.origin.y, 1024U);
        for (std::size_t k = 0; k < i; ++k)
            EXPECT_GE(gap_between(sheet, sheets[k].sheet), 1024) << i << " " << k;
    }
}

TEST(SheetFile, the_gap_is_wider_than_the_largest_frame) {
    // 4096 x 4096 px is the largest frame, 6 px the least spacing.
    EXPECT_GT(kSheetGap_cells, std::sqrt(2.0) * 4096 / 6);
}

TEST(SheetFile, allocates_from_the_top_left_and_fills_holes) {
    const TemporaryDirectory directory;
    SheetFile file(directory / "s.json");
    const Sheet sheet = page();
    const auto columns = static_cast<std::uint32_t>(sheet.columns);
    const auto pages = file.allocate("book", sheet, 3);
    ASSERT_EQ(pages.size(), 3U);
    for (std::uint32_t i = 0; i < 3; ++i) {
        EXPECT_EQ(pages[i].name, "book-" + std::to_string(i + 1));
        EXPECT_EQ(pages[i].page, static_cast<int>(i) + 1);
        EXPECT_EQ(pages[i].sheet.origin, (Cell{1024 + i * (columns + 1024), 1024}));
    }
    // Leaves exactly one page's place in the first row of pages.
    file.add(entry("later", {1024 + 4 * (columns + 1024), 1024}));
    EXPECT_EQ(file.allocate("hole", sheet)[0].sheet.origin,
              (Cell{1024 + 3 * (columns + 1024), 1024}));
    EXPECT_EQ(file.allocate("next", sheet)[0].sheet.origin,
              (Cell{1024 + 5 * (columns + 1024), 1024}));
}

TEST(SheetFile, starts_another_row_and_ends_with_the_plane) {
    const TemporaryDirectory directory;
    SheetFile file(directory / "s.json");
    constexpr std::uint32_t kLargest = kPositionsPerAxis - 2 * 1024;
    Sheet wide = page();
    wide.pattern.spacing_mm = 1e-4;
    wide.pattern.displacement_mm = wide.pattern.dot_mm = 1e-5;
    wide.width_mm = wide.height_mm = kMaxPage_mm;
    wide.origin_x_mm = wide.origin_y_mm = 1;
    wide.columns = static_cast<int>(kLargest);
    wide.rows = 100'000'000;
    EXPECT_EQ(file.allocate("a", wide)[0].sheet.origin, (Cell{1024, 1024}));
    EXPECT_EQ(file.allocate("b", wide)[0].sheet.origin, (Cell{1024, 100'002'048}));
    EXPECT_EQ(file.allocate("c", wide)[0].sheet.origin, (Cell{1024, 200'003'072}));
    // Of two that do not both fit none is added.
    wide.rows = 60'000'000;
    EXPECT_THAT([&] { file.allocate("d", wide, 2); },
                ThrowsMessage<BadArgument>(
                    HasSubstr("no free region of 410813300 x 60000000 cells is left")));
    EXPECT_EQ(file.sheets().size(), 3U);
    EXPECT_EQ(file.allocate("d", wide)[0].sheet.origin, (Cell{1024, 300'004'096}));
}

TEST(SheetFile, refuses_what_is_taken) {
    const TemporaryDirectory directory;
    SheetFile file(directory / "s.json");
    file.add(entry("a", {100, 100}));
    EXPECT_THAT(
        [&] {
            file.add(entry("a", {5000, 100}));
        },
        ThrowsMessage<BadArgument>(HasSubstr("there already is a sheet 'a'")));
    EXPECT_THAT(
        [&] {
            file.add(entry("b", {101, 101}));
        },
        ThrowsMessage<BadArgument>(HasSubstr("would share cells with sheet 'a'")));
    EXPECT_THROW(file.allocate("a", page()), BadArgument);
    EXPECT_THROW(file.allocate("", page()), BadArgument);
    EXPECT_THROW(file.allocate("", page(), 2), BadArgument);
    EXPECT_THROW(file.allocate("\xff", page()), BadArgument);
    EXPECT_THROW(file.allocate("c", page(), 0), BadArgument);
    EXPECT_THAT(
        [&] {
            file.replace(entry("c", {100, 100}));
        },
        ThrowsMessage<BadArgument>(HasSubstr("has no sheet 'c'")));
    SheetEntry nowhere = entry("c", {9000, 100});
    nowhere.world = {std::numeric_limits<double>::quiet_NaN(), 0, 0};
    EXPECT_THROW(file.add(nowhere), BadArgument);
    EXPECT_EQ(file.sheets().size(), 1U);
}

void expect_equal(const SheetEntry& a, const SheetEntry& b) {
    EXPECT_EQ(a.name, b.name);
    EXPECT_EQ(a.page, b.page);
    const auto numbers = [](const SheetEntry& e) {
        const Sheet& s = e.sheet;
        return std::vector<double>{s.pattern.spacing_mm,
                                   s.pattern.displacement_mm,
                                   s.pattern.dot_mm,
                                   s.width_mm,
                                   s.height_mm,
                                   s.origin_x_mm,
                                   s.origin_y_mm,
                                   e.print_scale_x,
                                   e.print_scale_y,
                                   double(s.columns),
                                   double(s.rows),
                                   e.world ? e.world->x_m : 0,
                                   e.world ? e.world->y_m : 0,
                                   e.world ? e.world->yaw_rad : 0};
    };
    EXPECT_EQ(numbers(a), numbers(b));
    EXPECT_EQ(a.sheet.origin, b.sheet.origin);
    EXPECT_EQ(a.sheet.pattern.profile, b.sheet.pattern.profile);
    EXPECT_EQ(a.sheet.pattern.section, b.sheet.pattern.section);
    EXPECT_EQ(a.world.has_value(), b.world.has_value());
}

TEST(SheetFile, what_is_saved_is_read_back_exactly) {
    const TemporaryDirectory directory;
    SheetEntry full = entry("\"Tisch\" Nº 1", {123'456'789, 400'000'000});
    full.page = 7;
    full.sheet.pattern.profile = Profile::published;
    full.sheet.pattern.section = {62, 1};
    full.print_scale_x = 1 + 1e-9 / 3;
    full.world = {1e-7 / 3, -12345.6789, -3.0 / 7};
    {
        SheetFile file(directory / "s.json");
        file.add(full);
        file.allocate("b", page(), 2);
        EXPECT_FALSE(fs::exists(directory / "s.json"));
        file.save();
    }
    EXPECT_THAT(directory.names(), ElementsAre("s.json"));
    const auto sheets = read_sheets(directory / "s.json");
    ASSERT_EQ(sheets.size(), 3U);
    expect_equal(sheets[0], full);
    // Saving what was read changes no byte.
    const std::string text = read_file(directory / "s.json");
    SheetFile file(directory / "s.json");
    file.save();
    EXPECT_EQ(read_file(directory / "s.json"), text);
}

TEST(SheetFile, keeps_keys_it_does_not_know) {
    const TemporaryDirectory directory;
    json document = hand_written();
    document["note"] = "ours";
    document["sheets"][0]["lamp"] = {1, 2};
    document["sheets"][0]["world"]["z_m"] = 0.75;
    write_file(directory / "s.json", document.dump());
    SheetFile file(directory / "s.json");
    file.allocate("new", page());
    SheetEntry table = file.sheets()[0];
    table.print_scale_x = 0.995;
    file.replace(table);
    file.save();
    const json saved = json::parse(read_file(directory / "s.json"));
    document["sheets"][0]["print_scale_x"] = 0.995;
    EXPECT_EQ(saved["note"], "ours");
    EXPECT_EQ(saved["sheets"][0], document["sheets"][0]);
    EXPECT_EQ(saved["sheets"][1]["name"], "new");
    EXPECT_FALSE(saved["sheets"][1].contains("lamp"));

    table.world.reset();
    file.replace(table);
    file.save();
    EXPECT_FALSE(json::parse(read_file(directory / "s.json"))["sheets"][0].contains("world"));
}

TEST(SheetFile, does_not_overwrite_what_an_editor_saved_meanwhile) {
    const TemporaryDirectory directory;
    SheetFile file(directory / "s.json");
    file.allocate("a", page());
    write_file(directory / "s.json", hand_written().dump());
    EXPECT_THAT([&] { file.save(); }, ThrowsMessage<Error>(HasSubstr("was changed by somebody")));
    EXPECT_EQ(read_file(directory / "s.json"), hand_written().dump());
}

TEST(SheetFile, a_full_disk_leaves_the_old_file) {
    const TemporaryDirectory directory;
    const std::string old_text = hand_written().dump();
    write_file(directory / "s.json", old_text);
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
        signal(SIGXFSZ, SIG_IGN);
        const rlimit limit{1000, 1000};
        setrlimit(RLIMIT_FSIZE, &limit);
        try {
            SheetFile file(directory / "s.json");
            file.allocate("a", page(), 100);
            file.save();
        } catch (const Error&) {
            _exit(1);
        }
        _exit(0);
    }
    int status = 0;
    ASSERT_EQ(waitpid(child, &status, 0), child);
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 1);
    EXPECT_EQ(read_file(directory / "s.json"), old_text);
    EXPECT_THAT(directory.names(), ElementsAre("s.json"));
}

TEST(SheetFile, writers_at_the_same_time_lose_nothing) {
    const TemporaryDirectory directory;
    fs::create_symlink("s.json", directory / "link.json");
    constexpr int kWriters = 6;
    constexpr int kRounds = 10;
    {
        std::vector<std::jthread> writers;
        for (int writer = 0; writer < kWriters; ++writer) {
            writers.emplace_back([&directory, writer] {
                for (int round = 0; round < kRounds; ++round) {
                    SheetFile file(directory / (writer % 2 == 0 ? "s.json" : "link.json"));
                    file.allocate(std::to_string(writer) + " " + std::to_string(round), page());
                    file.save();
                }
            });
        }
    }
    EXPECT_THAT(directory.names(), ElementsAre("link.json", "s.json"));
    EXPECT_TRUE(fs::is_symlink(directory / "link.json"));
    EXPECT_EQ(read_sheets(directory / "s.json").size(), std::size_t{kWriters * kRounds});
}

TEST(profile_by_name, is_the_way_back) {
    for (const Profile profile : {Profile::anoto, Profile::published, Profile::microdots})
        EXPECT_EQ(profile_by_name(name(profile)), profile);
    EXPECT_EQ(profile_by_name("published"), Profile::published);
    EXPECT_EQ(profile_by_name(""), std::nullopt);
    EXPECT_EQ(profile_by_name("Anoto"), std::nullopt);
}

}  // namespace
}  // namespace dotpose
