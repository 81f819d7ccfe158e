/// Interface for writing the bytes of a file, for example to disk or to memory.
#pragma once

#include <cstddef>
#include <string_view>

#include "dotpose/export.hpp"

// This class is exported because the tools library derives from it.
DOTPOSE_BEGIN_EXPORT

namespace dotpose::base {

class ByteSink {
  public:
    virtual ~ByteSink() = default;

    /// Appends bytes. Never throws, because C libraries call this function. After a failed write,
    /// all further bytes are ignored and `require_good` reports the first failure.
    virtual void write(const void* data, std::size_t size_bytes) noexcept = 0;
    void write(std::string_view text) noexcept { write(text.data(), text.size()); }

    /// Throws Error with the system's error message if a write failed, for example because the disk
    /// is full.
    virtual void require_good() const {}
};

}  // namespace dotpose::base

DOTPOSE_END_EXPORT
