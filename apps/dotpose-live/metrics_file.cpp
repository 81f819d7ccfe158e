#include "metrics_file.hpp"

#include <utility>

#include "dotpose/files/error.hpp"
#include "dotpose/files/write_file.hpp"

namespace dotpose::cli {

MetricsFile::MetricsFile(std::string path, std::function<void(const std::string&)> notify)
    : path_(std::move(path)), notify_(std::move(notify)) {
    require_writable(path_);
}

void MetricsFile::write(const std::string& text) {
    try {
        write_file(path_, text);
        is_failing_ = false;
    } catch (const Error& error) {
        if (!std::exchange(is_failing_, true)) notify_(error.what());
    }
}

}  // namespace dotpose::cli
