#include "rendered_page.hpp"

#include <array>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/core.h>

#include "../shell.hpp"

namespace dotpose::roundtrip {
namespace fs = std::filesystem;
namespace {

std::vector<std::uint8_t> read_samples(std::ifstream& file, std::size_t count,
                                       const fs::path& path) {
    std::vector<std::uint8_t> samples(count);
    file.read(reinterpret_cast<char*>(samples.data()), static_cast<std::streamsize>(count));
    if (!file) throw std::runtime_error("too short: " + path.string());
    return samples;
}

std::size_t area(const GreyPage& page) {
    return static_cast<std::size_t>(page.width_px) * static_cast<std::size_t>(page.height_px);
}

/// Reads a binary 8-bit PGM file. All three renderers write this format. '#' begins a comment.
GreyPage read_pgm(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    std::array<std::string, 4> header;  // P5, width, height, 255
    for (std::string& word : header) {
        while (file >> word && word.front() == '#')
            std::getline(file, word);
    }
    if (header[0] != "P5" || header[3] != "255")
        throw std::runtime_error("no PGM: " + path.string());
    file.get();
    GreyPage page{std::stoi(header[1]), std::stoi(header[2]), {}};
    page.grey = read_samples(file, area(page), path);
    return page;
}

/// Reads the black channel of an 8-bit CMYK file in PAM format, in which 255 is full ink.
GreyPage read_black_of_pam(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    GreyPage page;
    std::string type;
    for (std::string word; file >> word && word != "ENDHDR";) {
        if (word == "WIDTH") file >> page.width_px;
        if (word == "HEIGHT") file >> page.height_px;
        if (word == "TUPLTYPE") file >> type;
        std::getline(file, word);
    }
    file.get();
    if (type != "CMYK") throw std::runtime_error("no CMYK: " + path.string());
    const std::vector<std::uint8_t> inks = read_samples(file, 4 * area(page), path);
    for (std::size_t i = 3; i < inks.size(); i += 4)
        page.grey.push_back(static_cast<std::uint8_t>(255 - inks[i]));
    return page;
}

std::string ghostscript(const char* device, int dpi, int page) {
    return fmt::format(
        "gs -q -dSAFER -dUseCropBox -sDEVICE={0} -dTextAlphaBits=4 -dGraphicsAlphaBits=4 -r{1} "
        "-dFirstPage={2} -dLastPage={2}",
        device, dpi, page);
}

}  // namespace

std::string run(const std::string& command) {
    const test::ShellOutcome outcome = test::run_shell("{ " + command + "; } 2>&1");
    if (outcome.exit_code != 0) throw std::runtime_error(command + "\n" + outcome.output);
    return outcome.output;
}

GreyPage render(const std::string& renderer, const fs::path& pdf, int dpi, int page) {
    const fs::path image = fmt::format("{}-{}.pgm", pdf.string(), renderer);
    const std::string in = fmt::format("'{}'", pdf.string());
    const std::string out = fmt::format("'{}'", image.string());
    if (renderer == "pdftoppm") {
        run(fmt::format("pdftoppm -cropbox -gray -r {} -f {} -singlefile {} > {}", dpi, page, in,
                        out));
    } else if (renderer == "gs") {
        run(ghostscript("pgmraw", dpi, page) + fmt::format(" -o {} {}", out, in));
    } else {
        run(fmt::format("mutool draw -q -F pgm -r {} -o {} {} {}", dpi, out, in, page));
    }
    GreyPage result = read_pgm(image);
    fs::remove(image);
    return result;
}

GreyPage render_black(const fs::path& pdf, int dpi, int page) {
    const fs::path image = pdf.string() + "-inks.pam";
    run(ghostscript("pamcmyk32", dpi, page) +
        fmt::format(" -o '{}' '{}'", image.string(), pdf.string()));
    GreyPage result = read_black_of_pam(image);
    fs::remove(image);
    return result;
}

}  // namespace dotpose::roundtrip
