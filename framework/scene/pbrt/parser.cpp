#include "scene/pbrt/parser.h"

#include <utility>

#include "base/files.h"
#include "base/interrupt.h"
#include "base/suggest.h"
#include "scene/import/inflate.h"
#include "scene/pbrt/directives.h"

namespace voxray::pbrt {
namespace {

constexpr uint64_t kBytesPerByte = 10;    ///< Memory for a byte of text: a digit and a space become a double.
constexpr uint64_t kBytesPerFile = 4096;  ///< Of an empty one.

/// The text of a file, which may be compressed.
std::string readText(const std::filesystem::path& path, MemoryBudget& memory) {
    std::vector<uint8_t> bytes = readFile(path);
    memory.reserve(bytes.size() + kBytesPerFile, kBytesPerByte);
    if (isGzip(bytes)) {
        bytes = inflateBytes(bytes, memory);
        memory.reserve(bytes.size(), kBytesPerByte);
    }
    return {bytes.begin(), bytes.end()};
}

}  // namespace

const std::map<std::string, Parser::Handler, std::less<>>& Parser::handlers() {
    using P = Parser;
    static const std::map<std::string, Handler, std::less<>> table{
        {"Accelerator", &P::ofRenderer},
        {"ActiveTransform", &P::activeTransform},
        {"AreaLightSource", &P::areaLightSource},
        {"Attribute", &P::attribute},
        {"AttributeBegin", &P::attributeBegin},
        {"AttributeEnd", &P::attributeEnd},
        {"Camera", &P::camera},
        {"ColorSpace", &P::colorSpace},
        {"ConcatTransform", &P::concatTransform},
        {"CoordinateSystem", &P::coordinateSystem},
        {"CoordSysTransform", &P::coordSysTransform},
        {"Film", &P::film},
        {"Identity", &P::identity},
        {"Import", &P::import},
        {"Include", &P::include},
        {"Integrator", &P::ofRenderer},
        {"LightSource", &P::lightSource},
        {"LookAt", &P::lookAt},
        {"MakeNamedMaterial", &P::makeNamedMaterial},
        {"MakeNamedMedium", &P::makeNamedMedium},
        {"Material", &P::material},
        {"MediumInterface", &P::mediumInterface},
        {"NamedMaterial", &P::namedMaterial},
        {"ObjectBegin", &P::objectBegin},
        {"ObjectEnd", &P::objectEnd},
        {"ObjectInstance", &P::objectInstance},
        {"Option", &P::option},
        {"PixelFilter", &P::ofRenderer},
        {"ReverseOrientation", &P::reverseOrientation},
        {"Rotate", &P::rotate},
        {"Sampler", &P::ofRenderer},
        {"Scale", &P::scale},
        {"Shape", &P::shape},
        {"Texture", &P::texture},
        {"Transform", &P::transform},
        {"TransformBegin", &P::attributeBegin},
        {"TransformEnd", &P::attributeEnd},
        {"TransformTimes", &P::transformTimes},
        {"Translate", &P::translate},
        {"WorldBegin", &P::worldBegin},
        {"WorldEnd", &P::worldEnd},
    };
    return table;
}

void Parser::parseFile(const std::filesystem::path& path, int depth) {
    Lexer lexer(readText(path, memory_), path.string());
    Lexer* const outer = std::exchange(lexer_, &lexer);
    const int outerDepth = std::exchange(depth_, depth);
    while (lexer.peek().kind != TokenKind::End) {
        if (interruptRequested()) throw Interrupted();
        const Token token = lexer.take();
        const TextLocation where = lexer.where(token);
        const std::string name(token.text.substr(0, 100));
        if (token.kind != TokenKind::Word)
            throw Error(where, "'{}' stands where a directive begins", name.substr(0, 40));
        const auto handler = handlers().find(name);
        if (handler == handlers().end()) {
            std::vector<std::string> names;
            for (const auto& entry : handlers()) names.push_back(entry.first);
            const std::string near = nearest(name, names);
            throw Error(where, "unknown directive '{}'{}", name.substr(0, 40),
                        near.empty() ? ": this is no pbrt-v4 file, or one of pbrt-v3; convert that by `pbrt --upgrade`"
                                     : "; did you mean '" + near + "'?");
        }
        (this->*handler->second)(handler->first, where);
    }
    lexer_ = outer;
    depth_ = outerDepth;
}

void Parser::finish() {
    if (!saved_.empty()) throw Error("{}: {} of '{}' has no end", root_.string(), saved_.size(), saved_.back().first);
}

std::shared_ptr<Parameters> Parser::takeParameters(const std::string& directive, const TextLocation& where,
                                                   const std::string& defaults) {
    auto parameters = std::make_shared<Parameters>();
    parameters->directive = directive;
    parameters->kind = lexer_->takeString(directive);
    parameters->where = where;
    parameters->read(*lexer_, state_.colorSpace);
    const auto found = state_.defaults->find(defaults);
    if (found != state_.defaults->end()) {
        memory_.reserve(found->second.size(), sizeof(std::shared_ptr<const Parameter>));
        parameters->addDefaults(found->second);
    }
    return parameters;
}

glm::dmat4 Parser::takeMatrix(const std::string& directive) {
    const std::array<double, 16> m = takeNumbers<16>(directive);
    glm::dmat4 matrix;
    // pbrt writes columns one after another, as glm stores them
    for (int i = 0; i < 16; ++i) matrix[i / 4][i % 4] = m[size_t(i)];
    return matrix;
}

void Parser::concat(const glm::dmat4& matrix) {
    if (state_.setsStart) state_.transform = state_.transform * matrix;
}

Description parse(const std::filesystem::path& path, ImportNotes& notes, MemoryBudget& memory) {
    return Parser(path, notes, memory).description;
}

}  // namespace voxray::pbrt
