// Tests how the tool reports mistakes that new users are likely to make. The exit status must be
// non-zero, and a single message must contain the cause and the next step.
#include <ostream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "locate_command.hpp"

namespace dotpose::test {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

struct Mistake {
    const char* name;
    const char* arguments;
    int exit_code;
    const char* cause;
    const char* next_step;
};

constexpr Mistake kMistakes[] = {
    // Commands and options
    {"NoCommand", "", 2, "no command given", "Try: dotpose --help"},
    {"MisspeltCommand", "loacte a.pgm", 2, "unknown command 'loacte'", "did you mean 'locate'?"},
    {"MisspeltCommandOfHelp", "help pirnt", 2, "'pirnt'", "did you mean 'print'?"},
    {"MisspeltOption", "locate a.pgm --spacng 0.5", 2, "unknown option '--spacng'",
     "did you mean '--spacing'?"},
    {"SingularOption", "locate a.pgm --sheet sheets.json", 2, "unknown option '--sheet'",
     "did you mean '--sheets'?"},
    {"OneHyphen", "print -out a.pdf", 2, "unknown option '-out'", "did you mean '--out'?"},
    {"MisspeltValue", "locate --code anotto a.pgm", 2, "'anotto'", "did you mean 'anoto'?"},
    {"OtherFormat", "locate --format xml a.pgm", 2, "'xml' is not", "csv"},
    {"ValueLeftOut", "calibrate frames --camera", 2, "--camera requires a value",
     "dotpose calibrate --help"},
    {"OptionBeforeCommand", "--spacing 0.5 locate a.pgm", 2, "unknown option '--spacing'",
     "dotpose locate --spacing"},
    // Files and folders
    {"NoImage", "locate", 2, "no source of frames given", "name images, a folder, a video"},
    {"NoSuchImage", "locate nothere.png", 1, "cannot read nothere.png", "no such file"},
    {"EmptyFolder", "locate empty", 1, "cannot read empty", "no images in this folder"},
    {"TextAsImage", "locate notes.txt", 1, "cannot read notes.txt",
     "PNM, PNG, JPEG, BMP, TIFF, WebP or HEIC"},
    {"DrawingAsImage", "locate sheet.svg", 1, "a drawing", "rsvg-convert"},
    {"PdfAsImage", "locate sheet.pdf", 1, "a PDF", "pdftoppm"},
    {"SheetFileAsImage", "locate sheets.json", 1, "JSON", "--sheets"},
    {"CutImage", "locate cut.pgm", 1, "cut.pgm", "cut short"},
    {"PhoneFormat", "locate photo.jxl", 1, "JPEG XL", "djxl"},
    {"NoSuchCameraFile", "locate --camera no.yaml a.pgm", 1, "cannot read no.yaml",
     "No such file or directory"},
    {"NoSuchList", "locate --list no.txt", 1, "cannot read the list no.txt",
     "No such file or directory"},
    {"NoSuchLog", "replay no.csv", 1, "cannot read no.csv", "No such file or directory"},
    {"NoSuchSheetFile", "locate --sheets no.json a.pgm", 1, "cannot read no.json",
     "dotpose print --sheets no.json"},
    {"TextAsSheetFile", "locate --sheets notes.txt a.pgm", 1, "notes.txt is not a sheet file",
     "line 1"},
    {"SheetFileAsCamera", "locate --camera sheets.json a.pgm", 1, "sheets.json",
     "not a camera file"},
    {"OutputForgotten", "locate -o a.pgm frames", 2, "-o a.pgm",
     "was the name of the output left out?"},
    {"PrintWithoutOutput", "print", 2, "--out is required", "-o FILE"},
    {"PrintWithoutMinusO", "print sheet.pdf", 2, "unexpected argument 'sheet.pdf'", "-o"},
    {"PrintToOtherFormat", "print -o sheet.docx", 2, "sheet.docx", ".pdf, .svg, .png"},
    {"PrintToMissingFolder", "print -o nothere/a.pdf", 1, "cannot create nothere/a.pdf",
     "No such file or directory"},
    {"SimulateIntoFile", "simulate -o notes.txt", 1, "notes.txt is a file", "name a folder"},
    {"OverlayOfImage", "overlay a.pgm -o b.pdf", 1, "a.pgm is not a PDF", "as a PDF"},
    {"ReplayOfFolder", "replay frames", 1, "cannot read frames", "dotpose watch --log"},
    {"ReplayOfText", "replay notes.txt", 1, "not a log of dotpose watch", "notes.txt"},
    {"EvaluateWithoutTruth", "evaluate plain", 1, "no plain/truth.csv", "--poses"},
    // Units, sizes and numbers
    {"SpacingInMicrometres", "locate --spacing 508 a.pgm", 2, "'508'", "the default is 0.508"},
    {"SpacingWithUnit", "locate --spacing 0.5mm a.pgm", 2, "'0.5mm'", "in mm"},
    {"UnknownPaper", "print -o a.pdf --paper A44", 2, "unknown paper size 'A44'", "A0 to A6"},
    {"CoarsePrinter", "print -o a.png --dpi 100", 2, "100 dpi is too low", "300 dpi or more"},
    {"SizeOfOneNumber", "optics --size 640", 2, "'640'", "such as 188x120"},
    {"ReferenceOfOneNumber", "locate --reference 10 a.pgm", 2, "'10'", "two numbers"},
    {"SectionTooLarge", "print -o a.pdf --section 63,0", 2, "'63,0'", "from 0 to 62"},
    {"NoFrames", "simulate -o g --frames 0", 2, "0", "1 to 1000000"},
    // Options that require each other, and missing arguments
    {"NameTaken", "print -o b.svg --sheets sheets.json --name table", 2,
     "there already is a sheet 'table'", "dotpose print --help"},
    {"SheetsWithoutName", "print -o b.svg --sheets sheets.json", 2, "--sheets", "--name"},
    {"StitchWithoutSheets", "calibrate --stitch frames", 2, "--stitch", "--sheets"},
    {"OneFrameToCalibrate", "calibrate a.pgm -o c.yaml", 1, "a single frame", "take 5 to 50"},
    {"NothingToCalibrate", "calibrate", 2, "no frames given", "5 to 50 images"},
    {"RawWithoutSize", "locate -", 2, "raw frames need their size", "--size WxH"},
    // Cameras, serial lines and brokers
    {"NoSuchCamera", "watch 63 --no-window", 1, "cannot open the camera 63", "there is none"},
    {"NoSuchVideo", "watch nothere.mp4", 1, "cannot read nothere.mp4", "no such file or camera"},
    {"BrokerWithoutScheme", "fleet --mqtt broker", 2, "'broker'", "did you mean mqtt://broker?"},
    {"NoPackets", "listen notes.txt", 0, "0 packets", "watch --packets"},
};

void PrintTo(const Mistake& mistake, std::ostream* out) {
    *out << "dotpose " << mistake.arguments;
}

class Mistakes : public ToolCommand, public testing::WithParamInterface<Mistake> {};

TEST_P(Mistakes, NameTheCauseAndTheNextStep) {
    ASSERT_EQ(shell("$T simulate -o frames --frames 4 && cp frames/frame_000000.pgm a.pgm && "
                    "mkdir empty plain && cp a.pgm plain && head -c 300 a.pgm > cut.pgm && "
                    "echo hello > notes.txt && printf '\\377\\012' > photo.jxl "
                    "&& $T print -o sheet.pdf --paper 40x30 && "
                    "$T print -o sheet.svg --paper 40x30 --sheets sheets.json --name table"),
              0)
        << errors_;
    EXPECT_EQ(run(GetParam().arguments), GetParam().exit_code) << errors_;
    EXPECT_THAT(errors_, StartsWith("dotpose: "));
    EXPECT_THAT(errors_, HasSubstr(GetParam().cause));
    EXPECT_THAT(errors_, HasSubstr(GetParam().next_step));
}

INSTANTIATE_TEST_SUITE_P(OfNewUsers, Mistakes, testing::ValuesIn(kMistakes),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace dotpose::test
