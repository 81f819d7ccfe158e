// Tests the help texts, and the error messages for invalid command lines.
#include <sstream>
#include <string>

#include <gmock/gmock.h>

#include "tool_command.hpp"

namespace dotpose::test {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

class Usage : public ToolCommand {
  protected:
    /// Expects that the tool refuses the arguments with exactly these two lines.
    void expect_refusal(const std::string& arguments, const std::string& message,
                        const std::string& help) {
        EXPECT_EQ(run(arguments), 2) << arguments;
        EXPECT_EQ(errors_, "dotpose: " + message + "\nTry: " + help + "\n") << arguments;
        EXPECT_EQ(output_, "") << arguments;
    }
};

TEST_F(Usage, CommandsThatDoNotExist) {
    expect_refusal("", "no command given", "dotpose --help");
    expect_refusal("lokate a.png", "unknown command 'lokate'; did you mean 'locate'?",
                   "dotpose --help");
    expect_refusal("wacth 0", "unknown command 'wacth'; did you mean 'watch'?", "dotpose --help");
    expect_refusal("cal", "unknown command 'cal'; did you mean 'calibrate'?", "dotpose --help");
    expect_refusal("banana", "unknown command 'banana'", "dotpose --help");
}

TEST_F(Usage, OptionsThatDoNotExist) {
    expect_refusal("locate --formt csv a.png", "unknown option '--formt'; did you mean '--format'?",
                   "dotpose locate --help");
    expect_refusal("locate --formt=csv a.png", "unknown option '--formt'; did you mean '--format'?",
                   "dotpose locate --help");
    expect_refusal("locate a.png --banana", "unknown option '--banana'", "dotpose locate --help");
    expect_refusal("watch 0 --mqt x", "unknown option '--mqt'; did you mean '--mqtt'?",
                   "dotpose watch --help");
    expect_refusal("--vershun", "unknown option '--vershun'; did you mean '--version'?",
                   "dotpose --help");
}

TEST_F(Usage, AMisspeltOptionIsToldBeforeTheOneThatIsMissing) {
    expect_refusal("print --ouut a.pdf", "unknown option '--ouut'; did you mean '--out'?",
                   "dotpose print --help");
    expect_refusal("print", "--out is required: name the file to write, -o FILE",
                   "dotpose print --help");
}

TEST_F(Usage, ALongOptionWithOneHyphen) {
    expect_refusal("locate -out poses.csv a.png", "unknown option '-out'; did you mean '--out'?",
                   "dotpose locate --help");
    expect_refusal("print -out=a.pdf", "unknown option '-out'; did you mean '--out'?",
                   "dotpose print --help");
    expect_refusal("locate -format csv a.png", "unknown option '-format'; did you mean '--format'?",
                   "dotpose locate --help");
    EXPECT_FALSE(fs::exists(directory_ / "ut"));
}

TEST_F(Usage, AnOptionBeforeTheCommand) {
    expect_refusal("--format csv locate a.png",
                   "unknown option '--format'; options of a command follow it: dotpose locate "
                   "--format",
                   "dotpose locate --help");
}

TEST_F(Usage, ValuesThatDoNotExist) {
    expect_refusal("locate --code microdot a.png",
                   "--code: 'microdot' is not auto, anoto, libdots or microdots; did you mean "
                   "'microdots'?",
                   "dotpose locate --help");
    expect_refusal("locate --format CSV a.png",
                   "--format: 'CSV' is not json, csv or text; did you mean 'csv'?",
                   "dotpose locate --help");
    expect_refusal("locate --effort wice a.png",
                   "--effort: 'wice' is not device, once or twice; did you mean 'twice'?",
                   "dotpose locate --help");
    expect_refusal("print -o a.pdf --dots glyph",
                   "--dots: 'glyph' is not auto, glyphs or strokes; did you mean 'glyphs'?",
                   "dotpose print --help");
    expect_refusal("watch 0 --code anotto",
                   "--code: 'anotto' is not auto, anoto, libdots or microdots; did you mean "
                   "'anoto'?",
                   "dotpose watch --help");
}

TEST_F(Usage, ValuesThatAreMissingOrNoNumbers) {
    expect_refusal("print -o", "--out requires a value", "dotpose print --help");
    expect_refusal("print -o a.pdf --pages few", "--pages: 'few' is not a valid number",
                   "dotpose print --help");
    expect_refusal("simulate -o a --at 5", "--at takes 2 values, not 1", "dotpose simulate --help");
    expect_refusal("simulate -o a --at 5,6,7", "--at takes 2 values, not 3",
                   "dotpose simulate --help");
    expect_refusal("simulate -o a --frames 0", "--frames: '0' is not a number from 1 to 1000000",
                   "dotpose simulate --help");
    expect_refusal("print -o a.pdf --pages 2.5", "--pages: '2.5' is not a valid number",
                   "dotpose print --help");
}

TEST_F(Usage, OptionsThatNeedOrExcludeOthers) {
    expect_refusal("simulate -o a --speed 50", "--speed requires --drive",
                   "dotpose simulate --help");
    expect_refusal("locate --sheets a.json --code anoto a.png",
                   "--code and --sheets cannot be given together", "dotpose locate --help");
    expect_refusal("locate --code anoto --code libdots a.png", "--code takes one value, not 2",
                   "dotpose locate --help");
}

TEST_F(Usage, AReaderOfMessagesMayLeave) {
    shell("{ sleep 0.1; \"$T\" watch missing.png 2>&1; echo $? >status; } | true");
    EXPECT_EQ(file("status"), "1\n");
}

TEST_F(Usage, MistakesFoundAfterParsingNameTheHelpToo) {
    expect_refusal("locate",
                   "no source of frames given: name images, a folder, a video or a camera, or use "
                   "--list",
                   "dotpose locate --help");
    expect_refusal("replay run.csv extra",
                   "unexpected argument 'extra'; the file to write is named with -o",
                   "dotpose replay --help");
    expect_refusal("print -o a.svg extra", "unexpected argument 'extra'", "dotpose print --help");
}

TEST_F(Usage, HelpOfACommandIsThatOfItsOption) {
    for (const std::string command : {"print", "locate", "watch"}) {
        ASSERT_EQ(run(command + " --help"), 0);
        const std::string wanted = output_;
        EXPECT_THAT(wanted, HasSubstr("Usage: dotpose " + command));
        ASSERT_EQ(run("help " + command), 0);
        EXPECT_EQ(output_, wanted);
    }
    EXPECT_EQ(run("help lokate"), 2);
    EXPECT_THAT(errors_, HasSubstr("did you mean 'locate'?"));
}

TEST_F(Usage, HelpHasAtMostAHundredColumnsAndNothingOfTheParser) {
    for (const std::string command :
         {"", "locate", "print", "overlay", "sheets place", "simulate", "evaluate", "check-print",
          "calibrate", "optics", "listen", "replay", "ink", "watch", "fleet"}) {
        ASSERT_EQ(run(command + " --help"), 0);
        std::istringstream lines(output_);
        for (std::string line; std::getline(lines, line);)
            EXPECT_LE(line.size(), 100U) << command << ": " << line;
        for (const char* word : {" in [", "FLOAT", "INT ", "Excludes", "Needs:", "REQUIRED"})
            EXPECT_THAT(output_, Not(HasSubstr(word))) << command;
    }
}

TEST_F(Usage, HelpShowsAFirstDay) {
    ASSERT_EQ(run("--help"), 0);
    const std::string wanted = output_;
    ASSERT_EQ(run("help"), 0);
    EXPECT_EQ(output_, wanted);
    for (const char* line : {"\n  dotpose print -o ", "\n  dotpose locate ", "\n  dotpose watch 0",
                             "\nDocuments: ", "examples/"})
        EXPECT_THAT(wanted, HasSubstr(line));
}

TEST_F(Usage, Version) {
    ASSERT_EQ(run("version"), 0);
    EXPECT_THAT(output_, StartsWith("dotpose 0."));
    const std::string wanted = output_;
    ASSERT_EQ(run("--version"), 0);
    EXPECT_EQ(output_, wanted);
}

}  // namespace
}  // namespace dotpose::test
