#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "experiment/aovs.h"

namespace voxray {

/// What can be looked at of a rendering besides its image: AOVs, images and buffers of passes, voxels.
struct ViewInfo {
    enum class Kind { Aov, Image, Buffer, Voxels };
    /// Of a value; numpy's types of these names.
    enum class Type { Uint8, Uint32, Uint64, Float16, Float32 };

    std::string name;  ///< "<pass>.<what>"
    std::string pass;
    Kind kind = Kind::Image;
    Type type = Type::Float32;
    /// Of the array, the slowest axis first: (height, width[, channels]), (depth, height, width[, channels]),
    /// (elements[, values]).
    std::vector<uint64_t> shape;
    std::vector<std::string> channels;  ///< Names of the last axis, or of the only channel; empty: unnamed.
    Quantity quantity = Quantity::Other;
    std::string note{};  ///< What its colors mean besides.
};

template <>
struct EnumNames<ViewInfo::Kind> {
    static constexpr std::array names{std::pair{ViewInfo::Kind::Aov, "aov"}, std::pair{ViewInfo::Kind::Image, "image"},
                                      std::pair{ViewInfo::Kind::Buffer, "buffer"},
                                      std::pair{ViewInfo::Kind::Voxels, "voxels"}};
};
template <>
struct EnumNames<ViewInfo::Type> {
    static constexpr std::array names{
        std::pair{ViewInfo::Type::Uint8, "uint8"}, std::pair{ViewInfo::Type::Uint32, "uint32"},
        std::pair{ViewInfo::Type::Uint64, "uint64"}, std::pair{ViewInfo::Type::Float16, "float16"},
        std::pair{ViewInfo::Type::Float32, "float32"}};
};
template <>
struct EnumNames<Quantity> {
    static constexpr std::array names{std::pair{Quantity::Radiance, "radiance"},
                                      std::pair{Quantity::Fraction, "fraction"},
                                      std::pair{Quantity::Direction, "direction"},
                                      std::pair{Quantity::Number, "number"}, std::pair{Quantity::Other, "other"}};
};

/// Bytes of a value.
uint32_t bytesOf(ViewInfo::Type type);
/// Number of values of an array.
uint64_t valuesOf(const ViewInfo& info);

/// A view with its values, in the host's byte order.
struct ViewArray : ViewInfo {
    std::vector<std::byte> bytes;
    uint64_t elements = 0;  ///< Of the whole buffer, of which `shape` may be a part.
};

/// Values of a 2D image as a view. @param channels names of all channels.
ViewArray viewOfImage(ViewInfo info, const ImageF& image, std::vector<std::string> channels);
/// The image of a view that viewOfImage() made.
ImageF imageOf(const ViewArray& view);

/// The compared frame, as a graph has rendered it.
struct RenderedFrame {
    const Graph& graph;
    const Frame& frame;
    glm::vec3 origin;  ///< Of the frame's coordinates, m.
    Device& device;
    CommandStream& stream;
};

/// All but voxels, by pass in execution order. Reads nothing back.
std::vector<ViewInfo> listViews(const Graph& graph, Device& device);
/// Reads one of them. @param maxValues of a buffer; its first ones, as whole elements.
/// @throws UsageError for a name that is not listed, with the most similar one.
ViewArray readView(const RenderedFrame& rendered, const std::string& name, uint64_t maxValues);

}  // namespace voxray
