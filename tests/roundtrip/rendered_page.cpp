#include "rendered_page.hpp"

#include <array>
#include <cstdio>
#include <fstream>
#include <stdexcept>

#include <fmt/format.h>
#include <sys/wait.h>

namespace dotpose::roundtrip {
namespace fs = std::filesystem;
namespace {

/// Binary PGM with 8 bits, as all three renderers write it; '#' begins a comment.
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
    page.grey.resize(static_cast<std::size_t>(page.width_px) *
                     static_cast<std::size_t>(page.height_px));
    file.read(reinterpret_cast<char*>(page.grey.data()),
              static_cast<std::streamsize>(page.grey.size()));
    if (!file) throw std::runtime_error("PGM too short: " + path.string());
    return page;
}

}  // namespace

std::string run(const std::string& command) {
    std::FILE* pipe = popen((command + " 2>&1").c_str(), "r");
    if (pipe == nullptr) throw std::runtime_error("cannot run " + command);
    std::string output;
    std::array<char, 4096> buffer;
    while (const std::size_t size = std::fread(buffer.data(), 1, buffer.size(), pipe))
        output.append(buffer.data(), size);
    const int status = pclose(pipe);
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) {
        throw std::runtime_error(command + "\n" + output);
    }
    return output;
}

GreyPage render(const std::string& renderer, const fs::path& pdf, int dpi, int page) {
    const fs::path image = fmt::format("{}-{}.pgm", pdf.string(), renderer);
    const std::string in = fmt::format("'{}'", pdf.string());
    const std::string out = fmt::format("'{}'", image.string());
    if (renderer == "pdftoppm") {
        run(fmt::format("pdftoppm -cropbox -gray -r {} -f {} -singlefile {} > {}", dpi, page, in,
                        out));
    } else if (renderer == "gs") {
        run(fmt::format(
            "gs -q -dNOPAUSE -dBATCH -dSAFER -dUseCropBox -sDEVICE=pgmraw -dTextAlphaBits=4 "
            "-dGraphicsAlphaBits=4 -r{0} -dFirstPage={1} -dLastPage={1} "
            "-sOutputFile={2} {3}",
            dpi, page, out, in));
    } else {
        run(fmt::format("mutool draw -q -F pgm -r {} -o {} {} {}", dpi, out, in, page));
    }
    GreyPage result = read_pgm(image);
    fs::remove(image);
    return result;
}

}  // namespace dotpose::roundtrip
