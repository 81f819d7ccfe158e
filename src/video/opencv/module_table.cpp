#include "video/opencv/offers.hpp"

namespace dotpose::video {

extern "C" [[gnu::visibility("default")]] const Module dotpose_video_module;
const Module dotpose_video_module = {open_camera, open_video, create_video, open_screen};

}  // namespace dotpose::video
