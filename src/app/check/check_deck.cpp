// `courant check`, first part: what is in the deck, sound or not.
#include <fmt/format.h>
#include <algorithm>
#include <map>
#include <set>

#include "app/check/check.hpp"
#include "keyword/help/families.hpp"
#include "keyword/source.hpp"

namespace courant {

namespace {

constexpr std::size_t line_width = 100;

std::string size_of(const DeckFile& file) {
  if (!file.source) return "";
  const double bytes = static_cast<double>(file.source->text.size());
  const std::size_t lines = file.source->lines.size();
  return fmt::format("{} line{}, {}", lines, lines == 1 ? "" : "s",
                     bytes < 1e4   ? fmt::format("{:.0f} bytes", bytes)
                     : bytes < 1e6 ? fmt::format("{:.0f} kB", bytes / 1e3)
                                   : fmt::format("{:.1f} MB", bytes / 1e6));
}

/// How deep a file is in the tree of includes.
int depth_of(const Deck& deck, const DeckFile& file) {
  int depth = 0;
  for (std::int32_t f = file.parent; f >= 0; f = deck.files[static_cast<std::size_t>(f)].parent) ++depth;
  return depth;
}

const char* word_of(Treatment treatment) {
  switch (treatment) {
    case Treatment::output_only:
      return "no effect: output";
    case Treatment::refused:
      return "REFUSED";
    default:
      return "honoured";
  }
}

/// "a, b, c" over lines of the page's width, from `column` on.
std::string wrapped(const std::vector<std::string>& words, std::size_t column) {
  std::string out, line;
  for (std::size_t k = 0; k < words.size(); ++k) {
    const std::string word = words[k] + (k + 1 < words.size() ? "," : "");
    if (!line.empty() && column + line.size() + 1 + word.size() > line_width) {
      out += line + "\n" + std::string(column, ' ');
      line.clear();
    }
    line += (line.empty() ? "" : " ") + word;
  }
  return out + line;
}

/// Shortens a long list to its first entries and a count.
template <class T, class Text>
std::string first_of(const std::vector<T>& all, std::size_t column, Text text) {
  constexpr std::size_t most = 20;
  std::vector<std::string> words;
  for (std::size_t k = 0; k < std::min(most, all.size()); ++k) words.push_back(text(all[k]));
  if (all.size() > most) words.push_back(fmt::format("... {} more", all.size() - most));
  return wrapped(words, column);
}

}  // namespace

std::string files_text(const Deck& deck) {
  constexpr std::size_t most = 40;
  std::string out = "Files\n";
  for (std::size_t k = 0; k < std::min(most, deck.files.size()); ++k) {
    const DeckFile& file = deck.files[k];
    const std::string indent(2 + 2 * static_cast<std::size_t>(std::min(depth_of(deck, file), 20)), ' ');
    out += fmt::format("{:<52}  {}", indent + file.name, size_of(file));
    if (file.parent >= 0)
      out += fmt::format(", included by {}:{}", deck.files[static_cast<std::size_t>(file.parent)].name,
                         file.line);
    if (file.conversion.any() || !file.conversion.transformations.empty()) out += ", transformed";
    out += "\n";
  }
  if (deck.files.size() > most) out += fmt::format("  ... {} more\n", deck.files.size() - most);
  return out;
}

std::string parameters_text(const Deck& deck) {
  constexpr std::size_t most = 100;
  std::string out;
  for (std::size_t k = 0; k < std::min(most, deck.parameters.size()); ++k) {
    const DeckParameter& p = deck.parameters[k];
    out +=
        fmt::format("  {} {:<20} {:<28}  {}:{}{}{}{}\n", p.type, p.name, p.text, p.where.file, p.where.line,
                    p.local ? ", local" : "", p.given ? ", from --param" : "", p.used ? "" : ", unused");
  }
  if (deck.parameters.size() > most) out += fmt::format("  ... {} more\n", deck.parameters.size() - most);
  return out.empty() ? out : "Parameters\n" + out;
}

std::string keywords_text(const Deck& deck) {
  std::string out = fmt::format("{:<43}{:>6}{:>11}  treatment\n", "Keywords", "blocks", "entries");
  for (const auto& [name, use] : deck.keywords) {
    // entries of keywords without a table cannot be counted; lines can
    const std::string entries = use.lines > 0     ? fmt::format("{} lines", use.lines)
                                : use.entries > 0 ? fmt::format("{}", use.entries)
                                                  : "-";
    std::string what = word_of(use.treatment);
    if (use.treatment == Treatment::refused)
      what += use.lacking.empty() ? ": unknown" : fmt::format(": {}", use.lacking);
    out += fmt::format("  *{:<40}{:>6}{:>11}  {}\n", name, use.blocks, entries, what);
  }
  return out;
}

std::string mesh_text(const DeckFacts& facts) {
  std::string out = fmt::format("Mesh\n  {:<24}{:>10}", "nodes", facts.nodes);
  if (facts.nodes > 0) {
    const Vec size = facts.high - facts.low;
    out += fmt::format("  from ({:.4g}, {:.4g}, {:.4g}), size {:.4g} x {:.4g} x {:.4g} [L]", facts.low[0],
                       facts.low[1], facts.low[2], size[0], size[1], size[2]);
  }
  out += "\n";
  for (const ElementFacts& e : facts.elements) {
    if (e.count > 0) {
      out += fmt::format("  {:<24}{:>10}", e.kind, e.count);
      if (e.mass > 0) out += fmt::format("  given mass {:.6g} [M]", e.mass);
      if (e.volume > 0) out += fmt::format("  given volume {:.6g} [L3, in 2D L2]", e.volume);
      out += "\n";
    }
    if (e.unread > 0) out += fmt::format("  {:<24}{:>10}  (lines that are not read)\n", e.kind, e.unread);
  }
  if (facts.parts.empty()) return out;
  out += "Parts in the deck\n";
  out += fmt::format("  {:>10}  {:<30} {:>9}{:>9}{:>9}  {}\n", "part", "title", "section", "material", "eos",
                     "elements");
  constexpr int most = 60;
  int shown = 0;
  for (const auto& [id, part] : facts.parts) {
    if (++shown > most) continue;
    std::vector<std::string> elements;
    for (const auto& [kind, count] : part.elements) elements.push_back(fmt::format("{} {}", kind, count));
    std::string row = fmt::format("  {:>10}  {:<30.30} ", id, part.title);
    row += part.defined ? fmt::format("{:>9}{:>9}{:>9}  ", part.secid, part.mid, part.eosid)
                        : fmt::format("{:>27}  ", "no *PART");
    out += row + (elements.empty() ? "none" : wrapped(elements, row.size())) + "\n";
  }
  if (shown > most) out += fmt::format("  ... {} more\n", shown - most);
  return out;
}

std::string needs_text(const Deck& deck, const DeckFacts& facts) {
  std::map<std::string, std::vector<std::string>> keywords_of;  // by what they lack
  std::set<std::string> given;
  for (const auto& [name, use] : deck.keywords) {
    if (use.treatment == Treatment::refused)
      keywords_of[use.lacking.empty() ? "unknown keywords" : use.lacking].push_back("*" + name);
    given.insert(name.substr(0, name.find('_')));
  }
  const auto has = [&](const char* begin) {
    const auto at = deck.keywords.lower_bound(begin);
    return at != deck.keywords.end() && at->first.rfind(begin, 0) == 0;
  };
  const auto holds = [&](const char* kind) {
    return std::any_of(facts.elements.begin(), facts.elements.end(),
                       [&](const ElementFacts& e) { return e.kind == kind && e.count + e.unread > 0; });
  };
  const bool solids = holds("solids"), particles = holds("SPH particles") || has("DEFINE_SPH_INJECTION");
  const bool frames = holds("shells") || holds("beams") || holds("springs and dampers");
  std::vector<std::pair<const char*, const char*>> missing;
  if (facts.nodes == 0) missing.emplace_back("*NODE", "coordinates");
  if (!particles && !solids && !frames)
    missing.emplace_back("*ELEMENT_SPH or *ELEMENT_SOLID", "particles, or solids");
  const bool of_particles = particles || (!solids && !frames);
  if (!has("PART")) missing.emplace_back("*PART", "what the elements are made of");
  if (of_particles && !has("SECTION_SPH")) missing.emplace_back("*SECTION_SPH", "smoothing length");
  if (solids && !has("SECTION_SOLID")) missing.emplace_back("*SECTION_SOLID", "formulation of the solids");
  if (of_particles && !has("MAT_")) missing.emplace_back("*MAT_NULL", "density of the particles' material");
  if (solids && !has("MAT_")) missing.emplace_back("*MAT_ELASTIC", "what the solids are made of");
  if (of_particles && !has("EOS_") && !has("MAT_ELASTIC") && !has("MAT_001"))
    missing.emplace_back("*EOS_...", "equation of state of the particles");
  if (!has("CONTROL_TERMINATION")) missing.emplace_back("*CONTROL_TERMINATION", "end time");
  std::string out;
  for (const auto& [what, names] : keywords_of) {
    const std::string row = fmt::format("  not supported: {}: ", what);
    out += row + wrapped(names, std::min<std::size_t>(row.size(), 40)) + "\n";
  }
  for (const auto& [name, what] : missing) out += fmt::format("  not in the deck: {} ({})\n", name, what);
  return out.empty() ? out : "What a run would need\n" + out;
}

std::string unused_text(const Deck& deck, const UnusedIds& unused) {
  if (!unused.any()) return "";
  std::string out = "Ids that nothing refers to\n";
  for (std::size_t begin = 0; begin < unused.named.size();) {
    std::vector<UnusedId> same;
    const IdSpace space = unused.named[begin].space;
    for (; begin < unused.named.size() && unused.named[begin].space == space; ++begin)
      same.push_back(unused.named[begin]);
    const std::string row = fmt::format("  {:<24} ", id_word(space));
    out +=
        row +
        first_of(same, row.size(),
                 [&](const UnusedId& one) { return fmt::format("{} ({})", one.id, deck.place(one.entry)); }) +
        "\n";
  }
  if (!unused.nodes.empty()) {
    const std::string row = fmt::format(
        "  {:<24} ", fmt::format("{} node{}", unused.nodes.size(), unused.nodes.size() == 1 ? "" : "s"));
    out += row + first_of(unused.nodes, row.size(), [](Id id) { return fmt::format("{}", id); }) + "\n";
  }
  return out;
}

}  // namespace courant
