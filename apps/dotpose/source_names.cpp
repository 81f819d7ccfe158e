#include "source_names.hpp"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <utility>

#include "dotpose/files/error.hpp"
#include "files/input_file.hpp"
#include "system/path.hpp"

namespace dotpose::cli {

SourceNames::SourceNames(std::vector<std::string> names, const std::string& list)
    : known_(std::move(names)), list_name_(list) {
    if (list.empty()) return;
    is_pipe_ = list == "-" || !std::filesystem::is_regular_file(system::path_of(list));
    if (list == "-") {
        list_ = &std::cin;
        return;
    }
    file_.open(system::path_of(list));
    if (!file_) throw Error("cannot read the list " + list + ": " + std::strerror(errno));
    list_ = &file_;
    if (is_pipe_) return;
    while (const auto name = next_of_list())
        known_.push_back(*name);
}

std::optional<std::string> SourceNames::next() {
    return next_known_ < known_.size() ? known_[next_known_++] : next_of_list();
}

std::optional<std::string> SourceNames::next_of_list() {
    std::string line;
    try {
        while (list_ != nullptr && files::next_line(*list_, line)) {
            if (!line.empty()) return line;
        }
    } catch (const Error& error) {
        list_ = nullptr;
        throw Error("the list " + list_name_ + ": " + error.what());
    }
    return std::nullopt;
}

}  // namespace dotpose::cli
