#include "files/input_file.hpp"

#include <array>
#include <cerrno>
#include <fstream>
#include <system_error>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "base/system_error.hpp"
#include "dotpose/files/error.hpp"

namespace dotpose::files {
namespace fs = std::filesystem;

std::optional<std::string> text_of(const fs::path& path, std::size_t max_bytes) {
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    if (status.type() == fs::file_type::not_found) return std::nullopt;
    if (fs::is_directory(status)) base::throw_system("read", path, EISDIR);
    errno = 0;
    std::ifstream stream(path, std::ios::binary);
    std::string text;
    std::array<char, 65536> block;
    while (stream.read(block.data(), block.size()), stream.gcount() > 0) {
        text.append(block.data(), static_cast<std::size_t>(stream.gcount()));
        if (text.size() > max_bytes) {
            throw Error(fmt::format("{} has more than {} MB", path.string(), max_bytes >> 20));
        }
    }
    if (!stream.is_open() || stream.bad())
        base::throw_system("read", path, errno != 0 ? errno : EIO);
    return text;
}

bool next_line(std::istream& stream, std::string& line) {
    constexpr std::size_t kMaxBytes = 64 << 10;
    line.clear();
    for (int byte = stream.get(); byte != std::istream::traits_type::eof(); byte = stream.get()) {
        if (byte == '\n') return true;
        if (line.size() == kMaxBytes) throw Error("a line has more than 64 KB");
        line += static_cast<char>(byte);
    }
    if (stream.bad()) throw Error("it cannot be read");
    return !line.empty();
}

nlohmann::json parse_json(const std::string& text) {
    using nlohmann::json;
    const auto refuse_depth = [](int depth, json::parse_event_t, const json&) {
        if (depth > kMaxJsonDepth) {
            throw Error(fmt::format("it is nested deeper than {} levels", kMaxJsonDepth));
        }
        return true;
    };
    try {
        return json::parse(text, refuse_depth);
    } catch (const json::exception& error) {
        const std::string what = error.what();
        const std::size_t tag = what.find("] ");  // the message starts with "[json.exception...] "
        throw Error(tag == std::string::npos ? what : what.substr(tag + 2));
    }
}

}  // namespace dotpose::files
