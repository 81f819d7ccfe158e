/// Writes a file incrementally. A failed write never leaves an incomplete file under the target's
/// name. To write a whole text in one call, use write_file.hpp.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>

#include "base/byte_sink.hpp"
#include "dotpose/export.hpp"

// These declarations are exported because the tools library uses them.
DOTPOSE_BEGIN_EXPORT

namespace dotpose::base {

/// Writes to a temporary file in the target's folder. `commit` renames the temporary file to the
/// target. Without `commit`, the destructor removes the temporary file. Follows symbolic links and
/// keeps the mode of an existing target.
class OutputFile : public ByteSink {
  public:
    /// Creates the temporary file. Throws Error if this fails or if the target is not a regular
    /// file.
    explicit OutputFile(const std::filesystem::path& target);
    ~OutputFile() override;
    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;

    void write(const void* data, std::size_t size_bytes) noexcept override;
    using ByteSink::write;

    /// Sets the position of the next write, as fseeko does. Returns the new position in bytes from
    /// the start of the file.
    std::int64_t seek(std::int64_t offset, int whence) noexcept;

    void require_good() const override;

    /// Closes the temporary file and renames it to the target. Throws Error if either operation
    /// fails.
    void commit();

  private:
    void open_temporary();
    void fail() noexcept;

    std::filesystem::path target_;
    std::filesystem::path temporary_;
    std::FILE* stream_ = nullptr;
    int error_number_ = 0;
};

}  // namespace dotpose::base

DOTPOSE_END_EXPORT
