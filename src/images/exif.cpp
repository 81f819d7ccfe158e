#include <algorithm>
#include <memory>
#include <new>
#include <vector>

#include <libexif/exif-data.h>

#include "images/image_format.hpp"

namespace dotpose::images {

bool is_of_camera(Bytes exif) {
    constexpr std::size_t kMaxBytes = 65'535;  // maximum size that libexif reads
    std::vector<std::uint8_t> segment{'E', 'x', 'i', 'f', 0, 0};
    if (!exif.empty() && exif.front() == segment.front()) segment.clear();
    const Bytes read = exif.first(std::min(exif.size(), kMaxBytes));
    segment.insert(segment.end(), read.begin(), read.end());
    const std::unique_ptr<ExifData, decltype(&exif_data_unref)> data(exif_data_new(),
                                                                     exif_data_unref);
    if (!data) throw std::bad_alloc();
    // Without this call, libexif would add and remove entries to follow the specification.
    exif_data_unset_option(data.get(), EXIF_DATA_OPTION_FOLLOW_SPECIFICATION);
    exif_data_load_data(data.get(), segment.data(), static_cast<unsigned>(segment.size()));
    return std::ranges::any_of(kCameraTags, [&](std::uint16_t tag) {
        return exif_content_get_entry(data->ifd[EXIF_IFD_EXIF], static_cast<ExifTag>(tag)) !=
               nullptr;
    });
}

}  // namespace dotpose::images
