/// Shows the progress of long computations on a terminal, and handles Ctrl-C.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace dotpose::cli {

/// Ignores SIGPIPE, so that writing to a closed output fails without ending the program.
void ignore_broken_pipes();

/// Makes SIGINT, SIGTERM and SIGHUP set `interrupted` instead of ending the program, so that the
/// program can remove its temporary files. A second signal ends the program if it arrives more than
/// half a second after the first.
void catch_interrupts();
bool interrupted();

/// Returns true if the first signal was SIGINT, the signal of Ctrl-C. In this case, also resets
/// `interrupted`, so that the next signal counts as the first.
bool take_ctrl_c();

/// Formats a duration with at most two units, such as "12 s", "3 min 05 s" or "2 h 10 min". Rounds
/// up.
std::string duration_text(double seconds);

/// A progress line on standard error, such as "printing sheet.png: 42 %, 12 s left". It appears
/// only on a terminal, after a second of work, and is removed at the end. A message written by
/// `tell` hides the line until the next update. There can be only one progress line at a time.
class ProgressLine {
  public:
    /// `out` is the file to which the work writes lines. Empty or "-" means standard output. If
    /// standard output is a terminal, the progress line is not shown, because the lines of output
    /// already show the progress.
    ProgressLine(std::string what, const std::string& out);
    explicit ProgressLine(std::string what);
    ~ProgressLine();
    ProgressLine(const ProgressLine&) = delete;
    ProgressLine& operator=(const ProgressLine&) = delete;

    /// Shows the number of finished items and, if `total` is known, the percentage. If `total` is
    /// 0, it is not known.
    void update(std::int64_t done, std::int64_t total);

  private:
    std::string what_;
    bool on_terminal_;
    std::chrono::steady_clock::time_point begin_;
    std::chrono::steady_clock::time_point next_;
};

/// Removes the progress line from the terminal before a message is written.
void hide_progress();

}  // namespace dotpose::cli
