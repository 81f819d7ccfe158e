// Manual pages and completions, which are written from what the commands declare.
#include <set>
#include <sstream>
#include <string>

#include <gmock/gmock.h>

#include "tool_command.hpp"

namespace dotpose::test {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::IsSupersetOf;
using testing::Not;

using Words = std::set<std::string>;

Words words_of(const std::string& text) {
    std::istringstream stream(text);
    Words words;
    for (std::string word; stream >> word;)
        words.insert(word);
    return words;
}

/// The program that writes lies beside the tool.
class Manuals : public ToolCommand {
  protected:
    Manuals() { shell("\"$(dirname \"$T\")\"/dotpose_manuals ."); }

    /// Returns what bash would offer after these words, the last of which is being typed. Words
    /// that begin with a plus or minus are what bash was told to offer beside.
    Words bash_offers(const std::string& words) {
        EXPECT_EQ(shell("bash -c 'set -u; compopt() { echo \"$@\"; }; . ./dotpose; "
                        "COMP_WORDS=(" +
                        words +
                        "); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); _dotpose; "
                        "printf \"%s\\n\" \"${COMPREPLY[@]-}\"'"),
                  0);
        EXPECT_EQ(errors_, "");
        return words_of(output_);
    }

    /// Returns the commands that bash offers after these words.
    Words commands(const std::string& words = "dotpose") {
        Words offers = bash_offers(words + " \"\"");
        std::erase_if(offers, [](const std::string& word) { return !std::isalpha(word[0]); });
        offers.erase("default");
        return offers;
    }

    /// Returns the long options that the help of a command lists.
    Words options_in_help(const std::string& command) {
        EXPECT_EQ(run(command + " --help"), 0);
        EXPECT_THAT(output_, Not(HasSubstr(":{"))) << "names of values are checked by one_of";
        Words options;
        std::istringstream lines(output_);
        for (std::string line; std::getline(lines, line);) {
            const std::size_t start = line.find("--");
            if (!line.starts_with("  -") || start > 5) continue;
            options.insert(line.substr(start, line.find(' ', start) - start));
        }
        return options;
    }

    bool has(const std::string& program) { return shell("command -v " + program) == 0; }
};

using Completions = Manuals;

TEST_F(Completions, OfBashOfferCommands) {
    EXPECT_THAT(bash_offers("dotpose \"\""),
                IsSupersetOf({"locate", "print", "watch", "fleet", "help", "--version"}));
    EXPECT_EQ(bash_offers("dotpose wat"), (Words{"+o", "default", "watch"}));
    EXPECT_EQ(bash_offers("dotpose help wat"), (Words{"+o", "default", "watch"}));
}

TEST_F(Completions, OfBashOfferAllOptionsThatTheHelpHas) {
    ASSERT_THAT(commands(), Contains("watch"));
    for (const std::string& command : commands()) {
        const Words options = options_in_help(command);
        EXPECT_THAT(options, Contains("--help")) << command;
        Words offers = bash_offers("dotpose " + command + " --");
        std::erase_if(offers, [](const std::string& word) { return !word.starts_with("--"); });
        EXPECT_EQ(offers, options) << command;
    }
}

TEST_F(Completions, OfBashOfferCommandsOfACommand) {
    const Words own = commands("dotpose sheets");
    EXPECT_THAT(own, IsSupersetOf({"list", "place", "map"}));
    for (const std::string& command : own) {
        Words offers = bash_offers("dotpose sheets " + command + " --");
        std::erase_if(offers, [](const std::string& word) { return !word.starts_with("--"); });
        EXPECT_EQ(offers, options_in_help("sheets " + command)) << command;
    }
}

TEST_F(Completions, OfBashOfferValues) {
    EXPECT_EQ(bash_offers("dotpose locate --format \"\""),
              (Words{"+o", "default", "json", "csv", "text"}));
    EXPECT_EQ(bash_offers("dotpose locate --format = c"), (Words{"+o", "default", "csv"}));
    EXPECT_EQ(bash_offers("dotpose locate --format ="),
              (Words{"+o", "default", "json", "csv", "text"}));
    EXPECT_EQ(bash_offers("dotpose watch 0 --code micro"), (Words{"+o", "default", "microdots"}));
    EXPECT_THAT(bash_offers("dotpose simulate -o \"\""), IsEmpty()) << "a folder or a video";
    EXPECT_THAT(bash_offers("dotpose locate --sheets \"\""), IsEmpty()) << "files are the default";
    EXPECT_THAT(bash_offers("dotpose locate a.png \"\""), IsEmpty()) << "files are the default";
    EXPECT_EQ(bash_offers("dotpose locate --spacing \"\""), (Words{"+o", "default"}));
}

TEST_F(Completions, OfFish) {
    if (!has("fish")) GTEST_SKIP() << "no fish; scripts/setup packaging installs it";
    const auto offers = [this](const std::string& line) {
        EXPECT_EQ(shell("HOME=$PWD fish --no-config -c 'source dotpose.fish; complete -C \"" +
                        line + "\"' | cut -f 1"),
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
    EXPECT_THAT(offers("dotpose locate dotpose.f"), Contains("dotpose.fish"));
    fs::create_directory(directory_ / "frames");
    EXPECT_THAT(offers("dotpose simulate -o "), Contains("frames/"));
}

TEST_F(Completions, OfZsh) {
    if (!has("zsh")) GTEST_SKIP() << "no zsh; scripts/setup packaging installs it";
    // What is typed and then completed is read back from a terminal.
    std::ofstream(directory_ / "try.zsh") << R"(
        zmodload zsh/zpty
        zpty -b typed zsh -f -i
        zpty -w typed 'PS1= zle_highlight=(none) fpath=($PWD $fpath)'
        zpty -w typed 'autoload -U compinit; compinit -u -d $PWD/dump; echo rea""dy'
        zpty -r typed answer '*ready*'
        zpty -w -n typed "$1"$'\t'
        zpty -r typed answer "*$2*"
    )";
    const auto expect_becomes = [this](const std::string& typed, const std::string& completed) {
        EXPECT_EQ(
            shell("TERM=xterm timeout 240 zsh -f try.zsh '" + typed + "' '" + completed + "'"), 0)
            << typed;
    };
    ASSERT_EQ(shell("zsh -f -n _dotpose"), 0) << errors_;
    expect_becomes("dotpose wat", "dotpose watch ");
    expect_becomes("dotpose help wat", "dotpose help watch ");
    expect_becomes("dotpose sheets pl", "dotpose sheets place ");
    expect_becomes("dotpose sheets map --ou", "dotpose sheets map --out=");
    expect_becomes("dotpose locate --forma", "dotpose locate --format=");
    expect_becomes("dotpose locate --format js", "dotpose locate --format json ");
    expect_becomes("dotpose locate dotpose.f", "dotpose locate dotpose.fish ");
}

TEST_F(Manuals, EveryCommandHasAPageWithAllItsOptions) {
    for (const std::string& command : commands()) {
        const std::string page = file("dotpose-" + command + ".1");
        for (const std::string& option : options_in_help(command)) {
            std::string escaped;
            for (const char c : option)
                escaped += c == '-' ? std::string("\\-") : std::string(1, c);
            EXPECT_THAT(page, HasSubstr("\\fB" + escaped + "\\fR")) << command;
        }
    }
    EXPECT_THAT(file("dotpose.1"), HasSubstr("dotpose\\-watch"));
    EXPECT_THAT(file("dotpose-sheets.1"), HasSubstr("\\fB\\-\\-yaw\\fR"));
}

TEST_F(Manuals, PagesAreWithoutFaultForTroff) {
    ASSERT_EQ(shell("for page in *.1; do groff -man -ww -Tascii -P-cbou $page >$page.txt; done"),
              0);
    EXPECT_EQ(errors_, "");
    const std::string page = file("dotpose-locate.1.txt");
    for (const char* title : {"NAME", "SYNOPSIS", "OPTIONS", "EXAMPLES", "SEE ALSO"})
        EXPECT_THAT(page, HasSubstr(title));
    EXPECT_THAT(page, HasSubstr("find frames -name '*.png' | sort | dotpose locate --list -\n"));
}

}  // namespace
}  // namespace dotpose::test
