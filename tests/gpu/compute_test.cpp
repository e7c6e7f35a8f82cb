// The device's building blocks against the standard library.
#include <algorithm>
#include <bit>
#include <numeric>
#include <random>

#include "passes/common/compute/compaction.h"
#include "passes/common/compute/histogram.h"
#include "passes/common/compute/radix_sort.h"
#include "tests/gpu/vulkan_fixture.h"
#include "tests/support/programs.h"

namespace voxray {
namespace {

/// Sizes round those of threads, work groups, blocks and rows of work groups.
const std::vector<uint32_t> kCounts{1, 15, 16, 17, 255, 1024, 1025, 4095, 4096, 4097, 70000, 1u << 20};

std::vector<uint32_t> randomNumbers(uint32_t count, uint32_t below, uint32_t seed) {
    std::mt19937 random(seed);
    std::vector<uint32_t> numbers(count);
    for (uint32_t& number : numbers) number = below == 0 ? random() : random() % below;
    return numbers;
}

class Compute : public VulkanTest {
 protected:
    Buffer upload(CommandStream& stream, const std::vector<uint32_t>& values) {
        Buffer buffer(device(), "values", values.size() * sizeof(uint32_t));
        stream.upload(buffer, values);
        return buffer;
    }

    test::TestPrograms programs_;
};

TEST_F(Compute, PrefixSumsOfValuesAndOfSetBits) {
    const PrefixSum ofUints(programs_, PrefixSum::Input::Uints), ofBits(programs_, PrefixSum::Input::SetBits);
    programs_.compile();
    for (const uint32_t count : kCounts) {
        const std::vector<uint32_t> values = randomNumbers(count, 2000, count), words = randomNumbers(count, 0, count);
        std::vector<uint32_t> sums(count), bits(count);
        std::exclusive_scan(values.begin(), values.end(), sums.begin(), 0u);
        uint32_t set = 0;
        for (uint32_t i = 0; i < count; ++i) {
            bits[i] = set;
            set += uint32_t(std::popcount(words[i]));
        }
        CommandStream stream(device());
        const Buffer source = upload(stream, values), other = upload(stream, words);
        EXPECT_EQ(ofUints.run(stream, source, source, count), sums.back() + values.back()) << count;
        EXPECT_EQ(stream.readAs<uint32_t>(source, count), sums) << count;
        EXPECT_EQ(ofBits.run(stream, other, other, count), set) << count;
        EXPECT_EQ(stream.readAs<uint32_t>(other, count), bits) << count;
    }
}

TEST_F(Compute, CompactionListsFlaggedItems) {
    const Compaction compaction(programs_);
    programs_.compile();
    for (const uint32_t words : {1u, 33u, 1024u, 5000u}) {
        std::vector<uint32_t> flags = randomNumbers(words, 0, words), expected;
        flags[0] = words == 1 ? 0 : 0xffffffffu;
        for (uint32_t i = 0; i < 32 * words; ++i)
            if (flags[i / 32] >> (i % 32) & 1u) expected.push_back(i);
        CommandStream stream(device());
        const Buffer indices(device(), "indices", 32ull * words * sizeof(uint32_t));
        EXPECT_EQ(compaction.run(stream, upload(stream, flags), indices, words), expected.size()) << words;
        if (!expected.empty()) {
            EXPECT_EQ(stream.readAs<uint32_t>(indices, expected.size()), expected) << words;
        }
    }
}

TEST_F(Compute, HistogramCountsWhatIsInRange) {
    const Histogram histogram(programs_);
    programs_.compile();
    constexpr uint32_t kBins = 37;
    const std::vector<uint32_t> values = randomNumbers(100000, 50, 1);
    std::vector<uint32_t> expected(kBins);
    for (const uint32_t value : values)
        if (value < kBins) ++expected[value];
    CommandStream stream(device());
    const Buffer counts(device(), "counts", kBins * sizeof(uint32_t));
    const Buffer source = upload(stream, values);
    histogram.record(stream, source, counts, uint32_t(values.size()), kBins);
    EXPECT_EQ(stream.readAs<uint32_t>(counts, kBins), expected);
}

TEST_F(Compute, RadixSortIsStableAndEqualsTheStandardLibrarys) {
    RadixSort sort(programs_);
    programs_.compile();
    for (const uint32_t count : kCounts)
        for (const uint32_t keyBits : {32u, 9u}) {
            // Few different keys in the second case: many are equal, and their values keep their order.
            const std::vector<uint32_t> keys = randomNumbers(count, keyBits == 32 ? 0 : 400, count + keyBits);
            std::vector<uint32_t> order(count), sortedKeys(count);
            std::iota(order.begin(), order.end(), 0u);
            CommandStream stream(device());
            Buffer deviceKeys = upload(stream, keys), deviceValues = upload(stream, order);
            std::ranges::stable_sort(order, {}, [&](uint32_t i) { return keys[i]; });
            for (uint32_t i = 0; i < count; ++i) sortedKeys[i] = keys[order[i]];
            sort.record(stream, deviceKeys, deviceValues, count, keyBits);
            EXPECT_EQ(stream.readAs<uint32_t>(deviceKeys, count), sortedKeys) << count;
            EXPECT_EQ(stream.readAs<uint32_t>(deviceValues, count), order) << count;
        }
}

}  // namespace
}  // namespace voxray
