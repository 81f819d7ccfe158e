#include "web_sheets.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "dotpose/files/error.hpp"
#include "json_text.hpp"
#include "serve/background_thread.hpp"
#include "sheet_changes.hpp"
#include "sheet_pdf.hpp"
#include "sheet_print.hpp"
#include "sheet_text.hpp"
#include "terminal_text.hpp"

namespace dotpose::cli {
namespace {

/// Maximum time to wait for another program to release the lock on the sheet file.
constexpr double kMaxWait_s = 3;
constexpr std::chrono::milliseconds kRefreshPeriod(300);
constexpr std::size_t kMaxWaiting = 16;
constexpr std::size_t kMaxAnswers = 32;
constexpr std::size_t kMaxPdfs = 6;
constexpr std::size_t kMaxIdLength = 64;
constexpr const char* kReadOnly =
    "this page may only show the sheets; start dotpose watch with --web-edit-sheets to change them";

template <typename T>
const T& require(const serve::Command& command, std::string_view key) {
    const T* value = command.argument<T>(key);
    if (value == nullptr)
        throw BadArgument(fmt::format("the command {} needs a valid '{}'", command.name, key));
    return *value;
}

/// Returns the id of a command, or an empty string if it is missing or too long.
std::string id_of(const serve::Command& command) {
    const std::string* id = command.argument<std::string>("id");
    return id != nullptr && id->size() <= kMaxIdLength ? *id : std::string();
}

double require_number(const serve::Command& command, std::string_view key, double min, double max) {
    const double value = require<double>(command, key);
    if (value >= min && value <= max) return value;
    throw BadArgument(fmt::format("{} must be a number from {:g} to {:g}", key, min, max));
}

SheetEdits::Target target_of(const serve::Command& command) {
    constexpr double kMaxRevision = 1e15;
    return {require<std::string>(command, "name"),
            static_cast<std::int64_t>(require_number(command, "revision", 0, kMaxRevision))};
}

PagePose pose_of(const serve::Command& command) {
    constexpr double kMax_mm = 1e9;
    return {require_number(command, "x_mm", -kMax_mm, kMax_mm),
            require_number(command, "y_mm", -kMax_mm, kMax_mm),
            require_number(command, "yaw_deg", -3600, 3600)};
}

MeasuredLength length_of(const serve::Command& command) {
    constexpr double kMin_mm = 1e-3;
    constexpr double kMax_mm = 1e6;
    const std::string& along = require<std::string>(command, "along");
    if (std::ranges::find(kDirections, along) == kDirections.end())
        throw BadArgument("a length is measured along x, y or both");
    return {require_number(command, "measured_mm", kMin_mm, kMax_mm),
            require_number(command, "nominal_mm", kMin_mm, kMax_mm), along};
}

std::string scale_text(const SheetEntry& entry) {
    return fmt::format("print scale x {:.6g}, y {:.6g}", entry.print_scale_x, entry.print_scale_y);
}

std::string offset_text(const SheetEntry& entry) {
    return fmt::format("first intersection {:g} mm right of and {:g} mm below the corner",
                       entry.sheet.origin_x_mm, entry.sheet.origin_y_mm);
}

}  // namespace

SheetTopics::SheetTopics(serve::Server& server)
    : sheets(server.add_topic("sheets", serve::Format::text)),
      answers(server.add_topic("sheet-answers", serve::Format::text)),
      stitch(server.add_topic("stitch", serve::Format::text)) {}

WebSheets::WebSheets(WebSheetsOptions options, serve::Server& server, const SheetTopics& topics)
    : options_(std::move(options)),
      server_(server),
      topics_(topics),
      edits_(options_.path, {kMaxWait_s, [](const std::string& message) { notify(message); },
                             [this] { return ends_.load(); }}) {}

WebSheets::~WebSheets() {
    {
        const std::lock_guard lock(mutex_);
        ends_ = true;
    }
    wake_.notify_one();
    if (thread_.joinable()) thread_.join();
}

void WebSheets::start() {
    publish_sheets();
    publish_measurement(nullptr);
    thread_ = std::thread([this] { run(); });
}

bool WebSheets::obey(const serve::Command& command) {
    if (!command.name.starts_with("sheet-") && !command.name.starts_with("stitch-")) return false;
    {
        const std::lock_guard lock(mutex_);
        if (options_.may_edit && waiting_.size() < kMaxWaiting) {
            waiting_.push_back(command);
            wake_.notify_one();
            return true;
        }
    }
    answer({.id = id_of(command),
            .message = options_.may_edit ? "too many changes are waiting; try again" : kReadOnly});
    return true;
}

void WebSheets::take(const Reading& reading, ImageView image) {
    const std::lock_guard lock(mutex_);
    if (job_) job_->offer(reading, image);
}

std::optional<std::vector<SheetEntry>> WebSheets::take_changed() {
    const std::lock_guard lock(mutex_);
    return std::exchange(changed_, std::nullopt);
}

void WebSheets::run() {
    serve::run_in_background();
    std::unique_lock lock(mutex_);
    while (!ends_) {
        wake_.wait_for(lock, kRefreshPeriod, [this] { return ends_ || !waiting_.empty(); });
        if (ends_) break;
        std::optional<serve::Command> command;
        if (!waiting_.empty()) {
            command = std::move(waiting_.front());
            waiting_.pop_front();
        }
        lock.unlock();
        if (command) answer_to(*command);
        refresh();
        lock.lock();
    }
    lock.unlock();
    measure(false);
}

/// Reads the sheet file if another program has changed it.
void WebSheets::refresh() {
    if (edits_.refresh()) publish_sheets();
}

void WebSheets::answer_to(const serve::Command& command) {
    SheetAnswer given{.id = id_of(command)};
    try {
        perform(command, given);
        given.is_ok = true;
    } catch (const std::exception& error) {
        given.message = error.what();
    }
    // Publishes the sheets before the answer, even if the change was rejected. The page then
    // already displays the current values when the answer arrives.
    publish_sheets();
    answer(std::move(given));
}

void WebSheets::perform(const serve::Command& command, SheetAnswer& answer) {
    const std::string& name = command.name;
    if (name == "sheet-undo") {
        answer.message = "Undone: " + edits_.undo();
    } else if (name == "sheet-redo") {
        answer.message = "Done again: " + edits_.redo();
    } else if (name == "sheet-remove") {
        remove(command, answer);
    } else if (name == "sheet-reprint") {
        reprint(command, answer);
    } else if (name == "sheet-print") {
        print_new(command, answer);
    } else if (name == "stitch-start" || name == "stitch-discard") {
        measure(name == "stitch-start");
    } else if (name == "stitch-accept") {
        accept_measurement(answer);
    } else {
        change(command, answer);
    }
}

void WebSheets::change(const serve::Command& command, SheetAnswer& answer) {
    const SheetEdits::Target target = target_of(command);
    std::string what;
    SheetEdits::Change change;
    std::string (*text)(const SheetEntry&) = world_text;
    if (command.name == "sheet-place") {
        what = "place";
        change = [pose = pose_of(command)](const SheetEntry& entry) { return placed(entry, pose); };
    } else if (command.name == "sheet-unplace") {
        what = "take from the map";
        change = [](const SheetEntry& entry) { return placed(entry, std::nullopt); };
    } else if (command.name == "sheet-rename") {
        what = "rename";
        change = [name = require<std::string>(command, "new_name")](SheetEntry entry) {
            entry.name = name;
            return entry;
        };
        text = [](const SheetEntry&) { return std::string("the new name of the sheet"); };
    } else if (command.name == "sheet-scale") {
        what = "scale";
        change = [length = length_of(command)](const SheetEntry& e) { return scaled(e, length); };
        text = scale_text;
    } else if (command.name == "sheet-offset") {
        what = "offset";
        const double right_mm = require_number(command, "right_mm", 0, kMaxPage_mm);
        const double below_mm = require_number(command, "below_mm", 0, kMaxPage_mm);
        change = [=](const SheetEntry& entry) { return with_offset(entry, right_mm, below_mm); };
        text = offset_text;
    } else {
        throw BadArgument("there is no command " + command.name);
    }
    const SheetEntry after = edits_.change(target, what, change);
    answer.name = after.name;
    answer.message = fmt::format("Saved. {}: {}", printable(after.name), text(after));
}

void WebSheets::remove(const serve::Command& command, SheetAnswer& answer) {
    const SheetEdits::Target target = target_of(command);
    edits_.remove(target);
    answer.message = removal_text(target.name);
}

void WebSheets::reprint(const serve::Command& command, SheetAnswer& answer) {
    const std::string& name = require<std::string>(command, "name");
    const SheetEntry entry = named_sheet(edits_.sheets(), name, options_.path);
    offer_pdf(entry, answer);
    if (entry.is_reserved) edits_.confirm(name);
}

void WebSheets::print_new(const serve::Command& command, SheetAnswer& answer) {
    constexpr double kMinSpacing_mm = 0.05;
    constexpr double kMaxSpacing_mm = 20;
    NewPage page;
    page.name = require<std::string>(command, "name");
    page.paper = require<std::string>(command, "paper");
    page.is_landscape = require<bool>(command, "landscape");
    page.spacing_mm = require_number(command, "spacing_mm", kMinSpacing_mm, kMaxSpacing_mm);
    SheetEntry entry;
    const auto enter = [&](SheetFile& file) {
        entry = enter_page(file, page);
        require_printable(entry.sheet);
    };
    SheetReservation reservation(edits_.path(), enter, edits_.wait());
    offer_pdf(entry, answer);
    reservation.confirm();
    answer.name = entry.name;
}

/// Offers the PDF of a sheet for download. Only the newest PDFs are kept.
void WebSheets::offer_pdf(const SheetEntry& entry, SheetAnswer& answer) {
    const auto bytes =
        std::make_shared<const std::string>(pdf_of(entry, [this] { return !ends_.load(); }));
    const std::string file = pdf_name(entry.name);
    const std::string path = fmt::format("/sheets/{}/{}", ++pdfs_, file);
    server_.set_route(path, [bytes, file] {
        return serve::Answer{.type = "application/pdf", .body = *bytes, .download = file};
    });
    pdf_paths_.push_back(path);
    if (pdf_paths_.size() > kMaxPdfs) {
        server_.remove_route(pdf_paths_.front());
        pdf_paths_.pop_front();
    }
    answer.url = path;
    answer.message = fmt::format("The PDF of {} is ready.", printable(entry.name));
}

/// Discards the running measurement, if there is one. Then starts a measurement of the current
/// sheets if `is_on` is true.
void WebSheets::measure(bool is_on) {
    std::shared_ptr<StitchJob> job;
    {
        const std::lock_guard lock(mutex_);
        std::swap(job, job_);
    }
    job.reset();  // waits for the job's thread, which may still be publishing
    publish_measurement(nullptr);
    if (!is_on) return;
    edits_.refresh();
    if (edits_.sheets().size() < 2)
        throw Error("the sheet file has only one sheet; at least two are measured");
    measured_.clear();
    for (const SheetEntry& entry : edits_.sheets())
        measured_.push_back({entry.name, edits_.revision(entry.name)});
    const StitchJob::Progress none;
    publish_measurement(&none);
    std::optional<Camera> camera;
    {
        const std::lock_guard lock(mutex_);
        camera = options_.camera;
    }
    job = std::make_shared<StitchJob>(
        edits_.sheets(), std::move(camera),
        [this](const StitchJob::Progress& progress) { publish_measurement(&progress); });
    const std::lock_guard lock(mutex_);
    job_ = std::move(job);
}

void WebSheets::set_camera(const Camera& camera) {
    const std::lock_guard lock(mutex_);
    options_.camera = camera;
}

void WebSheets::accept_measurement(SheetAnswer& answer) {
    std::shared_ptr<StitchJob> job;
    {
        const std::lock_guard lock(mutex_);
        job = job_;
    }
    const std::optional<Stitching> result = job ? job->result() : std::nullopt;
    if (!result) throw Error("no places were measured yet");
    std::vector<SheetEntry> measured;
    for (const StitchedSheet& sheet : result->stitched)
        measured.push_back(named_sheet(result->sheets, sheet.name, options_.path));
    edits_.change_all(measured_, measured, "measured places");
    job.reset();
    measure(false);
    answer.message = fmt::format("Saved the measured places of {} sheets", measured.size());
}

void WebSheets::answer(SheetAnswer answer) {
    if (answer.id.empty()) return;
    const std::lock_guard lock(mutex_);
    answers_.push_back(std::move(answer));
    if (answers_.size() > kMaxAnswers) answers_.pop_front();
    server_.publish(topics_.answers, [text = text_of(answers_message(answers_))] { return text; });
}

/// Publishes the sheets to the web pages, and makes them available to the thread that follows the
/// robot.
void WebSheets::publish_sheets() {
    server_.publish(topics_.sheets,
                    [text = text_of(sheets_message(edits_, options_.may_edit))] { return text; });
    if (edits_.version() == taken_version_ || edits_.sheets().empty()) return;
    taken_version_ = edits_.version();
    const std::lock_guard lock(mutex_);
    changed_ = edits_.sheets();
}

void WebSheets::publish_measurement(const StitchJob::Progress* progress) {
    server_.publish(topics_.stitch, [text = text_of(stitch_message(progress))] { return text; });
}

}  // namespace dotpose::cli
