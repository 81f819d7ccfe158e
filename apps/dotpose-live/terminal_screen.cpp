#include "terminal_screen.hpp"

#include <array>
#include <cstdio>
#include <string_view>
#include <utility>

#include <fmt/core.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <unistd.h>

namespace dotpose::cli {
namespace {

// Control sequences of ECMA-48 and xterm. kEnter selects the alternate screen, hides the cursor and
// disables line wrapping, and kLeave undoes this.
constexpr const char* kEnter = "\033[?1049h\033[?25l\033[?7l";
constexpr const char* kLeave = "\033[?7h\033[?25h\033[?1049l";
constexpr std::string_view kTopLeft = "\033[H";
constexpr std::string_view kEraseRight = "\033[K";
constexpr std::string_view kEraseBelow = "\033[J";

/// Byte sequences that terminals send for keys. The input is matched against them in this order, so
/// a sequence must precede its own prefixes.
constexpr std::array<std::pair<std::string_view, Key>, 22> kKeys = {{
    {"\033[5~", Key::page_up},
    {"\033[6~", Key::page_down},
    {"\033[1~", Key::home},
    {"\033[7~", Key::home},
    {"\033[4~", Key::end},
    {"\033[8~", Key::end},
    {"\033[A", Key::up},
    {"\033OA", Key::up},
    {"\033[B", Key::down},
    {"\033OB", Key::down},
    {"\033[H", Key::home},
    {"\033OH", Key::home},
    {"\033[F", Key::end},
    {"\033OF", Key::end},
    {"k", Key::up},
    {"j", Key::down},
    {"b", Key::page_up},
    {" ", Key::page_down},
    {"g", Key::home},
    {"G", Key::end},
    {"n", Key::order},
    {"q", Key::quit},
}};

}  // namespace

bool TerminalScreen::is_available() {
    // A background program must not change the terminal settings, because the system would suspend
    // it.
    return isatty(STDOUT_FILENO) == 1 && tcgetpgrp(STDOUT_FILENO) == getpgrp();
}

TerminalScreen::TerminalScreen() {
    termios settings{};
    if (isatty(STDIN_FILENO) == 1 && tcgetattr(STDIN_FILENO, &settings) == 0) {
        before_ = settings;
        settings.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);
        tcsetattr(STDIN_FILENO, TCSANOW, &settings);
    }
    fmt::print("{}", kEnter);
}

TerminalScreen::~TerminalScreen() {
    std::fputs(kLeave, stdout);
    std::fflush(stdout);
    if (before_) tcsetattr(STDIN_FILENO, TCSANOW, &*before_);
}

ScreenSize TerminalScreen::size() const {
    winsize size{};
    const bool is_known =
        ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_row > 0 && size.ws_col > 0;
    return is_known ? ScreenSize{size.ws_col, size.ws_row} : ScreenSize{};
}

void TerminalScreen::read_input() {
    pollfd state{STDIN_FILENO, POLLIN, 0};
    std::array<char, 256> bytes;
    while (before_ && poll(&state, 1, 0) > 0 && (state.revents & POLLIN) != 0) {
        const ssize_t size = ::read(STDIN_FILENO, bytes.data(), bytes.size());
        if (size <= 0) return;
        input_.append(bytes.data(), static_cast<std::size_t>(size));
    }
}

std::optional<Key> TerminalScreen::next_key() {
    read_input();
    while (!input_.empty()) {
        for (const auto& [bytes, key] : kKeys) {
            if (!input_.starts_with(bytes)) continue;
            input_.erase(0, bytes.size());
            return key;
        }
        input_.erase(0, 1);
    }
    return std::nullopt;
}

void TerminalScreen::show(const std::vector<std::string>& lines) {
    std::string text(kTopLeft);
    for (std::size_t i = 0; i < lines.size(); ++i) {
        if (i > 0) text += "\r\n";
        text.append(lines[i]).append(kEraseRight);
    }
    fmt::print("{}{}", text, kEraseBelow);
    std::fflush(stdout);
}

}  // namespace dotpose::cli
