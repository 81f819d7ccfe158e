/// Runs shell commands and captures their output.
#pragma once

#include <array>
#include <cstdio>
#include <stdexcept>
#include <string>

#include <sys/wait.h>

namespace dotpose::test {

struct ShellOutcome {
    int exit_code = -1;  ///< -1 if a signal ended the command
    std::string output;  ///< standard output
};

inline ShellOutcome run_shell(const std::string& commands) {
    std::FILE* pipe = popen(commands.c_str(), "r");
    if (pipe == nullptr) throw std::runtime_error("cannot run " + commands);
    ShellOutcome outcome;
    std::array<char, 4096> buffer;
    while (const std::size_t size = std::fread(buffer.data(), 1, buffer.size(), pipe))
        outcome.output.append(buffer.data(), size);
    const int status = pclose(pipe);
    if (WIFEXITED(status)) outcome.exit_code = WEXITSTATUS(status);
    return outcome;
}

}  // namespace dotpose::test
