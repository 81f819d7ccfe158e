// Reads values from a YAML file. Error messages contain the file name and the key.
#pragma once

#include <filesystem>
#include <initializer_list>
#include <string>
#include <vector>

#include <yaml-cpp/yaml.h>

namespace dotpose::files {

/// One mapping of a YAML file. All functions that read values throw Error if the key is missing or
/// its value has the wrong type.
class YamlMap {
  public:
    /// Reads a file. Throws Error if it cannot be read, is not YAML, or is not a mapping.
    explicit YamlMap(const std::filesystem::path& path);
    /// Parses a string. Error messages contain `name` in place of the file name.
    YamlMap(const std::string& text, std::string name);

    bool has(const std::string& key) const { return static_cast<bool>(node_[key]); }
    std::string text(const std::string& key) const;
    int integer(const std::string& key) const;
    bool boolean(const std::string& key) const;
    double number(const std::string& key) const;
    /// Returns a list of exactly `count` numbers, or of any length if `count` is 0.
    std::vector<double> numbers(const std::string& key, std::size_t count) const;
    /// Returns a list of lists of numbers, each of any length.
    std::vector<std::vector<double>> rows_of_numbers(const std::string& key) const;
    YamlMap map(const std::string& key) const;
    std::vector<std::string> keys() const;

    /// Throws Error if the mapping contains a key that is not in `keys`.
    void allow_only(std::initializer_list<const char*> keys) const;
    /// Throws Error with the file name and the key, followed by `what`.
    [[noreturn]] void fail(const std::string& key, const std::string& what) const;

  private:
    YamlMap(std::string file, std::string prefix, const YAML::Node& node)
        : file_(std::move(file)), prefix_(std::move(prefix)), node_(node) {}
    YAML::Node value(const std::string& key) const;
    double finite(const YAML::Node& node, const std::string& key) const;

    std::string file_;
    std::string prefix_;  ///< prefix of the keys in messages
    YAML::Node node_;
};

}  // namespace dotpose::files
