/// A destination for the bytes of a file, on any medium.
#pragma once

#include <cstddef>
#include <string_view>

// Visible outside of the library because the tools library derives from it too.
#pragma GCC visibility push(default)

namespace dotpose::base {

class ByteSink {
  public:
    virtual ~ByteSink() = default;

    /// Appends. Never throws, because C libraries call it. The first failure is stored for
    /// `require_good`, and later bytes are dropped.
    virtual void write(const void* data, std::size_t size_bytes) noexcept = 0;
    void write(std::string_view text) noexcept { write(text.data(), text.size()); }

    /// Throws Error with the system's reason if a write failed, for example a full disk.
    virtual void require_good() const {}
};

}  // namespace dotpose::base

#pragma GCC visibility pop
