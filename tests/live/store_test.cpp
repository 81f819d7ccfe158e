// Tests the databases of states (SQLite and PostgreSQL) and the queue from which states are written
// to them.
#include <atomic>
#include <filesystem>
#include <fstream>
#include <memory>
#include <mutex>
#include <numeric>
#include <string>
#include <thread>
#include <tuple>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../temporary_directory.hpp"
#include "mqtt_fixture.hpp"
#include "postgres.hpp"
#include "store/database.hpp"
#include "store/queue.hpp"

namespace dotpose::test {
namespace {

using store::Access;
using store::Motion;
using store::State;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr std::int64_t kDay_us = 86'400'000'000;
constexpr std::int64_t kNoon_us = 1'795'000'000'000'000;  // 2026-11-18T11:06:40 UTC

State state_of(const std::string& robot, std::int64_t time_us, std::int64_t number) {
    State state;
    state.robot = std::make_shared<const std::string>(robot);
    state.place = std::make_shared<const store::Place>(store::Place{"hall", "left"});
    state.time_us = time_us;
    state.number = number;
    state.delay_us = -1500;
    state.motion = Motion::moving;
    state.theta_urad = -3'141'592;
    state.x_nm = -123'456'789'012'345;
    state.y_nm = 987'654'321;
    state.deviation_nm = 350;
    state.vx_um_s = -500'000;
    state.vy_um_s = 1;
    state.omega_urad_s = 2'147'483'647;
    return state;
}

auto values_of(const State& s) {
    return std::tuple(*s.robot, s.place->map, s.place->sheet, s.time_us, s.number, s.delay_us,
                      s.motion, s.reason, s.theta_urad, s.x_nm, s.y_nm, s.deviation_nm, s.vx_um_s,
                      s.vy_um_s, s.omega_urad_s);
}

enum class Kind { sqlite, postgres };

class Databases : public testing::TestWithParam<Kind> {
  protected:
    static void SetUpTestSuite() { cluster_ = std::make_unique<Postgres>(); }
    static void TearDownTestSuite() { cluster_.reset(); }

    Databases() {
        if (GetParam() == Kind::postgres) {
            cluster_->query(
                "SET client_min_messages = warning; DROP SCHEMA IF EXISTS dotpose CASCADE");
        }
    }
    std::string where() const {
        return GetParam() == Kind::postgres ? cluster_->url()
                                            : (directory_.path() / "fleet.db").string();
    }
    std::unique_ptr<store::Database> open(Access access = Access::write) const {
        return store::make_database(where(), access);
    }
    static std::vector<State> read(store::Database& database, const store::Query& query) {
        std::vector<State> states;
        database.read(query, [&states](const State& state) { states.push_back(state); });
        return states;
    }
    static std::vector<std::int64_t> numbers(store::Database& database, const store::Query& query) {
        std::vector<std::int64_t> numbers;
        for (const State& state : read(database, query))
            numbers.push_back(state.number);
        return numbers;
    }

    static inline std::unique_ptr<Postgres> cluster_;
    TemporaryDirectory directory_;
};

TEST_P(Databases, AReaderMayEndTheReading) {
    std::vector<State> written;
    for (int i = 0; i < 3000; ++i)
        written.push_back(state_of("anna", kNoon_us + i, i));
    const auto database = open();
    database->write(written);
    struct Enough {};
    EXPECT_THROW(database->read({"anna"}, [](const State&) { throw Enough(); }), Enough);
    EXPECT_EQ(read(*database, {"anna"}).size(), written.size());
    database->write(std::vector{state_of("bert", kNoon_us, 1)});
    EXPECT_EQ(read(*database, {"bert"}).size(), 1U);
}

TEST_P(Databases, AReaderSeesThePlacesOfAllItsStates) {
    constexpr int kPlaces = 150;
    const auto place_of = [](int i) { return fmt::format("sheet {}", i); };
    open()->prepare();
    std::atomic<bool> is_written = false;
    std::jthread writer([&] {
        const auto database = open();
        for (int i = 0; i < kPlaces; ++i) {
            State state = state_of("anna", kNoon_us + i, i);
            state.place = std::make_shared<const store::Place>(store::Place{"hall", place_of(i)});
            database->write(std::vector{state});
        }
        is_written = true;
    });
    const auto database = open(Access::read);
    std::size_t states = 0;
    for (bool is_last = false; !is_last;) {
        is_last = is_written;
        const auto found = read(*database, {"anna"});
        EXPECT_GE(found.size(), states);
        states = found.size();
        for (std::size_t i = 0; i < states; ++i)
            EXPECT_EQ(found[i].place->sheet, place_of(static_cast<int>(i)));
    }
    writer.join();
    EXPECT_EQ(states, std::size_t{kPlaces});
}

TEST_P(Databases, ReturnWhatWasWritten) {
    State lost = state_of("anna", kNoon_us + 1, 2);
    lost.motion = Motion::lost;
    lost.reason = Status::too_few_dots;
    State elsewhere = state_of("anna", kNoon_us + 2, 3);
    elsewhere.place = std::make_shared<const store::Place>(store::Place{"pattern-7", ""});
    elsewhere.motion = Motion::still;
    const std::vector<State> written = {state_of("anna", kNoon_us, 1), lost, elsewhere};
    open()->write(written);
    const auto database = open(Access::read);
    const auto found = read(*database, {"anna"});
    ASSERT_EQ(found.size(), 3U);
    EXPECT_EQ(values_of(found[0]), values_of(written[0]));
    EXPECT_EQ(values_of(found[2]), values_of(written[2]));
    EXPECT_EQ(found[1].motion, Motion::lost);
    EXPECT_EQ(found[1].reason, Status::too_few_dots);
    EXPECT_EQ(found[1].x_nm, 0);
}

TEST_P(Databases, SelectByRobotAndTime) {
    const auto database = open();
    std::vector<State> states;
    for (int i = 9; i >= 0; --i) {
        states.push_back(state_of("anna", kNoon_us + i, i));
        states.push_back(state_of("bert", kNoon_us + kDay_us + i, 100 + i));
    }
    database->write(states);
    EXPECT_THAT(numbers(*database, {"anna", kNoon_us + 3, kNoon_us + 6}), ElementsAre(3, 4, 5));
    EXPECT_EQ(numbers(*database, {"bert"}).size(), 10U);
    EXPECT_THAT(numbers(*database, {"carl"}), ElementsAre());
    const auto robots = database->robots();
    ASSERT_EQ(robots.size(), 2U);
    EXPECT_EQ(robots[1].robot, "bert");
    EXPECT_EQ(robots[1].first_us, kNoon_us + kDay_us);
    EXPECT_EQ(robots[1].last_us, kNoon_us + kDay_us + 9);
}

TEST_P(Databases, SkipStatesThatAreStoredAlready) {
    const auto database = open();
    const std::vector<State> first = {state_of("anna", kNoon_us, 1), state_of("anna", kNoon_us, 2)};
    const std::vector<State> second = {state_of("anna", kNoon_us, 2), state_of("bert", kNoon_us, 2),
                                       state_of("anna", kNoon_us + 1, 2)};
    database->write(first);
    database->write(first);
    database->write(second);
    open()->write(second);
    EXPECT_THAT(numbers(*database, {"anna"}), ElementsAre(1, 2, 2));
    EXPECT_THAT(numbers(*database, {"bert"}), ElementsAre(2));
}

TEST_P(Databases, NamesAreDataAndNeverStatements) {
    const std::vector<std::string> names = {"'; DROP TABLE states; --",
                                            "\"; DROP SCHEMA dotpose CASCADE; --",
                                            "$1",
                                            "%s%n",
                                            "\\'",
                                            "a\tb\nc",
                                            "\\N",
                                            "../../etc/passwd",
                                            "<script>",
                                            std::string(128, 'x'),
                                            "\xE2\x80\xAE right to left",
                                            "NULL",
                                            "?"};
    std::vector<State> states;
    for (std::size_t i = 0; i < names.size(); ++i) {
        states.push_back(state_of(names[i], kNoon_us, static_cast<std::int64_t>(i)));
        states.back().place = std::make_shared<const store::Place>(
            store::Place{names[i], names[names.size() - 1 - i]});
    }
    const auto database = open();
    database->write(states);
    EXPECT_EQ(database->robots().size(), names.size());
    for (std::size_t i = 0; i < names.size(); ++i) {
        const auto found = read(*database, {names[i]});
        ASSERT_EQ(found.size(), 1U) << names[i];
        EXPECT_EQ(values_of(found[0]), values_of(states[i]));
    }
}

TEST_P(Databases, RemoveOldDays) {
    const auto database = open();
    std::vector<State> states;
    for (int day = 0; day < 5; ++day)
        states.push_back(state_of("anna", kNoon_us + day * kDay_us, day));
    states.push_back(state_of("old", kNoon_us, 0));
    database->write(states);
    database->remove_days_before(kNoon_us + 3 * kDay_us);
    EXPECT_THAT(numbers(*database, {"anna"}), ElementsAre(3, 4));
    EXPECT_THAT(numbers(*database, {"old"}), ElementsAre());
    EXPECT_EQ(database->robots().size(), 1U);
    database->write(states);  // after `remove_days_before`, the same states can be written again
    EXPECT_EQ(numbers(*database, {"anna"}).size(), 5U);
}

TEST_P(Databases, TwoProgramsWriteAtTheSameTime) {
    std::vector<std::thread> threads;
    std::atomic<int> failures = 0;
    for (int program = 0; program < 2; ++program) {
        threads.emplace_back([&, program] {
            const auto database = open();
            for (int i = 0; i < 20; ++i) {
                std::vector<State> states;
                for (const char* robot : {"anna", "bert"})
                    states.push_back(state_of(robot, kNoon_us + i * kDay_us / 4, program));
                try {
                    database->write(states);
                } catch (const Error& error) {
                    // If two transactions wait for each other, PostgreSQL aborts one of them. Its
                    // states are then written again.
                    ++failures;
                    database->write(states);
                }
            }
        });
    }
    for (std::thread& thread : threads)
        thread.join();
    const auto database = open();
    EXPECT_EQ(numbers(*database, {"anna"}).size(), 40U) << failures;
    EXPECT_EQ(numbers(*database, {"bert"}).size(), 40U);
}

INSTANTIATE_TEST_SUITE_P(Both, Databases, testing::Values(Kind::sqlite, Kind::postgres),
                         [](const auto& kind) {
                             return kind.param == Kind::sqlite ? "SQLite" : "PostgreSQL";
                         });

template <typename Action>
std::string message_of(const Action& action) {
    try {
        action();
    } catch (const Error& error) {
        return error.what();
    }
    return "no error";
}

TEST(DatabaseFiles, OtherFilesAreRefused) {
    const TemporaryDirectory directory;
    const std::string path = (directory.path() / "x.db").string();
    EXPECT_THAT(message_of([&] { store::make_database(path, Access::read)->robots(); }),
                HasSubstr("x.db: unable to open database file"));
    EXPECT_FALSE(std::filesystem::exists(path));
    std::ofstream(path) << "a text of more than one hundred bytes, which is not a database of "
                           "SQLite and must not be changed in any way by dotpose";
    EXPECT_THAT(message_of([&] { store::make_database(path, Access::write)->prepare(); }),
                HasSubstr("x.db: file is not a database"));
    EXPECT_THAT(message_of([&] {
                    store::make_database((directory.path() / "none" / "x.db").string(),
                                         Access::write)
                        ->prepare();
                }),
                HasSubstr("unable to open database file"));
    EXPECT_THAT(message_of([] { store::make_database("postgresql://[", Access::write); }),
                HasSubstr("the URL of the database is not valid"));
}

/// An in-memory database that can be made to fail.
class FakeDatabase : public store::Database {
  public:
    struct Contents {
        std::mutex mutex;
        std::vector<std::int64_t> numbers;
        bool is_away = false;
        bool fails_to_remove = false;
        std::vector<std::int64_t> kept_from;
    };
    explicit FakeDatabase(Contents& contents) : contents_(contents) {}
    std::string label() const override { return "fake"; }
    void prepare() override { require(); }
    void write(std::span<const State> states) override {
        require();
        const std::lock_guard lock(contents_.mutex);
        for (const State& state : states)
            contents_.numbers.push_back(state.number);
    }
    void remove_days_before(std::int64_t time_us) override {
        const std::lock_guard lock(contents_.mutex);
        if (contents_.fails_to_remove) throw Error("locked");
        contents_.kept_from.push_back(time_us);
    }
    void read(const store::Query&, const std::function<void(const State&)>&) override {}
    std::vector<store::RobotSpan> robots() override { return {}; }

  private:
    void require() {
        const std::lock_guard lock(contents_.mutex);
        if (contents_.is_away) throw Error("away");
    }
    Contents& contents_;
};

TEST(StoreQueue, KeepsStatesWhileTheDatabaseIsAway) {
    FakeDatabase::Contents contents;
    contents.is_away = true;
    News news;
    store::Queue queue(std::make_unique<FakeDatabase>(contents), true,
                       {.max_states = 1000, .period = 1ms, .notify = news.listener()});
    for (int i = 0; i < 1000; ++i)
        queue.push(state_of("anna", kNoon_us + i, i));
    std::this_thread::sleep_for(50ms);
    EXPECT_TRUE(queue.status().is_away);
    EXPECT_EQ(queue.status().waiting, 1000);
    {
        const std::lock_guard lock(contents.mutex);
        contents.is_away = false;
    }
    EXPECT_TRUE(queue.finish(10s));
    std::vector<std::int64_t> expected(1000);
    std::iota(expected.begin(), expected.end(), 0);
    EXPECT_EQ(contents.numbers, expected);
    EXPECT_EQ(queue.status().stored, 1000);
    EXPECT_EQ(queue.status().dropped, 0);
    EXPECT_THAT(news.text(), HasSubstr("cannot store states in fake: away; trying again\n"));
    EXPECT_THAT(news.text(), HasSubstr("fake answers again\n"));
}

TEST(StoreQueue, ReportsOldDaysThatAreNotRemoved) {
    FakeDatabase::Contents contents;
    contents.fails_to_remove = true;
    News news;
    store::Queue queue(std::make_unique<FakeDatabase>(contents), true,
                       {.period = 1ms, .keep_days = 7, .notify = news.listener()});
    for (int i = 0; i < 20; ++i) {
        queue.push(state_of("anna", kNoon_us + i, i));
        std::this_thread::sleep_for(5ms);
    }
    EXPECT_FALSE(queue.status().is_away);
    {
        const std::lock_guard lock(contents.mutex);
        contents.fails_to_remove = false;
    }
    queue.push(state_of("anna", kNoon_us + 20, 20));
    EXPECT_TRUE(queue.finish(10s));
    EXPECT_EQ(queue.status().stored, 21);
    EXPECT_EQ(contents.kept_from.size(), 1U);
    // The states are stored, so only the failed removal is reported, and only once.
    EXPECT_EQ(news.text(), "cannot remove old days from fake: locked; trying again\n");
}

TEST(StoreQueue, DropsTheOldestStatesBeyondItsBuffer) {
    FakeDatabase::Contents contents;
    contents.is_away = true;
    News news;
    store::Queue queue(std::make_unique<FakeDatabase>(contents), true,
                       {.max_states = 100, .period = 10s, .notify = news.listener()});
    for (int i = 0; i < 250; ++i)
        queue.push(state_of("anna", kNoon_us + i, i));
    EXPECT_EQ(queue.status().dropped, 150);
    EXPECT_THAT(news.text(), HasSubstr("fake: more than 100 states wait; the oldest are dropped"));
    contents.is_away = false;
    EXPECT_TRUE(queue.finish(10s));
    ASSERT_EQ(contents.numbers.size(), 100U);
    EXPECT_EQ(contents.numbers.front(), 150);
}

TEST(StoreQueue, MessagesMayUseTheQueue) {
    FakeDatabase::Contents contents;
    contents.is_away = true;
    // Null while the queue is being constructed. The constructor may already report a failure.
    const store::Queue* used = nullptr;
    std::int64_t dropped = 0;
    store::Queue queue(std::make_unique<FakeDatabase>(contents), true,
                       {.max_states = 1, .period = 10s, .notify = [&](const std::string&) {
                            if (used != nullptr) dropped = used->status().dropped;
                        }});
    used = &queue;
    queue.push(state_of("anna", kNoon_us, 0));
    queue.push(state_of("anna", kNoon_us + 1, 1));
    EXPECT_EQ(dropped, 1);
    used = nullptr;
}

TEST(StoreQueue, EndsIfTheDatabaseStaysAway) {
    FakeDatabase::Contents contents;
    contents.is_away = true;
    store::Queue queue(std::make_unique<FakeDatabase>(contents), true, {.period = 1ms});
    queue.push(state_of("anna", kNoon_us, 1));
    EXPECT_FALSE(queue.finish(300ms));
    EXPECT_EQ(queue.status().waiting, 1);
    EXPECT_THROW(store::Queue(std::make_unique<FakeDatabase>(contents), false, {}), Error);
}

TEST(StoreQueue, RemovesOldDaysOnceADay) {
    FakeDatabase::Contents contents;
    store::Queue queue(std::make_unique<FakeDatabase>(contents), true,
                       {.period = 1ms, .keep_days = 30});
    wait_until([&] {
        const std::lock_guard lock(contents.mutex);
        return !contents.kept_from.empty();
    });
    std::this_thread::sleep_for(50ms);
    EXPECT_TRUE(queue.finish(1s));
    EXPECT_EQ(contents.kept_from.size(), 1U);
    EXPECT_EQ(contents.kept_from[0] % kDay_us, 0);
}

}  // namespace
}  // namespace dotpose::test
