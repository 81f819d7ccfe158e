#include "run_files.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <string_view>

#include <fmt/core.h>

#include "dotpose/files/error.hpp"
#include "dotpose/files/write_file.hpp"
#include "print/lower_case.hpp"
#include "system/files.hpp"
#include "system/path.hpp"

namespace dotpose::cli {
namespace {

namespace fs = std::filesystem;

constexpr int kInputDescriptor = 0;
constexpr int kOutputDescriptor = 1;

constexpr std::array<std::string_view, 24> kImagesAndVideos = {
    ".pgm", ".ppm",  ".pbm", ".pnm",  ".png",  ".jpg",  ".jpeg", ".bmp",
    ".tif", ".tiff", ".gif", ".webp", ".heic", ".heif", ".svg",  ".pdf",
    ".mp4", ".m4v",  ".avi", ".mkv",  ".mov",  ".webm", ".mpg",  ".mpeg"};

const char* name(Content content) {
    switch (content) {
        case Content::json:
            return "JSON";
        case Content::csv:
            return "CSV";
        case Content::yaml:
            return "YAML";
        case Content::svg:
            return "an SVG picture";
        case Content::packets:
            return "pose packets";
        case Content::mcap:
            return "a recording (MCAP)";
        case Content::text:
            return "a report";
        case Content::own:
            break;
    }
    return "";
}

void require_fitting_name(const std::string& label, const std::string& path, Content content) {
    const std::string ending = print::lower_case(system::path_of(path).extension().string());
    if (content == Content::own || (content == Content::svg && ending == ".svg")) return;
    if (std::ranges::find(kImagesAndVideos, ending) == kImagesAndVideos.end()) return;
    throw BadArgument(
        fmt::format("{}: the name ends like that of an image or video ({}), and the file would "
                    "contain {}; was the name of the output left out?",
                    label, ending, name(content)));
}

std::string label_of(const std::string& option, const std::string& path) {
    return option.empty() ? path : option + " " + path;
}

/// Returns the identity of an existing file, or none for a device or a pipe.
std::optional<FileIdentity> identity_of(const std::optional<system::FileNumbers>& numbers) {
    if (!numbers || !numbers->is_regular) return std::nullopt;
    return FileIdentity{numbers->device, numbers->file, ""};
}

[[noreturn]] void refuse(const std::string& output, const std::string& input) {
    throw BadArgument(
        fmt::format("{} would overwrite the input {}: name another file", output, input));
}

}  // namespace

Content content_of(RecordFormat format) {
    return format == RecordFormat::csv    ? Content::csv
           : format == RecordFormat::text ? Content::text
                                          : Content::json;
}

Content content_of(const ReportArguments& report) {
    return report.as_json ? Content::json : Content::text;
}

std::optional<FileIdentity> identity_of(const std::string& path) {
    if (path.empty()) return std::nullopt;
    if (const auto numbers = system::numbers_of(system::path_of(path))) return identity_of(numbers);
    const fs::path target = without_links(system::path_of(path));
    const auto folder =
        system::numbers_of(target.has_parent_path() ? target.parent_path() : fs::path("."));
    if (!folder) return std::nullopt;
    return FileIdentity{folder->device, folder->file,
                        print::lower_case(target.filename().string())};
}

void RunFiles::reads(const std::string& option, const std::string& path) {
    if (path.empty()) return;
    if (path == "-") {
        add_input("on standard input", identity_of(system::numbers_of(kInputDescriptor)));
    } else {
        add_input(label_of(option, path), identity_of(path));
    }
}

void RunFiles::add_input(const std::string& label, const std::optional<FileIdentity>& identity) {
    if (!identity) return;
    const auto output = outputs_.find(*identity);
    if (output != outputs_.end()) refuse(output->second, label);
    inputs_.emplace(*identity, label);
}

void RunFiles::reads(const std::string& option, const std::vector<std::string>& paths) {
    for (const std::string& path : paths)
        reads(option, path);
}

void RunFiles::writes(const std::string& option, const std::string& path, Content content) {
    if (path.empty()) return;
    if (path == "-") {
        if (option == "-o") {
            return add_output("standard output",
                              identity_of(system::numbers_of(kOutputDescriptor)));
        }
        throw BadArgument(fmt::format(
            "{} - needs the name of a file: only -o takes - for standard output", option));
    }
    const std::string label = label_of(option, path);
    require_fitting_name(label, path, content);
    add_output(label, identity_of(path));
}

void RunFiles::writes_lines(const std::string& path, Content content) {
    writes("-o", path.empty() ? "-" : path, content);
}

void RunFiles::updates(const std::string& option, const std::string& path, Content content) {
    std::error_code error;
    fs::exists(system::path_of(path), error) ? reads(option, path) : writes(option, path, content);
}

void RunFiles::require_not_written(const std::string& path) const {
    const auto identity = identity_of(path);
    const auto output = identity ? outputs_.find(*identity) : outputs_.end();
    if (output != outputs_.end()) refuse(output->second, path);
}

void RunFiles::require_free(const std::string& option, const std::string& path) const {
    const auto identity = identity_of(path);
    if (identity) require_free(label_of(option, path), *identity);
}

void RunFiles::add_output(const std::string& label, const std::optional<FileIdentity>& identity) {
    if (!identity) return;
    require_free(label, *identity);
    outputs_.emplace(*identity, label);
}

void RunFiles::require_free(const std::string& label, const FileIdentity& identity) const {
    const auto input = inputs_.find(identity);
    if (input != inputs_.end()) refuse(label, input->second);
    const auto other = outputs_.find(identity);
    if (other == outputs_.end()) return;
    throw BadArgument(fmt::format("{} and {} are the same file: name another for one of them",
                                  other->second, label));
}

}  // namespace dotpose::cli
