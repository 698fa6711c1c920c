#include "mutate.hpp"

#include <algorithm>
#include <iterator>
#include <string_view>

#include "keyword/registry.hpp"

namespace courant::fuzz {

namespace {

const std::vector<std::string> numbers = {"0",
                                          "-1",
                                          "1",
                                          "2",
                                          "7",
                                          "99999999",
                                          "2147483648",
                                          "9999999999999999",
                                          "9223372036854775807",
                                          "-9223372036854775808",
                                          "18446744073709551616",
                                          "1e308",
                                          "-1e308",
                                          "1e-308",
                                          "1.5-3",
                                          "1.d+5",
                                          "1e999",
                                          "nan",
                                          ".5"};

const std::vector<std::string> pieces = {",",
                                         ",,,",
                                         "&",
                                         "-&",
                                         "<",
                                         ">",
                                         "(",
                                         ")",
                                         "$",
                                         "*",
                                         "\r",
                                         "\r\n",
                                         "\n",
                                         "\t",
                                         " ",
                                         "\n\n\n",
                                         "+",
                                         "%",
                                         "\"",
                                         "-",
                                         "\xC3\xA4",
                                         "\xFF",
                                         "&low",
                                         "<1+2*3>",
                                         " +\n",
                                         "_TITLE",
                                         "_ID",
                                         "_MPP",
                                         "_GENERATE",
                                         "_SET",
                                         "_LIST",
                                         "LONG=Y",
                                         "I10=Y",
                                         "ALL",
                                         "PART",
                                         "BOX",
                                         "TRANSL",
                                         "ROTATE",
                                         "SCALE",
                                         "MIRROR",
                                         "R",
                                         "I",
                                         "$$FILE a.k\n",
                                         "\n*INCLUDE\na.k\n",
                                         "\n*END\n",
                                         "\n*KEYWORD LONG=Y\n"};

/// Of the registry: "\n*NODE\n".
const std::vector<std::string>& keyword_lines() {
  static const std::vector<std::string> lines = [] {
    std::vector<std::string> all;
    for (const auto& keyword : keyword_registry())
      for (const std::string& name : keyword->names) all.push_back("\n*" + name + "\n");
    return all;
  }();
  return lines;
}

/// Begin of the line in which `at` lies.
std::size_t line_start(const std::string& text, std::size_t at) {
  const std::size_t feed = at == 0 ? std::string::npos : text.rfind('\n', at - 1);
  return feed == std::string::npos ? 0 : feed + 1;
}

/// Begin of the line behind that in which `at` lies.
std::size_t line_end(const std::string& text, std::size_t at) {
  return std::min(text.find('\n', at), text.size() - 1) + 1;
}

}  // namespace

Mutator::Mutator(std::uint64_t seed) : Mutator(seed, pieces, keyword_lines()) {}

Mutator::Mutator(std::uint64_t seed, const std::vector<std::string>& pieces,
                 const std::vector<std::string>& lines)
    : random_(seed), pieces_(pieces), keywords_(lines) {}

std::size_t Mutator::below(std::size_t bound) {
  return bound == 0 ? 0 : static_cast<std::size_t>(random_() % bound);
}

void Mutator::change(std::string& deck, const std::string& other, std::size_t largest) {
  for (std::size_t changes = 1 + below(4); changes > 0; --changes) change_once(deck, other);
  if (deck.size() > largest) deck.resize(largest);
}

void Mutator::change_once(std::string& deck, const std::string& other) {
  if (deck.empty()) deck = other.empty() ? "*KEYWORD\n" : other;
  if (below(2) == 0)
    change_bytes(deck);
  else
    change_lines(deck, other);
}

void Mutator::change_bytes(std::string& deck) {
  const std::size_t at = below(deck.size());
  switch (below(7)) {
    case 0:
      deck[at] = static_cast<char>(random_());
      break;
    case 1:
      deck.erase(at, 1 + below(12));
      break;
    case 2:
      deck.insert(at, one_of(pieces_));
      break;
    case 3:
      deck.insert(at, one_of(keywords_));
      break;
    case 4:
      deck.resize(at);
      break;
    default: {  // a number for another, over the same columns or not
      const std::size_t digit = std::min(deck.find_first_of("0123456789", at), deck.size());
      const std::size_t end = std::min(deck.find_first_not_of("0123456789.+-eE", digit), deck.size());
      const std::string& number = one_of(numbers);
      const std::size_t before = std::min(digit, number.size());
      const bool keep_columns =
          below(2) == 0 && deck.substr(digit - before, before).find('\n') == std::string::npos;
      if (keep_columns)
        deck.replace(digit - before, end - digit + before, std::string(end - digit, ' ') + number);
      else
        deck.replace(digit, end - digit, number);
    }
  }
}

void Mutator::change_lines(std::string& deck, const std::string& other) {
  const std::size_t begin = line_start(deck, below(deck.size()));
  std::size_t end = begin;
  for (std::size_t lines = 1 + below(8); lines > 0 && end < deck.size(); --lines) end = line_end(deck, end);
  const std::string block = deck.substr(begin, end - begin);
  switch (below(6)) {
    case 0:
      deck.erase(begin, end - begin);
      break;
    case 1:
      for (std::size_t copies = 1 + below(below(8) == 0 ? 300 : 3); copies > 0; --copies)
        deck.insert(begin, block);
      break;
    case 2:
      deck.insert(line_start(deck, below(deck.size())), block);
      break;
    case 3: {
      if (other.empty()) break;
      const std::size_t from = line_start(other, below(other.size()));
      std::size_t to = from;
      for (std::size_t lines = 1 + below(20); lines > 0 && to < other.size(); --lines)
        to = line_end(other, to);
      deck.insert(begin, other, from, to - from);
      break;
    }
    case 4:
      deck.insert(begin, one_of(keywords_).substr(1) + block);
      break;
    default: {  // fixed columns as commas
      std::string commas;
      for (const char c : block)
        if (c != ' ')
          commas += c;
        else if (!commas.empty() && commas.back() != ',')
          commas += ',';
      deck.replace(begin, end - begin, commas);
    }
  }
}

void change_binary(std::string& bytes, const std::string& other, std::size_t largest,
                   std::mt19937_64& random) {
  const auto below = [&](std::size_t bound) {
    return bound == 0 ? 0 : static_cast<std::size_t>(random() % bound);
  };
  if (bytes.empty()) bytes = other;
  for (std::size_t changes = 1 + below(4); changes > 0 && !bytes.empty(); --changes) {
    const std::size_t at = below(bytes.size());
    switch (below(8)) {
      case 0:
      case 1:
        bytes[at] = static_cast<char>(bytes[at] ^ (1 << below(8)));
        break;
      case 2:
        bytes[at] = static_cast<char>(random());
        break;
      case 3:
      case 4: {
        constexpr std::uint64_t limits[] = {0,       1,          0x7f,       0xff,        0x7fff,    0xffff,
                                            1 << 24, 0x7fffffff, 0xffffffff, 1ull << 40u, ~0ull / 2, ~0ull};
        const std::uint64_t value = limits[below(std::size(limits))];
        const std::size_t width = std::size_t(1) << below(4);
        for (std::size_t k = 0; k < width && at + k < bytes.size(); ++k)
          bytes[at + k] = static_cast<char>(value >> 8 * k);
        break;
      }
      case 5:
        bytes.erase(at, 1 + below(below(2) == 0 ? 8 : 512));
        break;
      case 6:
        bytes.insert(at, other, below(other.size()), 1 + below(64));
        break;
      default:
        if (below(4) == 0)
          bytes.resize(at);
        else
          bytes.insert(at, bytes.substr(at, 1 + below(32)));
    }
  }
  if (bytes.size() > largest) bytes.resize(largest);
}

}  // namespace courant::fuzz
