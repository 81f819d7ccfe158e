#include "image_names.hpp"

#include <filesystem>
#include <iostream>
#include <utility>

#include "dotpose/files/error.hpp"
#include "files/input_file.hpp"

namespace dotpose::cli {

ImageNames::ImageNames(std::vector<std::string> images, const std::string& list)
    : known_(std::move(images)), list_name_(list) {
    if (list.empty()) return;
    if (list == "-") {
        list_ = &std::cin;
        return;
    }
    file_.open(list);
    if (!file_) throw Error("cannot read the list " + list);
    list_ = &file_;
    if (!std::filesystem::is_regular_file(list)) return;
    while (const auto name = next_of_list())
        known_.push_back(*name);
}

std::optional<std::string> ImageNames::next() {
    return next_known_ < known_.size() ? known_[next_known_++] : next_of_list();
}

std::optional<std::string> ImageNames::next_of_list() {
    std::string line;
    try {
        while (list_ != nullptr && files::next_line(*list_, line)) {
            if (!line.empty()) return line;
        }
    } catch (const Error& error) {
        throw Error("the list " + list_name_ + ": " + error.what());
    }
    return std::nullopt;
}

}  // namespace dotpose::cli
