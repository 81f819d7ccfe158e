#include "video/module.hpp"

#include <filesystem>
#include <string>

#include <dlfcn.h>

#include "dotpose/files/error.hpp"

namespace dotpose::video {
namespace {

const Module& load() {
    std::error_code failed;
    const auto program = std::filesystem::read_symlink("/proc/self/exe", failed);
    const std::string path = (program.parent_path() / "dotpose-video.so").string();
    void* library = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
    const void* found = library != nullptr ? dlsym(library, "dotpose_video_module") : nullptr;
    if (found == nullptr) {
        throw Error(
            std::string(
                "cameras, videos and windows need dotpose-video.so, which cannot be loaded: ") +
            dlerror());
    }
    return *static_cast<const Module*>(found);
}

}  // namespace

const Module& module() {
    static const Module& loaded = load();
    return loaded;
}

}  // namespace dotpose::video
