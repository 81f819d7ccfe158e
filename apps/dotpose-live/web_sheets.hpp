/// Sheet management on the web page of `dotpose watch --web`. docs/web.md describes the topics and
/// commands.
///
/// A separate thread reads and changes the sheet file and creates PDFs. These tasks may take
/// seconds, because another program may have locked the file, or a printed page may be large.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "reading.hpp"
#include "serve/server.hpp"
#include "sheet_edits.hpp"
#include "sheet_messages.hpp"
#include "stitch_job.hpp"

namespace dotpose::cli {

struct WebSheetsOptions {
    std::string path;       ///< path of the sheet file
    bool may_edit = false;  ///< true if web pages may change the sheet file and print sheets
    std::optional<Camera> camera;
};

/// Sheet topics. They exist even without a sheet file, because web pages always subscribe to them.
struct SheetTopics {
    /// Adds the topics to the server. Must be called before the server is started.
    explicit SheetTopics(serve::Server& server);

    serve::Topic& sheets;
    serve::Topic& answers;
    serve::Topic& stitch;
};

class WebSheets {
  public:
    /// Reads the sheet file. `server` must outlive this object. Throws Error if the file cannot be
    /// read.
    WebSheets(WebSheetsOptions options, serve::Server& server, const SheetTopics& topics);
    /// Aborts running tasks. If a change to the sheet file has already begun, completes the change
    /// first.
    ~WebSheets();
    WebSheets(const WebSheets&) = delete;
    WebSheets& operator=(const WebSheets&) = delete;

    /// Publishes the sheets. Must be called after the server has been started.
    void start();

    /// Uses this camera in later measurements.
    void set_camera(const Camera& camera);

    /// Executes a command from a web page. Returns false if the command is not about sheets.
    bool obey(const serve::Command& command);

    /// Offers a frame to a running measurement. `image` is the image that was located.
    void take(const Reading& reading, ImageView image);

    /// Returns the sheets if a web page or another program has changed them since the previous
    /// call, and nullopt otherwise.
    std::optional<std::vector<SheetEntry>> take_changed();

  private:
    void run();
    void refresh();
    void answer_to(const serve::Command& command);
    void perform(const serve::Command& command, SheetAnswer& answer);
    void change(const serve::Command& command, SheetAnswer& answer);
    void remove(const serve::Command& command, SheetAnswer& answer);
    void reprint(const serve::Command& command, SheetAnswer& answer);
    void print_new(const serve::Command& command, SheetAnswer& answer);
    void measure(bool is_on);
    void accept_measurement(SheetAnswer& answer);
    void offer_pdf(const SheetEntry& entry, SheetAnswer& answer);
    void answer(SheetAnswer answer);
    void publish_sheets();
    void publish_measurement(const StitchJob::Progress* progress);

    WebSheetsOptions options_;
    serve::Server& server_;
    SheetTopics topics_;

    // Used only by `thread_` after `start`.
    SheetEdits edits_;
    std::deque<std::string> pdf_paths_;         ///< paths of the downloadable PDFs
    std::int64_t taken_version_ = 0;            ///< version of the sheets in `changed_`
    std::int64_t pdfs_ = 0;                     ///< number of PDFs created so far
    std::vector<SheetEdits::Target> measured_;  ///< sheets at the start of the measurement

    std::mutex mutex_;
    std::condition_variable wake_;
    std::deque<serve::Command> waiting_;
    std::deque<SheetAnswer> answers_;
    std::optional<std::vector<SheetEntry>> changed_;
    std::shared_ptr<StitchJob> job_;
    std::atomic<bool> ends_ = false;
    std::thread thread_;  // declared last, because the thread uses the other members
};

}  // namespace dotpose::cli
