/// Writes files so that they appear complete or not at all.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>

#include "base/byte_sink.hpp"

// Visible outside of the library because the tools library calls them too.
#pragma GCC visibility push(default)

namespace dotpose::base {

/// Follows symbolic links and returns the path of their target, which need not exist.
std::filesystem::path without_links(std::filesystem::path path);

/// Writes to a temporary file beside the target; `commit` renames it, the destructor of an
/// uncommitted file removes it. Symbolic links are followed, and an existing file keeps its mode.
class OutputFile : public ByteSink {
  public:
    /// Throws Error if the target is not a regular file or the temporary file cannot be created.
    explicit OutputFile(const std::filesystem::path& target);
    ~OutputFile() override;
    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;

    void write(const void* data, std::size_t size_bytes) noexcept override;
    using ByteSink::write;

    /// Moves the position of the next write, like fseeko; returns the new position in bytes from
    /// the start of the file.
    std::int64_t seek(std::int64_t offset, int whence) noexcept;

    void require_good() const override;

    /// Closes the temporary file and renames it to the target. Throws Error.
    void commit();

  private:
    void open_temporary();
    void fail() noexcept;

    std::filesystem::path target_;
    std::filesystem::path temporary_;
    std::FILE* stream_ = nullptr;
    int error_number_ = 0;
};

/// Throws Error, as OutputFile does, if the file could not be created. Call it before a long
/// computation whose result goes into the file.
void require_writable(const std::filesystem::path& target);

}  // namespace dotpose::base

#pragma GCC visibility pop
