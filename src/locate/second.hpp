// Second: the second attempt. Removes noise and uneven light from the image, fits the grid to all
// dots, and reads the bits in each grid cell.
#pragma once

#include "dotpose/device_options.hpp"
#include "dotpose/image.hpp"
#include "locate/workspace.hpp"

namespace dotpose::core {

/// Runs second attempts on one image in several codes. The filtered image, its dots and its grid do
/// not depend on the code. They are computed once, and computed again only after an attempt has
/// overwritten them.
class SecondAttempt {
  public:
    enum class Resampling : std::uint8_t { never, if_doubtful };

    SecondAttempt(const ImageView& image, DesktopWorkspace& w) : image_(image), w_(w) {}

    /// Locates the image in the code of the options. Returns true if there is a fix. Stores the fix
    /// in the workspace or, if there is none, the status. With `Resampling::if_doubtful`, a
    /// position that is not certain is read again with a grid that is fitted to its dots.
    bool read(const DeviceOptions& options, Resampling resampling);

  private:
    const ImageView& image_;
    DesktopWorkspace& w_;
    bool is_seen_ = false;  ///< true if the workspace contains dots and cells of the filtered image
    Fix seen_;              ///< copy of the fix, made after the bits were read and before they were
                            ///< decoded
};

}  // namespace dotpose::core
