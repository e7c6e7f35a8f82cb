#pragma once

#include <array>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "scene/import/notes.h"
#include "scene/memory_budget.h"
#include "scene/pbrt/state.h"

namespace voxray::pbrt {

/// Reads directives into a description. The directives themselves are in directives.cpp.
class Parser {
 public:
    Parser(const std::filesystem::path& path, ImportNotes& notes, MemoryBudget& memory)
        : root_(path), notes_(notes), memory_(memory) {
        auto plain = std::make_shared<Parameters>();
        plain->directive = "Material";
        plain->kind = "diffuse";
        state_.material.material = plain;
        parseFile(path, 0);
        finish();
    }

    Description description;

 private:
    using Handler = void (Parser::*)(const std::string& directive, const TextLocation& where);
    static const std::map<std::string, Handler, std::less<>>& handlers();

    void parseFile(const std::filesystem::path& path, int depth);
    void finish();

    // Directives
    void attributeBegin(const std::string&, const TextLocation& where);
    void attributeEnd(const std::string& directive, const TextLocation& where);
    void attribute(const std::string& directive, const TextLocation& where);
    void activeTransform(const std::string& directive, const TextLocation& where);
    void areaLightSource(const std::string& directive, const TextLocation& where);
    void camera(const std::string& directive, const TextLocation& where);
    void colorSpace(const std::string& directive, const TextLocation& where);
    void concatTransform(const std::string& directive, const TextLocation&);
    void coordinateSystem(const std::string& directive, const TextLocation&);
    void coordSysTransform(const std::string& directive, const TextLocation& where);
    void film(const std::string& directive, const TextLocation& where);
    void identity(const std::string&, const TextLocation&);
    void import(const std::string& directive, const TextLocation& where);
    void include(const std::string& directive, const TextLocation& where);
    void lightSource(const std::string& directive, const TextLocation& where);
    void lookAt(const std::string& directive, const TextLocation& where);
    void makeNamedMaterial(const std::string& directive, const TextLocation& where);
    void makeNamedMedium(const std::string& directive, const TextLocation& where);
    void material(const std::string& directive, const TextLocation& where);
    void mediumInterface(const std::string& directive, const TextLocation& where);
    void namedMaterial(const std::string& directive, const TextLocation& where);
    void objectBegin(const std::string& directive, const TextLocation& where);
    void objectEnd(const std::string&, const TextLocation& where);
    void objectInstance(const std::string& directive, const TextLocation& where);
    void option(const std::string& directive, const TextLocation&);
    void ofRenderer(const std::string& directive, const TextLocation& where);
    void reverseOrientation(const std::string&, const TextLocation&);
    void rotate(const std::string& directive, const TextLocation& where);
    void scale(const std::string& directive, const TextLocation&);
    void shape(const std::string& directive, const TextLocation& where);
    void texture(const std::string& directive, const TextLocation& where);
    void transform(const std::string& directive, const TextLocation&);
    void transformTimes(const std::string& directive, const TextLocation&);
    void translate(const std::string& directive, const TextLocation&);
    void worldBegin(const std::string&, const TextLocation&);
    void worldEnd(const std::string&, const TextLocation&) {}

    template <size_t n>
    std::array<double, n> takeNumbers(const std::string& directive);
    glm::dmat4 takeMatrix(const std::string& directive);
    void concat(const glm::dmat4& matrix);
    /// Kind and parameters. @param defaults what `Attribute` calls them, or ""
    std::shared_ptr<Parameters> takeParameters(const std::string& directive, const TextLocation& where,
                                               const std::string& defaults);

    std::filesystem::path root_;
    ImportNotes& notes_;
    MemoryBudget& memory_;
    Lexer* lexer_ = nullptr;  ///< Of the file that is read.
    int depth_ = 0;
    State state_;
    std::vector<std::pair<std::string, State>> saved_;  ///< With the directive that began each.
    std::map<std::string, glm::dmat4> coordinateSystems_;
    std::vector<Shape>* object_ = nullptr;  ///< That ObjectBegin began.
};

template <size_t n>
std::array<double, n> Parser::takeNumbers(const std::string& directive) {
    std::array<double, n> numbers;
    const bool hasBracket = lexer_->takeIf(TokenKind::Open);
    for (double& number : numbers) number = lexer_->takeNumber(directive);
    if (hasBracket && !lexer_->takeIf(TokenKind::Close))
        throw Error(lexer_->where(lexer_->peek()), "{} has more than {} numbers, or a ] is missing", directive, n);
    return numbers;
}

}  // namespace voxray::pbrt
