#include "video/camera_list.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <functional>

#include <fcntl.h>
#include <fmt/core.h>
#include <linux/videodev2.h>
#include <sys/ioctl.h>
#include <unistd.h>

namespace dotpose::video {
namespace {

constexpr int kMaxDevices = 64;
/// Maximum number of entries read from each list that a driver returns. The limit is needed because
/// a faulty driver might return entries endlessly.
constexpr std::uint32_t kMaxEntries = 256;

class Device {
  public:
    explicit Device(const std::string& path)
        : descriptor_(open(path.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC)) {}
    ~Device() {
        if (is_open()) close(descriptor_);
    }
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;

    bool is_open() const { return descriptor_ >= 0; }

    /// Sends a request to the driver. Returns false if the request fails.
    template <typename Question>
    bool ask(unsigned long request, Question& question) const {
        int result = -1;
        do {
            result = ioctl(descriptor_, request, &question);
        } while (result < 0 && errno == EINTR);
        return result == 0;
    }

  private:
    int descriptor_;
};

/// Calls `use` for each entry that the driver reports, up to kMaxEntries.
template <typename Entry>
void for_each_entry(const Device& device, unsigned long request, Entry entry,
                    const std::function<void(const Entry&)>& use) {
    for (std::uint32_t index = 0; index < kMaxEntries; ++index) {
        entry.index = index;
        if (!device.ask(request, entry)) return;
        use(entry);
    }
}

/// Converts a character array from a driver to a string. The terminating zero may be missing.
template <std::size_t size>
std::string text_of(const std::uint8_t (&bytes)[size]) {
    const char* text = reinterpret_cast<const char*>(bytes);
    return {text, strnlen(text, size)};
}

std::string name_of_format(std::uint32_t code) {
    std::string name;
    for (int shift = 0; shift < 32; shift += 8)
        name += static_cast<char>(code >> shift & 0x7f);
    name.erase(name.find_last_not_of(' ') + 1);
    return name;
}

double rate_of(const v4l2_fract& interval) {
    return interval.numerator > 0 ? 1.0 * interval.denominator / interval.numerator : 0;
}

std::vector<double> rates_at(const Device& device, std::uint32_t format, std::uint32_t width,
                             std::uint32_t height) {
    std::vector<double> rates;
    v4l2_frmivalenum asked{};
    asked.pixel_format = format;
    asked.width = width;
    asked.height = height;
    for_each_entry<v4l2_frmivalenum>(
        device, VIDIOC_ENUM_FRAMEINTERVALS, asked, [&rates](const v4l2_frmivalenum& found) {
            const bool is_one = found.type == V4L2_FRMIVAL_TYPE_DISCRETE;
            // If the driver reports a range of frame intervals, only the rate for the shortest
            // interval is added.
            rates.push_back(rate_of(is_one ? found.discrete : found.stepwise.min));
        });
    return rates;
}

void add(std::vector<CameraSize>& sizes, const std::string& size, const std::string& format,
         const std::vector<double>& rates) {
    auto known = std::ranges::find(sizes, size, &CameraSize::size);
    if (known == sizes.end()) known = sizes.insert(sizes.end(), {size, {}, {}});
    known->formats.push_back(format);
    for (const double rate : rates) {
        if (std::ranges::find(known->rates, rate) == known->rates.end()) {
            known->rates.push_back(rate);
        }
    }
    std::ranges::sort(known->rates, std::greater());
}

std::vector<CameraSize> sizes_of(const Device& device) {
    std::vector<CameraSize> sizes;
    v4l2_fmtdesc formats{};
    formats.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
    for_each_entry<v4l2_fmtdesc>(device, VIDIOC_ENUM_FMT, formats, [&](const v4l2_fmtdesc& format) {
        v4l2_frmsizeenum asked{};
        asked.pixel_format = format.pixelformat;
        const std::string name = name_of_format(format.pixelformat);
        for_each_entry<v4l2_frmsizeenum>(
            device, VIDIOC_ENUM_FRAMESIZES, asked, [&](const v4l2_frmsizeenum& found) {
                if (found.type == V4L2_FRMSIZE_TYPE_DISCRETE) {
                    const auto& [width, height] = found.discrete;
                    add(sizes, fmt::format("{}x{}", width, height), name,
                        rates_at(device, format.pixelformat, width, height));
                } else if (found.index == 0) {
                    const v4l2_frmsize_stepwise& range = found.stepwise;
                    add(sizes,
                        fmt::format("{}x{} to {}x{}", range.min_width, range.min_height,
                                    range.max_width, range.max_height),
                        name,
                        rates_at(device, format.pixelformat, range.max_width, range.max_height));
                }
            });
    });
    return sizes;
}

/// Reads the name of the camera from sysfs. Used for devices that cannot be opened.
std::string name_in_sysfs(int number) {
    std::ifstream file(fmt::format("/sys/class/video4linux/video{}/name", number));
    std::string name;
    std::getline(file, name);
    return name;
}

bool is_camera(const v4l2_capability& device) {
    const bool tells_own = (device.capabilities & V4L2_CAP_DEVICE_CAPS) != 0;
    const std::uint32_t what = tells_own ? device.device_caps : device.capabilities;
    return (what & (V4L2_CAP_VIDEO_CAPTURE | V4L2_CAP_VIDEO_CAPTURE_MPLANE)) != 0;
}

}  // namespace

std::vector<FoundCamera> find_cameras() {
    std::vector<FoundCamera> cameras;
    for (int number = 0; number < kMaxDevices; ++number) {
        FoundCamera camera;
        camera.device = fmt::format("/dev/video{}", number);
        const Device device(camera.device);
        if (!device.is_open()) {
            if (errno == ENOENT || errno == ENODEV || errno == ENXIO) continue;
            camera.problem = std::strerror(errno);
            camera.name = name_in_sysfs(number);
            cameras.push_back(std::move(camera));
            continue;
        }
        v4l2_capability what{};
        if (!device.ask(VIDIOC_QUERYCAP, what) || !is_camera(what)) continue;
        camera.name = text_of(what.card);
        camera.sizes = sizes_of(device);
        cameras.push_back(std::move(camera));
    }
    return cameras;
}

std::string in_one_line(const std::vector<FoundCamera>& cameras) {
    std::string line;
    for (const FoundCamera& camera : cameras) {
        line += fmt::format("{}{} ({}{}{})", line.empty() ? "cameras are " : ", ", camera.device,
                            camera.name, camera.problem.empty() ? "" : ": ", camera.problem);
    }
    return line.empty() ? "no camera was found at /dev/video*" : line;
}

}  // namespace dotpose::video
