/// Displays lines of text on the whole terminal screen, and reads keys.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <termios.h>

#include "fleet_page.hpp"

namespace dotpose::cli {

class TerminalScreen {
  public:
    /// Returns true if standard output is a terminal and this program is in the foreground.
    static bool is_available();

    /// Switches to the alternate screen of the terminal. If standard input is a terminal, also
    /// starts reading keys from it without echo. Ctrl-C still sends SIGINT. The destructor restores
    /// the terminal.
    TerminalScreen();
    ~TerminalScreen();
    TerminalScreen(const TerminalScreen&) = delete;
    TerminalScreen& operator=(const TerminalScreen&) = delete;

    ScreenSize size() const;

    /// Returns the next key that was pressed, or nullopt if no key was pressed. Does not block.
    std::optional<Key> next_key();

    /// Replaces the contents of the screen. Lines that are too long are truncated.
    void show(const std::vector<std::string>& lines);

  private:
    void read_input();

    std::optional<termios> before_;  ///< original terminal settings, or nullopt if no keys are read
    std::string input_;              ///< bytes that have not been recognised as keys yet
};

}  // namespace dotpose::cli
