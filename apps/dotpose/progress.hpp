/// Shows the progress of long computations on a terminal, and handles Ctrl-C.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace dotpose::cli {

/// Ignores SIGPIPE. Writing to a closed output then fails instead of terminating the program.
void ignore_broken_pipes();

/// Installs handlers for SIGINT, SIGTERM and SIGHUP. After such a signal, `interrupted` returns
/// true, and the program can remove its temporary files before it ends. A second signal terminates
/// the program immediately if it arrives more than half a second after the first.
void catch_interrupts();
bool interrupted();

/// Returns true if the first signal was SIGINT, the signal sent by Ctrl-C. In this case, also
/// resets `interrupted`, and the next signal is treated as a first signal.
bool take_ctrl_c();

/// Formats a duration with at most two units, rounded up, such as "12 s", "3 min 05 s" or
/// "2 h 10 min".
std::string duration_text(double seconds);

/// A progress line on standard error, such as "printing sheet.png: 42 %, 12 s left". It appears
/// only on a terminal and only after one second, and is removed at the end. A message from `notify`
/// hides the line until the next update. Only one progress line may exist at a time.
class ProgressLine {
  public:
    /// `out` is the file for the output lines of the command. An empty path or "-" means standard
    /// output. The progress line is not shown if the output lines appear on a terminal, because
    /// they already indicate the progress.
    ProgressLine(std::string what, const std::string& out);
    explicit ProgressLine(std::string what);
    ~ProgressLine();
    ProgressLine(const ProgressLine&) = delete;
    ProgressLine& operator=(const ProgressLine&) = delete;

    /// Shows the number of completed items and, unless `total` is 0 (unknown), the percentage.
    void update(std::int64_t done, std::int64_t total);

  private:
    std::string what_;
    bool on_terminal_;
    std::chrono::steady_clock::time_point begin_;
    std::chrono::steady_clock::time_point next_;
};

/// Removes the progress line from the terminal. Must be called before a message is written.
void hide_progress();

}  // namespace dotpose::cli
