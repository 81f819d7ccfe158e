/// Progress of long work on a terminal, and giving it up by Ctrl-C.
#pragma once

#include <chrono>
#include <string>

namespace dotpose::cli {

/// From now on a reader that leaves makes the write fail, and does not end the program.
void ignore_broken_pipes();

/// From now on SIGINT, SIGTERM and SIGHUP no longer end the program but make `interrupted` true, so
/// that no temporary file is left behind. A second signal ends the program.
void catch_interrupts();
bool interrupted();

/// One line on standard error, "printing sheet.png: 42 %". Shown only if standard error is a
/// terminal and the work has taken more than a second; removed at the end.
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
