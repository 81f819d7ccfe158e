#include "files/yaml_reader.hpp"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <utility>

#include <fmt/core.h>

#include "base/system_error.hpp"
#include "dotpose/files/error.hpp"
#include "files/input_file.hpp"

namespace dotpose::files {
namespace {

constexpr std::size_t kMaxBytes = 1 << 20;

std::string text_of(const std::filesystem::path& path) {
    const auto text = files::text_of(path, kMaxBytes);
    if (!text) base::throw_system("read", path, ENOENT);
    return *text;
}

}  // namespace

YamlMap::YamlMap(const std::filesystem::path& path) : YamlMap(text_of(path), path.string()) {}

YamlMap::YamlMap(const std::string& text, std::string name) : file_(std::move(name)) {
    try {
        node_ = YAML::Load(text);
    } catch (const YAML::Exception& error) {
        throw Error(
            fmt::format("{}: not YAML: line {}: {}", file_, error.mark.line + 1, error.msg));
    }
    if (!node_.IsMap()) throw Error(fmt::format("{}: not a camera file: it has no keys", file_));
}

void YamlMap::fail(const std::string& key, const std::string& what) const {
    throw Error(fmt::format("{}: {}{} {}", file_, prefix_, key, what));
}

YAML::Node YamlMap::value(const std::string& key) const {
    const YAML::Node node = node_[key];
    if (!node) fail(key, "is missing");
    return node;
}

std::string YamlMap::text(const std::string& key) const {
    const YAML::Node node = value(key);
    if (!node.IsScalar()) fail(key, "must be a word");
    return node.Scalar();
}

double YamlMap::finite(const YAML::Node& node, const std::string& key) const {
    double number = 0;
    if (!node.IsScalar() || !YAML::convert<double>::decode(node, number)) {
        fail(key, "must be a number");
    }
    if (!std::isfinite(number)) fail(key, "must be finite");
    return number;
}

int YamlMap::integer(const std::string& key) const {
    int number = 0;
    const YAML::Node node = value(key);
    if (!node.IsScalar() || !YAML::convert<int>::decode(node, number)) {
        fail(key, "must be a whole number");
    }
    return number;
}

bool YamlMap::boolean(const std::string& key) const {
    bool is_true = false;
    const YAML::Node node = value(key);
    if (!node.IsScalar() || !YAML::convert<bool>::decode(node, is_true)) {
        fail(key, "must be true or false");
    }
    return is_true;
}

double YamlMap::number(const std::string& key) const {
    return finite(value(key), key);
}

std::vector<double> YamlMap::numbers(const std::string& key, std::size_t count) const {
    const YAML::Node node = value(key);
    if (!node.IsSequence()) fail(key, "must be a list of numbers");
    if (count > 0 && node.size() != count) {
        fail(key, fmt::format("must be a list of {} numbers", count));
    }
    std::vector<double> result;
    for (const YAML::Node& element : node)
        result.push_back(finite(element, key));
    return result;
}

std::vector<std::vector<double>> YamlMap::rows_of_numbers(const std::string& key) const {
    const YAML::Node node = value(key);
    if (!node.IsSequence()) fail(key, "must be a list of rows");
    std::vector<std::vector<double>> result;
    for (const YAML::Node& row : node) {
        if (!row.IsSequence()) fail(key, "must be a list of rows, each a list of numbers");
        std::vector<double>& numbers = result.emplace_back();
        for (const YAML::Node& element : row)
            numbers.push_back(finite(element, key));
    }
    return result;
}

YamlMap YamlMap::map(const std::string& key) const {
    const YAML::Node node = value(key);
    if (!node.IsMap()) fail(key, "must be a mapping");
    return {file_, prefix_ + key + ".", node};
}

std::vector<std::string> YamlMap::keys() const {
    std::vector<std::string> result;
    for (const auto& pair : node_)
        result.push_back(pair.first.Scalar());
    return result;
}

void YamlMap::allow_only(std::initializer_list<const char*> allowed) const {
    for (const std::string& key : keys()) {
        if (std::ranges::find(allowed, key) == allowed.end()) {
            fail(key, "is not a key of a camera file");
        }
    }
}

}  // namespace dotpose::files
