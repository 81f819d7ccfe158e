#include "dotpose/files/sheet_file.hpp"

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

#include "../print/files.hpp"
#include "dotpose/tools/print.hpp"
#include "sheet_files.hpp"

namespace dotpose {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using print_test::hand_written;
using print_test::page;
using print_test::read_file;
using print_test::TemporaryDirectory;
using print_test::write_file;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

SheetEntry entry(const std::string& name, Cell origin) {
    SheetEntry entry;
    entry.name = name;
    entry.sheet = page();
    entry.sheet.origin = origin;
    return entry;
}

TEST(overlap, means_a_common_cell_in_the_same_section_of_the_same_code) {
    const Sheet a = page();
    Sheet b = a;
    EXPECT_TRUE(overlap(a, b));
    b.pattern.code = CodeVariant::libdots;  // has the same symbols as anoto on most of the plane
    EXPECT_TRUE(overlap(a, b));
    b.pattern.code = CodeVariant::microdots;
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

/// Returns the number of free cells between two regions, along the axis with the larger gap.
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
    // Other programs add some regions, including regions in other sections and code variants.
    for (int i = 0; i < 10; ++i) {
        SheetEntry other = entry("old " + std::to_string(i), {});
        other.sheet.origin = {static_cast<std::uint32_t>(random() % 6000),
                              static_cast<std::uint32_t>(i * 700)};
        other.sheet.pattern.section.u = static_cast<std::uint8_t>(random() % 63);
        if (i % 2 == 0) other.sheet.pattern.code = CodeVariant::microdots;
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
    // The gap must exceed the diagonal of the largest frame: 4096 x 4096 px at the minimum spacing
    // of 6 px.
    EXPECT_GT(kSheetGap_cells, std::sqrt(2.0) * 4096 / 6);
}

TEST(SheetFile, allocates_for_one_page_with_all_that_is_known_of_it) {
    const TemporaryDirectory directory;
    SheetFile file(directory / "s.json");
    const auto columns = static_cast<std::uint32_t>(page().columns);
    file.allocate("first", page());
    SheetEntry third;
    third.name = "form-3";
    third.page = 3;
    third.sheet = page();
    third.print_scale_x = 0.97;
    const SheetEntry added = file.allocate(third);
    EXPECT_EQ(added.sheet.origin, (Cell{1024 + columns + 1024, 1024}));
    ASSERT_EQ(file.sheets().size(), 2U);
    EXPECT_EQ(file.sheets()[1].sheet.origin, added.sheet.origin);
    EXPECT_EQ(file.sheets()[1].name, "form-3");
    EXPECT_EQ(file.sheets()[1].page, 3);
    EXPECT_EQ(file.sheets()[1].print_scale_x, 0.97);
    EXPECT_THROW(file.allocate(third), BadArgument) << "the name is taken";
    EXPECT_EQ(file.sheets().size(), 2U);
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
    // The gap in the first row of pages has room for exactly one page.
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
    // If only one of two sheets fits, neither is added.
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
    EXPECT_EQ(a.sheet.pattern.code, b.sheet.pattern.code);
    EXPECT_EQ(a.sheet.pattern.section, b.sheet.pattern.section);
    EXPECT_EQ(a.world.has_value(), b.world.has_value());
}

TEST(SheetFile, what_is_saved_is_read_back_exactly) {
    const TemporaryDirectory directory;
    SheetEntry full = entry("\"Tisch\" Nº 1", {123'456'789, 400'000'000});
    full.page = 7;
    full.sheet.pattern.code = CodeVariant::libdots;
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
    // Saving a file that was only read leaves every byte unchanged.
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
    EXPECT_THAT([&] { file.save(); },
                ThrowsMessage<Error>(HasSubstr("was changed by another program")));
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

}  // namespace
}  // namespace dotpose
