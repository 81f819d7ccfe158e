// Tests the manual pages and the shell completions (apps/shell).
#include <set>
#include <sstream>
#include <string>

#include <gmock/gmock.h>

#include "tool_command.hpp"

namespace dotpose::test {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::IsSupersetOf;

using Words = std::set<std::string>;

Words words_of(const std::string& text) {
    std::istringstream stream(text);
    Words words;
    for (std::string word; stream >> word;)
        words.insert(word);
    return words;
}

class ShellFiles : public ToolCommand {
  protected:
    const std::string folder_ = source_dir() + "/apps/shell";

    /// Returns the completions that bash offers for the last element of `words`.
    Words bash_offers(const std::string& words) {
        EXPECT_EQ(
            shell("T=\"$T\" bash -c 'set -u; . " + folder_ + "/dotpose.bash; COMP_WORDS=(" + words +
                  "); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); _dotpose \"$T\"; "
                  "printf \"%s\\n\" \"${COMPREPLY[@]-}\"'"),
            0);
        EXPECT_EQ(errors_, "");
        return words_of(output_);
    }

    Words options_in_help(const std::string& command) {
        EXPECT_EQ(run(command + " --help"), 0);
        Words options;
        std::istringstream lines(output_);
        for (std::string line; std::getline(lines, line);) {
            const std::size_t start = line.find("--");
            if (!line.starts_with("  -") || start > 6) continue;
            options.insert(line.substr(start, line.find(' ', start) - start));
        }
        return options;
    }

    bool has(const std::string& program) { return shell("command -v " + program) == 0; }
};

using Completions = ShellFiles;
using Manuals = ShellFiles;

TEST_F(Completions, OfBashOfferCommandsAndTheirOptions) {
    const Words commands = bash_offers("dotpose \"\"");
    EXPECT_THAT(commands, IsSupersetOf({"locate", "print", "watch", "fleet", "help"}));
    for (const std::string& command : commands)
        EXPECT_EQ(bash_offers("dotpose " + command + " --"), options_in_help(command)) << command;
    EXPECT_EQ(bash_offers("dotpose wat"), Words{"watch"});
    EXPECT_EQ(bash_offers("dotpose help wat"), Words{"watch"});
    EXPECT_EQ(bash_offers("dotpose --ver"), Words{"--version"});
    EXPECT_THAT(bash_offers("dotpose sheets \"\""), IsSupersetOf({"list", "place", "map"}));
    EXPECT_EQ(bash_offers("dotpose sheets place --"), options_in_help("sheets place"));
}

TEST_F(Completions, OfBashOfferValues) {
    EXPECT_EQ(bash_offers("dotpose locate --format \"\""), (Words{"json", "csv", "text"}));
    EXPECT_EQ(bash_offers("dotpose locate --format = c"), Words{"csv"});
    EXPECT_EQ(bash_offers("dotpose locate --format ="), (Words{"json", "csv", "text"}));
    EXPECT_EQ(bash_offers("dotpose watch 0 --code micro"), Words{"microdots"});
    // If the completion function offers nothing, bash itself completes file names.
    for (const char* words : {"dotpose locate --sheets \"\"", "dotpose locate a.png \"\"",
                              "dotpose watch \"\"", "dotpose banana \"\""})
        EXPECT_THAT(bash_offers(words), IsEmpty()) << words;
}

TEST_F(Completions, OfFish) {
    if (!has("fish")) GTEST_SKIP() << "no fish; scripts/setup packaging installs it";
    const auto offers = [this](const std::string& line) {
        EXPECT_EQ(shell("PATH=$(dirname $T):$PATH HOME=$PWD fish --no-config -c 'source " +
                        folder_ + "/dotpose.fish; complete -C \"" + line + "\"' | cut -f 1"),
                  0);
        EXPECT_EQ(errors_, "");
        return words_of(output_);
    };
    EXPECT_EQ(offers("dotpose wat"), Words{"watch"});
    EXPECT_EQ(offers("dotpose help wat"), Words{"watch"});
    EXPECT_EQ(offers("dotpose sheets pl"), Words{"place"});
    EXPECT_EQ(offers("dotpose sheets place --ya"), Words{"--yaw"});
    EXPECT_EQ(offers("dotpose locate --forma"), Words{"--format"});
    EXPECT_EQ(offers("dotpose locate --format "), (Words{"json", "csv", "text"}));
    fs::create_directory(directory_ / "frames");
    EXPECT_EQ(offers("dotpose simulate -o "), Words{"frames/"});
}

TEST_F(Completions, OfZsh) {
    if (!has("zsh")) GTEST_SKIP() << "no zsh; scripts/setup packaging installs it";
    // The arguments of the script are pairs. For each pair, the script types the first argument and
    // a tab into a terminal, and waits until the second argument appears.
    std::ofstream(directory_ / "try.zsh") << R"(
        zmodload zsh/zpty
        zpty -b typed zsh -f -i
        zpty -w typed 'PS1= zle_highlight=(none) fpath=($PWD $fpath)'
        zpty -w typed 'autoload -U compinit; compinit -u -d $PWD/dump; echo rea""dy'
        zpty -r typed answer '*ready*'
        for typed completed in "$@"; do
            zpty -w -n typed $'\025'"$typed"$'\t'
            zpty -r typed answer "*$completed*"
            print -r -- "$completed"
        done
    )";
    fs::copy_file(folder_ + "/dotpose.zsh", directory_ / "_dotpose");
    ASSERT_EQ(shell("zsh -f -n _dotpose"), 0) << errors_;
    fs::create_directory(directory_ / "frames");
    EXPECT_EQ(shell("PATH=$(dirname $T):$PATH TERM=xterm timeout 240 zsh -f try.zsh "
                    "'dotpose wat' 'dotpose watch ' "
                    "'dotpose help wat' 'dotpose help watch ' "
                    "'dotpose sheets pl' 'dotpose sheets place ' "
                    "'dotpose sheets map --ou' 'dotpose sheets map --out ' "
                    "'dotpose locate --format js' 'dotpose locate --format json ' "
                    "'dotpose locate fra' 'dotpose locate frames/'"),
              0)
        << "completed: " << output_;
}

TEST_F(Manuals, PagesAreWithoutFaultAndHaveAllThatTheHelpHas) {
    if (!has("help2man")) GTEST_SKIP() << "no help2man; scripts/setup live installs it";
    ASSERT_EQ(shell(folder_ + "/write_manual_pages \"$T\" pages locate"), 0) << errors_;
    ASSERT_EQ(shell("groff -man -ww -Tascii -P-cbou pages/dotpose-locate.1"), 0);
    EXPECT_EQ(errors_, "");
    const std::string page = output_;
    EXPECT_THAT(words_of(page), IsSupersetOf(options_in_help("locate")));
    for (const char* part :
         {"dotpose-locate - Find the position", "SYNOPSIS", "OPTIONS", "EXAMPLES", "EXIT STATUS",
          "SEE ALSO", "find frames -name '*.png' | sort | dotpose locate --list -\n"})
        EXPECT_THAT(page, HasSubstr(part));
}

}  // namespace
}  // namespace dotpose::test
