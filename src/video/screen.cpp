#include "video/screen.hpp"

#include <dlfcn.h>

#include "video/module.hpp"

namespace dotpose::video {

Screen::Screen(const ScreenOptions& options) {
    if (options.has_window || !options.record.empty()) output_ = module().open_screen(options);
}

bool Screen::is_on() const {
    return output_ != nullptr;
}

bool Screen::show(const Scene& scene) {
    return output_ == nullptr || output_->show(scene);
}

void Screen::finish() {
    if (output_) output_->finish();
}

bool Screen::is_wanted() {
    return output_ == nullptr || output_->is_wanted();
}

bool has_display() {
    // Qt ends the program if it cannot connect to the X server, so the connection is tested before
    // Qt opens the window. The X library is loaded at run time instead of being linked, because
    // dotpose needs it only with Qt.
    void* library = dlopen("libX11.so.6", RTLD_LAZY);
    if (library == nullptr) return false;
    const auto connect = reinterpret_cast<void* (*)(const char*)>(dlsym(library, "XOpenDisplay"));
    const auto leave = reinterpret_cast<int (*)(void*)>(dlsym(library, "XCloseDisplay"));
    void* display = connect != nullptr && leave != nullptr ? connect(nullptr) : nullptr;
    if (display != nullptr) leave(display);
    return display != nullptr;
}

}  // namespace dotpose::video
