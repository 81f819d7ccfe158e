/// `dotpose` as its user sees it: a program in a directory with files.
#pragma once

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include <gtest/gtest.h>
#include <stdlib.h>
#include <sys/wait.h>

namespace dotpose::test {

namespace fs = std::filesystem;

inline std::string read_file(const fs::path& path) {
    std::ifstream stream(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

/// Runs the tool in a directory of its own, and keeps what the last run said.
class ToolCommand : public testing::Test {
  protected:
    void SetUp() override {
        std::string name = (fs::temp_directory_path() / "dotpose-tool-XXXXXX").string();
        ASSERT_NE(mkdtemp(name.data()), nullptr);
        directory_ = name;
    }
    void TearDown() override { fs::remove_all(directory_); }

    /// Runs `dotpose ARGUMENTS`, which a shell reads, and returns the exit code.
    int run(const std::string& arguments, const std::string& input = "/dev/null") {
        const fs::path errors = directory_ / ".stderr";
        const std::string command = "cd '" + directory_.string() + "' && { '" DOTPOSE_TOOL "' " +
                                    arguments + "; } <" + input + " 2>'" + errors.string() + "'";
        exit_code_ = -1;
        output_.clear();
        errors_.clear();
        std::FILE* pipe = popen(command.c_str(), "r");
        if (pipe == nullptr) {
            ADD_FAILURE() << "cannot run " << command;
            return exit_code_;
        }
        std::array<char, 4096> buffer;
        for (std::size_t n = 1; n > 0;) {
            n = std::fread(buffer.data(), 1, buffer.size(), pipe);
            output_.append(buffer.data(), n);
        }
        const int status = pclose(pipe);
        if (WIFEXITED(status)) exit_code_ = WEXITSTATUS(status);
        errors_ = read_file(errors);
        fs::remove(errors);
        return exit_code_;
    }

    std::string file(const std::string& name) const { return read_file(directory_ / name); }

    fs::path directory_;
    int exit_code_ = -1;
    std::string output_;  ///< standard output
    std::string errors_;  ///< standard error
};

}  // namespace dotpose::test
