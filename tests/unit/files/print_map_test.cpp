#include "dotpose/files/print_map.hpp"

#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "dotpose/tools/print.hpp"

namespace dotpose {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

SheetEntry sheet_entry() {
    SheetOptions options;
    options.paper = {30, 40};
    options.origin = {2000, 3000};
    SheetEntry entry;
    entry.name = "desk";
    entry.sheet = make_sheet(options);
    return entry;
}

/// Returns a map with a different offset for each dot.
PrintMap small_map() {
    const SheetEntry entry = sheet_entry();
    MapPage page;
    page.name = entry.name;
    page.code = entry.sheet.pattern.code;
    page.section = entry.sheet.pattern.section;
    page.origin = entry.sheet.origin;
    page.columns = entry.sheet.columns;
    page.rows = entry.sheet.rows;
    page.spacing_mm = entry.sheet.pattern.spacing_mm;
    page.frames = 70'000;
    page.noise = 0.003;
    page.jitter = 0.02;
    for (int i = 0; i < page.columns * page.rows; ++i) {
        page.offsets.push_back(
            {static_cast<std::int16_t>(7 * i - 9000), static_cast<std::int16_t>(300 - 5 * i)});
        page.views.push_back(static_cast<std::uint8_t>(i));
    }
    page.errors = {2, 3, {}};
    for (int node = 0; node < 6; ++node) {
        const auto factor = static_cast<float>(1 + node);
        page.errors.nodes.push_back(
            {4e-8F * factor, -1e-8F * factor, 9e-8F * factor, 2e-10F * factor, 0, 1e-10F * factor});
    }
    return {{page}};
}

/// Returns the bytes of a map in format version 1, which has no error grid.
std::string version_1_bytes() {
    PrintMap map = small_map();
    map.pages[0].errors = {};
    std::string bytes = print_map_bytes(map);
    bytes.resize(bytes.size() - 12);  // removes the size of the error grid, and the checksum
    bytes[8] = 1;
    std::uint32_t crc = 0xFFFFFFFF;
    for (const char byte : bytes) {
        crc ^= static_cast<std::uint8_t>(byte);
        for (int bit = 0; bit < 8; ++bit)
            crc = crc >> 1 ^ ((crc & 1) != 0 ? 0xEDB88320 : 0);
    }
    for (int i = 0; i < 4; ++i)
        bytes += static_cast<char>(~crc >> (8 * i) & 0xFF);
    return bytes;
}

auto refuses(const std::string& reason) {
    return ThrowsMessage<Error>(HasSubstr(reason));
}

TEST(PrintMapFile, KeepsAllValues) {
    const PrintMap map = small_map();
    const PrintMap read = parse_print_map(print_map_bytes(map));
    ASSERT_EQ(read.pages.size(), 1U);
    const MapPage& a = map.pages[0];
    const MapPage& b = read.pages[0];
    EXPECT_EQ(b.name, "desk");
    EXPECT_EQ(b.code, a.code);
    EXPECT_EQ(b.section, a.section);
    EXPECT_EQ(b.origin, a.origin);
    EXPECT_EQ(b.columns, a.columns);
    EXPECT_EQ(b.rows, a.rows);
    EXPECT_EQ(b.spacing_mm, a.spacing_mm);
    EXPECT_EQ(b.frames, 70'000U);
    EXPECT_EQ(b.noise, 0.003);
    EXPECT_EQ(b.jitter, 0.02);
    EXPECT_EQ(b.views, a.views);
    EXPECT_EQ(b.errors.columns, 2);
    EXPECT_EQ(b.errors.rows, 3);
    EXPECT_EQ(b.errors.nodes, a.errors.nodes);
    for (std::size_t i = 0; i < a.offsets.size(); ++i) {
        ASSERT_EQ(b.offsets[i].x_q14, a.offsets[i].x_q14);
        ASSERT_EQ(b.offsets[i].y_q14, a.offsets[i].y_q14);
    }
}

TEST(PrintMapFile, UsesFiveBytesForEachDot) {
    const PrintMap map = small_map();
    const MapPage& page = map.pages[0];
    EXPECT_LE(print_map_bytes(map).size(),
              5 * page.offsets.size() + 24 * page.errors.nodes.size() + 200);
}

TEST(PrintMapFile, RefusesEveryTruncation) {
    const std::string bytes = print_map_bytes(small_map());
    for (std::size_t size = 0; size < bytes.size(); size += 1 + size / 40)
        EXPECT_THROW((void)parse_print_map(bytes.substr(0, size)), Error) << size;
}

TEST(PrintMapFile, RefusesEveryChangedByte) {
    const std::string bytes = print_map_bytes(small_map());
    for (std::size_t i = 0; i < bytes.size(); i += 1 + i / 40) {
        std::string changed = bytes;
        changed[i] = static_cast<char>(changed[i] ^ 0x10);
        EXPECT_THROW((void)parse_print_map(changed), Error) << i;
    }
}

TEST(PrintMapFile, ExplainsRefusals) {
    const std::string bytes = print_map_bytes(small_map());
    EXPECT_THAT([&] { (void)parse_print_map("{}"); }, refuses("not a print map"));
    std::string newer = bytes;
    newer[8] = 3;
    EXPECT_THAT([&] { (void)parse_print_map(newer); },
                refuses("has version 3, and this program reads versions 1 to 2"));
    EXPECT_THAT([&] { (void)parse_print_map(bytes + "x"); }, refuses("checksum"));
    EXPECT_THAT([&] { (void)read_print_map("missing.map"); },
                refuses("missing.map does not exist"));
}

TEST(PrintMapFile, RefusesInvalidPages) {
    PrintMap map = small_map();
    map.pages[0].offsets.pop_back();
    EXPECT_THROW((void)print_map_bytes(map), BadArgument);
    map = small_map();
    map.pages[0].origin.x = kPositionsPerAxis - 1;
    EXPECT_THROW((void)print_map_bytes(map), BadArgument);
}

TEST(PrintMapFile, RefusesErrorsThatAreNotCovariances) {
    const auto with_node = [](const MapErrors::Node& node) {
        PrintMap map = small_map();
        map.pages[0].errors.nodes[4] = node;
        return map;
    };
    const float nan = std::numeric_limits<float>::quiet_NaN();
    for (const MapErrors::Node& node : {MapErrors::Node{-1e-8F, 0, 1e-8F, 0, 0, 0},
                                        {nan, 0, 1e-8F, 0, 0, 0},
                                        {1e-8F, nan, 1e-8F, 0, 0, 0},
                                        {1e-8F, 2e-8F, 1e-8F, 0, 0, 0},
                                        {1e-8F, 0, 1e-8F, 0, 1e-9F, 0}})
        EXPECT_THROW((void)print_map_bytes(with_node(node)), BadArgument);
    PrintMap map = small_map();
    map.pages[0].errors.nodes.pop_back();
    EXPECT_THROW((void)print_map_bytes(map), BadArgument);
    map = small_map();
    map.pages[0].errors = {1, 6, map.pages[0].errors.nodes};
    EXPECT_THROW((void)print_map_bytes(map), BadArgument);
}

TEST(PrintMapFile, ReadsVersion1WithoutErrors) {
    const PrintMap map = parse_print_map(version_1_bytes());
    const MapPage& page = map.pages.at(0);
    EXPECT_EQ(page.views, small_map().pages[0].views);
    EXPECT_TRUE(page.errors.nodes.empty());
    EXPECT_EQ(page.error_covariance({page.origin, page.section})[0][0], 0);
}

TEST(PrintMapFile, InterpolatesTheErrors) {
    const PrintMap map = small_map();
    const MapPage& page = map.pages[0];
    const auto at = [&](int column, int row) {
        return page.error_covariance({{page.origin.x + static_cast<std::uint32_t>(column),
                                       page.origin.y + static_cast<std::uint32_t>(row)},
                                      page.section});
    };
    const int right = page.columns - 1;
    const int bottom = page.rows - 1;
    EXPECT_FLOAT_EQ(static_cast<float>(at(0, 0)[0][0]), 4e-8F);
    EXPECT_FLOAT_EQ(static_cast<float>(at(right, 0)[1][1]), 18e-8F);
    EXPECT_FLOAT_EQ(static_cast<float>(at(0, bottom)[0][1]), -5e-8F);
    EXPECT_FLOAT_EQ(static_cast<float>(at(right, bottom)[2][0]), 12e-10F);
    // The errors at each node are multiplied by 1 + x + 4 y, where x and y go from 0 to 1 across
    // the page.
    const double x = 10.0 / right;
    const double y = 17.0 / bottom;
    EXPECT_NEAR(at(10, 17)[2][2], 1e-10 * (1 + x + 4 * y), 1e-15);
    EXPECT_EQ(at(right + 1, 0)[0][0], 0);
}

TEST(PrintMapFile, RequiresThePagesOfTheSheetFile) {
    SheetEntry entry = sheet_entry();
    EXPECT_NO_THROW(require_pages(small_map(), std::vector{entry}));
    entry.sheet.origin.x += 1;
    EXPECT_THAT([&] { require_pages(small_map(), std::vector{entry}); }, refuses("page 'desk'"));
}

TEST(PrintMapFile, FindsThePageOfACell) {
    const PrintMap map = small_map();
    const MapPage& page = map.pages[0];
    const CodeVariant code = page.code;
    EXPECT_EQ(find_page(map, code, {{2000, 3000}, page.section}), &page);
    EXPECT_EQ(find_page(map, code, {{1999, 3000}, page.section}), nullptr);
    const auto end = 2000 + static_cast<std::uint32_t>(page.columns);
    EXPECT_EQ(find_page(map, code, {{end, 3000}, page.section}), nullptr);
    EXPECT_EQ(find_page(map, code, {{2000, 3000}, {1, 1}}), nullptr);
    EXPECT_EQ(page.index_of({{2003, 3001}, page.section}),
              static_cast<std::size_t>(page.columns) + 3);
}

}  // namespace
}  // namespace dotpose
