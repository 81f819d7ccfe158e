#include "dotpose/pose_packet.hpp"

#include <algorithm>
#include <limits>
#include <optional>
#include <set>
#include <string_view>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "dotpose/tools/random.hpp"
#include "link/framing.hpp"

namespace dotpose {
namespace {

using Bytes = std::vector<std::uint8_t>;

PosePacket typical() {
    PosePacket packet;
    packet.sequence = 258;
    packet.time_us = 0x01020304;
    packet.status = Status::ok;
    packet.code = CodeVariant::microdots;
    packet.cell = {410'815'347, 70'000};
    packet.fraction_x_q16 = 0xABCD;
    packet.fraction_y_q16 = 1;
    packet.theta_bam16 = -2;
    packet.section = {62, 7};
    packet.certainty = 120;
    packet.deviation_q12 = 9;
    return packet;
}

PosePacket random_packet(Rng& rng) {
    PosePacket packet;
    packet.sequence = static_cast<std::uint16_t>(rng.bits());
    packet.time_us = static_cast<std::uint32_t>(rng.bits());
    packet.status = static_cast<Status>(rng.below(kStatusCount));
    packet.code = static_cast<CodeVariant>(rng.below(3));
    packet.cell = {rng.below(kPositionsPerAxis), rng.below(kPositionsPerAxis)};
    packet.fraction_x_q16 = static_cast<std::uint16_t>(rng.bits());
    packet.fraction_y_q16 = static_cast<std::uint16_t>(rng.below(2));  // zeros are frequent
    packet.theta_bam16 = static_cast<std::int16_t>(rng.bits());
    packet.section = {static_cast<std::uint8_t>(rng.below(63)),
                      static_cast<std::uint8_t>(rng.below(63))};
    packet.certainty = static_cast<std::uint8_t>(rng.bits());
    packet.deviation_q12 = static_cast<std::uint8_t>(rng.bits());
    return packet;
}

Bytes stream_of(const std::vector<PosePacket>& packets) {
    Bytes stream;
    for (const PosePacket& packet : packets) {
        const PacketBytes bytes = encode(packet);
        stream.insert(stream.end(), bytes.begin(), bytes.end());
    }
    return stream;
}

std::vector<PosePacket> received(const Bytes& stream) {
    PacketReader reader;
    std::vector<PosePacket> packets;
    for (const std::uint8_t byte : stream) {
        if (reader.push(byte)) packets.push_back(reader.packet());
    }
    return packets;
}

/// Encodes `plain` with COBS as defined by its authors: appends a zero, splits the bytes after
/// every zero, and writes each piece without its zero, preceded by the length of the piece
/// including the zero.
Bytes cobs(Bytes plain) {
    plain.push_back(0);
    Bytes coded;
    Bytes piece;
    for (const std::uint8_t byte : plain) {
        if (byte != 0) {
            piece.push_back(byte);
            continue;
        }
        coded.push_back(static_cast<std::uint8_t>(piece.size() + 1));
        coded.insert(coded.end(), piece.begin(), piece.end());
        piece.clear();
    }
    return coded;
}

TEST(PosePacket, HasTheDocumentedLayout) {
    const Bytes plain = {1,    2,    1,    4,    3, 2, 1, 0,    2,    0x73, 0x8B, 0x7C, 0x18, 0xCD,
                         0xAB, 0x70, 0x11, 0x01, 0, 1, 0, 0xFE, 0xFF, 62,   7,    120,  9};
    ASSERT_EQ(plain.size(), 27U);
    ASSERT_EQ(410'815'347U, 0x187C8B73U);
    Bytes expected = cobs(plain);
    const unsigned crc = link::crc16(expected);
    for (const int shift : {14, 7, 0})
        expected.push_back(static_cast<std::uint8_t>(128 + (crc >> shift) % 128));
    expected.push_back(0);
    EXPECT_THAT(encode(typical()), testing::ElementsAreArray(expected));
}

TEST(PosePacket, CrcIsThatOfTheCatalogue) {
    // CRC-16/M17 in the RevEng catalogue: poly 0x5935, init 0xFFFF, check 0x772B.
    constexpr std::string_view kText = "123456789";
    EXPECT_EQ(link::crc16(Bytes(kText.begin(), kText.end())), 0x772B);
}

TEST(PosePacket, NoFourBitsCancelInTheCrc) {
    // The CRC is linear, so an error of several bits changes the CRC by the XOR of the changes
    // caused by the individual bits. If no two pairs of single-bit changes have the same XOR, an
    // error of up to four bits always changes the CRC.
    Bytes coded(link::kCodedBytes, 0);
    const unsigned none = link::crc16(coded);
    std::vector<unsigned> changes;
    for (std::size_t bit = 0; bit < 8 * coded.size(); ++bit) {
        coded[bit / 8] ^= static_cast<std::uint8_t>(1U << bit % 8);
        changes.push_back(link::crc16(coded) ^ none);
        coded[bit / 8] = 0;
    }
    for (int bit = 0; bit < 16; ++bit)
        changes.push_back(1U << bit);
    std::set<unsigned> seen = {0U};
    for (std::size_t i = 0; i < changes.size(); ++i) {
        ASSERT_TRUE(seen.insert(changes[i]).second);
    }
    std::set<unsigned> pairs;
    for (std::size_t i = 0; i < changes.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            const unsigned pair = changes[i] ^ changes[j];
            ASSERT_EQ(seen.count(pair), 0U) << i << " " << j;
            ASSERT_TRUE(pairs.insert(pair).second) << i << " " << j;
        }
    }
}

TEST(PosePacket, ComesBackAsItWasSent) {
    Rng rng(4711);
    std::vector<PosePacket> sent = {PosePacket{}, typical()};
    for (int i = 0; i < 2000; ++i)
        sent.push_back(random_packet(rng));
    const Bytes stream = stream_of(sent);
    EXPECT_EQ(std::count(stream.begin(), stream.end(), 0),
              static_cast<std::ptrdiff_t>(sent.size()));
    EXPECT_EQ(received(stream), sent);
}

/// Tests which of three packets are received if some bits in the first two packets are changed.
class DamagedStream : public testing::TestWithParam<int> {
  protected:
    void SetUp() override {
        Rng rng(99, static_cast<std::uint64_t>(GetParam()));
        sent_ = {random_packet(rng), random_packet(rng), random_packet(rng)};
        if (GetParam() == 0) sent_ = {PosePacket{}, typical(), typical()};
        stream_ = stream_of(sent_);
    }
    void flip(std::size_t bit) { stream_[bit / 8] ^= static_cast<std::uint8_t>(1U << bit % 8); }

    void expect_only_undamaged(std::size_t a, std::size_t b) {
        flip(a);
        if (b != a) flip(b);
        const std::vector<PosePacket> got = received(stream_);
        std::vector<PosePacket> undamaged;
        for (const std::size_t i : {0U, 1U, 2U}) {
            const bool is_hit = a / 256 == i || b / 256 == i;
            // If the end mark of a packet is damaged, the next packet cannot be separated from it.
            const bool is_joined = i > 0 && (is_mark(a, i - 1) || is_mark(b, i - 1));
            if (!is_hit && !is_joined) undamaged.push_back(sent_[i]);
        }
        ASSERT_EQ(got, undamaged) << "bits " << a << " and " << b;
        flip(a);
        if (b != a) flip(b);
    }
    static bool is_mark(std::size_t bit, std::size_t packet) { return bit / 8 == packet * 32 + 31; }

    std::vector<PosePacket> sent_;
    Bytes stream_;
};

TEST_P(DamagedStream, NoticesEverySingleAndDoubleBitError) {
    for (std::size_t a = 0; a < 512; ++a) {
        for (std::size_t b = 0; b <= a; ++b) {
            expect_only_undamaged(a, b);
            if (HasFatalFailure()) return;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Packets, DamagedStream, testing::Range(0, 4));

TEST(PosePacket, GoesOnWithTheNextPacketAfterAnything) {
    Rng rng(12);
    for (int round = 0; round < 2000; ++round) {
        const std::vector<PosePacket> sent = {random_packet(rng), random_packet(rng),
                                              random_packet(rng)};
        Bytes stream = stream_of(sent);
        // Bytes are lost, added or changed anywhere in the first packet, including its end mark.
        const std::size_t at = rng.below(32);
        const auto lost =
            static_cast<std::ptrdiff_t>(rng.below(static_cast<std::uint32_t>(33 - at)));
        const auto begin = stream.begin() + static_cast<std::ptrdiff_t>(at);
        stream.erase(begin, begin + lost);
        Bytes noise(rng.below(80));
        for (std::uint8_t& byte : noise)
            byte = static_cast<std::uint8_t>(rng.bits());
        stream.insert(stream.begin() + static_cast<std::ptrdiff_t>(at), noise.begin(), noise.end());
        const std::vector<PosePacket> got = received(stream);
        ASSERT_FALSE(got.empty());
        EXPECT_EQ(got.back(), sent[2]) << "round " << round;
        for (const PosePacket& packet : got)
            EXPECT_THAT(sent, testing::Contains(packet)) << "round " << round;
    }
}

TEST(PosePacket, CountsWhatItRefuses) {
    PacketReader reader;
    const PacketBytes bytes = encode(typical());
    const auto push_all = [&reader](const auto& all) {
        bool is_packet = false;
        for (const std::uint8_t byte : all)
            is_packet = reader.push(byte);
        return is_packet;
    };
    EXPECT_FALSE(reader.push(0));  // bytes before the first end mark do not count as damage
    EXPECT_EQ(reader.damaged(), 0U);
    EXPECT_FALSE(push_all(Bytes{1, 2, 3, 0}));
    EXPECT_EQ(reader.damaged(), 1U);
    EXPECT_FALSE(push_all(Bytes(100'000, 7)));
    EXPECT_FALSE(reader.push(0));
    EXPECT_EQ(reader.damaged(), 2U);
    EXPECT_TRUE(push_all(bytes));
    EXPECT_EQ(reader.damaged(), 2U);
}

TEST(PosePacket, RefusesValuesThatNoPoseHas) {
    const auto is_refused = [](const auto& change) {
        PosePacket packet = typical();
        change(packet);
        return received(stream_of({packet})).empty();
    };
    EXPECT_FALSE(is_refused([](PosePacket&) {}));
    EXPECT_TRUE(is_refused([](PosePacket& p) { p.cell.x = kPositionsPerAxis; }));
    EXPECT_TRUE(is_refused([](PosePacket& p) { p.cell.y = kPositionsPerAxis; }));
    EXPECT_TRUE(is_refused([](PosePacket& p) { p.section.u = 63; }));
    EXPECT_TRUE(is_refused([](PosePacket& p) { p.section.v = 63; }));
    EXPECT_TRUE(is_refused([](PosePacket& p) { p.code = static_cast<CodeVariant>(3); }));
}

// A sender may be newer than its receiver, and may send statuses that do not exist in the
// receiver's version.
TEST(PosePacket, StatusesOfNewerVersionsAreOther) {
    for (const int number : {kStatusCount, 100, 254, 255}) {
        PosePacket packet = typical();
        packet.status = static_cast<Status>(number);
        const std::vector<PosePacket> read = received(stream_of({packet}));
        ASSERT_EQ(read.size(), 1U) << number;
        packet.status = Status::other;
        EXPECT_EQ(read[0], packet) << number;
    }
}

TEST(PosePacket, CarriesAFix) {
    Fix fix;
    fix.status = Status::ok;
    fix.cell = {5, 6};
    fix.fraction_x_q16 = 0x8000;
    fix.theta_bam = -(1 << 30);  // a quarter turn counter-clockwise
    fix.section = {1, 2};
    fix.p_wrong_log2 = -90;
    fix.covariance[0][0] = 4e-6F;  // a standard deviation of 0.002 spacings, which is 8.19 / 2^12
    fix.covariance[1][1] = 1e-6F;
    const PosePacket packet = make_packet(fix, CodeVariant::libdots, 3, 4);
    EXPECT_EQ(packet.sequence, 3);
    EXPECT_EQ(packet.time_us, 4U);
    EXPECT_EQ(packet.code, CodeVariant::libdots);
    EXPECT_EQ(packet.x_grid(), 5.5);
    EXPECT_EQ(packet.y_grid(), 6);
    EXPECT_EQ(packet.theta_bam16, -16384);
    EXPECT_EQ(packet.section, (Section{1, 2}));
    EXPECT_EQ(packet.certainty, 90);
    EXPECT_EQ(packet.deviation_q12, 9);
}

TEST(PosePacket, LimitsWhatDoesNotFit) {
    Fix fix;
    fix.status = Status::ok;
    fix.p_wrong_log2 = -1000;
    fix.covariance[0][0] = 1;
    fix.theta_bam = std::numeric_limits<std::int32_t>::max();
    const PosePacket packet = make_packet(fix, CodeVariant::anoto, 0, 0);
    EXPECT_EQ(packet.certainty, 255);
    EXPECT_EQ(packet.deviation_q12, 255);
    EXPECT_EQ(packet.theta_bam16, -32768);
}

TEST(PosePacket, OfAFrameWithoutAFixSaysOnlyWhy) {
    Fix fix;
    fix.status = Status::too_few_dots;
    fix.cell = {5, 6};
    const PosePacket packet = make_packet(fix, CodeVariant::anoto, 1, 2);
    PosePacket expected;
    expected.sequence = 1;
    expected.time_us = 2;
    expected.status = Status::too_few_dots;
    EXPECT_EQ(packet, expected);
}

}  // namespace
}  // namespace dotpose
