/// Fixed-size memory for a Locator or DeviceLocator. The locator reuses the memory for each frame.
/// The caller owns the memory, unless a Locator allocates it. The memory may be static, on the
/// heap, or on a sufficiently large stack. The contents are private to the core.
#pragma once

#include <array>
#include <cstddef>

#include "dotpose/export.hpp"
#include "dotpose/language.hpp"

DOTPOSE_BEGIN_EXPORT

namespace dotpose {

namespace core {
struct DeviceWorkspace;
struct DesktopWorkspace;
}  // namespace core

/// Base class of all DeviceMemoryFor classes. It does not depend on the frame size.
class AnyDeviceMemory {
  public:
    AnyDeviceMemory(const AnyDeviceMemory&) = delete;
    AnyDeviceMemory& operator=(const AnyDeviceMemory&) = delete;

  protected:
    AnyDeviceMemory() = default;
    ~AnyDeviceMemory() = default;

    /// Returns the size of a workspace in bytes, or 0 if frames of this size are not supported.
    static constexpr std::size_t bytes_for(int width_px, int height_px) {
        const bool has_32_bits = sizeof(void*) == 4;
        if (width_px == 36 && height_px == 36) return has_32_bits ? 4'632 : 4'848;
        if (width_px == 160 && height_px == 120) return has_32_bits ? 10'640 : 11'808;
        if (width_px == 188 && height_px == 120) return has_32_bits ? 12'608 : 13'312;
        if (width_px == 320 && height_px == 240) return has_32_bits ? 23'104 : 25'040;
        return 0;
    }

    core::DeviceWorkspace* workspace_ = nullptr;

  private:
    friend class DeviceLocator;
};

/// Memory for a DeviceLocator that processes frames of up to Width x Height px. The end of this
/// header lists the supported sizes. The memory for 36 x 36 px is intended for the sensors of
/// optical mice, whose frames can be located only on known sheets (DeviceLocator::set_known).
/// Memory for a width of 160 or 188 px also supports frames with more rows than Height.
template <int Width, int Height>
class DeviceMemoryFor : public AnyDeviceMemory {
  public:
    DeviceMemoryFor();

  private:
    static constexpr std::size_t kBytes = bytes_for(Width, Height);
    static_assert(kBytes > 0,
                  "the supported sizes are 36 x 36, 160 x 120, 188 x 120 and 320 x 240 px");
    alignas(8) std::array<std::byte, kBytes> bytes_;
};

/// Memory for a Locator that processes images up to 188 px wide, the width of the sensor in the
/// paper. The size is about 330 KB.
class SmallMemory {
  public:
    SmallMemory();
    SmallMemory(const SmallMemory&) = delete;
    SmallMemory& operator=(const SmallMemory&) = delete;

  private:
    friend class Locator;
    static constexpr std::size_t kBytes = 320 * 1024;
    core::DesktopWorkspace* workspace_;
    alignas(64) std::array<std::byte, kBytes> bytes_;
};

/// Memory for a Locator that processes images of up to 4096 x 4096 px. The size is about 4.4 MB.
class LargeMemory {
  public:
    LargeMemory();
    LargeMemory(const LargeMemory&) = delete;
    LargeMemory& operator=(const LargeMemory&) = delete;

  private:
    friend class Locator;
    static constexpr std::size_t kBytes = 4280 * 1024;
    core::DesktopWorkspace* workspace_;
    alignas(64) std::array<std::byte, kBytes> bytes_;
};

extern template class DeviceMemoryFor<36, 36>;    ///< size: 4.5 KB with 32-bit pointers
extern template class DeviceMemoryFor<160, 120>;  ///< size: 11 KB with 32-bit pointers
extern template class DeviceMemoryFor<188, 120>;  ///< size: 13 KB with 32-bit pointers
extern template class DeviceMemoryFor<320, 240>;  ///< size: 23 KB with 32-bit pointers
/// Memory for frames of 188 x 120 px, the size of the sensor in the paper.
using DeviceMemory = DeviceMemoryFor<188, 120>;

}  // namespace dotpose

DOTPOSE_END_EXPORT
