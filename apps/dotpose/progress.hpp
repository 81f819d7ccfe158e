/// Shows the progress of long computations on a terminal, and lets Ctrl-C stop them.
#pragma once

#include <chrono>
#include <string>

namespace dotpose::cli {

/// Ignores SIGPIPE: if the reader of an output closes it, the write fails and the program goes on.
void ignore_broken_pipes();

/// Makes SIGINT, SIGTERM and SIGHUP set `interrupted` instead of ending the program, so that it can
/// remove its temporary files. A second signal ends the program.
void catch_interrupts();
bool interrupted();

/// Makes `interrupted` false again, and the next signal like the first one: for a part of the work
/// that the user may end, while the program goes on.
void forget_interrupt();

/// A line such as "printing sheet.png: 42 %" on standard error. It is shown if standard error is a
/// terminal and the work takes more than a second, and removed at the end.
class ProgressLine {
  public:
    explicit ProgressLine(std::string what);
    ~ProgressLine();
    ProgressLine(const ProgressLine&) = delete;
    ProgressLine& operator=(const ProgressLine&) = delete;

    void update(int done, int total);

  private:
    std::string what_;
    bool on_terminal_;
    bool visible_ = false;
    std::chrono::steady_clock::time_point next_;
};

}  // namespace dotpose::cli
