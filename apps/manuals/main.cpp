// Writes the manual pages and the completions for shells, from what the commands declare.
//
//   dotpose_manuals FOLDER    FOLDER must exist
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "writers.hpp"

namespace {

void write(const std::filesystem::path& path, const std::string& text) {
    std::ofstream file(path, std::ios::binary);
    file << text;
    file.close();
    if (!file) throw std::runtime_error("cannot write " + path.string());
}

void write_all(const std::filesystem::path& folder) {
    using namespace dotpose::manuals;
    const ToolText tool = declarations();
    write(folder / "dotpose.1", tool_page(tool));
    for (const CommandText& command : tool.top.commands)
        write(folder / ("dotpose-" + command.name + ".1"), command_page(tool, command));
    // Each shell looks for its file under the name that it gives it.
    write(folder / "dotpose", bash_completions(tool));
    write(folder / "_dotpose", zsh_completions(tool));
    write(folder / "dotpose.fish", fish_completions(tool));
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) {
        std::fputs("Usage: dotpose_manuals FOLDER\n", stderr);
        return 2;
    }
    try {
        write_all(argv[1]);
        return 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "dotpose_manuals: %s\n", error.what());
        return 1;
    }
}
