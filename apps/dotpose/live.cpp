// Starts `dotpose-live`, the program beside this one, for the commands that it executes.
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

#include <unistd.h>

#include "commands.hpp"
#include "dotpose/files/error.hpp"

namespace dotpose::cli {
namespace {

/// Replaces this process by the other program. Throws Error if that fails.
[[noreturn]] void become_live(const CLI::App& command) {
    std::error_code failed;
    const auto here = std::filesystem::read_symlink("/proc/self/exe", failed);
    const std::string program = (here.parent_path() / "dotpose-live").string();
    std::vector<std::string> words = {"dotpose", command.get_name()};
    for (const std::string& word : command.remaining())
        words.push_back(word);
    std::vector<char*> arguments;
    for (std::string& word : words)
        arguments.push_back(word.data());
    arguments.push_back(nullptr);
    // Timeout in seconds for a camera that delivers no frames. OpenCV reads the variable when it is
    // loaded, so it is set before the program starts.
    setenv("OPENCV_VIDEOIO_V4L_SELECT_TIMEOUT", "2", 0);
    execv(program.c_str(), arguments.data());
    throw Error("cannot start " + program + ": " + std::strerror(errno));
}

void add_forwarded(CLI::App& app, const char* name, const char* what) {
    CLI::App* command = app.add_subcommand(name, what);
    command->set_help_flag();
    command->prefix_command();
    command->callback([command] { become_live(*command); });
}

}  // namespace

void add_live(CLI::App& app) {
    add_forwarded(app, "watch", "Follow a camera live, or a video frame by frame");
    add_forwarded(app, "fleet", "Show all robots that publish to a broker");
}

}  // namespace dotpose::cli
