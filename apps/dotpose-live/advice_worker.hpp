/// Determines why a frame was refused. The analysis can take up to a second, so it runs in a
/// separate thread.
#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "dotpose/memory.hpp"
#include "dotpose/tools/grey_image.hpp"
#include "locate_record.hpp"
#include "picture_advice.hpp"

namespace dotpose::cli {

class AdviceWorker {
  public:
    /// A refused frame.
    struct Job {
        GreyImage image;
        PictureFacts facts;
        Record record;
    };

    /// The worker thread calls `take` after each analysis. The argument is the reason why the frame
    /// was refused (see `reason` in locate_record.hpp), including advice for the user.
    explicit AdviceWorker(std::function<void(const std::string&)> take);
    /// Waits until the running analysis has finished.
    ~AdviceWorker();
    AdviceWorker(const AdviceWorker&) = delete;
    AdviceWorker& operator=(const AdviceWorker&) = delete;

    /// Queues a refused frame for analysis. The queue holds one frame. A new frame replaces a frame
    /// that is still waiting.
    void ask(Job job);

  private:
    void run();

    std::function<void(const std::string&)> take_;
    std::mutex mutex_;
    std::condition_variable changed_;
    std::optional<Job> waiting_;
    bool stops_ = false;
    std::thread thread_;
};

}  // namespace dotpose::cli
