#include "serve/background_thread.hpp"

#include <csignal>

#include <sys/resource.h>
#include <unistd.h>

namespace dotpose::serve {

void run_in_background() {
    sigset_t all;
    sigfillset(&all);
    pthread_sigmask(SIG_BLOCK, &all, nullptr);
    // On Linux, `setpriority` changes the priority of a single thread.
    constexpr int kNiceness = 5;
    setpriority(PRIO_PROCESS, static_cast<id_t>(gettid()), kNiceness);
}

}  // namespace dotpose::serve
