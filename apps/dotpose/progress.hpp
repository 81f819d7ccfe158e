/// Shows the progress of long computations on a terminal, and lets Ctrl-C stop them.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace dotpose::cli {

/// Ignores SIGPIPE: if the reader of an output closes it, the write fails and the program goes on.
void ignore_broken_pipes();

/// Makes SIGINT, SIGTERM and SIGHUP set `interrupted` instead of ending the program, so that it can
/// remove its temporary files. A second signal ends it, if it comes more than half a second later.
void catch_interrupts();
bool interrupted();

/// Whether Ctrl-C was pressed (SIGINT, no other signal). If so, it is forgotten: `interrupted` is
/// false again, and the next signal counts as the first.
bool take_ctrl_c();

/// Returns a duration in words of two units at most, such as "12 s", "3 min 05 s" or "2 h 10 min",
/// rounded up.
std::string duration_text(double seconds);

/// A line such as "printing sheet.png: 42 %, 12 s left" on standard error. It is shown if standard
/// error is a terminal and the work takes more than a second, and removed at the end. Messages of
/// `tell` remove it until the next update. At most one line at a time.
class ProgressLine {
  public:
    /// `out` is the file that gets lines while the work goes on, or empty or "-" for standard
    /// output: if that is a terminal, its lines show the progress, and this one is not shown.
    ProgressLine(std::string what, const std::string& out);
    explicit ProgressLine(std::string what);
    ~ProgressLine();
    ProgressLine(const ProgressLine&) = delete;
    ProgressLine& operator=(const ProgressLine&) = delete;

    /// Shows how much is done. If the total is not known (0), it shows the number alone.
    void update(std::int64_t done, std::int64_t total);

  private:
    std::string what_;
    bool on_terminal_;
    std::chrono::steady_clock::time_point begin_;
    std::chrono::steady_clock::time_point next_;
};

/// Removes the progress line from the terminal, so that a message can be written there.
void hide_progress();

}  // namespace dotpose::cli
