#include <cstdio>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include "dotpose/tools/print.hpp"
#include "files.hpp"

namespace dotpose {
namespace {

namespace fs = std::filesystem;
using print_test::read_file;
using print_test::TemporaryDirectory;
using print_test::write_file;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::ThrowsMessage;

const char* const kNames[] = {"page.txt", "page.svg", "page.png", "page.tif"};

Sheet page() {
    SheetOptions options;
    options.paper = {.width_mm = 60, .height_mm = 60};
    return make_sheet(options);
}

/// Simulates a full disk: during the lifetime of the object, no file can grow beyond `limit_bytes`.
class FileSizeLimit {
  public:
    explicit FileSizeLimit(rlim_t limit_bytes) {
        old_handler_ = signal(SIGXFSZ, SIG_IGN);
        getrlimit(RLIMIT_FSIZE, &old_limit_);
        const rlimit limit = {limit_bytes, old_limit_.rlim_max};
        setrlimit(RLIMIT_FSIZE, &limit);
    }
    ~FileSizeLimit() {
        setrlimit(RLIMIT_FSIZE, &old_limit_);
        signal(SIGXFSZ, old_handler_);
    }
    FileSizeLimit(const FileSizeLimit&) = delete;
    FileSizeLimit& operator=(const FileSizeLimit&) = delete;

  private:
    rlimit old_limit_{};
    void (*old_handler_)(int) = SIG_DFL;
};

TEST(write_sheet, replaces_an_old_file_and_leaves_only_the_new_one) {
    for (const char* name : kNames) {
        const TemporaryDirectory directory;
        write_file(directory / name, "old");
        write_sheet(page(), directory / name);
        EXPECT_THAT(directory.names(), ElementsAre(name));
        EXPECT_GT(fs::file_size(directory / name), 1000U);
    }
}

TEST(write_sheet, leaves_the_old_file_and_no_litter_when_the_disk_is_full) {
    for (const char* name : kNames) {
        const TemporaryDirectory directory;
        write_file(directory / name, "old");
        {
            const FileSizeLimit limit(1000);
            EXPECT_THAT([&] { write_sheet(page(), directory / name); },
                        ThrowsMessage<Error>(AllOf(HasSubstr("cannot write"), HasSubstr(name),
                                                   HasSubstr("File too large"))));
        }
        EXPECT_THAT(directory.names(), ElementsAre(name));
        EXPECT_EQ(read_file(directory / name), "old");
    }
}

TEST(write_sheet, leaves_the_old_file_and_no_litter_when_stopped) {
    for (const char* name : kNames) {
        const TemporaryDirectory directory;
        write_file(directory / name, "old");
        int calls = 0;
        PrintOptions options;
        options.progress = [&](int rows_done, int rows) {
            EXPECT_EQ(rows, page().rows);
            EXPECT_EQ(rows_done, ++calls);
            // The new file has a temporary name until it is complete. Until then, the old file
            // still exists.
            EXPECT_EQ(read_file(directory / name), "old");
            EXPECT_EQ(directory.names().size(), 2U);
            return rows_done < 50;
        };
        EXPECT_THAT([&] { write_sheet(page(), directory / name, options); },
                    ThrowsMessage<Error>(HasSubstr("stopped; nothing was written")));
        EXPECT_EQ(calls, 50);
        EXPECT_THAT(directory.names(), ElementsAre(name));
        EXPECT_EQ(read_file(directory / name), "old");
    }
}

TEST(write_sheet, reports_every_row) {
    const TemporaryDirectory directory;
    int calls = 0;
    PrintOptions options;
    options.progress = [&](int, int) {
        ++calls;
        return true;
    };
    write_sheet(page(), directory / "page.png", options);
    EXPECT_EQ(calls, page().rows);
}

TEST(write_sheet, says_why_a_file_cannot_be_created) {
    const TemporaryDirectory directory;
    EXPECT_THAT(
        [&] { write_sheet(page(), directory / "missing/page.png"); },
        ThrowsMessage<Error>(AllOf(HasSubstr("cannot create"), HasSubstr("missing/page.png"),
                                   HasSubstr("No such file or directory"))));
    fs::create_directory(directory / "folder.png");
    EXPECT_THAT([&] { write_sheet(page(), directory / "folder.png"); },
                ThrowsMessage<Error>(HasSubstr("Is a directory")));
    mkfifo((directory / "pipe.png").c_str(), 0600);
    EXPECT_THAT([&] { write_sheet(page(), directory / "pipe.png"); },
                ThrowsMessage<Error>(HasSubstr("it is not a regular file")));
    EXPECT_THAT(directory.names(), ElementsAre("folder.png", "pipe.png"));
}

/// Writes a file in a child process. The process first changes to another user because root can
/// write anywhere.
[[noreturn]] void write_without_rights(const fs::path& path) {
    constexpr uid_t kNobody = 65534;
    if (geteuid() == 0 && setuid(kNobody) != 0) _exit(3);
    try {
        write_sheet(page(), path);
    } catch (const Error& error) {
        std::fputs(error.what(), stderr);
        _exit(1);
    }
    _exit(0);
}

TEST(write_sheet_death, respects_write_protection) {
    const TemporaryDirectory directory;
    write_file(directory / "page.png", "old");
    fs::permissions(directory / "page.png", fs::perms(0444));
    fs::permissions(directory.path(), fs::perms(0777));
    EXPECT_EXIT(write_without_rights(directory / "page.png"), testing::ExitedWithCode(1),
                "cannot write .*page.png: Permission denied");
    EXPECT_EXIT(write_without_rights(directory / "other.png"), testing::ExitedWithCode(0), "");
    fs::remove(directory / "other.png");
    fs::permissions(directory.path(), fs::perms(0555));
    EXPECT_EXIT(write_without_rights(directory / "other.png"), testing::ExitedWithCode(1),
                "cannot create .*other.png: Permission denied");
    fs::permissions(directory.path(), fs::perms(0755));
    EXPECT_THAT(directory.names(), ElementsAre("page.png"));
    EXPECT_EQ(read_file(directory / "page.png"), "old");
}

TEST(write_sheet, keeps_modes_and_links) {
    const TemporaryDirectory directory;
    write_file(directory / "real.png", "old");
    fs::permissions(directory / "real.png", fs::perms(0640));
    fs::create_symlink("real.png", directory / "link.png");
    write_sheet(page(), directory / "link.png");
    EXPECT_TRUE(fs::is_symlink(directory / "link.png"));
    EXPECT_NE(read_file(directory / "real.png"), "old");
    EXPECT_EQ(fs::status(directory / "real.png").permissions(), fs::perms(0640));

    const mode_t old_mask = umask(027);
    write_sheet(page(), directory / "new.png");
    umask(old_mask);
    EXPECT_EQ(fs::status(directory / "new.png").permissions(), fs::perms(0640));
}

TEST(write_sheet, checks_before_it_touches_anything) {
    const TemporaryDirectory directory;
    Sheet sheet = page();
    sheet.pattern.section.u = 63;
    EXPECT_THROW(write_sheet(sheet, directory / "page.png"), BadArgument);
    EXPECT_THAT(directory.names(), IsEmpty());
}

TEST(print_format, follows_the_file_ending) {
    EXPECT_EQ(print_format("a.txt"), PrintFormat::text);
    EXPECT_EQ(print_format("b/a.b.SVG"), PrintFormat::svg);
    EXPECT_EQ(print_format("a.Png"), PrintFormat::png);
    EXPECT_EQ(print_format("a.tif"), PrintFormat::tiff);
    EXPECT_EQ(print_format("a.tiff"), PrintFormat::tiff);
    for (const char* name : {"a", "a.jpg", "a.png.gz", ".png", "png", ""}) {
        EXPECT_THAT([&] { (void)print_format(name); },
                    ThrowsMessage<BadArgument>(HasSubstr("the name must end in")))
            << name;
    }
}

}  // namespace
}  // namespace dotpose
