#include "scene/pbrt/lexer.h"

#include <algorithm>

#include "scene/import/numbers.h"

namespace voxray::pbrt {
namespace {

constexpr std::string_view kSpaces = " \t\r\n";
constexpr std::string_view kEnds = " \t\r\n\"[]#";

std::string shown(std::string_view text) {
    return std::string(text.substr(0, 40));
}

}  // namespace

double numberOf(std::string_view text, const TextLocation& where, const std::string& after) {
    std::string_view rest = text;
    // pbrt reads "1." and ".5" as C does
    const std::optional<double> number = takeNumber(rest);
    if (!number || !rest.empty()) throw Error(where, "'{}' is no number; {} wants one", shown(text), after);
    return *number;
}

void Lexer::skipSpace() {
    for (; at_ < text_.size(); ++at_) {
        const char c = text_[at_];
        if (c == '#') {
            at_ = std::min(text_.find('\n', at_), text_.size());
            if (at_ == text_.size()) return;
            ++line_;
        } else if (c == '\n') {
            ++line_;
        } else if (kSpaces.find(c) == std::string_view::npos) {
            return;
        }
    }
}

Token Lexer::readString() {
    const int line = line_;
    const size_t begin = ++at_;
    bool escaped = false;
    for (; at_ < text_.size() && text_[at_] != '"' && text_[at_] != '\n'; ++at_)
        if (text_[at_] == '\\') {
            escaped = true;
            if (at_ + 1 < text_.size()) ++at_;
        }
    if (at_ >= text_.size() || text_[at_] != '"')
        throw Error(TextLocation{file_, line}, "the string that begins here has no closing quote");
    const std::string_view raw = std::string_view(text_).substr(begin, at_ - begin);
    ++at_;
    if (!escaped) return {TokenKind::String, raw, line};

    unescaped_.clear();
    for (size_t i = 0; i < raw.size(); ++i) {
        if (raw[i] == '\\' && i + 1 < raw.size())
            ++i, unescaped_ += raw[i] == 'n' ? '\n' : raw[i] == 't' ? '\t' : raw[i];
        else
            unescaped_ += raw[i];
    }
    return {TokenKind::String, unescaped_, line};
}

Token Lexer::read() {
    skipSpace();
    if (at_ >= text_.size()) return {TokenKind::End, {}, line_};
    const std::string_view text = text_;
    const char c = text[at_];
    if (c == '"') return readString();
    if (c == '[' || c == ']') return {c == '[' ? TokenKind::Open : TokenKind::Close, text.substr(at_++, 1), line_};
    const size_t end = std::min(text.find_first_of(kEnds, at_), text.size());
    const std::string_view word = text.substr(at_, end - at_);
    at_ = end;
    return {TokenKind::Word, word, line_};
}

const Token& Lexer::peek() {
    if (!hasNext_) next_ = read();
    hasNext_ = true;
    return next_;
}

Token Lexer::take() {
    const Token token = peek();
    hasNext_ = false;
    return token;
}

Token Lexer::takeKind(TokenKind kind, const char* what, const std::string& after) {
    const Token token = take();
    if (token.kind == TokenKind::End) throw Error(where(token), "the file ends where {} wants {}", after, what);
    if (token.kind != kind) throw Error(where(token), "'{}' stands where {} wants {}", shown(token.text), after, what);
    return token;
}

std::string Lexer::takeString(const std::string& after) {
    return std::string(takeKind(TokenKind::String, "a string in quotes", after).text);
}

double Lexer::takeNumber(const std::string& after) {
    const Token token = takeKind(TokenKind::Word, "a number", after);
    return numberOf(token.text, where(token), after);
}

std::string Lexer::takeWord(const std::string& after) {
    return std::string(takeKind(TokenKind::Word, "a word", after).text);
}

bool Lexer::takeIf(TokenKind bracket) {
    if (peek().kind != bracket) return false;
    take();
    return true;
}

}  // namespace voxray::pbrt
