// A fake camera for machines that have no camera. It is loaded with LD_PRELOAD, and intercepts
// OpenCV's system calls on /dev/video0. It repeats the raw grey frames in the file named by the
// environment variable FAKE_CAMERA. FAKE_CAMERA_SIZE is the size of the frames, such as 640x480.
// While the file does not exist, the camera behaves as if unplugged. The requested settings and the
// frame times in µs are written to the file named by FAKE_CAMERA_LOG. The camera also offers
// 640x480 at 15 frames/s.
#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <fstream>
#include <string>
#include <vector>

#include <dlfcn.h>
#include <linux/videodev2.h>
#include <sys/mman.h>
#include <sys/types.h>
#include <unistd.h>

namespace {

constexpr int kBuffers = 4;

struct FakeCamera {
    int descriptor = -1;  ///< in-memory file that represents the device and contains the buffers
    int width_px = 0;
    int height_px = 0;
    double fps = 30;
    bool waits[kBuffers] = {};  ///< true for queued buffers, which wait for a frame
    std::vector<char> frames;
    unsigned sequence = 0;
    double next_s = 0;

    std::size_t frame_size() const { return static_cast<std::size_t>(width_px * height_px); }
    /// Returns the size of a YUYV frame, rounded up to whole pages of memory.
    std::size_t buffer_size() const { return (2 * frame_size() + 4095) / 4096 * 4096; }
};
FakeCamera camera;

double now_s() {
    timespec now{};
    clock_gettime(CLOCK_MONOTONIC, &now);
    return static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec) * 1e-9;
}

bool is_plugged_in() {
    return access(std::getenv("FAKE_CAMERA"), F_OK) == 0;
}

void note(const char* what, long long value) {
    std::ofstream(std::getenv("FAKE_CAMERA_LOG"), std::ios::app) << what << ' ' << value << '\n';
}

int failed(int why) {
    errno = why;
    return -1;
}

int open_camera() {
    if (!is_plugged_in()) return failed(ENOENT);
    std::ifstream file(std::getenv("FAKE_CAMERA"), std::ios::binary);
    camera.frames.assign(std::istreambuf_iterator<char>(file), {});
    std::sscanf(std::getenv("FAKE_CAMERA_SIZE"), "%dx%d", &camera.width_px, &camera.height_px);
    camera.descriptor = memfd_create("camera", 0);
    if (ftruncate(camera.descriptor, static_cast<off_t>(kBuffers * camera.buffer_size())) != 0) {
        return -1;
    }
    camera.next_s = now_s();
    return camera.descriptor;
}

void tell_format(v4l2_format& format) {
    v4l2_pix_format& pixels = format.fmt.pix;
    pixels.width = static_cast<unsigned>(camera.width_px);
    pixels.height = static_cast<unsigned>(camera.height_px);
    pixels.pixelformat = V4L2_PIX_FMT_YUYV;
    pixels.field = V4L2_FIELD_NONE;
    pixels.bytesperline = 2 * pixels.width;
    pixels.sizeimage = pixels.bytesperline * pixels.height;
}

/// Waits until the next frame is due, and writes it to a queued buffer. If the call is more than
/// one period late, all following frames are delayed.
int give_frame(v4l2_buffer& buffer) {
    while (now_s() < camera.next_s)
        usleep(500);
    if (!is_plugged_in()) return failed(ENODEV);
    unsigned index = 0;
    while (index < kBuffers && !camera.waits[index])
        ++index;
    if (index == kBuffers) return failed(EAGAIN);
    camera.waits[index] = false;
    const std::size_t size = camera.frame_size();
    const char* frame = camera.frames.data() + camera.sequence * size % camera.frames.size();
    std::vector<char> picture(camera.buffer_size(), '\x80');
    for (std::size_t i = 0; i < size; ++i)
        picture[2 * i] = frame[i];
    const auto at = static_cast<off_t>(index * picture.size());
    if (pwrite(camera.descriptor, picture.data(), picture.size(), at) < 0) return -1;
    buffer.index = index;
    buffer.length = static_cast<unsigned>(camera.buffer_size());
    buffer.bytesused = static_cast<unsigned>(2 * size);
    buffer.sequence = camera.sequence++;
    buffer.flags = V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC;
    const auto time_us = static_cast<long long>(camera.next_s * 1e6);
    note("time", time_us);
    buffer.timestamp = {time_us / 1'000'000, time_us % 1'000'000};
    camera.next_s = std::max(camera.next_s + 1 / camera.fps, now_s());
    return 0;
}

/// Returns the supported frame size with this index, or 0 x 0 if there is none.
v4l2_frmsize_discrete size_at(unsigned index) {
    if (index == 0) {
        return {static_cast<unsigned>(camera.width_px), static_cast<unsigned>(camera.height_px)};
    }
    return index == 1 ? v4l2_frmsize_discrete{640, 480} : v4l2_frmsize_discrete{};
}

int tell_entry(unsigned long request, void* argument) {
    if (request == VIDIOC_ENUM_FMT) {
        auto& format = *static_cast<v4l2_fmtdesc*>(argument);
        format.pixelformat = V4L2_PIX_FMT_YUYV;
        return format.index == 0 ? 0 : failed(EINVAL);
    }
    if (request == VIDIOC_ENUM_FRAMESIZES) {
        auto& size = *static_cast<v4l2_frmsizeenum*>(argument);
        size.type = V4L2_FRMSIZE_TYPE_DISCRETE;
        size.discrete = size_at(size.index);
        return size.discrete.width > 0 ? 0 : failed(EINVAL);
    }
    auto& interval = *static_cast<v4l2_frmivalenum*>(argument);
    interval.type = V4L2_FRMIVAL_TYPE_DISCRETE;
    interval.discrete = {1, interval.index == 0 ? 15U : 30U};
    const unsigned most = interval.width == 640 ? 1 : 2;
    return interval.index < most ? 0 : failed(EINVAL);
}

int set_rate(v4l2_streamparm& rate) {
    v4l2_fract& interval = rate.parm.capture.timeperframe;
    if (interval.numerator > 0) camera.fps = interval.denominator * 1.0 / interval.numerator;
    note("fps", std::llround(camera.fps));
    return 0;
}

int get_rate(v4l2_streamparm& rate) {
    rate.parm.capture.timeperframe = {1, static_cast<unsigned>(camera.fps)};
    return 0;
}

int set_control(const v4l2_control& control) {
    switch (control.id) {
        case V4L2_CID_EXPOSURE_AUTO:
            note("exposure_auto", control.value);
            return 0;
        case V4L2_CID_EXPOSURE_ABSOLUTE:
            note("exposure", control.value);
            return 0;
        case V4L2_CID_GAIN:
            note("gain", control.value);
            return 0;
        default:
            return failed(EINVAL);
    }
}

int answer(unsigned long request, void* argument) {
    const auto index = [](const v4l2_buffer& buffer) { return buffer.index; };
    switch (request) {
        case VIDIOC_QUERYCAP: {
            auto& what = *static_cast<v4l2_capability*>(argument);
            what = {};
            std::strcpy(reinterpret_cast<char*>(what.card), "fake");
            what.capabilities = V4L2_CAP_VIDEO_CAPTURE | V4L2_CAP_STREAMING;
            return 0;
        }
        case VIDIOC_S_FMT:
        case VIDIOC_TRY_FMT: {
            const auto& wanted = static_cast<v4l2_format*>(argument)->fmt.pix;
            if (request == VIDIOC_S_FMT) note("width", wanted.width);
            [[fallthrough]];
        }
        case VIDIOC_G_FMT:
            tell_format(*static_cast<v4l2_format*>(argument));
            return 0;
        case VIDIOC_ENUM_FMT:
        case VIDIOC_ENUM_FRAMESIZES:
        case VIDIOC_ENUM_FRAMEINTERVALS:
            return tell_entry(request, argument);
        case VIDIOC_S_PARM:
            return set_rate(*static_cast<v4l2_streamparm*>(argument));
        case VIDIOC_G_PARM:
            return get_rate(*static_cast<v4l2_streamparm*>(argument));
        case VIDIOC_QUERYCTRL:
            return 0;
        case VIDIOC_S_CTRL:
            return set_control(*static_cast<v4l2_control*>(argument));
        case VIDIOC_REQBUFS:
            static_cast<v4l2_requestbuffers*>(argument)->count = kBuffers;
            return 0;
        case VIDIOC_QUERYBUF: {
            auto& buffer = *static_cast<v4l2_buffer*>(argument);
            buffer.length = static_cast<unsigned>(camera.buffer_size());
            buffer.m.offset = index(buffer) * buffer.length;
            return 0;
        }
        case VIDIOC_QBUF:
            camera.waits[index(*static_cast<v4l2_buffer*>(argument))] = true;
            return 0;
        case VIDIOC_DQBUF:
            return give_frame(*static_cast<v4l2_buffer*>(argument));
        case VIDIOC_STREAMON:
        case VIDIOC_STREAMOFF:
            return 0;
        default:
            return failed(EINVAL);
    }
}

}  // namespace

extern "C" int open(const char* path, int flags, ...) {
    if (std::strcmp(path, "/dev/video0") == 0) return open_camera();
    va_list rest;
    va_start(rest, flags);
    const mode_t mode = va_arg(rest, mode_t);
    va_end(rest);
    using Open = int (*)(const char*, int, ...);
    static const auto real = reinterpret_cast<Open>(dlsym(RTLD_NEXT, "open"));
    return real(path, flags, mode);
}

extern "C" int ioctl(int descriptor, unsigned long request, ...) noexcept {
    va_list rest;
    va_start(rest, request);
    void* argument = va_arg(rest, void*);
    va_end(rest);
    if (descriptor == camera.descriptor) return answer(request, argument);
    using Ioctl = int (*)(int, unsigned long, ...);
    static const auto real = reinterpret_cast<Ioctl>(dlsym(RTLD_NEXT, "ioctl"));
    return real(descriptor, request, argument);
}
