#include "lines.hpp"

#include "dotpose/error.hpp"

namespace dotpose::cli {

Lines::Lines(const std::string& path) : path_(path) {
    if (path.empty()) return;
    file_.reset(std::fopen(path.c_str(), "w"));
    if (!file_) throw Error("cannot create " + path);
}

void Lines::write(const std::string& line) {
    std::FILE* stream = file_ ? file_.get() : stdout;
    const bool written = std::fwrite(line.data(), 1, line.size(), stream) == line.size();
    if (!written || std::fflush(stream) != 0) {
        throw Error("cannot write " + (path_.empty() ? "to standard output" : path_));
    }
}

}  // namespace dotpose::cli
