#include "sheet_pdf.hpp"

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <system_error>

#include <fmt/core.h>

#include "dotpose/files/error.hpp"
#include "sheet_reprint.hpp"
#include "system/files.hpp"

namespace dotpose::cli {
namespace {

class TemporaryFolder {
  public:
    TemporaryFolder() : path_(system::create_temporary_folder()) {}
    ~TemporaryFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
};

}  // namespace

void require_printable(const Sheet& sheet) {
    constexpr std::int64_t kMaxDots = 8'000'000;  // an A0 page has 4 million dots
    if (std::int64_t{sheet.columns} * sheet.rows <= kMaxDots) return;
    throw Error(
        fmt::format("{} x {} dots are too many for the page: use dotpose print or dotpose sheets "
                    "reprint",
                    sheet.columns, sheet.rows));
}

std::string pdf_of(const SheetEntry& entry, const std::function<bool()>& goes_on) {
    require_printable(entry.sheet);
    PrintOptions options = reprint_options(entry);
    options.progress = [&goes_on](int, int) { return goes_on(); };
    const TemporaryFolder folder;
    const std::filesystem::path path = folder.path() / "sheet.pdf";
    write_sheet(entry.sheet, path, options);
    std::ifstream file(path, std::ios::binary);
    std::string bytes(std::istreambuf_iterator<char>(file), {});
    if (!file) throw Error(fmt::format("cannot read {}", path.string()));
    return bytes;
}

}  // namespace dotpose::cli
