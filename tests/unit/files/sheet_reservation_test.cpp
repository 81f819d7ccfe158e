// Tests the reservation of regions while their pages are written. No region may be assigned twice.
#include <algorithm>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include "../print/files.hpp"
#include "dotpose/files/sheet_file.hpp"
#include "sheet_files.hpp"

namespace dotpose {
namespace {

using namespace print_test;
namespace fs = std::filesystem;
using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::ThrowsMessage;

class SheetReservations : public testing::Test {
  protected:
    const TemporaryDirectory directory_;
    const fs::path path_ = directory_ / "s.json";

    static void enter_a(SheetFile& file) { file.allocate("a", page()); }
    json saved() const { return json::parse(read_file(path_)); }
};

TEST_F(SheetReservations, are_in_the_file_before_the_page_and_marked_until_it_is_confirmed) {
    SheetReservation reservation(path_, enter_a);
    EXPECT_EQ(saved()["sheets"][0]["name"], "a");
    EXPECT_EQ(saved()["sheets"][0]["reserved"], true);
    ASSERT_EQ(read_sheets(path_).size(), 1U);
    EXPECT_TRUE(read_sheets(path_)[0].is_reserved);
    // Meanwhile, another program reserves other regions.
    SheetReservation other(path_, [](SheetFile& file) { file.allocate("b", page()); });
    reservation.confirm();
    other.confirm();
    const auto sheets = read_sheets(path_);
    ASSERT_EQ(sheets.size(), 2U);
    EXPECT_FALSE(overlap(sheets[0].sheet, sheets[1].sheet));
    const json all = saved();
    for (const json& sheet : all["sheets"])
        EXPECT_FALSE(sheet.contains("reserved"));
}

TEST_F(SheetReservations, that_are_given_up_leave_the_file_as_it_was) {
    { const SheetReservation reservation(path_, enter_a); }
    EXPECT_THAT(directory_.names(), IsEmpty());
    const std::string by_hand = hand_written().dump(5) + "\n\n";
    write_file(path_, by_hand);
    { const SheetReservation reservation(path_, enter_a); }
    EXPECT_EQ(read_file(path_), by_hand);
    // If a reservation is not confirmed, its destructor removes it. Changes made by other programs
    // are kept.
    {
        const SheetReservation reservation(path_, enter_a);
        SheetFile file(path_);
        file.allocate("b", page());
        file.save();
    }
    EXPECT_EQ(saved()["sheets"][0]["name"], "table");
    EXPECT_EQ(saved()["sheets"][1]["name"], "b");
    EXPECT_EQ(saved()["sheets"].size(), 2U);
}

TEST_F(SheetReservations, keep_what_an_editor_did_meanwhile) {
    SheetReservation reservation(path_, enter_a);
    json edited = saved();
    edited["sheets"][0]["world"] = {{"x_m", 1}, {"y_m", 2}, {"yaw_rad", 0}};
    write_file(path_, edited.dump());
    reservation.confirm();
    EXPECT_EQ(saved()["sheets"][0]["world"]["x_m"], 1);
    EXPECT_FALSE(saved()["sheets"][0].contains("reserved"));
}

TEST_F(SheetReservations, come_back_where_an_editor_took_them_out) {
    write_file(path_, hand_written().dump());
    SheetReservation reservation(path_, enter_a);
    const Cell origin = read_sheets(path_)[1].sheet.origin;
    write_file(path_, hand_written().dump());
    reservation.confirm();
    EXPECT_EQ(read_sheets(path_).at(1).sheet.origin, origin);

    SheetReservation next(path_, [](SheetFile& file) { file.allocate("b", page()); });
    json edited = saved();
    edited["sheets"][2]["origin_x"] = 400'000'000;
    write_file(path_, edited.dump());
    EXPECT_THAT([&] { next.confirm(); }, ThrowsMessage<Error>(HasSubstr("to another sheet")));
    EXPECT_EQ(saved(), edited);
}

TEST_F(SheetReservations, stay_where_they_cannot_be_confirmed_or_taken_out) {
    std::vector<std::string> told;
    {
        SheetReservation reservation(
            path_, enter_a, {.notify = [&](const std::string& text) { told.push_back(text); }});
        fs::rename(path_, directory_ / "aside");
        fs::create_directory(path_);
        EXPECT_THROW(reservation.confirm(), Error);
        EXPECT_THAT(told, IsEmpty());
    }
    fs::remove(path_);
    {
        const SheetReservation reservation(
            path_, enter_a, {.notify = [&](const std::string& text) { told.push_back(text); }});
        fs::rename(path_, directory_ / "aside");
        fs::create_directory(path_);
    }
    EXPECT_THAT(told, ElementsAre(HasSubstr("the regions reserved in")));
    EXPECT_THAT(read_file(directory_ / "aside"), HasSubstr("\"reserved\": true"));
}

TEST_F(SheetReservations, of_somebody_who_was_stopped_are_named_as_such) {
    json stopped = hand_written();
    stopped["sheets"][0]["reserved"] = true;
    write_file(path_, stopped.dump());
    EXPECT_THAT(
        [&] { SheetReservation(path_, [](SheetFile& file) { file.allocate("table", page()); }); },
        ThrowsMessage<BadArgument>(
            HasSubstr("reserved by a print that is running or was stopped")));
    stopped["sheets"][0]["reserved"] = 1;
    write_file(path_, stopped.dump());
    EXPECT_THAT([&] { read_sheets(path_); },
                ThrowsMessage<Error>(HasSubstr("sheets[0].reserved must be true or false")));
}

TEST_F(SheetReservations, wait_for_a_lock_say_so_and_end) {
    std::vector<std::string> told;
    SheetFileWait wait{.max_s = 0.05,
                       .notify = [&](const std::string& text) { told.push_back(text); }};
    const SheetFile holder(path_);
    EXPECT_THAT([&] { SheetFile(path_, wait); },
                ThrowsMessage<Error>(HasSubstr("another program has been changing it for 0.05 s")));
    EXPECT_THAT(told, ElementsAre(HasSubstr("waiting for another program that is changing")));
    wait.max_s = 1e9;
    wait.stop = [] { return true; };
    EXPECT_THAT([&] { SheetFile(path_, wait); }, ThrowsMessage<Error>(HasSubstr("stopped")));
}

/// Prints sheet number `n` in a child process. After `after_us`, a timer signal kills the child
/// process, as kill -9 would.
void print_and_die(const fs::path& folder, int n, int after_us) {
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
        const itimerval timer{{0, 0}, {0, after_us}};
        setitimer(ITIMER_REAL, &timer, nullptr);
        try {
            const std::string name = "n" + std::to_string(n);
            std::vector<SheetEntry> added;
            SheetReservation reservation(
                folder / "s.json", [&](SheetFile& file) { added = file.allocate(name, page()); });
            write_sheet(added[0].sheet, folder / (name + ".svg"));
            reservation.confirm();
        } catch (const Error&) {
            _exit(1);
        }
        _exit(0);
    }
    int status = 0;
    ASSERT_EQ(waitpid(child, &status, 0), child);
}

TEST_F(SheetReservations, no_page_is_without_its_entry_whenever_its_printer_is_killed) {
    constexpr int kPrints = 60;
    constexpr int kStep_us = 100;
    for (int n = 0; n < kPrints; ++n)
        print_and_die(path_.parent_path(), n, (n + 1) * kStep_us);
    // read_sheets would throw if two sheets shared cells.
    const auto sheets = fs::exists(path_) ? read_sheets(path_) : std::vector<SheetEntry>();
    for (int n = 0; n < kPrints; ++n) {
        const std::string name = "n" + std::to_string(n);
        if (!fs::exists(directory_ / (name + ".svg"))) continue;
        EXPECT_EQ(std::ranges::count(sheets, name, &SheetEntry::name), 1) << name;
    }
}

}  // namespace
}  // namespace dotpose
