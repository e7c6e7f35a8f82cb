#include "image/bootstrap.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace voxray {
namespace {

constexpr uint32_t kTileEdge = 16;
constexpr size_t kMinTiles = 64;
// The 25th value from either end bounds 2.5 %.
constexpr size_t kResamples = 999, kTail = 25;

struct Tile {
    double sum = 0;
    double count = 0;
};

std::vector<Tile> tilesOf(const std::vector<double>& values, uint32_t width, uint32_t height, PixelMask mask,
                          size_t count) {
    const uint32_t edge = std::clamp(uint32_t(std::sqrt(double(count) / double(kMinTiles))), 1u, kTileEdge);
    const size_t tilesX = (width + edge - 1) / edge;
    std::vector<Tile> tiles(tilesX * ((height + edge - 1) / edge));
    for (uint32_t y = 0; y < height; ++y)
        for (uint32_t x = 0; x < width; ++x) {
            const size_t pixel = size_t(y) * width + x;
            if (!mask.empty() && !mask[pixel]) continue;
            Tile& tile = tiles[y / edge * tilesX + x / edge];
            tile.sum += values[pixel];
            tile.count += 1;
        }
    std::erase_if(tiles, [](const Tile& tile) { return tile.count == 0; });
    return tiles;
}

}  // namespace

Estimate meanOverTiles(const std::vector<double>& values, uint32_t width, uint32_t height, PixelMask mask) {
    const std::vector<Tile> tiles = tilesOf(values, width, height, mask, countPixels(width, height, mask));
    Tile total;
    for (const Tile& tile : tiles) {
        total.sum += tile.sum;
        total.count += tile.count;
    }
    Estimate mean(total.sum / total.count);
    if (tiles.size() < 2) return mean;

    // Resample as many tiles with replacement
    std::mt19937 random(1);
    std::vector<double> means(kResamples);
    for (double& resampled : means) {
        Tile drawn;
        for (size_t i = 0; i < tiles.size(); ++i) {
            const Tile& tile = tiles[(uint64_t(random()) * tiles.size()) >> 32];
            drawn.sum += tile.sum;
            drawn.count += tile.count;
        }
        resampled = drawn.sum / drawn.count;
    }
    std::sort(means.begin(), means.end());
    mean.interval = {means[kTail - 1], means[kResamples - kTail]};
    return mean;
}

}  // namespace voxray
