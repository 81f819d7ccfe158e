#include "progress.hpp"

#include <csignal>
#include <cstdint>
#include <cstdio>

#include <fmt/core.h>
#include <unistd.h>

namespace dotpose::cli {
namespace {

using namespace std::chrono_literals;

constexpr auto kFirstShown = 1s;
constexpr auto kBetween = 100ms;
constexpr const char* kEraseLine = "\r\033[K";

volatile std::sig_atomic_t signal_seen = 0;

void on_signal(int) {
    signal_seen = 1;
}

}  // namespace

void catch_interrupts() {
    struct sigaction action {};
    action.sa_handler = on_signal;
    action.sa_flags = static_cast<int>(SA_RESETHAND) | SA_RESTART;
    for (const int signal_number : {SIGINT, SIGTERM, SIGHUP}) {
        sigaction(signal_number, &action, nullptr);
    }
}

void ignore_broken_pipes() {
    struct sigaction action {};
    action.sa_handler = SIG_IGN;
    sigaction(SIGPIPE, &action, nullptr);
}

bool interrupted() {
    return signal_seen != 0;
}

void forget_interrupt() {
    signal_seen = 0;
    catch_interrupts();
}

ProgressLine::ProgressLine(std::string what)
    : what_(std::move(what)),
      on_terminal_(isatty(STDERR_FILENO) == 1),
      next_(std::chrono::steady_clock::now() + kFirstShown) {}

ProgressLine::~ProgressLine() {
    if (visible_) std::fputs(kEraseLine, stderr);
}

void ProgressLine::update(int done, int total) {
    if (!on_terminal_ || total <= 0) return;
    const auto now = std::chrono::steady_clock::now();
    if (now < next_) return;
    next_ = now + kBetween;
    visible_ = true;
    fmt::print(stderr, "{}{}: {} %", kEraseLine, what_, std::int64_t{100} * done / total);
    std::fflush(stderr);
}

}  // namespace dotpose::cli
