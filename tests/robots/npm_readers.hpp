/// Reads robot messages with independent programs that are installed from npm.
#pragma once

#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "../paths.hpp"
#include "../shell.hpp"

namespace dotpose::test {

/// Returns the folder that contains the programs that read the messages. The first call installs
/// these programs. Returns an empty string if npm or the network is not available.
inline std::string npm_folder() {
    static const ShellOutcome installed =
        run_shell("'" + source_dir() + "/tests/robots/npm_packages' '" DOTPOSE_NPM_FOLDER "'");
    return installed.exit_code == 0 ? DOTPOSE_NPM_FOLDER : "";
}

/// Skips a test if the readers are not available.
#define DOTPOSE_NEEDS_NPM() \
    if (npm_folder().empty()) GTEST_SKIP() << "no npm, or no network to get its packages"

inline ShellOutcome run_node(const std::string& command) {
    return run_shell("node '" + npm_folder() + "'/" + command);
}

/// Reads all messages in an MCAP file with both readers, which check all checksums.
inline std::vector<nlohmann::json> read_mcap(const std::string& path,
                                             const std::string& option = "") {
    const ShellOutcome read = run_node("read_mcap.mjs '" + path + "' " + option + " 2>&1");
    EXPECT_EQ(read.exit_code, 0) << read.output.substr(0, 2000);
    std::vector<nlohmann::json> messages;
    if (read.exit_code != 0) return messages;
    std::istringstream stream(read.output);
    for (std::string line; std::getline(stream, line);)
        messages.push_back(nlohmann::json::parse(line));
    return messages;
}

inline std::vector<nlohmann::json> of_topic(const std::vector<nlohmann::json>& messages,
                                            const std::string& topic) {
    std::vector<nlohmann::json> result;
    for (const nlohmann::json& message : messages)
        if (message["topic"] == topic) result.push_back(message);
    return result;
}

}  // namespace dotpose::test
