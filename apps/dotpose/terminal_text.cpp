#include "terminal_text.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>

#include <fmt/core.h>

#include "progress.hpp"
#include "system/process.hpp"

namespace dotpose::cli {
namespace {

constexpr std::string_view kRed = "\033[31m";
constexpr std::string_view kYellow = "\033[33m";
constexpr std::string_view kGreen = "\033[32m";
constexpr std::string_view kPlain = "\033[0m";

/// A prefix of report lines and the colour in which it is printed.
struct Beginning {
    std::string_view text;
    std::string_view colour;
};
constexpr std::array kBeginnings = {
    Beginning{"FAULT:", kRed},
    Beginning{"CHANGE:", kRed},
    Beginning{"NOT FOUND:", kRed},
    Beginning{"UNKNOWN:", kRed},
    Beginning{"note:", kYellow},
    Beginning{"warning:", kYellow},
    Beginning{"verdict     good", kGreen},
    Beginning{"verdict", kRed},
};

/// Returns the line with its prefix coloured if the prefix is one of kBeginnings.
std::string coloured(std::string_view line) {
    for (const Beginning& beginning : kBeginnings) {
        if (!line.starts_with(beginning.text)) continue;
        return fmt::format("{}{}{}{}", beginning.colour, beginning.text, kPlain,
                           line.substr(beginning.text.size()));
    }
    return std::string(line);
}

}  // namespace

void write_to_stderr(const std::string& text) {
    std::fflush(stdout);
    static_cast<void>(std::fputs(text.c_str(), stderr));
}

void notify(std::string_view message) {
    const std::string text = printable(message);
    hide_progress();
    write_to_stderr(fmt::format("dotpose: {}\n", wants_colour(stderr) ? coloured(text) : text));
}

void notify_failure(std::string_view message) {
    if (!wants_colour(stderr)) return notify(message);
    hide_progress();
    write_to_stderr(fmt::format("{}dotpose:{} {}\n", kRed, kPlain, printable(message)));
}

bool wants_colour(std::FILE* stream) {
    const char* const refused = std::getenv("NO_COLOR");
    const char* const terminal = std::getenv("TERM");
    const bool is_refused = refused != nullptr && *refused != '\0';
    const bool is_dumb = terminal == nullptr || std::string_view(terminal) == "dumb";
    return !is_refused && !is_dumb && system::is_terminal(stream);
}

std::string in_colour(const std::string& report) {
    std::string result;
    for (std::size_t at = 0; at < report.size();) {
        const std::size_t end = std::min(report.find('\n', at), report.size());
        result += coloured(std::string_view(report).substr(at, end - at));
        if (end < report.size()) result += '\n';
        at = end + 1;
    }
    return result;
}

std::string for_standard_output(const std::string& report) {
    return wants_colour(stdout) ? in_colour(report) : report;
}

}  // namespace dotpose::cli
