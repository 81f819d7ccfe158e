#include "calibration_display.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <string_view>

#include <fmt/core.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include "terminal_text.hpp"

namespace dotpose::cli {
namespace {

using namespace std::chrono_literals;
using TextLines = std::vector<std::string>;

/// Maximum number of characters per line in the window's text panel.
constexpr std::size_t kPanelColumns = 44;
constexpr std::size_t kCaptions = 7;

/// Appends `text`, wrapped at spaces into lines with at most `columns` characters.
void append_wrapped(std::string_view text, std::size_t columns, TextLines& lines) {
    while (text.size() > columns) {
        const std::size_t space = text.rfind(' ', columns);
        const std::size_t end = space == std::string_view::npos || space == 0 ? columns : space;
        lines.emplace_back(text.substr(0, end));
        text.remove_prefix(std::min(text.size(), end + (text[end] == ' ' ? 1 : 0)));
    }
    lines.emplace_back(text);
}

TextLines captions_of(const CalibrationStatus& status) {
    TextLines lines;
    append_wrapped(taken_text(status) + "; " + status.now, kPanelColumns, lines);
    append_wrapped("next: " + next_text(status), kPanelColumns, lines);
    if (!status.remark.empty()) append_wrapped(status.remark, kPanelColumns, lines);
    // A constant number of lines keeps the drawings below the captions in place.
    lines.resize(kCaptions - 1);
    lines.emplace_back("q ends");
    return lines;
}

/// Returns the text for the terminal: a character map of the covered image blocks, with the gauges
/// next to it, followed by the messages for the user.
TextLines terminal_lines(const CalibrationStatus& status) {
    using Image = ImageCoverage;
    TextLines lines;
    for (int row = 0; row < Image::kRows; ++row) {
        std::string line = "  ";
        for (int column = 0; column < Image::kColumns; ++column)
            line += status.coverage.image().is_covered(column, row) ? "##" : " .";
        lines.push_back(line);
    }
    const std::vector<video::Gauge> gauges = gauges_of(status);
    for (std::size_t i = 0; i < gauges.size(); ++i) {
        lines[i] += fmt::format("   {:<11} {:<14} {}", gauges[i].label, gauges[i].text,
                                gauges[i].is_reached ? "enough" : "");
    }
    lines[gauges.size() + 1] += "   " + taken_text(status);
    lines.push_back("now   " + status.now);
    lines.push_back("next  " + next_text(status));
    lines.push_back("Ctrl-C ends" + (status.remark.empty() ? "" : "; " + status.remark));
    return lines;
}

std::size_t terminal_columns() {
    constexpr std::size_t kDefault = 80;
    winsize size{};
    const bool is_known = ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
    return is_known ? size.ws_col : kDefault;
}

std::string line_of(const CalibrationStatus& status) {
    std::string line = taken_text(status);
    for (const video::Gauge& gauge : gauges_of(status))
        line += fmt::format("; {} {}", gauge.label, gauge.text);
    return line + "; next: " + next_text(status);
}

}  // namespace

CalibrationDisplay::CalibrationDisplay(bool has_window)
    : has_window_(has_window),
      on_terminal_(isatty(STDERR_FILENO) == 1),
      screen_({.has_window = has_window, .record = {}}) {}

bool CalibrationDisplay::show(const CalibrationStatus& status, ImageView image,
                              const Trace& trace) {
    if (has_window_) {
        video::Scene scene;
        scene.image = image;
        scene.trace = trace;
        scene.is_good = true;
        scene.lines = captions_of(status);
        video::CalibrationScene& calibration = scene.calibration.emplace(status.coverage);
        calibration.gauges = gauges_of(status);
        calibration.theta_rad = status.theta_rad;
        calibration.is_taken = status.is_taken;
        return screen_.show(scene);
    }
    if (on_terminal_) {
        show_in_terminal(status);
    } else if (const std::string line = line_of(status); line != last_line_) {
        last_line_ = line;
        notify(line);
    }
    return true;
}

void CalibrationDisplay::show_in_terminal(const CalibrationStatus& status) {
    const auto now = std::chrono::steady_clock::now();
    if (now < next_ && !status.is_taken) return;
    next_ = now + 100ms;
    // This control sequence moves the cursor to the first line of the previous output and erases
    // everything from there to the end of the screen.
    const int shown_lines = shown_lines_;
    std::string text = shown_lines > 0 ? fmt::format("\033[{}A\r\033[J", shown_lines) : "";
    const std::size_t columns = terminal_columns();
    const TextLines lines = terminal_lines(status);
    for (const std::string& line : lines)
        text += printable(line.substr(0, columns - 1)) + "\n";
    shown_lines_ = static_cast<int>(lines.size());
    std::fputs(text.c_str(), stderr);
    std::fflush(stderr);
}

void CalibrationDisplay::say(const std::string& message) {
    notify(message);
    shown_lines_ = 0;
}

}  // namespace dotpose::cli
