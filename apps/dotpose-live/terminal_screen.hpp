/// Displays lines on the whole terminal, and reads keys.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <termios.h>

#include "fleet_page.hpp"

namespace dotpose::cli {

class TerminalScreen {
  public:
    /// Returns true if standard output is a terminal, and this program is in its foreground.
    static bool is_available();

    /// Switches to the alternate screen of the terminal. If standard input is a terminal, keys are
    /// read from it without echo. Ctrl-C still sends SIGINT. The destructor restores the terminal.
    TerminalScreen();
    ~TerminalScreen();
    TerminalScreen(const TerminalScreen&) = delete;
    TerminalScreen& operator=(const TerminalScreen&) = delete;

    ScreenSize size() const;

    /// Returns the next key that was pressed, or nullopt if there is none. Does not wait.
    std::optional<Key> next_key();

    /// Replaces the contents of the screen. Longer lines are cut off.
    void show(const std::vector<std::string>& lines);

  private:
    void read_input();

    std::optional<termios> before_;  ///< settings of the terminal, or none if no keys are read
    std::string input_;              ///< bytes that are not yet recognized as keys
};

}  // namespace dotpose::cli
