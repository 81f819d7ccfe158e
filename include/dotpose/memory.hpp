/// Memory of a Locator: of fixed size, given by the caller, for any number of frames one after the
/// other. It may be static, on the heap or, if there is room, on the stack. Its content is private
/// to the core.
#pragma once

#include <array>
#include <cstddef>

#include "dotpose/language.hpp"

#pragma GCC visibility push(default)

namespace dotpose {

namespace core {
struct Workspace;
}

/// Memory of a DeviceLocator on a small microcontroller with a 188 x 120 px sensor: about 12 KB.
class DeviceMemory {
  public:
    DeviceMemory();
    DeviceMemory(const DeviceMemory&) = delete;
    DeviceMemory& operator=(const DeviceMemory&) = delete;

  private:
    friend class DeviceLocator;
    static constexpr std::size_t kBytes = sizeof(void*) == 4 ? 12'608 : 13'312;
    core::Workspace* workspace_;
    alignas(8) std::array<std::byte, kBytes> bytes_;
};

/// Memory of a Locator for images up to 188 px wide, as those of the paper's sensor: about 250 KB.
class SmallMemory {
  public:
    SmallMemory();
    SmallMemory(const SmallMemory&) = delete;
    SmallMemory& operator=(const SmallMemory&) = delete;

  private:
    friend class Locator;
    static constexpr std::size_t kBytes = 248 * 1024;
    core::Workspace* workspace_;
    alignas(64) std::array<std::byte, kBytes> bytes_;
};

/// Memory of a Locator for images up to 4096 x 4096 px: about 1.7 MB.
class LargeMemory {
  public:
    LargeMemory();
    LargeMemory(const LargeMemory&) = delete;
    LargeMemory& operator=(const LargeMemory&) = delete;

  private:
    friend class Locator;
    static constexpr std::size_t kBytes = 1720 * 1024;
    core::Workspace* workspace_;
    alignas(64) std::array<std::byte, kBytes> bytes_;
};

}  // namespace dotpose

#pragma GCC visibility pop
