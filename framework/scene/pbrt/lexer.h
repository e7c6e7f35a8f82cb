#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "base/error.h"

namespace voxray::pbrt {

enum class TokenKind : uint8_t { End, Word, String, Open, Close };

struct Token {
    TokenKind kind = TokenKind::End;
    std::string_view text;  ///< Of a string without its quotes. Valid until the next token is taken.
    int line = 0;
};

/// Splits the text of a pbrt file into words, strings and brackets; comments are left out.
class Lexer {
 public:
    Lexer(std::string text, std::string file) : text_(std::move(text)), file_(std::move(file)) {}
    Lexer(const Lexer&) = delete;
    Lexer& operator=(const Lexer&) = delete;

    const std::string& file() const { return file_; }
    TextLocation where(const Token& token) const { return {file_, token.line}; }

    /// The next token without taking it. @throws Error with file and line
    const Token& peek();
    Token take();

    /// Takes a string, number or word. @param after the directive or parameter that wants it, for the message
    std::string takeString(const std::string& after);
    double takeNumber(const std::string& after);
    std::string takeWord(const std::string& after);
    /// Takes an opening or closing bracket, if it comes next. @return whether it did
    bool takeIf(TokenKind bracket);

 private:
    void skipSpace();
    Token read();
    Token readString();
    Token takeKind(TokenKind kind, const char* what, const std::string& after);

    std::string text_;
    std::string file_;
    size_t at_ = 0;
    int line_ = 1;
    bool hasNext_ = false;
    Token next_;
    std::string unescaped_;
};

/// A number that is all of a text, as pbrt writes it. @throws Error at a place
double numberOf(std::string_view text, const TextLocation& where, const std::string& after);

}  // namespace voxray::pbrt
