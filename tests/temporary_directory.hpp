/// A temporary directory. The destructor removes it.
#pragma once

#include <filesystem>

#include "system/files.hpp"

namespace dotpose::test {

class TemporaryDirectory {
  public:
    TemporaryDirectory() : path_(system::create_temporary_folder()) {}
    ~TemporaryDirectory() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    TemporaryDirectory(const TemporaryDirectory&) = delete;
    TemporaryDirectory& operator=(const TemporaryDirectory&) = delete;

    const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
};

}  // namespace dotpose::test
