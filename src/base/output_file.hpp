/// Writes a file piece by piece. The file appears completely or not at all. write_file.hpp is for
/// texts.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>

#include "base/byte_sink.hpp"
#include "dotpose/export.hpp"

// Exported, because the tools library uses these declarations.
DOTPOSE_BEGIN_EXPORT

namespace dotpose::base {

/// Writes to a temporary file beside the target. `commit` renames it to the target. The destructor
/// removes an uncommitted file. Symbolic links are followed, and an existing target keeps its mode.
class OutputFile : public ByteSink {
  public:
    /// Throws Error if the target is not a regular file or the temporary file cannot be created.
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

    /// Closes the temporary file and renames it to the target. Throws Error if either fails.
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
