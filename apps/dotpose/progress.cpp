#include "progress.hpp"

#include <atomic>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <ctime>
#include <utility>

#include <fmt/core.h>

#include "lines.hpp"
#include "system/process.hpp"
#include "terminal_text.hpp"

namespace dotpose::cli {
namespace {

using namespace std::chrono_literals;

constexpr auto kFirstShown = 1s;
constexpr auto kBetween = 100ms;
constexpr const char* kEraseLine = "\r\033[K";

volatile std::sig_atomic_t signal_seen = 0;
std::atomic<std::int64_t> signal_ns = 0;  ///< time of the first signal on the monotonic clock
std::atomic<bool> is_line_visible = false;

/// Returns the time on the monotonic clock in ns. Safe to call from a signal handler.
std::int64_t now_ns() {
    timespec time{};
    clock_gettime(CLOCK_MONOTONIC, &time);
    return std::int64_t{time.tv_sec} * 1'000'000'000 + time.tv_nsec;
}

/// Records the first signal. A second signal terminates the program immediately if it arrives more
/// than 500 ms after the first. An earlier second signal is ignored, because the `timeout` program
/// sends two signals in quick succession: one to the program and one to its process group.
void on_signal(int signal_number) {
    constexpr std::int64_t kTwice_ns = 500'000'000;
    if (signal_seen == 0) {
        signal_ns = now_ns();
        signal_seen = signal_number;
    } else if (now_ns() - signal_ns > kTwice_ns) {
        std::signal(signal_number, SIG_DFL);
        std::raise(signal_number);
    }
}

}  // namespace

void catch_interrupts() {
    system::on_end_signals(on_signal);
}

void ignore_broken_pipes() {
    system::ignore_broken_pipes();
}

bool interrupted() {
    return signal_seen != 0;
}

bool take_ctrl_c() {
    if (signal_seen != SIGINT) return false;
    signal_seen = 0;
    return true;
}

std::string duration_text(double seconds) {
    const auto whole = static_cast<std::int64_t>(std::ceil(seconds));
    if (whole < 60) return fmt::format("{} s", whole);
    if (whole < 3600) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
    const std::int64_t minutes = (whole + 59) / 60;
    return fmt::format("{} h {:02} min", minutes / 60, minutes % 60);
}

ProgressLine::ProgressLine(std::string what)
    : what_(std::move(what)),
      on_terminal_(system::is_terminal(stderr)),
      begin_(std::chrono::steady_clock::now()),
      next_(begin_ + kFirstShown) {}

ProgressLine::ProgressLine(std::string what, const std::string& out)
    : ProgressLine(std::move(what)) {
    if (is_standard_output(out) && system::is_terminal(stdout)) on_terminal_ = false;
}

ProgressLine::~ProgressLine() {
    hide_progress();
}

void ProgressLine::update(std::int64_t done, std::int64_t total) {
    if (!on_terminal_) return;
    const auto now = std::chrono::steady_clock::now();
    if (now < next_) return;
    next_ = now + kBetween;
    const std::chrono::duration<double> elapsed = now - begin_;
    std::string text = fmt::format("{}: {} done", printable(what_), done);
    if (total > 0 && done <= total) {
        text = fmt::format("{}: {} %", printable(what_), 100 * done / total);
        if (done > 0) {
            const double left_s =
                elapsed.count() * static_cast<double>(total - done) / static_cast<double>(done);
            text += fmt::format(", {} left", duration_text(left_s));
        }
    }
    is_line_visible = true;
    write_to_stderr(kEraseLine + text);
}

void hide_progress() {
    if (is_line_visible.exchange(false)) write_to_stderr(kEraseLine);
}

}  // namespace dotpose::cli
